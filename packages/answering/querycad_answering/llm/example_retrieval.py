"""Which questions of a small collection are most like another? Okapi BM25 over the words that say what is asked."""

from __future__ import annotations

import math
import re
from collections import Counter
from collections.abc import Sequence
from functools import cache

from .files import prompt_data

K1, B = 1.2, 0.75
"""The usual parameters: how soon a repeated word stops counting, and how much a long text is marked down."""
_WORD = re.compile(r"[a-z]+|\d+(?:[.,]\d+)*")
_IRREGULAR = {"feet": "foot", "teeth": "tooth"}
NUMBER, SIDE = "#", "@"
ASKED_FOR_WEIGHT = 2.0
"""A program follows the measure that is asked for more than the part: another part changes one word of it."""

UNASKED = 0.5
"""Share of its weight that a measure which only the text asks for counts against it: other words may say the same."""


@cache
def _listed(name: str) -> frozenset[str]:
    """The words in words.toml that this is the name of."""
    return frozenset(prompt_data("words.toml")["questions"][name])


def words(text: str) -> list[str]:
    """The words that say something, lower-case, in the singular; numbers are one word, sides and synonyms too."""
    return [_form(word) for word in _WORD.findall(text.lower()) if word not in _listed("say_nothing")]


def singular(word: str) -> str:
    """The word without the ending of a plural: bodies, bosses, holes."""
    if word in _IRREGULAR:
        return _IRREGULAR[word]
    if len(word) > len("ties") and word.endswith("ies"):
        return f"{word[:-3]}y"
    if len(word) > len("axes") and word.endswith(("sses", "shes", "ches", "xes")):
        return word[:-2]
    return word[:-1] if len(word) > 3 and word.endswith("s") and not word.endswith("ss") else word


def _form(word: str) -> str:
    if word[0].isdigit():
        return NUMBER
    if word in _listed("sides"):
        return SIDE
    return _same().get(singular(word), singular(word))


@cache
def _particular() -> frozenset[str]:
    """What a program follows most: the measure that is asked for, a side, a number."""
    return _listed("asked_for") | {NUMBER, SIDE}


@cache
def _same() -> dict[str, str]:
    """The word that each of words.toml's `same` stands for."""
    same: dict[str, list[str]] = prompt_data("words.toml")["questions"]["same"]
    return {other: word for word, others in same.items() for other in others}


class Nearest:
    """Ranks texts by how much they have in common with a query (Robertson and Zaragoza 2009, section 3)."""

    def __init__(self, texts: Sequence[str]) -> None:
        self._counts = [Counter(words(text)) for text in texts]
        lengths = [sum(counts.values()) for counts in self._counts]
        mean = sum(lengths) / max(1, len(lengths))
        self._marked_down = [1 - B + B * length / max(1.0, mean) for length in lengths]
        found_in = Counter(word for counts in self._counts for word in counts)
        self._weight = {
            word: math.log(1 + (len(texts) - number + 0.5) / (number + 0.5))
            * (ASKED_FOR_WEIGHT if word in _particular() else 1.0)
            for word, number in found_in.items()
        }

    def ranked(self, query: str) -> list[int]:
        """Indices of the texts, the most alike first; ties in the order of the collection.

        What a text asks for and the query does not counts against it: "different diameters" is not "the diameter". So
        does a side or number: a writer takes it over into its program.
        """
        asked = set(words(query))
        scores = [
            sum(self._score(word, counts[word], down) for word in asked & counts.keys())
            - UNASKED * sum(self._weight[word] for word in (counts.keys() - asked) & _particular())
            for counts, down in zip(self._counts, self._marked_down, strict=True)
        ]
        return sorted(range(len(scores)), key=lambda i: -scores[i])

    def _score(self, word: str, count: int, down: float) -> float:
        return self._weight[word] * count * (K1 + 1) / (count + K1 * down)
