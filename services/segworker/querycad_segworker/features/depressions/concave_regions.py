"""Depressions as groups of faces that meet in concave edges, whether or not their rim is one boundary loop."""

from __future__ import annotations

import math
from collections.abc import Iterator, Sequence, Set
from dataclasses import replace
from itertools import combinations

from querycad_contracts import SurfaceKind, Vector
from querycad_segworker.features.shared.adjacency import ConcaveGraph
from querycad_segworker.features.shared.extruded_walls import (
    MORE_THAN_HALF,
    Tunnel,
    first_of_surface,
    tunnel_of,
)
from querycad_segworker.features.shared.frames import LocalFrame, frame_of, outline_of
from querycad_segworker.features.shared.reach import faces_span
from querycad_segworker.features.shared.refusals import refuse
from querycad_segworker.features.shared.regular import is_d
from querycad_segworker.tolerances import FACING, Tolerances, exceeds, reaches, significant
from querycad_segworker.topology import Brep, EdgeConvexity, FaceRecord
from querycad_segworker.vectors import cross, dot, norm, parallel, scale, sub, unit, upwards

from .depression import ELONGATED, Depression, DepressionKind, depression_in
from .floors import by_attitude, floor_of, is_surrounded
from .outlets import held_floor
from .slot_sections import (
    DRAFT_RAD,
    SQUARE,
    Pair,
    facing_pair,
    gap_between,
    gap_on,
    over_edge_break,
    undercut,
    v_slot,
    woodruff,
)

BEVEL = 0.1
"""Cosine of the angle that a bevel at the foot of a wall stands off both the wall and the floor at least."""
LEVEL = 0.9
"""Cosine: what a slot is cut into looks the way that its floor does, within 26 degrees."""
CROSSING = 0.5
"""Cosine: directions that enclose 60 degrees or more cross."""
LEANS_BACK = math.sin(math.radians(29.5))
"""A step's wall stands up from its floor: one that leans back by 30 degrees or more, as the sides of a hexagon do to
each other, is the next side of the body."""
RUNS_OUT = 1.5
"""A floor so many times as wide as the gap between two walls goes on beyond them, as that of a lower step."""
CHANNEL_SHARE = 0.5
"""A slot wider than this share of its body is the inside of a channel section, not a slot in something."""


def group_depression(
    brep: Brep, group: set[int], graph: ConcaveGraph, tolerances: Tolerances, others: Set[int] = frozenset()
) -> Depression | None:
    """What do these faces form, which meet in concave edges? None when they form no depression.

    The floor is the plane that the most others stand on. A floor with walls all around makes a pocket, walls that
    close a ring without a floor a passage, two walls that face each other a slot, channel or notch, two planes alone
    that open the same way a V slot; whatever else stands on a floor makes a step. `others`: faces of other cuts, beside
    those of holes; where they break in, the floor counts as closed.
    """
    planes = brep.of_kind(SurfaceKind.PLANE, sorted(group))
    tunnel = tunnel_of(brep, group)
    if tunnel is not None and tunnel.closed:
        return _passage(brep, group, tunnel)
    if not planes:
        return None
    own_links = {face.id: _wall_links(graph, face.id, group) for face in planes}
    links = _links_by_plane(planes, own_links)
    lipped = _under_lips(graph, group, planes, own_links, links)
    floor = lipped[0] if lipped else floor_of(graph, group, planes, links)
    walls = [brep.faces[i] for i in sorted(lipped[1] if lipped else links[floor.id])]
    special = v_slot(brep, group, planes) or woodruff(brep, group, planes)
    if special is not None or not walls:
        return special
    pair = lipped[2] if lipped else facing_pair([w for w in walls if w.kind is SurfaceKind.PLANE], floor.axis)
    if pair is not None and _is_bevel(brep, floor, pair):
        either = pair
        floor = max(either, key=lambda face: by_attitude(face, either))
        walls, pair = [brep.faces[i] for i in sorted(group) if i != floor.id], None
    if pair is None and (beveled := _between_bevels(graph, group, planes, links)) is not None:
        floor, above, pair = beveled
        walls = [brep.faces[i] for i in sorted(links[floor.id] | above)]
    if pair is None and (bottom := _across(brep, group, planes)) is not None:
        floor, pair = bottom
        ends = brep.of_kind(SurfaceKind.CYLINDER, sorted(group))
        walls = [plane for plane in planes if plane.id != floor.id]
        walls += [end for end in ends if parallel(end.axis, floor.axis, SQUARE)]
    if tunnel is not None and tunnel.turn > MORE_THAN_HALF and not (pair and undercut(brep, group, floor, pair)):
        return _passage(brep, group, tunnel)
    if tunnel is not None and not any(_stands_square(wall, floor) for wall in walls):
        return _round_bottomed(brep, group, tunnel, planes)
    floors = [brep.faces[f] for f in sorted(graph.flush(floor.id))]
    if all(_is_walled_in(graph, piece, walls, group, others) for piece in floors):
        return _pocket(brep, _within_rim(brep, group, floor, walls, tolerances), floors, planes, tolerances)
    if pair is None or undercut(brep, group, floor, pair) is None:
        held = held_floor(graph, group, planes)
        if held is not None:
            return _pocket(brep, *held, planes, tolerances, is_open=True)
    return _open_on_floor(graph, group, floor, walls, pair)


