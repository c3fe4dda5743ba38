"""Where is the model looked at from? Orthographic cameras for the sides and corners.

Frames. World: the frame of the file, metres. Camera: `right`, `up`, `backward` (from the model to the viewer),
right-handed.
Image: continuous (column, row), column to the right, row downwards, (0, 0) at the outer corner of the first pixel, so
that pixel [row, column] of an array has its centre at (column + 0.5, row + 0.5). Depth: metres from the near plane,
along the viewing direction (against `backward`).
"""

from __future__ import annotations

from dataclasses import dataclass
from itertools import product

import numpy as np
from numpy.typing import ArrayLike, NDArray

from querycad_contracts import Side, Vector

OFF_AXIS_DEG = 1.0
"""Turn of each side camera about its own up direction, towards the right of its image (QueryCAD paper, SegCAD's views):
walls along the viewing direction then own pixels instead of falling exactly on edges."""

MARGIN = 0.02
"""Share of the image left free on each side: the silhouette needs background around it, more would waste pixels."""

_UP: dict[Side, Vector] = {
    Side.TOP: (0.0, 1.0, 0.0),
    Side.BOTTOM: (0.0, -1.0, 0.0),
    Side.LEFT: (0.0, 0.0, 1.0),
    Side.RIGHT: (0.0, 0.0, 1.0),
    Side.FRONT: (0.0, 0.0, 1.0),
    Side.BACK: (0.0, 0.0, 1.0),
}


@dataclass(frozen=True, slots=True)
class Camera:
    """An orthographic camera with square pixels."""

    name: str
    """The side or corner that it looks from, such as 'top' or 'top front right'."""
    width: int
    height: int
    eye_m: Vector
    """The point of the near plane at the middle of the image; nothing of the model is nearer."""
    right: Vector
    up: Vector
    backward: Vector
    pixel_m: float
    """Edge of a pixel in the world."""
    range_m: float
    """Distance from the near to the far plane; nothing of the model is farther."""

    @property
    def axes(self) -> NDArray[np.float64]:
        """Which rotation takes world to camera directions? (3, 3) float64, rows right, up, backward."""
        return np.array([self.right, self.up, self.backward])

    def to_pixels(self, points_m: ArrayLike) -> NDArray[np.float64]:
        """Where do world points appear? (N, 3) metres in, (N, 3) float64 out: column, row (pixels), depth (metres)."""
        local = (np.asarray(points_m, dtype=np.float64).reshape(-1, 3) - np.array(self.eye_m)) @ self.axes.T
        return np.stack(
            [self.width / 2 + local[:, 0] / self.pixel_m, self.height / 2 - local[:, 1] / self.pixel_m, -local[:, 2]],
            axis=1,
        )

    def to_world(self, pixels: ArrayLike) -> NDArray[np.float64]:
        """Which world points appear there? The inverse of `to_pixels`: (N, 3) column, row, depth in, metres out."""
        given = np.asarray(pixels, dtype=np.float64).reshape(-1, 3)
        local = np.stack(
            [
                (given[:, 0] - self.width / 2) * self.pixel_m,
                (self.height / 2 - given[:, 1]) * self.pixel_m,
                -given[:, 2],
            ],
            axis=1,
        )
        return np.array(self.eye_m) + local @ self.axes


def off_axis(side: Side, degrees: float = OFF_AXIS_DEG) -> tuple[Vector, Vector, Vector]:
    """Which way do right, up and backward of a side's camera point? Unit vectors; turned about `up` by `degrees`."""
    outward, up = np.array(side.outward), np.array(_UP[side])
    right, angle = np.cross(up, outward), np.radians(degrees)
    return (
        _vector(right * np.cos(angle) - outward * np.sin(angle)),
        _UP[side],
        _vector(outward * np.cos(angle) + right * np.sin(angle)),
    )


def side_camera(
    side: Side,
    bounds_m: ArrayLike,
    width: int,
    height: int,
    margin: float = MARGIN,
    focus_m: ArrayLike | None = None,
    off_axis_deg: float = OFF_AXIS_DEG,
) -> Camera:
    """Which camera looks at the model from this side?

    Seen from the front x points right and z up; from the back -x right; from the right y right; from the left -y
    right; from the top x right and y up; from the bottom x right and -y up. `bounds_m`: (2, 3), lower and upper corner
    of the model; all of it lies in the depth range. `focus_m`: (N, 3) points to fill the image with; the box's corners
    when None.
    """
    return _fit(side.value, off_axis(side, off_axis_deg), box_corners(bounds_m), focus_m, (width, height), margin)


