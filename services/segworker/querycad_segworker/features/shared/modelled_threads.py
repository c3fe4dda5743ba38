"""Modelled threads: faces that wind around a bore or shaft, bounded by helices, made one wall with it."""

from __future__ import annotations

import math
from collections import defaultdict
from collections.abc import Sequence
from dataclasses import dataclass, replace

from querycad_contracts import SurfaceKind
from querycad_segworker.tolerances import Tolerances
from querycad_segworker.topology import Brep, EdgeKind, EdgeRecord

from .axes import Axis, Wall
from .refusals import refuse

MIN_TURNS = 2.0
"""Fewer turns are a helical groove, as in twist drills and oil grooves, or a ramp."""
MIN_TURNS_OF_AN_EDGE = 0.9
"""Writers cut helices at whole turns or not at all; a shorter one hardly tells its pitch."""
MAX_PITCH = 1.0
"""Steeper than one diameter a turn is a worm's or drill's flute, no thread: coarse pitches (ISO 261) are below 0.25."""
SAME_RADIUS = 0.02
"""A helix keeps its radius within this share: run-outs aside, threads are cylindrical."""
MAX_AXES = 20
"""Threads lie on the main axes of their body."""


@dataclass(frozen=True, slots=True)
class _Helix:
    """One helical edge around an axis. Metres."""

    edge: EdgeRecord
    axis: Axis
    radius: float
    pitch: float
    turns: float


def with_threads(brep: Brep, walls: Sequence[Wall], tolerances: Tolerances) -> list[Wall]:
    """The same walls, where those of a modelled thread are one wall with a pitch.

    It has the radius that the bare cylinder has: the core's of a nut thread, the outer one of a bolt thread.
    """
    helices = _helices(brep, walls, tolerances)
    if not helices:
        return list(walls)
    found: list[Wall] = []
    used: set[int] = set()
    for group in helices:
        turns = sum(helix.turns for helix in group)
        if turns < MIN_TURNS:
            refuse("thread", (f for helix in group for f in helix.edge.faces), f"it has {turns:.1f} turns only")
            continue
        faces = {face for helix in group for face in helix.edge.faces}
        lead = group[0]
        own = [w for w in walls if not faces.isdisjoint(w.faces) and w.axis.same_line(lead.axis, tolerances)]
        faces |= {face for wall in own for face in wall.faces}
        inner = _is_inner(brep, faces, lead.axis)
        radii = [w.radius for w in own if w.kind is SurfaceKind.CYLINDER] or [helix.radius for helix in group]
        points = [p for f in faces for e in brep.face_edges[f] for p in (brep.edges[e].start, brep.edges[e].end)]
        positions = [lead.axis.position(p) for p in points]
        radius = min(radii) if inner else max(radii)
        used |= faces
        found.append(
            Wall(
                kind=SurfaceKind.CYLINDER,
                axis=lead.axis,
                radius_low=radius,
                radius_high=radius,
                low=min(positions),
                high=max(positions),
                sweep=2 * math.pi,
                outward=-1 if inner else 1,
                faces=tuple(sorted(faces)),
                body=brep.faces[min(faces)].body,
                pitch=lead.pitch,
            )
        )
    kept = [replace(w, faces=tuple(f for f in w.faces if f not in used)) for w in walls]
    return [wall for wall in kept if wall.faces] + found


def _helices(brep: Brep, walls: Sequence[Wall], tolerances: Tolerances) -> list[list[_Helix]]:
    """The helical edges of each thread: those of one body, axis and pitch whose radii are near each other."""
    axes: dict[int, list[Axis]] = defaultdict(list)
    candidates = [edge for edge in brep.edges if _may_be_helix(edge)]
    if not candidates:
        return []
    for wall in sorted(walls, key=lambda w: -w.sweep):
        known = axes[wall.body]
        if len(known) < MAX_AXES and not any(axis.same_line(wall.axis, tolerances) for axis in known):
            known.append(wall.axis)
    groups: list[list[_Helix]] = []
    for edge in candidates:
        body = brep.faces[edge.faces[0]].body
        helix = next((h for axis in axes[body] if (h := _helix(edge, axis)) is not None), None)
        if helix is None:
            continue
        for group in groups:
            first = group[0]
            same = brep.faces[first.edge.faces[0]].body == body and first.axis.same_line(helix.axis, tolerances)
            if same and abs(first.pitch - helix.pitch) < 0.02 * helix.pitch and _near(first.radius, helix.radius):
                group.append(helix)
                break
        else:
            groups.append([helix])
    return groups


def _near(a: float, b: float) -> bool:
    """Crest and root of one thread: the outer diameter is at most a third larger than the core (ISO 724, M1)."""
    return max(a, b) < 1.4 * min(a, b)


def _may_be_helix(edge: EdgeRecord) -> bool:
    return (
        edge.kind is EdgeKind.OTHER
        and not edge.closed
        and len(edge.faces) == 2
        and edge.length > 3 * math.dist(edge.start, edge.end)
    )


def _helix(edge: EdgeRecord, axis: Axis) -> _Helix | None:
    """The edge as a helix around the axis, if its ends, middle and length agree with one."""
    radii = [axis.radius_of(p) for p in edge.points]
    radius = sum(radii) / 3
    if radius <= 0 or max(radii) - min(radii) > SAME_RADIUS * radius:
        return None
    start, middle, end = (axis.position(p) for p in edge.points)
    rise = abs(end - start)
    around = math.sqrt(max(edge.length**2 - rise**2, 0.0))
    turns = around / (2 * math.pi * radius)
    if turns < MIN_TURNS_OF_AN_EDGE or rise <= 0 or abs(middle - (start + end) / 2) > 0.05 * rise:
        return None
    pitch = rise / turns
    return _Helix(edge, axis, radius, pitch, turns) if pitch < MAX_PITCH * 2 * radius else None


def _is_inner(brep: Brep, faces: set[int], axis: Axis) -> bool:
    """Does the thread look at its axis? Its cylinders tell; without any, its flanks, which lean that way."""
    cylinders = brep.of_kind(SurfaceKind.CYLINDER, faces)
    if cylinders:
        return sum(face.outward * face.area for face in cylinders) < 0
    outwards = 0.0
    for f in faces:
        face = brep.faces[f]
        radius = axis.radius_of(face.point)
        step = tuple(p + 0.01 * radius * n for p, n in zip(face.point, face.point_normal, strict=True))
        outwards += math.copysign(face.area, axis.radius_of((step[0], step[1], step[2])) - radius)
    return outwards < 0
