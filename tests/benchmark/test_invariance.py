"""Each change keeps what a part is, and only what may stay is compared."""

from __future__ import annotations

from pathlib import Path

import pytest
from benchmark.invariance import CHANGES, SCALE, comparable, read
from benchmark.understanding.data import Question
from build123d import Solid, export_step
from tests.segworker.shapes import cut, cylinder, find, plate

DRILLED = cut(plate(), cylinder(6, 40, (5, 0, -30)))


def asked(question: str, kind: str = "length") -> Question:
    return Question("own:plate", Path("plate.step"), "own", question, 0.012, kind)


@pytest.mark.parametrize("change", CHANGES)
def test_the_part_stays_what_it_is_through_a_file(change: str, tmp_path: Path) -> None:
    file = tmp_path / "changed.step"
    export_step(CHANGES[change](Solid(DRILLED)), file)
    solid = read(file)
    assert solid is not None
    (hole,) = find(solid.wrapped).of("hole")
    assert hole.diameter == pytest.approx(0.012 * (SCALE if change == "scaled" else 1), rel=1e-6)


def test_words_of_sides_stated_sizes_and_places_are_not_compared_where_they_change() -> None:
    assert comparable("tilted", asked("What is the bore diameter?"))
    assert not comparable("tilted", asked("What is the diameter of the hole on the left?"))
    assert not comparable("scaled", asked("How deep is the 12 mm hole?"))
    assert not comparable("shifted", asked("Where is the hole?", "point"))
    assert comparable("halves", asked("Where is the hole?", "point"))
