"""Rolling bearings in assemblies: two rings on one axis with balls or rollers between, or the rings alone."""

from __future__ import annotations

import itertools
import math
from collections.abc import Sequence
from dataclasses import dataclass

from querycad_contracts import SurfaceKind, Vector
from querycad_segworker.features.shared.axes import ENCLOSES_RAD, Axis
from querycad_segworker.features.shared.frames import face_points
from querycad_segworker.features.shared.part_measures import faces_box
from querycad_segworker.features.shared.refusals import refuse
from querycad_segworker.tolerances import Tolerances
from querycad_segworker.topology import REVOLVED, BodyRecord, Brep, FaceRecord
from querycad_segworker.vectors import box_center, parallel

REVOLVED_SHARE = 0.9
"""Of a ring's surface: what turns about its axis. Marks, lubrication holes and slots take the rest."""
MIN_ROLLERS = 3
"""Fewer rolling bodies do not hold a ring."""
LEVEL = 0.15
"""The rings of a radial bearing lie beside each other: their middles differ by less than this share of their width;
those of angular contact and tapered bearings (ISO 355) by less than twice that."""
WIDTHS = 1.34
"""Rings without rolling bodies between are those of a bearing when their widths are alike: equal in ISO 15; by up to
a third wider inner rings have insert bearings (ISO 9628)."""
RING_WIDTH = 0.6
"""A bearing is narrower than this share of its outer diameter (ISO 15: 0.06 to 0.5); longer ones are nested tubes."""
MIN_GAP = 0.05
"""Rings without rolling bodies leave at least this share of the bearing's section between them; less is a fit."""
FILLS = 0.5
"""Rolling bodies run on both rings: they are thicker than this share of the gap between these, and where the rings have
raceways, thicker than the gap itself."""
SAME_SIZE = 0.01
"""Rolling bodies of one bearing agree in size by this share."""


@dataclass(frozen=True, slots=True)
class Bearing:
    """One bearing. Metres, frame of the file. Bodies by id: `rings` are inner and outer one, or the two washers."""

    axis: Axis
    center: Vector
    inner_radius: float
    outer_radius: float
    width: float
    rings: tuple[int, int]
    rolling: tuple[int, ...]
    others: tuple[int, ...]
    """Cage, seals and shields."""
    axial: bool
    """A thrust bearing: its rings lie one behind the other."""
    balls: bool


@dataclass(frozen=True, slots=True)
class _Ring:
    """A body that turns about an axis that it leaves free. Positions are along `axis`."""

    body: int
    axis: Axis
    inner: float
    outer: float
    low: float
    high: float

    def on(self, axis: Axis) -> _Ring:
        """The same ring by positions along another directed line through its axis."""
        ends = [axis.position(self.axis.at(p)) for p in (self.low, self.high)]
        return _Ring(self.body, axis, self.inner, self.outer, min(ends), max(ends))

    @property
    def width(self) -> float:
        return self.high - self.low

    @property
    def middle(self) -> float:
        return (self.low + self.high) / 2


@dataclass(frozen=True, slots=True)
class _Roller:
    """A ball or roller: a body that turns about an axis or point and is convex all over."""

    body: int
    center: Vector
    size: tuple[float, float]
    """Widest radius and area: equal ones are equal bodies, however they lie."""
    ball: bool


def recognise_bearings(brep: Brep, tolerances: Tolerances) -> list[Bearing]:
    """Which bearings does an assembly have? Sorted by their first body; none in a file of one body."""
    if len(brep.bodies) < 2:
        return []
    rings = [ring for record in brep.bodies if (ring := _ring(brep, record, tolerances)) is not None]
    if len(rings) < 2:
        return []
    centers = [box_center(faces_box(brep, record.faces)) for record in brep.bodies]
    rollers = [roller for record in brep.bodies if (roller := _roller(brep, record, centers[record.id])) is not None]
    found: list[Bearing] = []
    for line in _by_axis(rings, tolerances):
        taken: set[int] = set()
        pairs = [pair for pair in itertools.permutations(line, 2) if pair[0].body != pair[1].body]
        # Nearest pairs first: of several bearings on one shaft each ring goes with its neighbour.
        pairs.sort(key=lambda pair: (abs(pair[0].middle - pair[1].middle), pair[1].inner - pair[0].outer))
        for first, second in pairs:
            if {first.body, second.body} & taken:
                continue
            bearing = _bearing(brep, centers, first, second, rollers)
            if bearing is not None:
                taken.update((first.body, second.body))
                found.append(bearing)
    return sorted(found, key=lambda bearing: min(bearing.rings))


