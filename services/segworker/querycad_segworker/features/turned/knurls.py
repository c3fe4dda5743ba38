"""Diamond knurls: rows of small points around a handle, each row turned by half a pitch against the next."""

from __future__ import annotations

import math
from collections.abc import Callable, Sequence
from dataclasses import dataclass

from querycad_contracts import Vector
from querycad_segworker.features.shared.axes import Axis
from querycad_segworker.features.shared.refusals import refuse
from querycad_segworker.features.shared.walls import Wall
from querycad_segworker.tolerances import Tolerances
from querycad_segworker.topology import Brep, parted
from querycad_segworker.vectors import dot, foot, mean, sub

from .gears import KNURL_DEPTH, KNURL_TEETH, main_axes, period

MIN_FACES = 3 * KNURL_TEETH
"""Two rows of points have more faces than this."""
SAME_PLACE = 2e-3
"""Share of the radius by which faces of one row may differ in height and distance from the axis."""
SHORT = 0.5
"""A face of a diamond knurl takes less of its width than this; those of straight and diagonal ones take all of it."""


@dataclass(frozen=True, slots=True)
class Knurl:
    """A diamond knurl. Metres. `count` points around; `width` along the axis."""

    axis: Axis
    count: int
    tip_radius: float
    root_radius: float
    width: float
    center: Vector
    faces: tuple[int, ...]


@dataclass(frozen=True, slots=True)
class _Spot:
    """Where a face lies about an axis."""

    face: int
    position: float
    radius: float
    angle: float


def recognise_knurls(brep: Brep, walls: Sequence[Wall], tolerances: Tolerances) -> list[Knurl]:
    """Which diamond knurls does the model have? Sorted by lowest face id.

    Rows of at least twenty faces at equal angles, one row above the other, that touch each other, rise by little, and
    are short along the axis. Straight knurls are gears of many low pointed teeth.
    """
    found: list[Knurl] = []
    for body in brep.bodies:
        if len(body.faces) < MIN_FACES:
            continue
        for axis in main_axes([w for w in walls if w.body == body.id], tolerances):
            rows = _rows(brep, body.faces, axis)
            counts = {face: count for count, row in rows for face in row}
            for patch in _touching(brep, counts):
                knurl = _knurl(brep, axis, patch, counts)
                if knurl is not None and not any(set(knurl.faces) & set(other.faces) for other in found):
                    found.append(knurl)
    return sorted(found, key=lambda knurl: knurl.faces[0])


def _rows(brep: Brep, faces: Sequence[int], axis: Axis) -> list[tuple[int, list[int]]]:
    """Faces that look outwards from one height and distance, at equal angles: how often in a turn, and their ids."""
    spots = []
    for i in faces:
        face = brep.faces[i]
        middle = mean([brep.edges[e].mid for e in brep.face_edges[i]]) if brep.face_edges[i] else face.point
        radius = axis.radius_of(middle)
        if radius > 0 and dot(face.point_normal, sub(middle, foot(middle, axis.origin, axis.direction))) > 0:
            spots.append(_Spot(i, axis.position(middle), radius, axis.angle_of(middle)))
    rows = []
    for level in _clusters(spots, lambda spot: spot.position):
        for row in _clusters(level, lambda spot: spot.radius):
            count = period([spot.angle for spot in row]) if len(row) >= KNURL_TEETH else 0
            if count >= KNURL_TEETH:
                rows.append((count, [spot.face for spot in row]))
    return rows


def _clusters(spots: Sequence[_Spot], key: Callable[[_Spot], float]) -> list[list[_Spot]]:
    """Spots in order of `key`, parted where neighbours differ."""
    clusters: list[list[_Spot]] = []
    last = -math.inf
    for spot in sorted(spots, key=key):
        if key(spot) - last > SAME_PLACE * spot.radius:
            clusters.append([])
        clusters[-1].append(spot)
        last = key(spot)
    return clusters


def _touching(brep: Brep, counts: dict[int, int]) -> list[list[int]]:
    """The faces of rows, parted into those that hang together."""
    patches = parted(sorted(counts), lambda face: {other for _, other in brep.neighbours(face) if other in counts})
    return [sorted(patch) for patch in patches if len(patch) >= MIN_FACES]


def _knurl(brep: Brep, axis: Axis, patch: Sequence[int], counts: dict[int, int]) -> Knurl | None:
    corners = {i: [p for e in brep.face_edges[i] for p in (brep.edges[e].start, brep.edges[e].end)] for i in patch}
    radii = [axis.radius_of(p) for points in corners.values() for p in points]
    positions = {i: [axis.position(p) for p in points] for i, points in corners.items()}
    low, high = min(min(p) for p in positions.values()), max(max(p) for p in positions.values())
    short = all(max(p) - min(p) <= SHORT * (high - low) for p in positions.values())
    if not short or max(radii) == min(radii):
        return None
    if max(radii) - min(radii) > KNURL_DEPTH * max(radii):
        refuse("gear", patch, "its points are too high for a knurl")
        return None
    return Knurl(
        axis=axis,
        count=min(counts[i] for i in patch),
        tip_radius=max(radii),
        root_radius=min(radii),
        width=high - low,
        center=axis.at((low + high) / 2),
        faces=tuple(patch),
    )
