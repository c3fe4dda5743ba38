"""Boxes in a feature's own frame, and the names of outlines."""

from __future__ import annotations

import math
from collections import defaultdict
from collections.abc import Callable, Collection, Iterable, Sequence
from dataclasses import dataclass

from querycad_contracts import Vector
from querycad_segworker.features.shared.reach import edges_span
from querycad_segworker.tolerances import Tolerances
from querycad_segworker.topology import Brep, EdgeKind, EdgeRecord, Loop
from querycad_segworker.vectors import (
    add,
    cross,
    dist,
    dot,
    mean,
    norm,
    parallel,
    perpendicular,
    scale,
    span,
    sub,
    unit,
)

POLYGONS = {3: "triangular", 4: "rectangular", 5: "pentagonal", 6: "hexagonal", 8: "octagonal"}
"""Names of outlines by their number of sides."""
ARCHED = "arched"
"""Two sides along each other, a third across, and a round top."""
SKEW = math.sin(math.radians(3.0))
"""Sides that run apart by more than this lean on purpose; converted files are off by far less."""

HULL = 0.75
"""An outline whose sides are less than that on its convex hull is no polygon with a name: a notch is as deep as long,
so with .75 that in a square may take .4 of a side."""
BROKEN_CORNER = 0.25
"""A side this much shorter than both its neighbours breaks their corner; those of a regular octagon are alike."""
FLUSH = 1e-3
"""Corners this much of the longest side beyond another are on it."""


@dataclass(frozen=True, slots=True)
class LocalFrame:
    """A box in a depression's own frame: unit vectors u (length), v (width), n (out), and its low corner and size."""

    u: Vector
    v: Vector
    n: Vector
    low: tuple[float, float, float]
    size: tuple[float, float, float]

    def point(self, a: float, b: float, c: float) -> Vector:
        """The point at these shares of the box."""
        u, v, n = (low + share * size for low, size, share in zip(self.low, self.size, (a, b, c), strict=True))
        return add(add(scale(self.u, u), scale(self.v, v)), scale(self.n, n))


def frame_of(
    brep: Brep, faces: Collection[int], normal: Vector, rim: Loop | None, along: Vector | None = None
) -> LocalFrame:
    """The box of some faces along `normal` and the direction of their longest straight edge across it."""
    return frame_of_edges(brep, brep.edges_of(faces), normal, rim, along)


def frame_of_edges(
    brep: Brep, edges: Collection[int], normal: Vector, rim: Loop | None, along: Vector | None = None
) -> LocalFrame:
    """The box of some edges, as for `frame_of`; exact for lines and arcs."""
    straight: dict[Vector, float] = defaultdict(float)
    exact: dict[Vector, Vector] = {}  # edges are gathered by rounded direction, the box is turned by an exact one
    for e in rim.edges if rim is not None else edges:
        edge = brep.edges[e]
        way = sub(edge.end, edge.start)
        flat = sub(way, scale(normal, dot(way, normal)))
        if edge.kind is EdgeKind.LINE and norm(flat) > 0.7 * edge.length:
            d = unit(flat)
            d = d if (d > (-d[0], -d[1], -d[2])) else scale(d, -1.0)
            rounded = (round(d[0], 4), round(d[1], 4), round(d[2], 4))
            straight[rounded] += edge.length
            exact.setdefault(rounded, d)
    longest = max(straight, key=lambda d: straight[d], default=None)
    u = along or (exact[longest] if longest is not None else perpendicular(normal))
    u = unit(sub(u, scale(normal, dot(u, normal))))
    return _frame_of_ranges(lambda way: edges_span(brep, edges, way), normal, u, turn=along is None)


def frame_of_points(points: Collection[Vector], normal: Vector, u: Vector) -> LocalFrame:
    """The box of some points along `normal` and the unit vector `u` across it, or turned: its longer side is u's."""
    return _frame_of_ranges(lambda way: span(points, way), normal, u, turn=True)


