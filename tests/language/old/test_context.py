"""What a question leans on: the parts that are named before it, in brackets, or in place of others."""

from __future__ import annotations

import pytest

from querycad_language.old import NotUnderstood, parse


@pytest.mark.parametrize(
    ("said", "plain"),
    [
        ("The slot on top, how long is it?", "How long is the slot on top?"),
        ("So the pocket on the underside, how deep does it go?", "How deep is the pocket on the underside?"),
        ("Slot on top - length?", "What is the length of the slot on top?"),
        ("the cover, thickness?", "What is the thickness of the cover?"),
        ("The shaft has a keyway. What width?", "What is the width of the keyway?"),
        ("The plate has four holes on top. How many?", "How many holes are on the top?"),
        ("There are two pockets on top. How deep is the deeper one?", "How deep is the deepest pocket on top?"),
        ("We have to mill the slot. How deep must we go?", "How deep is the slot?"),
        ("I want to put a dowel in the hole on the left. What diameter should it have?",
         "What is the diameter of the hole on the left?"),
        ("The robot has to grip the shaft: where is its centre?", "Where is the centre of the shaft?"),
        ("Behind the flange is a groove. How wide is it?", "How wide is the groove behind the flange?"),
        ("On the underside there seem to be some pockets. How many, please?", "How many pockets are on the underside?"),
        ("Does the shaft have a keyway? If so, how wide is it?", "How wide is the keyway?"),
        ("Four screws hold the lid. How thick is it?", "How thick is the lid?"),
        ("It bolts to the 13 mm holes in the lugs, how far apart are these holes?",
         "How far apart are the 13 mm holes in the lugs?"),
        ("The six holes lie on a circle - what is its radius?",
         "What is the radius of the bolt circle of the six holes?"),
        ("I'd need a screw for the threaded hole on the right, how deep is that one?",
         "How deep is the threaded hole on the right?"),
        ("See that slot at the front? How wide is it?", "How wide is the slot at the front?"),
        ("Our customer complains about the fit of the shaft. How thick is it?", "How thick is the shaft?"),
        ("The fan is held by four screws. How long are their heads?", "How long are the screws' heads?"),
        ("How many spokes does it have, the wheel?", "How many spokes does the wheel have?"),
        ("Look at the slot on top. How wide is it?", "How wide is the slot on top?"),
        ("For a replacement pin I need its length.", "What is the length of the pin?"),
        ("I'm looking at the part from the front. How many holes do I see?",
         "How many holes are visible from the front?"),
        ("The gap between the two legs, how wide is it?", "How wide is the gap between the two legs?"),
        ("How many holes with a ring around them are there?", "How many holes with a ring around are there?"),
        ("Key width? (keyway in the bore)", "What is the width of the keyway in the bore?"),
        ("How wide is the key seat (the slot in the shaft)?", "How wide is the slot in the shaft?"),
    ],
)  # fmt: skip
def test_a_question_takes_its_parts_from_what_is_said_around_it(said: str, plain: str) -> None:
    assert parse(said).code == parse(plain).code


@pytest.mark.parametrize(
    ("said", "description"),
    [
        ("The lid, I mean the round one on top, how thick is it?", "the round lid"),
        ("How wide is the fork, I mean the slot for the roller?", "the slot for roller"),
        ("What diameter has the socket, the small cylinder inside the shade?", "the small cylinder in shade"),
        ("The plate is rounded at the corners. What radius?", "the corner rounding in plate"),
        ("Clear aperture (the narrowest diameter of the big hole)?", "big hole"),
        ("What is the diameter of the hole the pin sits in?", "the hole for pin"),
        ("What is the diameter of the shaft where the bearing goes?", "the shaft for bearing"),
    ],
)
def test_words_that_explain_others_choose_the_parts(said: str, description: str) -> None:
    assert f'find_parts("{description}"' in parse(said).code


@pytest.mark.parametrize(
    ("said", "left_out"),
    [
        ("My caliper is broken, can you tell me how thick the flange is?", "My caliper is broken"),
        ("We've lost the drawing. How deep are the blind holes?", "We have lost the drawing."),
        ("How wide is the fork, I mean the slot for the roller?", "what is corrected by 'the slot for the roller'."),
        ("How thick is the base, the flat plate at the bottom?", "the base."),
    ],
)
def test_what_is_passed_over_is_told(said: str, left_out: str) -> None:
    program = parse(said)
    assert f"Left out: {left_out}" in program.notes
    assert program.confidence < 1


def test_a_condition_is_never_left_out() -> None:
    with pytest.raises(NotUnderstood):
        parse("If the wall were 3 mm thicker, how deep would the bore be then?")


def test_whose_measure_is_asked_is_told() -> None:
    assert "Asked of 'The shaft'." in parse("The shaft has several steps. What are the diameters?").notes


def test_an_overall_measure_is_of_the_whole_model_whatever_was_said_before() -> None:
    assert "shape.height" in parse("The plate has a hole. What is the overall height?").code


def test_a_list_with_and_is_no_apposition() -> None:
    assert parse("How long are the shaft, the pin and the rod?").code.count("find_parts") == 3