def _bearing(
    brep: Brep, centers: Sequence[Vector], first: _Ring, second: _Ring, rollers: Sequence[_Roller]
) -> Bearing | None:
    """The bearing that has these as inner and outer ring, or as its two washers."""
    radial = _lies_in(first, second) and _reach_together(first, second)
    axial = not radial and first.body < second.body and _face_each_other(first, second)
    if not radial and not axial:
        return None
    rolling = _between(first, second, rollers, axial=axial)
    if not rolling and (axial or not _pair_alone(brep, first, second)):
        return None
    low, high = min(first.low, second.low), max(first.high, second.high)
    inner, outer = min(first.inner, second.inner), max(first.outer, second.outer)
    taken = {first.body, second.body, *(roller.body for roller in rolling)}
    between = ((first.inner + first.outer) / 2, second.outer) if radial else (inner, outer)
    return Bearing(
        axis=first.axis,
        center=first.axis.at((low + high) / 2),
        inner_radius=inner,
        outer_radius=outer,
        width=high - low,
        rings=(first.body, second.body),
        rolling=tuple(sorted(roller.body for roller in rolling)),
        others=_within(brep, centers, first.axis, between, (low, high), taken),
        axial=axial,
        balls=bool(rolling) and all(roller.ball for roller in rolling),
    )


def _lies_in(first: _Ring, second: _Ring) -> bool:
    """Is one the inner, the other the outer ring? The ribs of tapered bearings may overlap a little."""
    return (first.inner + first.outer) / 2 < second.inner and first.outer < (second.inner + second.outer) / 2


def _reach_together(first: _Ring, second: _Ring) -> bool:
    """Do both lie at one place along the axis?"""
    return abs(first.middle - second.middle) <= 2 * LEVEL * max(first.width, second.width)


def _face_each_other(first: _Ring, second: _Ring) -> bool:
    """Are they washers of about one size, one behind the other?"""
    apart = first.high <= second.low or second.high <= first.low
    overlap = min(first.outer, second.outer) - max(first.inner, second.inner)
    return apart and overlap > 0.5 * max(first.outer - first.inner, second.outer - second.inner)


def _pair_alone(brep: Brep, first: _Ring, second: _Ring) -> bool:
    """Are two rings without anything that rolls between them those of a bearing drawn in a simple way?"""
    section = second.outer - first.inner
    wide, narrow = max(first.width, second.width), min(first.width, second.width)
    level = abs(first.middle - second.middle) <= LEVEL * wide
    gap = second.inner - first.outer
    reasons = {
        "the rings do not lie beside each other": level,
        "the rings have unlike widths": wide <= WIDTHS * narrow,
        "the rings are as long as nested tubes": wide <= RING_WIDTH * 2 * second.outer,
        "no room is left between the rings": gap >= MIN_GAP * section,
    }
    for reason, holds in reasons.items():
        if not holds:
            refuse("bearing", (*brep.bodies[first.body].faces, *brep.bodies[second.body].faces), reason)
            return False
    return True


def _between(first: _Ring, second: _Ring, rollers: Sequence[_Roller], *, axial: bool) -> list[_Roller]:
    """The rolling bodies of one size in the space between two rings, which fill the gap of a radial bearing."""
    if axial:
        near, far = max(first.inner, second.inner), min(first.outer, second.outer)
        low, high = sorted((first.middle, second.middle))
    else:
        near, far = (first.inner + first.outer) / 2, (second.inner + second.outer) / 2
        low, high = min(first.low, second.low), max(first.high, second.high)
    thin = 0.0 if axial else FILLS * (second.inner - first.outer) / 2
    inside = [
        roller
        for roller in rollers
        if roller.size[0] >= thin
        and near <= first.axis.radius_of(roller.center) <= far
        and low <= first.axis.position(roller.center) <= high
    ]
    sizes: list[list[_Roller]] = []
    for roller in inside:
        alike = (s for s in sizes if all(_same(a, b) for a, b in zip(s[0].size, roller.size, strict=True)))
        same = next(alike, None)
        if same is None:
            sizes.append([roller])
        else:
            same.append(roller)
    most = max(sizes, key=len, default=[])
    return most if len(most) >= MIN_ROLLERS else []


def _same(a: float, b: float) -> bool:
    return abs(a - b) <= SAME_SIZE * max(a, b)


def _within(
    brep: Brep,
    centers: Sequence[Vector],
    axis: Axis,
    between: tuple[float, float],
    along: tuple[float, float],
    taken: set[int],
) -> tuple[int, ...]:
    """The bodies that lie wholly in the ring between two radii and two positions: cages, seals, shields."""
    slack_r, slack = 0.02 * between[1], 0.05 * (along[1] - along[0])
    found = []
    for record in brep.bodies:
        center = centers[record.id]
        beside = not along[0] - slack <= axis.position(center) <= along[1] + slack
        if record.id in taken or beside or axis.radius_of(center) > between[1]:
            continue
        points = face_points(brep, record.faces)
        if points and all(
            between[0] - slack_r <= axis.radius_of(p) <= between[1] + slack_r
            and along[0] - slack <= axis.position(p) <= along[1] + slack
            for p in points
        ):
            found.append(record.id)
    return tuple(found)


