"""Grooves turned around shafts and into bores, for retaining rings, O-rings, belts, bearing balls and as undercuts."""

from __future__ import annotations

import math
from collections.abc import Sequence
from dataclasses import dataclass

from querycad_contracts import SurfaceKind, Vector
from querycad_segworker.features.shared.coaxial_stacks import End, Stack, radius_at, stacks, wall_range
from querycad_segworker.features.shared.refusals import refuse
from querycad_segworker.features.shared.walls import Wall, is_waist
from querycad_segworker.tolerances import Tolerances, exceeds, reaches
from querycad_segworker.topology import Brep
from querycad_segworker.vectors import parallel

MAX_WIDTH = 1.0
"""A groove is narrower than its diameter; between collars further apart lies a step of the shaft."""
MAX_RELIEF = 0.2
"""An undercut at a shoulder is no deeper than this share of its diameter: 0.18 for the thread M6 (DIN 76-1). What is
narrower, between a head and what it stands on, is a neck."""
EDGE_BREAK = 2.0
"""What breaks the edge of a groove's wall runs along the axis by no more than this times as far as across it."""
SQUARE = 1e-2
"""Sine of the angle by which a shoulder may deviate from square to the axis."""
MIN_DEPTH = 1e-3
"""Radii that differ by less than this share are those of one fit, not of a groove."""


@dataclass(frozen=True, slots=True)
class TurnedGroove:
    """One groove around an axis. Metres, radians. `radius` is its bottom's; `depth` counts from the nearer shoulder.

    `section`: 'rectangular', 'v_shaped', 'trapezoidal' or 'semicircular' (part of a torus). `width` is that of its
    mouth, `floor_width` that of the straight bottom between leaning flanks. `angle`: between its flanks, where they
    lean. `inner`: it lies in a bore.
    """

    radius: float
    width: float
    depth: float
    center: Vector
    axis: Vector
    section: str
    inner: bool
    floor_width: float | None
    angle: float | None
    faces: tuple[int, ...]


@dataclass(frozen=True, slots=True)
class _Piece:
    """A wall in the profile, by position along the axis; radii negative in a bore, so that a groove is always low."""

    wall: Wall
    low: float
    high: float
    at_low: float
    at_high: float
    bottom: float


def recognise_turned_grooves(brep: Brep, walls: Sequence[Wall], tolerances: Tolerances) -> list[TurnedGroove]:
    """Which grooves are turned into the model's shafts and bores? Sorted by lowest face id."""
    found: list[TurnedGroove] = []
    for outward in (1, -1):

        def belongs(wall: Wall, outward: int = outward) -> bool:
            if wall.kind is SurfaceKind.TORUS and wall.outward < 0:
                return wall.encloses and is_waist(brep.faces[wall.faces[0]]) == (outward > 0)
            return wall.encloses and wall.outward == outward

        for stack in stacks(brep, walls, tolerances, belongs):
            found.extend(_grooves(brep, stack, outward))
    return sorted(found, key=lambda groove: groove.faces[0])


def _grooves(brep: Brep, stack: Stack, outward: int) -> list[TurnedGroove]:
    pieces = sorted((_piece(brep, stack, wall, outward) for wall in stack.walls), key=lambda p: (p.low, p.high))
    found = []
    for i in range(len(pieces)):
        for j in (i, i + 1):  # the bottom is one piece, or where two flanks meet
            span = _span(pieces, i, j)
            if span is not None:
                groove = _groove(brep, stack, pieces, i, j, span, outward)
                if groove is not None:
                    found.append(groove)
    return found


def _piece(brep: Brep, stack: Stack, wall: Wall, outward: int) -> _Piece:
    low, high = wall_range(stack.axis, wall)
    at_low, at_high = (outward * radius_at(stack.axis, wall, end) for end in (False, True))
    bottom = min(at_low, at_high)
    if wall.kind is SurfaceKind.TORUS and wall.outward < 0:  # a convex one rounds an edge and has no throat
        face = brep.faces[wall.faces[0]]
        if low <= stack.axis.position(face.origin) <= high:
            bottom = min(bottom, outward * face.radius - face.minor_radius)
    return _Piece(wall, low, high, at_low, at_high, bottom)


def _span(pieces: Sequence[_Piece], i: int, j: int) -> tuple[int, int] | None:
    """From which to which piece does the groove reach whose bottom is i, or i and j? None when they are no bottom."""
    if j >= len(pieces):
        return None
    a, b = pieces[i], pieces[j]
    near = MIN_DEPTH * abs(a.bottom)
    if i == j:
        dips = a.wall.kind is SurfaceKind.TORUS and min(a.at_low, a.at_high) > a.bottom + near
        if not dips and a.wall.kind is not SurfaceKind.CYLINDER:
            return None
    else:
        meet = abs(a.high - b.low) <= near and abs(a.at_high - b.at_low) <= near
        cones = a.wall.kind is b.wall.kind is SurfaceKind.CONE
        return (i, j) if cones and meet and a.at_low > a.at_high + near and b.at_high > b.at_low + near else None
    first, last = i, j
    if first > 0 and _rises(pieces[first - 1], pieces[first], near, upwards=False):
        first -= 1
    if last < len(pieces) - 1 and _rises(pieces[last + 1], pieces[last], near, upwards=True):
        last += 1
    return first, last


