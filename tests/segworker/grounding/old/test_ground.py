"""From words to parts: synonyms, spelling, traits, colours, names, sizes; and what is not known is said."""

from __future__ import annotations

from typing import Any

import pytest
from hypothesis import example, given, settings
from hypothesis import strategies as st

from querycad_contracts import Evidence, Grounding, Part, Side
from querycad_segworker.grounding.old.ground import ground
from querycad_segworker.grounding.old.lexicon import PREPOSITIONS, lexicon, singular, words_of


def part(letter: str, kind: str, tags: str = "", **measures: Any) -> Part:
    """A part whose id is a letter; sizes in metres."""
    fields = {"label": letter, "faces": (0,), "center": (0.0, 0.0, 0.0), "extents": (0.01, 0.01, 0.01)}
    evidence = Evidence(source="geometry", confidence=1.0, reason="built by hand")
    return Part(id=letter, kind=kind, tags=tuple(tags.split()), evidence=evidence, **{**fields, **measures})


PARTS = [
    part("a", "hole", "through circular", diameter=5.5e-3, radius=2.75e-3, sides=(Side.TOP, Side.BOTTOM)),
    part("b", "hole", "blind circular", diameter=4.2e-3, radius=2.1e-3, sides=(Side.TOP,)),
    part("c", "hole", "through circular counterbored stepped", diameter=9e-3, radius=4.5e-3, sides=(Side.FRONT,)),
    part("d", "hole", "through circular countersunk beveled", diameter=3.4e-3, radius=1.7e-3, sides=(Side.BOTTOM,)),
    part("e", "boss", "cylindrical circular", radius=8e-3, sides=(Side.TOP,)),
    part("f", "boss", "cylindrical circular hollow", radius=6e-3, sides=(Side.TOP,)),
    part("g", "boss", "cylindrical circular slender", radius=5e-3, sides=(Side.LEFT,)),
    part("h", "cylinder", "inner circular cylindrical", radius=2.75e-3),
    part("i", "cylinder", "outer circular cylindrical", radius=8e-3),
    part("j", "body", "solid", name="Base_Plate", color="#0000ff", sides=(Side.TOP,)),
    part("k", "body", "solid", name="ISO 4762 M5x20", color="#c0c0c0", sides=(Side.TOP,)),
    part("l", "body", "solid", name="Dowel pin", color="#ff0000", sides=(Side.BOTTOM,)),
]


def names(description: str, *sides: Side) -> str:
    found = ground(PARTS, description, sides or None)
    assert found.understood, found.message
    return "".join(p.id for p in found.parts)


def refused(description: str) -> Grounding:
    found = ground(PARTS, description, None)
    assert not found.understood
    assert found.parts == ()
    return found


@pytest.mark.parametrize("word", ["hole", "holes", "Hole", "the holes", "bore", "bores", "drill hole", "bore-holes"])
def test_synonyms_and_plurals_of_a_hole(word: str) -> None:
    assert names(word) == "abcd"


@pytest.mark.parametrize(
    ("description", "expected"),
    [
        ("through hole", "acd"),
        ("thru holes", "acd"),
        ("blind hole", "b"),
        ("counterbored hole", "c"),
        ("counterbore", "c"),
        ("countersunk holes", "d"),
        ("hole with a bevel", "d"),
        ("hole with ring", "c"),
        ("hole without a bevel", "abc"),
        ("through hole without countersink", "ac"),
        ("standoff", "f"),
        ("shaft", "g"),
        ("inner cylinder", "h"),
        ("outer cylinder", "i"),
        ("individual holes", "abcd"),
    ],
)
def test_traits_choose_among_the_parts(description: str, expected: str) -> None:
    assert names(description) == expected


@pytest.mark.parametrize("word", ["hoel", "holle", "hloe", "holess"])
def test_a_slip_of_the_keyboard_is_forgiven_and_said(word: str) -> None:
    found = ground(PARTS, word, None)
    assert "".join(p.id for p in found.parts) == "abcd"
    assert any("hole" in warning for warning in found.warnings)
    assert all(p.evidence.confidence < 1.0 for p in found.parts)


@pytest.mark.parametrize("word", ["vole", "mole", "whale"])
def test_another_word_is_no_slip_of_the_keyboard(word: str) -> None:
    refused(word)


@pytest.mark.parametrize(("description", "expected"), [("M5 hole", "ab"), ("M8 holes", "c"), ("M3 through hole", "d")])
def test_the_name_of_a_thread_chooses_core_and_clearance_holes(description: str, expected: str) -> None:
    assert names(description) == expected


