"""What a program's result measures, read from the program."""

from __future__ import annotations

import pytest

from querycad_answering.quantities import frame, measures, measures_anything, scalar_type, triple_type
from querycad_answering.typed import same_value, typed_answer
from querycad_contracts import AnswerType, Frame
from querycad_contracts.guest_reference import guest_api

T = AnswerType


@pytest.mark.parametrize(
    ("code", "kind"),
    [
        ("solution = shape.volume", T.VOLUME),
        ("part = find_parts('hole')[0]\nvalue = part.area\nsolution = value", T.AREA),
        ("solution = [p.area for p in find_parts('hole')]", T.AREA),
        ("a = find_parts('a')[0]\nsolution = a.angle_to(a)", T.ANGLE),
        ("solution = max(find_parts('hole'), key=lambda p: p.area).radius", T.LENGTH),
        ("parts = [p for p in find_parts('hole') if p.area > 1]\nsolution = [p.depth for p in parts]", T.LENGTH),
        ("solution = shape.width / shape.height", T.NUMBER),
        ("parts = find_parts('hole')\nsolution = sum(p.radius for p in parts) / len(parts)", T.LENGTH),
        ("solution = shape.width / 2", T.LENGTH),
        ("solution = (", T.LENGTH),
    ],
)
def test_a_number_is_of_the_kind_that_the_program_reads(code: str, kind: AnswerType) -> None:
    assert scalar_type(code) is kind


@pytest.mark.parametrize(
    ("code", "kind"),
    [
        ("solution = shape.extents", T.SIZE),
        ("solution = [p.center for p in find_parts('hole')]", T.POINT),
        ("solution = find_parts('hole')[0].axis", T.DIRECTION),
        ("parts = [p for p in find_parts('hole') if p.center[2] > 0]\nsolution = [p.radius for p in parts]", None),
    ],
)
def test_three_numbers_are_coordinates_where_the_program_reads_some(code: str, kind: AnswerType | None) -> None:
    assert triple_type(code) is kind


def test_three_radii_are_no_point() -> None:
    code = "solution = [p.radius for p in find_parts('hole')]"
    assert typed_answer([0.1, 0.2, 0.3], None, code=code).type is T.LENGTHS
    assert typed_answer([0.1, 0.2, 0.3], None, code="solution = shape.center").type is T.POINT
    assert typed_answer([[0.1, 0.2, 0.3]], None, code="solution = [b.extents for b in shape.bodies]").type is T.SIZES


def test_only_sizes_in_a_parts_own_frame_are_not_along_the_files_axes() -> None:
    own, files = "solution = find_parts('slot')[0].local_size", "solution = shape.extents"
    assert frame(own, T.SIZE) is Frame.PART
    assert frame(files, T.SIZE) is Frame.MODEL
    assert frame(own, T.POINT) is Frame.MODEL
    assert frame(own, T.LENGTH) is None


def test_names_that_lead_in_circles_are_followed_once() -> None:
    assert measures("a = b\nb = a\nsolution = a") == ()


@pytest.mark.parametrize(
    ("one", "other", "are_same"),
    [
        (([0.1, 0.2], T.LENGTHS), ([0.2, 0.1], T.LENGTHS), True),
        ((0.1, T.LENGTH), ([0.1], T.LENGTHS), True),
        ((0.1, T.LENGTH), (0.1, T.ANGLE), False),
        (([0.1, 0.2, 0.3], T.POINT), ([0.3, 0.2, 0.1], T.POINT), False),
        (([0.1, 0.1], T.LENGTHS), ([0.1, 0.2], T.LENGTHS), False),
        ((2, T.COUNT), (2.0, T.NUMBER), True),
        ((True, T.BOOLEAN), (1, T.COUNT), False),
        ((0.1, T.LENGTH), (0.1 + 1e-9, T.LENGTH), True),
    ],
)
def test_two_answers_say_the_same_or_not(
    one: tuple[object, AnswerType], other: tuple[object, AnswerType], are_same: bool
) -> None:
    assert same_value(typed_answer(*one), typed_answer(*other)) is are_same


@pytest.mark.parametrize(
    ("code", "does"),
    [
        ("solution = len(find_parts('hole'))", False),
        ("solution = [p.id for p in find_parts('hole')]", False),
        ("values = []\nfor p in find_parts('hole'):\n    values.append(p.radius)\nsolution = values", True),
        ("solution = shape.extents", True),
        ("solution = (", False),
    ],
)
def test_a_program_that_only_counts_or_names_measures_nothing(code: str, does: bool) -> None:
    assert measures_anything(code) is does


def test_every_number_of_the_guest_api_is_a_measure_or_is_known_to_be_none() -> None:
    numbers = {
        each.name
        for holder in guest_api().classes
        if not holder.is_query
        for each in holder.attributes
        if each.type in ("float", "list[float]", "Vector")
    }
    assert {name for name in numbers if not measures_anything(f"solution = shape.{name}")} == set()
