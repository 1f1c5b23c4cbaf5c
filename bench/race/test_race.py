"""What the race can be trusted in without running it: `python3 -m unittest` in this folder. Needs no packages."""

import random
import unittest
from pathlib import Path

from race import digest, write
from race.scenes import SCENES, rounded_cube, swiss
from race.solids import Below, Box, Combined, Copy, Cylinder, Sphere, bounds, moved


def holds(node, p) -> bool:
    """Whether the point is in the solid."""
    match node:
        case Sphere(center, radius):
            return sum((a - b) ** 2 for a, b in zip(p, center)) < radius**2
        case Box(low, high):
            return all(a < c < b for a, c, b in zip(low, p, high))
        case Cylinder(axis, low, _, radius):
            across = sum((p[k] - low[k]) ** 2 for k in range(3) if k != axis)
            return across < radius**2 and low[axis] < p[axis] < node.high[axis]
        case Below(height):
            return p[2] < height
        case Copy():
            return holds(moved(node, (0.0, 0.0, 0.0)), p)
        case Combined("union", children):
            return any(holds(child, p) for child in children)
        case Combined("intersection", children):
            return all(holds(child, p) for child in children)
        case Combined("difference", (first, *others)):
            return holds(first, p) and not any(holds(other, p) for other in others)


class Race(unittest.TestCase):
    def test_digests_are_those_of_the_scenes(self):
        lines = (Path(__file__).parent / "digests.txt").read_text().splitlines()
        for name, expected in (line.split() for line in lines):
            if SCENES[name]().is_quick:
                self.assertEqual(digest.digest(SCENES[name]()), expected, name)

    def test_cells_make_the_same_solid(self):
        solid = swiss(100).parts[0][1]
        cells = write.cells(solid)
        self.assertGreater(len(cells), 100)
        rng = random.Random(1)
        for _ in range(1000):
            point = tuple(rng.uniform(-1.05, 1.05) for _ in range(3))
            self.assertEqual(any(holds(cell, point) for cell in cells), holds(solid, point), point)

    def test_nothing_is_outside_of_its_bounds(self):
        solid = Copy(rounded_cube(), (1.0, 2.0, 3.0))
        low, high = bounds(solid)
        rng = random.Random(2)
        for _ in range(1000):
            point = tuple(rng.uniform(-2.0, 5.0) for _ in range(3))
            inside = all(a <= c <= b for a, c, b in zip(low, point, high))
            self.assertTrue(inside or not holds(solid, point))

    def test_every_scene_can_be_written(self):
        for name in ("classic", "plate", "menger-3", "grid-100", "whitted"):
            scene = SCENES[name]()
            for text in (write.oct(scene), write.pov(scene), write.pov_normals(scene, write.pov(scene))):
                self.assertEqual(text.count("{"), text.count("}"), name)
            self.assertEqual(write.pov_cells(scene) is not None, name == "menger-3")


if __name__ == "__main__":
    unittest.main()
