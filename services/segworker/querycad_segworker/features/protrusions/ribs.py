"""Ribs and fins: thin walls that stand on the material, with a narrow top face."""

from __future__ import annotations

import math
from collections import Counter
from collections.abc import Sequence, Set
from dataclasses import dataclass, replace

from querycad_contracts import SurfaceKind, Vector
from querycad_segworker.features.shared.reach import edges_span, faces_span
from querycad_segworker.features.shared.refusals import refuse
from querycad_segworker.tolerances import FACING, Tolerances, exceeds
from querycad_segworker.topology import Brep, EdgeConvexity, EdgeRecord, FaceRecord
from querycad_segworker.vectors import add, cross, dist, dot, parallel, scale, sub, unit

from .protrusions import RIB_RATIO

RIGHT_ANGLE = (math.radians(75.0), math.radians(105.0))
"""The flanks of a rib stand about square on its top; casting drafts are below 15 degrees."""
MAX_RISE = math.sin(math.radians(45.0))
"""A foot runs along the top; concave edges that rise towards it are the corners of a cut beside it."""
EDGE_BREAK = 0.1
"""Flanks that end apart by less than this share of their length differ by an edge break; else one runs on past."""
NEAR_FOOT = 0.02
"""What lies below the foot by less than this share of the rib's height still counts as its foot."""
HALF_ROUND = math.radians(150.0)
"""The round top of an ear covers at least so much: half a circle, less what its sides lean towards each other."""
NARROW = math.radians(30.0)
"""The tip of a rib in a bore covers less than this of it: within its sides, an arc so short bulges by a fifteenth."""
LOW, LONG = 1 / 3, 5.0
"""What is lower than thick is a rib as long as it is higher than this share of its thickness and so many times longer
than thick: ribs of moulded parts, and ridges. Lower still are strips and pads."""
TOUCHED = 1 / 3
"""A rib stands on at least this share of its length on either side: a wall that a lug or block touches goes on past
that on both sides, so the lug takes less than a third of it."""
FOOTED = 0.5
"""A low rib stands on more than this share of its length: a pin beside a notch stands on its end."""
OWN = 1.5
"""The flanks of a low rib are its own: no larger than so many times its height by its length. The large faces of a
plate that stands out a little at its edge are not."""
ALIKE = 0.3
"""Of two sides of a rib, the shorter one meets the top along more than this share of the longer one."""
LEAF = 0.5
"""Flanks with more than this share of their body's surface, on barrels only, are the two sides of what the body is."""
FINS = 3
"""So many ribs alike, side by side, are fins."""


@dataclass(frozen=True, slots=True)
class Rib:
    """One rib or fin. Metres. `thickness` is between its flanks, `height` from its lower foot to its top."""

    thickness: float
    height: float
    length: float
    normal: Vector
    direction: Vector
    center: Vector
    tip: Vector
    top: int
    flanks: tuple[int, ...]
    """Those that end at its foot: two, or the inner one of an outermost fin."""
    body: int

    @property
    def faces(self) -> tuple[int, ...]:
        """All its faces."""
        return tuple(sorted((self.top, *self.flanks)))


def recognise_lugs(brep: Brep, tolerances: Tolerances) -> list[Rib]:
    """Which walls longer and higher than thick stand on the model, ribs among them? Sorted by lowest face id.

    Ears with round tops are among them.
    """
    return _standing_walls(brep, tolerances, 1.0, round_tops=True)


def recognise_ribs(brep: Brep, tolerances: Tolerances) -> list[Rib]:
    """Which ribs does the model have? Sorted by lowest face id.

    A rib is a plane top face with two parallel flanks that face away from each other, each meeting the top in a
    convex edge and the material below in a concave one, thin against its height and length. The outermost fins of a
    row may be flush with what they stand on: there the outer flank has no foot of its own. The leaf of a hinge is no
    rib of its barrels.
    """
    return _standing_walls(brep, tolerances, RIB_RATIO)


