"""Flat walls: two plane faces with nothing but material between them, close together against their size."""

from __future__ import annotations

import math
from collections import defaultdict
from collections.abc import Collection, Iterable, Iterator, Mapping, Sequence
from dataclasses import dataclass, replace
from itertools import chain, permutations

from querycad_contracts import Part, Vector
from querycad_segworker.features.depressions.depression import Depression, DepressionKind
from querycad_segworker.features.shared.adjacency import breaks_edge, is_blend
from querycad_segworker.features.shared.frames import LocalFrame, frame_of_edges
from querycad_segworker.features.shared.part_measures import (
    PLATE_RATIO,
    UPRIGHT,
    faces_area,
    faces_box,
    geometry,
    millimetres,
    stance,
)
from querycad_segworker.features.shared.reach import faces_span
from querycad_segworker.tolerances import Tolerances, exceeds, reaches, significant
from querycad_segworker.topology import Brep, EdgeConvexity, EdgeKind, FaceRecord, linked
from querycad_segworker.vectors import OFF_ROUND, add, box_extents, cross, dist, dot, scale, sub

from .gussets import gusset_in

MOST = 0.5
"""More than this share of one of the two faces has the other one straight behind it."""
FILLED = 0.4
"""A side that fills less than this share of its box is a rim, or the cross-section of a wall."""
FLATTER = 0.8
"""A wall is thinner than it is wide, by this factor at least; else it is a bar."""
MADE_OF = 0.6
"""A body of walls, such as an angle bracket, has more than this share of its volume in them and in the gussets between
them; holes and bends are the rest."""
APART = 0.95
"""Cosine of the angle that legs of a bent part are turned by at least: some 20 degrees."""
SQUARE = 0.02
"""Cosine of the angle between faces that are square to each other."""
PAIR = 2
"""A web has so many flanges."""
STANDS_IN = frozenset(("between", "gusset"))
"""What parts two openings, or stiffens a corner, is no leg."""
HALF_TURN_RAD = math.radians(150.0)
"""The end of an ear is round by so much at least."""
DISC_RAD = math.radians(270.0)
"""What is round by more than so much is a disc with a flat; ears and eyes are round by 180 to 240 degrees."""
FORKS = (DepressionKind.SLOT, DepressionKind.CHANNEL, DepressionKind.NOTCH)
UNDERCUT = frozenset(("t_slot", "dovetail", "v_shaped", "keyway"))
"""Slots that no fork has."""
PAD = 0.5
"""What stands on a wall and covers less than this share of what is left beside it is a pad, and no wall by itself."""
TINE = 2.0
"""Tines are no thicker than so many widths of the gap between them, and a wall beside a pocket than so many widths of
the smaller of its sides."""


@dataclass(frozen=True, slots=True)
class FlatWall:
    """One wall. Metres, frame of the file. `length` and `width` are those of the smaller of its two sides."""

    thickness: float
    length: float
    width: float
    normal: Vector
    """Square to it, out of the smaller side."""
    center: Vector
    faces: tuple[int, ...]
    body: int
    tags: tuple[str, ...] = ()
    is_floor: bool = False
    height: float | None = None
    """Of a leg that stands upright, to the outside of what it stands on."""
    is_thin: bool = True
    """Thinner than a third of its width. What is thicker is a wall only beside a pocket, or on one that is thin."""
    encloses: bool = False
    """One of its sides, and not the other, is a side of a closed pocket, or the end of a channel."""

    @property
    def volume(self) -> float:
        """How much material would a full block of its size have?"""
        return self.thickness * self.length * self.width