def _is_bevel(brep: Brep, floor: FaceRecord, pair: Pair) -> bool:
    """Is what looks like a floor between leaning walls the bevel at the foot of a step?

    The walls then are square to each other, and end at faces that look another way than the bevel.
    """
    if abs(dot(pair[0].axis, pair[1].axis)) > SQUARE or dot(pair[0].axis, floor.axis) < BEVEL:
        return False
    beside = [brep.faces[i] for wall in pair for i in brep.beside(wall.id, EdgeConvexity.CONVEX)]
    return not any(dot(face.axis, floor.axis) > LEVEL for face in beside)


def _between_bevels(
    graph: ConcaveGraph, group: set[int], planes: Sequence[FaceRecord], links: dict[int, set[int]]
) -> tuple[FaceRecord, set[int], Pair] | None:
    """A floor with bevels along both sides, the walls that stand on those, and the two that face each other.

    A round end stands on a conical bevel.
    """
    brep = graph.brep
    for floor in sorted(planes, key=lambda face: -face.area):
        bevels = [i for i in links[floor.id] & links.keys() if BEVEL < dot(brep.faces[i].axis, floor.axis) < 1 - BEVEL]
        above = {wall for i in bevels for wall in links[i] & links.keys()} - {floor.id, *bevels}
        pair = facing_pair([brep.faces[i] for i in sorted(above)], floor.axis) if len(bevels) > 1 else None
        if pair is not None:
            cones = [i for i in graph.concave[floor.id] & group if brep.faces[i].kind is SurfaceKind.CONE]
            ends = {i for cone in cones for i in graph.concave[cone] & group if brep.faces[i].outward < 0}
            return floor, above | {i for i in ends if brep.faces[i].kind is SurfaceKind.CYLINDER}, pair
    return None


def _under_lips(
    graph: ConcaveGraph,
    group: set[int],
    planes: Sequence[FaceRecord],
    own_links: dict[int, set[int]],
    links: dict[int, set[int]],
) -> tuple[FaceRecord, set[int], Pair] | None:
    """The floor of a T slot, its walls, and the two with lips that leave a neck between them.

    Those stand on the floor, or on bevels beside it, as in extruded profiles. `own_links`, `links`: what stands on each
    plane, and on all pieces of it.
    """
    brep = graph.brep
    for floor in planes:
        pair = facing_pair(brep.of_kind(SurfaceKind.PLANE, own_links[floor.id]), floor.axis)
        found = undercut(brep, group, floor, pair) if pair is not None else None
        if pair is not None and found is not None and found.tag == "t_slot":
            walls = brep.of_kind(SurfaceKind.PLANE, sorted(links[floor.id]))
            return floor, links[floor.id], facing_pair(walls, floor.axis) or pair
    beveled = _between_bevels(graph, group, planes, links)
    if beveled is None or undercut(brep, group, beveled[0], beveled[2]) is None:
        return None
    floor, above, pair = beveled
    return floor, links[floor.id] | above, pair


