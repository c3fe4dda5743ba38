"""Frames, ends, grasps, mates and wordings, each for itself, on parts made by hand."""

from __future__ import annotations

import math
import random
from typing import Any

import pytest
from pydantic import TypeAdapter, ValidationError
from tests.made import UP, body, hole, part

from querycad_answering.parameters.ends import ends_of
from querycad_answering.parameters.frames import MODEL, Rigid
from querycad_answering.parameters.grasping import Flat, grasps
from querycad_answering.parameters.mating import fits, loosest
from querycad_answering.parameters.wording import question_of
from querycad_contracts import ParameterRequest, ParametersRequest, ReferenceFrame, Side, Vector
from querycad_contracts.parameters import Matrix
from querycad_contracts.vectors import add, cross, dot, scale, unit

DOWN = (0.0, 0.0, -1.0)
FRAME: TypeAdapter[Any] = TypeAdapter(ReferenceFrame)


def turned_by(quaternion: tuple[float, ...], v: Vector) -> Vector:
    """A vector turned by a unit quaternion x, y, z, w: v + 2 w (q x v) + 2 q x (q x v)."""
    x, y, z, w = quaternion
    once = cross((x, y, z), v)
    return add(add(v, scale(once, 2 * w)), scale(cross((x, y, z), once), 2))


@pytest.mark.parametrize("seed", range(20))
def test_a_pose_s_quaternion_and_matrix_are_one_rotation(seed: int) -> None:
    chance = random.Random(seed)
    a, b = (unit((chance.gauss(0, 1), chance.gauss(0, 1), chance.gauss(0, 1))) for _ in range(2))
    frame = Rigid.along((1.0, 2.0, 3.0), a, b)
    pose = frame.pose(1e-3)
    assert math.isclose(math.hypot(*pose.quaternion), 1.0, abs_tol=1e-8)
    for axis, column in (((1.0, 0.0, 0.0), 0), ((0.0, 1.0, 0.0), 1), (UP, 2)):
        assert turned_by(pose.quaternion, axis) == pytest.approx([row[column] for row in pose.matrix[:3]], abs=1e-7)
    assert [row[3] for row in pose.matrix] == [1000.0, 2000.0, 3000.0, 1.0]
    assert dot(frame.z, a) == pytest.approx(1.0)
    assert frame.seen(frame).pose(1.0) == MODEL.pose(1.0)


@pytest.mark.parametrize("z", [UP, DOWN, (1.0, 0.0, 0.0), (-1.0, 0.0, 0.0), (0.0, -1.0, 0.0)])
def test_half_turns_have_quaternions_too(z: Vector) -> None:
    pose = Rigid.along((0.0, 0.0, 0.0), z).pose(1.0)
    assert turned_by(pose.quaternion, UP) == pytest.approx(z, abs=1e-8)


def test_a_given_frame_must_be_rigid() -> None:
    good = [[0, -1, 0, 5], [1, 0, 0, 0], [0, 0, 1, 0], [0, 0, 0, 1]]
    FRAME.validate_python({"of": "given", "matrix": good})
    mirrored = [[0, 1, 0, 5], *good[1:]]
    scaled = [[0, -2, 0, 5], *good[1:]]
    shifted = [*good[:3], [0, 0, 1, 1]]
    for bad in (mirrored, scaled, shifted):
        with pytest.raises(ValidationError, match="rotation"):
            FRAME.validate_python({"of": "given", "matrix": bad})
    for mixed in ({"of": "model", "part": "hole-1"}, {"of": "part"}, {"of": "given"}):
        with pytest.raises(ValidationError, match=r"part|matrix"):
            FRAME.validate_python(mixed)


def test_two_parameters_of_one_name_are_refused() -> None:
    one = {"name": "a", "type": "count"}
    with pytest.raises(ValidationError, match="same name"):
        ParametersRequest.model_validate({"parameters": [one, one]})


def test_a_through_hole_has_two_ends_that_a_counterbore_or_a_side_tells_apart() -> None:
    plain = ends_of(hole(1), None, None)
    assert [(end.point[2], end.outward) for end in plain.ends] == [(0.005, UP), (-0.005, DOWN)]
    assert not plain.told_apart
    assert ends_of(hole(1, tags=("through", "counterbored")), None, None).told_apart
    below = ends_of(hole(1), Side.BOTTOM, None)
    assert (below.told_apart, below.ends[0].outward) == (True, DOWN)
    assert ends_of(hole(1), None, (0.0, 0.0, -0.005)).ends[0].outward == DOWN
    assert ends_of(hole(1), Side.LEFT, None).ends == ()


def test_a_block_is_come_at_from_a_side_and_from_nowhere_else() -> None:
    block = part("body-1", (0.0, 0.0, 0.01), extents=(0.1, 0.2, 0.02))
    assert ends_of(block, None, None).ends == ()
    (end,) = ends_of(block, Side.TOP, None).ends
    assert end.point == pytest.approx((0.0, 0.0, 0.02))


def flat(number: int, center: Vector, normal: Vector, length: float = 0.02, width: float = 0.01) -> Flat:
    return Flat(number, center, normal, length * width, length, width, (0.0, 1.0, 0.0))


LEFT, RIGHT = (-1.0, 0.0, 0.0), (1.0, 0.0, 0.0)


