"""Which faces of a model are so? Faces by kind, direction, size and axis, and the part that each belongs to."""

from __future__ import annotations

from collections.abc import Sequence

from querycad_contracts import Face, FaceQuery, Line, Part, PartKind, Side, as_drawn

from .tolerances import FACING, Tolerances
from .vectors import dot, line_distance, parallel


def owned(faces: Sequence[Face], parts: Sequence[Part]) -> tuple[Face, ...]:
    """The faces, each with the part that it belongs to: the smallest feature that it is of, else its body."""
    owner: dict[int, Part] = {}
    for part in parts:
        if part.kind in (PartKind.MODEL, PartKind.PATTERN):
            continue
        for face in part.faces:
            if face not in owner or _rank(part) < _rank(owner[face]):
                owner[face] = part
    return tuple(face.model_copy(update={"part": owner[face.id].id}) if face.id in owner else face for face in faces)


def _rank(part: Part) -> tuple[int, int]:
    """Features before bodies, bodies before single surfaces; of features the one of fewest faces."""
    return (0 if part.kind.is_feature else 1 if part.kind is PartKind.BODY else 2), len(part.faces)


def chosen(faces: Sequence[Face], query: FaceQuery, diagonal_m: float) -> tuple[Face, ...]:
    """Which of the faces match the query? `diagonal_m`: of the model's box, which tolerances follow."""
    tolerances = Tolerances.for_diagonal(diagonal_m)
    return tuple(face for face in faces if _is_so(face, query, tolerances))


def _is_so(face: Face, query: FaceQuery, tolerances: Tolerances) -> bool:
    return (
        (query.kind is None or face.kind is query.kind)
        and (query.convexity is None or face.convexity is query.convexity)
        and (query.body is None or face.body == query.body)
        and (query.facing is None or _faces(face, query.facing))
        and (query.radius is None or _has_radius(face, query.radius))
        and (query.coaxial_with is None or _around(face, query.coaxial_with, tolerances))
    )


def _faces(face: Face, side: Side) -> bool:
    return face.normal is not None and dot(face.normal, side.outward) > FACING.parallel


def _has_radius(face: Face, radius: float) -> bool:
    return face.radius is not None and as_drawn(face.radius, radius)


def _around(face: Face, line: Line, tolerances: Tolerances) -> bool:
    """Is the face of revolution about the line?"""
    if face.axis is None or face.axis_point is None or not parallel(face.axis, line.direction, tolerances.angle):
        return False
    return line_distance(face.axis_point, line.point, line.direction) <= 10 * tolerances.length