def _rises(flank: _Piece, bottom: _Piece, near: float, *, upwards: bool) -> bool:
    """Is it a cone or fillet that leads from the bottom up to the shaft's surface?"""
    if flank.wall.kind not in (SurfaceKind.CONE, SurfaceKind.TORUS) or bottom.wall.kind is not SurfaceKind.CYLINDER:
        return False
    foot, top = (flank.at_low, flank.at_high) if upwards else (flank.at_high, flank.at_low)
    return abs(foot - bottom.bottom) <= near and top > foot + near


def _groove(
    brep: Brep, stack: Stack, pieces: Sequence[_Piece], i: int, j: int, span: tuple[int, int], outward: int
) -> TurnedGroove | None:
    first, last = span
    bottom = min(pieces[i].bottom, pieces[j].bottom)
    rims = [pieces[first].at_low, pieces[last].at_high]
    at_shoulder = False
    for side, (own, beside) in enumerate(((first, first - 1), (last, last + 1))):
        kind = pieces[own].wall.kind
        if kind is SurfaceKind.CONE or (kind is SurfaceKind.TORUS and own in (i, j)):
            continue  # a flank, or a round bottom, leads up to the rim itself
        at_high = side == 1
        if 0 <= beside < len(pieces):
            rims[side] = _rim(pieces, beside, at_high=at_high)
        else:
            rims[side], at_shoulder = _shoulder(brep, stack, bottom, outward, at_high=at_high), True
    low, high = pieces[first].low, pieces[last].high
    depth = min(rims) - bottom
    members = [piece.wall for piece in pieces[first : last + 1]]
    if depth <= MIN_DEPTH * abs(bottom) or (at_shoulder and exceeds(depth, MAX_RELIEF * 2 * abs(bottom))):
        return None
    if reaches(high - low, MAX_WIDTH * 2 * abs(bottom)):
        refuse("groove", (f for w in members for f in w.faces), "it is wider than its diameter: a step between collars")
        return None
    faces = {face for wall in members for face in wall.faces}
    faces |= {other for face in faces for _, other in brep.neighbours(face) if other in stack.shoulders}
    section, angle = _section(members)
    return TurnedGroove(
        radius=abs(bottom),
        width=high - low,
        depth=depth,
        center=stack.axis.at((low + high) / 2),
        axis=stack.axis.direction,
        section=section,
        inner=outward < 0,
        floor_width=next((wall.height for wall in members if wall.kind is SurfaceKind.CYLINDER and angle), None),
        angle=angle,
        faces=tuple(sorted(faces)),
    )


def _rim(pieces: Sequence[_Piece], beside: int, *, at_high: bool) -> float:
    """How high is the surface beside a groove's square wall, over the chamfer or round of the wall's edge?"""
    edge = pieces[beside]
    near, far = (edge.at_low, edge.at_high) if at_high else (edge.at_high, edge.at_low)
    beyond = beside + (1 if at_high else -1)
    broken = edge.wall.kind is not SurfaceKind.CYLINDER and 0 <= beyond < len(pieces)
    return far if broken and edge.high - edge.low <= abs(far - near) * EDGE_BREAK else near


def _shoulder(brep: Brep, stack: Stack, bottom: float, outward: int, *, at_high: bool) -> float:
    """How high is the plane that a groove's bottom runs into at the end of its stack? As the radii of pieces count.

    It may have any outline, as a hexagon has: what counts is where it comes nearest to the axis. A bore's ends in its
    floor.
    """
    closed = (stack.high_end if at_high else stack.low_end) is End.CLOSED
    faces = [brep.faces[f] for f in stack.beyond(at_high)]
    across = [f for f in faces if f.kind is SurfaceKind.PLANE and parallel(f.axis, stack.axis.direction, SQUARE)]
    if not closed or len(faces) != 1 or not across or not across[0].loops or not across[0].loops[0].outer:
        return -math.inf
    if outward < 0:
        return 0.0 if len(across[0].loops) == 1 else -math.inf
    edges = [brep.edges[e] for e in across[0].loops[0].edges]
    reach = min(stack.axis.radius_of(p) for edge in edges for p in edge.points)
    return reach if reach > bottom else -math.inf


def _section(members: Sequence[Wall]) -> tuple[str, float | None]:
    """What is the groove's cross-section called, and which angle do its flanks enclose?"""
    cones = [wall for wall in members if wall.kind is SurfaceKind.CONE]
    if any(wall.kind is SurfaceKind.TORUS for wall in members) and len(members) == 1:
        return "semicircular", None
    if len(cones) < 2:
        return "rectangular", None
    leans = [math.atan2(wall.height, abs(wall.radius_high - wall.radius_low)) for wall in cones]
    return ("v_shaped" if len(members) == 2 else "trapezoidal"), sum(leans)
