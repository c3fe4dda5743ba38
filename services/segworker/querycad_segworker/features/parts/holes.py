"""Records of holes become parts: holes, their counterbores, countersinks and chamfers, dimples, patterns."""

from __future__ import annotations

import math
from collections.abc import Sequence
from dataclasses import replace

from querycad_contracts import Bottom, Part, PartKind, SurfaceKind, Vector
from querycad_segworker.features.depressions.dimples import Dimple
from querycad_segworker.features.holes.hole import RIM, Hole, Section, SectionKind
from querycad_segworker.features.shared.coaxial_stacks import roundings_beside
from querycad_segworker.features.shared.margins import edge_distance
from querycad_segworker.features.shared.part_measures import faces_area, faces_box, geometry, millimetres
from querycad_segworker.tolerances import FACING
from querycad_segworker.topology import Brep, EdgeConvexity
from querycad_segworker.vectors import box_extents, dist, dot, mid, scale, sub

from .patterns import Pattern, PatternKind

_HOLE_ADJECTIVES = ("oblique", "threaded", "countersunk", "counterbored", "spotfaced", "conical")
_SQUARE = math.radians(0.1)
"""Axes this far off a right angle are square: the angle of `Tolerances`."""
_SLACK = 1e-7
"""Metres. Sections that follow each other end and begin at one depth."""
_WIDER = (SectionKind.COUNTERBORE, SectionKind.SEAT, SectionKind.SPOTFACE)
_CUT_AT_A_HOLE = (*_WIDER, SectionKind.COUNTERSINK, SectionKind.CHAMFER)


def hole_part(brep: Brep, hole: Hole, number: int) -> Part:
    """A hole or ring groove as a part; the inside of a rim is a depression.

    A hole's width is that of its widest step, a groove's that of the gap; the diameter is that of the bore.
    """
    kind = "groove" if hole.is_ring else "depression" if RIM in hole.tags else "hole"
    adjective = next((tag for tag in _HOLE_ADJECTIVES if tag in hole.tags), None)
    form = {Bottom.THROUGH: "through", Bottom.BORE: "cross"}.get(hole.bottom, "blind")
    words = " ".join(word for word in (adjective, "" if hole.is_ring else form, kind) if word)
    widest = max((hole.opening_radius, hole.radius, *hole.steps))
    width = max((hole.radius, *hole.steps)) - hole.core_radius if hole.core_radius is not None else 2 * widest
    cones = [section for section in hole.sections if section.kind in (SectionKind.COUNTERSINK, SectionKind.BORE)]
    ends = {Bottom.THROUGH: "open at both ends", Bottom.BORE: "ending in another bore"}
    return Part(
        id=f"{kind}-{number}",
        kind=kind,
        tags=(*tuple(t for t in hole.tags if t not in ("through", "blind")), "ring", "annular")
        if hole.is_ring
        else hole.tags,
        label=f"{words}, diameter {millimetres(2 * hole.radius)}, depth {millimetres(hole.depth)}",
        faces=hole.faces,
        center=hole.center,
        extents=_whole_extents(brep, hole, 2 * widest),
        axis=hole.normal,
        normal=hole.normal,
        radius=hole.radius,
        diameter=2 * hole.radius,
        depth=hole.depth,
        width=width,
        mouth_width=width if hole.is_ring else 2 * hole.opening_radius,
        length=2 * widest,
        opening=hole.opening,
        bottom=hole.bottom,
        pitch=hole.pitch,
        local_size=(2 * widest, 2 * widest, hole.depth),
        angle=next(filter(None, (_angle(s, dist(s.start, s.end)) for s in cones)), None),
        volume=None if hole.is_ring else _volume(hole),
        area=faces_area(brep, hole.faces),
        radii=(hole.steps or (hole.radius,)) + (() if hole.core_radius is None else (hole.core_radius,)),
        edge_distance=edge_distance(brep, hole.faces, hole.opening, hole.normal, hole.opening_radius),
        children=() if hole.is_ring else tuple(_section_id(s, number, i) for i, s in enumerate(_cuts(hole), start=1)),
        evidence=geometry(
            f"{len(hole.faces)} face(s) around one axis: concave walls of radius "
            + ", ".join(millimetres(r) for r in (hole.steps or (hole.radius,)))
            + ", "
            + ends.get(hole.bottom, "open at one end")
        ),
    )