def side_cameras(bounds_m: ArrayLike, width: int, height: int, margin: float = MARGIN) -> tuple[Camera, ...]:
    """Which six cameras see the whole model from its sides? In the order of `Side`."""
    return tuple(side_camera(side, bounds_m, width, height, margin) for side in Side)


ISOMETRIC_DEG = float(np.degrees(np.arctan(1 / np.sqrt(2))))
"""Elevation from which the three axes are equally short (ISO 5456-3): 35.3 degrees."""

CORNERS: tuple[tuple[int, int, int], ...] = tuple(
    (x, y, z)
    for z, y, x in product((1, -1), (-1, 1), (1, -1))  # top before bottom, front before back, right before left
)
"""Signs of x, y, z of the eight directions that corner cameras look from; the usual isometric view comes first."""


def corner_camera(
    corner: tuple[int, int, int],
    bounds_m: ArrayLike,
    width: int,
    height: int,
    margin: float = MARGIN,
    focus_m: ArrayLike | None = None,
    elevation_deg: float = ISOMETRIC_DEG,
) -> Camera:
    """Which camera looks at the model from this corner, z upwards, x and y alike? Parameters as for `side_camera`."""
    level, rise = np.cos(np.radians(elevation_deg)) / np.sqrt(2.0), np.sin(np.radians(elevation_deg))
    backward = np.array(corner, dtype=np.float64) * (level, level, rise)
    right = np.cross((0.0, 0.0, 1.0), backward)
    right /= np.linalg.norm(right)
    axes = (_vector(right), _vector(np.cross(backward, right)), _vector(backward))
    x, y, z = corner
    name = f"{'top' if z > 0 else 'bottom'} {'back' if y > 0 else 'front'} {'right' if x > 0 else 'left'}"
    return _fit(name, axes, box_corners(bounds_m), focus_m, (width, height), margin)


def isometric_camera(bounds_m: ArrayLike, width: int, height: int, margin: float = MARGIN) -> Camera:
    """Which camera gives the usual overview, from the top front right corner?"""
    return corner_camera(CORNERS[0], bounds_m, width, height, margin)


def _fit(
    name: str,
    axes: tuple[Vector, Vector, Vector],
    inside: NDArray[np.float64],
    focus_m: ArrayLike | None,
    size: tuple[int, int],
    margin: float,
) -> Camera:
    """The camera whose image `focus_m` fills up to the margin and whose depth range holds `inside`."""
    width, height = size
    if width < 1 or height < 1 or not 0.0 <= margin < 0.5:
        raise ValueError(f"an image of {width} x {height} pixels with a margin of {margin} cannot be")
    frame = np.array(axes)
    whole = inside @ frame.T
    seen = whole if focus_m is None else np.asarray(focus_m, dtype=np.float64).reshape(-1, 3) @ frame.T
    low, high = seen.min(axis=0), seen.max(axis=0)
    extent = float(np.ptp(whole, axis=0).max()) or 1.0  # a single point gets a view of one metre
    spans = (high - low)[:2]
    fill = 1.0 - 2.0 * margin
    pixel = max(spans[0] / (width * fill), spans[1] / (height * fill), 1e-6 * extent / max(width, height))
    near, far = whole[:, 2].max() + 0.01 * extent, whole[:, 2].min() - 0.01 * extent
    eye = np.array([(low[0] + high[0]) / 2, (low[1] + high[1]) / 2, near]) @ frame
    return Camera(name, width, height, _vector(eye), *axes, pixel_m=float(pixel), range_m=float(near - far))


def box_corners(bounds_m: ArrayLike) -> NDArray[np.float64]:
    """Which eight corners has the box? (2, 3) lower and upper corner in, (8, 3) float64 out."""
    low_high = np.asarray(bounds_m, dtype=np.float64)
    if low_high.shape != (2, 3):
        raise ValueError(f"bounds_m must be (2, 3), not {low_high.shape}")
    return np.array([[low_high[i, 0], low_high[j, 1], low_high[k, 2]] for i, j, k in product((0, 1), repeat=3)])


def _vector(array: NDArray[np.float64]) -> Vector:
    x, y, z = (float(component) for component in array)
    return (x, y, z)
