"""Depressions of any outline: pockets, passages, slots, notches and steps cut into the material."""

from __future__ import annotations

import math
from collections import defaultdict
from collections.abc import Collection, Sequence
from dataclasses import replace

from querycad_contracts import SurfaceKind, Vector
from querycad_segworker.features.shared.adjacency import ConcaveGraph
from querycad_segworker.features.shared.clearance import IsClear
from querycad_segworker.features.shared.extruded_walls import ACROSS, MORE_THAN_HALF, tunnel_of
from querycad_segworker.features.shared.frames import bow_of, frame_of, outline_of
from querycad_segworker.features.shared.reach import edges_span, faces_span
from querycad_segworker.features.shared.refusals import refuse
from querycad_segworker.features.shared.walls import Wall
from querycad_segworker.tolerances import FACING, Tolerances
from querycad_segworker.topology import Brep, EdgeConvexity, FaceRecord, Loop
from querycad_segworker.vectors import add, cross, dist, dot, foot, mean, norm, parallel, scale, sub, unit

from .cavities import recognise_cavities
from .concave_regions import group_depression
from .depression import Depression, DepressionKind, depression_in, with_open_ends
from .interrupted_slots import united_slots
from .keyways import with_hosts
from .round_notches import recognise_round_notches
from .slits import recognise_slits
from .slot_sections import relieved_vees, with_run_outs
from .stepped_slots import with_stepped_slots
from .windows import recognise_windows

UPRIGHT = math.sin(math.radians(45.0))
"""Faces that lean less than this off the direction of a depression are its walls, the others its floor."""
STRAIGHT = 0.9998
"""Cosine above which two directions are one: 1.1 degrees, as ACROSS has."""
GROOVE_SHARE = 0.25
"""A groove around an island takes at most this share of the width of its outline on either side."""


def recognise_depressions(
    brep: Brep,
    taken: Collection[int],
    tolerances: Tolerances,
    is_clear: IsClear | None = None,
    found_walls: Sequence[Wall] = (),
) -> list[Depression]:
    """Which depressions does the model have? Sorted by lowest face id. `taken`: faces of holes, which do not count.

    Closed ones are found from their rim: a whole boundary loop of some face along which the material turns away
    (convex edges, or roundings). Open ones are groups of faces that meet in concave edges. With `is_clear`, a slot
    that other features interrupt is one slot.
    """
    graph = ConcaveGraph(brep, taken)
    found = recognise_cavities(brep)
    found.extend(window for window in recognise_windows(brep, tolerances) if not set(window.faces) & set(taken))
    used = set(taken).union(*(cut.faces for cut in found))
    for face, loop, sunk in _rims(brep, graph, used):
        if sunk & used:
            continue
        behind = _behind_rim(brep, graph, face, loop, sunk, tolerances)
        if not behind:
            used.update(sunk)  # closed all around: no step or slot, which run out at a border
        for depression in behind:
            used.update(depression.faces)
            found.append(depression)
    groups = graph.concave_groups(used)
    for group in sorted(groups, key=len, reverse=True):  # a T slot owns its neck, which is a smaller group
        cut = None if group & used else group_depression(brep, group, graph, tolerances, used)
        if cut is None and not group & used:
            refuse("pocket", group, "its faces form neither a floor with walls nor a passage")
        if cut is not None:
            used.update(cut.faces)
            found.append(cut)
    found = with_stepped_slots(graph, found)
    found.extend(recognise_slits(brep, found_walls, used))
    found.extend(recognise_round_notches(brep, found_walls, used, tolerances))
    if is_clear is not None:
        found = united_slots(brep, found, tolerances, is_clear, found_walls)
        found = [with_open_ends(cut, is_clear) for cut in found]
    found.extend(relieved_vees(brep, found))
    found = [with_run_outs(brep, cut) for cut in found]
    return sorted(with_hosts(brep, found), key=lambda d: d.faces[0])


def _rims(brep: Brep, graph: ConcaveGraph, used: Collection[int]) -> list[tuple[FaceRecord, Loop, set[int]]]:
    """All rims with the faces that sink in behind them; first those that the walls run square to.

    Those are mouths; the others may be where another cut opens a wall.
    """
    found = []
    for face in brep.faces:
        for loop in face.loops:
            if loop.outer or (face.id in used and face.id in graph.taken):
                continue
            sunk = graph.behind(face, loop)
            if sunk:
                found.append((face, loop, sunk))
    return sorted(found, key=lambda rim: not _runs_square(brep, rim[0], rim[2]))


