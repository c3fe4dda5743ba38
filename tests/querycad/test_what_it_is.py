"""'Is this a washer?' asks what the model is: yes where it is called or shaped so, else that nothing says it."""

from __future__ import annotations

from collections.abc import Iterator

import pytest
from tests.segworker.shapes import box, compound, cut, cylinder, write_step

from querycad.model import Model
from querycad.runtime import EmbeddedRuntime
from querycad_contracts import Status


@pytest.fixture(scope="module")
def runtime() -> Iterator[EmbeddedRuntime]:
    with EmbeddedRuntime() as runtime:
        yield runtime


@pytest.fixture(scope="module")
def tube(runtime: EmbeddedRuntime, tmp_path_factory: pytest.TempPathFactory) -> Model:
    """A tube of 30 x 20, 60 long, in a file that is not called so."""
    body = cut(cylinder(15, 60), cylinder(10, 60))
    return runtime.open(write_step(tmp_path_factory.mktemp("tube") / "model.step", body))


@pytest.fixture(scope="module")
def blocks(runtime: EmbeddedRuntime, tmp_path_factory: pytest.TempPathFactory) -> Model:
    """Two blocks of 20 x 20 x 10, 5 apart."""
    body = compound(box((20, 20, 10)), box((20, 20, 10), (25, 0, 0)))
    return runtime.open(write_step(tmp_path_factory.mktemp("blocks") / "model.step", body))


@pytest.mark.parametrize(
    ("question", "value"),
    [
        ("Is this a tube?", True),
        ("Is the part a tube?", True),
        ("Is it an assembly?", False),
        ("Is it a single body?", True),
        ("Is this hollow?", True),
        ("Is it solid?", False),
    ],
)
def test_what_a_model_is_is_yes_or_no(tube: Model, question: str, value: bool) -> None:
    reply = tube.ask(question)
    assert reply.answer is not None
    assert reply.answer.value is value


@pytest.mark.parametrize("question", ["Is this a gear?", "Is it a bolt?", "Is the model a flange?"])
def test_what_nothing_says_is_no_no(tube: Model, question: str) -> None:
    reply = tube.ask(question)
    assert reply.status is not Status.ANSWERED
    assert reply.answer is None


@pytest.mark.parametrize(
    ("question", "value"), [("Is this an assembly?", True), ("Is it one body?", False), ("Is it hollow?", False)]
)
def test_of_several_bodies_each_counts(blocks: Model, question: str, value: bool) -> None:
    reply = blocks.ask(question)
    assert reply.answer is not None
    assert reply.answer.value is value


def test_the_least_of_several_spacings_is_told_as_such_and_is_not_sure(
    runtime: EmbeddedRuntime, tmp_path_factory: pytest.TempPathFactory
) -> None:
    """Three holes in a row, 20 and 35 apart; and three that are 20 apart."""
    folder = tmp_path_factory.mktemp("rows")

    def spaced(name: str, third: float) -> tuple[float | None, str]:
        holes = [cylinder(3, 10, (x, 10, 0)) for x in (10, 30, third)]
        model = runtime.open(write_step(folder / f"{name}.step", cut(box((80, 20, 10)), *holes)))
        reply = model.ask("What is the spacing of the holes?")
        assert reply.answer is not None
        assert "equally far" not in " ".join(model.ask("What is the spacing of the holes along x?").warnings)
        assert reply.answer.value == pytest.approx(0.02)
        return reply.confidence, " ".join(reply.warnings)

    (even, no_note), (uneven, note) = spaced("even", 50), spaced("uneven", 65)
    assert even is not None
    assert uneven is not None
    assert uneven < 0.8
    assert even > uneven
    assert "20, 35 mm" in note
    assert "equally far" not in no_note