def _by_axis(rings: Sequence[_Ring], tolerances: Tolerances) -> list[list[_Ring]]:
    """Rings on one line, with positions along one axis of it."""
    lines: list[list[_Ring]] = []
    for ring in rings:
        line = next((line for line in lines if line[0].axis.same_line(ring.axis, tolerances)), None)
        if line is None:
            lines.append([ring])
        else:
            line.append(ring.on(line[0].axis))
    return [line for line in lines if len(line) > 1]


def _ring(brep: Brep, record: BodyRecord, tolerances: Tolerances) -> _Ring | None:
    """The body as a ring: all of it turns about one axis, and a concave wall around that leaves it free."""
    faces = [brep.faces[f] for f in record.faces]
    lead = max((f for f in faces if f.kind in REVOLVED), key=lambda f: f.area, default=None)
    if lead is None or not any(f.outward < 0 for f in faces):
        return None
    axis = Axis.of(lead)
    own = [f for f in faces if _turns_about(f, axis, tolerances)]
    if sum(f.area for f in own) < REVOLVED_SHARE * record.area:
        return None
    bores = [f for f in own if f.kind is not SurfaceKind.PLANE and f.outward < 0]
    rims = face_points(brep, (f.id for f in bores))
    points = face_points(brep, (f.id for f in own))
    ends = [axis.position(p) for p in points]
    covers = [axis.position(p) for p in rims]
    if not rims or max(covers) - min(covers) < 0.5 * (max(ends) - min(ends)) or not _go_around(axis, rims):
        return None
    inner, outer = min(axis.radius_of(p) for p in rims), max(axis.radius_of(p) for p in points)
    hollow = inner > 10 * tolerances.length and not any(_closes(brep, f, axis) for f in own)
    return _Ring(record.id, axis, inner, outer, min(ends), max(ends)) if hollow else None


def _go_around(axis: Axis, points: Sequence[Vector]) -> bool:
    """Do points lie around the axis, with no opening between them as wide as that of a C, which holds no shaft?"""
    angles = sorted(axis.angle_of(p) for p in points)
    gaps = [b - a for a, b in itertools.pairwise([*angles, angles[0] + 2 * math.pi])]
    return max(gaps) < 2 * math.pi - ENCLOSES_RAD


def _closes(brep: Brep, face: FaceRecord, axis: Axis) -> bool:
    """Does a plane reach across the axis, as the bottom of a cup does? Its boundary is one circle then."""
    if face.kind is not SurfaceKind.PLANE or len(face.loops) > 1:
        return False
    radii = [axis.radius_of(p) for p in face_points(brep, (face.id,))]
    return max(radii) <= 1.001 * min(radii)


def _turns_about(face: FaceRecord, axis: Axis, tolerances: Tolerances) -> bool:
    if face.kind is SurfaceKind.PLANE:
        return parallel(face.axis, axis.direction, 3 * tolerances.angle)
    if face.kind is SurfaceKind.SPHERE:
        return axis.radius_of(face.origin) <= 3 * tolerances.length
    return face.kind in REVOLVED and axis.same_line(Axis.of(face), tolerances)


def _roller(brep: Brep, record: BodyRecord, center: Vector) -> _Roller | None:
    """The body as a ball or roller: nothing of it is concave, and its largest face is round."""
    faces = [brep.faces[f] for f in record.faces]
    round_faces = [f for f in faces if f.kind in (*REVOLVED, SurfaceKind.SPHERE)]
    lead = max(round_faces, key=lambda f: f.area, default=None)
    if lead is None or any(f.outward < 0 for f in faces) or not record.is_solid:
        return None
    if any(f.kind is SurfaceKind.FREEFORM for f in faces):
        return None
    ball = all(f.kind is SurfaceKind.SPHERE for f in faces)
    axis = Axis.of(lead)
    if not ball and sum(f.area for f in faces if f.kind is SurfaceKind.PLANE or _coaxial(f, axis)) < 0.99 * record.area:
        return None
    radius = lead.radius if ball else max(map(axis.radius_of, face_points(brep, record.faces)), default=lead.radius)
    return _Roller(record.id, lead.origin if ball else center, (radius, record.area), ball)


def _coaxial(face: FaceRecord, axis: Axis) -> bool:
    near = 0.01 * max(face.radius, 1e-9)
    return parallel(face.axis, axis.direction, 0.01) and axis.radius_of(face.origin) <= near
