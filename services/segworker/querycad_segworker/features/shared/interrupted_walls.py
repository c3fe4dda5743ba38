"""Round walls that slots, flats or keyways interrupt: the pieces of one cylinder are one wall."""

from __future__ import annotations

import math
from collections import defaultdict
from collections.abc import Collection, Sequence
from dataclasses import replace
from functools import partial

from querycad_contracts import SurfaceKind
from querycad_segworker.tolerances import Tolerances
from querycad_segworker.topology import Brep, EdgeKind, EdgeRecord, FaceRecord, spread
from querycad_segworker.vectors import ORIGIN, binned, dot, parallel

from .axes import Axis, Wall, by_line

MAX_PIECES = 12
"""More pieces than this are the tips of teeth, unless they cover most of the circle."""
MOST = math.radians(216.0)
"""Tips of teeth cover less than three fifths of the circle; grip notches leave more."""
NOTCHED = math.radians(90.0)
"""Pieces that cover a quarter of the circle together are a round part with notches; less are separate arms or teeth."""
WIDEST_NOTCH = math.radians(160.0)
"""A wider gap leaves a part that no longer fills a ring put around it."""
STEEP = math.cos(math.radians(45.0))
"""The walls of a notch meet the rim more steeply than flats and the sides of a polygon do."""
FLATTENED = math.radians(120.0)
"""A bore with two flats (double D) keeps a third of its wall at least; a slot with bowed ends has less."""
BETWEEN = 5
"""So many faces at most lie between two pieces of a bore's wall: a keyway has three, with rounded corners five."""
FULL_RAD = math.radians(361.0)
"""Pieces that cover more together lie above each other, not beside."""
OVERLAP = 0.5
"""Pieces of one cylinder lie beside each other: they share this part of the shorter one's length."""


def with_interrupted(brep: Brep, walls: Sequence[Wall], tolerances: Tolerances) -> list[Wall]:
    """The same walls, where the pieces of one cylinder or cone are one wall when together they enclose it.

    Of an outer one they do when they cover more than half of the circle, or what is left of a rim that notches
    interrupt; of a bore when keyways, splines or two flats lead from each piece to the next, all the way around; of a
    cone, such as the chamfer of a slotted shaft, when they cover more than half of the circle. What another cut left
    beyond a wall that encloses the cylinder alone is of that wall, too.
    """
    buckets: dict[tuple[SurfaceKind, int, int, str], list[int]] = defaultdict(list)
    for i, wall in enumerate(walls):
        if wall.kind in (SurfaceKind.CYLINDER, SurfaceKind.CONE) and wall.sweep < 2 * math.pi:
            buckets[(wall.kind, wall.outward, wall.body, binned(wall.radius))].append(i)
    beside = partial(_beside, tolerances=tolerances)
    merged: dict[int, Wall] = {}
    gone: set[int] = set()
    for (kind, outward, _, _), indices in buckets.items():
        for group in by_line(
            indices, lambda i: walls[i].axis, ORIGIN, 10 * tolerances.length, lambda i, j: beside(walls[i], walls[j])
        ):
            pieces = [walls[i] for i in group]
            covered = sum(piece.sweep for piece in pieces)
            if len(pieces) < 2 or (len(pieces) > MAX_PIECES and covered < MOST):
                continue
            if any(piece.encloses for piece in pieces):
                if covered <= FULL_RAD:
                    merged[min(group)] = _one(pieces, covered)
                    gone.update(group)
            elif outward < 0 and kind is SurfaceKind.CYLINDER:
                if _is_bore(brep, pieces, covered):
                    merged[min(group)] = _one(pieces, 2 * math.pi)
                    gone.update(group)
            elif covered > math.radians(200):
                merged[min(group)] = _one(pieces, covered)
                gone.update(group)
            elif covered > NOTCHED and _is_notched(brep, pieces):
                merged[min(group)] = _one(pieces, 2 * math.pi)
                gone.update(group)
    return [merged.get(i, wall) for i, wall in enumerate(walls) if i in merged or i not in gone]