def recognise_flat_walls(
    brep: Brep,
    opposite_m2: Mapping[tuple[int, int], float],
    depressions: Sequence[Depression],
    tolerances: Tolerances,
) -> list[FlatWall]:
    """Which flat walls does the model have: sides and floors of boxes, legs of brackets, webs, ears? By lowest face id.

    `opposite_m2`: how much of a plane face has another one straight behind it, across the material. Pieces of one plane
    that have one face behind them are one side. Floors are those that a pocket or channel ends at; the channel between
    two gussets ends at a leg.
    """
    alike: dict[tuple[int, int], list[tuple[int, int]]] = defaultdict(list)
    for a, b in _pairs(brep, opposite_m2):
        thickness = round(_gap(brep, a, b) * OFF_ROUND / (3 * tolerances.length))
        alike[brep.faces[a].body, thickness].append((a, b))
    floored = [found for found in depressions if found.kind in (DepressionKind.POCKET, DepressionKind.CHANNEL)]
    closed = (DepressionKind.POCKET, DepressionKind.PASSAGE)
    beside = {
        face: number
        for number, found in enumerate(depressions)
        if found.kind in closed
        for face in found.faces
        if face not in found.floor
    }
    slots = _forks(brep, depressions)
    pockets = {face: depressions[n] for face, n in beside.items() if depressions[n].kind is DepressionKind.POCKET}
    aside = {face: FLATTER * pocket.depth for face, pocket in pockets.items()}
    below = {face: FLATTER * found.depth for found in floored for face in found.floor}
    slits = {face for cut in depressions if "slit" in cut.tags for face in cut.faces}
    sides = (faces for pairs in alike.values() for faces in linked({i for pair in pairs for i in pair}, pairs))
    found = [wall for faces in sides if (wall := _wall(brep, faces, slots, aside, below, beside, slits)) is not None]
    found = [_gusset(brep, wall) or wall for wall in found]
    ends = {face for cut in floored if cut.kind is DepressionKind.CHANNEL for face in cut.floor}
    floors = _floors(floored, found)
    placed = [_between(brep, _with_place(wall, floors), beside) for wall in found]
    placed = [_as_enclosing(brep, wall, pockets.keys() | ends) for wall in placed]
    thin = [wall for wall in placed if wall.is_thin]
    low = [wall for wall in placed if not wall.is_thin]
    thin = [wall for wall in thin if not _is_pad(brep, wall, thin)]
    low = [_as_tine(brep, wall, slots) for wall in low if not _is_pad(brep, wall, thin)]
    low = [
        wall
        for wall in low
        if not {"between", "tine"}.isdisjoint(wall.tags)
        or wall.is_floor
        or not slits.isdisjoint(wall.faces)
        or not pockets.keys().isdisjoint(wall.faces)
        or next(_joined(brep, wall, thin), None) is not None
    ]
    ears = [wall for wall in (*thin, *low) if not slits.isdisjoint(wall.faces)]
    others = [wall for wall in (*thin, *low) if slits.isdisjoint(wall.faces)]
    bottoms = {face for cut in floored if cut.kind is DepressionKind.POCKET and not cut.is_open for face in cut.floor}
    named = (_bottom(wall, bottoms) for wall in (*ears, *_legs(brep, _webs(brep, others))))
    return sorted(named, key=lambda wall: (wall.faces, wall.thickness))


def _bottom(wall: FlatWall, bottoms: Collection[int]) -> FlatWall:
    """The same wall; no ear nor tine where it is the bottom of a pocket, as of one for a nut, which an ear has."""
    is_ear = set(wall.faces).isdisjoint(bottoms)
    return wall if is_ear else replace(wall, tags=tuple(tag for tag in wall.tags if tag not in ("ear", "tine")))


def _forks(brep: Brep, depressions: Sequence[Depression]) -> dict[int, float]:
    """How thick may the tines beside a slot be, in metres, by its sides? It reaches farther than it is wide.

    As thick as it reaches, and as twice its width: a slit between two halves of a clamp makes no fork.
    """
    found = {}
    for cut in depressions:
        reach = cut.length if "through" in cut.tags else cut.depth
        slit = cut.kind in FORKS and not UNDERCUT.intersection(cut.tags)
        if slit and cut.is_open and exceeds(reach, cut.width):
            across = cross(cut.normal, cut.direction)
            sides = (face for face in cut.faces if abs(dot(brep.faces[face].axis, across)) > APART)
            found.update(dict.fromkeys(sides, min(reach, TINE * cut.width)))
    return found


