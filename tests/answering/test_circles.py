"""Circles through the centres of parts that are no pattern, and angles about their middle."""

from __future__ import annotations

import math
from typing import Any

import pytest
from tests.made import hole, part, whole

from querycad_answering.programs.builder import Unwritable
from querycad_answering.programs.circles import on_one_circle
from querycad_answering.programs.writer import write
from querycad_contracts import Measure, Part, PartQuery
from querycad_language.forms import Angle, Get

CIRCLE, HOLES = PartQuery(noun="pitch circle"), PartQuery(noun="hole", plural=True)
SEVEN_OF_EIGHT = [10, 55, 100, 190, 235, 280, 325]
IN_ROW, IN_GRID = [(10 * i, 0) for i in range(4)], [(x, y) for x in (0, 10, 20) for y in (0, 15)]


def at_angles(degrees: list[int], radius: float = 45.0) -> list[tuple[float, float]]:
    """Places on a circle about (70, -30) mm."""
    turns = [math.radians(turn) for turn in degrees]
    return [(70 + radius * math.cos(turn), -30 + radius * math.sin(turn)) for turn in turns]


def holes(places: list[tuple[float, float]]) -> tuple[Part, ...]:
    return tuple(hole(i, *place) for i, place in enumerate(places))


def value(form: Get | Angle, query: PartQuery, parts: tuple[Part, ...]) -> Any:
    values: dict[str, Any] = {"find_parts": lambda _: parts, "different": lambda found, _: sorted(set(found))}
    exec(write(form, {query: (parts, 0)}, whole()).code, values)  # noqa: S102 - our own program
    return values["solution"]


@pytest.mark.parametrize("degrees", [SEVEN_OF_EIGHT, [0, 40, 80, 120], [5, 95, 185, 275], [0, 100, 230], [0, 20, 340]])
def test_a_circle_that_lacks_holes_runs_through_those_that_are_there(degrees: list[int]) -> None:
    parts = holes(at_angles(degrees))
    assert value(Get((Measure.DIAMETER,), CIRCLE), CIRCLE, parts) == pytest.approx(0.09)
    assert value(Get((Measure.RADIUS,), CIRCLE), CIRCLE, parts) == pytest.approx(0.045)


@pytest.mark.parametrize("places", [IN_ROW, IN_GRID, [*at_angles(SEVEN_OF_EIGHT), (70, -30)], IN_ROW[:3]])
def test_what_lies_on_no_one_circle_has_none(places: list[tuple[float, float]]) -> None:
    assert on_one_circle(holes(places)) is None
    with pytest.raises(Unwritable):
        write(Get((Measure.DIAMETER,), CIRCLE), {CIRCLE: (holes(places), 0)}, whole())


def test_one_hole_of_a_circle_on_another_level_is_not_on_it() -> None:
    parts = holes(at_angles(SEVEN_OF_EIGHT))
    x, y, z = parts[3].center
    assert on_one_circle((*parts[:3], parts[3].model_copy(update={"center": (x, y, z + 0.01)}), *parts[4:])) is None


@pytest.mark.parametrize(("degrees", "apart"), [(SEVEN_OF_EIGHT, 45), ([0, 30, 60], 30), ([0, 120, 240], 120)])
def test_holes_of_a_circle_are_spaced_about_its_middle_wherever_one_is_missing(degrees: list[int], apart: int) -> None:
    assert math.degrees(value(Angle(HOLES, None), HOLES, holes(at_angles(degrees)))) == pytest.approx(apart)


def test_curved_slots_run_along_their_pitch_circle() -> None:
    kidney: dict[str, Any] = {"tags": ("curved", "through"), "width": 0.009, "angle": 0.7, "center_length": 0.035}
    slots = tuple(part(f"cutout-{i}", **kidney) for i in range(3))
    assert value(Get((Measure.DIAMETER,), CIRCLE), CIRCLE, slots) == pytest.approx(0.1)
    assert value(Get((Measure.RADIUS,), CIRCLE), CIRCLE, slots) == pytest.approx(0.05)
    assert value(Get((Measure.DIAMETER,), HOLES), HOLES, slots) != pytest.approx(0.1)
    straight = tuple(part(f"cutout-{i}", tags=("through",), width=0.009, center_length=0.035) for i in range(3))
    assert value(Get((Measure.DIAMETER,), CIRCLE), CIRCLE, straight) != pytest.approx(0.1)