def _beside(a: Wall, b: Wall, tolerances: Tolerances) -> bool:
    if abs(a.radius - b.radius) > 3 * tolerances.length or not a.axis.same_line(b.axis, tolerances):
        return False
    low, high = sorted((a.axis.position(b.axis.at(b.low)), a.axis.position(b.axis.at(b.high))))
    if a.kind is SurfaceKind.CONE:
        near = 3 * tolerances.length
        narrow = abs(min(a.radius_low, a.radius_high) - min(b.radius_low, b.radius_high))
        return max(abs(a.low - low), abs(a.high - high), narrow) <= near
    return min(high, a.high) - max(low, a.low) > OVERLAP * min(a.height, b.height)


def _is_bore(brep: Brep, pieces: Sequence[Wall], covered: float) -> bool:
    """Are these what keyways, splines or two flats left of the wall of one bore?"""
    axis, radius = pieces[0].axis, pieces[0].radius
    owner = {face: i for i, piece in enumerate(pieces) for face in piece.faces}
    nexts: dict[int, set[int]] = defaultdict(set)
    flats = 0
    for face in owner:
        for first in _along(brep, face, axis) - owner.keys():
            chain = _chain(brep, face, first, axis, owner)
            if chain is None:
                return False
            nexts[owner[face]].add(owner[chain[-1]])
            inside = any(axis.radius_of(brep.faces[i].point) < radius for i in chain[:-1])
            if inside and (len(chain) > 2 or brep.faces[first].kind is not SurfaceKind.PLANE):
                return False
            flats += inside
    if len(spread((0,), lambda piece: nexts[piece])) < len(pieces):
        return False
    if flats:  # each is met from both of its sides
        return len(pieces) == 2 and flats == 4 and covered > FLATTENED
    return covered > NOTCHED and _is_notched(brep, pieces)


def _along(brep: Brep, face: int, axis: Axis) -> set[int]:
    """The faces that border this one along the axis."""
    return {
        other
        for edge, other in brep.neighbours(face)
        if edge.kind is EdgeKind.LINE and parallel(edge.direction, axis.direction, 1e-3)
    }


def _chain(brep: Brep, start: int, first: int, axis: Axis, owner: Collection[int]) -> list[int] | None:
    """The faces from one piece of a wall to the next, which is the last of them; None where they lead elsewhere."""
    chain, before = [first], start
    while chain[-1] not in owner:
        beside = _along(brep, chain[-1], axis) - {before}
        if len(chain) > BETWEEN or len(beside) != 1:
            return None
        before = chain[-1]
        chain.append(beside.pop())
    return chain


def _is_notched(brep: Brep, pieces: Sequence[Wall]) -> bool:
    """Are all gaps between the pieces narrow, with walls that meet the rim steeply?"""
    axis = pieces[0].axis
    own = {face for piece in pieces for face in piece.faces}
    ends = [
        (edge, brep.faces[other])
        for face in own
        for edge, other in brep.neighbours(face)
        if other not in own and parallel(edge.direction, axis.direction, 1e-3)
    ]
    angles = sorted(axis.angle_of(edge.mid) for edge, _ in ends)
    gaps = [b - a for a, b in zip(angles, [*angles[1:], angles[0] + 2 * math.pi], strict=True)] if angles else []
    left = 2 * math.pi - sum(piece.sweep for piece in pieces)  # two slits leave two wide pieces, and narrow gaps
    narrow = min(left, max(gaps, default=0.0)) < WIDEST_NOTCH
    return bool(ends) and narrow and all(_is_steep(axis, edge, face) for edge, face in ends)


def _is_steep(axis: Axis, edge: EdgeRecord, face: FaceRecord) -> bool:
    """Does a face leave a rim around the axis, at this edge, rather towards the axis than along the rim?"""
    if face.kind is SurfaceKind.PLANE:
        normal = face.axis
    elif face.kind is SurfaceKind.CYLINDER:
        normal = Axis.of(face).out_to(edge.mid)
    else:
        normal = face.point_normal
    return abs(dot(normal, axis.out_to(edge.mid))) < STEEP


def _one(pieces: Sequence[Wall], sweep: float) -> Wall:
    """`sweep`: what they enclose together, notches between them included."""
    first = pieces[0]
    ends = [first.axis.position(p.axis.at(end)) for p in pieces for end in (p.low, p.high)]
    return replace(
        first,
        low=min(ends),
        high=max(ends),
        sweep=min(sweep, 2 * math.pi),
        faces=tuple(sorted(face for piece in pieces for face in piece.faces)),
    )
