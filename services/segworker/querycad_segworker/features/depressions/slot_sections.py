"""Slots by their cross-section: V, T, dovetail, and the keyseat of a Woodruff key."""

from __future__ import annotations

import math
from collections.abc import Collection, Iterator, Sequence
from dataclasses import dataclass, replace

from querycad_contracts import SurfaceKind, Vector
from querycad_segworker.features.shared.adjacency import breaks_edge
from querycad_segworker.features.shared.extruded_walls import first_of_surface
from querycad_segworker.features.shared.frames import frame_of
from querycad_segworker.features.shared.refusals import refuse
from querycad_segworker.topology import Brep, EdgeConvexity, FaceRecord
from querycad_segworker.vectors import add, cross, dot, line_distance, norm, parallel, scale, span, sub, unit

from .depression import Depression, DepressionKind, depression_in

DRAFT_RAD = math.radians(10.0)
"""Walls may lean by this draft angle and still stand square on their floor."""
MAX_LEAN = math.sin(math.radians(50.0))
"""Flanks that lean more than this are ramps; dovetails have flanks of 45 to 60 degrees to the floor."""
V_ANGLE_RAD = (math.radians(3.0), math.radians(160.0))
"""Two faces that enclose less or more than this are a crack or a bend, no groove with a V section."""
NARROW_RAD = math.radians(44.0)
"""Floor and flank of a step that is undercut like a dovetail enclose 45 degrees at least: what encloses less is a V
groove, also where another cut has taken what lay beside a flank. Not so over a round: the inside of a bent strap."""
SAME_WAY = math.cos(math.radians(45.0))
"""The two faces beside a groove face the same way; those beside a step face at right angles to each other."""
FLARE = math.cos(math.radians(44.0))
"""What a groove is cut into looks its way; beside a step cut square into a block lie faces at 45 degrees to that."""
SQUARE = 0.05
"""Cosine: faces that lean less than 3 degrees off square to each other are square."""
BEYOND = 2.0
"""So many times as large as a chamfer is what lies beyond it; a land beside a V groove may end at one itself."""
MUCH = 0.25
"""A face that ends a flank over less than this share of its length is what another cut left there."""

LEVEL_RIMS = 0.8
"""The flanks of a dovetail end at one face, so they are equally high, but for a chamfer along one of them."""
DISC_RAD = math.radians(270.0)
"""A disc whose middle lies below the surface cuts more than half a turn; hardly so much that it could not come out."""
NECK_SHARE = 1 / 3
"""The mouth of a dovetail or T slot is at least this share as wide as its bottom: what slides in it has to pull. T
slots of DIN 650 have half. A narrower mouth is where another cut opens a pocket."""

Pair = tuple[FaceRecord, FaceRecord]


@dataclass(frozen=True, slots=True)
class Undercut:
    """What lies under the lips of a T slot or dovetail. Metres, radians."""

    tag: str
    neck_width: float
    neck: frozenset[int]
    """Faces of the neck, which convex edges part from the rest."""
    angle: float | None
    """Between the flanks and the floor of a dovetail."""


def facing_pair(walls: Sequence[FaceRecord], normal: Vector | None) -> Pair | None:
    """The largest two walls that look at each other across a floor with this normal; leaning ones only with it."""
    best: Pair | None = None
    for i, a in enumerate(walls):
        for b in walls[i + 1 :]:
            if _face_each_other(a, b, normal) and (best is None or a.area + b.area > best[0].area + best[1].area):
                best = (a, b)
    return best


def _face_each_other(a: FaceRecord, b: FaceRecord, normal: Vector | None) -> bool:
    if normal is not None and max(abs(dot(a.axis, normal)), abs(dot(b.axis, normal))) > MAX_LEAN:
        return False
    side_a, side_b = (_level(wall.axis, normal) for wall in (a, b))
    return dot(side_a, side_b) < -math.cos(DRAFT_RAD) and dot(sub(b.point, a.point), side_a) > 0


def _level(direction: Vector, normal: Vector | None) -> Vector:
    """The direction within the plane across `normal`."""
    return direction if normal is None else unit(sub(direction, scale(normal, dot(direction, normal))))


def gap_between(brep: Brep, pair: Pair, floor: FaceRecord) -> float:
    """How wide is a slot between two walls, in metres? Where walls lean, at their upper rims."""
    side = _level(pair[0].axis, floor.axis)
    if all(abs(dot(wall.axis, floor.axis)) < 1e-3 for wall in pair):
        return abs(dot(sub(pair[1].point, pair[0].point), side))
    rims = []
    for wall in pair:
        ends = [p for e in brep.face_edges[wall.id] for p in (brep.edges[e].start, brep.edges[e].end)]
        top = max(ends, key=lambda p: dot(p, floor.axis))
        rims.append(dot(top, side))
    return abs(rims[1] - rims[0])