def _across(brep: Brep, group: set[int], planes: Sequence[FaceRecord]) -> tuple[FaceRecord, Pair] | None:
    """The floor between two walls that face each other, where all else runs straight across or rounds the end.

    As the floor that a disc cutter leaves, flat and rising at its end, when another cut took its corner with a wall; or
    the round end that an end mill leaves, when another cut took the foot of a wall.
    """
    pair = facing_pair(planes, None)
    if pair is None:
        return None
    owners = first_of_surface([*pair, *(plane for plane in planes if plane.id not in (pair[0].id, pair[1].id))])
    rest = [brep.faces[i] for i in sorted(group) if owners.get(i) not in (pair[0].id, pair[1].id)]
    flat = [face for face in rest if face.kind is SurfaceKind.PLANE and abs(dot(face.axis, pair[0].axis)) < SQUARE]
    if not flat:
        return None
    floor = max(flat, key=lambda face: face.area)
    rounds = [f for f in rest if f.kind is SurfaceKind.CYLINDER]
    across = all(parallel(f.axis, pair[0].axis, SQUARE) for f in rounds)
    at_end = all(parallel(f.axis, floor.axis, SQUARE) and f.outward < 0 for f in rounds) and len(flat) == 1
    return (floor, pair) if len(flat) + len(rounds) == len(rest) and (across or at_end) else None


def _stands_square(wall: FaceRecord, floor: FaceRecord) -> bool:
    """Is it a plane, or a round wall whose axis is upright on the floor?"""
    return wall.kind is SurfaceKind.PLANE or parallel(wall.axis, floor.axis, 0.1)


def _pocket(
    brep: Brep,
    group: set[int],
    floors: Sequence[FaceRecord],
    planes: Sequence[FaceRecord],
    tolerances: Tolerances,
    *,
    is_open: bool = False,
) -> Depression:
    """A pocket as large as its rim; an open one as its walls: its floor may run on into an outlet."""
    floor = floors[0]
    owners = first_of_surface([floor, *(plane for plane in planes if plane.id != floor.id)])
    ids = tuple(sorted({*(piece.id for piece in floors), *(i for i, owner in owners.items() if owner == floor.id)}))
    outline, corner = outline_of(brep, floor.loops[0], tolerances)
    around = tunnel_of(brep, group.difference(ids))
    if around is not None and (not around.closed or not is_surrounded(brep, floor, group)):
        outline = around.outline
    frame = frame_of(brep, group.difference(ids) if is_open else group, floor.axis, floor.loops[0])
    pocket = depression_in(DepressionKind.POCKET, outline, frame, group, ids, floor.body, is_open=is_open)
    walls = brep.of_kind(SurfaceKind.PLANE, sorted(group.difference(ids)))
    return replace(pocket, corner_radius=corner, depth=max(pocket.depth, _mouth(brep, floor, walls)))


def _open_on_floor(
    graph: ConcaveGraph, group: set[int], floor: FaceRecord, walls: Sequence[FaceRecord], pair: Pair | None
) -> Depression | None:
    """A slot, channel, notch or step: a floor with walls that leave a side open."""
    if _goes_around(graph.brep.of_kind(SurfaceKind.PLANE, sorted(group))):
        refuse("pocket", group, "its walls look away from each other: it goes around a body")
        return None
    if pair is not None:
        return slot_between(graph, group, floor, walls, pair)
    plane_walls = [wall for wall in walls if wall.kind is SurfaceKind.PLANE]
    round_ends = [wall for wall in walls if wall.kind is SurfaceKind.CYLINDER]
    along = unit(cross(plane_walls[0].axis, floor.axis)) if plane_walls else None
    if along is not None and norm(along) == 0:
        return None
    frame = frame_of(graph.brep, group, floor.axis, None, along)
    feet = [*plane_walls, *_over_fillets(graph.brep, group, floor)]
    if any(_are_back_to_back(a, b) for a, b in combinations(feet, 2)):
        refuse("step", group, "its walls look away from each other: they are those of what stands on the floor")
        return None
    if not plane_walls and len(round_ends) == 1 and frame.size[2] > max(frame.size[:2]):
        if _is_in_round_rim(graph.brep, round_ends[0]):
            return None  # higher than long: a flute along the rim, and what looks like its floor is its end
    kind = DepressionKind.STEP
    leaning = [wall for wall in plane_walls if dot(wall.axis, floor.axis) > LEANS_BACK]
    if any(sum(_meet(graph.brep, wall, end) for end in round_ends) > 1 for wall in plane_walls):
        kind = DepressionKind.SLOT  # closed at both ends by the round of the cutter, open along one side
    elif (reason := _no_step(graph.brep, floor, plane_walls, leaning)) is not None:
        refuse("step", group, reason)
        return None
    if not plane_walls:
        outline = "circular"
    elif round_ends:
        outline = "obround" if kind is DepressionKind.SLOT else "free"
    else:
        outline = "rectangular" if _is_square(plane_walls) and not leaning else "free"
    found = depression_in(kind, outline, frame, group, (floor.id,), floor.body, is_open=True)
    if kind is not DepressionKind.STEP:
        return found
    return replace(found, depth=max(found.depth, _rise(graph.brep, floor, plane_walls)))