def _runs_square(brep: Brep, host: FaceRecord, sunk: Collection[int]) -> bool:
    """Does all that sinks in behind a rim in `host` run straight in or straight across?"""
    if host.kind is not SurfaceKind.PLANE:
        return False
    for face in (brep.faces[i] for i in sunk):
        along = abs(dot(face.axis, host.axis))
        straight = along > STRAIGHT or (face.kind is SurfaceKind.PLANE and along < ACROSS)
        if face.kind not in (SurfaceKind.PLANE, SurfaceKind.CYLINDER) or not straight:
            return False
    return True


def _behind_rim(
    brep: Brep, graph: ConcaveGraph, host: FaceRecord, rim: Loop, sunk: set[int], tolerances: Tolerances
) -> list[Depression]:
    """What was cut in behind a rim: one depression, or several whose openings run into each other.

    Pieces without a floor that run along one direction are one cutout of a composed outline.
    """
    pieces = graph.pieces(sunk)
    beyond = {i for e in rim.edges for i in brep.edges[e].faces} - {host.id}
    tunnels = [tunnel_of(brep, piece) for piece in pieces]
    first = tunnels[0]
    alone = beyond.isdisjoint(graph.taken) and (
        len(pieces) == 1
        or (first is not None and all(t is not None and parallel(t.axis, first.axis, 1e-2) for t in tunnels))
    )
    if alone:
        # A flat on a shaft runs out in it, wherever the shaft's seam lies: no wall stands there.
        runs_out = host.kind is SurfaceKind.CYLINDER and host.outward > 0 and _is_flat(brep, host, beyond & sunk)
        cut = group_depression(brep, sunk, graph, tolerances, set()) if runs_out else None
        depression = cut or _closed(brep, graph, host, rim, sunk, tolerances)
        return [depression] if depression is not None else []
    found = []
    for piece in pieces:
        own_rim = Loop(tuple(e for e in rim.edges if not piece.isdisjoint(brep.edges[e].faces)), rim.outer)
        if own_rim.edges and _holds(brep, host, piece):
            cut = _closed(brep, graph, host, own_rim, piece, tolerances)
        else:
            cut = group_depression(brep, piece, graph, tolerances, sunk - piece)
        if cut is not None:
            found.append(cut)
    return found


def _is_flat(brep: Brep, shaft: FaceRecord, beyond: Collection[int]) -> bool:
    """Is one of the faces beyond a rim in a shaft a plane that looks straight away from its axis?"""
    planes = brep.of_kind(SurfaceKind.PLANE, sorted(beyond))
    feet = ((face, foot(face.point, shaft.origin, shaft.axis)) for face in planes)
    return any(
        abs(dot(face.axis, shaft.axis)) < UPRIGHT and dot(sub(face.point, at), face.axis) > 0 for face, at in feet
    )


def _holds(brep: Brep, host: FaceRecord, piece: set[int]) -> bool:
    """Do the walls of a piece turn so far that it is still closed in, though others break into it?"""
    around = tunnel_of(brep, {f for f in piece if abs(dot(brep.faces[f].facing, host.axis)) < UPRIGHT})
    return around is not None and (around.closed or around.turn > MORE_THAN_HALF)


def _closed(
    brep: Brep, graph: ConcaveGraph, host: FaceRecord, rim: Loop, group: set[int], tolerances: Tolerances
) -> Depression | None:
    """A pocket or passage behind a rim."""
    normal = _out_of(brep, host, rim, group)
    outline, corner = outline_of(brep, rim, tolerances)
    tunnel = tunnel_of(brep, group)
    if tunnel is not None and tunnel.closed and not parallel(tunnel.axis, normal, 1e-2):
        normal = scale(tunnel.axis, math.copysign(1.0, dot(tunnel.axis, normal)))
        outline = tunnel.outline
    inside = {f for f in group - graph.bevels if brep.faces[f].outward <= 0}
    walls = [f for f in group - graph.bevels if abs(dot(brep.faces[f].facing, normal)) < UPRIGHT]
    if not walls:
        refuse("pocket", group, "no wall runs into the material: a shallow hollow")
        return None
    floors = {f for f in inside if dot(brep.faces[f].facing, normal) >= UPRIGHT} or _shared_floor(
        brep, graph, walls, normal
    )
    group = group | floors
    around = tunnel_of(brep, set(walls))
    if around is not None and around.outline != "free":
        outline = around.outline
        rounds = (face.radius for face in brep.of_kind(SurfaceKind.CYLINDER, sorted(walls)) if face.outward < 0)
        corner = min(rounds, default=None) if corner is None else corner  # of a rim on a shaft, no edge is an arc
    frame = frame_of(brep, group, normal, rim if outline != "free" else None)
    mouth = frame if inside == group or not inside | floors else frame_of(brep, inside | floors, normal, None, frame.u)
    kind = DepressionKind.POCKET if floors else DepressionKind.PASSAGE
    if kind is DepressionKind.PASSAGE and around is None and _leads_aside(brep, rim, group, normal):
        refuse("cutout", group, "it ends aside of where it begins, as the inside of a bent tube does")
        return None
    found = depression_in(kind, outline, frame, group, tuple(sorted(floors)), host.body)
    found = replace(found, corner_radius=corner, length=mouth.size[0], width=mouth.size[1])
    bow = bow_of([brep.edges[e] for e in rim.edges], tolerances) if outline == "curved" else None
    if bow is not None:
        off = sub(bow.middle, found.opening)  # the middle of a bent slot is that of its centre line
        shift = sub(off, scale(normal, dot(off, normal)))
        found = replace(found, center=add(found.center, shift), opening=add(found.opening, shift))
        return replace(found, length=bow.radius * bow.angle + bow.width, width=bow.width, angle=bow.angle)
    return _around_island(brep, found) or found