def gap_on(floor: FaceRecord, pair: Pair) -> float:
    """How far apart do two walls meet the plane of a floor, in metres, also where fillets hide that?"""
    side = _level(pair[0].axis, floor.axis)
    a, b = (dot(sub(wall.point, floor.point), wall.axis) / dot(side, wall.axis) for wall in pair)
    return abs(a - b)


def undercut(brep: Brep, group: Collection[int], floor: FaceRecord, pair: Pair) -> Undercut | None:
    """Is the slot wider below than at its mouth? A T slot by lips above it, a dovetail by leaning flanks."""
    leans = [dot(wall.axis, floor.axis) for wall in pair]
    if all(lean < -math.sin(DRAFT_RAD) for lean in leans):
        neck = _dovetail_neck(brep, floor, pair)
        if neck is None:
            return None
        return Undercut("dovetail", neck, frozenset(), math.acos(min(1.0, -leans[0])))
    lips = []
    for wall in pair:
        over = {j for i in brep.beside(wall.id, EdgeConvexity.SMOOTH) for j in brep.beside(i, EdgeConvexity.SMOOTH)}
        above = [brep.faces[i] for i in group if i in over.union(brep.beside(wall.id, EdgeConvexity.CONCAVE))]
        above = [face for face in above if dot(face.axis, floor.axis) < -math.cos(DRAFT_RAD)]
        if not above:
            return None
        lips.append(max(above, key=lambda face: face.area))
    necks = _necks(brep, lips, pair)
    if necks is None:
        return None
    width = abs(dot(sub(necks[1].point, necks[0].point), pair[0].axis))
    points = [p for e in brep.face_edges[floor.id] for p in (brep.edges[e].start, brep.edges[e].end)]
    low, high = span(points, unit(cross(pair[0].axis, floor.axis)))
    if high - low < gap_between(brep, pair, floor):
        refuse("slot", (floor.id, *(wall.id for wall in (*pair, *lips))), "shorter than wide: a pocket with a notch")
        return None
    if width < NECK_SHARE * gap_between(brep, pair, floor):
        refuse("slot", (floor.id, *(wall.id for wall in (*pair, *lips))), "too narrow between its lips for a T slot")
        return None
    return Undercut("t_slot", width, frozenset(neck.id for neck in necks), None)


def _dovetail_neck(brep: Brep, floor: FaceRecord, pair: Pair) -> float | None:
    """How wide is the mouth between leaning flanks, in metres? None where it is no dovetail's.

    Then the walls are those of a triangle that another cut has opened: at a corner, which leaves a narrow mouth, or
    askew.
    """
    side = _level(pair[0].axis, floor.axis)
    rims = []
    for wall in pair:
        ends = [p for e in brep.face_edges[wall.id] for p in (brep.edges[e].start, brep.edges[e].end)]
        rims.append(max(ends, key=lambda p: dot(p, floor.axis)))
    heights = [dot(sub(rim, floor.point), floor.axis) for rim in rims]
    neck = abs(dot(sub(rims[1], rims[0]), side))
    leans = sum(h * abs(dot(w.axis, floor.axis)) / abs(dot(w.axis, side)) for h, w in zip(heights, pair, strict=True))
    if min(heights) < LEVEL_RIMS * max(heights) or neck < NECK_SHARE * (neck + leans):
        refuse("slot", (floor.id, pair[0].id, pair[1].id), "its leaning walls leave no mouth that a dovetail has")
        return None
    return neck


def _necks(brep: Brep, lips: Sequence[FaceRecord], pair: Pair) -> Pair | None:
    """The two walls between the lips of a T slot and its mouth."""
    found = []
    for lip, wall in zip(lips, pair, strict=True):
        outline = {e for loop in lip.loops if loop.outer for e in loop.edges}  # a window in the lip is no mouth
        around = [(edge, brep.faces[i]) for edge, i in brep.neighbours(lip.id) if edge.id in outline]
        beside = [face for edge, face in around if edge.convexity is EdgeConvexity.CONVEX]
        beside = [f for f in (*beside, *over_edge_break(brep, lip)) if dot(f.axis, wall.axis) > math.cos(DRAFT_RAD)]
        if not beside:
            return None
        found.append(max(beside, key=lambda face: face.area))
    a, b = found
    return (a, b) if _face_each_other(a, b, None) else None


