"""The lexicon: which words mean which recognised parts. The words are data, in `lexicon.toml`."""

from __future__ import annotations

import tomllib
from dataclasses import dataclass
from functools import cache
from importlib.resources import files
from typing import Any

_FILLER_TEXT = """
a an the and or its their this that these those all any each every both some which are is has have there
one two three four five six seven eight nine ten shaped surface side sides
"""
FILLERS = frozenset(_FILLER_TEXT.split())
"""Words that carry no part of the meaning inside a part phrase."""
_PREPOSITION_TEXT = "in of on at for to from by inside within into onto with without"
PREPOSITIONS = frozenset(_PREPOSITION_TEXT.split())
"""Words that end a noun phrase; what follows is a trait of it, or where it is."""


@dataclass(frozen=True, slots=True)
class Choice:
    """One reading of a term: the demands on a part, and how sure the reading is."""

    kind: tuple[str, ...]
    tags: tuple[str, ...] = ()
    any: tuple[str, ...] = ()
    without: tuple[str, ...] = ()
    name: tuple[str, ...] = ()
    pick: str | None = None
    confidence: float = 1.0


@dataclass(frozen=True, slots=True)
class Term:
    """A noun: its canonical name and its readings, the strictest first."""

    name: str
    choices: tuple[Choice, ...]


@dataclass(frozen=True, slots=True)
class Adjective:
    """A demand on tags: one of `tags` makes it true; none at all means that the word adds nothing."""

    name: str
    tags: tuple[str, ...]
    unchecked: bool = False
    """It says something that recognition does not know; the user is told."""


@dataclass(frozen=True, slots=True)
class Lexicon:
    """All words, by phrase of lower-case singular words."""

    terms: dict[str, Term]
    adjectives: dict[str, Adjective]
    with_nouns: dict[str, Adjective]
    metric_m: dict[str, tuple[float, ...]]
    """Thread name to (core diameter, clearance diameters …) in metres."""
    hues: dict[str, tuple[float, float]]

    @property
    def words(self) -> frozenset[str]:
        """Every single word that occurs in some phrase."""
        phrases = (*self.terms, *self.adjectives, *self.with_nouns)
        return frozenset(word for phrase in phrases for word in phrase.split())


def _choice(line: dict[str, Any]) -> Choice:
    fields: dict[str, Any] = {k: tuple(v) if isinstance(v, list) else v for k, v in line.items()}
    return Choice(**fields)


@cache
def lexicon() -> Lexicon:
    """The product's lexicon, read once a process."""
    data = tomllib.loads(files(__package__).joinpath("lexicon.toml").read_text(encoding="utf-8"))
    terms: dict[str, Term] = {}
    for entry in data["term"]:
        choices = tuple(_choice(line) for line in entry["choose"])
        for phrase in entry["words"]:
            terms[phrase] = Term(entry["words"][0], choices)
    adjectives: dict[str, Adjective] = {}
    with_nouns: dict[str, Adjective] = {}
    for entry in data["adjective"]:
        adjective = Adjective(entry["words"][0], tuple(entry["tags"]), entry.get("unchecked", False))
        adjectives.update(dict.fromkeys(entry["words"], adjective))
        with_nouns.update(dict.fromkeys(entry.get("nouns", ()), adjective))
    metric = {name.lower(): tuple(d * 1e-3 for d in diameters) for name, diameters in data["metric"].items()}
    hues = {name: (float(low), float(high)) for name, (low, high) in data["colour"].items()}
    return Lexicon(terms, adjectives, with_nouns, metric, hues)


def words_of(text: str) -> list[str]:
    """Which lower-case words does a text hold? Hyphens part words; a number keeps its decimal point."""
    cleaned = "".join(c if c.isalnum() or c in ".#" else " " for c in text.lower())
    return [word for word in (w.strip(".") for w in cleaned.split()) if word]


def singular(word: str, known: frozenset[str]) -> str:
    """Which known singular does the word stand for? The word itself when no singular form of it is known."""
    if word in known:
        return word
    forms = [word[:-1]] if word.endswith("s") else []
    forms += [word[:-2]] if word.endswith("es") else []
    forms += [word[:-3] + "y"] if word.endswith("ies") else []
    forms += [word[:-3] + "f", word[:-3] + "fe"] if word.endswith("ves") else []
    return next((form for form in forms if form in known), word)
