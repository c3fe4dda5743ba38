"""The words of the grammar, read once from `lexicon.toml`: which wordings of a category start at a token?"""

from __future__ import annotations

import tomllib
from collections.abc import Sequence
from importlib import resources
from typing import Any

_SCALE_FORMS = ("positive", "more", "less", "most", "least")
_NOT_ENGLISH_GRAMMAR = frozenset({"units", "foreign", "never_corrected", "spelling", "mass_plural", "singular"})
_CORRECTED_TO = (
    "property",
    "extreme",
    "reduce",
    "place_extreme",
    "side",
    "unit",
    "distance",
    "whole",
    "often_misspelt",
)
_TABLES_WITH_PLURALS = ("property", "noun", "distance")

Entries = list[tuple[tuple[str, ...], str]]


def plural_of(noun: str) -> str:
    """What is the regular plural of a noun (of its last word)?"""
    if noun.endswith(("s", "x", "ch", "sh")):
        return noun + "es"
    if noun.endswith("y") and noun[-2] not in "aeiou":
        return noun[:-1] + "ies"
    return noun + "s"


class Lexicon:
    """Categories of wordings, each with a value; matched longest first."""

    def __init__(self, data: dict[str, Any]) -> None:
        self.spelling: dict[str, str] = data["spelling"]
        self.units: dict[str, tuple[float, int]] = {
            name: (factor, kind) for name, (factor, kind) in data["units"].items()
        }
        self.foreign: dict[str, frozenset[str]] = {name: frozenset(words) for name, words in data["foreign"].items()}
        self.never_corrected = frozenset(data["never_corrected"]["never_corrected"])
        self.singular_in_s = frozenset(data["mass_plural"]["mass_plural"])
        self.irregular: dict[str, str] = {
            plural: noun for noun, plurals in data["singular"].items() for plural in plurals
        }
        self._index: dict[str, dict[str, Entries]] = {}
        for category, table in data.items():
            if category == "scale":
                for form in _SCALE_FORMS:
                    self._add(f"scale.{form}", {measure: forms[form] for measure, forms in table.items()})
            elif category not in _NOT_ENGLISH_GRAMMAR:
                self._add(category, self._with_plurals(table) if category in _TABLES_WITH_PLURALS else table)
        self.words = frozenset(
            word
            for category in self._index.values()
            for entries in category.values()
            for words, _ in entries
            for word in words
        )

        corrected_to = {*_CORRECTED_TO, *(f"scale.{form}" for form in _SCALE_FORMS)}
        self.corrected_to = frozenset(
            word
            for category in corrected_to
            for wording in self.wordings(category)
            if category != "property" or " " not in wording  # measures are named with words of parts: 'hole depth'
            for word in wording.split()
        )

    def match(self, category: str, words: Sequence[str], start: int, end: int) -> tuple[str, int] | None:
        """Which value's wording starts at `start`, and where does it end? The longest one; None when there is none."""
        if start >= end:
            return None
        for wording, value in self._index[category].get(words[start], ()):
            stop = start + len(wording)
            if stop <= end and tuple(words[start:stop]) == wording:
                return value, stop
        return None

    def wordings(self, category: str) -> list[str]:
        """Every wording of a category."""
        return [" ".join(wording) for entries in self._index[category].values() for wording, _ in entries]

    def singular(self, word: str) -> str:
        """What is the singular of a noun? The word itself when it is none."""
        if word in self.irregular:
            return self.irregular[word]
        if word in self.singular_in_s or len(word) < 4 or not word.endswith("s") or word.endswith(("ss", "us", "is")):
            return word
        if word.endswith("ies"):
            return word[:-3] + "y"
        if word.endswith(("sses", "xes", "ches", "shes", "zzes")):
            return word[:-2]
        return word[:-1]

    def is_plural(self, word: str) -> bool:
        """Is a noun in the plural?"""
        return self.singular(word) != word

    def _with_plurals(self, table: dict[str, list[str]]) -> dict[str, list[str]]:
        """The table with the regular plural of each noun that is no plural itself."""
        regular = {noun for nouns in table.values() for noun in nouns if not self._ends_in_s_or_irregular(noun)}
        return {value: [*nouns, *(plural_of(n) for n in nouns if n in regular)] for value, nouns in table.items()}

    def _ends_in_s_or_irregular(self, noun: str) -> bool:
        last = noun.rsplit(maxsplit=1)[-1]
        return last in self.irregular or last.endswith(("es", "xis", "ius"))

    def _add(self, category: str, table: dict[str, list[str]]) -> None:
        index: dict[str, Entries] = {}
        for value, wordings in table.items():
            for wording in wordings:
                words = tuple(wording.split())
                index.setdefault(words[0], []).append((words, value))
        for entries in index.values():
            entries.sort(key=lambda entry: -len(entry[0]))
        self._index[category] = index


def load() -> Lexicon:
    """Read the lexicon from the package's data."""
    return Lexicon(tomllib.loads(resources.files(__package__).joinpath("lexicon.toml").read_text(encoding="utf-8")))


LEXICON = load()
