"""What is asked about need not be there: that it is missing competes, as an answer of its own, with every guess."""

from __future__ import annotations

import pytest
from tests.made import hole, part, view, whole

from querycad_answering.candidates import Absence
from querycad_answering.ranking import Ranked, ranked
from querycad_answering.unanswerable import Refused
from querycad_answering.understanding import Understanding
from querycad_contracts import (
    Expectation,
    FailureCategory,
    Grounded,
    LengthUnit,
    PartQuery,
    Place,
    Program,
    RunOutcome,
    RunStatus,
    Side,
)
from querycad_language.forms import Towards
from querycad_language.readings.reader import Reader

HOLES = (hole(1, -20, faces=(1,)), hole(2, 0, diameter=0.012, depth=0.004, faces=(2,)), hole(3, 20, 9, faces=(3,)))


def ten_millimetres(_: Program) -> RunOutcome:
    return RunOutcome(status=RunStatus.OK, value=0.01)


def asked(question: str) -> Understanding:
    return Understanding(question, view(*HOLES), Expectation())


@pytest.mark.parametrize("noun", ["keyway", "wardrobe"])
def test_a_noun_that_only_something_else_stands_for_may_be_missing(noun: str) -> None:
    assert noun in {one.query.noun for one in asked(f"How long is the {noun}?").absences}


def test_what_is_there_by_its_name_is_not_missing() -> None:
    assert not asked("How deep is the hole?").absences


def test_how_many_there_are_is_answered_by_none_and_not_refused() -> None:
    assert not asked("How many keyways are there?").absences
    assert not asked("Is there a keyway?").absences


def test_what_the_file_is_named_after_is_there() -> None:
    named = Understanding("How wide is the bracket?", view(whole("wire_bracket"), hole(1)), Expectation())
    assert not named.absences
    assert asked("How wide is the bracket?").absences


def test_a_keyway_that_is_not_there_is_refused_with_its_name_and_what_there_is() -> None:
    failure = asked("How deep is the keyway?").answered(ten_millimetres, LengthUnit.MM).verdict.failure
    assert failure is not None
    assert (failure.category, "keyway" in failure.message) == (FailureCategory.NOT_GROUNDED, True)
    assert "hole" in failure.nearest


@pytest.mark.parametrize("question", ["How long is the wardrobe?", "How wide is the second keyway?"])
def test_what_is_not_there_is_never_answered_as_if_it_were_sure(question: str) -> None:
    told = asked(question).answered(ten_millimetres, LengthUnit.MM)
    assert told.verdict.failure is not None or (told.confidence is not None and told.confidence < 0.6)


def test_a_part_that_may_be_missing_lowers_the_confidence_of_every_value() -> None:
    understanding = asked("How long is the wardrobe?")
    tried = understanding.tried(ten_millimetres, every=True)
    (alone,), (beside,) = ranked(tried).values, ranked(tried, (), understanding.absences).values
    assert understanding.absences
    assert beside.confidence < alone.confidence


def test_where_it_is_likelier_than_the_best_value_a_note_says_that_it_may_be_missing() -> None:
    told = asked("How long is the wardrobe?").answered(ten_millimetres, LengthUnit.MM)
    failure = told.verdict.failure
    assert "wardrobe" in (failure.message if failure is not None else " ".join(told.notes))


def test_missing_is_what_is_likelier_than_all_values_together() -> None:
    understanding = asked("How deep is the hole?")
    values = ranked(understanding.tried(ten_millimetres)).values
    assert not Ranked(values, 0.0).is_absent
    assert Ranked(values, 1.0).is_absent
    assert Ranked((), 0.1).is_absent
    assert understanding.missing(Ranked(values, 0.0)) is None


@pytest.mark.parametrize(
    ("place", "features", "message"),
    [
        ("places", ("place_empties", "place_elsewhere"), "the model has 'hole', but not in the slot"),
        ("places", ("place_absent",), "the model has no 'slot'"),
        ("ends", ("end_empties",), "the model has 'hole', but not at the left end"),
    ],
)
def test_what_is_in_another_place_is_told_to_be_there(place: str, features: tuple[str, ...], message: str) -> None:
    slot = Place(relation="in", what=PartQuery(noun="slot", words=("slot",), definite=True))
    left = {"places": (slot,)} if place == "places" else {"ends": (Side.LEFT,)}
    query = PartQuery(noun="hole", words=("hole",), definite=True).model_copy(update=left)
    missing = Absence(query, Grounded(parts=(), features=dict.fromkeys(features, 1.0)), {})
    assert Refused(Reader("How deep is it?"), ()).absent(missing).message == message


@pytest.mark.parametrize(("noun", "guessed"), [("holes", False), ("gussets", True)])
def test_the_side_of_parts_that_are_there_is_not_that_of_guesses(noun: str, guessed: bool) -> None:
    notches = [part(f"notch-{i}", (0.03 * i, 0.0, 0.0), width=0.004, length=0.02, depth=0.003) for i in (1, 2)]
    asked = Understanding(f"Which side has the most {noun}?", view(hole(1), hole(2, 20), *notches), Expectation())
    towards = [found for found in asked.ranked if isinstance(found.reading.form, Towards)]
    taken = {one.kind for found in towards for way in found.grounds.values() for one in way.parts}
    assert taken
    assert ("notch" in taken) is guessed
