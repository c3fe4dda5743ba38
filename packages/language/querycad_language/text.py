"""A tokenised question with every phrase that the lexicon knows in it."""

from __future__ import annotations

from dataclasses import replace
from functools import cached_property

from .ellipsis import restored
from .lexicon import Lexicon, Span, lexicon
from .tokens import Kind, Token, tokenize

CLOSED = frozenset([
    "function", "chatter", "courtesy", "be", "do", "modal", "have", "ask", "imperative", "count", "exists", "place",
    "side_preposition", "relation", "behind", "except", "negation", "pronoun", "where", "distance", "gap", "between",
    "outside_to_outside", "same", "article", "each", "quantifier", "seeing", "center_to_center", "surface_to_surface",
    "minus", "axis_preposition", "most", "least", "mean", "total", "different", "view", "number", "ordinal",
    "whole_adjective", "edge", "origin", "near", "far", "parallel", "perpendicular", "density", "verbs", "neighbor",
    "remaining", "axis", "stuff", "operation", "left_out", "leaving", "overview", "overlap", "contact", "carry",
    "fasten", "comparing", "emerging", "engagement", "entering", "flush",
])  # fmt: skip
"""Categories whose words are no names of parts."""
EXTENTS = ("over_all", "facewise", "outside_to_outside", "surface_to_surface")
"""Categories of the adverbs that say from where to where, such as 'end to end'."""
ROUNDED = ("radius", "fillet", "filleted", "rounded", "rounding", "round", "blend", "blended")
"""Words that tell that the edges are rounded which a question speaks of."""
_PASSIVE = ("is", "are", "be", "been", "get", "gets", "has")
_WHO = ("i", "we", "you", "they", "he", "she", "can", "must", "should", "will", "would")  # before verbs
BREAKS = frozenset((".", "?", "!", ";", ":"))  # symbols that end a clause for good


