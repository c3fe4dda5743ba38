"""Readings are ranked on the model; the answer says how probable it is, and what else may be meant."""

from __future__ import annotations

import math
from typing import Any

import pytest
from tests.made import body, hole, inventory, part, view, whole

from querycad_answering.affinity import Affinity
from querycad_answering.answering import answer_question
from querycad_answering.candidates import candidates, with_value
from querycad_answering.confidence import NOT_SURE, calibrated, most
from querycad_answering.ranking import key, ranked
from querycad_answering.understanding import ModelView, Understanding, meant
from querycad_contracts import (
    AnswerOptions,
    AnswerRecord,
    AnswerType,
    Expectation,
    Program,
    RunOutcome,
    RunStatus,
    Status,
)
from querycad_language.forms import Which
from querycad_language.readings import read
from querycad_language.readings.reader import Reader
from querycad_sandbox import Sandbox
from querycad_segworker.grounding.find import find

THREE = (hole(1, -20, faces=(1,)), hole(2, 0, diameter=0.012, depth=0.004, faces=(2,)), hole(3, 20, 9, faces=(3,)))


class Counted:
    """Gives each program another value, or the ones that it is told; counts the runs."""

    def __init__(self, *told: Any) -> None:
        self.told = list(told)
        self.programs: list[Program] = []

    def __call__(self, program: Program) -> RunOutcome:
        self.programs.append(program)
        number = len(self.programs) - 1
        value = self.told[number] if number < len(self.told) else 0.001 * (number + 1)
        return RunOutcome(status=RunStatus.OK, value=value)


def ask(question: str, run: Any, model: ModelView, **options: Any) -> AnswerRecord:
    return answer_question(question, run, model, options=AnswerOptions(**options))


def test_candidates_are_ranked_and_each_program_is_one() -> None:
    model = view(*THREE)
    found = candidates(
        read("What is the depth of the largest hole?"), model.ground, model.whole, Affinity((), model.whole)
    )
    scores = [one.score for one in found]
    assert scores == sorted(scores, reverse=True)
    assert len({one.written.code for one in found}) == len(found)
    assert [part.id for grounded in found[0].grounds.values() for part in grounded.parts] == ["hole-2"]


def test_an_agent_is_told_of_no_reading_that_is_unlikely() -> None:
    """A small model took "diameter of the whole model" for what was asked."""
    understanding = Understanding("What is the diameter of the holes?", view(*THREE), Expectation())
    every = [meant(one) for one in understanding.ranked]
    assert "diameter of the whole model" in every
    assert understanding.readings == ("diameter of the holes",)


def test_equal_values_are_one_value_and_what_was_not_run_is_nobodys() -> None:
    model = view(*THREE)
    understanding = Understanding("What is the depth of the hole?", model, Expectation())
    tried = understanding.tried(Counted(*[0.01] * 9), every=True)
    (alone,) = ranked(tried).values
    assert 0.5 < alone.share < 1.0  # the rest: that none is right
    (less,) = ranked(tried, [tried[0].score] * 3).values
    assert less.share < alone.share
    assert key([0.01, 0.0100000001]) == key(0.01)


def test_confidence_grows_with_the_share() -> None:
    low, high = (calibrated(share, {}, 1.0, {"bias": 0.0, "share": 1.0}) for share in (0.2, 0.9))
    assert [low, high] == [pytest.approx(0.2), pytest.approx(0.9)]


def test_a_plain_question_is_sure_after_few_runs() -> None:
    run = Counted(3)
    record = ask("How many holes are there?", run, view(*THREE))
    assert record.status is Status.ANSWERED
    assert record.confidence is not None
    assert record.confidence > 0.5
    assert record.understood_as == "number of the holes"
    assert len(run.programs) <= 3