def _is_pad(brep: Brep, wall: FlatWall, others: Sequence[FlatWall]) -> bool:
    """Is its smaller side the top of a pad on a thinner, larger wall, with the same face behind both?"""
    small, large = _sides(brep, wall)
    rim = _rims([brep.faces[face] for face in small])  # holes in its top are not around it
    beside = (one for face in small for one in brep.neighbours(face))
    around = {i for edge, i in beside if edge.id in rim and edge.convexity is EdgeConvexity.CONVEX}
    before = (other for other in others if not large.isdisjoint(other.faces))
    thinner = [_sides(brep, other) for other in before if exceeds(wall.thickness, other.thickness)]
    for ground, behind in chain.from_iterable(permutations(sides) for sides in thinner):
        less = sum(brep.faces[i].area for i in small) < PAD * sum(brep.faces[i].area for i in ground)
        feet = {i for face in ground for i in brep.beside(face, EdgeConvexity.CONCAVE)}
        if less and around and around <= feet and not large.isdisjoint(behind):
            return True
    return False


def _sides(brep: Brep, wall: FlatWall) -> tuple[set[int], set[int]]:
    """The faces of its smaller side, and those of the larger one."""
    small = {i for i in wall.faces if dot(brep.faces[i].axis, wall.normal) > 0}
    return small, {*wall.faces} - small


def _as_tine(brep: Brep, wall: FlatWall, slots: Mapping[int, float]) -> FlatWall:
    """The same wall, a 'tine' where it stands beside a slot through a fork and is no thicker than tines are.

    `slots`: how thick that may be, metres, by the sides of the slots.
    """
    beside = (face for face in wall.faces if face in slots and not exceeds(wall.thickness, slots[face]))
    flank = any(abs(dot(brep.faces[face].axis, wall.normal)) > APART for face in beside)
    return replace(wall, tags=(*wall.tags, "tine")) if flank else wall


def _between(brep: Brep, wall: FlatWall, beside: Mapping[int, int]) -> FlatWall:
    """The same wall, 'between' where its two sides are walls of two different openings."""
    small, large = ([brep.faces[face] for face in side] for side in _sides(brep, wall))
    return replace(wall, tags=(*wall.tags, "between")) if _parts(small, large, beside) else wall


def _parts(small: Iterable[FaceRecord], large: Iterable[FaceRecord], beside: Mapping[int, int]) -> bool:
    """Are the two sides walls of two different openings? `beside`: number of the opening, by its walls."""
    one, other = ({beside[face.id] for face in side if face.id in beside} for side in (small, large))
    return bool(one and other) and one.isdisjoint(other)


def _gusset(brep: Brep, wall: FlatWall) -> FlatWall | None:
    found = gusset_in(brep, wall.faces, wall.center, wall.thickness)
    if found is None:
        return None
    return replace(wall, length=found.length, width=found.height, faces=found.faces, tags=("gusset",))


def _joined(brep: Brep, wall: FlatWall, others: Sequence[FlatWall]) -> Iterator[int]:
    """Which of the others does a wall meet at an angle, also over a bend or a fillet?"""
    beside = {i for face in wall.faces for _, i in brep.neighbours(face)} - set(wall.faces)
    around = beside.union(*([n for _, n in brep.neighbours(i)] for i in beside if is_blend(brep, brep.faces[i])))
    for number, other in enumerate(others):
        at_angle = wall.body == other.body and abs(dot(wall.normal, other.normal)) <= APART
        if at_angle and not around.isdisjoint(other.faces):
            yield number


def _pairs(brep: Brep, opposite_m2: Mapping[tuple[int, int], float]) -> list[tuple[int, int]]:
    found = set()
    for (a, b), area_m2 in opposite_m2.items():
        if brep.faces[a].body == brep.faces[b].body and exceeds(area_m2, MOST * brep.faces[a].area):
            found.add((min(a, b), max(a, b)))
    return sorted(found)


def _gap(brep: Brep, a: int, b: int) -> float:
    return abs(dot(brep.faces[a].point, brep.faces[a].axis) - dot(brep.faces[b].point, brep.faces[a].axis))


