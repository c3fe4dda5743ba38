"""Blocks with machining features at random places, which cut into each other, and which cutter left each face.

The classes are those of MFCAD++. Each feature is a cutter, a prism in the frame of one side of the block: u and v along
the side, w into the material. A face belongs to the cutter on whose surface it lies.
"""

from __future__ import annotations

import math
from collections.abc import Callable, Iterator
from dataclasses import dataclass
from itertools import pairwise

import numpy as np
from build123d import Box, Edge, Face, Part, Plane, Pos, Solid, Vector, Wire, extrude

_OUT = 2.0
"""So far a cutter reaches out of the block, mm."""
NEAR_MM = 1e-5
"""A point this near to a cutter's surface lies on it."""


@dataclass(frozen=True, slots=True)
class Cut:
    """A cutter and the class of what it leaves."""

    label: str
    solid: Solid


@dataclass(frozen=True, slots=True)
class _Side:
    """A side of the block: `u` and `v` long, `w` deep. Corner of the frame at the block's own corner."""

    plane: Plane
    u: float
    v: float
    w: float

    def down(self, outline: Wire, depth: float) -> Solid:
        """An outline in u and v, cut straight down."""
        start = self.plane.offset(_OUT)
        return extrude(start.from_local_coords(Face(outline)), depth + _OUT, dir=-self.plane.z_dir).solid()

    def along(self, profile: Wire, low: float, high: float) -> Solid:
        """A profile in u (x) and w (y, into the material), run along v from `low` to `high`."""
        origin = self.plane.from_local_coords((0.0, low, 0.0))
        frame = Plane(origin, x_dir=self.plane.x_dir, z_dir=self.plane.y_dir)  # its y is -z of the side: w
        return extrude(frame.from_local_coords(Face(profile)), high - low, dir=self.plane.y_dir).solid()


def _polygon(*points: tuple[float, float]) -> Wire:
    return Wire.make_polygon([Vector(*p) for p in points], close=True)


def _regular(sides: int, u: float, v: float, radius: float, turn: float) -> Wire:
    angles = [turn + 2 * math.pi * i / sides for i in range(sides)]
    return _polygon(*((u + radius * math.cos(a), v + radius * math.sin(a)) for a in angles))


def _circle(u: float, v: float, radius: float) -> Wire:
    return Wire([Edge.make_circle(radius, Plane((u, v, 0)))])


def _with_arc(points: list[tuple[float, float]], middle: tuple[float, float]) -> Wire:
    """The polygon, where an arc through `middle` leads from the last point to the first."""
    lines = [Edge.make_line(Vector(*a), Vector(*b)) for a, b in pairwise(points)]
    return Wire([*lines, Edge.make_three_point_arc(Vector(*points[-1]), Vector(*middle), Vector(*points[0]))])


class _Dice:
    """Sizes as shares of the side at hand."""

    def __init__(self, roll: Callable[[float, float], float], side: _Side) -> None:
        self.roll, self.side = roll, side
        self.least = min(side.u, side.v)
        self.depth = self.roll(0.1, 0.6) * side.w
        self.through = side.w + _OUT
        self.ends = (-_OUT, side.v + _OUT)

    def inside(self, radius: float) -> tuple[float, float]:
        """A place where a circle of this radius stays on the side."""
        u, v = (self.roll(1.15 * radius, length - 1.15 * radius) for length in (self.side.u, self.side.v))
        return u, v


def _prism(sides: int, *, through: bool) -> Callable[[_Dice], Solid]:
    def cut(d: _Dice) -> Solid:
        radius = d.roll(0.08, 0.28) * d.least
        outline = _regular(sides, *d.inside(radius), radius, d.roll(0, 2 * math.pi))
        return d.side.down(outline, d.through if through else d.depth)

    return cut


def _rectangle(*, through: bool) -> Callable[[_Dice], Solid]:
    def cut(d: _Dice) -> Solid:
        a, b = (d.roll(0.1, 0.45) * length for length in (d.side.u, d.side.v))
        u, v = d.roll(0.05, 0.5) * d.side.u, d.roll(0.05, 0.5) * d.side.v
        return d.side.down(_polygon((u, v), (u + a, v), (u + a, v + b), (u, v + b)), d.through if through else d.depth)

    return cut


def _hole(*, through: bool) -> Callable[[_Dice], Solid]:
    def cut(d: _Dice) -> Solid:
        radius = d.roll(0.04, 0.2) * d.least
        return d.side.down(_circle(*d.inside(radius), radius), d.through if through else d.depth)

    return cut


def _ring(d: _Dice) -> Solid:
    radius = d.roll(0.12, 0.3) * d.least
    u, v = d.inside(radius)
    outer = d.side.down(_circle(u, v, radius), d.depth)
    return (outer - d.side.down(_circle(u, v, d.roll(0.4, 0.8) * radius), d.depth + 1)).solid()