def v_slot(brep: Brep, group: set[int], planes: Sequence[FaceRecord]) -> Depression | None:
    """Two flanks that meet at the bottom, also over a small round, and end at two faces that face the same way.

    A wall at right angles to both may close an end.
    """
    owners = first_of_surface(planes)
    flanks = [plane for plane in planes if owners[plane.id] == plane.id]
    if not 2 <= len(flanks) <= 4 or len(group) > len(planes) + 1:
        return None
    pieces = {flank.id: [plane for plane in planes if owners[plane.id] == flank.id] for flank in flanks}
    for i, a in enumerate(flanks):
        for b in flanks[i + 1 :]:
            ends = [flank for flank in flanks if flank.id not in (a.id, b.id)]
            slot = _v_between(brep, group, pieces[a.id], pieces[b.id], ends)
            if slot is not None:
                return slot
    return None


def _v_between(
    brep: Brep, group: set[int], a: Sequence[FaceRecord], b: Sequence[FaceRecord], ends: Sequence[FaceRecord]
) -> Depression | None:
    """`a` and `b`: the pieces of two flanks, which other cuts may have parted."""
    along = unit(cross(a[0].axis, b[0].axis))
    normal = unit(add(a[0].axis, b[0].axis))
    opening_angle = math.pi - math.acos(max(-1.0, min(1.0, dot(a[0].axis, b[0].axis))))
    if norm(along) == 0 or not V_ANGLE_RAD[0] < opening_angle < V_ANGLE_RAD[1]:
        refuse("slot", group, "two flanks that enclose too much or too little for a V groove")
        return None
    if any(not parallel(end.axis, along, math.sin(DRAFT_RAD)) for end in ends):
        return None
    if abs(dot(a[0].axis, b[0].axis)) < SQUARE and _is_step(brep, a, b) and _is_step(brep, b, a):
        return None
    first, second = ([face for piece in flank for face in _beside(brep, piece, along, normal)] for flank in (a, b))
    same_way = any(dot(f.axis, s.axis) > SAME_WAY for f in first for s in second)
    is_sharp = all(brep.faces[i].kind is SurfaceKind.PLANE for i in group)
    if not same_way and not (is_sharp and opening_angle < NARROW_RAD):
        return None
    frame = frame_of(brep, group, normal, None, along)
    slot = depression_in(DepressionKind.SLOT, "triangular", frame, group, (), a[0].body, is_open=True)
    mouth = dot(slot.opening, normal)
    level = [dot(face.point, normal) - mouth for face in (*first, *second) if parallel(face.axis, normal, SQUARE)]
    rise = max(level, default=0.0) if len(level) > 1 and max(level) - min(level) < SQUARE * slot.depth else 0.0
    depth = slot.depth + max(rise, 0.0)  # to the face that it is cut into, over the chamfers or rounds of its edges
    width = slot.width + 2 * (depth - slot.depth) * math.tan(opening_angle / 2)
    return replace(slot, tags=("v_shaped",), angle=opening_angle, depth=depth, width=width)


def _is_step(brep: Brep, flank: Sequence[FaceRecord], other: Sequence[FaceRecord]) -> bool:
    """Does a flank end at an edge break with a face along the other flank beyond, as beside a step?"""
    return any(
        dot(face.axis, other[0].axis) > math.cos(DRAFT_RAD) for piece in flank for face in over_edge_break(brep, piece)
    )


def over_edge_break(brep: Brep, wall: FaceRecord) -> list[FaceRecord]:
    """The planes beyond the chamfers and rounds along the edges of a plane wall.

    A chamfer is less wide than the wall is high and than what lies beyond, so its area is much less.
    """
    around = [(edge, brep.faces[i]) for edge, i in brep.neighbours(wall.id)]
    bevels = [other for edge, other in around if breaks_edge(brep, wall, edge, other)]
    beyond = [(bevel, brep.faces[i]) for bevel in bevels for _, i in brep.neighbours(bevel.id) if i != wall.id]
    return [face for bevel, face in beyond if face.kind is SurfaceKind.PLANE and face.area > BEYOND * bevel.area]


def with_run_outs(brep: Brep, cut: Depression) -> Depression:
    """As long as it is drawn, a step also as wide: over the chamfers and rounds at which an open cut ends at its body.

    These are narrower than the cut.
    """
    planes = brep.of_kind(SurfaceKind.PLANE, cut.faces) if cut.is_open else ()
    ends = [end for face in planes for end in over_edge_break(brep, face)]
    length, cut = _over_breaks(cut, ends, cut.direction, cut.length)
    across = unit(cross(cut.normal, cut.direction))
    width, cut = _over_breaks(cut, ends, across, cut.width) if cut.kind is DepressionKind.STEP else (cut.width, cut)
    return replace(cut, length=length, width=width)


