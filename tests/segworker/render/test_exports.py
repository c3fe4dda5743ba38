"""What other programs are given of a model: triangles with face ids, and plain views."""

from __future__ import annotations

import io
import json
from pathlib import Path
from typing import Any

import numpy as np
import pytest
import trimesh

from querycad_contracts import Body, ViewName
from querycad_segworker.errors import UnreadableFile
from querycad_segworker.ingest import ingest
from querycad_segworker.mesh import Mesh
from querycad_segworker.model import ModelStore
from querycad_segworker.render.glb import edge_lines, glb, write_glb
from querycad_segworker.render.plain import picture_of


@pytest.fixture
def box() -> Mesh:
    """1 x 2 x 3 m, a face for each side, in the order of their axes."""
    solid = trimesh.creation.box((1.0, 2.0, 3.0))
    axes = np.abs(solid.face_normals).argmax(axis=1) * 2 + (solid.face_normals.sum(axis=1) > 0)
    return Mesh(solid.vertices.astype(np.float64), solid.faces.astype(np.int32), axes.astype(np.int32))


def loaded(data: bytes) -> trimesh.Scene:
    return trimesh.load(io.BytesIO(data), file_type="glb")


def surfaces(data: bytes) -> list[trimesh.Trimesh]:
    return [shape for shape in loaded(data).geometry.values() if isinstance(shape, trimesh.Trimesh)]


def tree(data: bytes) -> dict[str, Any]:
    """The JSON chunk of a GLB file."""
    length = int.from_bytes(data[12:16], "little")
    return dict(json.loads(data[20 : 20 + length]))


def body(number: int, name: str, color: str | None) -> Body:
    return Body(
        id=number,
        name=name,
        color=color,
        is_solid=True,
        center=(0, 0, 0),
        extents=(1, 1, 1),
        volume=1,
        area=1,
        face_count=3,
    )


def test_every_triangle_knows_its_face(box: Mesh) -> None:
    (shape,) = surfaces(glb(box))
    ids = np.asarray(shape.vertex_attributes["_FACE_ID"]).reshape(-1)
    assert ids.dtype == np.float32
    of_triangles = ids[shape.faces]
    assert (of_triangles == of_triangles[:, :1]).all()
    assert sorted(set(of_triangles[:, 0].astype(int))) == list(range(6))
    for face in range(6):
        area = shape.area_faces[of_triangles[:, 0] == face].sum()
        assert area == pytest.approx([6.0, 6.0, 3.0, 3.0, 2.0, 2.0][face])


def test_the_triangles_are_the_models_in_metres_with_y_up(box: Mesh) -> None:
    scene = loaded(glb(box))
    (shape,) = surfaces(glb(box))
    assert shape.extents == pytest.approx([1.0, 2.0, 3.0])
    assert scene.extents == pytest.approx([1.0, 3.0, 2.0])
    assert shape.volume == pytest.approx(6.0)
    assert len(shape.faces) == 12


def test_an_edge_between_two_faces_stays_sharp(box: Mesh) -> None:
    (shape,) = surfaces(glb(box))
    assert np.sort(np.abs(shape.vertex_normals), axis=1) == pytest.approx(np.tile([0.0, 0.0, 1.0], (24, 1)), abs=1e-6)


def test_lines_run_where_faces_meet_and_nowhere_else(box: Mesh) -> None:
    corners = box.vertices_m.astype(np.float32)
    lines = edge_lines(corners, box.triangles, box.triangle_face)
    assert len(lines) == 12  # of a box, its diagonals left out
    lengths = np.linalg.norm(corners[lines[:, 0]] - corners[lines[:, 1]], axis=1)
    assert sorted(lengths) == pytest.approx([1.0] * 4 + [2.0] * 4 + [3.0] * 4)
    one_face = np.zeros(len(box.triangles), dtype=np.int32)
    assert len(edge_lines(corners, box.triangles, one_face)) == 0


def test_each_body_is_a_node_with_its_name_colour_and_own_faces(box: Mesh) -> None:
    bodies = (body(0, "Lid", "#ff0000"), body(1, "", None))
    data = glb(box, bodies, np.array([0, 0, 0, 1, 1, 1], dtype=np.int32))
    whole = tree(data)
    top, *nodes = whole["nodes"]
    assert top["children"] == [1, 2]
    assert [node["name"] for node in nodes] == ["Lid", "body-2"]
    assert [node["extras"]["body"] for node in nodes] == [0, 1]
    colors = [material["pbrMetallicRoughness"]["baseColorFactor"] for material in whole["materials"]]
    assert colors[0] == [1.0, 0.0, 0.0, 1.0]
    assert 0.6 < colors[1][0] < 0.8  # linear, of a light grey
    found = [set(np.asarray(shape.vertex_attributes["_FACE_ID"]).reshape(-1).astype(int)) for shape in surfaces(data)]
    assert found == [{0, 1, 2}, {3, 4, 5}]
    assert sum(len(shape.faces) for shape in surfaces(data)) == 12


def test_a_file_is_written_with_every_face(flange: Path, tmp_path: Path) -> None:
    artefacts = ingest(flange, ModelStore(tmp_path / "store"))
    write_glb(artefacts, tmp_path / "bodies.glb")
    data = (tmp_path / "bodies.glb").read_bytes()
    (shape,) = surfaces(data)
    ids = np.asarray(shape.vertex_attributes["_FACE_ID"]).reshape(-1)
    assert set(ids.astype(int)) == set(range(artefacts.load_model().shape.face_count))


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
