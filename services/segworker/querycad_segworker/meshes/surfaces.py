"""Which plane, cylinder, cone, sphere or torus goes through these points? Least squares; lengths in metres."""

from __future__ import annotations

import math
from collections.abc import Callable
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from querycad_contracts import SurfaceKind

Array = NDArray[np.float64]

STEPS = 25
"""Of Gauss and Newton: from a start near the surface they end within ten."""
SLOW = 0.8
"""A step that leaves more of the squares than this: it has arrived, or the points are on no such surface."""
MOST_POINTS = 600
"""Looked at in a fit: more make it no better, as the vertices of a mesh lie on the surface that it was made from."""
LEAST_TAPER_RAD = math.radians(0.5)
"""A cone with less is a cylinder, with more than a right angle less this a plane."""
_FREE = {
    SurfaceKind.CYLINDER: [0, 1, 2, 3, 5],
    SurfaceKind.CONE: [0, 1, 2, 3, 4, 6],
}
"""What may change: the axis turns 0 and 1, the origin moves 2, 3 and along the axis 4, the radius 5, the angle 6."""


@dataclass(frozen=True, slots=True, eq=False)
class Fitted:
    """A surface; `origin`, `axis`, the radii and `half_angle` as in `topology.FaceRecord`, as arrays of 3."""

    kind: SurfaceKind
    origin: Array
    axis: Array
    radius: float = 0.0
    minor_radius: float = 0.0
    half_angle: float = 0.0

    def off(self, points: Array) -> Array:
        """How far from the surface is each of (N, 3) points, away from axis, centre or tube, or along the normal?"""
        to = points - self.origin
        off: Array
        along = to @ self.axis
        if self.kind is SurfaceKind.PLANE:
            return along
        if self.kind is SurfaceKind.SPHERE:
            off = np.linalg.norm(to, axis=1) - self.radius
            return off
        radial = np.linalg.norm(to - along[:, None] * self.axis, axis=1)
        if self.kind is SurfaceKind.CYLINDER:
            off = radial - self.radius
        elif self.kind is SurfaceKind.CONE:
            off = radial * math.cos(self.half_angle) - along * math.sin(self.half_angle)
        else:
            off = np.hypot(radial - self.radius, along) - self.minor_radius
        return off

    def directions(self, points: Array) -> Array:
        """Which way does `off` grow there? (N, 3) unit vectors."""
        to = points - self.origin
        if self.kind is SurfaceKind.PLANE:
            return np.broadcast_to(self.axis, points.shape)
        if self.kind is SurfaceKind.SPHERE:
            return _units(to)
        along = to @ self.axis
        radial = _units(to - along[:, None] * self.axis)
        if self.kind is SurfaceKind.CYLINDER:
            return radial
        if self.kind is SurfaceKind.CONE:
            return math.cos(self.half_angle) * radial - math.sin(self.half_angle) * self.axis
        return _units(to - self.radius * radial)


def fit_plane(points: Array, normal: Array) -> Fitted:
    """The plane through the points, its axis on the side of `normal`."""
    middle = points.mean(axis=0)
    values, vectors = np.linalg.eigh((points - middle).T @ (points - middle))
    axis = vectors[:, 0]
    if values[1] <= 1e-12 * values[2]:  # points in a line have many planes
        axis = normal
    return Fitted(SurfaceKind.PLANE, middle, axis if axis @ normal >= 0 else -axis)


def fit_cylinder(points: Array, normals: Array, weights: Array, near: float) -> Fitted | None:
    """Normals of a cylinder lie in a plane across its axis. Refined by steps only where points are not `near`."""
    axis = np.linalg.eigh((normals * weights[:, None]).T @ normals)[1][:, 0]
    start = _cylinder_along(points, axis)
    if start is None or np.abs(start.off(points)).max() <= near:
        return start
    return _refined(start, points, near)