def _obround(d: _Dice) -> Solid:
    radius, length = d.roll(0.06, 0.16) * d.least, d.roll(0.1, 0.3) * d.side.u
    u, v = d.roll(1.1 * radius, d.side.u - length - 1.1 * radius), d.roll(1.1 * radius, d.side.v - 1.1 * radius)
    line = [Edge.make_line(Vector(u, v - radius), Vector(u + length, v - radius))]
    line.append(
        Edge.make_three_point_arc(
            Vector(u + length, v - radius), Vector(u + length + radius, v), Vector(u + length, v + radius)
        )
    )
    line.append(Edge.make_line(Vector(u + length, v + radius), Vector(u, v + radius)))
    line.append(Edge.make_three_point_arc(Vector(u, v + radius), Vector(u - radius, v), Vector(u, v - radius)))
    return d.side.down(Wire(line), d.depth)


def _slot_span(d: _Dice) -> tuple[float, float]:
    width = d.roll(0.08, 0.35) * d.side.u
    u = d.roll(0.08, 0.9) * (d.side.u - width)
    return u, u + width


def _through_slot(d: _Dice) -> Solid:
    a, b = _slot_span(d)
    return d.side.along(_polygon((a, -_OUT), (b, -_OUT), (b, d.depth), (a, d.depth)), *d.ends)


def _triangular_slot(d: _Dice) -> Solid:
    a, b = _slot_span(d)
    return d.side.along(_polygon((a, 0), (a, -_OUT), (b, -_OUT), (b, 0), ((a + b) / 2, d.depth)), *d.ends)


def _circular_slot(d: _Dice) -> Solid:
    a, b = _slot_span(d)
    b = min(b, a + 1.6 * d.side.w)
    r = (b - a) / 2
    return d.side.along(_with_arc([(a, 0), (a, -_OUT), (b, -_OUT), (b, 0)], ((a + b) / 2, r)), *d.ends)


def _blind_slot(d: _Dice) -> Solid:
    a, b = _slot_span(d)
    return d.side.down(_polygon((a, -_OUT), (b, -_OUT), (b, reach := d.roll(0.2, 0.7) * d.side.v), (a, reach)), d.depth)


def _round_ended(d: _Dice) -> Solid:
    a, b = _slot_span(d)
    b = min(b, a + 0.6 * d.side.v)
    reach = d.roll(0.1, 0.6) * d.side.v
    outline = _with_arc([(a, reach), (a, -_OUT), (b, -_OUT), (b, reach)], ((a + b) / 2, reach + (b - a) / 2))
    return d.side.down(outline, d.depth)


def _cutter_ended(d: _Dice) -> Solid:
    """A slot whose floor rises along an arc: by a disc cutter."""
    low, high = _slot_span(d)
    depth = min(d.depth, 0.5 * d.side.v)
    reach = d.roll(1.1 * depth, 0.8 * d.side.v)
    arc = (reach - depth * (1 - math.sqrt(0.5)), depth * math.sqrt(0.5))
    # u and v change places: the profile lies in v and w and runs along u.
    points = [(reach, 0.0), (reach, -_OUT), (-_OUT, -_OUT), (-_OUT, depth), (reach - depth, depth)]
    side = d.side.plane
    frame = Plane(side.from_local_coords((high, 0.0, 0.0)), x_dir=side.y_dir, z_dir=-side.x_dir)  # its y is w
    return extrude(frame.from_local_coords(Face(_with_arc(points, arc))), high - low, dir=-side.x_dir).solid()


def _through_step(d: _Dice) -> Solid:
    a = d.roll(0.1, 0.5) * d.side.u
    return d.side.along(_polygon((-_OUT, -_OUT), (a, -_OUT), (a, d.depth), (-_OUT, d.depth)), *d.ends)


def _two_sided_step(d: _Dice) -> Solid:
    a, b = d.roll(0.2, 0.5) * d.side.u, d.roll(0.2, 0.5) * d.side.w
    corner = (d.roll(0.55, 0.9) * a, d.roll(0.55, 0.9) * b)
    return d.side.along(_polygon((-_OUT, -_OUT), (a, -_OUT), (a, 0), corner, (0, b), (-_OUT, b)), *d.ends)


def _slanted_step(d: _Dice) -> Solid:
    a, b = d.roll(0.2, 0.6) * d.side.u, d.roll(0.2, 0.6) * d.side.w
    return d.side.along(_polygon((-_OUT, -_OUT), (a, -_OUT), (a, 0), (0, b), (-_OUT, b)), *d.ends)


def _corner_step(d: _Dice) -> Solid:
    a, b = d.roll(0.1, 0.5) * d.side.u, d.roll(0.1, 0.5) * d.side.v
    return d.side.down(_polygon((-_OUT, -_OUT), (a, -_OUT), (a, b), (-_OUT, b)), d.depth)


