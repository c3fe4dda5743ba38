"""The lexicon: which words mean which recognised parts. The words are data, in `lexicon.toml`."""

from __future__ import annotations

import tomllib
from dataclasses import dataclass
from functools import cache
from importlib.resources import files
from typing import Any, Literal

_FILLER_TEXT = """
a an the and or its their this that these those all any each every both some which are is has have there it them they
very
"""
FILLERS = frozenset(_FILLER_TEXT.split())
"""Words that carry no part of the meaning inside a part phrase."""
_PREPOSITION_TEXT = """
in of on at for to from by inside within into onto with without around through near under between across
along
"""
PREPOSITIONS = frozenset(_PREPOSITION_TEXT.split())
"""Words that end a noun phrase; what follows is a trait of it, or where it is."""
_NUMBER_TEXT = "one two three four five six seven eight nine ten eleven twelve"
NUMBERS = {word: number for number, word in enumerate(_NUMBER_TEXT.split(), start=1)}
"""Number words; how many parts there are is a hint, and no part of the description."""

Order = Literal["size", "length", "width", "depth", "height", "thickness", "distance", "corner"]
"""What tells parts of one kind apart: a measure, the distance from the model's middle, or being in a corner."""
Pick = Literal["lowest", "largest", "smallest", "wide", "standing", "most", "elongated"]
Step = Literal["widest", "narrowest"]


@dataclass(frozen=True, slots=True)
class Choice:
    """One reading of a term: the demands on a part, and how sure the reading is."""

    kind: tuple[str, ...]
    tags: tuple[str, ...] = ()
    any: tuple[str, ...] = ()
    without: tuple[str, ...] = ()
    name: tuple[str, ...] = ()
    alone: bool = False
    """Only where the file holds a single body."""
    several: bool = False
    """Only where the file holds several bodies: a feature of the only body is never the body."""
    also: bool = False
    """As good a reading as the one before it, of which no part is visible from the sides asked for."""
    step: Step | None = None
    pick: Pick | None = None
    confidence: float = 1.0


@dataclass(frozen=True, slots=True)
class Term:
    """A noun: its canonical name and its readings, the strictest first."""

    name: str
    choices: tuple[Choice, ...]
    product: bool = False
    """It names a whole body or model, never a feature."""
    apart: bool = False
    """Said apart it means the same: 'the bore of the cylinder'."""


@dataclass(frozen=True, slots=True)
class Adjective:
    """A demand on parts: one of `tags` makes it true, else one of `fallback`, else the order; none: no demand."""

    name: str
    tags: tuple[str, ...]
    unchecked: bool = False
    """It says something that recognition does not know; the user is told."""
    order: Order | None = None
    most: bool = True
    lacks: tuple[str, ...] = ()
    whole: bool = False
    """It asks for all of what a name means: 'the complete cylinder'."""
    loose: bool = False
    """What has it often is not modelled with it: where no part has it, it is left out, at half the confidence."""
    fallback: tuple[str, ...] = ()
    """Looked at where no part has one of `tags`."""
    fallback_confidence: float = 1.0


@dataclass(frozen=True, slots=True)
class Lexicon:
    """All words, by phrase of lower-case singular words."""

    terms: dict[str, Term]
    adjectives: dict[str, Adjective]
    with_nouns: dict[str, Adjective]
    threads: dict[str, tuple[float, ...]]
    """Name of a thread to (core diameter, clearance diameters …) in metres."""
    cores: frozenset[float]
    """Core diameters in metres of the threads that are usual: those whose pitch need not be said."""
    hues: dict[str, tuple[float, float]]
    words: frozenset[str]
    """Every single word that occurs in some phrase, and words of the trade that name no part."""


def _choice(line: dict[str, Any]) -> Choice:
    fields: dict[str, Any] = {k: tuple(v) if isinstance(v, list) else v for k, v in line.items()}
    return Choice(**fields)


def _product(word: str) -> Term:
    """'bracket': the whole model where it is one body, else a body with the word in its name, else all of the model."""
    choices = (
        Choice(("model",), alone=True, confidence=0.9),
        Choice(("body",), name=(word,), confidence=0.7),
        Choice(("model",), confidence=0.6),
    )
    return Term(word, choices, product=True)


@cache
def lexicon() -> Lexicon:
    """The product's lexicon, read once a process."""
    data = tomllib.loads(files(__package__).joinpath("lexicon.toml").read_text(encoding="utf-8"))
    terms = {word: _product(word) for word in data["product"]["words"]}
    for entry in data["term"]:
        choices = tuple(_choice(line) for line in entry["choose"])
        for phrase in entry["words"]:
            terms[phrase] = Term(entry["words"][0], choices, entry.get("product", False), entry.get("apart", False))
    adjectives: dict[str, Adjective] = {}
    with_nouns: dict[str, Adjective] = {}
    for entry in data["adjective"]:
        adjective = Adjective(
            entry["words"][0],
            tuple(entry["tags"]),
            entry.get("unchecked", False),
            entry.get("order"),
            entry.get("most", True),
            tuple(entry.get("lacks", ())),
            entry.get("whole", False),
            entry.get("loose", False),
            tuple(entry.get("fallback", ())),
            entry.get("fallback_confidence", 1.0),
        )
        adjectives.update(dict.fromkeys(entry["words"], adjective))
        with_nouns.update(dict.fromkeys(entry.get("nouns", ()), adjective))
    threads = {
        name.lower(): tuple(d * 1e-3 for d in diameters)
        for table in ("metric", "metric_pitch", "unified")
        for name, diameters in data[table].items()
    }
    hues = {name: (float(low), float(high)) for name, (low, high) in data["colour"].items()}
    known = (*terms, *adjectives, *with_nouns, *data["other"]["words"])
    words = frozenset(word for phrase in known for word in phrase.split())
    cores = frozenset(threads[name.lower()][0] for table in ("metric", "unified") for name in data[table])
    return Lexicon(terms, adjectives, with_nouns, threads, cores, hues, words)


def words_of(text: str) -> list[str]:
    """Which lower-case words does a text hold? Hyphens part words but not the size of a thread ('1/4-20')."""
    cleaned = "".join(c if c.isalnum() or c in ".#/-" else " " for c in text.lower())
    words: list[str] = []
    for word in cleaned.split():
        digits = word.strip(".-/")
        is_size = bool(digits) and digits[0].isdigit() and digits[-1].isdigit() and not digits.isalpha()
        keep = is_size and all(c.isdigit() or c in "./-" for c in digits)
        words += [digits] if keep else [piece for w in word.replace("/", "-").split("-") if (piece := w.strip("."))]
    return words


def singular(word: str, known: frozenset[str]) -> str:
    """Which known singular does the word stand for? The word itself when no singular form of it is known."""
    if word in known:
        return word
    forms = [word[:-1]] if word.endswith("s") else []
    forms += [word[:-2]] if word.endswith("es") else []
    forms += [word[:-3] + "y"] if word.endswith("ies") else []
    forms += [word[:-3] + "f", word[:-3] + "fe"] if word.endswith("ves") else []
    return next((form for form in forms if form in known), word)
