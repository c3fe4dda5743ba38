"""What other programs are given of a model: triangles with face ids, and plain views."""

from __future__ import annotations

import io

import numpy as np
import pytest
import trimesh

from querycad_contracts import ViewName
from querycad_segworker.errors import UnreadableFile
from querycad_segworker.mesh import Mesh
from querycad_segworker.render.glb import glb
from querycad_segworker.render.plain import picture_of


@pytest.fixture
def box() -> Mesh:
    """1 x 2 x 3 m, a face for each side, in the order of their axes."""
    solid = trimesh.creation.box((1.0, 2.0, 3.0))
    axes = np.abs(solid.face_normals).argmax(axis=1) * 2 + (solid.face_normals.sum(axis=1) > 0)
    return Mesh(solid.vertices.astype(np.float64), solid.faces.astype(np.int32), axes.astype(np.int32))


def loaded(mesh: Mesh) -> trimesh.Scene:
    return trimesh.load(io.BytesIO(glb(mesh)), file_type="glb")


def test_every_triangle_knows_its_face(box: Mesh) -> None:
    (shape,) = loaded(box).geometry.values()
    ids = np.asarray(shape.vertex_attributes["_FACE_ID"]).reshape(-1)
    assert ids.dtype == np.float32
    of_triangles = ids[shape.faces]
    assert (of_triangles == of_triangles[:, :1]).all()
    assert sorted(set(of_triangles[:, 0].astype(int))) == list(range(6))
    for face in range(6):
        area = shape.area_faces[of_triangles[:, 0] == face].sum()
        assert area == pytest.approx([6.0, 6.0, 3.0, 3.0, 2.0, 2.0][face])


def test_the_triangles_are_the_models_in_metres_with_y_up(box: Mesh) -> None:
    scene = loaded(box)
    (shape,) = scene.geometry.values()
    assert shape.extents == pytest.approx([1.0, 2.0, 3.0])
    assert scene.extents == pytest.approx([1.0, 3.0, 2.0])
    assert shape.volume == pytest.approx(6.0)
    assert len(shape.faces) == 12


def test_an_edge_between_two_faces_stays_sharp(box: Mesh) -> None:
    (shape,) = loaded(box).geometry.values()
    assert np.sort(np.abs(shape.vertex_normals), axis=1) == pytest.approx(np.tile([0.0, 0.0, 1.0], (24, 1)), abs=1e-6)


def test_a_model_without_triangles_cannot_be_shown() -> None:
    empty = Mesh(np.zeros((0, 3)), np.zeros((0, 3), dtype=np.int32), np.zeros(0, dtype=np.int32))
    with pytest.raises(UnreadableFile):
        glb(empty)
    assert picture_of(empty, ViewName.TOP, (64, 64)).getextrema() == ((255, 255),) * 3


@pytest.mark.parametrize(
    ("view", "across", "up"),
    [(ViewName.TOP, 1.0, 2.0), (ViewName.FRONT, 1.0, 3.0), (ViewName.LEFT, 2.0, 3.0), (ViewName.BOTTOM, 1.0, 2.0)],
)
def test_a_side_shows_the_model_in_its_proportions(box: Mesh, view: ViewName, across: float, up: float) -> None:
    shown = np.asarray(picture_of(box, view, (300, 200))).min(axis=2) < 250
    rows, columns = np.flatnonzero(shown.any(axis=1)), np.flatnonzero(shown.any(axis=0))
    width, height = columns[-1] - columns[0] + 1, rows[-1] - rows[0] + 1
    assert width / height == pytest.approx(across / up, abs=0.06)
    assert shown.shape == (200, 300)


def test_the_isometric_view_shows_three_sides(box: Mesh) -> None:
    picture = picture_of(box, ViewName.ISOMETRIC, (300, 200))
    counts = sorted(
        (count for count, color in picture.getcolors(10**6) or [] if color != (255, 255, 255)), reverse=True
    )
    assert len([count for count in counts if count > 1000]) == 3
