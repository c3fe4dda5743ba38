from __future__ import annotations

from pathlib import Path

import pytest
from benchmark.scoring.failures import FailureClass, failure_class
from benchmark.scoring.items import Item
from benchmark.scoring.rules import expression, score
from benchmark.scoring.systems import Reply
from hypothesis import given, settings
from hypothesis import strategies as st

from querycad_contracts import AnswerType

RIGHT, WRONG, NEAR = (True, True), (False, False), (False, True)


def item(label: str, is_sorted: bool = False, kind: AnswerType | None = None) -> Item:
    return Item("abc", "001", 0, Path("cad.step"), "?", label, is_sorted, kind)


def judge(label: str, answer: str | None, said: AnswerType | None = None, **options: object) -> tuple[bool, bool]:
    found = score(item(label, **options), answer, said)  # type: ignore[arg-type]
    return found.strict, found.tolerant


@pytest.mark.parametrize(
    ("label", "answer", "expected"),
    [
        ("4", "4", RIGHT),
        ("4", "5", WRONG),
        ("4", "4.0", WRONG),
        ("100", "101", WRONG),
        ("4", None, WRONG),
        ("4", "four", WRONG),
        ("0.0064", "0.00636", RIGHT),
        ("0.00636", "0.0064", RIGHT),
        ("0.0063", "0.0064", NEAR),
        ("0.0062", "0.0064", WRONG),
        ("0.14662", "0.14651", NEAR),
        ("0.1", "0.1009", NEAR),
        ("0.1", "0.1011", WRONG),
        ("0.005", "[0.005]", RIGHT),
        ("[0.005]", "0.005", RIGHT),
        ("0.005", "[0.005, 0.005]", NEAR),
        ("0.005", "[0.005, 0.006]", WRONG),
        ("0.005", "[]", WRONG),
        ("[0.01, 0.01]", "[0.01, 0.01]", RIGHT),
        ("[0.01, 0.01]", "[0.01]", WRONG),
        ("[0.01, 0.01]", "0.01", WRONG),
        ("[0.01, 0.02]", "[0.02, 0.01]", NEAR),
        ("[0.01, 0.02]", "(0.01, 0.02)", RIGHT),
        ("[0.01, 0.02, 0.02]", "[0.01, 0.01, 0.02]", WRONG),
        ("0.0", "-0.00001", RIGHT),
        ("True", "True", RIGHT),
        ("True", "1", WRONG),
        ("'steel'", "'Steel'", NEAR),
    ],
)
def test_one_label_and_one_answer(label: str, answer: str | None, expected: tuple[bool, bool]) -> None:
    assert judge(label, answer) == expected


def test_the_order_counts_strictly_unless_the_label_is_in_no_particular_order() -> None:
    assert judge("[0.001, 0.002]", "[0.002, 0.001]", is_sorted=True) == RIGHT
    assert judge("[[0.0, 1.0, 0.0], [0.0, 0.5, 0.0]]", "[[0.0, 0.5, 0.0], [0.0, 1.0, 0.0]]", is_sorted=True) == RIGHT
    assert judge("[[0.0, 1.0, 0.0], [0.0, 0.5, 0.0]]", "[[0.0, 0.5, 0.0], [0.0, 1.0, 0.0]]") == NEAR


def test_a_point_keeps_the_order_of_its_coordinates() -> None:
    assert judge("[0.1, 0.2, 0.3]", "[0.2, 0.1, 0.3]", AnswerType.POINT) == WRONG
    assert judge("[0.1, 0.2, 0.3]", "[0.2, 0.1, 0.3]", AnswerType.SIZE) == WRONG
    assert judge("[0.1, 0.2, 0.3]", "[0.2, 0.1, 0.3]", AnswerType.LENGTHS) == NEAR
    assert judge("[[0.1, 0.2, 0.3]]", "[0.2, 0.1, 0.3]", AnswerType.POINT) == WRONG
    assert judge("[0.1, 0.2, 0.3]", "[[0.1001, 0.2, 0.3], [0.1, 0.2, 0.3]]", AnswerType.POINTS) == NEAR
    assert judge("[0.1, 0.2, 0.3]", "[[0.1, 0.2, 0.3], [0.4, 0.2, 0.3]]", AnswerType.POINTS) == WRONG


def test_the_published_rule_compares_text_so_that_a_whole_number_is_no_float() -> None:
    assert judge("[0.0035, 0.007, 0]", "[0.0035, 0.007, 0.0]", AnswerType.POINT) == NEAR


