"""Gears and other cyclic teeth: faces that repeat around an axis."""

from __future__ import annotations

import math
from collections import Counter, defaultdict
from collections.abc import Sequence
from dataclasses import dataclass

from querycad_contracts import SurfaceKind, Vector
from querycad_segworker.features.shared.refusals import refuse
from querycad_segworker.features.shared.walls import Axis, Wall
from querycad_segworker.tolerances import Tolerances
from querycad_segworker.topology import Brep, EdgeConvexity, EdgeKind, FaceRecord, parted
from querycad_segworker.vectors import OFF_ROUND, binned, cross, dist, dot, mean, sub, unit

MIN_TEETH = 6
"""Fewer repetitions are a bolt pattern or a polygon; the smallest pinions have six teeth or more."""
MIN_FACES_PER_TOOTH = 3
"""Two flanks and a tip at least; pointed teeth have flanks only."""
MIN_POINTED_TEETH = 12
"""Pointed teeth are fine, as those of serrations (DIN 5481: 28 and more), ratchets and knurls; fewer are a star."""
KNURL_TEETH = 20
KNURL_DEPTH = 0.1
"""Many pointed teeth that rise by less than this share of the radius are a knurl: DIN 82 has pitches of 0.5 to 1.6 mm,
and a profile about half as deep as its pitch."""

MAIN_FLANK = 0.5
"""Flanks larger than this share of the largest one are those that give a tooth its shape, not the radii at its foot."""
SQUARE = 1e-3
"""Walls of a slot are parallel, and along the axis, to this sine; cosines near one deviate by its square, and less."""

Ring = tuple[int, list[FaceRecord]]
"""How often faces repeat around an axis, and the faces."""


@dataclass(frozen=True, slots=True)
class Tooth:
    """One tooth: its faces, and the middle of its tip."""

    faces: tuple[int, ...]
    tip: Vector


@dataclass(frozen=True, slots=True)
class Gear:
    """A ring of equal teeth around an axis. Metres.

    `tip_radius` is the largest distance of tooth faces from the axis, `root_radius` the smallest; of an internal gear
    the tips are nearest the axis. `width` is measured along the axis.
    """

    axis: Axis
    teeth: tuple[Tooth, ...]
    tip_radius: float
    root_radius: float
    width: float
    center: Vector
    faces: tuple[int, ...]
    body: int
    internal: bool

    @property
    def is_knurl(self) -> bool:
        """Is it straight knurling: many low pointed teeth around the outside?"""
        pointed = all(len(tooth.faces) == 2 for tooth in self.teeth)
        low = self.tip_radius - self.root_radius < KNURL_DEPTH * self.tip_radius
        return pointed and low and not self.internal and len(self.teeth) >= KNURL_TEETH


def recognise_gears(brep: Brep, walls: Sequence[Wall], tolerances: Tolerances) -> list[Gear]:
    """Which gears, splines and other toothed rings does the model have? Sorted by lowest face id.

    Around each axis on which round walls lie, faces of one size, distance and height form a ring when they stand at
    equal angles. At least three such rings with the same count, touching each other, are teeth; what stands elsewhere
    on the axis, as a hexagon beside splines does, is counted for itself.
    """
    found: list[Gear] = []
    for body in brep.bodies:
        members = [brep.faces[i] for i in body.faces]
        if len(members) < MIN_TEETH * 2:
            continue
        for axis in main_axes([w for w in walls if w.body == body.id], tolerances):
            rings = _touching(brep, _without_windows(brep, _rings(members, axis, tolerances), axis))
            for together in _apart(brep, rings):
                gear = _gear(brep, together, axis, body.id, tolerances)
                if gear is not None and not any(set(gear.faces) & set(other.faces) for other in found):
                    found.append(gear)
    return sorted(found, key=lambda gear: gear.faces[0])


