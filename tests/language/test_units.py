"""The unit that the words ask for wins."""

from __future__ import annotations

import pytest

from querycad_contracts import LengthUnit
from querycad_language.units import asked_unit


@pytest.mark.parametrize(
    ("question", "unit"),
    [
        ("How wide is it in inches?", LengthUnit.IN),
        ("depth of the slot in mm", LengthUnit.MM),
        ("length in metres please", LengthUnit.M),
        ("How deep is the 5 in bore?", None),
        ("How wide is the slot in the plate?", None),
        ("How many holes are in mounting plates?", None),
    ],
)
def test_the_unit_of_an_answer_is_the_one_that_is_asked_for(question: str, unit: LengthUnit | None) -> None:
    assert asked_unit(question) is unit
