"""Embree through embreex, as one uses it from Python: all rays in one call, which traces them one by one."""

from __future__ import annotations

import time
from pathlib import Path

import numpy as np
from embreex import rtcore_scene
from embreex.mesh_construction import TriangleMesh

from .runner import Took
from .scenes import HEIGHT, WIDTH, Scene


class Tracer:
    def __init__(self, scene: Scene, folder: Path):
        points = np.fromfile(folder / "points.f32", np.float32).reshape(-1, 3)
        triangles = np.fromfile(folder / "triangles.u32", np.uint32).reshape(-1, 3)
        self.corners = points[triangles]
        self.scene = rtcore_scene.EmbreeScene()
        self.mesh = TriangleMesh(self.scene, points, triangles.astype(np.int32))
        right, up, ahead = (np.array(v) for v in scene.camera.frame())
        x = (np.arange(WIDTH) + 0.5) / WIDTH * 2.0 - 1.0
        y = 1.0 - (np.arange(HEIGHT) + 0.5) / HEIGHT * 2.0
        directions = ahead + x[None, :, None] * right + y[:, None, None] * up
        directions /= np.linalg.norm(directions, axis=-1, keepdims=True)
        self.directions = directions.reshape(-1, 3).astype(np.float32)
        self.origins = np.broadcast_to(np.array(scene.camera.eye, np.float32), self.directions.shape).copy()
        self.trace()

    def trace(self) -> dict:
        return self.scene.run(self.origins, self.directions, query="INTERSECT", output=True)

    def frame(self) -> Took:
        cpu, wall = time.process_time(), time.perf_counter()
        self.trace()
        return Took(time.process_time() - cpu, time.perf_counter() - wall)

    def hits(self) -> np.ndarray:
        found = self.trace()
        missed = found["primID"] < 0
        a, b, c = (self.corners[np.where(missed, 0, found["primID"]), k] for k in range(3))
        normals = np.cross(b - a, c - a)
        normals /= np.maximum(np.linalg.norm(normals, axis=-1, keepdims=True), 1e-30)
        rows = np.concatenate([found["tfar"][:, None], normals], axis=1).astype(np.float32)
        rows[missed] = (np.inf, 0.0, 0.0, 0.0)
        return rows.reshape(HEIGHT, WIDTH, 4)
