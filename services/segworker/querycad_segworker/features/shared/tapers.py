"""Openings that narrow or widen: their sizes at mouth and bottom, and the draft of their walls."""

from __future__ import annotations

import math
from collections.abc import Collection

from querycad_contracts import SurfaceKind, Vector
from querycad_segworker.features.shared.reach import edges_span
from querycad_segworker.topology import Brep, EdgeConvexity
from querycad_segworker.vectors import dot

from .adjacency import is_blend
from .frames import frame_of_edges

LEAST_DRAFT_RAD = math.radians(0.2)
"""Half of the smallest draft that moulds are given; less is an error of conversion."""
MOST_DRAFT_RAD = math.radians(45.0)
"""Walls that lean more are a funnel or a bevel rather than drafted."""
SAME_RAD = math.radians(0.2)
"""Walls drafted alike lean alike to this."""
DIFFERENT = 0.005
"""A mouth that differs from the bottom by less than this share is as wide."""


def draft_of(brep: Brep, faces: Collection[int], normal: Vector) -> float | None:
    """How far do all walls lean from `normal`, in radians? None where they stand upright, or lean unlike each other."""
    leans: list[float] = []
    for i in faces:
        face = brep.faces[i]
        if face.kind is SurfaceKind.PLANE:
            lean = abs(math.asin(max(-1.0, min(1.0, dot(face.axis, normal)))))
        elif face.kind is SurfaceKind.CONE and abs(dot(face.axis, normal)) > math.cos(LEAST_DRAFT_RAD):
            lean = face.half_angle
        elif face.kind is SurfaceKind.CYLINDER and abs(dot(face.axis, normal)) > math.cos(LEAST_DRAFT_RAD):
            if is_blend(brep, face):
                continue
            lean = 0.0
        else:
            continue
        if lean <= MOST_DRAFT_RAD:
            leans.append(lean)
    if not leans or min(leans) < LEAST_DRAFT_RAD or max(leans) - min(leans) > SAME_RAD:
        return None
    return sum(leans) / len(leans)


def mouth_and_bottom(
    brep: Brep, faces: Collection[int], normal: Vector, draft: float | None
) -> tuple[tuple[float, float], tuple[float, float]] | None:
    """How large is an opening at its mouth and at its bottom, (length, width) of both in metres?

    `faces`: its walls and floor, without broken edges of the mouth; `normal` points out of it. With one `draft` of all
    walls, in radians, the bottom is the mouth less twice depth times tan(draft), whatever rounds its foot; else it is
    as large as the sharp outline of the floor, or of the far mouth. None where both are alike.
    """
    edges = brep.edges_of(faces)
    low, high = edges_span(brep, edges, normal)
    near = 0.01 * (high - low)
    mouth = _level_edges(brep, edges, normal, high, near)
    if near <= 0 or not mouth:
        return None
    upper = frame_of_edges(brep, mouth, normal, None).size[:2]
    if draft is not None:
        less = 2 * (high - low) * math.tan(draft) * (1 if _narrows(brep, faces, normal) else -1)
        lower = (upper[0] - less, upper[1] - less)
    else:
        floor = _level_edges(brep, edges, normal, low, near)
        if not floor or any(brep.edges[e].convexity is EdgeConvexity.SMOOTH for e in floor):
            return None
        along, across = frame_of_edges(brep, floor, normal, None).size[:2]
        lower = (along, across)
    if min(*upper, *lower) <= 0:
        return None
    if all(abs(a - b) <= DIFFERENT * max(a, b) for a, b in zip(upper, lower, strict=True)):
        return None
    return (upper[0], upper[1]), lower


def _narrows(brep: Brep, faces: Collection[int], normal: Vector) -> bool:
    """Does one see the walls when one looks into the opening?"""
    leans = sum(
        dot(brep.faces[i].point_normal, normal) * brep.faces[i].area
        for i in faces
        if abs(dot(brep.faces[i].point_normal, normal)) < math.sin(MOST_DRAFT_RAD)
    )
    return leans > 0


def _level_edges(brep: Brep, edges: Collection[int], normal: Vector, level: float, near: float) -> set[int]:
    """Those edges that lie at one level."""
    return {e for e in edges if all(abs(dot(p, normal) - level) <= near for p in brep.edge_points[e])}