def _leads_aside(brep: Brep, rim: Loop, group: set[int], normal: Vector) -> bool:
    """Does what begins at a rim end beside it, between curved walls: more than the rim's width off to one side?"""
    far = [
        e for i in group for e in brep.face_edges[i] if e not in rim.edges and not group.issuperset(brep.edges[e].faces)
    ]
    if not far or brep.of_kind(SurfaceKind.PLANE, group):
        return False
    middle = mean([brep.edges[e].mid for e in rim.edges])
    reach = max(dist(p, middle) for e in rim.edges for p in brep.edge_points[e])
    off = sub(mean([brep.edges[e].mid for e in far]), middle)
    return norm(sub(off, scale(normal, dot(off, normal)))) > 2 * reach


def _around_island(brep: Brep, pocket: Depression) -> Depression | None:
    """A pocket with an island in it that is level with its rim, and nearly fills it: a groove closed on itself."""
    if len(pocket.floor) != 1 or brep.faces[pocket.floor[0]].kind is not SurfaceKind.PLANE:
        return None
    floor = brep.faces[pocket.floor[0]]
    inner = [loop for loop in floor.loops if not loop.outer]
    inner = [loop for loop in inner if all(brep.edges[e].convexity is EdgeConvexity.CONCAVE for e in loop.edges)]
    if len(inner) != 1:
        return None
    island = {i for e in inner[0].edges for i in brep.edges[e].faces} - {floor.id}
    rise = faces_span(brep, island, floor.axis)[1]
    if abs(rise - dot(floor.point, floor.axis) - pocket.depth) > 0.01 * pocket.depth:
        return None
    sizes = []
    for loop in (floor.loops[0], inner[0]):
        ways = (pocket.direction, cross(floor.axis, pocket.direction))
        ranges = [edges_span(brep, loop.edges, way) for way in ways]
        sizes.append([high - low for low, high in ranges])
    gaps = [(outer - core) / 2 for outer, core in zip(*sizes, strict=True)]
    if min(gaps) <= 0:
        return None
    if max(gaps) > GROOVE_SHARE * pocket.width:
        refuse("groove", pocket.faces, "too wide around its island: a pocket")
        return None
    return replace(pocket, kind=DepressionKind.GROOVE, width=min(gaps), tags=("ring", "annular"))


def _shared_floor(brep: Brep, graph: ConcaveGraph, walls: Sequence[int], normal: Vector) -> set[int]:
    """A floor that another cut has taken already, but that most of the walls stand on."""
    standing: dict[int, int] = defaultdict(int)
    for wall in walls:
        for other in graph.concave[wall]:
            if brep.faces[other].kind is SurfaceKind.PLANE and dot(brep.faces[other].axis, normal) > FACING.alike:
                standing[other] += 1
    return {face for face, count in standing.items() if 2 * count > len(walls)}


def _out_of(brep: Brep, host: FaceRecord, rim: Loop, group: set[int]) -> Vector:
    """The direction out of the opening: the host's normal where it is plane; else away from the floor, or the axis."""
    if host.kind is SurfaceKind.PLANE:
        return host.axis
    planes = brep.of_kind(SurfaceKind.PLANE, group)
    rim_center = mean([brep.edges[e].mid for e in rim.edges])
    facing = [f for f in planes if dot(sub(rim_center, f.point), f.axis) > 0.9 * norm(sub(rim_center, f.point))]
    from_axis = sub(rim_center, foot(rim_center, host.origin, host.axis))
    if host.kind is SurfaceKind.CYLINDER and norm(from_axis) > 0.5 * host.radius:
        out = scale(unit(from_axis), float(host.outward))
        facing = [f for f in facing if dot(f.axis, out) > UPRIGHT]  # the ends of a window face its middle, too
        return max(facing, key=lambda f: f.area).axis if facing else out
    if facing:
        return max(facing, key=lambda f: f.area).axis
    return unit(sub(rim_center, mean([brep.faces[f].point for f in group])))