def _whole_extents(brep: Brep, hole: Hole, diameter: float) -> Vector:
    """Along x, y, z: square to its axis a bore is as wide as its diameter, also where a keyway took some wall."""
    x, y, z = (
        max(size, diameter) if abs(along) < _SQUARE else size
        for size, along in zip(box_extents(faces_box(brep, hole.faces)), hole.normal, strict=True)
    )
    return x, y, z


def _volume(hole: Hole) -> float | None:
    """What was cut out: the frustums of all walls, m3; none where the walls leave gaps, as at split faces."""
    total, along = 0.0, 0.0
    for section in hole.sections:
        height, r, s = dist(section.start, section.end), section.radius, section.end_radius
        total += math.pi * height * (r * r + r * s + s * s) / 3
        along += height if section.kind is not SectionKind.DRILL_POINT else 0.0
    return total if abs(along - hole.depth) < 0.02 * hole.depth else None


def hole_section_parts(brep: Brep, hole: Hole, number: int) -> list[Part]:
    """The counterbores, spot faces, countersinks and chamfers of a hole as parts, which the hole carries."""
    if hole.is_ring:
        return []
    return [
        section_part(brep, _unbroken(brep, hole, s), _section_id(s, number, i), f"hole {number}")
        for i, s in enumerate(_cuts(hole), start=1)
    ]


def _unbroken(brep: Brep, hole: Hole, section: Section) -> Section:
    """A counterbore as deep as it is drawn, from the face to its floor.

    The chamfer or round of its edge and the fillet of its floor are less deep than its wall.
    """
    if section.kind not in _WIDER:
        return section

    def depth_of(point: Vector) -> float:
        return dot(sub(section.start, point), section.normal)

    far = sub(hole.opening, scale(hole.normal, hole.depth))
    wall = depth_of(section.end)
    steps = [s for s in hole.sections if s.kind is not SectionKind.CHAMFER and s.faces != section.faces]
    ends = [max(depth_of(s.start), depth_of(s.end)) for s in steps]
    mouth = max([min(depth_of(hole.opening), depth_of(far)), *(end for end in ends if end < _SLACK)])
    beside = {i for face in section.faces for i in brep.beside(face, EdgeConvexity.CONCAVE)}
    fillets = {i for face in section.faces for i in roundings_beside(brep, face)}
    beside |= {i for fillet in fillets for i in brep.beside(fillet, EdgeConvexity.SMOOTH)}
    planes = brep.of_kind(SurfaceKind.PLANE, sorted(beside))
    floor = max((depth_of(p.point) for p in planes if dot(p.axis, section.normal) > FACING.parallel), default=wall)
    start = sub(section.start, scale(section.normal, min(mouth, 0.0))) if mouth > -wall else section.start
    end = sub(section.end, scale(section.normal, floor - wall)) if wall < floor < 2 * wall else section.end
    return replace(section, start=start, end=end)


def _cuts(hole: Hole) -> list[Section]:
    return [section for section in hole.sections if section.kind in _CUT_AT_A_HOLE]


def _section_id(section: Section, number: int, i: int) -> str:
    return f"{section.kind.value}-h{number}.{i}"