def _frame_of_ranges(
    range_of: Callable[[Vector], tuple[float, float]], normal: Vector, u: Vector, *, turn: bool
) -> LocalFrame:
    """The box with these ranges along `normal`, the unit vector `u` across it, and square to both.

    With `turn` its longer side across the normal is u's.
    """
    v = cross(normal, u)
    ranges = [range_of(way) for way in (u, v, normal)]
    if turn and ranges[1][1] - ranges[1][0] > (ranges[0][1] - ranges[0][0]) * (1 + 1e-9):
        u, v = v, scale(u, -1.0)
        ranges[:2] = [ranges[1], (-ranges[0][1], -ranges[0][0])]
    low = (ranges[0][0], ranges[1][0], ranges[2][0])
    size = tuple(b - a for a, b in ranges)
    return LocalFrame(u, v, normal, low, (size[0], size[1], size[2]))


def face_points(brep: Brep, faces: Iterable[int]) -> list[Vector]:
    """Which points span some faces: those of all their edges?"""
    return [p for face in faces for e in brep.face_edges[face] for p in brep.edge_points[e]]


@dataclass(frozen=True, slots=True)
class Bow:
    """A slot bent along an arc: between two arcs around one centre, with a half circle at each end. Metres, radians."""

    radius: float
    """Of its centre line."""
    width: float
    angle: float
    """Between the centres of its ends."""
    middle: Vector
    """Half-way along its centre line."""


def bow_of(arcs: Sequence[EdgeRecord], tolerances: Tolerances) -> Bow | None:
    """Do these arcs outline a bent slot (of some length, in any number of pieces)?"""
    circles: list[tuple[Vector, float, float]] = []
    near = 10 * tolerances.length
    for arc in arcs:
        if arc.center is None or not arc.radius:
            return None
        for i, (center, radius, angle) in enumerate(circles):
            if (
                dist(center, arc.center) <= 10 * tolerances.length
                and abs(radius - arc.radius) <= 10 * tolerances.length
            ):
                circles[i] = (center, radius, angle + arc.length / arc.radius)
                break
        else:
            circles.append((arc.center, arc.radius, arc.length / arc.radius))
    if len(circles) != 4:
        return None
    inner, outer = sorted(circles, key=lambda circle: circle[1])[2:]
    ends = sorted(circles, key=lambda circle: circle[1])[:2]
    width = outer[1] - inner[1]
    half_turns = all(abs(r - width / 2) <= near and abs(angle - math.pi) < 0.05 for _, r, angle in ends)
    if not half_turns or dist(inner[0], outer[0]) > near:
        return None
    radius = (inner[1] + outer[1]) / 2
    # The middle of an arc lies from its centre towards the mean of its points, weighted by their pieces' chords.
    sides = [arc for arc in arcs if arc.center and arc.radius and arc.radius > radius]
    chords = [scale(sub(arc.mid, outer[0]), math.sin(arc.length / 2 / outer[1])) for arc in sides]
    return Bow(radius, width, outer[2], add(outer[0], scale(unit(mean(chords)), radius)))


def outline_of(brep: Brep, rim: Loop, tolerances: Tolerances) -> tuple[str, float | None]:
    """The name of the rim's outline, and the radius of its rounded corners."""
    edges = [brep.edges[e] for e in rim.edges]
    lines = [edge for edge in edges if edge.kind is EdgeKind.LINE]
    arcs = [edge for edge in edges if edge.kind is EdgeKind.CIRCLE]
    if len(lines) + len(arcs) < len(edges):
        return "free", None
    if not lines:
        centers = {
            tuple(round(c / max(tolerances.length * 10, 1e-12)) for c in arc.center) for arc in arcs if arc.center
        }
        if len(centers) == 1:
            return "circular", None
        bow = bow_of(arcs, tolerances)
        return ("curved", bow.width / 2) if bow is not None else ("free", None)
    directions = _runs(lines, tolerances)
    half_turns = [arc for arc in arcs if arc.radius and abs(arc.length - math.pi * arc.radius) < 0.02 * arc.length]
    if len(directions) == 2 and len(half_turns) in (2, 4):
        return "obround", half_turns[0].radius
    total_arc = sum(arc.length / arc.radius for arc in arcs if arc.radius)
    if len(directions) == 2 and parallel(directions[0], directions[1], SKEW) and abs(total_arc - 2 * math.pi) < 0.1:
        return "obround", arcs[0].radius
    radii = [arc.radius for arc in arcs if arc.radius]
    name = polygon_name(directions) if len(directions) <= 4 else _polygon(lines, [arc for arc in arcs if arc.radius])
    return name, min(radii) if radii else None


