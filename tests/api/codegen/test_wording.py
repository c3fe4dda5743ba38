"""Turns of speech: the same program as for the plain question."""

from __future__ import annotations

import pytest

from querycad_api.codegen import parse


@pytest.mark.parametrize(
    ("said", "plain"),
    [
        ("If I look at the part from above, what is the diameter of the holes I see?",
         "What is the diameter of the holes visible from above?"),
        ("How many holes do I see if I look at it from the left?", "How many holes are visible from the left?"),
        ("I'm looking at it from the front: how deep is the largest hole there?",
         "How deep is the largest hole seen from the front?"),
        ("Top view: how many holes are visible?", "How many holes are visible from the top?"),
        ("Holes on top: diameter?", "What is the diameter of the holes on top?"),
        ("For the shaft: what is the length?", "What is the length of the shaft?"),
        ("There's a slot at the back of the part, how wide is it?", "How wide is the slot at the back of the part?"),
        ("From the front you can see two legs, how far apart are they?",
         "How far apart are two legs visible from the front?"),
        ("How thick is the rib, i.e. what is its thickness?", "What is the thickness of the rib?"),
        ("How tall is the object if you leave out the shaft?", "How tall is the object without the shaft?"),
        ("How high is the part when the shaft is not counted?", "How high is the part without the shaft?"),
        ("Give me all unique hole radii.", "What are the different hole radii?"),
        ("What radii do the holes have? Please name each one only once.", "What different radii do the holes have?"),
        ("How much is the height of the rib?", "What is the height of the rib?"),
        ("How much wide is the slot?", "How wide is the slot?"),
        ("How much holes has the object?", "How many holes has the object?"),
        ("How big in diameter is the shaft?", "What is the diameter of the shaft?"),
        ("dia. of the holes?", "What is the diameter of the holes?"),
        ("How long are the two screws incl. their heads?", "How long are the two screws including their heads?"),
        ("Whats the length of the slot on the far right?", "What is the length of the slot on the right?"),
        ("What's the volume of material of the washer?", "What is the volume of the washer?"),
        ("slot width for each slot on the top", "width of each slot on the top"),
        ("Pitch circle diameter of the screw holes?", "What is the diameter of the bolt circle of the screw holes?"),
    ],
)  # fmt: skip
def test_a_turn_of_speech_gets_the_program_of_the_plain_question(said: str, plain: str) -> None:
    assert parse(said).code == parse(plain).code


@pytest.mark.parametrize(
    ("question", "written"),
    [
        ("What is the diameter of one of the holes?", "different([p.diameter for p in parts])"),
        ("How deep are the slots, one value?", "different([p.depth for p in parts])"),
        ("Where is the upper end of the rod?", "p.center[2] + p.half_extents[2]"),
        ("How wide is the collar along its axis?", "p.height"),
        ("How long is the motor without the shaft?", "others[0].length"),
        ("What is the radius of the upper hole?", "max(parts, key=lambda p: p.center[2])"),
        ("How high is the left leg visible from the front?", "min(parts, key=lambda p: p.center[0])"),
        ("Which diameter do the locating pins on top have?", 'find_parts("locating pin on top", sides=["top"])'),
        ("How far are the mounting holes apart in x?", "different([d for d in distances if d > 1e-06])"),
        ("How far apart are neighbouring holes?", "if close(a.diameter, b.diameter)"),
        ("What are the names of the different bodies?", "sorted(set([p.name for p in parts]))"),
        ("How far do the pins protrude above the plate?", "overhang(p, parts[0]) or p.height"),
        ("What is the radius of the plate the shaft comes out of?", 'find_parts("plate")'),
        ("How thick is the shaft?", "p.diameter"),
    ],
)
def test_a_wording_is_read_as_it_is_meant(question: str, written: str) -> None:
    assert written in parse(question).code


def test_several_like_parts_have_one_value_where_the_question_is_about_one() -> None:
    assert "len(different(values)) == 1" in parse("What is the diameter of the hole?").code
    assert "different" not in parse("What is the diameter of the holes?").code


def test_another_form_of_a_verb_is_no_typing_error() -> None:
    assert "locating pin" in parse("How high are the locating pins?").code
