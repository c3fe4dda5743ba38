"""What is passed over, or not checked, makes an answer unsure; what is counted is what the noun itself means."""

from __future__ import annotations

from collections.abc import Iterator
from pathlib import Path

import pytest
from tests.segworker.shapes import box, cone, cut, cylinder, write_step

from querycad.model import Model
from querycad.runtime import EmbeddedRuntime

EXAMPLES = Path(__file__).parents[2] / "examples"
SURE = 0.8


@pytest.fixture(scope="module")
def runtime() -> Iterator[EmbeddedRuntime]:
    with EmbeddedRuntime() as runtime:
        yield runtime


@pytest.fixture(scope="module")
def flange(runtime: EmbeddedRuntime) -> Model:
    return runtime.open(EXAMPLES / "flange.step")


@pytest.mark.parametrize(
    "question",
    [
        "What is half the diameter of the bore?",
        "What is twice the diameter of the bore?",
        "How many 16 mm and 8.5 mm holes are there in total?",
    ],
)
def test_what_is_passed_over_is_told_and_never_sure(flange: Model, question: str) -> None:
    reply = flange.ask(question)
    assert reply.confidence is not None
    assert reply.confidence < SURE
    assert reply.ignored


@pytest.mark.parametrize(
    ("question", "value"),
    [
        ("How many holes that are not 16 mm?", 3),
        ("How many holes of 16 mm are there?", 8),
        ("How many 10 mm holes are there?", 0),
    ],
)
def test_sizes_of_what_is_counted_hold(flange: Model, question: str, value: int) -> None:
    reply = flange.ask(question)
    assert reply.answer is not None
    assert reply.answer.value == value


def test_where_there_are_holes_sockets_are_none(runtime: EmbeddedRuntime) -> None:
    model = runtime.open(EXAMPLES / "bearing_assembly.step")
    reply = model.ask("How many holes are there?")
    assert reply.answer is not None
    assert reply.answer.value == sum(part.kind == "hole" for part in model.parts)


@pytest.fixture(scope="module")
def plate(runtime: EmbeddedRuntime, tmp_path_factory: pytest.TempPathFactory) -> Model:
    """80 x 60 x 8 with four holes in the corners of 60 x 40, one in the middle of these, one 15 beside it."""
    holes = [cylinder(2.5, 8, (x, y, 0)) for x in (10, 70) for y in (10, 50)]
    body = cut(box((80, 60, 8)), *holes, cylinder(6, 8, (40, 30, 0)), cylinder(4, 8, (55, 30, 0)))
    return runtime.open(write_step(tmp_path_factory.mktemp("plate") / "plate.step", body))


@pytest.mark.parametrize(
    ("question", "value"),
    [
        ("Is the 12 mm hole in the middle of the four 5 mm holes?", True),
        ("Is the 8 mm hole in the middle of the four 5 mm holes?", False),
        ("Are the holes bosses?", False),
    ],
)
def test_the_middle_of_several_is_that_of_all(plate: Model, question: str, value: bool) -> None:
    reply = plate.ask(question)
    assert reply.answer is not None
    assert reply.answer.value is value


def test_corners_of_a_rectangle_lie_on_the_circle_through_them(plate: Model) -> None:
    reply = plate.ask("What is the diameter of the bolt circle of the 5 mm holes?")
    assert reply.answer is not None
    assert reply.answer.value == pytest.approx((0.06**2 + 0.04**2) ** 0.5)


@pytest.mark.parametrize(("top", "sure"), [(19.0, True), (10.0, False)])
def test_the_slope_of_a_countersink_is_no_draft(
    runtime: EmbeddedRuntime, tmp_path: Path, top: float, sure: bool
) -> None:
    """A frustum, 20 high on a radius of 20: 3 degrees are a draft, 27 are none."""
    model = runtime.open(write_step(tmp_path / "model.step", cone(20, top, 20)))
    reply = model.ask("What is the draft angle?")
    assert reply.confidence is not None
    assert (reply.confidence >= SURE) is sure
