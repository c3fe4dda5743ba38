"""Which bodies are closed and point outwards, on boxes and on what the kernel tessellates."""

from __future__ import annotations

from dataclasses import replace

import numpy as np
import pytest
from tests.segworker.meshes import box, empty, joined, scaled
from tests.segworker.shapes import cut, cylinder, find, plate

from querycad_segworker.mesh import Mesh
from querycad_segworker.orientation import outward


def volume(mesh: Mesh) -> float:
    corners = mesh.vertices_m[mesh.triangles]
    return float(np.einsum("ij,ij->", corners[:, 0], np.cross(corners[:, 1], corners[:, 2])) / 6)


def inside_out(mesh: Mesh) -> Mesh:
    return replace(mesh, triangles=np.ascontiguousarray(mesh.triangles[:, ::-1]))


def faces_of(mesh: Mesh) -> list[int]:
    return sorted(set(mesh.triangle_face.tolist()))


@pytest.mark.parametrize("make", [box, lambda: scaled(box(), 1e-3, (0.1, 0.2, -0.7))])
def test_a_closed_body_is_closed_whichever_way_it_came(make: object) -> None:
    assert callable(make)
    mesh = make()
    for one in (mesh, inside_out(mesh)):
        found = outward(one, [faces_of(mesh)])
        assert found.closed
        assert volume(found) > 0


def test_a_body_with_a_face_missing_is_not_closed() -> None:
    mesh = box()
    for face in faces_of(mesh):
        assert not outward(mesh.of_faces(np.setdiff1d(mesh.triangle_face, face)), [faces_of(mesh)]).closed


def test_a_face_that_is_turned_leaves_a_border() -> None:
    mesh = box()
    turned = mesh.triangles.copy()
    turned[:2] = turned[:2, ::-1]
    assert not outward(replace(mesh, triangles=turned), [faces_of(mesh)]).closed


def test_each_body_is_turned_by_itself_and_one_open_body_leaves_the_model_open() -> None:
    mesh = joined(box(), inside_out(scaled(box(), 0.5, (3, 0, 0))))
    faces = faces_of(mesh)
    bodies = [faces[: len(faces) // 2], faces[len(faces) // 2 :]]
    found = outward(mesh, bodies)
    assert found.closed
    assert volume(found) == pytest.approx(volume(outward(box(), [faces_of(box())])) * 1.125)
    assert not outward(mesh.of_faces(np.array(faces[1:])), bodies).closed


def test_surfaces_of_no_body_are_open() -> None:
    mesh = box()
    half = faces_of(mesh)[:3]
    assert not outward(mesh.of_faces(np.array(half)), []).closed
    assert not outward(empty(), []).closed


def test_what_the_kernel_tessellates_is_closed() -> None:
    found = find(cut(plate(), cylinder(6, 30, (-18, 0, -25)), cylinder(5, 3, (18, 0, -20))))
    assert found.mesh.closed
    assert volume(found.mesh) == pytest.approx(found.brep.bodies[0].volume, rel=0.02)