def test_below_the_threshold_the_readings_are_shown_and_the_best_one_stays_the_answer() -> None:
    record = ask("What is the depth of the hole?", Counted(), view(*THREE), least_confidence=1.0)
    assert record.status is Status.UNSURE
    assert record.answer is not None
    assert record.failure is None
    assert record.answer.text.startswith("perhaps ")
    assert record.alternatives
    assert all(other.understood_as and other.confidence is not None for other in record.alternatives)
    assert record.alternatives[0].answer.text in record.answer.text
    sure = ask("What is the depth of the hole?", Counted(), view(*THREE), least_confidence=0.0)
    assert (sure.status, sure.answer and sure.answer.value) == (Status.ANSWERED, record.answer.value)


def test_words_that_carry_meaning_are_never_skipped_without_a_word() -> None:
    blue = ask("What is the depth of the blue hole?", Counted(), view(*THREE), least_confidence=0.0)
    assert "blue" in " ".join((*blue.ignored, *blue.warnings, blue.failure.message if blue.failure else ""))
    record = ask("What is the depth of the holes and the mantle?", Counted(), view(*THREE), least_confidence=0.0)
    assert record.ignored
    assert any("not checked" in said or "not taken into account" in said for said in record.warnings)
    plain = ask("Please, what is the depth of the largest hole? Thanks", Counted(0.004), view(*THREE))
    assert plain.ignored == ()


@pytest.mark.parametrize(
    ("question", "says"),
    [
        ("What is the depth of the keyway?", "the model has no 'keyway'"),
        ("How many zorbs are there?", "zorb"),
        ("What does it cost?", "price"),
        ("What material is it made of?", "material"),
        ("How heavy is it?", "density"),
        ("What is its mass in cheese?", "stainless steel, steel, titanium"),
        ("What is its mass at -5 kg/m3?", "density"),
        ("What does the plate weigh?", "density"),
        ("Which tolerance has the hole?", "tolerance"),
        ("What coating does it have?", "surface finish"),
        ("Can it be injection moulded?", "how the part is to be made"),
        ("Which CAD system was used?", "with what"),
        ("Who designed this part?", "designed"),
        ("Height and weight of the plate?", "density"),
        ("How much is the plate?", "price"),
        ("What runout does the hole have?", "tolerance"),
    ],
)
def test_what_the_model_or_any_file_lacks_is_refused_in_one_sentence(question: str, says: str) -> None:
    made = inventory(*THREE)

    def run(program: Program) -> RunOutcome:
        found = find(made, "zorb")
        return RunOutcome(status=RunStatus.RAISED, message="not grounded", groundings=(found,))

    record = ask(question, run, view(*THREE))
    assert record.status is Status.NOT_GROUNDED
    assert record.answer is None
    assert record.failure is not None
    assert says in record.failure.message
    assert "\n" not in record.failure.message


def test_a_missing_part_comes_with_the_kinds_that_there_are_and_no_words_spelt_alike() -> None:
    record = ask(
        "What is the depth of the keyway?", Counted(), view(*THREE, part("boss-1", height=0.003, tags=("cylindrical",)))
    )
    assert record.failure is not None
    assert set(record.failure.nearest) == {"hole", "boss", "body"}


@pytest.mark.parametrize("question", ["qwertz uiop", "The weather is nice.", "???"])
def test_where_nothing_is_asked_nothing_is_run(question: str) -> None:
    run = Counted()
    record = ask(question, run, view(*THREE))
    assert record.failure is not None
    assert record.failure.category == "not_understood"
    assert run.programs == []


def test_a_stated_density_makes_a_mass() -> None:
    record = ask("What does it weigh in steel at 7.85 g/cm3?", Counted(0.5), view(*THREE))
    assert record.status is Status.ANSWERED
    assert record.code is not None
    assert "7850" in record.code


def test_the_programs_run_in_the_sandbox_on_the_same_query() -> None:
    """What candidates say of a model is what their programs find there."""
    made = inventory(*THREE, body(9, "zorb", (0.2, 0.0, 0.0), faces=(60,)), whole(), body(1, "plate", faces=(1, 2, 3)))
    model = view(*made.parts)

    class Made:
        def find_parts(self, description: Any, sides: Any = None) -> Any:
            return find(made, description, sides)

    with Sandbox(workers=1) as sandbox:
        for question, value in (
            ("How many holes are there?", 3),
            ("What is the depth of the largest hole?", 0.004),
            ("Is there a slot?", False),
            ("How many slots are there?", 0),
        ):
            record = ask(question, lambda program: sandbox.run(program.code, Made(), expects=program.expects), model)  # type: ignore[arg-type]
            assert record.status in (Status.ANSWERED, Status.UNSURE)  # few were asked whether there is one
            assert record.answer is not None
            assert record.answer.value == value


