"""The mesh: what it refuses and what it says of itself."""

from __future__ import annotations

from pathlib import Path

import numpy as np
import pytest

from querycad_segworker.mesh import Mesh

VERTICES = np.array([[0, 0, 0], [1, 0, 0], [0, 2, 0], [9, 9, 9]], dtype=np.float64)
TRIANGLES = np.array([[0, 1, 2], [2, 1, 0]], dtype=np.int32)
FACES = np.array([0, 3], dtype=np.int32)


def test_bounds_are_those_of_the_vertices_in_use() -> None:
    assert Mesh(VERTICES, TRIANGLES, FACES).bounds.tolist() == [[0, 0, 0], [1, 2, 0]]


def test_an_empty_mesh_lies_at_the_origin() -> None:
    assert not Mesh(VERTICES, TRIANGLES[:0], FACES[:0]).bounds.any()


def test_the_mesh_of_some_faces_keeps_their_ids_and_passes_over_unknown_ones() -> None:
    part = Mesh(VERTICES, TRIANGLES, FACES).of_faces(np.array([3, 77]))
    assert part.triangles.tolist() == [[2, 1, 0]]
    assert part.triangle_face.tolist() == [3]


def test_a_mesh_comes_back_from_its_file(tmp_path: Path) -> None:
    Mesh(VERTICES, TRIANGLES, FACES).save(tmp_path / "mesh.npz")
    back = Mesh.load(tmp_path / "mesh.npz")
    assert (back.vertices_m == VERTICES).all()
    assert (back.triangles == TRIANGLES).all()
    assert (back.triangle_face == FACES).all()


@pytest.mark.parametrize(
    ("vertices", "triangles", "faces", "said"),
    [
        (VERTICES.astype(np.float32), TRIANGLES, FACES, "vertices_m must be"),
        (VERTICES[:, :2], TRIANGLES, FACES, "vertices_m must be"),
        (VERTICES, TRIANGLES.astype(np.int64), FACES, "triangles must be"),
        (VERTICES, TRIANGLES.ravel(), FACES, "triangles must be"),
        (VERTICES, TRIANGLES, FACES[:1], "triangle_face must be"),
        (VERTICES, TRIANGLES + np.int32(2), FACES, "outside 0..3"),
        (VERTICES, TRIANGLES - np.int32(1), FACES, "outside 0..3"),
        (VERTICES, TRIANGLES, FACES - np.int32(1), "negative face id"),
        (np.where(VERTICES == 2, np.nan, VERTICES), TRIANGLES, FACES, "not finite"),
        (np.where(VERTICES == 2, np.inf, VERTICES), TRIANGLES, FACES, "not finite"),
    ],
)
def test_arrays_that_are_no_mesh_are_refused(vertices: object, triangles: object, faces: object, said: str) -> None:
    with pytest.raises(ValueError, match=said):
        Mesh(vertices, triangles, faces)  # type: ignore[arg-type]
