"""What is said beside a value: overall lengths, ways in, and heights of what stands on another axis than the file's."""

from __future__ import annotations

from collections.abc import Iterator
from pathlib import Path

import pytest
from OCP.TopoDS import TopoDS_Shape
from tests.segworker.shapes import box, compound, cut, cylinder, fuse, plate, turned, write_step

from querycad.runtime import EmbeddedRuntime
from querycad_contracts import AnswerRecord

MM = 1e-3
DISC = fuse(cylinder(40, 12), cylinder(15, 20))
"""A hub on a disc, which stands on its flat face."""


@pytest.fixture(scope="module")
def runtime(tmp_path_factory: pytest.TempPathFactory) -> Iterator[EmbeddedRuntime]:
    with EmbeddedRuntime(tmp_path_factory.mktemp("models")) as runtime:
        yield runtime


def asked(runtime: EmbeddedRuntime, folder: Path, shape: TopoDS_Shape, question: str) -> AnswerRecord:
    return runtime.ask(write_step(folder / "asked.step", shape), question)


def profile() -> TopoDS_Shape:
    """An I of 60 x 80 that is 400 mm long, along z."""
    return fuse(box((60, 8, 400)), box((60, 8, 400), (0, 72, 0)), box((6, 72, 400), (27, 4, 0)))


@pytest.mark.parametrize(
    ("shape", "question", "height", "other"),
    [
        (turned(DISC, (1, 0, 0), 90), "How high is the part?", 80, (20, "stands along y")),
        (turned(DISC, (0, 1, 0), 90), "What is the height of the part?", 80, (20, "stands along x")),
        (DISC, "How high is the part?", 20, None),
        (plate(60, 40, 20), "How wide is the part along x?", 60, None),
        (profile(), "How high is the profile?", 400, (80, "profile lies along z")),
        (profile(), "How high is the part?", 400, None),
        (plate(60, 40, 20), "How high is the profile?", 20, None),
    ],
    ids=["along y", "along x", "on its face", "width", "profile", "no profile said", "no profile"],
)
def test_a_height_along_another_axis_is_given_too(
    runtime: EmbeddedRuntime,
    tmp_path: Path,
    shape: TopoDS_Shape,
    question: str,
    height: float,
    other: tuple[float, str] | None,
) -> None:
    record = asked(runtime, tmp_path, shape, question)
    assert record.answer is not None
    assert record.answer.value == pytest.approx(height * MM)
    notes = [note for note in record.warnings if "file's axis" in note]
    if other is None:
        assert notes == []
    else:
        value, why = other
        assert why in notes[0]
        assert f"{value} mm" in notes[0]
        assert record.alternatives[0].answer.value == pytest.approx(value * MM)


def test_what_a_pin_s_hole_is_reached_from_is_said_and_that_a_through_hole_has_two_ways(
    runtime: EmbeddedRuntime, tmp_path: Path
) -> None:
    block = cut(box((60, 40, 30)), cylinder(4, 20, (20, 20, 10)), cylinder(6, 40, (45, 20, -5)))
    shape = compound(block, cylinder(4, 40, (20, 20, 10)))
    blind = asked(runtime, tmp_path, shape, "From which direction is the blind hole drilled?")
    assert blind.answer is not None
    assert blind.answer.value == pytest.approx([0, 0, -1])
    assert "that is from the top" in blind.warnings
    through = asked(runtime, tmp_path, shape, "What is the approach direction of the through hole?")
    assert "what goes through has a second way in, from the other side" in through.warnings
    pin = asked(runtime, tmp_path, shape, "From which direction is the pin pushed in?")
    assert pin.answer is not None
    assert pin.answer.value == pytest.approx([0, 0, -1])


@pytest.mark.parametrize(
    ("question", "value", "note"),
    [
        ("How long are the screws?", 16, "overall 21 mm"),
        ("How long is the M5x16 screw?", 16, "overall 21 mm"),
        ("What is the overall length of the screws?", 21, ""),
        ("How long are the screws, head included?", 21, ""),
    ],
)
def test_a_screw_is_as_long_as_it_is_called(runtime: EmbeddedRuntime, question: str, value: float, note: str) -> None:
    example = Path(__file__).parents[2] / "examples/bearing_assembly.step"
    record = runtime.ask(example, question)
    assert record.answer is not None
    values = record.answer.value if isinstance(record.answer.value, list) else [record.answer.value]
    assert values == [pytest.approx(value * MM)] * len(values)
    assert any(note in said for said in record.warnings) if note else not any("overall" in w for w in record.warnings)


@pytest.mark.parametrize(
    ("question", "answer", "why"),
    [
        ("Is hole 1 deeper than 15 mm?", "yes", ["depth of hole-1: 20 mm"]),
        ("Are all holes wider than 9 mm?", "no", ["width of the holes: 8 mm, 12 mm"]),
        ("Is hole 1 wider than hole 2?", "no", ["width of hole-1: 8 mm", "width of hole-2: 12 mm"]),
        (
            "Is the distance between hole 1 and hole 2 more than 10 mm?",
            "yes",
            ["distance from hole-1 to hole-2: 40 mm"],
        ),
        ("Do all the holes have the same diameter?", "no", ["diameter of the holes: 8 mm, 12 mm"]),
        ("Are there any slots?", "no", []),
    ],
)
def test_yes_or_no_says_what_was_compared(
    question: str, answer: str, why: list[str], runtime: EmbeddedRuntime, tmp_path: Path
) -> None:
    shape = cut(plate(60, 40, 20), cylinder(4, 30, (-20, 0, -25)), cylinder(6, 30, (20, 0, -25)))
    record = asked(runtime, tmp_path, shape, question)
    assert record.answer is not None
    assert record.answer.text.removeprefix("perhaps ").startswith(answer)
    assert [note for note in record.warnings if ": " in note and not note.startswith("not ")] == why
