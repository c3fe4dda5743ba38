"""Wordings beyond the plain question: places, what sticks out, insides, statements before a question, telegrams."""

from __future__ import annotations

import statistics
import time

import pytest

from querycad_language.old import NotUnderstood, parse

SAME = [
    ("What is the depth of the blind hole?", "The plate has a blind hole; how deep is it?"),
    ("Give the centres of the round holes.", "Where must the four screws go? Give the centres of the round holes."),
    ("What is the width of the head?", "Which spanner fits, so what is the width across flats of the head?"),
    ("What is the outer diameter of the spigot?", "I want to grip the spigot: what is its outer diameter?"),
    ("What are the centres of the slots?", "The robot needs the centres of the slots."),
    ("How many logos are there?", "Is there a logo? How many of them?"),
    ("How many through holes are in the plate?", "How many holes go all the way through the plate?"),
    ("How many blind holes are on the top?", "Of the holes on the top, how many are blind?"),
    ("What is the height of the pins?", "How far do the pins stick out?"),
    ("Where is the centre of the slot?", "Where exactly is the middle of the slot?"),
    ("What is the diameter of the hole on the top?", "diameter top hole"),
    ("What is the size of the box?", "What is the size of the box (width x depth x height)?"),
    ("What is the diameter of the large hole?", "What is the diametre of the large hole?"),
    ("How many standoffs with a hole are there?", "How many standoffs have a hole?"),
    ("How many standoffs without a hole are there?", "How many standoffs have no hole?"),
    ("What is the centre distance between two slots in y?", "Which centre distance have two slots in y?"),
    ("How deep is the pocket?", "How deep is the pocket, half-way along its length?"),
    ("What is the diameter of the holes in the flange?", "What is the diametre of the holes in the flange?"),
    ("What is the colour of the cover?", "What is the color of the cover?"),
]  # fmt: skip


@pytest.mark.parametrize(("plain", "wordy"), SAME)
def test_another_wording_gives_the_same_program(plain: str, wordy: str) -> None:
    assert parse(wordy).code == parse(plain).code


@pytest.mark.parametrize(
    ("question", "description"),
    [
        ("How many holes are in the flange?", "hole in flange"),
        ("How many holes does the flange have?", "hole in flange"),
        ("How many screws hold the lid?", "screw near lid"),
        ("How many holes surround the hub?", "hole around hub"),
        ("What is the height of the cylinder that carries the cone?", "the cylinder with cone"),
        ("What is the diameter of the tube between the flanges?", "the tube between flange"),
        ("Diameter of the holes in the corners of the rear panel?", "corner hole in back panel"),
        ("How wide is the rectangular opening in the bottom?", "the rectangular opening"),
        ("What is the size of the rectangular inside of the box?", "the rectangular inside in box"),
        ("What is the inner height of the housing?", "the inside in housing"),
        ("What are the centres of the four through holes?", "4 through hole"),
        ("How many cooling fins does this heat sink have?", "cooling fin in heat sink"),
        ("What is the depth of the recess for the nut?", "the recess for nut"),
    ],
)
def test_a_place_stays_in_the_description_for_segcad_to_look_up(question: str, description: str) -> None:
    assert f'find_parts("{description}"' in parse(question).code


def test_what_passes_through_another_part_sticks_out_by_what_lies_outside_of_it() -> None:
    assert "overhang(" in parse("How far does the shaft stick out of the plate?").code
    assert "overhang(" not in parse("How far does the boss stick out of the top face?").code


def test_what_is_said_of_a_singular_part_beside_another_one_picks_the_nearest() -> None:
    assert "min(parts" in parse("What is the diameter of the cylinder below the cone?").code
    assert "min(parts" not in parse("How many holes are below the flange?").code


def test_opposite_parts_are_those_farthest_apart() -> None:
    assert "max(distances)" in parse("How far apart are two opposite holes?").code
    assert "max(distances)" in parse("Two holes lie opposite each other; how far are their centres apart?").code


@pytest.mark.parametrize(
    ("question", "measure"),
    [
        ("How large is the chamfer?", "min(p.extents)"),
        ("How large is the fillet?", "p.radius"),
        ("How thick is the tube?", "max(p.radii) - min(p.radii)"),
        ("What is the thickness of the tube's wall?", "max(p.radii) - min(p.radii)"),
        ("What is the x extent of the rib?", "p.extents[0]"),
        ("What is the width (shorter side) of the slot?", "min(p.length, p.width)"),
        ("What is the diameter of the countersink?", "2 * max(p.radii)"),
        ("At what height is the centre of the hole?", "p.center[2]"),
    ],
)
def test_a_measure_means_what_an_engineer_means(question: str, measure: str) -> None:
    assert measure in parse(question).code


def test_a_total_of_one_part_is_no_sum() -> None:
    assert "sum(" not in parse("How long is the shaft in total?").code
    assert "sum(" in parse("What is the total length of the slots?").code


@pytest.mark.parametrize(
    "question",
    [
        "What is the radius off chamferd hole?",
        "Which of the holes has the largest diameter, and how large is it?",
        "How many holes are there? How deep are they?",
        "Is the hole round or square?",
    ],
)
def test_what_is_not_understood_is_still_declined(question: str) -> None:
    with pytest.raises(NotUnderstood):
        parse(question)


def test_every_stretch_left_out_lowers_the_confidence() -> None:
    plain = parse("How deep is the pocket?").confidence
    once = parse("How deep is the pocket, measured from the rim?").confidence
    twice = parse("How deep is the pocket (the big one), measured from the rim?").confidence
    assert plain > once > twice


def test_a_question_is_parsed_in_the_time_of_a_few_milliseconds() -> None:
    """The median of all wordings, by processor time: 5 ms to hold, several times that on a busy machine."""
    spent = []
    for pair in SAME:
        for question in pair:
            start = time.process_time()
            parse(question)
            spent.append(time.process_time() - start)
    assert statistics.median(spent) < 0.05
