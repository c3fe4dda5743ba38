"""Questions as an attack: the work of reading any text is bounded, whatever it repeats."""

from __future__ import annotations

import math
import os
import random
import sys
import time
from collections.abc import Callable, Sequence
from dataclasses import replace

import pytest
from tests.api.fakes import BOX
from tests.made import hole, view

from querycad_answering.answering import answer_question
from querycad_answering.drawing.asked_units import asked_unit
from querycad_contracts import AnswerOptions, AnswerRecord, ModelSummary, RunOutcome, RunStatus
from querycad_language.lexicon import lexicon
from querycad_language.phrases import noun_phrase
from querycad_language.readings import Reader
from querycad_language.tokens import MAX_CHARS

WHOLE = os.environ.get("QUERYCAD_ATTACK") == "whole"
MAX_ANSWER_CALLS = 800_000
"""Of all that is done with a question but run its programs, and with one before it."""
MAX_CALLS = 400_000
"""Function calls in reading one text, some 40 ms. 'hole depth' said 200 times took 26 million."""
REPEATED = (
    " ",
    "\t",
    "\n",
    "\u00a0",
    "of the ",
    "of the hole ",
    "hole depth ",
    "depth hole ",
    "that where ",
    "largest ",
    "same ",
    "ratio of diameter to depth ",
    "depth and width of the holes and slots ",
    "each hole's depth and ",
    "without ",
    "without not counting clear width between count of ignoring ",
    "hole under the slot thickness ",
    "how many ",
    "thickness of the wall between the holes and the slot ",
    "distance from the edge of the hole to the edge of the plate ",
    "how far does the flange stick out beyond the boss ",
    "1 ",
    "1",
    "1-1 ",
    "1/1 ",
    ",111",
    "-",
    "a-b ",
    "a-",
    "(",
    "(hole) ",
    '"',
    '"hole" ',
    "'",
    "hole's ",
    "5 mm ",
    "5 mm x ",
    "mm ",
    "1 kg/m3 ",
    "M5x0.8 ",
    "Ø5 ",
    "⌴",
    "R5 ",
    "l x ",
    "o.d. ",
    "a",
    "é",
    "\u0301\u0316",
    "漢",
    "\u200d",
    "\x00",
    "\ufffd",
    ". ",
    ",",
    "hole? ",
    "hole; depth; ",
    "1a",
    "n't ",
    "w/",
)


