"""Which way does the surface point at each corner of its triangles?"""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

from querycad_segworker.mesh import Mesh


def smooth_normals(mesh: Mesh) -> NDArray[np.float32]:
    """Which normals do the corners of the triangles have? (T, 3, 3) float32, unit; zero for a triangle without area.

    At a vertex, the area-weighted mean over the triangles of the *same face*: a face is smooth within itself, and an
    edge between two faces stays sharp.
    """
    corners = mesh.vertices_m[mesh.triangles]
    area_vectors = np.cross(corners[:, 1] - corners[:, 0], corners[:, 2] - corners[:, 0])
    scale = np.abs(area_vectors).max(initial=0.0) or 1.0
    area_vectors /= scale  # tiny models would lose their squares below
    face_count = int(mesh.triangle_face.max(initial=0)) + 1
    keys = mesh.triangles.astype(np.int64) * face_count + mesh.triangle_face[:, None]
    _, group = np.unique(keys, return_inverse=True)
    group = group.reshape(-1)
    sums = np.stack(
        [np.bincount(group, weights=np.repeat(area_vectors[:, axis], 3)) for axis in range(3)], axis=1
    ).reshape(-1, 3)
    length = np.linalg.norm(sums, axis=1, keepdims=True)
    unit = (sums / np.where(length > 0, length, 1)).astype(np.float32)
    smooth: NDArray[np.float32] = unit[group].reshape(-1, 3, 3)
    return smooth