def _wall(
    brep: Brep,
    faces: Collection[int],
    slots: Mapping[int, float],
    aside: Mapping[int, float],
    below: Mapping[int, float],
    beside: Mapping[int, int],
    slits: Collection[int],
) -> FlatWall | None:
    """The wall between the faces that look one way and those that look the other; None where it is too thick.

    `slots`, `aside`, `below`: how thick it may be beside the slot of a fork, beside a pocket, and below the floor of
    one, metres, by their faces. What parts two openings, of `beside`, may be as thick as it is long: a bar of a frame.
    What is thicker than it is long and wide is a block beside a pocket, no wall; and where it is thicker than its
    smaller side is wide, that side is the pocket's: no wall lies behind the rim of a flange, nor under a rib. Beside a
    slit, of `slits`, it is an ear of a clamp, however thick, as long as it is thinner than wide.
    """
    first = brep.faces[min(faces)]
    sides: dict[bool, list[FaceRecord]] = defaultdict(list)
    for i in sorted(faces):
        sides[dot(brep.faces[i].axis, first.axis) > 0].append(brep.faces[i])
    if len(sides) != 2:
        return None
    small, large = sorted(sides.values(), key=lambda side: _size(brep, side))
    small = [face for face in small if not _is_disc(brep, face)]  # the bottom of a bore that ends level with a floor
    if not small:
        return None
    normal = small[0].axis
    thickness = dot(small[0].point, normal) - dot(large[0].point, normal)
    frame = _frame(brep, small, thickness)
    length, width, _ = frame.size
    # The rim of a box is long and wide as a whole, but narrow: there the mean width counts.
    area = sum(face.area for face in small)
    filled = area > FILLED * length * width
    clear = width if filled else area / length
    widest = TINE * width if filled else max(_frame(brep, [face], thickness).size[1] for face in small)
    thin = not reaches(thickness, PLATE_RATIO * clear)
    low = not reaches(thickness, FLATTER * clear) and not reaches(thickness, PLATE_RATIO * length)
    near = faces if thickness < clear else [face.id for face in small]
    tine, aside_m, under = (max(deep.get(face, 0.0) for face in near) for deep in (slots, aside, below))
    under = under if filled else min(under, widest)
    most = max(min(tine, length), min(aside_m, length, widest), under, length if _parts(small, large, beside) else 0.0)
    is_ear = not exceeds(thickness, FLATTER * clear) and not {face.id for face in (*small, *large)}.isdisjoint(slits)
    if thickness <= 0 or not (thin or low or is_ear or thickness < most):
        return None
    return FlatWall(
        thickness=thickness,
        length=length,
        width=width,
        normal=normal,
        center=add(frame.point(0.5, 0.5, 1.0), scale(normal, -thickness / 2)),
        faces=tuple(sorted(face.id for face in (*small, *large))),
        body=first.body,
        is_thin=thin,
        tags=("ear",) if is_ear or any(_is_ear(brep, face) for face in (*small, *large)) else (),
    )


def _size(brep: Brep, side: Sequence[FaceRecord]) -> tuple[float, float]:
    """To sort the two sides of a wall by: area; of a bent sheet's two, alike in that, the outer one is first."""
    around = {i for face in side for i in brep.beside(face.id, EdgeConvexity.SMOOTH)}
    return significant(sum(face.area for face in side)), -sum(brep.faces[i].outward for i in around)


def _is_disc(brep: Brep, face: FaceRecord) -> bool:
    """Is it bounded by a circle, or but for a flat on its rim by one?"""
    arcs = [edge for edge in map(brep.edges.__getitem__, _rims([face])) if edge.kind is EdgeKind.CIRCLE]
    return any(arc.closed or (arc.radius and arc.length > DISC_RAD * arc.radius) for arc in arcs)


def _frame(brep: Brep, side: Sequence[FaceRecord], thickness: float) -> LocalFrame:
    """The box of a side, over the rounds and chamfers narrower than the wall is thick that break its edges."""
    around = [(face, edge, brep.faces[i]) for face in side for edge, i in brep.neighbours(face.id)]
    broken = [other for face, edge, other in around if breaks_edge(brep, face, edge, other)]
    outline = _rims(side) or brep.edges_of(face.id for face in side)
    outline |= brep.edges_of(face.id for face in broken if max(face.radius, face.minor_radius) < thickness)
    return frame_of_edges(brep, outline, side[0].axis, None)


