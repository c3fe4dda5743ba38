"""The unit that the words ask for wins."""

from __future__ import annotations

import pytest

from querycad_answering.drawing.asked_units import asked_unit
from querycad_contracts import LengthUnit


@pytest.mark.parametrize(
    ("question", "unit"),
    [
        ("How wide is it in inches?", LengthUnit.IN),
        ("depth of the slot in mm", LengthUnit.MM),
        ("length in metres please", LengthUnit.M),
        ("area in square centimetres?", LengthUnit.CM),
        ("What is the volume in in³?", LengthUnit.IN),
        ("How deep is the 5 in bore?", None),
        ("How wide is the cut in cmos holders?", None),
        ("How wide is the slot in the plate?", None),
        ("How many holes are in mounting plates?", None),
    ],
)
def test_the_unit_of_an_answer_is_the_one_that_is_asked_for(question: str, unit: LengthUnit | None) -> None:
    assert asked_unit(question) is unit
