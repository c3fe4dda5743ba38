"""Which planes mirror a body or the whole model onto itself, and which rotations turn it onto itself?

Decided on the faces, by their exact areas, middles and second moments: an isometry maps every face onto one like it.
Candidates come from the faces of the rarest kind, so that none is missed and few are tried.
"""

from __future__ import annotations

import math
from collections.abc import Iterator, Sequence
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from querycad_contracts import SurfaceKind, Vector, Weighed
from querycad_segworker.topology import FaceRecord

Array = NDArray[np.float64]
SHARE = 2e-3
"""Areas and second moments that differ by less than this share are the same: what the kernel integrates is exact to
1e-4, and the second moments of a thin face are a small difference."""
NEAR_M = 2e-6
"""Middles nearer than this, and than 1e-5 of the model, are the same: files keep 1e-7 m, and drawings ask for 1e-5."""
SINGLE_KIND = 48
"""Of so many faces of one kind at most candidates are made: more lie on circles and grids whose planes others give."""
_AXES = np.eye(3)
_OFFSET = 0.3141
"""Bins of alike faces begin off round numbers, where values are that differ in the last digit only."""


@dataclass(frozen=True, slots=True)
class Symmetry:
    """Unit normals of mirror planes, and axes with their number of positions; 0: any angle. All through the middle.

    Of what is round about an axis, of all the planes through it only those along the file's axes are named.
    """

    planes: tuple[Vector, ...] = ()
    axes: tuple[tuple[Vector, int], ...] = ()


def symmetry(faces: Sequence[FaceRecord]) -> Symmetry:
    """How is the body symmetric that these faces, pieces of one surface united, make?"""
    if not faces:
        return Symmetry()
    table = _Faces(faces)
    round_about = [axis for axis in _unique(table.own_axes()) if table.is_round(axis)]
    planes = [n for n in _unique(table.normals()) if table.maps(np.eye(3) - 2 * np.outer(n, n))]
    if round_about:
        planes = [n for n in planes if any(abs(n @ a) > 1 - 1e-9 for a in (*_AXES, *round_about))]
    if len(round_about) > 1:  # a ball, or balls about one centre
        return Symmetry(tuple(map(_vector, _AXES)), tuple((_vector(axis), 0) for axis in _AXES))
    crossings = [np.cross(a, b) for i, a in enumerate(planes[:12]) for b in planes[:i]]
    turns = [(axis, table.order(axis)) for axis in _unique([*table.own_axes(), *planes, *crossings])]
    found = [(_vector(axis), 0) for axis in round_about]
    if not round_about:
        found += sorted(((_vector(axis), order) for axis, order in turns if order > 1), key=lambda one: -one[1])
    return Symmetry(tuple(map(_vector, planes)), tuple(found))


