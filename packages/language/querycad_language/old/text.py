"""The question as the grammar reads it: tokens, what matches at a place, and what is noted on the way."""

from __future__ import annotations

from collections.abc import Callable, Hashable, Iterable
from dataclasses import dataclass, field
from typing import Any, Concatenate, ParamSpec, TypeVar

from .lexicon import LEXICON
from .tokens import Kind, Token

Result = TypeVar("Result")
Arguments = ParamSpec("Arguments")

LEFT_OUT = "Left out:"
"""Opens the note of each stretch of the question that the meaning does not reflect."""
_SMALL = ("article", "noise")


@dataclass(slots=True)
class Notebook:
    """What is noted of one question, by all the texts that its tokens are arranged to."""

    notes: list[str] = field(default_factory=list)
    unread: list[Token] = field(default_factory=list)
    known: dict[Hashable, tuple[Any, list[str], list[Token]]] = field(default_factory=dict)
    """What a rule gave for a span, and noted: each is tried once, which keeps parsing polynomial."""


class Text:
    """Tokens with a notebook. Every rule reads a span `start:end` of them and gives None when it does not apply."""

    def __init__(self, tokens: tuple[Token, ...], notebook: Notebook | None = None) -> None:
        self.tokens = tokens
        self.words = tuple(token.word for token in tokens)
        self.book = notebook or Notebook()
        self._key = tuple(map(id, tokens))

    def match(self, category: str, start: int, end: int) -> tuple[str, int] | None:
        """Which value of a category stands at `start`, and where does it end?"""
        return LEXICON.match(category, self.words, start, end)

    def after(self, category: str, start: int, end: int) -> int | None:
        """Where does the wording of a category that stands at `start` end?"""
        found = self.match(category, start, end)
        return found[1] if found else None

    def skip(self, start: int, end: int, *categories: str) -> int:
        """Where is the first token that begins no wording of `categories` (articles and fillers by default)?"""
        at = start
        while found := next((stop for c in categories or _SMALL if (stop := self.after(c, at, end))), None):
            at = found
        return at

    def skip_commas(self, start: int, end: int) -> int:
        """Where is the first token that is no comma?"""
        while start < end and self.words[start] == ",":
            start += 1
        return start

    def word_at(self, start: int, end: int, *words: str) -> bool:
        """Does one of `words` stand at `start`?"""
        return start < end and self.words[start] in words

    def find(self, category: str, start: int, end: int) -> tuple[int, str, int] | None:
        """Where is the first wording of a category: its start, value and end?"""
        for at in range(start, end):
            if found := self.match(category, at, end):
                return at, *found
        return None

    def trimmed(self, start: int, end: int) -> int:
        """Where does the span end without the verb that closes it: '… do the holes have', '… does the part take up'?"""
        for at in range(max(start + 1, end - 2), end):
            if self.skip(start, at, "article", "shape_adjective") < at and (
                self.after("have", at, end) == end or self.after("be", at, end) == end
            ):
                return self.trimmed(start, at)
        return end

    def number(self, start: int, end: int) -> Token | None:
        """Which number stands at `start`?"""
        return self.tokens[start] if start < end and self.tokens[start].kind is Kind.NUMBER else None

    def rearranged(self, indices: Iterable[int]) -> Text:
        """The same question with only these tokens, in this order, and the same notebook."""
        return Text(tuple(self.tokens[i] for i in indices), self.book)

    def note(self, reading: str) -> None:
        """Keep a reading that was chosen where the question was ambiguous."""
        self.book.notes.append(reading)

    def leave_out(self, start: int, end: int) -> None:
        """Note a stretch that the meaning does not reflect; it lowers the confidence once, however long it is."""
        words = " ".join(token.raw for token in self.tokens[start:end] if token.word != ",")
        self.note(f"{LEFT_OUT} {words}.")

    def leave(self, at: int) -> None:
        """Keep a word that the meaning does not reflect."""
        self.book.unread.append(self.tokens[at])

    def attempt(
        self,
        rule: Callable[Concatenate[Text, Arguments], Result],
        *arguments: Arguments.args,
        **options: Arguments.kwargs,
    ) -> Result:
        """What does `rule(self, *arguments)` give? When it gives None, what it noted is forgotten."""
        book = self.book
        key = (rule, self._key, arguments, *options.items())
        if key in book.known:
            result, notes, unread = book.known[key]
            book.notes += notes
            book.unread += unread
            return result  # type: ignore[no-any-return]
        noted, left = len(book.notes), len(book.unread)
        result = rule(self, *arguments, **options)
        if result is None:
            del book.notes[noted:], book.unread[left:]
        book.known[key] = result, book.notes[noted:], book.unread[left:]
        return result