def _standing_walls(brep: Brep, tolerances: Tolerances, ratio: float, *, round_tops: bool = False) -> list[Rib]:
    """Walls on the material that are longer than thick by this ratio."""
    standing, flush = [], []
    tops = [face for face in brep.faces if face.kind is SurfaceKind.PLANE]
    tops += [_crown(face) for face in brep.faces if _is_narrow_inside(face)]
    if round_tops:
        tops += [_crown(face) for face in brep.faces if _is_round_top(brep, face)]
    for top in tops:
        sides = _sides(brep, top)
        footed = {face.id for _, face in sides if _feet(brep, face, top)}
        pairs = _pairs(sides, footed)
        standing += [_rib(brep, top, pair, {pair[0].id, pair[1].id}, ratio) for pair in pairs]
        if not pairs and (flanks := _flush_pair(sides, footed)) is not None:
            flush.append(_rib(brep, top, flanks, {f.id for f in flanks if f.id in footed}, ratio))
    ribs = _widest_tops(brep, [rib for rib in standing if rib is not None])
    if ratio >= RIB_RATIO:
        ribs = [rib for rib in ribs if not _is_leaf(brep, rib)]
    ends = [end for end in flush if end is not None and any(_same_row(brep, end, rib, tolerances) for rib in ribs)]
    row = [*ribs, *ends]
    ends = [end for end in ends if sum(_same_row(brep, end, rib, tolerances) for rib in row) >= FINS]
    return sorted([*ribs, *ends], key=lambda rib: rib.faces[0])


def _is_narrow_inside(face: FaceRecord) -> bool:
    """Is it a piece of the inside of a bore so narrow that it is nearly flat: the tip of a rib that stands inwards?"""
    return face.kind is SurfaceKind.CYLINDER and face.outward < 0 and face.sweep < NARROW


def _is_round_top(brep: Brep, face: FaceRecord) -> bool:
    """Is it the top of an ear: about half an outer cylinder that runs on into two plane sides?"""
    if face.kind is not SurfaceKind.CYLINDER or face.outward < 0:
        return False
    if not HALF_ROUND <= face.sweep <= math.pi + (math.pi - HALF_ROUND):
        return False
    sides = {
        other
        for edge, other in brep.neighbours(face.id)
        if edge.convexity is EdgeConvexity.SMOOTH and parallel(edge.direction, face.axis, 1e-2)
    }
    return len(sides) == 2 and all(brep.faces[side].kind is SurfaceKind.PLANE for side in sides)


def _crown(top: FaceRecord) -> FaceRecord:
    """A round top as the plane that touches it in its middle."""
    return replace(top, kind=SurfaceKind.PLANE, axis=top.point_normal)


def _rib(brep: Brep, top: FaceRecord, flanks: tuple[FaceRecord, FaceRecord], own: set[int], ratio: float) -> Rib | None:
    """The rib under a top face, or None where it is not thin. `own`: those of its flanks that end at its foot.

    It reaches as high as both flanks rise above a foot, and as far as both go on side by side there: what else is level
    with one of them is not its.
    """
    a, b = flanks
    out, along = top.axis, unit(cross(a.axis, top.axis))
    thickness = dot(sub(a.point, b.point), a.axis)
    level = faces_span(brep, (top.id,), out)[1]
    feet = [_foot(brep, flank, top) for flank in flanks if flank.id in own]
    foot = max(known for known in feet if known is not None)
    low, high = _side_by_side(*(_reach(brep, flank, along, out, foot) for flank in flanks))
    height, length = level - foot, high - low
    if thickness <= 0 or length <= 0:
        return None
    small = all(flank.area < OWN * height * length for flank in flanks)
    stands = min(sum(run for run, _ in _feet(brep, f, top)) for f in flanks if f.id in own) / length
    if stands < TOUCHED:
        refuse("rib", {top.id, *own}, "what it stands on is short: a wall that something touches")
        return None
    may_be_low = small and stands > FOOTED and ratio >= RIB_RATIO
    is_ridge = may_be_low and height > LOW * thickness and length > LONG * thickness
    if (height < thickness and not is_ridge) or length < ratio * thickness:
        short = "high" if height < thickness else "long"
        refuse("rib", {top.id, *own}, f"it is too thick for what it is {short}")
        return None
    across, middle = unit(cross(out, along)), (foot + level) / 2
    # Flanks with draft lean: each is where its plane is at mid height.
    side = sum((dot(f.point, f.axis) - middle * dot(out, f.axis)) / dot(across, f.axis) for f in flanks) / 2
    x, y, z = (scale(d, s) for d, s in ((along, (low + high) / 2), (across, side), (out, middle)))
    center = add(add(x, y), z)
    return Rib(
        thickness=thickness,
        height=height,
        length=length,
        normal=out,
        direction=along,
        center=center,
        tip=add(center, scale(out, height / 2)),
        top=top.id,
        flanks=tuple(sorted(own)),
        body=top.body,
    )