def _no_step(brep: Brep, floor: FaceRecord, walls: Sequence[FaceRecord], leaning: Sequence[FaceRecord]) -> str | None:
    """Why are a floor and plane walls, `leaning` ones among them, no step?"""
    if leaning == walls != []:
        return "its walls lean back: it lies between sides of the body at obtuse angles"
    if len(walls) == 1 and is_d(brep, floor, walls[0]):
        return "it is the flat of a D shaft"
    return None


def _is_in_round_rim(brep: Brep, wall: FaceRecord) -> bool:
    """Is a round wall cut into what is round about a direction along it, as the grip flutes of a knob are?"""
    beside = (brep.faces[i] for i in brep.beside(wall.id, EdgeConvexity.CONVEX))
    return any(
        face.kind in (SurfaceKind.CYLINDER, SurfaceKind.CONE)
        and face.outward > 0
        and parallel(face.axis, wall.axis, SQUARE)
        for face in beside
    )


def _within_rim(
    brep: Brep, group: set[int], floor: FaceRecord, walls: Sequence[FaceRecord], tolerances: Tolerances
) -> set[int]:
    """The faces of a pocket, but for those of what stands on its walls and reaches out of it: the tabs of a cover.

    A pocket ends at the highest level face that its walls, or the rounds and chamfers of their edges, end at.
    """
    beside = [brep.faces[i] for wall in walls for i in brep.beside(wall.id, EdgeConvexity.CONVEX)]
    beside += [top for wall in walls for top in over_edge_break(brep, wall)]
    planes = [face for face in beside if face.kind is SurfaceKind.PLANE]
    levels = [dot(face.point, floor.axis) for face in planes if dot(face.axis, floor.axis) > FACING.parallel]
    if not levels:
        return group
    rim = max(levels) + 10 * tolerances.length
    others = group.difference({floor.id}, (wall.id for wall in walls))
    out = {face for face in others if faces_span(brep, (face,), floor.axis)[1] > rim}
    return group - out - {face for face in others if not out.isdisjoint(brep.beside(face, EdgeConvexity.CONVEX))}


def _rise(brep: Brep, floor: FaceRecord, walls: Sequence[FaceRecord]) -> float:
    """How high above a floor lie the level faces that its walls end at, over the chamfer or round of their edge?"""
    level = [
        top for wall in walls for top in over_edge_break(brep, wall) if dot(top.axis, floor.axis) > FACING.parallel
    ]
    return max((dot(sub(top.point, floor.point), floor.axis) for top in level), default=0.0)


def _mouth(brep: Brep, floor: FaceRecord, walls: Sequence[FaceRecord]) -> float:
    """How high above its floor do most walls of a pocket end, over the breaks of their edges? 0 where those are sharp.

    One that runs on to a higher shelf does not make it deeper.
    """
    rises = [significant(_rise(brep, floor, [wall])) for wall in walls]
    return max(rises, key=lambda rise: (rises.count(rise), -rise), default=0.0)


def _are_back_to_back(a: FaceRecord, b: FaceRecord) -> bool:
    return dot(a.axis, b.axis) < -math.cos(DRAFT_RAD) and dot(sub(b.point, a.point), a.axis) < 0


def _over_fillets(brep: Brep, group: set[int], floor: FaceRecord) -> Iterator[FaceRecord]:
    """What stands on a floor over fillets, as planes there: what is round has no plane walls."""
    for fillet in brep.of_kind(SurfaceKind.CYLINDER, group.intersection(brep.beside(floor.id, EdgeConvexity.SMOOTH))):
        rise = dot(fillet.point_normal, floor.axis)
        if fillet.outward < 0 and abs(dot(fillet.axis, floor.axis)) < SQUARE and BEVEL < rise < 1 - BEVEL:
            yield replace(fillet, axis=unit(sub(fillet.point_normal, scale(floor.axis, rise))))


def _goes_around(planes: Sequence[FaceRecord]) -> bool:
    """Do planes look away from each other in two crossing directions, as those of a casing between flange and foot?"""
    away = [a.axis for a, b in combinations(planes, 2) if _are_back_to_back(a, b)]
    return any(abs(dot(one, other)) < CROSSING for one, other in combinations(away, 2))