class _Faces:
    """The faces of one body as arrays, metres: middles from the common one, areas, spreads, kinds."""

    def __init__(self, faces: Sequence[FaceRecord]) -> None:
        """At least one face."""
        self.faces = faces
        self.area = np.array([max(face.moments.amount, 1e-30) for face in faces])
        middles = np.array([face.moments.center for face in faces]).reshape(-1, 3)
        self.middle = self.area @ middles / self.area.sum()
        self.at = middles - self.middle
        inertia = np.array([face.moments.inertia for face in faces]).reshape(-1, 3, 3)
        self.spread = np.trace(inertia, axis1=1, axis2=2)[:, None, None] / 2 * np.eye(3) - inertia
        self.width = np.trace(self.spread, axis1=1, axis2=2)
        order = {kind: n for n, kind in enumerate(SurfaceKind)}
        self.kind = np.array([4 * order[face.kind] + face.outward for face in faces])
        self.radius = np.array([(face.radius, face.minor_radius) for face in faces]).reshape(-1, 2)
        self.log_area = 100 * np.log(self.area) + _OFFSET
        self.far = np.linalg.norm(self.at, axis=1)
        self.near = NEAR_M + 1e-5 * float(self.far.max(initial=0.0))
        self._way = np.array([0.4472, 0.6325, 0.6324])  # along no usual direction, so that few middles are level
        level = self.at @ self._way
        self._sorted = np.argsort(level)
        self._levels = level[self._sorted]

    def maps(self, turn: Array) -> bool:
        """Does an isometry (3, 3) about the middle put every face onto one like it?"""
        at = self.at @ turn.T
        level = at @ self._way
        first = np.searchsorted(self._levels, level - 2 * self.near)
        last = np.searchsorted(self._levels, level + 2 * self.near, "right")
        if (first == last).any():
            return False
        spread = turn @ self.spread @ turn.T
        open_ = np.arange(len(at))
        for step in range(int((last - first).max())):
            open_ = open_[first[open_] + step < last[open_]] if step else open_
            other = self._sorted[first[open_] + step]
            met = (np.abs(at[open_] - self.at[other]) <= self.near).all(axis=1) & self._like(open_, other)
            apart = np.abs(spread[open_] - self.spread[other]).max(axis=(1, 2))
            met &= apart <= SHARE * self.width[open_] + 1e-30
            first[open_[met]] = len(at) * 2  # found
            lost = first < len(at) * 2
            if not lost.any():
                return True
            open_ = np.flatnonzero(lost)
        return False

    def _like(self, one: NDArray[np.intp], other: NDArray[np.intp]) -> NDArray[np.bool_]:
        """Are faces of one kind, radius and area?"""
        same: NDArray[np.bool_] = self.kind[one] == self.kind[other]
        same &= (np.abs(self.radius[one] - self.radius[other]) <= self.near).all(axis=1)
        same &= np.abs(self.area[one] - self.area[other]) <= SHARE * self.area[one]
        return same

    def own_axes(self) -> list[Array]:
        """The file's axes and the principal axes of the surface."""
        whole = (self.area[:, None, None] * self.at[:, :, None] * self.at[:, None, :] + self.spread).sum(axis=0)
        return [*_AXES, *np.linalg.eigh(whole)[1].T]

    def normals(self) -> Iterator[Array]:
        """Normals of all planes that can be mirrors.

        A mirror takes a face off the middle to one like it, square to the way between both, or lies through it. Then
        it takes a second face, not in line with the first, so, or lies through both.
        """
        yield from self.own_axes()
        classes = self._classes(self.far)
        if not classes:
            return
        first = self.at[classes[0][0]]
        for other in classes[0][1:SINGLE_KIND]:
            yield first - self.at[other]
        beside = np.linalg.norm(np.cross(self.at, first), axis=1) > 1e-3 * np.linalg.norm(first) * self.far.max()
        for members in classes:
            second = next((i for i in members if beside[i]), None)
            if second is None:
                continue
            yield np.cross(first, self.at[second])
            for other in members[:SINGLE_KIND]:
                if other != second:
                    yield self.at[second] - self.at[other]
            return

    def _classes(self, *measures: Array) -> list[list[int]]:
        """Faces off the middle (or the axis: the first measure) that are alike in all measures; the rarest first."""
        groups: dict[tuple[float, ...], list[int]] = {}
        for i in np.flatnonzero(measures[0] > 100 * self.near):
            place = (*(math.floor(m[i] / (20 * self.near) + _OFFSET) for m in measures), math.floor(self.log_area[i]))
            groups.setdefault((int(self.kind[i]), *place), []).append(int(i))
        return sorted(groups.values(), key=len)

    def is_round(self, axis: Array) -> bool:
        """Is all of it turned about this axis? Freeform faces are not taken for round."""
        off = np.linalg.norm(self.at - np.outer(self.at @ axis, axis), axis=1)
        if off.max() > self.near or any(not _turned_about(face, axis) for face in self.faces):
            return False
        return self.maps(_rotation(axis, 1.0))

    def order(self, axis: Array) -> int:
        """Into how many positions does it turn about this axis? 1 where it does not."""
        along = self.at @ axis
        off = np.linalg.norm(self.at - np.outer(along, axis), axis=1)
        sizes = [len(group) for group in self._classes(off, along)]
        most = min(sizes, default=2)
        orders = (n for n in range(most, 1, -1) if most % n == 0)
        return next((n for n in orders if self.maps(_rotation(axis, math.tau / n))), 1)


def symmetry_tags(one: Weighed) -> tuple[str, ...]:
    """Tags that say how a body is symmetric: 'symmetric', 'symmetric_x' (left and right are alike), 'rotational' …"""
    along = [f"symmetric_{name}" for name, axis in zip("xyz", _AXES, strict=True) if tuple(axis) in one.mirror_planes]
    round_about = any(order == 0 for _, order in one.rotation_axes)
    turned = (*(("rotational",) if one.rotation_axes else ()), *(("axisymmetric",) if round_about else ()))
    return (*(("symmetric",) if one.mirror_planes else ()), *along, *turned)


def _turned_about(face: FaceRecord, axis: Array) -> bool:
    if face.kind is SurfaceKind.SPHERE:
        return True
    return face.kind is not SurfaceKind.FREEFORM and abs(float(np.asarray(face.axis) @ axis)) > 1 - 1e-6


def _rotation(axis: Array, angle: float) -> Array:
    """The matrix that turns about a unit vector (Rodrigues)."""
    x, y, z = axis
    across = np.array([[0.0, -z, y], [z, 0.0, -x], [-y, x, 0.0]])
    turned: Array = np.eye(3) + math.sin(angle) * across + (1 - math.cos(angle)) * (across @ across)
    return turned


def _unique(directions: Sequence[Array] | Iterator[Array]) -> list[Array]:
    """Unit vectors of these directions, each once, whichever way it points; the file's own axes as they are."""
    kept: list[Array] = []
    for direction in directions:
        length = float(np.linalg.norm(direction))
        if length > 0:
            one = direction / length
            one = one if one[np.abs(one).argmax()] > 0 else -one
            if all(abs(one @ other) < 1 - 1e-9 for other in kept):
                kept.append(one)
    return kept


def _vector(direction: Array) -> Vector:
    x, y, z = (float(value) + 0.0 for value in np.round(direction, 12))
    return (x, y, z)