def grown(piece: str, size: int = MAX_CHARS) -> str:
    return (piece * (size // len(piece) + 1))[:size]


def read(text: str) -> None:
    _ = Reader(text).readings
    noun_phrase(text)
    asked_unit(text)


def answer(text: str, context: Sequence[str] = ()) -> AnswerRecord:
    """What is said of the text, on a plate with two holes, where every program finds nothing."""
    known = (hole(1), hole(4, 10))
    summary = ModelSummary(shape=BOX, body_count=1, part_counts={}, warnings=(), timings_ms={})
    plate = replace(view(*known), contents=lambda: (summary, known))
    nothing = RunOutcome(status=RunStatus.OK, value=0)
    return answer_question(text, lambda _: nothing, plate, options=AnswerOptions(context=tuple(context)))


def calls(work: Callable[[], object]) -> int:
    """How many functions are called? Steps can be counted on a machine that is busy; seconds cannot."""
    count = 0

    def note(_frame: object, event: str, _argument: object) -> None:
        nonlocal count
        count += event in ("call", "c_call")

    sys.setprofile(note)
    try:
        work()
    finally:
        sys.setprofile(None)
    return count


@pytest.fixture(scope="module", autouse=True)
def _warm() -> None:
    read("How many holes are there?")


@pytest.mark.parametrize("piece", REPEATED, ids=ascii)
def test_what_is_repeated_is_read_in_bounded_steps(piece: str) -> None:
    for text in (grown(piece), "1" + grown(piece), f"How deep are the {grown(piece, 1900)} holes?"):
        assert calls(lambda text=text: read(text)) < MAX_CALLS  # type: ignore[misc]


@pytest.mark.parametrize("seed", range(60))
def test_words_of_the_lexicon_at_random_are_read_in_bounded_steps(seed: int) -> None:
    rng = random.Random(seed)
    phrases = [*lexicon().phrases, *lexicon().nouns, ",", "(", ")", "?", ".", "5 mm", "4", "M5", "'s", "of the", "and"]
    few = rng.sample(phrases, rng.choice((1, 2, 3, 5, 50)))
    text = " ".join(rng.choices(few, k=1000))[:MAX_CHARS]
    assert calls(lambda: read(text)) < MAX_CALLS


MIXED = 300 if WHOLE else 30
"""With what is repeated, and the lexicon's words at random, more than 500 texts."""


@pytest.mark.parametrize("seed", range(MIXED))
def test_what_is_repeated_in_turns_is_read_in_bounded_steps(seed: int) -> None:
    rng = random.Random(seed)
    few = rng.sample(REPEATED, rng.choice((2, 2, 3, 5)))
    text = rng.choice(("", "How many ", "What is the ")) + "".join(rng.choices(few, k=2000))
    assert calls(lambda: read(text[:MAX_CHARS])) < MAX_CALLS


LEANING = (
    "hole 4, ", "mark 1 ", "hole-1+", "⟦1⟧ ", "⟦1⟧, and ", "also , ", "and\t", "it ", "its ", "this hole ",
    "the same in mm ", "only ", "only the ", "the first one ", "1 ", "1, ", "a_", "holes 1 to 9 ", "hole-1 ", "face 3 ",
    "how many of them ",
)  # fmt: skip


@pytest.mark.parametrize("piece", [*REPEATED, *LEANING], ids=ascii)
def test_what_a_question_leans_on_is_found_in_bounded_steps(piece: str) -> None:
    """Ids, what 'it' is, and the questions before are looked for in the text itself."""
    assert calls(lambda: answer(f"How deep is hole 4{grown(piece, 1900)}?")) < MAX_ANSWER_CALLS
    assert calls(lambda: answer(grown(piece), ("How deep are the holes?", grown(piece)))) < MAX_ANSWER_CALLS


@pytest.mark.parametrize("blanks", [480, 1_900])
def test_blanks_are_folded_before_all_else(blanks: int) -> None:
    """480 of them once took 15 s."""
    said = f"How deep is hole 4{' ' * blanks}?"
    found = calls(lambda: answer(said, (said,)))
    assert found < calls(lambda: answer("How deep is hole 4 ?", ("How deep is hole 4 ?",))) + 1000


@pytest.mark.parametrize("piece", ["hole 4 ", "a ", "hole-1+", " "])
def test_a_text_that_is_too_long_is_refused_before_it_is_read(piece: str) -> None:
    """105,000 characters of 'hole 4' on the command line took minutes."""
    text = grown(piece, 1_000_000)
    assert calls(lambda: answer(text)) < 1000
    record = answer(text)
    assert record.failure is not None
    assert record.failure.message == "the question has more than 2,000 characters"
    assert len(record.question) <= MAX_CHARS


@pytest.mark.parametrize("letters", [5, 8, 9, 12, 2000])
def test_unknown_words_are_read_in_bounded_steps(letters: int) -> None:
    rng = random.Random(letters)
    text = " ".join("".join(rng.choices("abcdefghijklmnopqrstuvwxyz", k=letters)) for _ in range(200))
    assert calls(lambda: read(text)) < MAX_CALLS


def test_patterns_take_time_in_proportion_to_the_text() -> None:
    """Regular expressions run in C, where no calls are counted: twice the text takes twice the time or so."""

    def seconds(text: str) -> float:
        times = []
        for _ in range(7):
            start = time.thread_time()
            for _ in range(3):
                read(text)
            times.append(time.thread_time() - start)
        return min(times)

    slow = [
        piece
        for piece in (" ", "\t", "\u00a0", "a", "1", "1-", "lxl", "l x ", "1 a", "o.", ",111", "-", "'", "é", "w/")
        if seconds(grown(piece, 2000)) > 5 * seconds(grown(piece, 1000)) + 0.005
    ]
    assert not slow


def test_a_number_of_any_length_is_read() -> None:
    """One of 1,500 digits in groups was infinite, and stopped the reader."""
    tokens = Reader("How many 1" + ",111" * 480 + " mm holes?").text.tokens
    assert all(math.isfinite(token.value) for token in tokens)
