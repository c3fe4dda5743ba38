"""A description of a model: its size, likely unit, features, and questions that have a sure and true answer."""

from __future__ import annotations

from collections.abc import Sequence

import pytest
from tests.made import body, hole, part, whole

from querycad_answering.drawing.describing import describe, is_bare_surface
from querycad_contracts import Answer, AnswerType, Description, LengthUnit, ModelSummary, Part, Shape, Unit


def described(parts: Sequence[Part], unit: LengthUnit = LengthUnit.MM, bodies: int = 1) -> Description:
    shape = Shape(
        name="plate", center=(0, 0, 0), extents=(0.1, 0.06, 0.01), volume=6e-5, area=1.5e-2, bodies=(), face_count=9
    )
    summary = ModelSummary(
        shape=shape, body_count=bodies, part_counts={}, units=("millimetre",), warnings=("sewn",), timings_ms={}
    )
    return describe(summary, parts, unit, answers)


def answers(question: str) -> Answer | None:
    """Knows the number of holes, errs about the counterbores, and of the rest nothing."""
    told = {"How many holes are there?": 2, "How deep is the counterbore?": 0.5}
    value = told.get(question)
    return None if value is None else Answer(value=value, type=AnswerType.COUNT, unit=Unit.NONE, text=str(value))


BORE = part("counterbore-h1.1", kind="counterbore", diameter=0.01, radii=(0.005,), depth=0.008)
PARTS = [
    whole(),
    body(1, "plate"),
    hole(1, diameter=0.005, children=(BORE.id,)),
    BORE,
    hole(2, diameter=0.005),
    part("face-1", normal=(0.0, 0.0, 1.0), local_size=(0.1, 0.06, 0.0), area=6e-3),
    part("face-2", normal=(1.0, 0.0, 0.0), local_size=(0.06, 0.01, 0.0), area=6e-4),
    part("wall-1", thickness=0.01),
]


def test_it_says_size_unit_standing_axis_features_and_warnings() -> None:
    found = described(PARTS)
    lines = found.text.splitlines()
    assert lines[0] == "plate: one body, 9 faces, 100 x 60 x 10 mm (x, y, z)"
    assert lines[1] == "volume 60000 mm³, surface 15000 mm²"
    assert (found.stands_along, found.drawn_in) == ("z", "mm")
    assert [one.text for one in found.features] == ["Ø5 THRU, counterbore Ø10 depth 8", "Ø5 THRU"]
    assert "  sewn" in lines


def test_suggested_is_only_what_is_answered_with_the_true_value() -> None:
    assert described(PARTS).questions == ("How many holes are there?",)


def test_without_anyone_to_ask_nothing_is_suggested() -> None:
    found = described(PARTS)
    summary = ModelSummary(
        shape=Shape(name="a", center=(0, 0, 0), extents=found.size, volume=1e-6, area=1e-4, bodies=(), face_count=6),
        body_count=1,
        part_counts={},
        warnings=(),
        timings_ms={},
    )
    assert describe(summary, PARTS).questions == ()


@pytest.mark.parametrize(
    ("grid", "unit"), [(0.0254 / 8, "in"), (0.001, "mm"), (0.00037719, "")], ids=["eighths", "millimetres", "neither"]
)
def test_the_likely_unit_is_the_one_with_round_numbers(grid: float, unit: str) -> None:
    sizes = [(n + 2) * grid for n in range(1, 6)]
    holes = [hole(n, diameter=size, extents=(size, size, size), depth=size) for n, size in enumerate(sizes, 1)]
    assert described(holes).drawn_in == unit


def test_bodies_are_listed_with_their_number_and_standard_parts_by_name() -> None:
    size = (0.0085, 0.0085, 0.021)
    screws = [body(n, "ISO 4762 M5x16", extents=size, volume=1e-6) for n in range(2, 6)]
    found = described([*PARTS, *screws], bodies=5)
    assert found.standard_parts == ("4x ISO 4762 M5x16",)
    assert any(line.startswith("  4x ISO 4762 M5x16 (8.5 x 8.5 x 21)") for line in found.text.splitlines())


def test_lengths_in_text_are_in_the_unit_asked_for() -> None:
    assert "3.937 x 2.3622 x 0.3937 in" in described(PARTS, LengthUnit.IN).text


def test_a_model_without_a_name_is_said_to_have_none() -> None:
    shape = Shape(name="", center=(0, 0, 0), extents=(0.1, 0.06, 0.01), volume=6e-5, area=1e-2, bodies=(), face_count=9)
    summary = ModelSummary(shape=shape, body_count=1, part_counts={}, units=(), warnings=(), timings_ms={})
    assert describe(summary, (), LengthUnit.MM, answers).text.startswith("a model without a name: one body, 9 faces")


def test_a_ball_is_a_feature_and_a_spherical_hollow_is_a_bare_surface() -> None:
    ball = part("sphere-1", label="outer sphere, x", tags=("outer", "spherical"), diameter=0.03)
    hollow = part("sphere-2", label="inner sphere, x", tags=("inner", "spherical"), diameter=0.02)
    assert [one.text for one in described([*PARTS, ball, hollow]).features][-1] == "outer sphere Ø30"
    assert [is_bare_surface(one) for one in (ball, hollow)] == [False, True]