def fit_cone(points: Array, normals: Array, centers: Array, weights: Array, near: float) -> Fitted | None:
    """Normals of a cone end on a circle about its axis; the planes of facets between two rulings meet in its apex."""
    spread = normals - weights @ normals / weights.sum()
    axis = np.linalg.eigh((spread * weights[:, None]).T @ spread)[1][:, 0]
    rows = normals * np.sqrt(weights)[:, None]
    apex = np.linalg.lstsq(rows, (rows * centers).sum(axis=1), rcond=1e-12)[0]
    to = points - apex
    if (to @ axis).mean() < 0:
        axis = -axis
    along = to @ axis
    radial = np.linalg.norm(to - along[:, None] * axis, axis=1)
    half = math.atan2(float(radial.mean()), float(along.mean()))
    start = Fitted(SurfaceKind.CONE, apex, axis, half_angle=half)
    if np.abs(start.off(points)).max() > near:
        refined = _refined(start, points, near)
        if refined is None:
            return None
        start = refined
    flat = LEAST_TAPER_RAD < start.half_angle < math.pi / 2 - LEAST_TAPER_RAD
    along = (points - start.origin) @ start.axis
    return start if flat and along.min() > -1e-3 * along.max() else None


def fit_sphere(points: Array) -> Fitted | None:
    """Algebraic: |p|^2 = 2 c . p + d is linear in the centre c."""
    middle = points.mean(axis=0)
    local = points - middle
    solution, _, rank, _ = np.linalg.lstsq(np.c_[2 * local, np.ones(len(local))], (local**2).sum(axis=1), rcond=1e-9)
    square = solution[3] + solution[:3] @ solution[:3]
    if rank < 4 or square <= 0:
        return None
    return Fitted(SurfaceKind.SPHERE, solution[:3] + middle, np.zeros(3), math.sqrt(square))


def fit_torus(points: Array, origins: Array, axes: Array, near: float) -> Fitted | None:
    """The torus about one of (A, 3) known axes, through `origins`, on which the points lie; None where there is none.

    Rounds of turned and drilled parts are about the axis of what they round; seen along it, they are arcs of a circle.
    """
    if not len(axes):
        return None
    to = points[None, :, :] - origins[:, None, :]
    along = (to * axes[:, None, :]).sum(axis=2)
    radial = np.linalg.norm(to - along[:, :, None] * axes[:, None, :], axis=2)
    size = float(np.abs(points - points.mean(axis=0)).max()) or 1.0
    middle = np.stack([radial.mean(axis=1), along.mean(axis=1)], axis=1)
    x, y = (radial - middle[:, :1]) / size, (along - middle[:, 1:]) / size
    rows = np.stack([2 * x, 2 * y, np.ones_like(x)], axis=2)
    square = rows.transpose(0, 2, 1) @ rows + 1e-15 * np.eye(3)
    a, b, d = np.linalg.solve(square, rows.transpose(0, 2, 1) @ (x * x + y * y)[:, :, None])[:, :, 0].T
    tube = np.sqrt(np.maximum(d + a * a + b * b, 0.0))
    off = np.abs(np.hypot(x - a[:, None], y - b[:, None]) - tube[:, None]).max(axis=1) * size
    best = int(np.nanargmin(np.where(np.isfinite(off), off, np.inf)))
    ring, tube_m = middle[best, 0] + a[best] * size, tube[best] * size
    if off[best] > near or not 0 < tube_m < ring:
        return None
    origin = origins[best] + (middle[best, 1] + b[best] * size) * axes[best]
    return Fitted(SurfaceKind.TORUS, origin, axes[best], float(ring), float(tube_m))