def test_a_gripper_holds_faces_that_face_away_from_each_other() -> None:
    sides = [flat(1, (-0.015, 0, 0), LEFT), flat(2, (0.015, 0.005, 0), RIGHT), flat(3, (0, 0, 0.005), UP)]
    (grasp,) = grasps(sides, MODEL, 1e-3, None)
    assert (grasp.distance, grasp.faces, grasp.area) == (30.0, (1, 2), 150.0)
    assert grasp.center == pytest.approx((0.0, 2.5, 0.0))
    assert (grasp.closing, grasp.along) == (RIGHT, (0.0, 1.0, 0.0))
    assert grasps(sides, MODEL, 1e-3, 0.029) == []
    assert len(grasps(sides, MODEL, 1e-3, 0.03)) == 1


@pytest.mark.parametrize(
    "other",
    [
        flat(2, (-0.03, 0, 0), RIGHT),  # they face each other, as the walls of a slot
        flat(2, (0.015, 0.019, 0), RIGHT),  # they hardly overlap
        flat(2, (0.015, 0, 0), unit((1.0, 0.1, 0.0))),  # it is tilted
    ],
)
def test_other_faces_are_no_grasp(other: Flat) -> None:
    assert grasps([flat(1, (-0.015, 0, 0), LEFT), other], MODEL, 1e-3, None) == []


def shaft(number: int, diameter: float, x: float = 0.0, face: int = 100) -> Any:
    ends = ((x, 0.0, 0.02), (x, 0.0, -0.02))
    more = {"diameter": diameter, "axis": UP, "tips": ends, "faces": (face + number,), "height": 0.04}
    return body(number, f"pin {number}", (x, 0.0, 0.0), **more)


def plate_with(*holes: Any) -> list[Any]:
    return [*holes, body(1, "plate", faces=tuple(face for each in holes for face in each.faces))]


def test_a_shaft_goes_into_the_hole_that_fits_and_into_no_other() -> None:
    holes = [hole(1, diameter=0.0201), hole(2, x=50, diameter=0.019), hole(3, x=90, diameter=0.022)]
    (fit,) = fits(plate_with(*holes), [shaft(2, 0.02)])
    mate = fit.told(1e-3, (None, "b" * 64))
    assert (mate.hole, mate.shaft, mate.hole_model, mate.shaft_model) == ("hole-1", "body-2", None, "b" * 64)
    assert (mate.clearance, mate.hole_diameter, mate.depth, mate.assembled) == (0.1, 20.1, 10.0, False)


def test_what_is_assembled_is_no_other_shaft_s() -> None:
    parts = [*plate_with(hole(1, diameter=0.02), hole(2, x=50, diameter=0.02)), shaft(2, 0.02)]
    (fit,) = fits(parts)
    assert (fit.hole.id, fit.assembled) == ("hole-1", True)
    apart = [*plate_with(hole(1, x=30, diameter=0.02), hole(2, x=50, diameter=0.02)), shaft(2, 0.02)]
    assert [(one.hole.id, one.assembled) for one in fits(apart)] == [("hole-1", False), ("hole-2", False)]


def test_the_loosest_fit_is_that_of_the_standard() -> None:
    """ISO 286-2: H11 is +130 µm at 20 mm and +220 µm at 100 mm, c11 -110 to -240 µm and -180 to -400 µm.

    The standard's tables round, and take the geometric mean of a range of diameters; so it is met to a fifth.
    """
    assert loosest(0.02) == pytest.approx(370e-6, rel=0.2)
    assert loosest(0.1) == pytest.approx(620e-6, rel=0.2)


@pytest.mark.parametrize(
    ("asked", "wanted"),
    [
        ({"name": "hole_count", "type": "count"}, "How many hole are there?"),
        ({"name": "numberOfTeeth", "type": "count", "description": "number of teeth"}, "How many teeth are there?"),
        ({"name": "bore_diameter", "type": "length"}, "What is the bore diameter?"),
        (
            {"name": "d1", "type": "length", "description": "the diameter of the bore."},
            "What is the diameter of the bore?",
        ),
        ({"name": "x", "type": "length", "description": "How long is it?"}, "How long is it?"),
        ({"name": "shaft_pose", "type": "pose"}, "Where is the shaft?"),
        ({"name": "p", "type": "approach", "question": "the bore"}, "Where is the bore?"),
        ({"name": "p", "type": "pose", "question": "What is the center?"}, "What is the center?"),
        ({"name": "has_keyway", "type": "boolean"}, "Is there a keyway?"),
    ],
)
def test_a_parameter_asks_by_its_question_or_by_what_it_is_called(asked: Any, wanted: str) -> None:
    assert question_of(ParameterRequest.model_validate(asked)) == wanted


def test_a_given_frame_s_translation_is_in_the_unit() -> None:
    matrix: Matrix = ((1, 0, 0, 10), (0, 1, 0, 0), (0, 0, 1, 0), (0, 0, 0, 1))
    assert Rigid.of_matrix(matrix, 1e-3).point((0.01, 0.0, 0.0)) == pytest.approx((0, 0, 0))
    assert Rigid.of_matrix(matrix, 0.0254).point((0.254, 0.0, 0.0)) == pytest.approx((0, 0, 0))
