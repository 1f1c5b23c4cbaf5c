"""CSG trees, as every program of the race is told them."""

from __future__ import annotations

from dataclasses import dataclass

Vec = tuple[float, float, float]


@dataclass(frozen=True)
class Sphere:
    center: Vec
    radius: float


@dataclass(frozen=True)
class Box:
    low: Vec
    high: Vec


@dataclass(frozen=True)
class Cylinder:
    """Along the axis of this number, from `low` to `low` plus `length` on that axis."""

    axis: int
    low: Vec
    length: float
    radius: float

    @property
    def high(self) -> Vec:
        return tuple(c + (self.length if k == self.axis else 0.0) for k, c in enumerate(self.low))


@dataclass(frozen=True)
class Below:
    """The half-space z <= height."""

    height: float


@dataclass(frozen=True)
class Combined:
    """`op` is union, intersection, or difference: the first child and no other."""

    op: str
    children: tuple[Node, ...]


@dataclass(frozen=True)
class Copy:
    """The node, moved."""

    node: Node
    offset: Vec


Node = Sphere | Box | Cylinder | Below | Combined | Copy

# What programs without half-spaces get instead: a block this wide to every side, and this thick.
FLOOR_HALF_WIDTH = 5000.0
FLOOR_THICKNESS = 0.2


def union(*children: Node) -> Combined:
    return Combined("union", children)


def intersection(*children: Node) -> Combined:
    return Combined("intersection", children)


def difference(*children: Node) -> Combined:
    return Combined("difference", children)


def bar(axis: int, middle: Vec, half_length: float, radius: float) -> Cylinder:
    """A cylinder about the point in its middle."""
    low = tuple(c - (half_length if k == axis else 0.0) for k, c in enumerate(middle))
    return Cylinder(axis, low, 2.0 * half_length, radius)


def moved(node: Node, by: Vec) -> Node:
    """The node with all copies and moves written out."""

    def shift(p: Vec) -> Vec:
        return tuple(a + b for a, b in zip(p, by))

    match node:
        case Sphere(center, radius):
            return Sphere(shift(center), radius)
        case Box(low, high):
            return Box(shift(low), shift(high))
        case Cylinder(axis, low, length, radius):
            return Cylinder(axis, shift(low), length, radius)
        case Below(height):
            return Below(height + by[2])
        case Combined(op, children):
            return Combined(op, tuple(moved(child, by) for child in children))
        case Copy(child, offset):
            return moved(child, shift(offset))


def primitives(node: Node) -> int:
    match node:
        case Combined(_, children):
            return sum(map(primitives, children))
        case Copy(child, _):
            return primitives(child)
        case _:
            return 1


def bounds(node: Node) -> tuple[Vec, Vec]:
    """A box around the node."""
    match node:
        case Sphere(center, radius):
            return tuple(c - radius for c in center), tuple(c + radius for c in center)
        case Box(low, high):
            return low, high
        case Cylinder(axis, low, _, radius):
            out = [0.0 if k == axis else radius for k in range(3)]
            return (
                tuple(c - r for c, r in zip(low, out)),
                tuple(c + r for c, r in zip(node.high, out)),
            )
        case Below(height):
            wide = FLOOR_HALF_WIDTH
            return (-wide, -wide, height - FLOOR_THICKNESS), (wide, wide, height)
        case Copy(child, offset):
            low, high = bounds(child)
            return tuple(a + b for a, b in zip(low, offset)), tuple(a + b for a, b in zip(high, offset))
        case Combined("difference", children):
            return bounds(children[0])
        case Combined(op, children):
            lows, highs = zip(*map(bounds, children))
            outer, inner = (min, max) if op == "union" else (max, min)
            return tuple(map(outer, zip(*lows))), tuple(map(inner, zip(*highs)))