def _rims(side: Sequence[FaceRecord]) -> set[int]:
    return {e for face in side for loop in face.loops if loop.outer for e in loop.edges}


def _is_ear(brep: Brep, face: FaceRecord) -> bool:
    """Does it end round about a hole, as ears and eyes do? Not where it ends at a round wall that rises from it."""
    arcs = [brep.edges[e] for loop in face.loops if loop.outer for e in loop.edges]
    inner = [brep.edges[e] for loop in face.loops if not loop.outer for e in loop.edges]
    for arc in arcs:
        if arc.kind is not EdgeKind.CIRCLE or not arc.radius or arc.center is None or arc.closed:
            continue
        if arc.convexity is EdgeConvexity.CONCAVE:
            continue
        if arc.length < HALF_TURN_RAD * arc.radius:
            continue
        centers = [edge.center for edge in inner if edge.center is not None]
        if any(dist(center, arc.center) < 0.02 * arc.radius for center in centers):
            return True
    return False


def _floors(cuts: Iterable[Depression], walls: Sequence[FlatWall]) -> dict[int, Vector]:
    """The faces that these cuts end at, and the way each opens; not that of a channel with a gusset for a side."""
    gussets = {face for wall in walls if "gusset" in wall.tags for face in wall.faces}
    open_ = (cut for cut in cuts if cut.kind is not DepressionKind.CHANNEL or gussets.isdisjoint(cut.faces))
    return {face: cut.normal for cut in open_ for face in cut.floor}


def _as_enclosing(brep: Brep, wall: FlatWall, inner: Collection[int]) -> FlatWall:
    """The same wall, with the mark where one of its sides has faces among the inner ones, and the other has none."""
    one, other = (not side.isdisjoint(inner) for side in _sides(brep, wall))
    return replace(wall, encloses=one != other)


def _with_place(wall: FlatWall, floors: Mapping[int, Vector]) -> FlatWall:
    """The same wall, as a floor where a pocket or channel ends at it; a roof where that opens downwards."""
    tags = (*wall.tags, stance(wall.normal))
    opens = [floors[face] for face in wall.faces if face in floors]
    if not opens:
        return replace(wall, tags=tags)
    roof = ("roof",) if any(normal[2] < UPRIGHT - 1 for normal in opens) else ()
    return replace(wall, is_floor=True, tags=(*tags, *roof))


def _webs(brep: Brep, walls: Sequence[FlatWall]) -> list[FlatWall]:
    """The same walls; one that joins two parallel ones, as in an I or a U, is their web, and they are its flanges.

    In a closed ring of walls each one joins two others: there is none.
    """
    joined = {i: set(_joined(brep, wall, walls)) for i, wall in enumerate(walls)}
    webs = {
        i: beside
        for i, beside in joined.items()
        if len(beside) == PAIR
        and all(joined[j] == {i} for j in beside)
        and abs(dot(*(walls[j].normal for j in beside))) > APART
    }
    flanges = {j for pair in webs.values() for j in pair}
    named = {**dict.fromkeys(webs, "web"), **dict.fromkeys(flanges, "flange")}
    return [replace(wall, tags=(*wall.tags, named[i])) if i in named else wall for i, wall in enumerate(walls)]


def _legs(brep: Brep, walls: Sequence[FlatWall]) -> list[FlatWall]:
    """The same walls; those of a body that is made of walls turned against each other are its legs.

    A body that is one wall as a whole is a plate instead.
    """
    own: dict[int, list[FlatWall]] = defaultdict(list)
    for wall in walls:
        if STANDS_IN.isdisjoint(wall.tags):
            own[wall.body].append(wall)
    result = [wall for wall in walls if not STANDS_IN.isdisjoint(wall.tags)]
    for body, members in own.items():
        turned = any(abs(dot(a.normal, b.normal)) < APART for a in members for b in members)
        braces = sum(wall.volume for wall in result if wall.body == body and "gusset" in wall.tags) / 2  # triangles
        made_of = braces + sum(wall.volume for wall in members) > MADE_OF * brep.bodies[body].volume > 0
        if made_of and len(members) == 1 and not members[0].is_floor:
            continue
        floors = [wall.normal for wall in members if wall.is_floor]  # returned lips lie along the floor of a channel
        sides = [wall.normal for wall in members if all(abs(dot(wall.normal, floor)) < APART for floor in floors)]
        closed = floors and any(abs(dot(a, b)) < APART for a in sides for b in sides)  # a channel has legs, a box none
        legs = turned and made_of and not closed
        result += [_leg(brep, wall, members) if legs and not wall.is_floor else wall for wall in members]
    return result


