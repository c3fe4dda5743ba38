"""Several questions in one are parted where no reading answers all, each with what it is asked of."""

from __future__ import annotations

from typing import Any

import pytest
from tests.made import hole, part, view

from querycad_answering.affinity import Affinity
from querycad_answering.candidates import candidates
from querycad_answering.compound import clauses, together
from querycad_answering.understanding import ModelView
from querycad_contracts import Answer, AnswerRecord, AnswerType, Failure, FailureCategory, Part, Program, Status, Unit
from querycad_language.readings.reader import Reader

MODEL = view(hole(1, faces=(1,)), part("slot-1", (0.03, 0.0, 0.0), width=0.004, length=0.01))


def parted(question: str, model: ModelView = MODEL) -> tuple[str, ...]:
    reader = Reader(question)
    return clauses(reader, candidates(reader.readings, model.ground, model.whole, Affinity((), model.whole))[0])


@pytest.mark.parametrize(
    ("question", "said"),
    [
        (
            "What is the depth of the hole and the width of the slot?",
            ("What is the depth of the hole?", "the width of the slot?"),
        ),
        ("Depth of the hole vs width of the slot?", ("Depth of the hole?", "width of the slot?")),
        ("How many lugs are there, and how thick are they?", ("How many lugs are there?", "how thick are they?")),
        ("Lug: thickness, how many?", ("Lug: thickness?", "Lug: how many?")),
        ("Lugs - quantity, width & spacing", ("Lugs: quantity?", "Lugs: width?", "Lugs: spacing?")),
        ("Bore, outer diameter of the collar?", ("diameter of Bore?", "outer diameter of the collar?")),
        ("Number and pitch of the lugs?", ("Number of the lugs?", "pitch of the lugs?")),
        ("Lug thickness plus the bore size", ("Lug thickness?", "the bore size?")),
        ("Lug width as well as its distance from the bore?", ("Lug width?", "its distance from the bore?")),
        ("Radius at the short lug, and at the long lug?", ("Radius at the short lug?", "Radius at the long lug?")),
        ("How many lugs in the ring, what pitch?", ("How many lugs in the ring?", "and what pitch?")),
        ("Slot width; total height?", ("Slot width?", "total height?")),
        ("Slot width and lug height? Smaller one first.", ("Slot width?", "lug height?")),
        ("How many lugs, and what width has the first rib?", ("How many lugs?", "what width has the first rib?")),
        ("Lugs: how many, how thick each", ("Lugs: how many?", "Lugs: how thick each of them?")),
        ("Spacing of the lugs along x and y?", ("Spacing of the lugs along x?", "Spacing of the lugs along y?")),
        ("Lug spacing in the y and z direction?", ("Lug spacing along y?", "Lug spacing along z?")),
        ("Lugs: pitch along x, pitch along y?", ("Lugs: pitch along x?", "Lugs: pitch along y?")),
        ("How thick are the lug and the rib?", ("How thick are the lug?", "How thick are the rib?")),
        ("What widths do the lug and the rib have?", ("What widths do the lug have?", "What widths do the rib have?")),
        (
            "Diameters of the lug and the pad of the rib?",
            ("Diameters of the lug of the rib?", "Diameters of the pad of the rib?"),
        ),
        (
            "Widths of the lug on the left and of the rib on the right?",
            ("Widths of the lug on the left?", "and Widths of the rib on the right?"),
        ),
        ("Heights of the left and the right lug?", ("Heights of the left lug?", "Heights of the right lug?")),
        ("Lug width, and projection from the rib?", ("Lug width?", "projection from the rib?")),
        ("Lug width? And how far is it from the bore", ("Lug width?", "how far is it from the bore?")),
        ("Lug: width, and height above the rib?", ("Lug: width?", "Lug: height above the rib?")),
        (
            "Diameter and pitch circle diameter of the lugs?",
            ("Diameter of the lugs?", "pitch circle diameter of the lugs?"),
        ),
        ("Bore, total length of this lug?", ("diameter of Bore?", "total length of the lug?")),
    ],
)
def test_what_is_asked_of_several_is_several_questions(question: str, said: tuple[str, ...]) -> None:
    assert parted(question) == said