def circle_through(points: Array) -> tuple[Array, Array, float] | None:
    """Centre, axis and radius of the circle in space next to three points or more; None of points in a line."""
    middle = points.mean(axis=0)
    values, vectors = np.linalg.eigh((points - middle).T @ (points - middle))
    if values[1] <= 1e-9 * values[2]:
        return None
    x, y, axis = vectors[:, 2], vectors[:, 1], vectors[:, 0]
    found = _circle(np.c_[(points - middle) @ x, (points - middle) @ y])
    if found is None:
        return None
    return middle + found[0] * x + found[1] * y, axis, found[2]


def _across(axis: Array) -> tuple[Array, Array]:
    """Two unit vectors square to a third and to each other."""
    x = np.cross(axis, [1.0, 0.0, 0.0] if abs(axis[0]) < 0.7 else [0.0, 1.0, 0.0])
    x /= np.linalg.norm(x)
    return x, np.cross(axis, x)


def _cylinder_along(points: Array, axis: Array) -> Fitted | None:
    x, y = _across(axis)
    found = _circle(np.c_[points @ x, points @ y])
    if found is None:
        return None
    along = float((points @ axis).mean())
    return Fitted(SurfaceKind.CYLINDER, found[0] * x + found[1] * y + along * axis, axis, found[2])


def _circle(points: Array) -> tuple[float, float, float] | None:
    """Of (N, 2) points; algebraic (Kasa), which is exact for points on a circle."""
    middle = points.mean(axis=0)
    local = points - middle
    size = float(np.abs(local).max())
    if size == 0.0:
        return None
    local = local / size
    matrix = np.c_[2 * local, np.ones(len(local))]
    try:
        a, b, d = np.linalg.solve(matrix.T @ matrix, matrix.T @ (local**2).sum(axis=1))
    except np.linalg.LinAlgError:
        return None
    square = d + a * a + b * b
    if square <= 0 or not math.isfinite(square):
        return None
    return float(middle[0] + a * size), float(middle[1] + b * size), math.sqrt(square) * size


def _refined(start: Fitted, points: Array, near: float) -> Fitted | None:
    """Levenberg and Marquardt on the distances of the points. None where there are too few."""
    points = points[:: max(1, len(points) // MOST_POINTS)]
    size = float(np.abs(points - points.mean(axis=0)).max()) or 1.0
    x, y = _across(start.axis)

    def made(v: Array) -> Fitted:
        axis = start.axis + v[0] * x + v[1] * y
        return Fitted(
            start.kind,
            start.origin + size * (v[2] * x + v[3] * y + v[4] * start.axis),
            axis / np.linalg.norm(axis),
            start.radius + size * v[5],
            half_angle=start.half_angle + v[6],
        )

    free = _FREE[start.kind]
    if len(points) < len(free):
        return None
    found = _steps(lambda v: made(v).off(points) / size, free, near / size)
    return None if found is None else made(found)


def _steps(residuals: Callable[[Array], Array], free: list[int], near: float) -> Array | None:
    values, damping = np.zeros(7), 1e-4
    now = residuals(values)
    cost = float(now @ now)
    for _ in range(STEPS):
        jacobian = np.empty((len(now), len(free)))
        for column, index in enumerate(free):
            moved = values.copy()
            moved[index] += 1e-7
            jacobian[:, column] = (residuals(moved) - now) / 1e-7
        square, slope = jacobian.T @ jacobian, jacobian.T @ now
        step = np.linalg.lstsq(square + damping * np.diag(np.diag(square) + 1e-12), -slope, rcond=1e-14)[0]
        tried = values.copy()
        tried[free] += step
        there = residuals(tried)
        better = float(there @ there)
        if not math.isfinite(better):
            return None
        damping = damping / 10 if better < cost else damping * 10
        if better >= cost and damping > 1e-1:
            break
        if better < cost:
            slow = better > SLOW * cost
            values, now, cost = tried, there, better
            if slow or float(np.abs(now).max()) < 1e-3 * near:
                break
    return values


def _units(vectors: Array) -> Array:
    lengths = np.linalg.norm(vectors, axis=1)
    return vectors / np.where(lengths > 0, lengths, 1.0)[:, None]