def _polygon(lines: Sequence[EdgeRecord], arcs: Sequence[EdgeRecord]) -> str:
    """The name of an outline by the sides of its convex hull, of which small notches and broken corners are no part.

    'polygonal' where the hull has less than `HULL` of the length of all sides: an L, a cross or a comb.
    """
    normal = next((n for edge in lines if norm(n := cross(lines[0].direction, edge.direction)) > SKEW), None)
    if normal is None:
        return polygon_name([])
    normal = unit(normal)
    corners = [point for edge in (*lines, *arcs) for point in (edge.start, edge.end)]
    longest = max(edge.length for edge in lines)
    sides: list[tuple[float, float, Vector]] = []  # angle of the normal, length, direction
    for edge in lines:
        along = edge.direction
        across = cross(along, normal)
        heights = [dot(sub(corner, edge.start), across) for corner in corners]
        if max(heights) > FLUSH * longest:
            across, heights = scale(across, -1.0), [-height for height in heights]
        if max(heights) > FLUSH * longest:
            continue
        angle = math.atan2(dot(across, cross(normal, lines[0].direction)), dot(across, lines[0].direction))
        same = next((i for i, side in enumerate(sides) if abs(math.remainder(side[0] - angle, math.tau)) < SKEW), None)
        if same is None:
            sides.append((angle, edge.length, along))
        else:
            sides[same] = (sides[same][0], sides[same][1] + edge.length, sides[same][2])
    if sum(length for _, length, _ in sides) < HULL * sum(edge.length for edge in lines):
        return polygon_name([])
    sides.sort()
    neighbours = zip(sides[-1:] + sides[:-1], sides, sides[1:] + sides[:1], strict=True)
    return polygon_name([side[2] for one, side, other in neighbours if side[1] > BROKEN_CORNER * min(one[1], other[1])])


def polygon_name(sides: Sequence[Vector]) -> str:
    """What is an outline called that has these sides, given as unit directions along them, or across?

    With four sides 'rectangular' where all corners are square, 'trapezoidal' where only two sides are parallel. With
    three 'arched' where two are parallel: no triangle, a curve closes them, as of a window or a lug.
    """
    pairs = [(a, b) for i, a in enumerate(sides) for b in sides[i + 1 :]]
    parallels = sum(parallel(a, b, SKEW) for a, b in pairs)
    if len(sides) == 3 and parallels:
        return ARCHED
    if len(sides) != 4:
        return POLYGONS.get(len(sides), "polygonal")
    if parallels == 2:
        return "rectangular" if sum(abs(dot(a, b)) <= SKEW for a, b in pairs) == 4 else "rhomboid"
    return "trapezoidal" if parallels == 1 else "polygonal"


def _runs(lines: Sequence[EdgeRecord], tolerances: Tolerances) -> list[Vector]:
    """The sides of an outline: collinear neighbouring lines are one side."""
    sides: list[tuple[Vector, Vector]] = []
    for line in lines:
        start, d = line.start, line.direction
        if not any(
            parallel(d, other, 1e-3) and norm(cross(sub(start, origin), other)) <= 10 * tolerances.length
            for origin, other in sides
        ):
            sides.append((start, d))
    return [d for _, d in sides]