@pytest.mark.parametrize(
    "question",
    [
        "What is the length and the width of the slot?",
        "How wide is the slot of the hole and the lug?",
        "What is the ratio of the length of the slot and the depth of the hole?",
        "What is the sum of the length of the slot and the depth of the hole?",
        "Is the length of the slot and the depth of the hole the same?",
        "What is the distance between the centre of the slot and the axis of the hole?",
        "Slot size, length by width?",
        "Slot length and width, longer side first",
        "Which is wider, the slot or the hole?",
        "How much room is there in the slot, i.e. how wide is it?",
        "How long is the slot (at its full width)?",
        "How far apart are the lugs, middle to middle?",
        "What is the angle, seen from above, between the lugs?",
        "How wide is the slot at its narrowest, between the lugs?",
        "How long is the slot, measured along its axis and from the outer edge?",
        "The cover has a lug, 4 mm high and of 3 mm width. How long is the slot?",
        "In which direction does the slot run, as a unit vector in model coordinates?",
        "How many lugs are there, all widths together?",
        "What width has the slot, a single number",
        "How many lugs in total, on both slots?",
        "How many lugs cross the slot, counting each full-width lug as one?",
        "What is the distance of the lug and the rib?",
        "What is the angle of the lug and the rib?",
        "Slot width - at the bottom?",
        "Where do the axes of the lug and the rib cross?",
        "How thick is the slot that the lugs and the ribs stand on?",
    ],
)
def test_what_gives_one_answer_is_one_question(question: str) -> None:
    assert parted(question) == ()


def test_one_distance_is_not_two_spaces() -> None:
    """The slots with the slot give one distance that leaves no word out."""
    slots = view(*(part(f"slot-{i}", (0.03 * i, 0.0, 0.0), width=0.004, length=0.01) for i in range(3)))
    question = "Clear gap between slots and the slot pitch?"
    assert parted(question, slots) == ("Clear gap between slots?", "and the slot pitch?")


def test_longer_lists_are_tables() -> None:
    assert parted("Lug width, bore depth, rib height, slot length, pad thickness, groove radius?") == ()


def _counted(number: int, confidence: float, *parts: Part) -> AnswerRecord:
    answer = Answer(value=number, type=AnswerType.COUNT, unit=Unit.NONE, text=str(number))
    told = {"answer": answer, "code": f"solution = {number}", "codegen": "parser", "parts": parts}
    record = AnswerRecord.failed("How many?", Failure(category="not_grounded", message=""))
    return record.model_copy(update={**told, "status": Status.ANSWERED, "confidence": confidence, "failure": None})


def test_the_number_of_the_same_parts_asked_twice_is_one_and_of_others_two() -> None:
    first, second = hole(1), hole(2)
    once = together([_counted(1, 0.9, first), _counted(1, 0.6, first)], lambda _: None)
    assert once is not None
    assert once.answer is not None
    assert (once.answer.value, once.confidence) == (1, 0.6)
    joined: list[str] = []
    together([_counted(1, 0.9, first), _counted(1, 0.6, second)], lambda program: joined.append(program.code))
    assert len(joined) == 1


def answered(code: str, value: float | list[float]) -> AnswerRecord:
    kind = AnswerType.LENGTHS if isinstance(value, list) else AnswerType.LENGTH
    answer = Answer(value=value, type=kind, unit=Unit.METRE, text="")
    empty = AnswerRecord.failed("", Failure(category=FailureCategory.CANCELLED, message=""))
    return empty.model_copy(update={"status": Status.ANSWERED, "answer": answer, "code": code, "failure": None})


def judged(program: Program) -> Answer:
    """Runs a program without a model."""
    names: dict[str, Any] = {"parts": (2, 2), "different": lambda values, _: sorted(set(values))}
    exec(program.code, names)  # noqa: S102 - the code is this test's
    return Answer(value=names["solution"], type=AnswerType.LENGTHS, unit=Unit.METRE, text="")


@pytest.mark.parametrize(
    ("code", "value", "values"),
    [
        ("solution = [p for p in parts]", [2, 2], [2, 5]),  # the width of two like slots
        ("values = [(p, p) for p in parts]\nsolution = list(values[0])", [2, 2], [2, 2, 5]),  # width and depth of each
        ("value0 = 2\nvalue1 = 2\nsolution = [value0, value1]", [2, 2], [2, 2, 5]),  # two spacings
    ],
)
def test_like_parts_give_one_value_and_measures_that_are_alike_two(
    code: str, value: list[float], values: list[float]
) -> None:
    both = together((answered(code, value), answered("solution = 5", 5)), judged)
    assert both is not None
    assert both.answer is not None
    assert both.answer.value == values