class Text:
    """The tokens of a question, and what the lexicon says of each stretch."""

    def __init__(self, question: str, names: frozenset[str] = frozenset()) -> None:
        self.question = question
        self.lexicon: Lexicon = lexicon()
        self._tell(tokenize(question, names))
        moved = restored(self.tokens, self.find)
        if moved != self.tokens:
            self._tell(moved)
        if self.has(*ROUNDED) and not self.at_phrases("distance", "where"):
            self._tell(self._rounded())
        self._content = [self._names_something(at) for at in range(len(self.tokens))]

    def _rounded(self) -> tuple[Token, ...]:
        """'The radius of the vertical edges': of the rounded corners there."""
        named = self.covered("noun", "measure", "outside_to_outside", "surface_to_surface")
        edges = {i for i in self.at_words("edge") - named if "at" not in self.words[max(0, i - 3) : i]}
        return tuple(replace(one, word="corner") if at in edges else one for at, one in enumerate(self.tokens))

    def _tell(self, tokens: tuple[Token, ...]) -> None:
        self.tokens = tokens
        self._begins: dict[tuple[str, ...], frozenset[int]] = {}
        self.words = [token.word for token in tokens]
        self.spans: list[list[Span]] = self.lexicon.spans(self.words)
        for i in self.at_words("left"):  # 'the left lug' is none that remains
            if self.find(i - 1, "article") or self.find(i + 1, "noun", "side_noun"):
                self.spans[i] = [span for span in self.spans[i] if span.category != "remaining"]
        for i in range(1, len(tokens)):
            if self.find(i - 1, "article", "number"):  # 'the four return pins', 'a check valve'
                self.spans[i] = [span for span in self.spans[i] if span.category != "imperative"]
        for i in self.at_words("it"):  # 'where it leaves the plate'
            if i + 1 < len(tokens) and tokens[i + 1].plural and not self.is_word(i - 1, "has", "have", "had", "of"):
                self.spans[i + 1] = [span for span in self.spans[i + 1] if span.category != "noun"]
        self._extents: set[int] = set()
        for at in range(1, len(tokens) - 2):
            span = self.find(at, *EXTENTS)
            if span and self.words[at + 1] == "to" and self.words[at] == self.words[at + 2]:
                self._stands_alone(at, at + 3)
            elif span and self.words[span.end - 1] == "other" and not self.any_in(range(at - 2, at), "passing"):
                self._stands_alone(at, span.end)  # 'from one end to the other'

    def _stands_alone(self, start: int, end: int) -> None:
        """In 'the rod end to end' nothing reaches into the adverb from before it: it is no rod end."""
        self.spans[:start] = [[s for s in spans if s.end <= start] for spans in self.spans[:start]]
        self.spans[start] = [s for s in self.spans[start] if s.category in EXTENTS]
        self.spans[start + 1 : end] = [[] for _ in range(start + 1, end)]
        self._extents.update(range(start, end))

    def __len__(self) -> int:
        return len(self.tokens)

    def find(self, at: int, *categories: str) -> Span | None:
        """The longest phrase of one of the categories that begins here."""
        for span in self.spans[at] if 0 <= at < len(self.tokens) else ():
            if span.category in categories:
                return span
        return None

    def all(self, *categories: str) -> list[Span]:
        """The phrases of the categories, from left to right, none inside another."""
        found: list[Span] = []
        for at in sorted(self.at_phrases(*categories)):
            if (not found or at >= found[-1].end) and (span := self.find(at, *categories)):
                found.append(span)
        return found

    def covered(self, *categories: str) -> set[int]:
        """Where the words of such phrases stand."""
        return {at for span in self.all(*categories) for at in span.tokens}

    def is_word(self, at: int, *words: str) -> bool:
        """Is the token here one of these words or symbols?"""
        return 0 <= at < len(self.tokens) and self.words[at] in words

    def has(self, *words: str) -> bool:
        """Does one of these words occur at all?"""
        return any(word in self.words for word in words)

    def at_words(self, *words: str) -> set[int]:
        """Where these words stand."""
        return {at for at, word in enumerate(self.words) if word in words}

    def any_in(self, where: range, *categories: str) -> bool:
        """Does a phrase of one of the categories begin in the stretch?"""
        return any(self.find(at, *categories) for at in where)

    def at_phrases(self, *categories: str) -> frozenset[int]:
        """Where phrases of these categories begin."""
        if (begins := self._begins.get(categories)) is None:
            begins = frozenset(i for i in range(len(self.tokens)) if self.find(i, *categories))
            self._begins[categories] = begins
        return begins

    def skip(self, at: int, *categories: str) -> int:
        """Where the words of these categories that begin here end."""
        while (span := self.find(at, *categories)) is not None:
            at = span.end
        return at

    def stuff(self, at: int) -> Span | None:
        """What is there so much of: 'how much metal', 'how much solid material'? `at`: where 'how' stands."""
        adjective = self.find(at + 2, "adjective")
        return self.find(at + 2, "stuff") or (self.find(adjective.end, "stuff") if adjective is not None else None)

    def is_break(self, at: int) -> bool:
        """Does a clause end here?"""
        return self.is_kind(at, Kind.SYMBOL) and self.words[at] in BREAKS

    def is_possessive(self, at: int) -> bool:
        """Is it the 's of an owner?"""
        return self.is_kind(at, Kind.POSSESSIVE)

    def is_kind(self, at: int, *kinds: Kind) -> bool:
        """Is there a token here, of one of the kinds?"""
        return 0 <= at < len(self.tokens) and self.tokens[at].kind in kinds

    def is_content(self, at: int) -> bool:
        """Is it a word that no closed class has: the name of something?"""
        return self._content[at]

    def _names_something(self, at: int) -> bool:
        token = self.tokens[at]
        if token.kind is not Kind.WORD or at in self._extents:
            return False
        if not self.spans[at]:
            before, acts = self.words[at - 1] if at else "", self.find(at + 1, "article", "pronoun") is not None
            passive = token.word.endswith("ed") and before in _PASSIVE  # 'the floor that it is bolted to'
            acting = token.word.endswith("ing") and before in ("before", "after", "by", "when", "while")
            verb = before in _WHO or (before == "to" and acts)  # 'which side I chuck', 'to turn it'
            if passive or acting or verb or token.word.endswith(("ly", "wise", "wards")):
                return False
        return not any(span.category in CLOSED for span in self.spans[at] if span.end == at + 1)

    @cached_property
    def sentences(self) -> list[tuple[int, int]]:
        """(start, end) of each sentence; a colon, a semicolon and a dash part sentences too."""
        ends = [*(at for at in sorted(self.at_words(*BREAKS, "-")) if self.is_kind(at, Kind.SYMBOL)), len(self.tokens)]
        return [(start, end) for start, end in zip([0, *(end + 1 for end in ends)], ends, strict=False) if start < end]
