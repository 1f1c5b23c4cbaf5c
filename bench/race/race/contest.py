"""One scene, all programs: made ready, compared, and timed by turns."""

from __future__ import annotations

import json
import multiprocessing
import subprocess
import time
from collections.abc import Callable
from dataclasses import dataclass, field
from pathlib import Path
from statistics import median

import numpy as np

from . import compare, povray, write
from .compare import Difference
from .runner import Runner, TooSlow, Took
from .scenes import HEIGHT, WIDTH, Scene

RAYS = WIDTH * HEIGHT


@dataclass
class Programs:
    """Where the programs are, and how long the race waits for any of them."""

    octrace: Path
    runners: Path
    embree: Path
    work: Path
    patience_s: float
    repeat: int
    rivals: set[str]


@dataclass
class Entry:
    """One program on one scene."""

    name: str
    # Seconds of each round; empty if it was not timed.
    frames: list[float] = field(default_factory=list)
    shadows: list[float] = field(default_factory=list)
    shadow_rays: int = 0
    first_picture_s: float | None = None
    ready_s: dict[str, float] = field(default_factory=dict)
    difference: Difference | None = None
    note: str = ""

    def as_dict(self) -> dict:
        frame = median(self.frames) if self.frames else None
        shadow = median(self.shadows) if self.shadows else None
        return {
            "program": self.name,
            "mrays_per_s": RAYS / frame / 1e6 if frame else None,
            "frame_s": spread(self.frames),
            "shadow_mrays_per_s": self.shadow_rays / shadow / 1e6 if shadow else None,
            "shadow_s": spread(self.shadows),
            "first_picture_s": self.first_picture_s,
            "ready_s": self.ready_s,
            "difference": self.difference.as_dict() if self.difference else None,
            "note": self.note,
        }


def spread(values: list[float]) -> dict | None:
    return {"median": median(values), "min": min(values), "max": max(values)} if values else None


@dataclass
class Turn:
    """What a program does in each round."""

    entry: Entry
    frame: Callable[[], Took]
    shadow: Callable[[], Took] | None = None


def run(scene: Scene, programs: Programs) -> dict:
    """Everything there is to say about the scene."""
    folder = programs.work / scene.name
    folder.mkdir(parents=True, exist_ok=True)
    oct_file = folder / "scene.oct"
    oct_file.write_text(write.oct(scene))

    runners: list[Runner] = []
    turns: list[Turn] = []
    entries: list[Entry] = []
    try:
        ours = Entry("octrace")
        runner = start(ours, [programs.runners / "race-octrace", oct_file], programs, runners)
        turns.append(turn_of(ours, runner))
        entries.append(ours)
        reference = hits_of(runner, folder)
        for name, enter in RIVALS.items():
            if name not in programs.rivals:
                continue
            entry = Entry(name)
            entries.append(entry)
            try:
                enter(scene, folder, reference, entry, programs, runners, turns)
            except TooSlow as slow:
                entry.note = str(slow)
        rounds(turns, programs)
        frames = whole_frames(scene, folder, programs) if "POV-Ray" in programs.rivals else None
    finally:
        for runner in runners:
            runner.close()
    return {
        "scene": scene.name,
        "primitives": scene.primitives,
        "programs": [entry.as_dict() for entry in entries],
        "whole_frame": frames,
    }


def start(entry: Entry, command: list, programs: Programs, runners: list[Runner]) -> Runner:
    runner = Runner(entry.name, command, programs.patience_s)
    runners.append(runner)
    entry.ready_s["read and build"] = runner.ready.cpu_s
    first = runner.ask("frame")
    entry.first_picture_s = runner.ready.cpu_s + first.cpu_s
    return runner


def turn_of(entry: Entry, runner: Runner) -> Turn:
    return Turn(entry, lambda: runner.ask("frame"), lambda: runner.ask("shadow"))


def hits_of(runner: Runner, folder: Path) -> np.ndarray:
    path = folder / f"{runner.name}.hits"
    runner.ask(f"dump {path}")
    return compare.load(path)


def rounds(turns: list[Turn], programs: Programs) -> None:
    """All by turns, there and back, so that what the machine does besides meets all alike. What takes long is timed once."""
    slow = programs.patience_s / programs.repeat
    left = list(turns)
    for number in range(programs.repeat):
        for turn in left[:] if number % 2 == 0 else left[::-1]:
            try:
                take(turn)
            except TooSlow as reason:
                turn.entry.note = str(reason)
                left.remove(turn)
        left = [turn for turn in left if max(turn.entry.frames, default=0.0) <= slow]


def take(turn: Turn) -> None:
    turn.entry.frames.append(turn.frame().cpu_s)
    if turn.shadow:
        took = turn.shadow()
        turn.entry.shadows.append(took.cpu_s)
        turn.entry.shadow_rays = took.rays or 0


# ---- the rivals


def enter_embree(scene, folder, reference, entry, programs, runners, turns) -> None:
    meshing = mesh_of(scene, folder / "mesh", programs.patience_s)
    runner = start(entry, [programs.embree, folder / "mesh"], programs, runners)
    entry.ready_s["mesh"] = meshing
    entry.first_picture_s += meshing
    tolerance = compare.MESH if scene.segments >= 72 else compare.COARSE_MESH
    entry.difference = compare.hits(reference, hits_of(runner, folder), tolerance)
    entry.note = f"{scene.segments} facets around"
    turns.append(turn_of(entry, runner))


