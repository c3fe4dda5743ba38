"""Where can two fingers take hold? Pairs of plane faces that face away from each other."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from typing import Any

from querycad_contracts import Vector
from querycad_contracts.parameters import Grasp
from querycad_contracts.vectors import ORIGIN, add, cross, dot, scale, sub

from .frames import Rigid, told, told_length

OPPOSITE = 0.99985
"""Cosine of one degree: how far from parallel two faces may be, as recognition takes walls to be opposite."""
SHARED = 0.25
"""Of the smaller face, that the other has to be opposite to."""
MOST = 10
"""Pairs that are told; a gripper's planner tries the first few."""
FACES = 60
"""Plane faces that are looked at, the largest: pairs grow with their square, and small faces hold nothing."""

PLANES = """def own(face):
    try:
        return [list(face.local_size), list(face.frame.x)]
    except AttributeError:
        return None

part = find_parts({{"ids": ["{part}"]}})[0]
flat = [face for face in {faces} if face.kind == "plane"]
flat = sorted(flat, key=lambda face: -face.area)[:{most}]
solution = [[f.id, list(f.center), list(f.normal), f.area, list(f.extents), own(f)] for f in flat]"""


@dataclass(frozen=True, slots=True)
class Flat:
    """A plane face: its middle, outward normal, area in m2, its length and width, and the direction of its length.

    One of free outline has no length of its own: then `extents` are those of its box along the file's axes.
    """

    id: int
    center: Vector
    normal: Vector
    area: float
    length: float
    width: float
    along: Vector
    extents: Vector | None = None

    @classmethod
    def of(cls, told_by_program: Sequence[Any]) -> Flat:
        """As `PLANES` tells it."""
        face, center, normal, area, extents, own = told_by_program
        if own is None:
            along = Rigid.along(ORIGIN, tuple(normal)).x
            return cls(face, tuple(center), tuple(normal), area, 0.0, 0.0, along, tuple(extents))
        (length, width, _), along = own
        return cls(face, tuple(center), tuple(normal), area, length, width, tuple(along))

    def half(self, way: Vector) -> float:
        """How far does its rectangle reach along a direction in its plane, from its middle?"""
        if self.extents is not None:
            return sum(abs(a * b) for a, b in zip(way, self.extents, strict=True)) / 2
        across = cross(self.normal, self.along)
        return (abs(dot(self.along, way)) * self.length + abs(dot(across, way)) * self.width) / 2


def grasps(faces: Sequence[Flat], frame: Rigid, metres: float, at_most: float | None) -> list[Grasp]:
    """The pairs, those that share the largest area first, no farther apart than `at_most` metres."""
    found = []
    for number, one in enumerate(faces):
        for other in faces[number + 1 :]:
            pair = _pair(one, other)
            if pair is not None and (at_most is None or pair[1] <= at_most + 1e-9):
                found.append(pair)
    found.sort(key=lambda pair: (-round(pair[2], 12), pair[3]))
    return [
        Grasp(
            center=told(frame.point(center), metres),
            closing=told(frame.direction(closing), 1.0),
            along=told(frame.direction(along), 1.0),
            distance=told_length(distance, metres),
            area=told_length(area, metres**2),
            faces=ids,
        )
        for center, distance, area, ids, closing, along in found[:MOST]
    ]


def _pair(one: Flat, other: Flat) -> tuple[Vector, float, float, tuple[int, int], Vector, Vector] | None:
    """Centre, distance, shared area, ids, closing, along; None where they are no such pair."""
    if dot(one.normal, other.normal) > -OPPOSITE:
        return None
    apart = sub(other.center, one.center)
    distance = dot(apart, other.normal)
    if distance <= 0:  # they face each other, as the walls of a slot do
        return None
    u, v = one.along, cross(one.normal, one.along)
    low_u, high_u = _shared(one, other, dot(apart, u), u)
    low_v, high_v = _shared(one, other, dot(apart, v), v)
    area = min(max(0.0, high_u - low_u) * max(0.0, high_v - low_v), one.area, other.area)
    if high_u <= low_u or high_v <= low_v or area < SHARED * min(one.area, other.area):
        return None
    center = add(one.center, add(scale(u, (low_u + high_u) / 2), scale(v, (low_v + high_v) / 2)))
    along = u if high_u - low_u >= high_v - low_v else v
    return (
        add(center, scale(other.normal, distance / 2)),
        distance,
        area,
        (one.id, other.id),
        scale(one.normal, -1.0),
        along,
    )


def _shared(one: Flat, other: Flat, offset: float, way: Vector) -> tuple[float, float]:
    return max(-one.half(way), offset - other.half(way)), min(one.half(way), offset + other.half(way))