def test_one_place_is_one_value_and_two_are_two() -> None:
    tips = ((0.0, 0.0, 0.1), (0.0, 0.0, -0.1))
    model = view(part("boss-1", tags=("shaft",), tip=tips[0], tips=tips))
    asked = candidates(read("Where is the tip of the boss?"), model.ground, model.whole, Affinity((), model.whole))[0]
    assert asked.written.expects is AnswerType.POINTS
    ends = [[0.0, 0.0, 0.1], [0.0, 0.0, -0.1]]
    assert "values_several_for_one" not in with_value(asked, ends[0], model.whole.extents).features
    assert with_value(asked, ends, model.whole.extents).features["values_several_for_one"] == 1.0


@pytest.mark.parametrize(("value", "square"), [(math.pi / 2, True), (0.4, False), ([math.pi / 2] * 2, True)])
def test_nobody_asks_how_far_what_stands_upright_leans(value: float | list[float], square: bool) -> None:
    model = view(part("wall-1", tags=("upright",), inclination=math.pi / 2))
    asked = candidates(
        read("What is the inclination of the wall?"), model.ground, model.whole, Affinity((), model.whole)
    )[0]
    assert ("value_square" in with_value(asked, value, model.whole.extents).features) is square


def test_an_angle_of_its_own_may_well_be_a_right_one() -> None:
    model = view(part("countersink-1", angle=math.pi / 2))
    asked = candidates(
        read("What is the angle of the countersink?"), model.ground, model.whole, Affinity((), model.whole)
    )[0]
    assert "value_square" not in with_value(asked, math.pi / 2, model.whole.extents).features


@pytest.mark.parametrize(("other", "same"), [("bore", 1.0), ("slot", 0.0)])
def test_two_names_in_one_question_are_seldom_one_part(other: str, same: float) -> None:
    model = view(hole(1, faces=(1,)), part("slot-1", (0.03, 0.0, 0.0), width=0.004))
    asked = candidates(
        read(f"How far is the hole from the {other}?"), model.ground, model.whole, Affinity((), model.whole)
    )[0]
    assert asked.features["same_parts"] == same


def test_two_that_are_alike_are_hardly_meant_where_one_is_asked_for() -> None:
    model = view(*(part(f"boss-{i}", (0.02 * i, 0.0, 0.0), width=0.01 * i, sides=()) for i in (1, 2)))
    question = read("Which is wider, the left boss or the right boss?")
    found = candidates(question, model.ground, model.whole, Affinity((), model.whole))
    which = next(one for one in found if isinstance(one.reading.form, Which))
    assert "value_alike" in with_value(which, "left boss and right boss alike", model.whole.extents).features
    assert "value_alike" not in with_value(which, "left boss", model.whole.extents).features


@pytest.mark.parametrize(
    ("question", "at_most"), [("How many bores are in the long side?", NOT_SURE), ("How many bores are there?", 1.0)]
)
def test_a_number_that_passes_over_a_measure_is_not_sure(question: str, at_most: float) -> None:
    model, reader = view(*THREE), Reader(question)
    best = candidates(reader.readings, model.ground, model.whole, Affinity((), model.whole))[0]
    assert most(best, reader.text) == at_most


@pytest.mark.parametrize(
    "question",
    [
        "Net volume for the weight estimation?",
        "What is the height of the outer weights?",
        "How much is the hole sunk below the face?",
        "Does the hole run out through the end?",
    ],
)
def test_a_word_for_what_no_file_holds_may_name_something_else(question: str) -> None:
    assert Understanding(question, view(*THREE), Expectation()).refused is None
