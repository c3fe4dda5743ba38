"""A question as the frames see it: its words, its mentions of parts, and the sentence that asks."""

from __future__ import annotations

from collections.abc import Iterable
from functools import cached_property

from querycad_language.phrases import Phrases
from querycad_language.text import Text


class Question:
    """One question. `names`: words of product names in the file."""

    def __init__(self, question: str, names: Iterable[str] = ()) -> None:
        self.text = Text(question, frozenset(names))
        self.phrases = Phrases(self.text)
        self.mentions = self.phrases.mentions()
        self.asking = _asking_sentence(self.text)

    def in_question(self, at: int) -> bool:
        """Is the token in the sentence that asks?"""
        return self.asking[0] <= at < self.asking[1]

    def sentence_of(self, at: int) -> int:
        """Which sentence is the token in? -1 between two."""
        return self._sentence_at.get(at, -1)

    @cached_property
    def _sentence_at(self) -> dict[int, int]:
        return {at: i for i, sentence in enumerate(self.text.sentences) for at in range(*sentence)}

    def is_unit(self, at: int) -> bool:
        """Is it a unit of measure: 'how many millimetres'?"""
        return at < len(self.text) and self.text.tokens[at].raw.lower() in self.text.lexicon.units


def _asking_sentence(text: Text) -> tuple[int, int]:
    """The sentence that asks: the last one with a question word or an order, else the last one."""
    best: tuple[int, tuple[int, int]] = (-1, (0, len(text)))
    for index, (start, end) in enumerate(text.sentences):
        score = 0
        if end < len(text) and text.is_word(end, "?"):
            score += 4
        if any(text.find(i, "ask", "count", "exists", "imperative", "where") for i in range(start, end)):
            score += 3
        if any(text.find(i, "measure", "distance", "gap") for i in range(start, end)):
            score += 2
        best = max(best, (score * 100 + index, (start, end)))
    return best[1]