def _is_leaf(brep: Brep, rib: Rib) -> bool:
    """Are the flanks most of their body, and end only at outer cylinders? A plate with rolled edges, as of a hinge."""
    ends = {
        other
        for flank in rib.flanks
        for edge, other in brep.neighbours(flank)
        if edge.convexity is EdgeConvexity.CONCAVE and parallel(edge.direction, rib.direction, 1e-2)
    }
    on_rounds = all(brep.faces[i].kind is SurfaceKind.CYLINDER and brep.faces[i].outward > 0 for i in ends)
    area = sum(brep.faces[flank].area for flank in rib.flanks)
    if bool(ends) and on_rounds and exceeds(area, LEAF * brep.bodies[rib.body].area):
        refuse("rib", rib.faces, "it is most of the body, and carries the barrels that it ends at")
        return True
    return False


def _foot(brep: Brep, flank: FaceRecord, top: FaceRecord) -> float | None:
    """At which position along the top's normal is the flank's foot: the longest edge it stands on?"""
    return max(_feet(brep, flank, top), default=(0.0, None), key=lambda foot: foot[0])[1]


def _reach(brep: Brep, flank: FaceRecord, along: Vector, out: Vector, foot: float) -> tuple[float, float]:
    """From where to where along the rib does a flank go above the foot?"""
    edges = brep.face_edges[flank.id]
    level = foot - NEAR_FOOT * (edges_span(brep, edges, out)[1] - foot)
    whole = [e for e in edges if edges_span(brep, (e,), out)[0] >= level]
    above = list(edges_span(brep, whole, along)) if whole else []
    for start, middle, end in (brep.edges[e].points for e in edges if e not in whole):
        for a, b in ((start, middle), (middle, end)):
            at_a, at_b = dot(a, out) - level, dot(b, out) - level
            above += [dot(p, along) for p, at in ((a, at_a), (b, at_b)) if at >= 0]
            if at_a * at_b < 0:
                above.append(dot(add(a, scale(sub(b, a), at_a / (at_a - at_b))), along))
    return min(above), max(above)


def _side_by_side(a: tuple[float, float], b: tuple[float, float]) -> tuple[float, float]:
    """From where to where do two flanks go together? Where one ends a little earlier, to the end of the other."""
    shorter = min(a[1] - a[0], b[1] - b[0])
    low = max(a[0], b[0]) if abs(a[0] - b[0]) > EDGE_BREAK * shorter else min(a[0], b[0])
    high = min(a[1], b[1]) if abs(a[1] - b[1]) > EDGE_BREAK * shorter else max(a[1], b[1])
    return low, high


def _widest_tops(brep: Brep, ribs: Sequence[Rib]) -> list[Rib]:
    """Of ribs with the same two flanks, those with the largest top: the end faces of a rib are no tops."""
    best: dict[frozenset[int], tuple[float, Rib]] = {}
    for rib in ribs:
        flanks, area = frozenset(rib.flanks), brep.faces[rib.top].area
        if flanks not in best or area > best[flanks][0]:
            best[flanks] = (area, rib)
    return [rib for _, rib in best.values()]


def _sides(brep: Brep, top: FaceRecord) -> list[tuple[EdgeRecord, FaceRecord]]:
    """The plane faces that a top face ends at, about square, with the edges there; longest first."""
    low, high = RIGHT_ANGLE
    sides = [
        (edge, brep.faces[other])
        for edge, other in brep.neighbours(top.id)
        if edge.convexity is EdgeConvexity.CONVEX
        and low <= edge.angle <= high
        and brep.faces[other].kind is SurfaceKind.PLANE
    ]
    return sorted(sides, key=lambda side: -side[0].length)