@pytest.mark.parametrize(
    ("description", "expected"),
    [("blue body", "j"), ("red solid", "l"), ("grey solid", "k"), ("gray body", "k")],
)
def test_colours_choose_bodies(description: str, expected: str) -> None:
    assert names(description) == expected


@pytest.mark.parametrize(
    ("description", "expected"),
    [
        ("base plate", "j"),
        ("dowel pin", "l"),
        ("Dowel Pins", "l"),
        ("screw", "k"),
        ("ISO 4762 screw", "k"),
        ("bodies", "jkl"),
    ],
)
def test_product_names_choose_bodies(description: str, expected: str) -> None:
    assert names(description) == expected


def test_sides_choose_what_is_visible_from_there() -> None:
    assert names("hole", Side.TOP) == "ab"
    assert names("hole", Side.TOP, Side.FRONT) == "abc"
    assert names("through hole", Side.BOTTOM) == "ad"


def test_a_part_that_is_not_visible_from_there_is_said_to_be_elsewhere() -> None:
    found = ground(PARTS, "counterbored hole", [Side.TOP])
    assert found.understood
    assert found.parts == ()
    assert found.message is not None
    assert "none visible from top" in found.message


def test_a_known_part_that_the_model_has_not_is_no_unknown_word() -> None:
    found = ground(PARTS, "keyway", None)
    assert found.understood
    assert found.parts == ()
    assert found.nearest[0] == "hole"


@pytest.mark.parametrize("word", ["banana", "flux capacitor", "xyzzy", "", "   ", "the", "?!"])
def test_an_unknown_word_is_refused_with_what_the_model_has(word: str) -> None:
    assert {"hole", "boss", "body"} <= set(refused(word).nearest)


def test_an_unknown_word_is_answered_with_terms_that_are_spelt_alike() -> None:
    assert refused("boreal").nearest[0] == "bore"


def test_an_empty_model_has_nothing() -> None:
    assert ground([], "hole", None).parts == ()


@settings(max_examples=300, deadline=None)
@given(st.text(max_size=60) | st.lists(st.sampled_from(sorted(lexicon().words)), max_size=6).map(" ".join))
@example("with")
@example("hole with")
@example("without without")
@example("M5 M5 M5")
@example("of of of hole")
@example("hole in the hole in the hole")
def test_any_text_gets_an_answer(description: str) -> None:
    found = ground(PARTS, description, None)
    assert set(found.parts) <= set(PARTS) or all(p.evidence.confidence < 1.0 for p in found.parts)
    assert found.parts or found.message
    assert found.description == description


@given(st.sampled_from([phrase for phrase in lexicon().terms if phrase.split()[0] not in PREPOSITIONS]))
def test_every_term_of_the_lexicon_is_understood_in_singular_and_plural(phrase: str) -> None:
    assert ground(PARTS, phrase, None).understood
    assert ground(PARTS, f"{phrase}s", None).understood


@given(st.sampled_from(sorted(lexicon().terms)), st.sets(st.sampled_from(list(Side)), min_size=1))
def test_only_what_is_visible_from_a_side_is_found_there(phrase: str, sides: set[Side]) -> None:
    assert all(sides & set(found.sides) for found in ground(PARTS, phrase, sorted(sides)).parts)


@given(st.sampled_from(sorted(lexicon().words)))
def test_a_singular_stays_what_it_is(word: str) -> None:
    assert singular(word, lexicon().words) == word


def test_words_are_parted_by_hyphens_and_keep_decimal_points() -> None:
    assert words_of("Counter-bored M2.5 hole.") == ["counter", "bored", "m2.5", "hole"]


@pytest.mark.parametrize(
    ("plural", "expected"), [("holes", "hole"), ("bosses", "boss"), ("cavities", "cavity"), ("shelves", "shelf")]
)
def test_plurals_are_put_back(plural: str, expected: str) -> None:
    assert singular(plural, frozenset({"hole", "boss", "cavity", "shelf"})) == expected


def test_a_shape_that_a_named_body_has_speaks_for_its_name() -> None:
    """'Rectangular pin' is a known noun as well, which the block beside the pins would be, too."""
    others = [part("b", "body", "solid", name="Housing"), part("q", "prism", "rectangular")]
    pin = part("p", "body", "solid rectangular", name="Solder pin")
    assert [p.id for p in ground([pin, *others], "rectangular pin", None).parts] == ["p"]
    round_pin = part("p", "body", "solid cylindrical", name="Dowel pin")
    assert [p.id for p in ground([round_pin, *others], "rectangular pin", None).parts] == ["q"]
