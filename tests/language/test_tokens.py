"""Words are folded, numbers carry SI values and what they are of, and no text takes long."""

from __future__ import annotations

import math
import time

import pytest

from querycad_contracts import Measure
from querycad_language.readings import read
from querycad_language.tokens import DENSITY, MAX_TOKENS, Kind, tokenize


@pytest.mark.parametrize(
    ("text", "value", "power"),
    [
        ("12 mm", 0.012, 1),
        ("1,5 mm", 0.0015, 1),
        ("1,250 mm", 1.25, 1),
        ('3/8"', 0.009525, 1),
        ("1-1/2 in", 0.0381, 1),
        ("90 deg", math.pi / 2, 0),
        ("45°", math.pi / 4, 0),
        ("7.85 g/cm3", 7850.0, DENSITY),
        ("2700 kg/m3", 2700.0, DENSITY),
    ],
)
def test_a_number_with_its_unit_is_one_quantity_in_si(text: str, value: float, power: int) -> None:
    (token,) = tokenize(text)
    assert (token.kind, token.power) == (Kind.QUANTITY, power)
    assert token.value == pytest.approx(value)


@pytest.mark.parametrize(
    ("text", "measure"), [("Ø8", Measure.DIAMETER), ("⌀ 8 mm", Measure.DIAMETER), ("R8", Measure.RADIUS)]
)
def test_a_symbol_says_what_its_number_is_of(text: str, measure: Measure) -> None:
    (token,) = tokenize(text)
    assert (token.kind, token.measure) == (Kind.QUANTITY, measure)
    assert token.value == pytest.approx(0.008)


def test_a_range_shares_its_unit() -> None:
    first, _, second = tokenize("5 to 8 mm")
    assert [first.value, second.value] == [pytest.approx(0.005), pytest.approx(0.008)]


@pytest.mark.parametrize(
    ("text", "kind", "word"),
    [
        ("M6x1", Kind.THREAD, "m6x1"),
        ("M5x16", Kind.THREAD, "m5x16"),
        ("1/4-20", Kind.THREAD, "1/4-20"),
        ("4x", Kind.TIMES, "x"),
    ]
    + [
        (text, Kind.THREAD, word)
        for text, word in (
            ("#10-32", "10-32"),
            ('1/4"-20', "1/4-20"),
            ("0-80", "0-80"),
            ("G 1/4", "g1/4"),
            ("G1 1/4", "g1-1/4"),
            ("1/4-18 NPT", "1/4npt"),
            ("1 1/4 NPT", "1-1/4npt"),
        )
    ],
)
def test_threads_and_how_many_are_tokens_of_their_own(text: str, kind: Kind, word: str) -> None:
    (token,) = tokenize(text)
    assert (token.kind, token.word) == (kind, word)


@pytest.mark.parametrize("text", ["10-28 mm", "3-48 mm", "G12345", "the 1-2 slots"])
def test_ranges_and_numbers_of_articles_are_no_threads(text: str) -> None:
    assert all(token.kind is not Kind.THREAD for token in tokenize(text))


def test_words_are_folded_to_one_form() -> None:
    words = [(token.word, token.plural) for token in tokenize("Holes' centres, grey BUSHES")]
    assert ("hole", True) in words
    assert ("center", True) in words
    assert ("gray", False) in words


@pytest.mark.parametrize(
    ("text", "words"),
    [
        ("c/line to u/side", ["centerline", "to", "underside"]),
        ("C'bored thro'", ["counterbored", "through"]),
        ("o/a height", ["overall", "height"]),
        ("across the boss's flats", ["across", "flat", "of", "the", "boss"]),
        ("Ø x dp", ["diameter", "x", "depth"]),
        ("Vol. in mm³", ["volume", "in", "mm3"]),
    ],
)
def test_drawing_offices_shorten_words(text: str, words: list[str]) -> None:
    assert " ".join(token.word for token in tokenize(text)) == " ".join(words)


def test_a_slip_is_corrected_and_a_name_of_the_file_is_none() -> None:
    assert [token.word for token in tokenize("countrbore")] == ["counterbore"]
    assert [token.word for token in tokenize("countrbore", frozenset(("countrbore",)))] == ["countrbore"]


@pytest.mark.parametrize(
    "piece",
    [
        " ",
        "a ",
        "(",
        "the hole ",
        "x",
        "5 ",
        "1/2-",
        "0,",
        "M1",
        "of the hole in the plate on the ",
        "how deep and ",
        "'",
        "1 ",
        "Ø",
    ],
)
def test_no_text_of_any_length_takes_long(piece: str) -> None:
    text = (piece * 2000)[:2000]
    read("How deep is it?")  # the lexicon is read once
    start = time.perf_counter()
    read(text)
    assert time.perf_counter() - start < 1.0
    assert len(tokenize(text)) <= MAX_TOKENS


def test_leading_spaces_say_nothing() -> None:
    assert tokenize(" " * 480 + "hole") == tokenize("hole")
    assert read(" " * 480) == []


@pytest.mark.parametrize("word", ["closer", "counted", "difference", "caliper", "casting"])
def test_an_english_word_is_no_slip_of_another(word: str) -> None:
    assert [token.word for token in tokenize(word)] == [word]


def test_a_closed_compound_is_parted_into_nouns_of_parts_and_no_word_ends_in_a_thing() -> None:
    assert [token.word for token in tokenize("earthing screwhole")] == ["earthing", "screw", "hole"]


@pytest.mark.parametrize(
    ("text", "density"),
    [
        ("7.85 kg per cubic decimetre", 7850.0),
        ("2.7 kg/l", 2700.0),
        ("1.2 grams per cubic centimetre", 1200.0),
        ("7,85 g/cm³", 7850.0),
        ("7200 kg per cubic metre", 7200.0),
    ],
)
def test_a_density_is_one_quantity_however_its_units_are_written(text: str, density: float) -> None:
    (token,) = tokenize(text)
    assert [token.value, token.power] == [pytest.approx(density), DENSITY]
