"""How is a strip of sheet bent? A helper of this folder's sheet-metal models."""

from __future__ import annotations

import math
from collections.abc import Sequence

from build123d import Face, Polyline, Vector, fillet, make_face


def strip(points: Sequence[tuple[float, float]], t: float, radius: float) -> Face:
    """The profile of a strip: `points` are one side's corners, the sheet lies to the left; `radius` inside."""
    pts = [Vector(*q) for q in points]
    left = []
    for i, q in enumerate(pts):
        dirs = []
        if i > 0:
            dirs.append((q - pts[i - 1]).normalized())
        if i < len(pts) - 1:
            dirs.append((pts[i + 1] - q).normalized())
        normals = [Vector(-d.Y, d.X) for d in dirs]
        if len(normals) == 1:
            left.append(q + normals[0] * t)
        else:
            n = normals[0] + normals[1]
            left.append(q + n * (t / (1 + normals[0].dot(normals[1]))))
    face = make_face(Polyline(*[(v.X, v.Y) for v in pts + left[::-1]], close=True))
    for i in range(1, len(pts) - 1):
        a, b = pts[i] - pts[i - 1], pts[i + 1] - pts[i]
        turn_left = a.X * b.Y - a.Y * b.X > 0
        for corner, inside in ((pts[i], not turn_left), (left[i], turn_left)):
            near = [v for v in face.vertices() if math.hypot(v.X - corner.X, v.Y - corner.Y) < 1e-4]
            face = fillet(near, radius if inside else radius + t)
            face = face.face() if not isinstance(face, Face) else face
    return face
