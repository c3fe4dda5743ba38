"""Which length of a screw is asked for, and what becomes of several values."""

from __future__ import annotations

import pytest

from querycad_contracts import Measure
from querycad_language.forms import Form, Get, Reduce
from querycad_language.readings import read


def forms(question: str) -> list[Form]:
    return [reading.form for reading in read(question)]


@pytest.mark.parametrize(
    ("question", "overall"),
    [
        ("How long are the bolts?", False),
        ("How long is the bolt below its head?", False),
        ("Overall length of the bolt?", True),
        ("How long is the bolt from end to end?", True),
        ("Length of the bolt, head included?", True),
        ("How long is the bolt below the head, chamfer included?", False),
        ("All over length of bolt, from head top to the tip?", True),
    ],
)
def test_a_length_over_all_is_told_from_that_of_the_standard(question: str, overall: bool) -> None:
    get = next(form for form in forms(question) if isinstance(form, Get) and form.measures == (Measure.LENGTH,))
    assert get.overall is overall


@pytest.mark.parametrize(
    ("question", "reduce"),
    [
        ("range of the slot widths", Reduce.RANGE),
        ("What is the range of the depths of the bores?", Reduce.RANGE),
        ("What is the depth of the bores in the range of 4 to 6 mm?", Reduce.EACH),
    ],
)
def test_a_range_is_the_smallest_and_the_largest_value(question: str, reduce: Reduce) -> None:
    get = next(form for form in forms(question) if isinstance(form, Get) and form.target is not None)
    assert get.reduce is reduce


@pytest.mark.parametrize(
    ("question", "socket"), [("What allen key turns the stud?", True), ("What spanner turns the stud?", False)]
)
def test_an_allen_key_goes_in_a_socket(question: str, socket: bool) -> None:
    gets = [form for form in forms(question) if isinstance(form, Get) and form.measures == (Measure.ACROSS_FLATS,)]
    assert gets
    assert any(get.target is not None and get.target.noun == "hex socket" for get in gets) is socket
