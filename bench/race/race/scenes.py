"""The scenes of the race: the same that `octrace bench` has built in (see `digest`)."""

from __future__ import annotations

import math
import random
from collections.abc import Callable
from dataclasses import dataclass

from .solids import Below, Box, Copy, Cylinder, Node, Sphere, Vec, bar, difference, intersection, primitives, union

WIDTH, HEIGHT = 1024, 768


@dataclass(frozen=True)
class Material:
    """Phong's coefficients, and shares of light that is reflected and passes; POV-Ray's finish."""

    color: Vec
    ambient: float = 0.15
    diffuse: float = 0.75
    specular: float = 0.3
    shininess: float = 40.0
    reflect: float = 0.0
    transmit: float = 0.0
    ior: float = 1.0


@dataclass(frozen=True)
class Camera:
    """z is up; `across_deg` is the angle of view from the left to the right edge."""

    eye: Vec
    at: Vec
    across_deg: float

    @property
    def up_deg(self) -> float:
        """The angle of view from the lower to the upper edge."""
        half = math.atan(math.tan(math.radians(self.across_deg / 2.0)) * HEIGHT / WIDTH)
        return 2.0 * math.degrees(half)

    def frame(self) -> tuple[Vec, Vec, Vec]:
        """What a step to the right edge, to the upper edge, and ahead is, in a film at distance 1."""
        ahead = unit(tuple(a - e for a, e in zip(self.at, self.eye)))
        right = unit((ahead[1], -ahead[0], 0.0))
        up = cross(right, ahead)
        across = math.tan(math.radians(self.across_deg / 2.0))
        return tuple(c * across for c in right), tuple(c * across * HEIGHT / WIDTH for c in up), ahead


@dataclass(frozen=True)
class Scene:
    name: str
    camera: Camera
    lights: tuple[tuple[Vec, float], ...]
    parts: tuple[tuple[Material, Node], ...]
    background: Vec = (0.55, 0.65, 0.8)
    max_bounces: int = 1
    # How many facets make a circle, for programs that need a mesh.
    segments: int = 72

    @property
    def primitives(self) -> int:
        return sum(primitives(node) for _, node in self.parts)

    @property
    def is_quick(self) -> bool:
        return self.primitives <= 10_000


def unit(v: Vec) -> Vec:
    length = math.sqrt(sum(c * c for c in v))
    return tuple(c / length for c in v)


def cross(a: Vec, b: Vec) -> Vec:
    return a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]


RED = Material((0.8, 0.25, 0.2))
GREY = Material((0.7, 0.7, 0.7))
NEAR_LIGHTS = (((6.0, -8.0, 10.0), 0.7), ((-8.0, -5.0, 6.0), 0.35))
ORIGIN = (0.0, 0.0, 0.0)


def rounded_cube() -> Node:
    """Cube and sphere minus three cylinders."""
    both = intersection(Box((-1.0,) * 3, (1.0,) * 3), Sphere(ORIGIN, 1.35))
    return difference(both, *(bar(axis, ORIGIN, 1.5, 0.6) for axis in (2, 1, 0)))


def classic() -> Scene:
    camera = Camera((3.2, -4.8, 3.4), (0.0, 0.0, -0.1), 36.0)
    return Scene("classic", camera, NEAR_LIGHTS, ((RED, rounded_cube()), (GREY, Below(-1.0))))


def of_a_block(name: str, *holes: Node, segments: int = 72) -> Scene:
    """A block 2 wide, minus things."""
    camera = Camera((2.6, -3.8, 2.8), (0.0, 0.0, -0.1), 36.0)
    solid = difference(Box((-1.0,) * 3, (1.0,) * 3), *holes)
    return Scene(name, camera, NEAR_LIGHTS, ((RED, solid),), segments=segments)


def swiss(n: int) -> Scene:
    """Balls at random places; together they have 0.4 of the block's volume."""
    rng = random.Random(12345 + n)
    radius = (0.4 * 8.0 / n * 3.0 / (4.0 * math.pi)) ** (1.0 / 3.0)
    balls = []
    for _ in range(n):
        center = tuple(rng.uniform(-1.0, 1.0) for _ in range(3))
        balls.append(Sphere(center, radius * rng.uniform(0.6, 1.4)))
    return of_a_block(f"swiss-{n}", *balls, segments=72 if n <= 1000 else 24)


def menger(levels: int) -> Scene:
    """Square bars along all axes, finer at every level."""

    def is_kept(i: int, j: int) -> bool:
        while i or j:
            if i % 3 == 1 and j % 3 == 1:
                return False
            i, j = i // 3, j // 3
        return True

    bars = []
    for level in range(levels):
        across = 3**level
        cell = 2.0 / across
        w = cell / 3.0
        for i in range(across):
            for j in range(across):
                if is_kept(i, j):
                    u, v = (-1.0 + (k + 1.0 / 3.0) * cell for k in (i, j))
                    bars.append(Box((u, v, -1.1), (u + w, v + w, 1.1)))
                    bars.append(Box((u, -1.1, v), (u + w, 1.1, v + w)))
                    bars.append(Box((-1.1, u, v), (1.1, u + w, v + w)))
    return of_a_block(f"menger-{levels}", *bars)


