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
    """The words that say something, lower-case and without a plural's s; all numbers are one word, and all sides."""
    return [_form(word) for word in _WORD.findall(text.lower()) if word not in _listed("say_nothing")]


def _form(word: str) -> str:
    if word[0].isdigit():
        return NUMBER
    if word in _listed("sides"):
        return SIDE
    return word[:-1] if len(word) > 3 and word.endswith("s") and not word.endswith("ss") else word


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
            * (ASKED_FOR_WEIGHT if word in _listed("asked_for") else 1.0)
            for word, number in found_in.items()
        }

    def ranked(self, query: str) -> list[int]:
        """Indices of the texts, the most alike first; ties in the order of the collection.

        What a text asks for and the query does not counts against it: "different diameters" is not "the diameter".
        """
        asked = set(words(query))
        scores = [
            sum(self._score(word, counts[word], down) for word in asked & counts.keys())
            - UNASKED * sum(self._weight[word] for word in (counts.keys() - asked) & _listed("asked_for"))
            for counts, down in zip(self._counts, self._marked_down, strict=True)
        ]
        return sorted(range(len(scores)), key=lambda i: -scores[i])

    def _score(self, word: str, count: int, down: float) -> float:
        return self._weight[word] * count * (K1 + 1) / (count + K1 * down)