def _triangular_step(d: _Dice) -> Solid:
    a, b = d.roll(0.15, 0.5) * d.side.u, d.roll(0.15, 0.5) * d.side.v
    return d.side.down(_polygon((-_OUT, -_OUT), (a, -_OUT), (a, 0), (0, b), (-_OUT, b)), d.depth)


def _circular_step(d: _Dice) -> Solid:
    radius = d.roll(0.1, 0.3) * d.least
    return d.side.down(_circle(d.roll(1.1 * radius, d.side.u - 1.1 * radius), 0.0, radius), d.depth)


def _chamfer(d: _Dice) -> Solid:
    a = d.roll(0.03, 0.08) * min(d.side.u, d.side.w)
    return d.side.along(_polygon((-_OUT, -_OUT), (a, -_OUT), (a, 0), (0, a), (-_OUT, a)), *d.ends)


def _round(d: _Dice) -> Solid:
    a = d.roll(0.04, 0.12) * min(d.side.u, d.side.w)
    middle = (a * (1 - math.sqrt(0.5)),) * 2
    return d.side.along(_with_arc([(0, a), (-_OUT, a), (-_OUT, -_OUT), (a, -_OUT), (a, 0)], middle), *d.ends)


CUTTERS: dict[str, Callable[[_Dice], Solid]] = {
    "through_hole": _hole(through=True),
    "blind_hole": _hole(through=False),
    "Oring": _ring,
    "chamfer": _chamfer,
    "round": _round,
    "rectangular_passage": _rectangle(through=True),
    "triangular_passage": _prism(3, through=True),
    "6sides_passage": _prism(6, through=True),
    "rectangular_pocket": _rectangle(through=False),
    "triangular_pocket": _prism(3, through=False),
    "6sides_pocket": _prism(6, through=False),
    "circular_end_pocket": _obround,
    "rectangular_through_slot": _through_slot,
    "triangular_through_slot": _triangular_slot,
    "circular_through_slot": _circular_slot,
    "rectangular_blind_slot": _blind_slot,
    "v_circular_end_blind_slot": _round_ended,
    "h_circular_end_blind_slot": _cutter_ended,
    "rectangular_through_step": _through_step,
    "2sides_through_step": _two_sided_step,
    "slanted_through_step": _slanted_step,
    "rectangular_blind_step": _corner_step,
    "triangular_blind_step": _triangular_step,
    "circular_blind_step": _circular_step,
}


EDGE_BREAKS = ("chamfer", "round")
"""Made last, if at all."""
LEAST_LEFT = 0.25
"""Of the block's volume, so much stays."""


def _sides(size: tuple[float, float, float]) -> Iterator[_Side]:
    """All frames of a block from the origin: six sides, each with u and v in both orders."""
    directions = {0: Vector(1, 0, 0), 1: Vector(0, 1, 0), 2: Vector(0, 0, 1)}
    for axis in range(3):
        for up in (False, True):
            a, b = (i for i in range(3) if i != axis)
            for u, v in ((a, b), (b, a)):
                z = directions[axis] * (1 if up else -1)
                x, y = directions[u], directions[v]
                right = x.cross(y).dot(z) > 0
                origin = directions[axis] * (size[axis] if up else 0.0)
                if not right:  # the frame begins at the other end of v
                    origin, y = origin + y * size[v], -y
                yield _Side(Plane(origin, x_dir=x, z_dir=z), size[u], size[v], size[axis])


def block(seed: int, cuts: int) -> tuple[Part, list[Cut]]:
    """One solid block with `cuts` features cut one after the other, repeatable by seed."""
    generator = np.random.default_rng(seed)

    def roll(low: float, high: float) -> float:
        return float(generator.uniform(low, high))

    size = (roll(20, 60), roll(20, 60), roll(20, 60))
    body = Pos(*(length / 2 for length in size)) * Box(*size)
    sides = list(_sides(size))
    names = list(CUTTERS)
    made: list[Cut] = []
    while len(made) < cuts:
        last = len(made) == cuts - 1
        name = names[generator.integers(len(names))]
        if name in EDGE_BREAKS and not last:
            continue
        cutter = CUTTERS[name](_Dice(roll, sides[generator.integers(len(sides))]))
        left = body - cutter
        whole = len(left.solids()) == 1 and left.is_valid and left.volume > LEAST_LEFT * math.prod(size)
        if whole and left.volume < body.volume - 1e-3:
            body = left
            made.append(Cut(name, cutter))
    return body, made


def cutter_of(face: Face, cuts: list[Cut]) -> int | None:
    """Which cutter left the face, by its place in order? None where it is of the block itself."""
    point = face.position_at(0.5, 0.5)
    inside = point if face.is_inside(point) else face.center()
    for number, cut in enumerate(cuts):
        if cut.solid.shell().distance_to(inside) < NEAR_MM:
            return number
    return None
