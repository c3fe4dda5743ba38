"""Triangles and which of them meet: what a file of a mesh comes to. Lengths in metres."""

from __future__ import annotations

from dataclasses import dataclass
from functools import cached_property

import numpy as np
from numpy.typing import NDArray

from querycad_contracts import Vector

Array = NDArray[np.float64]
Ints = NDArray[np.int64]

MOST_TRIANGLES = 1_500_000
"""What can be read within the limits of time and memory; programs write some thousand for a part."""
NOISE = 1e-6
"""A coordinate is off by this share of the largest: single precision has 1e-7, text of six digits up to 5e-7."""


@dataclass(frozen=True, slots=True)
class Named:
    """An object of a file: its name, colour and how many of the triangles are its own, which follow those before it."""

    name: str
    color: str | None
    count: int


@dataclass(frozen=True, eq=False)
class Triangles:
    """vertices: (V, 3) float64, metres, each place once. corners: (T, 3) int64, counter-clockwise from outside."""

    vertices: Array
    corners: Ints

    @cached_property
    def sides(self) -> Array:
        """(T, 3, 3): side k goes from corner k to the next."""
        points = self.vertices[self.corners]
        return np.roll(points, -1, axis=1) - points

    @cached_property
    def _crosses(self) -> Array:
        return np.cross(self.sides[:, 0], self.sides[:, 1])

    @cached_property
    def areas(self) -> Array:
        """(T,) m2."""
        found: Array = np.linalg.norm(self._crosses, axis=1) / 2
        return found

    @cached_property
    def normals(self) -> Array:
        """(T, 3) unit vectors; zeros of a triangle without an area."""
        doubled = 2 * self.areas
        return self._crosses / np.where(doubled > 0, doubled, 1.0)[:, None]

    @cached_property
    def centers(self) -> Array:
        """(T, 3)."""
        found: Array = self.vertices[self.corners].mean(axis=1)
        return found

    @cached_property
    def lengths(self) -> Array:
        """(T, 3): of the sides."""
        found: Array = np.linalg.norm(self.sides, axis=2)
        return found

    @cached_property
    def noise(self) -> float:
        """How far may a vertex be off, in metres?"""
        return NOISE * float(np.abs(self.vertices).max(initial=0.0))

    @cached_property
    def tilts(self) -> Array:
        """(T,): by which angle may the normal be off, in radians? A sliver's by any."""
        longest = self.lengths.max(axis=1)
        heights = np.where(longest > 0, 2 * self.areas / np.where(longest > 0, longest, 1.0), 0.0)
        return np.minimum(3 * self.noise / np.maximum(heights, 1e-300), np.pi)

    @cached_property
    def _paired(self) -> tuple[Ints, Ints, bool]:
        """Neighbours, how often each side is used, and whether both ways alike."""
        count = len(self.corners)
        start = self.corners.ravel()
        end = np.roll(self.corners, -1, axis=1).ravel()
        forward = start < end
        keys = np.where(forward, start, end) * np.int64(len(self.vertices)) + np.where(forward, end, start)
        order = np.argsort(keys, kind="stable")
        ordered = keys[order]
        first = np.flatnonzero(np.r_[True, ordered[1:] != ordered[:-1]])
        uses = np.diff(np.r_[first, len(ordered)])
        neighbours = np.full(3 * count, -1, dtype=np.int64)
        two = first[uses == 2]
        a, b = order[two], order[two + 1]
        fits = forward[a] != forward[b]
        a, b = a[fits], b[fits]
        neighbours[a], neighbours[b] = b, a
        for at in np.flatnonzero((uses > 2) & (uses % 2 == 0)):
            around = order[first[at] : first[at] + uses[at]]
            for one, other in self._wedges(around[forward[around]], around[~forward[around]]):
                neighbours[one], neighbours[other] = other, one
        balance = np.add.reduceat(np.where(forward[order], 1, -1), first) if len(first) else np.zeros(0, dtype=np.int64)
        unbalanced = np.zeros(3 * count, dtype=np.int64)
        unbalanced[order] = np.repeat(balance, uses)
        return neighbours, unbalanced, bool(fits.all())

    def _wedges(self, forward: Ints, backward: Ints) -> list[tuple[int, int]]:
        """Which sides at an edge where bodies touch bound one wedge of material? The thinnest wedges first."""
        if len(forward) != len(backward):
            return []
        along = self.sides.reshape(-1, 3)[forward[0]]
        length = float(np.linalg.norm(along))
        if length == 0.0:
            return []
        along = along / length
        inward = np.cross(self.normals[forward // 3], along)  # from the edge into each triangle
        other = -np.cross(self.normals[backward // 3], along)
        normals = self.normals[forward // 3]
        found: list[tuple[float, int, int]] = []
        for i, side in enumerate(forward):
            angles = np.arctan2(-(other @ normals[i]), other @ inward[i]) % (2 * np.pi)
            angles[(angles < 1e-4) | (angles > 2 * np.pi - 1e-4)] = 2 * np.pi  # two bodies' faces on each other
            found.extend((float(angle), int(side), int(backward[j])) for j, angle in enumerate(angles))
        taken: set[int] = set()
        pairs = []
        for _, one, two in sorted(found):
            if one not in taken and two not in taken:
                taken |= {one, two}
                pairs.append((one, two))
        return pairs

    @cached_property
    def across(self) -> Ints:
        """(T, 3): the side (3 t + k) that lies on side k of a triangle; -1 where there is none, or several."""
        return self._paired[0].reshape(-1, 3)

    @cached_property
    def beside(self) -> Ints:
        """(T, 3): the triangle across side k; -1 where there is none, or several."""
        return np.where(self.across < 0, -1, self.across // 3)

    @cached_property
    def is_open(self) -> NDArray[np.bool_]:
        """(T,): is a side of it the border of a surface, or do its neighbours not agree which side is out?"""
        found: NDArray[np.bool_] = (self._paired[1].reshape(-1, 3) != 0).any(axis=1)
        return found

    @cached_property
    def pairs(self) -> tuple[Ints, Ints]:
        """Sides that two triangles share: the side of one and of the other, each pair once."""
        sides = np.arange(3 * len(self.corners))
        other = self.across.ravel()
        once = other > sides
        return sides[once], other[once]

    @cached_property
    def angles(self) -> Array:
        """(T, 3): between the normals of a triangle and of the one across each side; pi where there is none."""
        beside = np.where(self.beside < 0, 0, self.beside)
        other = self.normals[beside]
        own = self.normals[:, None, :]
        sine = np.linalg.norm(np.cross(own, other), axis=2)
        angles = np.arctan2(sine, (own * other).sum(axis=2))
        return np.where(self.beside < 0, np.pi, angles)


def components(count: int, a: Ints, b: Ints) -> Ints:
    """(count,): which group is each in, when a[i] and b[i] are in one? Numbered by their lowest member's place."""
    label = np.arange(count)
    while len(a):
        one, other = label[a], label[b]
        apart = one != other
        a, b, one, other = a[apart], b[apart], one[apart], other[apart]
        if not len(a):
            break
        np.minimum.at(label, np.maximum(one, other), np.minimum(one, other))
        while True:
            shorter = label[label]
            if (shorter == label).all():
                break
            label = shorter
    return np.unique(label, return_inverse=True)[1].reshape(-1)


def merged(corners: Array, grid: float = 0.0) -> tuple[Triangles, NDArray[np.bool_]]:
    """From (T, 3, 3) places of corners: each place once; and which triangles are kept, as they have three.

    `grid`: places that round to the same multiple of it are one; 0: those that are equal.
    """
    places = corners.reshape(-1, 3) + 0.0  # minus zero is zero
    rounded = np.round(places / grid) + 0.0 if grid else places
    order = np.lexsort(rounded.T)
    ordered = rounded[order]
    new = np.r_[True, (ordered[1:] != ordered[:-1]).any(axis=1)] if len(order) else np.zeros(0, dtype=bool)
    index = np.empty(len(order), dtype=np.int64)
    index[order] = np.cumsum(new) - 1
    three = index.reshape(-1, 3)
    kept = (three[:, 0] != three[:, 1]) & (three[:, 1] != three[:, 2]) & (three[:, 2] != three[:, 0])
    return Triangles(places[order[new]], three[kept]), kept


def vector_of(values: Array) -> Vector:
    """Three plain numbers."""
    return float(values[0]), float(values[1]), float(values[2])


def grouped(number: Ints, count: int) -> list[Ints]:
    """Which places hold each of the numbers 0 to `count` - 1?"""
    order = np.argsort(number, kind="stable")
    return np.split(order, np.searchsorted(number[order], np.arange(1, count)))