def _meet(brep: Brep, a: FaceRecord, b: FaceRecord) -> bool:
    return any(other == b.id for _, other in brep.neighbours(a.id))


def slot_between(
    graph: ConcaveGraph, group: set[int], floor: FaceRecord, walls: Sequence[FaceRecord], pair: Pair
) -> Depression | None:
    """A slot, channel or notch: a floor between two walls that face each other.

    Where those stand in the group, as two ribs or gussets do, or its floor runs out into a wider one, as that of a
    lower step, it is as long and high as both go side by side.
    """
    brep = graph.brep
    along = unit(cross(pair[0].axis, floor.axis))
    frame = frame_of(brep, group, floor.axis, None, along)
    at_mouth: Sequence[FaceRecord] = pair
    length = frame.size[0]
    width = gap_between(brep, pair, floor)
    runs_out = frame_of(brep, {floor.id}, floor.axis, None, along).size[1] > RUNS_OUT * width
    behind = {wall.id for wall in walls for side in pair if _are_back_to_back(wall, side)}
    between = _between(brep, floor, pair, along)
    undercuts = undercut(brep, group, floor, pair)
    if undercuts is not None:
        width = undercuts.neck_width
        group = group | undercuts.neck
        frame = frame_of(brep, group, floor.axis, None, along)
        at_mouth = brep.of_kind(SurfaceKind.PLANE, undercuts.neck) or pair
    elif behind or (runs_out and exceeds(between.size[0], width)):
        if behind and reaches(width, min(between.size[0], between.size[2])):
            refuse("slot", group, "the room between two walls that are farther apart than they are long or high")
            return None
        frame, length = between, between.size[0]
        group = {floor.id, *(side.id for side in pair)}
        walls = [wall for wall in walls if wall.id not in behind]
    depth = max(frame.size[2], _rise(brep, floor, at_mouth))
    round_ends = [wall for wall in walls if wall.kind is SurfaceKind.CYLINDER]
    plane_walls = [wall for wall in walls if wall.kind is SurfaceKind.PLANE]
    ends = [w for w in plane_walls if abs(dot(w.axis, along)) > 0.5]
    straight = undercuts is not None or _is_square(plane_walls)  # from above the lips of an undercut are its outline
    corners = [wall for wall in round_ends if any(_meet(brep, wall, end) for end in ends)]
    outline = "obround" if len(corners) < len(round_ends) else "rectangular" if straight else "free"
    found = depression_in(DepressionKind.SLOT, outline, frame, group, (floor.id,), floor.body, is_open=True)
    found = replace(
        found,
        corner_radius=min((corner.radius for corner in corners), default=None),
        width=width,
        depth=depth,
        floor_width=gap_on(floor, pair) if undercuts else None,
        tags=(undercuts.tag,) if undercuts else (),
        angle=undercuts.angle if undercuts else None,
    )
    if exceeds(width, CHANNEL_SHARE * graph.extent(floor.body, pair[0].axis)):
        return replace(found, kind=DepressionKind.CHANNEL)
    is_cut_through = undercuts is None and not ends and not round_ends
    if is_cut_through and exceeds(depth, length) and reaches(depth, ELONGATED * width):
        return _through_slot(brep, group, floor, along, width)
    if not reaches(length, width) and undercuts is None:
        return replace(found, kind=DepressionKind.NOTCH)
    return found


def _between(brep: Brep, floor: FaceRecord, pair: Pair, along: Vector) -> LocalFrame:
    """The box between two walls, as far as both go along a floor and up from it."""
    a, b = (frame_of(brep, {wall.id}, floor.axis, None, along) for wall in pair)
    both = frame_of(brep, {wall.id for wall in pair}, floor.axis, None, along)
    ends = [(x + dx, y + dy) for x, dx, y, dy in zip(a.low, a.size, b.low, b.size, strict=True)]
    low = max(a.low[0], b.low[0]), both.low[1], max(a.low[2], b.low[2])
    size = max(min(ends[0]) - low[0], 0.0), both.size[1], max(min(ends[2]) - low[2], 0.0)
    return replace(both, low=low, size=size)


def _through_slot(
    brep: Brep, group: set[int], end: FaceRecord, across: tuple[float, float, float], width: float
) -> Depression:
    """A slot cut right through a plate from its edge: what looks like its floor is its end."""
    frame = frame_of(brep, group, upwards(across), None, end.axis)
    slot = depression_in(DepressionKind.SLOT, "rectangular", frame, group, (), end.body, is_open=True)
    return replace(slot, width=width, tags=("through",))