def main_axes(walls: Sequence[Wall], tolerances: Tolerances) -> list[Axis]:
    """On which axes do the most round faces lie? At most three: teeth stand around a main axis of their body.

    Axes are compared only when they pass a fixed point at about the same distance, as equal ones must.
    """
    full = [wall for wall in walls if wall.encloses]
    if not full:
        return []
    point = sub(full[0].axis.origin, (1.0, 1.7, 2.3))  # off any grid of holes
    reach = max(dist(wall.axis.origin, point) for wall in full)
    cell = 3 * (tolerances.length + tolerances.angle * reach)
    axes: list[Axis] = []
    weights: list[float] = []
    near: dict[int, list[int]] = defaultdict(list)
    for wall in full:
        key = round(wall.axis.radius_of(point) / cell)
        known = (i for k in (key - 1, key, key + 1) for i in near[k] if axes[i].same_line(wall.axis, tolerances))
        index = next(known, len(axes))
        if index == len(axes):
            axes.append(wall.axis)
            weights.append(0.0)
            near[key].append(index)
        weights[index] += wall.height * wall.radius
    heaviest = sorted(range(len(axes)), key=lambda i: -weights[i])
    return [axes[i] for i in heaviest[:3]]


def _gear(brep: Brep, rings: Sequence[Ring], axis: Axis, body: int, tolerances: Tolerances) -> Gear | None:
    if all(_looks_out(face, axis, tolerances) for _, ring in rings for face in ring):
        return None  # no flank rises between the flats of a nut
    # Two flanks a tooth may stand at nearly equal angles, and seem to repeat twice as often as the teeth.
    per_count: Counter[int] = Counter()
    for n in {count for count, _ in rings}:
        per_count[n] = sum(len(ring) // n for count, ring in rings if count in (n, 2 * n))
    teeth = max(per_count, key=lambda n: (per_count[n], n))
    chosen = [ring for _, ring in _touching(brep, [one for one in rings if one[0] in (teeth, 2 * teeth)])]
    per_tooth = sum(len(ring) for ring in chosen) / teeth
    ids = sorted(face.id for ring in chosen for face in ring)
    if not ids:
        return None
    points = [p for i in ids for e in brep.face_edges[i] for p in (brep.edges[e].start, brep.edges[e].mid)]
    radii = [axis.radius_of(p) for p in points]
    positions = [axis.position(p) for p in points]
    facing = [f for ring in chosen for f in ring if _is_coaxial(f, axis, tolerances)]
    inner = sum(f.outward < 0 and axis.radius_of(f.point) < (min(radii) + max(radii)) / 2 for f in facing)
    tips = min if inner > len(facing) / 2 else max
    single = [ring for ring in chosen if len(ring) == teeth]
    if per_tooth < MIN_FACES_PER_TOOTH:
        # The flanks of pointed teeth may be alike, and their number then twice that of the teeth.
        members = _pointed_teeth(brep, ids, axis, tips(radii))
        if len(members) < MIN_POINTED_TEETH or 2 * len(members) != len(ids):
            refuse("gear", ids, f"{teeth} times around, with {len(members)} pointed teeth")
            return None
    elif single:
        tops = tips(single, key=lambda ring: axis.radius_of(ring[0].point))
        if any(_is_bottom(brep, face, set(ids)) for face in tops):
            refuse("gear", ids, f"{teeth} slots cut into a round body: nothing stands out between them")
            return None
        if any(_is_floor(brep, brep.faces[i], axis, set(ids)) for i in ids):
            refuse("gear", ids, f"{teeth} pockets sunk into a face around the axis: flanks rise from their floors")
            return None
        flanks = [face for face in (brep.faces[i] for i in ids) if not _looks_out(face, axis, tolerances)]
        depth = max(radii) - min(radii)
        if _are_parallel(flanks, axis, depth if tips is max else -depth):
            slots = "slots with parallel walls: what is left between them widens outwards"
            ribs = "ribs with parallel sides: teeth widen to their root"
            refuse("gear", ids, f"{teeth} {slots if tips is max else ribs}")
            return None
        members = _teeth(chosen, tops, axis)
    else:
        refuse("gear", ids, f"{teeth} times around, but without one tip a tooth")
        return None
    middle = (min(positions) + max(positions)) / 2
    return Gear(
        axis=axis,
        teeth=members,
        tip_radius=tips(radii),
        root_radius=(max if tips is min else min)(radii),
        width=max(positions) - min(positions),
        center=axis.at(middle),
        faces=tuple(ids),
        body=body,
        internal=tips is min,
    )


def _looks_out(face: FaceRecord, axis: Axis, tolerances: Tolerances) -> bool:
    """Does it look straight away from the axis, as flats, chamfers and tips do and the flanks of teeth do not?"""
    around = cross(axis.direction, sub(face.point, axis.foot(face.point)))
    return _is_coaxial(face, axis, tolerances) or abs(dot(face.point_normal, unit(around))) < SQUARE


def _apart(brep: Brep, rings: Sequence[Ring]) -> list[list[Ring]]:
    """The rings in groups whose faces touch each other."""
    owner = {face.id: index for index, (_, ring) in enumerate(rings) for face in ring}

    def beside(index: int) -> set[int]:
        neighbours = (other for face in rings[index][1] for _, other in brep.neighbours(face.id))
        return {owner[other] for other in neighbours if other in owner}

    return [[rings[index] for index in sorted(group)] for group in parted(range(len(rings)), beside)]


def _touching(brep: Brep, rings: Sequence[Ring]) -> list[Ring]:
    """Those rings of which every face has two neighbours or more in one of them."""
    patterned = {face.id for _, ring in rings for face in ring}
    touching = {face for face in patterned if sum(other in patterned for _, other in brep.neighbours(face)) >= 2}
    return [(count, ring) for count, ring in rings if all(face.id in touching for face in ring)]


def _without_windows(brep: Brep, rings: Sequence[Ring], axis: Axis) -> list[Ring]:
    """Those rings whose faces are not walls of windows beside the axis: walls that touch and face each other."""
    faces = {face.id: face for _, ring in rings for face in ring}
    windows: set[int] = set()
    for ids in parted(sorted(faces), lambda face: {other for _, other in brep.neighbours(face)} & faces.keys()):
        together = [faces[i] for i in ids]
        middle = mean([face.point for face in together])
        beside = axis.radius_of(middle) > min(axis.radius_of(face.point) for face in together) / 2
        if beside and all(dot(face.point_normal, sub(middle, face.point)) > 0 for face in together):
            windows |= ids
    return [(count, ring) for count, ring in rings if not any(face.id in windows for face in ring)]


def _are_parallel(flanks: Sequence[FaceRecord], axis: Axis, depth: float) -> bool:
    """Are the largest flanks planes in parallel pairs, closer than they are deep?

    They face each other, or away from each other where `depth` is negative: those of slots, or of ribs. Gaps between
    teeth widen outwards, or are as wide as they are deep and more, and so are the teeth of internal splines.
    """
    largest = max((face.area for face in flanks), default=0.0)
    flanks = [face for face in flanks if face.area > MAIN_FLANK * largest]
    planes = [
        face for face in flanks if face.kind is SurfaceKind.PLANE and abs(dot(face.axis, axis.direction)) < SQUARE
    ]
    return bool(flanks) and len(planes) == len(flanks) and all(_has_wall_across(face, planes, depth) for face in planes)


def _has_wall_across(face: FaceRecord, planes: Sequence[FaceRecord], depth: float) -> bool:
    """Is another plane right across from this one, parallel to it and nearer than `depth`; behind it if negative?"""
    for other in planes:
        offset = sub(other.point, face.point)
        gap = math.copysign(1.0, depth) * dot(offset, face.axis)
        near = 0 < gap < abs(depth) and dist(other.point, face.point) < 1.1 * gap
        if near and dot(face.axis, other.axis) < SQUARE - 1:
            return True
    return False


def _is_bottom(brep: Brep, face: FaceRecord, own: set[int]) -> bool:
    """Do the others rise from this face, as the walls of a slot do from its floor?"""
    return any(
        edge.convexity is EdgeConvexity.CONCAVE and edge.kind is EdgeKind.LINE
        for edge, other in brep.neighbours(face.id)
        if other in own
    )


def _is_floor(brep: Brep, face: FaceRecord, axis: Axis, own: set[int]) -> bool:
    """Is it a plane square to the axis, from which the others rise? Teeth end in such planes, in convex edges."""
    if face.kind is not SurfaceKind.PLANE or abs(dot(face.axis, axis.direction)) < 1 - SQUARE:
        return False
    inner = [edge for edge, other in brep.neighbours(face.id) if other in own]
    return bool(inner) and all(edge.convexity is EdgeConvexity.CONCAVE for edge in inner)


def _rings(faces: Sequence[FaceRecord], axis: Axis, tolerances: Tolerances) -> list[Ring]:
    """Groups of alike faces that repeat around the axis, each with how often."""
    groups: dict[tuple[object, ...], list[FaceRecord]] = defaultdict(list)
    for face in faces:
        if axis.radius_of(face.point) > 10 * tolerances.length:
            groups[_signature(face, axis)].append(face)
    alike = [group for group in groups.values() if len(group) >= MIN_TEETH]
    periods = [(period([axis.angle_of(face.point) for face in group]), group) for group in alike]
    return [(count, group) for count, group in periods if count >= MIN_TEETH]


def _signature(face: FaceRecord, axis: Axis) -> tuple[object, ...]:
    """What stays the same when a face is turned about the axis; two digits, as converted files differ slightly."""
    radius = axis.radius_of(face.point)
    position = axis.position(face.point) / radius
    return face.kind, binned(face.area / radius**2, 2), binned(radius), round(position * OFF_ROUND, 1), len(face.loops)


def period(group: Sequence[float]) -> int:
    """How often do these angles repeat in one turn? One or two a tooth, as its flanks are alike; 0: no order."""
    angles = sorted(group)
    for per_tooth in (1, 2):
        count, rest = divmod(len(angles), per_tooth)
        pitch = 2 * math.pi / max(count, 1)
        ahead = [*angles[per_tooth:], *(angle + 2 * math.pi for angle in angles[:per_tooth])]
        if rest == 0 and all(abs(b - a - pitch) < 0.05 * pitch for a, b in zip(angles, ahead, strict=True)):
            return count
    return 0


def _is_coaxial(face: FaceRecord, axis: Axis, tolerances: Tolerances) -> bool:
    return face.kind is SurfaceKind.CYLINDER and axis.same_line(Axis.of(face), tolerances)


def _pointed_teeth(brep: Brep, faces: Sequence[int], axis: Axis, tip_radius: float) -> tuple[Tooth, ...]:
    """Teeth of two flanks that meet in an edge at the tip."""
    own = set(faces)
    found: dict[tuple[int, ...], Tooth] = {}
    for face in faces:
        for edge, other in brep.neighbours(face):
            at_tip = abs(axis.radius_of(edge.mid) - tip_radius) < 0.01 * tip_radius
            if other in own and at_tip and edge.convexity is EdgeConvexity.CONVEX:
                pair = tuple(sorted((face, other)))
                found[pair] = Tooth(pair, edge.mid)
    return tuple(found.values())


def _teeth(rings: Sequence[Sequence[FaceRecord]], tips: Sequence[FaceRecord], axis: Axis) -> tuple[Tooth, ...]:
    """Each face goes to the tooth whose tip is nearest by angle."""
    ordered = sorted(tips, key=lambda face: axis.angle_of(face.point))
    members: list[list[int]] = [[] for _ in ordered]
    pitch = 2 * math.pi / len(ordered)
    first = axis.angle_of(ordered[0].point)
    for ring in rings:
        for face in ring:
            turns = (axis.angle_of(face.point) - first) / pitch
            members[round(turns) % len(ordered)].append(face.id)
    return tuple(Tooth(tuple(sorted(ids)), face.point) for ids, face in zip(members, ordered, strict=True))
