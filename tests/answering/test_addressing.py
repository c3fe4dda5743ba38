"""What is printed of parts can be asked for: ids, face numbers, names of bodies; what the model lacks is refused."""

from __future__ import annotations

import pytest
from tests.made import body, hole, part

from querycad_answering.addressing import FIRST_ALIAS, address, may_name_parts, names_all, reader_of
from querycad_contracts import Part
from querycad_language.forms import Distance

BORE = part("counterbore-h1.1", kind="counterbore", faces=(40,))
WALL = part("cylinder-7", faces=(36,))
PARTS: tuple[Part, ...] = (
    hole(1),
    hole(2),
    hole(4),
    hole(6),
    BORE,
    WALL,
    part("sheet-bend-2", kind="bend", faces=(50,)),
    part("face-36", faces=(60,)),
    body(9, "Dowel pin 1", faces=(70,)),
    body(10, "Dowel pin 2", faces=(80,)),
    body(11, "Screw", faces=(81,)),
    body(12, "Screw", faces=(82,)),
)


@pytest.mark.parametrize(
    ("question", "ids"),
    [
        ("How deep is hole 4?", {"hole-4"}),
        ("How deep is hole-4?", {"hole-4"}),
        ("depth of HOLE-4", {"hole-4"}),
        ("depth of hole number 4", {"hole-4"}),
        ("distance between hole 4 and hole 6", {"hole-4", "hole-6"}),
        ("diameters of holes 1, 2 and 4", {"hole-1", "hole-2", "hole-4"}),
        ("diameter of holes 1 to 2", {"hole-1", "hole-2"}),
        ("distance from hole 1 to hole 2", {"hole-1", "hole-2"}),
        ("diameter of counterbore-h1.1", {"counterbore-h1.1"}),
        ("radius of bend 2", {"sheet-bend-2"}),
        ("radius of sheet bend 2", {"sheet-bend-2"}),
        ("area of face 36", {"cylinder-7"}),
        ("area of face-36", {"face-36"}),
        ("volume of dowel pin 2", {"body-10"}),
        ("distance between Dowel pin 1 and Dowel pin 2", {"body-9", "body-10"}),
        ("depth of hole-1+hole-2+hole-4", {"hole-1", "hole-2", "hole-4"}),
        ("How deep is hole 4 in inches?", {"hole-4"}),
        ("depth of Hole4", {"hole-4"}),
        ("mass of body 9 in aluminium", {"body-9"}),
        ("radius of face 50", {"sheet-bend-2"}),
    ],
)
def test_parts_are_named_by_what_is_printed_of_them(question: str, ids: set[str]) -> None:
    found = address(question, PARTS)
    assert found.failure is None
    assert found.ids == ids
    assert may_name_parts(question)
    readings = reader_of(found, frozenset()).readings
    assert any(names_all(reading, found.ids) for reading in readings)


@pytest.mark.parametrize(
    "question",
    [
        "How many 4 mm holes are there?",
        "Is there a hole 4 mm deep?",
        "holes with a radius of 8",
        "Are there 4 holes?",
        "4x M8 screws",
        "a hole of 4.5",
        "holes 10 apart",
        "Can it be made on a 3-axis mill?",
        "Is it ISO-4762?",
        "How many screws are there?",
    ],
)
def test_numbers_that_name_nothing_stay(question: str) -> None:
    found = address(question, PARTS)
    assert (found.texts, found.failure, found.ids) == ((question,), None, frozenset())


@pytest.mark.parametrize(
    ("question", "says"),
    [
        ("radius of hole 99", "the model has no hole-99; it has hole-1..2, hole-4, hole-6"),
        ("Is hole 4 deeper than hole 12?", "no hole-12"),
        ("depth of holes 1 and 5", "no hole-5"),
        ("radius of bend 7", "no bend-7; it has sheet-bend-2"),
        ("How wide is slot 3?", "no slot-3; it has no slot at all"),
        ("depth of counterbore-h9.1", "no counterbore-h9.1"),
        ("area of face 500", "its faces have the numbers 0 to 82"),
    ],
)
def test_an_id_that_the_model_lacks_is_refused_with_those_it_has(question: str, says: str) -> None:
    failure = address(question, PARTS).failure
    assert failure is not None
    assert failure.category == "not_grounded"
    assert says in failure.message


def test_a_face_by_number_and_a_part_of_that_number_are_told_apart() -> None:
    assert address("area of face 36", PARTS).notes == (
        "face 36 is the face of that number in the file, cylinder-7; face-36 is another",
    )


def test_several_in_a_list_are_read_apart_or_together() -> None:
    apart, together = address("depth of hole 1 and hole 2", PARTS).texts
    assert apart == f"depth of hole {FIRST_ALIAS} and hole {FIRST_ALIAS + 1}"
    assert together == f"depth of holes {FIRST_ALIAS + 2}"


def test_neighbours_in_a_row_are_no_distance_of_three_parts() -> None:
    found = address("how far apart are hole 1, hole 2 and hole 4", PARTS)
    readings = reader_of(found, frozenset()).readings
    assert any(isinstance(reading.form, Distance) for reading in readings)
    assert not any(names_all(reading, found.ids) for reading in readings if isinstance(reading.form, Distance))


def test_a_name_that_is_passed_over_is_told_as_it_is_printed() -> None:
    readings = reader_of(address("Is hole 4 or hole 6 wider than the slot?", PARTS), frozenset()).readings
    skipped = [word for reading in readings for _, word in reading.skipped]
    assert not any(word.startswith("90") for word in skipped)
    assert {"hole-4", "hole-6"} & set(skipped)
