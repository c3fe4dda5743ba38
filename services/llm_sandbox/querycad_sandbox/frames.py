"""Axes of a part's or face's own, and the openings of what is cut in: derived from what recognition measured."""

from __future__ import annotations

import math
from collections.abc import Sequence
from dataclasses import dataclass
from typing import Any, Final

from querycad_contracts import Face, Outline, Part, PartKind, Vector

_ACROSS: Final = 1e-3
"""A direction this near to right angles to another one is across it, as a cosine: below any draft."""


@dataclass(frozen=True, slots=True)
class LocalFrame:
    """A point and three unit vectors at right angles, in the frame of the file. Metres."""

    origin: Vector
    x: Vector
    y: Vector
    z: Vector


@dataclass(frozen=True, slots=True)
class Opening:
    """Where a hole, pocket or slot meets the outside. Metres."""

    center: Vector
    normal: Vector
    outline: Outline


def frame_measures(frame: LocalFrame) -> dict[str, Any]:
    """What does a program see of a frame?"""
    return {"origin": frame.origin, "x": frame.x, "y": frame.y, "z": frame.z}


def opening_measures(opening: Opening) -> dict[str, Any]:
    """What does a program see of an opening?"""
    return {"center": opening.center, "normal": opening.normal, "outline": opening.outline.value}


def face_frame(face: Face) -> LocalFrame | None:
    """The frame of a plane face: z out of the material, x along its length. None for other faces."""
    if face.normal is None or face.along is None:
        return None
    return _frame(face.center, face.normal, face.along)


def part_frame(part: Part, faces: Sequence[Face]) -> LocalFrame | None:
    """The frame of a part made of these faces: z along its axis or normal, x along its longest plane face across z.

    A part without such a face is round about z: any direction across does. None for a part without axis and normal.
    """
    z = part.axis or part.normal
    if z is None:
        return None
    across = [face for face in faces if face.along is not None and face.length and abs(_dot(face.along, z)) < _ACROSS]
    longest = max(across, key=lambda face: face.length or 0.0, default=None)
    helper: Vector = (1.0, 0.0, 0.0) if abs(z[0]) < 0.7 else (0.0, 1.0, 0.0)
    return _frame(part.center, z, longest.along if longest is not None and longest.along is not None else helper)


def openings_of(part: Part) -> list[Opening]:
    """The openings of what is cut in: where it begins and, of what goes through, where it ends."""
    if part.opening is None or part.normal is None:
        return []
    outline = _outline(part)
    found = [Opening(part.opening, part.normal, outline)]
    if part.bottom == "through" and part.depth is not None:
        x, y, z = (c - part.depth * n for c, n in zip(part.opening, part.normal, strict=True))
        a, b, c = part.normal
        found.append(Opening((x, y, z), (-a, -b, -c), outline))
    return found


def _outline(part: Part) -> Outline:
    named = {"circular": Outline.CIRCLE, "rectangular": Outline.RECTANGLE, "obround": Outline.SLOT}
    told = [outline for tag, outline in named.items() if tag in part.tags]
    if len(told) == 1:
        return told[0]
    return Outline.CIRCLE if part.kind is PartKind.HOLE else Outline.FREE


def _frame(origin: Vector, z: Vector, toward: Vector) -> LocalFrame:
    along = _dot(toward, z)
    x = _unit((toward[0] - along * z[0], toward[1] - along * z[1], toward[2] - along * z[2]))
    y = (z[1] * x[2] - z[2] * x[1], z[2] * x[0] - z[0] * x[2], z[0] * x[1] - z[1] * x[0])
    return LocalFrame(origin, x, y, z)


def _dot(a: Vector, b: Vector) -> float:
    return a[0] * b[0] + a[1] * b[1] + a[2] * b[2]


def _unit(a: Vector) -> Vector:
    length = math.hypot(*a)
    return (a[0] / length, a[1] / length, a[2] / length)
