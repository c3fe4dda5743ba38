"""Meshes made by hand, whose pictures can be worked out on paper."""

from __future__ import annotations

from collections.abc import Sequence

import numpy as np
from numpy.typing import NDArray

from querycad_segworker.mesh import Mesh

Corners = Sequence[Sequence[float]]

TOP, BOTTOM, LEFT, RIGHT, FRONT, BACK = range(6)


def quads(*faces: Sequence[Corners]) -> Mesh:
    """A mesh of faces, each given as its quadrilaterals, each given as four corners."""
    corners = [quad for face in faces for quad in face]
    owner = [index for index, face in enumerate(faces) for _ in face]
    vertices = np.array(corners, dtype=np.float64).reshape(-1, 3)
    first = 4 * np.arange(len(corners), dtype=np.int32)
    triangles = np.stack([first, first + 1, first + 2, first, first + 2, first + 3], axis=1).reshape(-1, 3)
    return Mesh(vertices, triangles, np.repeat(np.array(owner, dtype=np.int32), 2))


def box_faces(low: Sequence[float], high: Sequence[float]) -> list[list[Corners]]:
    """The six faces of a box, in the order of Side: top, bottom, left, right, front, back; corners outwards."""
    (a, b, c), (x, y, z) = low, high
    return [
        [[(a, b, z), (x, b, z), (x, y, z), (a, y, z)]],
        [[(a, b, c), (a, y, c), (x, y, c), (x, b, c)]],
        [[(a, b, c), (a, b, z), (a, y, z), (a, y, c)]],
        [[(x, b, c), (x, y, c), (x, y, z), (x, b, z)]],
        [[(a, b, c), (x, b, c), (x, b, z), (a, b, z)]],
        [[(a, y, c), (a, y, z), (x, y, z), (x, y, c)]],
    ]


def box(low: Sequence[float] = (-0.5, -0.5, -0.5), high: Sequence[float] = (0.5, 0.5, 0.5)) -> Mesh:
    """A closed box."""
    return quads(*box_faces(low, high))


def tunnel() -> Mesh:
    """The box from -1 to 1 with a square tunnel of width 1 along z.

    Faces 0 to 5 are outside, in the order of Side; 6 to 9 are the tunnel's walls at -x, x, -y, y.
    """
    faces = box_faces((-1, -1, -1), (1, 1, 1))
    for index, z in ((TOP, 1.0), (BOTTOM, -1.0)):
        faces[index] = [
            [(-1, -1, z), (1, -1, z), (1, -0.5, z), (-1, -0.5, z)],
            [(-1, 0.5, z), (1, 0.5, z), (1, 1, z), (-1, 1, z)],
            [(-1, -0.5, z), (-0.5, -0.5, z), (-0.5, 0.5, z), (-1, 0.5, z)],
            [(0.5, -0.5, z), (1, -0.5, z), (1, 0.5, z), (0.5, 0.5, z)],
        ]
    h = 0.5
    walls: list[list[Corners]] = [
        [[(-h, -h, -1), (-h, h, -1), (-h, h, 1), (-h, -h, 1)]],
        [[(h, -h, -1), (h, -h, 1), (h, h, 1), (h, h, -1)]],
        [[(-h, -h, -1), (-h, -h, 1), (h, -h, 1), (h, -h, -1)]],
        [[(-h, h, -1), (h, h, -1), (h, h, 1), (-h, h, 1)]],
    ]
    return quads(*faces, *walls)


def sphere(radius: float = 1.0, rings: int = 48) -> Mesh:
    """A ball, all one face, tessellated on meridians and parallels that share their vertices."""
    polar, turn = np.meshgrid(np.linspace(0, np.pi, rings + 1), np.linspace(0, 2 * np.pi, 2 * rings + 1), indexing="ij")
    points = radius * np.stack([np.sin(polar) * np.cos(turn), np.sin(polar) * np.sin(turn), np.cos(polar)], axis=-1)
    index = np.arange(polar.size, dtype=np.int32).reshape(polar.shape)
    a, b, c, d = (part.ravel() for part in (index[:-1, :-1], index[1:, :-1], index[1:, 1:], index[:-1, 1:]))
    triangles = np.concatenate([np.stack([a, b, c], axis=1), np.stack([a, c, d], axis=1)])
    return Mesh(points.reshape(-1, 3), triangles, np.zeros(len(triangles), dtype=np.int32))


def joined(*meshes: Mesh) -> Mesh:
    """All meshes as one; the faces of each are numbered after those of the one before."""
    vertices, triangles, owners = [], [], []
    vertex_count = face_count = 0
    for mesh in meshes:
        vertices.append(mesh.vertices_m)
        triangles.append(mesh.triangles + np.int32(vertex_count))
        owners.append(mesh.triangle_face + np.int32(face_count))
        vertex_count += len(mesh.vertices_m)
        face_count += int(mesh.triangle_face.max()) + 1
    return Mesh(np.concatenate(vertices), np.concatenate(triangles), np.concatenate(owners))


def scaled(mesh: Mesh, factor: float, shift: Sequence[float] = (0.0, 0.0, 0.0)) -> Mesh:
    """The mesh, larger by the factor, then moved."""
    moved: NDArray[np.float64] = mesh.vertices_m * factor + np.asarray(shift, dtype=np.float64)
    return Mesh(moved, mesh.triangles, mesh.triangle_face)


def empty() -> Mesh:
    """No triangles at all."""
    return Mesh(np.zeros((0, 3)), np.zeros((0, 3), dtype=np.int32), np.zeros(0, dtype=np.int32))
