"""500 odd questions over six models: no traceback, no name of ours, no answer of another class than asked."""

from __future__ import annotations

import re
from collections.abc import Iterator
from pathlib import Path

import pytest
from tests.house.odd_questions import Odd, Sort, odd_questions

from querycad.runtime import EmbeddedRuntime
from querycad_answering.answering import SURE
from querycad_contracts import AnswerRecord, AnswerType, PartKind, Status

EXAMPLES = Path(__file__).parents[2] / "examples"
MODELS = sorted(EXAMPLES.glob("*.step"))
COUNT = 500
OURS = re.compile(
    r"Traceback|\w+Error\b|\w+Exception\b|NoneType|has no attribute|object at 0x|<class|\bself\b|querycad_|__\w+__"
    r"|\bPartQuery\b|find_parts|\bnan\b|\bNone\b|\bTrue\b|\bFalse\b|\b(?!sheet_metal|gear_shaft|bearing_assembly)[a-z]+_[a-z]+",
)
"""What Python says, and names of our own modules, classes and fields."""
MOST_LETTERS = 400


@pytest.fixture(scope="module")
def records(tmp_path_factory: pytest.TempPathFactory) -> list[tuple[Odd, Path, AnswerRecord]]:
    asked = odd_questions(COUNT)
    with EmbeddedRuntime(tmp_path_factory.mktemp("models")) as runtime:
        found = []
        for number, odd in enumerate(asked):
            model = MODELS[(number + number // len(MODELS)) % len(MODELS)]
            found.append((odd, model, runtime.ask(model, odd.text)))
    return found


def of(records: list[tuple[Odd, Path, AnswerRecord]], *sorts: Sort) -> Iterator[tuple[str, AnswerRecord]]:
    return ((f"{model.stem}: {odd.text[:80]}", record) for odd, model, record in records if odd.sort in sorts)


def said(record: AnswerRecord) -> list[str]:
    """Everything that a person reads of an answer, but for words of the question itself."""
    texts = [record.failure.message] if record.failure else []
    texts += [record.answer.text] if record.answer else []
    texts += [record.understood_as, *record.warnings, *(other.understood_as for other in record.alternatives)]
    own = {word for word in re.findall(r"\w+", record.question) if word}
    return [re.sub(r"\w+", lambda word: "" if word[0] in own else word[0], text) for text in texts]


def test_all_sorts_are_asked_of_all_models(records: list[tuple[Odd, Path, AnswerRecord]]) -> None:
    assert len(records) == COUNT
    assert len(MODELS) == 6
    for sort in Sort:
        assert len({model for odd, model, _ in records if odd.sort is sort}) == 6, sort


def test_nothing_that_is_said_is_pythons_or_ours(records: list[tuple[Odd, Path, AnswerRecord]]) -> None:
    found = {
        f"{model.stem}: {odd.text[:80]}": text
        for odd, model, record in records
        if odd.sort is not Sort.RUBBISH
        for text in said(record)
        if OURS.search(text)
    }
    assert found == {}


def test_no_question_breaks_anything(records: list[tuple[Odd, Path, AnswerRecord]]) -> None:
    categories = {record.failure.category for _, _, record in records if record.failure is not None}
    assert categories <= {"not_grounded", "not_understood", "bad_input"}


def test_what_is_refused_is_refused_in_one_line(records: list[tuple[Odd, Path, AnswerRecord]]) -> None:
    messages = {record.failure.message for _, _, record in records if record.failure is not None}
    assert len(messages) > 50
    assert [text for text in messages if "\n" in text or not text] == []
    assert [
        text for text in messages if len(text) > MOST_LETTERS and "xxx" not in text and "hole hole" not in text
    ] == []


def test_what_no_step_file_holds_is_never_answered(records: list[tuple[Odd, Path, AnswerRecord]]) -> None:
    answered = {text: record.status for text, record in of(records, Sort.UNKNOWABLE)}
    assert set(answered.values()) == {Status.NOT_GROUNDED}, answered


def test_other_languages_jokes_and_sums_have_no_sure_answer(records: list[tuple[Odd, Path, AnswerRecord]]) -> None:
    """And one that is answered at all says which words it does not take into account."""
    answered = [
        (text, record.confidence, record.warnings)
        for text, record in of(records, Sort.FOREIGN, Sort.NONSENSE)
        if record.status is Status.ANSWERED
    ]
    assert len(answered) < 5
    assert [one for one in answered if (one[1] or 1.0) >= SURE or not one[2]] == []


def test_a_part_that_is_not_there_is_refused_or_its_noun_is_said_to_stand_for_the_whole(
    records: list[tuple[Odd, Path, AnswerRecord]],
) -> None:
    silent = [
        text
        for text, record in of(records, Sort.ABSENT)
        if record.status is Status.ANSWERED and not (record.warnings or "the whole model" in record.understood_as)
    ]
    assert silent == []


def test_an_id_that_is_not_there_is_always_refused(records: list[tuple[Odd, Path, AnswerRecord]]) -> None:
    named = [
        (text, record.status)
        for text, record in of(records, Sort.ABSENT)
        if re.search(rf"\b({'|'.join(PartKind)})[- ]h?\d{{3}}", text)
    ]
    assert len(named) > 20
    assert [text for text, status in named if status is not Status.NOT_GROUNDED] == []


def test_yes_or_no_is_answered_with_yes_or_no(records: list[tuple[Odd, Path, AnswerRecord]]) -> None:
    wrong = [
        (text, record.answer.text)
        for text, record in of(records, *Sort)
        if re.match(r"\S+: (?:is|are|does|has) ", text, re.IGNORECASE)
        and record.status is Status.ANSWERED
        and record.answer is not None
        and record.answer.type is not AnswerType.BOOLEAN
    ]
    assert wrong == []


def test_a_few_typing_errors_still_have_answers(records: list[tuple[Odd, Path, AnswerRecord]]) -> None:
    """Half of them at least: else the other claims would hold of a program that answers nothing."""
    statuses = [record.status for _, record in of(records, Sort.MISTYPED)]
    assert statuses.count(Status.ANSWERED) * 2 >= len(statuses)


def test_a_density_that_is_stated_gives_a_mass_with_its_unit(records: list[tuple[Odd, Path, AnswerRecord]]) -> None:
    weighed = [
        r.answer.text
        for text, r in of(records, Sort.HARD)
        if "g/cm3" in text and r.status is Status.ANSWERED and r.answer
    ]
    assert weighed
    assert all(re.fullmatch(r"[\d.]+ kg", text) for text in weighed), weighed
