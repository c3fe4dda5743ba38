"""What gets a mark? Every part that a person could point at, and the faces that are in none."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass

from querycad_contracts import Face, Part, PartKind, Side, Vector
from querycad_segworker.fusing.region import region_id

MOST = 96
"""Candidates of a model, the largest first: more numbers than this nobody reads, and each costs room in a picture."""
FREE_SHARE = 0.005
"""Of the model's surface: a face in no part that is smaller is what is left over between parts."""


@dataclass(frozen=True, slots=True)
class Candidate:
    """What one number stands for."""

    part: str
    """Id of a recognised part, or of a region made of one face."""
    faces: tuple[int, ...]
    area: float
    """Of all its faces, m2."""
    sides: tuple[Side, ...] = ()
    """From which an opening is looked into; empty where its faces tell."""
    anchor_m: Vector | None = None


def candidates(parts: Sequence[Part], faces: Sequence[Face]) -> tuple[tuple[Candidate, ...], int]:
    """Which are there, the largest first, and how many are left out? Each set of faces is marked once.

    Bodies count where there are several. What breaks an edge, is a group of other parts, or the sunk end of a hole that
    has a mark of its own, does not.
    """
    areas = [face.area for face in faces]
    several = sum(part.kind is PartKind.BODY for part in parts) > 1
    sunk = {child for part in parts if part.kind.cuts_in for child in part.children}  # a hole's counterbore …
    found: dict[frozenset[int], Candidate] = {}
    for part in parts:
        own = frozenset(part.faces)
        if own and own not in found and part.id not in sunk and _is_pointed_at(part, several):
            opens = part.opening is not None and part.normal is not None
            found[own] = Candidate(
                part.id,
                tuple(sorted(own)),
                sum(areas[face] for face in own),
                part.sides if opens else (),
                part.opening if opens else None,
            )
    covered = frozenset[int]().union(*found)
    least = FREE_SHARE * sum(areas)
    free = (face for face in faces if face.id not in covered and face.area >= least)
    every = [*found.values(), *(Candidate(region_id([face.id]), (face.id,), face.area) for face in free)]
    every.sort(key=lambda one: (-one.area, one.part))
    return tuple(every[:MOST]), max(0, len(every) - MOST)


def _is_pointed_at(part: Part, several_bodies: bool) -> bool:
    if part.kind is PartKind.BODY:
        return several_bodies
    return part.kind.is_feature and not part.kind.breaks_edge
