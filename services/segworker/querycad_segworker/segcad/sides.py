"""From which sides is a part visible?"""

from __future__ import annotations

import math
from collections.abc import Sequence

import numpy as np
from numpy.typing import NDArray

from querycad_contracts import Part, Side, Vector
from querycad_segworker.render.raycast import Scene
from querycad_segworker.render.visibility import FaceVisibility
from querycad_segworker.topology import Brep
from querycad_segworker.vectors import add, cross, dot, perpendicular, scale, sub

SEEN_SHARE = 0.03
"""A face counts as seen when its visible projected area is more than this share of its area. The views are turned by
one degree, so that faces seen edge-on show sin(1 degree) = 1.7 % of themselves."""
OPENING_SHARE = 0.25
"""An opening counts as seen when at least this share of the points spread over it is."""
OPENING_ANGLE_RAD = math.radians(75.0)
"""An opening turned away by more than this shows less than a quarter of its area."""


def with_sides(parts: Sequence[Part], brep: Brep, scene: Scene, visibility: FaceVisibility) -> list[Part]:
    """The same parts, each with the sides it is visible from.

    What has an opening is visible where one looks into that opening; anything else, and what is open at a border,
    where its faces own pixels.
    """
    seen_faces = _seen_faces(brep, visibility)
    openings = _openings(parts)
    points = [p for _, _, normal, disc in openings for p in disc]
    normals = [normal for _, _, normal, disc in openings for _ in disc]
    seen = scene.sees(points, normals) if points else np.zeros((len(Side), 0), dtype=np.bool_)
    opening_sides: dict[int, set[Side]] = {}
    start = 0
    for index, _, normal, disc in openings:
        share = seen[:, start : start + len(disc)].mean(axis=1)
        start += len(disc)
        found = opening_sides.setdefault(index, set())
        for row, side in enumerate(Side):
            if share[row] >= OPENING_SHARE and dot(normal, side.outward) > math.cos(OPENING_ANGLE_RAD):
                found.add(side)
    result = []
    for index, part in enumerate(parts):
        if index in opening_sides:
            sides = opening_sides[index]
        else:
            sides = {side for row, side in enumerate(Side) if bool(seen_faces[row, list(part.faces)].any())}
        result.append(part.model_copy(update={"sides": tuple(side for side in Side if side in sides)}))
    return result


def _seen_faces(brep: Brep, visibility: FaceVisibility) -> NDArray[np.bool_]:
    """(6, F): which faces are seen from which side?"""
    areas = np.array([max(face.area, 1e-30) for face in brep.faces])
    visible_m2 = visibility.pixels * (visibility.pixel_m**2)[:, None]
    seen: NDArray[np.bool_] = visible_m2 > SEEN_SHARE * areas
    return seen


def _openings(parts: Sequence[Part]) -> list[tuple[int, Vector, Vector, list[Vector]]]:
    """(index of the part, centre, outward normal, points spread over the opening) for each opening of each part."""
    found = []
    for index, part in enumerate(parts):
        if part.opening is None or part.normal is None or "open" in part.tags:
            continue
        ends = [(part.opening, part.normal)]
        if part.bottom == "through":
            far = sub(scale(part.center, 2.0), part.opening)
            ends.append((far, scale(part.normal, -1.0)))
        reach = part.radius or min(part.width or 0.0, part.length or part.width or 0.0) / 2
        for center, normal in ends:
            x = perpendicular(normal)
            y = cross(normal, x)
            disc = [center]
            for i in range(6):
                angle = i * math.pi / 3
                offset = add(scale(x, math.cos(angle)), scale(y, math.sin(angle)))
                disc.append(add(center, scale(offset, 0.7 * reach)))
            found.append((index, center, normal, disc))
    return found
