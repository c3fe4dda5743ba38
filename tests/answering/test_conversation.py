"""Questions that lean on what is pointed at, or on questions before, as ones that stand alone."""

from __future__ import annotations

from collections.abc import Sequence

import pytest
from tests.made import hole, part, whole

from querycad_answering.conversation import NotFollowed, stands_alone
from querycad_contracts import Part, Selection

BORE = part("counterbore-h1.1", kind="counterbore", faces=(25,))
PARTS: tuple[Part, ...] = (
    whole(faces=tuple(range(60))),
    hole(1, faces=(2, 25)),
    hole(4, faces=(5,)),
    BORE,
    part("cylinder-2", faces=(2,)),
    part("cylinder-12", faces=(25,)),
    part("cylinder-4", faces=(5,)),
    part("cylinder-99", faces=(99,)),
)


def alone(
    question: str, *context: str, before: Sequence[str] | None = ("hole-4",), selection: Selection | None = None
) -> str:
    return stands_alone(question, context, selection, lambda: PARTS, lambda _: before)


@pytest.mark.parametrize(
    ("question", "context", "text"),
    [
        ("and how deep is it?", "What is the radius of the slot?", "and how deep is hole-4?"),
        ("what is its depth?", "What is the radius of the slot?", "what is hole-4's depth?"),
        ("And the depth?", "What is the radius of the slot?", "And the depth of hole-4?"),
        ("How far is it from hole 1?", "radius of the slot", "How far is hole-4 from hole 1?"),
        ("the same in inches", "How deep is the slot?", "How deep is the slot in inches?"),
        ("and in mm?", "How deep is the slot?", "How deep is the slot in mm?"),
        ("what is their pitch?", "How many slots are there?", "what is the pitch of the slots?"),
        (
            "what is their centre distance?",
            "How many T-slots are there?",
            "what is the centre distance of the T-slots?",
        ),
        (
            "what is their distance from the edge?",
            "How many slots are there?",
            "what is hole-4's distance from the edge?",
        ),
        ("only the ones on top", "How many holes are there?", "How many holes on top are there?"),
        ("only the blind ones", "How deep are the holes on top?", "How deep are the blind holes on top?"),
        (
            "just those visible from the left",
            "How deep are the holes?",
            "How deep are the holes visible from the left?",
        ),
        ("only on the bottom", "How many slots are there?", "How many slots on the bottom are there?"),
        ("only the largest", "How deep are the holes?", "How deep are the largest holes?"),
        ("and the slots?", "How deep are the holes?", "How deep are the slots?"),
        ("what about hole 1?", "How deep is hole 4?", "How deep is hole 1?"),
        ("how many are there?", "How deep are the blind slots?", "How many blind slots are there?"),
        ("How many ribs are there?", "How deep are the holes?", "How many ribs are there?"),
        ("How deep is the hole?", "How many slots are there?", "How deep is the hole?"),
    ],
)
def test_a_question_leans_on_the_one_before(question: str, context: str, text: str) -> None:
    assert alone(question, context) == text


def test_several_follow_one_another() -> None:
    said = ["How many holes are there?", "only the blind ones", "only the ones on top"]
    assert alone("how deep are they?", *said, before=("hole-1", "hole-4")) == "how deep are hole-1 and hole-4?"
    assert alone("and the slots?", *said) == "How many slots are there?"
    assert alone("the same in inches", "How deep is hole 4?", "and its diameter?") == "and hole-4's diameter in inches?"


def test_the_third_one_is_the_third_part_of_the_answer_before() -> None:
    three = ("hole-1", "hole-4", "hole-6")
    asked = "Which holes are deep?"
    assert alone("How deep is the third one?", asked, before=three) == "How deep is hole-6?"
    assert alone("How deep is the last one?", asked, before=three) == "How deep is hole-6?"
    assert alone("depth of number 2", asked, before=three) == "depth of hole-4"
    assert alone("distance of the 1st of them to the 2nd of them", asked, before=three) == (
        "distance of hole-1 to hole-4"
    )
    with pytest.raises(NotFollowed, match="no number 4 among 3 parts"):
        alone("How deep is the fourth one?", asked, before=three)


def test_it_is_the_whole_model_where_the_question_before_was_about_that() -> None:
    assert alone("how wide is it?", "What is the volume?", before=None) == "how wide is it?"


def test_what_was_not_found_before_is_not_taken_for_something_else() -> None:
    with pytest.raises(NotFollowed, match="about 'blind holes', and no such part was found"):
        alone("how deep are they?", "How many blind holes are there?", before=())


def test_a_question_about_several_things_is_not_narrowed() -> None:
    with pytest.raises(NotFollowed, match="ask in full"):
        alone("only the ones on top", "Is the slot deeper than the pocket?")


def test_more_than_two_parts_are_named_together() -> None:
    many = ("hole-1", "hole-4", "hole-6")
    assert alone("how deep are they?", "Which holes are deep?", before=many) == "how deep are hole-1+hole-4+hole-6?"


@pytest.mark.parametrize(
    ("question", "selection", "text"),
    [
        ("How deep is it?", Selection(parts=("hole-4",)), "How deep is hole-4?"),
        ("How deep is this hole?", Selection(parts=("hole-4",)), "How deep is hole-4?"),
        ("depth of the selected part", Selection(parts=("hole-4",)), "depth of hole-4"),
        ("How far apart are these?", Selection(parts=("hole-1", "hole-4")), "How far apart are hole-1 and hole-4?"),
        ("diameter?", Selection(faces=(25,)), "diameter of counterbore-h1.1?"),
        ("How deep?", Selection(faces=(25,)), "How deep is counterbore-h1.1?"),
        ("How deep is this hole?", Selection(faces=(25,)), "How deep is hole-1?"),
        ("How deep is it?", Selection(faces=(2, 25)), "How deep is hole-1?"),
        ("area of this face", Selection(faces=(25,)), "area of cylinder-12"),
        ("area of these faces", Selection(faces=(2, 5)), "area of cylinder-2 and cylinder-4"),
        ("area of this face", Selection(parts=("face 25",)), "area of cylinder-12"),
        ("How deep is it?", Selection(parts=("Hole 4",)), "How deep is hole-4?"),
        ("radius of it", Selection(faces=(99,)), "radius of cylinder-99"),
        ("How many slots are there?", Selection(parts=("hole-4",)), "How many slots are there?"),
        ("How deep is it?", Selection(), "How deep is it?"),
    ],
)
def test_it_and_this_are_what_is_pointed_at(question: str, selection: Selection, text: str) -> None:
    assert alone(question, selection=selection) == text


@pytest.mark.parametrize(
    ("selection", "says"),
    [(Selection(parts=("hole-9",)), "no hole-9"), (Selection(parts=("face-59",)), "known of face 59")],
)
def test_what_is_pointed_at_and_is_not_there_is_refused(selection: Selection, says: str) -> None:
    with pytest.raises(NotFollowed, match=says):
        alone("How deep is it?", selection=selection)


def test_what_is_pointed_at_goes_before_what_was_asked() -> None:
    asked = ("How deep is hole 4?",)
    text = stands_alone("and its area?", asked, Selection(parts=("hole-1",)), lambda: PARTS, lambda _: ("hole-4",))
    assert text == "and hole-1's area?"


def test_the_third_of_nothing_is_refused() -> None:
    with pytest.raises(NotFollowed, match="'the third one' counts what was answered before, and nothing was"):
        alone("how deep is the third one?")
    assert alone("Of the lugs, how deep is the third one?") == "Of the lugs, how deep is the third one?"