def _pairs(sides: Sequence[tuple[EdgeRecord, FaceRecord]], footed: Set[int]) -> list[tuple[FaceRecord, FaceRecord]]:
    """The standing sides two by two, each with the nearest one opposite: several ribs may end in one top face."""
    left = [side for side in sides if side[1].id in footed]
    pairs = []
    while left:
        first, *left = left
        across = [side for side in left if _are_opposed(first, side)]
        if across:
            nearest = min(across, key=lambda side: dist(side[0].mid, first[0].mid))
            pairs.append((first[1], nearest[1]))
            left = [side for side in left if side[1].id not in (first[1].id, nearest[1].id)]
    return pairs


def _flush_pair(
    sides: Sequence[tuple[EdgeRecord, FaceRecord]], footed: Set[int]
) -> tuple[FaceRecord, FaceRecord] | None:
    """The two longest parallel sides that face away from each other, one of them standing."""
    for i, side in enumerate(sides):
        for other in sides[i + 1 :]:
            if len(footed & {side[1].id, other[1].id}) == 1 and _are_opposed(side, other):
                return side[1], other[1]
    return None


def _are_opposed(longer: tuple[EdgeRecord, FaceRecord], other: tuple[EdgeRecord, FaceRecord]) -> bool:
    """Are these two sides parallel, face away from each other, and are about as long?"""
    (edge, a), (other_edge, b) = longer, other
    opposed = dot(a.axis, b.axis) < -FACING.opposed and dot(sub(a.point, b.point), a.axis) > 0
    return a.id != b.id and opposed and other_edge.length > ALIKE * edge.length


def _feet(brep: Brep, flank: FaceRecord, top: FaceRecord) -> list[tuple[float, float]]:
    """The flank's concave edges below the top, and along it: their lengths and positions along the top's normal.

    They are of its outline: what stands on the flank itself, a pin on a plate, is no foot. Over a fillet the foot is
    where that ends: ribs are dimensioned from what they stand on.
    """
    level = dot(top.point, top.axis)
    outline = [brep.edges[e] for loop in flank.loops if loop.outer for e in loop.edges]
    return [
        (edge.length, _level(brep, edge, other, top.axis))
        for edge in outline
        for other in edge.faces
        if other != flank.id
        and (
            edge.convexity is EdgeConvexity.CONCAVE
            or (edge.convexity is EdgeConvexity.SMOOTH and brep.faces[other].outward < 0)
        )
        and dot(edge.mid, top.axis) < level
        and abs(dot(sub(edge.end, edge.start), top.axis)) < MAX_RISE * edge.length
    ]


def _level(brep: Brep, edge: EdgeRecord, beside: int, out: Vector) -> float:
    """Where the flank ends along `out`; `beside`: the face behind the edge, whose end counts where it is a fillet."""
    smooth = edge.convexity is EdgeConvexity.SMOOTH
    return faces_span(brep, (beside,), out)[0] if smooth else dot(edge.mid, out)


def _alike(a: Rib, b: Rib, tolerances: Tolerances) -> bool:
    return (
        a.body == b.body
        and abs(a.thickness - b.thickness) <= 0.02 * a.thickness + tolerances.length
        and parallel(a.direction, b.direction, 0.02)
        and dot(a.normal, b.normal) > FACING.alike
    )


def _same_row(brep: Brep, a: Rib, b: Rib, tolerances: Tolerances) -> bool:
    """Alike, on one level and of one height?"""
    level = abs(dot(sub(brep.faces[a.top].point, brep.faces[b.top].point), a.normal))
    near = 0.02 * a.height + tolerances.length
    return _alike(a, b, tolerances) and level <= near and abs(a.height - b.height) <= near


def fins(ribs: Sequence[Rib], tolerances: Tolerances) -> set[int]:
    """Which ribs (by index) are fins, that is three or more alike that stand parallel in one body?

    Each has a top of its own: those that end in one face with others, as level with a rim, are ribs and dividers.
    """
    tops = Counter(rib.top for rib in ribs)
    own = {i: rib for i, rib in enumerate(ribs) if tops[rib.top] == 1}
    return {i for i, a in own.items() if sum(_alike(a, b, tolerances) for b in own.values()) >= FINS}
