"""What Embree traces: a mesh made by Manifold, and how often it is placed."""

from __future__ import annotations

from pathlib import Path

import manifold3d
import numpy as np

from .scenes import Scene
from .solids import Below, Box, Combined, Copy, Cylinder, Node, Sphere, bounds

OPERATIONS = {
    "union": manifold3d.OpType.Add,
    "intersection": manifold3d.OpType.Intersect,
    "difference": manifold3d.OpType.Subtract,
}


def manifold(node: Node, segments: int) -> manifold3d.Manifold:
    """The node with `segments` facets around everything round: with 72, chords are off by a thousandth of the radius."""
    match node:
        case Sphere(center, radius):
            return manifold3d.Manifold.sphere(radius, segments).translate(center)
        case Box() | Below():
            low, high = bounds(node)
            return manifold3d.Manifold.cube([b - a for a, b in zip(low, high)]).translate(low)
        case Cylinder(axis, low, length, radius):
            turn = ((0.0, 90.0, 0.0), (-90.0, 0.0, 0.0), (0.0, 0.0, 0.0))[axis]
            upright = manifold3d.Manifold.cylinder(length, radius, radius, segments)
            return upright.rotate(turn).translate(low)
        case Combined(op, children):
            solids = [manifold(child, segments) for child in children]
            return manifold3d.Manifold.batch_boolean(solids, OPERATIONS[op])
        case Copy(child, offset):
            return manifold(child, segments).translate(offset)


def mesh(scene: Scene) -> tuple[np.ndarray, np.ndarray, np.ndarray]:
    """Points, triangles, and where the mesh is placed if that is more than one place."""
    offsets: list[tuple[float, ...]] = []
    nodes = []
    for _, node in scene.parts:
        # Many copies of one thing are instances of one mesh.
        if isinstance(node, Combined) and node.op == "union" and all(isinstance(c, Copy) for c in node.children):
            offsets = [copy.offset for copy in node.children]
            node = node.children[0].node
        nodes.append(node)
    points, triangles, count = [], [], 0
    for node in nodes:
        part = manifold(node, scene.segments).to_mesh()
        points.append(np.asarray(part.vert_properties, np.float32)[:, :3])
        triangles.append(np.asarray(part.tri_verts, np.uint32) + count)
        count += len(points[-1])
    placed = np.asarray(offsets, np.float32).reshape(-1, 3)
    return np.ascontiguousarray(np.concatenate(points)), np.ascontiguousarray(np.concatenate(triangles)), placed


def write(folder: Path, scene: Scene, points: np.ndarray, triangles: np.ndarray, offsets: np.ndarray) -> None:
    """The files that `embree/trace.cpp` reads."""
    folder.mkdir(parents=True, exist_ok=True)
    points.tofile(folder / "points.f32")
    triangles.tofile(folder / "triangles.u32")
    offsets.tofile(folder / "offsets.f32")
    from .scenes import HEIGHT, WIDTH

    vectors = (scene.camera.eye, *scene.camera.frame(), scene.lights[0][0])
    lines = [f"{WIDTH} {HEIGHT}"] + [" ".join(repr(c) for c in v) for v in vectors]
    (folder / "view.txt").write_text("\n".join(lines) + "\n")
