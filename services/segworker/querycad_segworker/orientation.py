"""From which side is the surface looked at? Triangles of bodies turned outwards, and whether backs can be seen at all.

The back of a triangle is never seen where every body is closed and points outwards: whoever looks from outside meets a
front first. A renderer then draws half of the triangles.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import replace

import numpy as np
from numpy.typing import NDArray

from .mesh import Mesh

_MIX = np.array([0x9E3779B97F4A7C15, 0xC2B2AE3D27D4EB4F, 0x165667B19E3779F9], dtype=np.uint64)
"""Odd numbers without a pattern (golden ratio; xxHash's primes), which spread the bits of coordinates."""


def outward(mesh: Mesh, bodies: Sequence[Sequence[int]]) -> Mesh:
    """The same triangles, those of bodies that are inside out turned; `closed` says whether no back can be seen.

    bodies: ids of the faces of each. Files store bodies inside out, and mirrored ones come out so.
    """
    body_of_face = np.full(int(mesh.triangle_face.max(initial=-1)) + 1, len(bodies), dtype=np.int64)
    for number, faces in enumerate(bodies):
        known = np.asarray(faces, dtype=np.int64)
        body_of_face[known[known < len(body_of_face)]] = number  # a face without triangles may have a higher id
    body = body_of_face[mesh.triangle_face]
    volumes = np.bincount(body, weights=_volumes(mesh), minlength=len(bodies) + 1)
    triangles = mesh.triangles.copy()
    inside_out = (volumes < 0)[body]
    triangles[inside_out] = triangles[inside_out, ::-1]
    borders = np.zeros(len(bodies) + 1, dtype=np.uint64)
    np.add.at(borders, body, _projected(mesh.vertices_m, triangles))
    return replace(mesh, triangles=triangles, closed=bool(len(triangles)) and not borders.any())


def _volumes(mesh: Mesh) -> NDArray[np.float64]:
    """Signed volumes of the tetrahedra between each triangle and the middle; their sum is a closed body's volume."""
    corners = mesh.vertices_m[mesh.triangles] - mesh.bounds.mean(axis=0)
    volumes: NDArray[np.float64] = np.einsum("ij,ij->i", corners[:, 0], np.cross(corners[:, 1], corners[:, 2])) / 6
    return volumes


def _projected(vertices_m: NDArray[np.float64], triangles: NDArray[np.int32]) -> NDArray[np.uint64]:
    """Twice each triangle's signed area in a plane where every point has a place of its own by chance, modulo 2^64.

    A surface without a border covers any plane as often from one side as from the other, so its areas sum to zero; with
    a border they do so for no more than one choice of places in some 2^60. Vertices are one point when their
    coordinates are equal: the triangles of neighbouring faces have the very points of their common edge.
    """
    bits = (vertices_m + 0.0).view(np.uint64)  # + 0.0: minus zero is zero
    places = []
    for turn in range(2):
        mixed = bits * np.roll(_MIX, turn)
        mixed ^= mixed >> np.uint64(29)
        place = (mixed * np.roll(_MIX, turn + 1)).sum(axis=1, dtype=np.uint64)
        places.append((place ^ (place >> np.uint64(32))) * _MIX[turn])
    (x, y) = (place[triangles] for place in places)
    areas: NDArray[np.uint64] = (
        x[:, 0] * (y[:, 1] - y[:, 2]) + x[:, 1] * (y[:, 2] - y[:, 0]) + x[:, 2] * (y[:, 0] - y[:, 1])
    )
    return areas