def plate() -> Scene:
    """20 by 20 counterbored holes in a plate with rounded corners."""
    per_side, pitch, corner, thickness = 20, 1.5, 1.5, 1.0
    half = per_side * pitch / 2.0 + 0.5
    inner = half - corner

    def pin(x: float, y: float, radius: float, low: float, high: float) -> Node:
        return Cylinder(2, (x, y, low), high - low, radius)

    outline = [Box((-x, -y, 0.0), (x, y, thickness)) for x, y in ((inner, half), (half, inner))]
    outline += [pin(x * inner, y * inner, corner, 0.0, thickness) for x in (-1.0, 1.0) for y in (-1.0, 1.0)]
    places = [(i - (per_side - 1.0) / 2.0) * pitch for i in range(per_side)]
    holes = []
    for y in places:
        for x in places:
            holes.append(pin(x, y, 0.32, -0.5, thickness + 0.5))
            holes.append(pin(x, y, 0.55, 0.6 * thickness, thickness + 0.5))
    lights = (((40.0, -50.0, 60.0), 0.7), ((-50.0, -30.0, 40.0), 0.35))
    camera = Camera((18.0, -30.0, 26.0), (0.0, -1.0, 0.0), 50.0)
    return Scene("plate", camera, lights, ((RED, difference(union(*outline), *holes)),))


def grid(n: int) -> Scene:
    """Copies of the rounded cube."""
    counts = {100: (5, 5, 4), 1_000: (10, 10, 10), 10_000: (25, 20, 20), 100_000: (50, 50, 40)}[n]
    one = rounded_cube()
    x, y, z = ([(i - (count - 1.0) / 2.0) * 3.0 for i in range(count)] for count in counts)
    copies = union(*(Copy(one, (i, j, k)) for k in z for j in y for i in x))
    d = 3.0 * max(counts)
    camera = Camera((d, -1.5 * d, 1.05 * d), (0.0, 0.0, -0.06 * d), 44.0)
    lights = (((2.0 * d, -2.6 * d, 3.2 * d), 0.7), ((-2.6 * d, -1.6 * d, 2.0 * d), 0.35))
    return Scene(f"grid-{n}", camera, lights, ((RED, copies),))


def whitted() -> Scene:
    """Mirrors, glass, a lens and cut solids on a floor, under three lights."""
    floor = Material((0.75, 0.7, 0.55), specular=0.0)
    mirror = Material((0.9, 0.9, 0.95), 0.02, 0.1, 0.6, 120.0, reflect=0.8)
    glass = Material((0.95, 1.0, 0.97), 0.0, 0.02, 0.7, 200.0, reflect=0.1, transmit=0.88, ior=1.5)
    red = Material((0.8, 0.2, 0.15), reflect=0.1)
    blue = Material((0.2, 0.35, 0.8), reflect=0.25)

    bowl = difference(
        Box((1.1, 0.6, 0.0), (3.1, 2.6, 2.0)), Sphere((2.1, 0.6, 1.2), 0.8), Cylinder(1, (2.1, 0.0, 1.0), 4.0, 0.35)
    )
    drilled = difference(
        intersection(Box((-3.1, -2.1, 0.0), (-1.5, -0.5, 1.6)), Sphere((-2.3, -1.3, 0.8), 1.05)),
        Cylinder(0, (-4.0, -1.3, 0.8), 4.0, 0.45),
        Cylinder(1, (-2.3, -4.0, 0.8), 6.0, 0.45),
        Cylinder(2, (-2.3, -1.3, -1.0), 4.0, 0.45),
    )
    ring = difference(Cylinder(1, (-0.2, 3.4, 1.3), 0.6, 1.3), Cylinder(1, (-0.2, 3.0, 1.3), 1.5, 0.9))
    lens = intersection(Sphere((2.1, -3.3, 0.9), 1.4), Sphere((2.1, -1.1, 0.9), 1.4))
    parts = (
        (floor, Below(0.0)),
        (mirror, Sphere((-1.7, 1.6, 1.3), 1.3)),
        (glass, Sphere((0.5, -1.0, 1.0), 1.0)),
        (glass, lens),
        (mirror, bowl),
        (red, drilled),
        (blue, ring),
    )
    lights = (((5.0, -7.0, 9.0), 0.5), ((-7.0, -5.0, 7.0), 0.35), ((1.0, 3.0, 10.0), 0.3))
    camera = Camera((0.8, -9.2, 3.6), (0.0, 0.2, 0.9), 42.0)
    return Scene("whitted", camera, lights, parts, max_bounces=8)


SCENES: dict[str, Callable[[], Scene]] = {
    "classic": classic,
    "plate": plate,
    "menger-3": lambda: menger(3),
    "menger-4": lambda: menger(4),
    "swiss-100": lambda: swiss(100),
    "swiss-1000": lambda: swiss(1_000),
    "swiss-10000": lambda: swiss(10_000),
    "swiss-100000": lambda: swiss(100_000),
    "grid-100": lambda: grid(100),
    "grid-1000": lambda: grid(1_000),
    "grid-10000": lambda: grid(10_000),
    "grid-100000": lambda: grid(100_000),
    "whitted": whitted,
}

QUICK = ("classic", "plate", "menger-3", "swiss-100", "swiss-1000", "grid-100", "grid-1000", "whitted")
