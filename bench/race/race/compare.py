"""Are the pictures the same? Masks, distances, normals, colours, pixel by pixel."""

from __future__ import annotations

from dataclasses import asdict, dataclass
from pathlib import Path

import numpy as np
from PIL import Image

from .scenes import HEIGHT, WIDTH, Scene, unit

PIXELS = WIDTH * HEIGHT


@dataclass(frozen=True)
class Difference:
    """Shares of the picture's pixels: something in one picture and nothing in the other; else distances, or normals, or
    colours, that differ by more than the tolerance. None where a program does not tell."""

    mask: float
    distance: float | None = None
    normal: float | None = None
    color: float | None = None
    tolerance: str = ""

    def as_dict(self) -> dict:
        return asdict(self)


@dataclass(frozen=True)
class Tolerance:
    """Of distances, relative; of normals, the length of their difference."""

    distance: float
    normal: float | None

    def words(self) -> str:
        normal = "" if self.normal is None else f", normals {self.normal:g}"
        return f"distances {self.distance:g} of themselves{normal}"


# A mesh's chords are off by 1e-3 of a radius, and seen from the side by more; its facets by half of 5 degrees, both ways.
MESH = Tolerance(5e-3, 0.09)
COARSE_MESH = Tolerance(2e-2, 0.27)
# One step in depth is 1/1024 of the scene's depth in perspective.
VOXELS = Tolerance(1e-2, None)
# A step of 8 bits, a few times.
COLOR_STEPS = 4


def load(path: Path) -> np.ndarray:
    """Distance and normal of each pixel: (height, width, 4)."""
    return np.fromfile(path, np.float32).reshape(HEIGHT, WIDTH, 4)


def hits(ours: np.ndarray, theirs: np.ndarray, tolerance: Tolerance) -> Difference:
    here, there = np.isfinite(ours[..., 0]), np.isfinite(theirs[..., 0])
    both = here & there
    off = np.abs(ours[..., 0][both] - theirs[..., 0][both]) > tolerance.distance * ours[..., 0][both]
    normal = None
    if tolerance.normal is not None:
        apart = np.linalg.norm(ours[both][:, 1:] - theirs[both][:, 1:], axis=-1)
        normal = float((apart > tolerance.normal).sum() / PIXELS)
    return Difference(float((here != there).sum() / PIXELS), float(off.sum() / PIXELS), normal, None, tolerance.words())


def normals_of_picture(ours: np.ndarray, picture: Path, scene: Scene) -> Difference:
    """Against a picture that shows normals as `write.pov_normals` has it: red to the right, green up, blue to the viewer,
    as far as they are positive; 16 bits, linear."""
    theirs = linear(picture)
    right, up, ahead = (np.array(unit(v)) for v in scene.camera.frame())
    frame = np.stack([right, up, -ahead])
    expected = np.clip(ours[..., 1:] @ frame.T, 0.0, 1.0)
    here, there = np.isfinite(ours[..., 0]), theirs.max(axis=-1) > 0.0
    # What is seen from the side may be lit by none of the three.
    dark = expected.max(axis=-1) < 0.01
    both = here & there
    apart = np.abs(expected - theirs).max(axis=-1)
    tolerance = 0.01
    normal = float((apart[both] > tolerance).sum() / PIXELS)
    mask = float(((here != there) & ~(here & dark)).sum() / PIXELS)
    return Difference(mask, None, normal, None, f"normals {tolerance:g}")


def linear(picture: Path) -> np.ndarray:
    """Linear light of a PNG file of 8 bits, sRGB encoded."""
    encoded = np.asarray(Image.open(picture).convert("RGB"), np.float64) / 255.0
    return np.where(encoded <= 0.04045, encoded / 12.92, ((encoded + 0.055) / 1.055) ** 2.4)


def colors(ours: Path, theirs: Path) -> Difference:
    a, b = (np.asarray(Image.open(path).convert("RGB"), np.int32) for path in (ours, theirs))
    apart = np.abs(a - b).max(axis=-1)
    share = float((apart > COLOR_STEPS).sum() / PIXELS)
    return Difference(0.0, None, None, share, f"colours {COLOR_STEPS} of 255")