def _leg(brep: Brep, wall: FlatWall, others: Sequence[FlatWall]) -> FlatWall:
    """The same wall as a leg, as long and wide as its outer side, to the outside of what it meets at a corner or bend.

    Drawings give legs and flanges by these dimensions (DIN 6935).
    """
    outer = [brep.faces[i] for i in wall.faces if dot(brep.faces[i].axis, wall.normal) < 0]
    frame = _frame(brep, outer, wall.thickness)
    meets = [face for other in _joined(brep, wall, others) for face in _met(brep, wall, others[other])]
    middle, sizes = frame.point(0.5, 0.5, 0.5), list[float]()
    for way, low, size in zip((frame.u, frame.v), frame.low, frame.size, strict=False):
        reach = [low, low + size]
        for face in meets:
            if abs(dot(face.axis, way)) > math.sqrt(1 - APART**2):  # the corner is where both planes meet
                corner = dot(sub(face.point, middle), face.axis) / dot(face.axis, way)
                reach.append(dot(middle, way) + corner)
        sizes.append(max(reach) - min(reach))
    heights = [size for size, way in zip(sizes, (frame.u, frame.v), strict=True) if abs(way[2]) > 1 - UPRIGHT**2]
    width, length = sorted(sizes)
    return replace(wall, tags=(*wall.tags, "leg"), length=length, width=width, height=heights[0] if heights else None)


def _met(brep: Brep, leg: FlatWall, other: FlatWall) -> list[FaceRecord]:
    """The faces of another wall up to which a leg reaches: both at a corner, the near one of what goes on behind it."""
    faces = [brep.faces[i] for i in other.faces]
    ends = faces_span(brep, other.faces, leg.normal)
    sides = [dot(brep.faces[i].point, leg.normal) for i in leg.faces]
    beyond = 0.5 * leg.thickness
    if min(ends) < min(sides) - beyond and max(ends) > max(sides) + beyond:
        return [face for face in faces if dot(sub(leg.center, face.point), face.axis) > 0]
    return faces


def _upright(brep: Brep, wall: FlatWall) -> float:
    """How high is a wall, metres? As its larger side; where that runs on past a floor or corner, as the smaller one.

    The larger side of a box runs on over its floor, however thick.
    """
    whole, own = (box_extents(faces_box(brep, faces))[2] for faces in (wall.faces, _sides(brep, wall)[0]))
    return own if not wall.encloses and exceeds(whole - own, wall.thickness) else whole


def flat_wall_part(brep: Brep, wall: FlatWall, number: int) -> Part:
    """A wall, floor or gusset as a part; its thickness is between its two sides.

    A gusset is a rib whose length and height are those of its two feet.
    """
    is_gusset = "gusset" in wall.tags
    kind = "rib" if is_gusset else "floor" if wall.is_floor else "wall"
    name = "gusset" if is_gusset else kind
    extents = box_extents(faces_box(brep, wall.faces))
    return Part(
        id=f"{name}-{number}",
        kind=kind,
        tags=("planar", *wall.tags),
        label=f"{name}, thickness {millimetres(wall.thickness)}, {millimetres(wall.length, wall.width)}",
        faces=wall.faces,
        center=wall.center,
        extents=extents,
        normal=wall.normal,
        thickness=wall.thickness,
        length=wall.length,
        width=wall.width,
        height=wall.width if is_gusset else None if "inclined" in wall.tags else wall.height or _upright(brep, wall),
        local_size=(wall.length, wall.width, wall.thickness),
        area=faces_area(brep, wall.faces),
        evidence=geometry(f"plane faces that look away from each other, {millimetres(wall.thickness)} apart"),
    )