def section_part(brep: Brep, section: Section, part_id: str, owner: str, *, outer: bool = False) -> Part:
    """A counterbore, countersink or chamfer around an axis as a part.

    Its diameter is the widest, its depth (and length) runs along the axis, a chamfer's width across its face.
    """
    name, seat = section.kind.value, section.kind is SectionKind.SEAT
    depth = dist(section.start, section.end)
    widest = max(section.radius, section.end_radius)
    flat, wider = section.radius == section.end_radius, section.kind in _WIDER
    tags = ["circular", "outer" if outer else "inner", "cylindrical" if flat else "conical"]
    if section.kind in (SectionKind.CHAMFER, SectionKind.COUNTERSINK):
        tags.append("beveled")
    if seat:
        tags.append("seat")
    return Part(
        id=part_id,
        kind=PartKind.COUNTERBORE if seat else PartKind(name),
        tags=tuple(tags),
        label=f"{name} of {owner}, diameter {millimetres(2 * widest)}, depth {millimetres(depth)}",
        faces=section.faces,
        center=mid(section.start, section.end),
        extents=box_extents(faces_box(brep, section.faces)),
        axis=section.normal,
        normal=section.normal,
        radius=widest,
        diameter=2 * widest,
        depth=depth,
        length=depth,
        width=2 * widest if flat or wider else math.hypot(depth, section.radius - section.end_radius),
        mouth_width=2 * section.radius if wider and not flat else None,
        bottom_width=2 * section.end_radius if wider and not flat else None,
        opening=None if outer else section.start,
        bottom=None if outer else Bottom.OPEN,
        area=faces_area(brep, section.faces),
        radii=(section.radius,) if flat else (section.radius, section.end_radius),
        angle=_angle(section, depth),
        evidence=geometry(f"a {'cylinder' if flat else 'cone'} around the axis of {owner}, wider than its bore")
        if not outer
        else geometry(f"a cone around the axis of {owner} that breaks its edge"),
    )


def _angle(section: Section, depth: float) -> float | None:
    """All of the cone of a countersink or tapered bore; of a chamfer, between it and the face whose edge it breaks."""
    wider = abs(section.radius - section.end_radius)
    if section.kind is SectionKind.CHAMFER:
        return math.atan2(depth, wider)
    return 2 * math.atan2(wider, depth) if wider else None


def dimple_part(brep: Brep, found: Dimple, number: int) -> Part:
    """A dimple as a part: its radius is that of the ball, its diameter and width those of its rim."""
    return Part(
        id=f"dimple-{number}",
        kind="dimple",
        tags=("blind", "circular", "spherical", "inner"),
        label=f"dimple, diameter {millimetres(2 * found.rim_radius)}, depth {millimetres(found.depth)}",
        faces=found.faces,
        center=mid(found.opening, found.bottom),
        extents=box_extents(faces_box(brep, found.faces)),
        axis=found.normal,
        normal=found.normal,
        radius=found.ball_radius,
        diameter=2 * found.rim_radius,
        width=2 * found.rim_radius,
        depth=found.depth,
        opening=found.opening,
        bottom=Bottom.SPHERICAL,
        area=faces_area(brep, found.faces),
        radii=(found.ball_radius,),
        evidence=geometry("a concave sphere that a circular convex rim bounds, with no bore above it"),
    )


_PATTERN_NAMES = {
    PatternKind.CIRCLE: "bolt circle",
    PatternKind.ROW: "linear pattern",
    PatternKind.GRID: "grid pattern",
    PatternKind.RECTANGLE: "rectangular pattern",
}


def pattern_part(found: Pattern, number: int, members: Sequence[Part]) -> Part:
    """A pattern of like holes, cutouts or standoffs as a part that carries them.

    A bolt circle's diameter is its pitch circle's, its pitch the distance of neighbours; a grid's pitch is the smaller
    of its two, its length and width run from the first to the last centre.
    """
    noun = members[0].kind
    name = _PATTERN_NAMES[found.kind]
    faces = tuple(sorted({face for part in members for face in part.faces}))
    low = [min(p.center[i] - p.extents[i] / 2 for p in members) for i in range(3)]
    high = [max(p.center[i] + p.extents[i] / 2 for p in members) for i in range(3)]
    on_circle = found.radius is not None
    return Part(
        id=f"pattern-{number}",
        kind="pattern",
        tags=(found.kind.value, noun, *(("circular",) if on_circle else ("rectangular",))),
        label=f"{name} of {len(members)} x {members[0].label.split(',')[0]}, "
        + (f"diameter {millimetres(2 * (found.radius or 0.0))}" if on_circle else f"pitch {millimetres(found.pitch)}"),
        faces=faces,
        center=found.center,
        extents=(high[0] - low[0], high[1] - low[1], high[2] - low[2]),
        axis=found.normal,
        normal=found.normal,
        radius=found.radius,
        diameter=None if found.radius is None else 2 * found.radius,
        length=found.length,
        width=found.width,
        pitch=found.pitch,
        count=len(members),
        children=tuple(part.id for part in members),
        evidence=geometry(f"{len(members)} alike parts at equal distances, all facing one way"),
    )
