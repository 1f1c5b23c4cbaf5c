"""POV-Ray: a process for each picture; it reports its processor time itself."""

from __future__ import annotations

import re
import subprocess
from pathlib import Path

from .runner import TooSlow, Took
from .scenes import HEIGHT, WIDTH

# Camera rays with diffuse and ambient light: no shadows, no reflections.
CAMERA_ONLY = "+Q3"
EVERYTHING = "+Q9"


def draw(scene: Path, picture: Path, quality: str, patience_s: float, *options: str) -> tuple[Took, Took]:
    """Draws, and says what tracing took, and all of it. One thread, no anti-aliasing, no display."""
    words = ["povray", f"+I{scene}", f"+O{picture}", f"+W{WIDTH}", f"+H{HEIGHT}", quality, *options]
    words += ["-D", "-A", "+WT1", "-P", "-V"]
    try:
        done = subprocess.run(words, capture_output=True, text=True, timeout=patience_s)
    except subprocess.TimeoutExpired:
        raise TooSlow(f"takes more than {patience_s:.0f} s") from None
    if done.returncode != 0:
        raise RuntimeError(done.stderr[-2000:])
    spent = {stage: Took(cpu, wall) for stage, wall, cpu in times(done.stderr)}
    trace, parse = spent["Trace"], spent.get("Parse", Took(0.0, 0.0))
    bounding = spent.get("Bounding", Took(0.0, 0.0))
    stages = (parse, bounding, trace)
    return trace, Took(sum(s.cpu_s for s in stages), sum(s.wall_s for s in stages))


def times(text: str) -> list[tuple[str, float, float]]:
    """Stage, seconds that went by, seconds of processor time."""
    pattern = r"(Parse|Bounding|Trace) Time:.*?\(([\d.]+) seconds\)(?:\s*using \d+ thread\(s\) with ([\d.]+) CPU-seconds)?"
    found = re.findall(pattern, text, re.DOTALL)
    return [(stage, float(wall), float(cpu or wall)) for stage, wall, cpu in found]


def version() -> str:
    done = subprocess.run(["povray", "--version"], capture_output=True, text=True)
    found = re.search(r"POV-Ray \d+(\.\d+)+", done.stdout + done.stderr)
    return found[0] if found else "POV-Ray"
