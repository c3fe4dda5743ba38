"""How does a part stand to another one, its place: beside it, on its axis, around it? In it: contracts' `places`."""

from __future__ import annotations

from collections.abc import Sequence

from querycad_contracts import Part
from querycad_contracts.places import RING_M, TOUCH_M
from querycad_segworker.vectors import cross, line_distance, norm

LEAST_IN_RING = 3
"""Two parts stand beside a third, three around it."""


def touches(part: Part, place: Part) -> bool:
    """Do the boxes of two parts meet?"""
    return all(
        abs(a - b) <= (e + f) / 2 + TOUCH_M
        for a, b, e, f in zip(part.center, place.center, part.extents, place.extents, strict=True)
    )


def coaxial(part: Part, other: Part) -> bool:
    """Do both lie on one axis, to a thousandth of the part?"""
    if part.axis is None or other.axis is None or norm(cross(part.axis, other.axis)) > 1e-3:
        return False
    return line_distance(other.center, part.center, part.axis) < 1e-3 * max(part.extents)


def encloses(part: Part, other: Part) -> bool:
    """Is it on the other's axis, and wider?"""
    return bool(part.radius and other.radius and part.radius > other.radius) and coaxial(part, other)


def surrounding(parts: Sequence[Part], place: Part) -> list[Part]:
    """Those that stand in a ring around the axis of the place: three and more, as far from it, their middle on it."""
    import numpy as np  # a tenth of a second, for the one word that asks for this

    if place.axis is None or not parts:
        return []
    arms = np.cross(np.array([part.center for part in parts]) - place.center, place.axis)  # (n, 3), off the axis
    away = np.linalg.norm(arms, axis=1)
    order = np.argsort(away, kind="stable")
    starts = np.flatnonzero(np.diff(away[order], prepend=-1.0) > RING_M)
    sizes = np.diff(starts, append=len(parts))
    middles = np.linalg.norm(np.add.reduceat(arms[order], starts) / sizes[:, None], axis=1)
    rings = (sizes >= LEAST_IN_RING) & (away[order][starts] > RING_M) & (middles < RING_M)
    found = set(order[np.repeat(rings, sizes)].tolist())
    return [part for i, part in enumerate(parts) if i in found] if found else []