def _round_bottomed(brep: Brep, group: set[int], tunnel: Tunnel, planes: Sequence[FaceRecord]) -> Depression | None:
    """Two flanks and the round between them: a slot with a round bottom, or cut through a plate with a round end."""
    flanks = facing_pair(planes, None)
    if flanks is None:
        return None
    rounds = brep.of_kind(SurfaceKind.CYLINDER, sorted(group))
    if not rounds:
        return None
    bottom = max(rounds, key=lambda face: face.area)
    normal = bottom.point_normal
    frame = frame_of(brep, group, normal, None, tunnel.axis)
    length, width, depth = frame.size
    if exceeds(depth, length) and reaches(depth, ELONGATED * width):  # as of slots with flat ends
        frame = frame_of(brep, group, upwards(tunnel.axis), None, normal)
        slot = depression_in(DepressionKind.SLOT, "obround", frame, group, (), bottom.body, is_open=True)
        return replace(slot, tags=("through",), corner_radius=bottom.radius)
    kind = DepressionKind.SLOT if reaches(length, width) else DepressionKind.NOTCH
    found = depression_in(kind, "free", frame, group, (bottom.id,), bottom.body, is_open=True)
    return replace(found, tags=("u_shaped",), corner_radius=bottom.radius)


def _passage(brep: Brep, group: set[int], tunnel: Tunnel) -> Depression:
    frame = frame_of(brep, group, upwards(tunnel.axis), None)
    body = brep.faces[min(group)].body
    is_open = not tunnel.closed
    return depression_in(DepressionKind.PASSAGE, tunnel.outline, frame, group, (), body, is_open=is_open)


def _is_walled_in(
    graph: ConcaveGraph, floor: FaceRecord, walls: Sequence[FaceRecord], group: set[int], others: Set[int]
) -> bool:
    """Do faces of the group, or round ones that bulge in, stand all around the floor, but where other cuts break in?"""
    if not floor.loops or not floor.loops[0].outer:
        return False
    closed, broken = 0, 0
    for e in floor.loops[0].edges:
        edge = graph.brep.edges[e]
        bulges = edge.convexity is EdgeConvexity.CONCAVE and all(
            graph.brep.faces[f].outward > 0 for f in edge.faces if f not in group
        )
        falls = any(graph.brep.faces[f].outward > 0 for f in edge.faces)  # over a round, to another side of the body
        if bulges or (edge.convexity is EdgeConvexity.SMOOTH and set(edge.faces) <= group and not falls):
            closed += 1
        elif all(other in others or other in graph.taken for other in edge.faces if other != floor.id):
            broken += 1
        else:
            return False
    if not broken:
        return closed > 0
    directions: list[FaceRecord] = []
    for wall in walls:
        if wall.kind is not SurfaceKind.PLANE or all(dot(wall.axis, d.axis) < math.cos(0.2) for d in directions):
            directions.append(wall)
    return len(directions) > 3 or (len(directions) == 3 and not _is_square(directions))


def _is_square(walls: Sequence[FaceRecord]) -> bool:
    first = walls[0].axis
    return all(parallel(wall.axis, first, 0.05) or abs(dot(wall.axis, first)) < 0.05 for wall in walls)


def _links_by_plane(planes: Sequence[FaceRecord], own: dict[int, set[int]]) -> dict[int, set[int]]:
    """What stands on each plane of the group, its pieces taken together where other cuts have parted it."""
    owners = first_of_surface(planes)
    links: dict[int, set[int]] = {face.id: set() for face in planes}
    for face in planes:
        links[owners[face.id]] |= own[face.id]
    return {face.id: links[owners[face.id]] for face in planes}


def _wall_links(graph: ConcaveGraph, face: int, group: set[int]) -> set[int]:
    """The faces of the group that stand on this one: planes, also over a fillet, and hollow walls with a sharp foot."""
    found: set[int] = set()
    pieces = graph.flush(face)
    for piece in pieces:
        for other in graph.concave[piece] & group - pieces:
            if other in graph.blends and not graph.is_sharp(piece, other):
                found |= {f for f in graph.concave[other] & group if f not in graph.blends and f != piece}
            else:
                found.add(other)
    kinds = (SurfaceKind.PLANE, SurfaceKind.CYLINDER)
    return {f for f in found if graph.brep.faces[f].kind in kinds and graph.brep.faces[f].outward <= 0}