def mesh_of(scene: Scene, folder: Path, patience_s: float) -> float:
    """Writes the mesh and says how many seconds of processor time it took; kept from one race to the next."""
    record = folder / "seconds.json"
    if not record.exists():
        worker = multiprocessing.get_context("fork").Process(target=make_mesh, args=(scene, folder))
        worker.start()
        worker.join(patience_s)
        if worker.is_alive():
            worker.kill()
            worker.join()
            raise TooSlow(f"Manifold takes more than {patience_s:.0f} s")
        if worker.exitcode != 0:
            raise RuntimeError("Manifold made no mesh")
    return json.loads(record.read_text())


def make_mesh(scene: Scene, folder: Path) -> None:
    from . import mesh

    started = time.process_time()
    arrays = mesh.mesh(scene)
    seconds = time.process_time() - started
    mesh.write(folder, scene, *arrays)
    (folder / "seconds.json").write_text(json.dumps(seconds))


def enter_embreex(scene, folder, reference, entry, programs, runners, turns) -> None:
    if (folder / "mesh" / "offsets.f32").exists() and (folder / "mesh" / "offsets.f32").stat().st_size > 0:
        entry.note = "it has no instances"
        return
    mesh_of(scene, folder / "mesh", programs.patience_s)
    from . import python_embree

    tracer = python_embree.Tracer(scene, folder / "mesh")
    entry.difference = compare.hits(
        reference, tracer.hits(), compare.MESH if scene.segments >= 72 else compare.COARSE_MESH
    )
    entry.note = "one call for all rays, made beforehand"
    turns.append(Turn(entry, tracer.frame))


def enter_fidget(scene, folder, reference, entry, programs, runners, turns) -> None:
    depths = distances_ahead(reference, scene)
    listing = folder / "scene.txt"
    listing.write_text(write.fidget(scene, 0.99 * depths[0], 1.01 * depths[1]))
    runner = start(entry, [programs.runners / "race-fidget", listing], programs, runners)
    entry.difference = compare.hits(reference, hits_of(runner, folder), compare.VOXELS)
    entry.note = "f32, 1024 voxels deep"
    turns.append(Turn(entry, lambda: runner.ask("frame")))


def distances_ahead(reference: np.ndarray, scene: Scene) -> tuple[float, float]:
    """The nearest that is seen, and the farthest but for a thousandth of the pixels (a floor has no end)."""
    right, up, ahead = (np.array(v) for v in scene.camera.frame())
    x = (np.arange(WIDTH) + 0.5) / WIDTH * 2.0 - 1.0
    y = 1.0 - (np.arange(HEIGHT) + 0.5) / HEIGHT * 2.0
    length = np.linalg.norm(ahead + x[None, :, None] * right + y[:, None, None] * up, axis=-1)
    depths = (reference[..., 0] / length)[np.isfinite(reference[..., 0])]
    return float(depths.min()), float(np.quantile(depths, 0.999))


def enter_povray(scene, folder, reference, entry, programs, runners, turns) -> None:
    enter_pov_text(scene, folder / "scene.pov", write.pov(scene), reference, entry, programs, turns)


def enter_povray_cells(scene, folder, reference, entry, programs, runners, turns) -> None:
    text = write.pov_cells(scene)
    if text is None:
        entry.note = "nothing to cut"
        return
    enter_pov_text(scene, folder / "cells.pov", text, reference, entry, programs, turns)


def enter_pov_text(scene, path, text, reference, entry, programs, turns) -> None:
    path.write_text(text)
    picture, normals = path.with_suffix(".png"), path.with_suffix(".normals.pov")

    def frame() -> Took:
        return povray.draw(path, picture, povray.CAMERA_ONLY, programs.patience_s)[0]

    _, whole = povray.draw(path, picture, povray.CAMERA_ONLY, programs.patience_s)
    entry.first_picture_s = whole.cpu_s
    normals.write_text(write.pov_normals(scene, text))
    shown = normals.with_suffix(".png")
    povray.draw(normals, shown, povray.CAMERA_ONLY, programs.patience_s)
    entry.difference = compare.normals_of_picture(reference, shown, scene)
    turns.append(Turn(entry, frame))


RIVALS = {
    "Embree": enter_embree,
    "embreex": enter_embreex,
    "POV-Ray": enter_povray,
    "POV-Ray, cells": enter_povray_cells,
    "fidget": enter_fidget,
}


# ---- frames with everything: all lights, shadows, mirrors, glass


def whole_frames(scene: Scene, folder: Path, programs: Programs) -> dict | None:
    """octrace's and POV-Ray's, by turns; None if POV-Ray takes too long."""
    ours, theirs = folder / "whole-octrace.png", folder / "whole-povray.png"
    pov_file = folder / "scene.pov"
    if not pov_file.exists():
        pov_file.write_text(write.pov(scene))
    times: dict[str, list[float]] = {"octrace": [], "POV-Ray": []}
    rays = {}
    for _ in range(min(programs.repeat, 3)):
        words = [programs.octrace, "render", folder / "scene.oct", "-o", ours, "--threads", "1", "--samples", "1"]
        words += ["--max-bounces", str(scene.max_bounces), "--stats", "json", "--quiet"]
        done = subprocess.run([str(word) for word in words], capture_output=True, text=True, check=True)
        stats = json.loads(done.stdout)
        times["octrace"].append(stats["seconds"]["render"])
        rays = stats["rays"]
        try:
            took, _ = povray.draw(pov_file, theirs, povray.EVERYTHING, programs.patience_s)
        except TooSlow:
            return None
        times["POV-Ray"].append(took.cpu_s)
        if took.cpu_s > programs.patience_s / programs.repeat:
            break
    return {
        "octrace_s": spread(times["octrace"]),
        "povray_s": spread(times["POV-Ray"]),
        "ratio": median(times["POV-Ray"]) / median(times["octrace"]),
        "octrace_rays": rays,
        "difference": compare.colors(ours, theirs).as_dict(),
    }