def _over_breaks(cut: Depression, ends: Sequence[FaceRecord], way: Vector, size: float) -> tuple[float, Depression]:
    """The size of a cut along a direction, up to planes square to it, and the cut with its middle there. Metres."""
    off = [dot(sub(end.point, cut.center), way) for end in ends if parallel(end.axis, way, SQUARE)]
    half = size / 2
    low, high = (max((abs(d) for d in off if half < s * d < half + cut.width), default=half) for s in (-1.0, 1.0))
    shift = scale(way, (high - low) / 2)
    return low + high, replace(cut, center=add(cut.center, shift), opening=add(cut.opening, shift))


def relieved_vees(brep: Brep, found: Sequence[Depression]) -> Iterator[Depression]:
    """V grooves with a relief slot along the bottom, as in V blocks: the walls of the slot end at their flanks.

    The slot is narrower than the flanks: else those are what breaks its edges.
    """
    for slot in found:
        walls = [face for face in brep.of_kind(SurfaceKind.PLANE, slot.faces) if face.id not in slot.floor]
        pair = facing_pair(walls, None) if slot.kind is DepressionKind.SLOT and slot.is_open else None
        flanks = [_flank(brep, wall, slot) for wall in pair or ()]
        a, b = (*flanks, None, None)[:2]
        if a is None or b is None or dot(sub(b.point, a.point), _level(a.axis, slot.normal)) <= 0:
            continue
        vee = _v_between(brep, {a.id, b.id}, [a], [b], [])
        if vee is not None and vee.depth > slot.width / 2 and vee.width > 2 * slot.width:
            yield vee


def _flank(brep: Brep, wall: FaceRecord, slot: Depression) -> FaceRecord | None:
    """The largest plane that leans away from the mouth of a slot above its wall."""
    beside = [
        brep.faces[other]
        for edge, other in brep.neighbours(wall.id)
        if edge.convexity is EdgeConvexity.CONVEX
        and abs(dot(sub(edge.end, edge.start), slot.direction)) > 0.98 * edge.length
    ]
    leaning = [
        face
        for face in beside
        if face.kind is SurfaceKind.PLANE and math.sin(DRAFT_RAD) < dot(face.axis, slot.normal) < math.cos(DRAFT_RAD)
    ]
    return max(leaning, key=lambda face: face.area, default=None)


def _beside(brep: Brep, flank: FaceRecord, along: Vector, out: Vector) -> list[FaceRecord]:
    """The planes that face out of a groove, and that its flank ends at over much of its length or a broken edge."""
    bounds: list[tuple[float, FaceRecord]] = []
    for edge, other in brep.neighbours(flank.id):
        face = brep.faces[other]
        runs_along = abs(dot(sub(edge.end, edge.start), along)) > 0.98 * edge.length
        if edge.convexity is EdgeConvexity.CONVEX and face.kind is SurfaceKind.PLANE and runs_along:
            bounds.append((edge.length, face))
    longest = max((length for length, _ in bounds), default=0.0)
    ends = [face for length, face in bounds if length > MUCH * longest] + over_edge_break(brep, flank)
    return [face for face in ends if dot(face.axis, out) > FLARE]


def woodruff(brep: Brep, group: set[int], planes: Sequence[FaceRecord]) -> Depression | None:
    """Two parallel walls on a floor that is part of a cylinder across them: cut by a disc, as for a Woodruff key.

    Where the walls end at a cylinder about the same axis it is a groove in half a bore, as deep as it is larger.
    """
    rounds = brep.of_kind(SurfaceKind.CYLINDER, group)
    if len(planes) != 2 or len(rounds) != 1 or not parallel(rounds[0].axis, planes[0].axis, 1e-2):
        return None
    bottom = rounds[0]
    pair = facing_pair(planes, None)
    if pair is None:
        return None
    if abs(dot(sub(pair[1].point, pair[0].point), pair[0].axis)) > 2 * bottom.radius:
        refuse("slot", group, "it is wider than the disc that would have cut it")
        return None
    if bottom.sweep > DISC_RAD:
        refuse("slot", group, "its bottom goes around its axis: a groove in a bore that another one opens")
        return None
    frame = frame_of(brep, group, bottom.point_normal, None, unit(cross(bottom.axis, bottom.point_normal)))
    slot = depression_in(DepressionKind.SLOT, "rectangular", frame, group, (bottom.id,), bottom.body, is_open=True)
    around = {i for wall in pair for i in brep.beside(wall.id, EdgeConvexity.CONVEX)}
    bores = brep.of_kind(SurfaceKind.CYLINDER, around)
    bore = next((one for one in bores if _coaxial(one, bottom)), None)
    if bore is not None:
        return replace(slot, corner_radius=bottom.radius, depth=bottom.radius - bore.radius)
    return replace(slot, corner_radius=bottom.radius, tags=("woodruff",))


def _coaxial(a: FaceRecord, b: FaceRecord) -> bool:
    return parallel(a.axis, b.axis, 1e-2) and line_distance(a.origin, b.origin, b.axis) < SQUARE * a.radius