def test_a_set_is_compared_with_the_different_values() -> None:
    assert judge("{0.0043053, 0.00635, 0.0127}", "[0.0127, 0.0043, 0.00635, 0.00635]") == RIGHT
    assert judge("{0.01, 0.02}", "[0.01]") == WRONG
    assert judge("{0.01, 0.02}", "[0.01, 0.02, 0.03]") == WRONG
    assert judge("{0.01, 0.02}", "[0.01008, 0.02]") == NEAR


def test_an_expression_must_match_the_whole_printed_answer() -> None:
    assert judge("re(12|13)", "13") == RIGHT
    assert judge("re(12|13)", "130") == WRONG
    assert judge("re(0.34|0.3405)", "0.34049") == RIGHT
    assert judge("re(0.34|0.3405)", "0.3425") == NEAR
    assert judge("re(0.34|0.3405)", "0.35") == WRONG
    assert judge("re(12|13)", "12.5") == WRONG
    assert judge(r"re \d+", "7") == RIGHT
    assert judge(r"re \d+", "0.5") == WRONG


def test_text_that_begins_with_the_letters_of_an_expression_is_none() -> None:
    assert expression("re(1|2)") == "(1|2)"
    assert expression("'red'") is None
    assert expression("rectangle") is None


@pytest.mark.parametrize("label", ["about 4", "re(4", ""])
def test_a_label_that_is_neither_is_text_and_stops_no_run(label: str) -> None:
    assert judge(label, "4") == WRONG
    assert judge(label, repr(label)) == RIGHT
    assert failure_class(item(label), Reply(value=4)) is FailureClass.REASONING


def test_areas_and_volumes_are_not_all_alike() -> None:
    assert judge("1.234e-05", "1.3e-05", kind=AnswerType.AREA) == WRONG
    assert judge("1.234e-05", "1.236e-05", kind=AnswerType.AREA) == NEAR
    assert judge("1.2344e-05", "1.23441e-05", kind=AnswerType.AREA) == RIGHT


def test_an_angle_has_no_tolerance_of_a_tenth_of_a_millimetre() -> None:
    assert judge("0.0012", "0.0013", kind=AnswerType.ANGLE) == WRONG
    assert judge("0.0012", "0.0013", kind=AnswerType.LENGTH) == NEAR
    assert judge("1.5707963", "1.57", kind=AnswerType.ANGLE) == NEAR


def test_a_direction_has_no_sign() -> None:
    assert judge("[0.0, 0.0, 1.0]", "[0.0, 0.0, -1.0]", kind=AnswerType.DIRECTION) == NEAR
    assert judge("[0.0, 0.0, 1.0]", "[0.0, 0.01, 1.0]", kind=AnswerType.DIRECTION) == NEAR
    assert judge("[0.0, 0.0, 1.0]", "[0.0, 1.0, 0.0]", kind=AnswerType.DIRECTION) == WRONG
    assert judge("[0.0, 0.0, 1.0]", "[0.0, 0.0, 0.0]", kind=AnswerType.DIRECTION) == WRONG


def test_a_whole_number_of_metres_is_no_count_where_the_benchmark_says_length() -> None:
    assert judge("1", "1.005", kind=AnswerType.LENGTH) == NEAR
    assert judge("1", "1.005") == WRONG


def test_close_values_are_paired_one_to_one() -> None:
    """0.100 agrees with both labels, 0.1008 only with the first: pairing in order of the answer would miss it."""
    assert judge("[0.1002, 0.0995]", "[0.1, 0.1008]") == NEAR


lengths = st.lists(st.floats(0.001, 2.0), min_size=1, max_size=6)


@settings(deadline=None)
@given(lengths, st.randoms())
def test_a_shuffled_list_of_the_same_lengths_is_right_within_tolerance(values: list[float], random: object) -> None:
    shuffled = list(values)
    random.shuffle(shuffled)  # type: ignore[attr-defined]
    assert judge(repr(values), repr(shuffled), AnswerType.LENGTHS)[1]
    assert judge(repr(values), repr(shuffled), AnswerType.LENGTHS, is_sorted=True)[0]


@settings(deadline=None)
@given(lengths, st.floats(0.02, 1.0))
def test_a_list_with_one_length_far_off_is_wrong(values: list[float], share: float) -> None:
    off = [*values[:-1], 2 * max(values) * (1 + share) + 0.01]
    assert judge(repr(values), repr(off), AnswerType.LENGTHS, is_sorted=True) == WRONG


@settings(deadline=None)
@given(lengths)
def test_what_is_strictly_right_is_right_within_tolerance(values: list[float]) -> None:
    strict, tolerant = judge(repr(values), repr([round(value, 5) for value in values]), AnswerType.LENGTHS)
    assert tolerant >= strict
