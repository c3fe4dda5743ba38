"""Which words can belong to a noun phrase?"""

from __future__ import annotations

from querycad_language.lexicon import Degree, Span
from querycad_language.text import Text
from querycad_language.tokens import Kind

_VERBS = (
    "run", "stand", "rest", "lead", "seat", "stop", "project", "lie", "end", "slide", "face", "point", "open", "look",
)  # fmt: skip
_OPEN = (
    "noun", "adjective", "whole", "side", "color", "scale", "ordinal", "place_extreme", "number", "article", "measure",
    "whole_adjective", "stock", "distance", "gap", "ground",
)  # fmt: skip


def noun_follows(text: Text, at: int) -> bool:
    """Does a word that can be part of a noun phrase stand here?"""
    if not text.is_kind(at, Kind.WORD):
        return text.is_kind(at, Kind.QUANTITY, Kind.NUMBER, Kind.TIMES, Kind.THREAD)
    return text.find(at, *_OPEN) is not None or text.is_content(at)


def is_noun(text: Text, at: int) -> bool:
    """Does a word stand here that can only be a noun, or belong to one?"""
    if not text.is_kind(at, Kind.WORD):
        return text.is_kind(at, Kind.QUANTITY, Kind.THREAD)
    if text.find(at, "noun", "adjective", "color", "whole"):
        return True
    return text.is_content(at) and text.find(at, "measure", "side", "side_noun", "scale", "ground") is None


def scale_at(text: Text, at: int, *degrees: Degree) -> Span | None:
    """The adjective of a measure that begins here, in one of the degrees: 'deep', 'deeper'."""
    span = text.find(at, "scale")
    return span if span is not None and span.value.degree in degrees else None


def superlative(text: Text, at: int) -> Span | None:
    """The superlative that begins here: 'deepest'."""
    return scale_at(text, at, "most", "least")


def ends_do_question(text: Text, at: int) -> bool:
    """Is it the last word of a question with 'do', or one before a preposition, where a verb stands?"""
    last = at + 1 >= len(text) or text.is_break(at + 1) or text.is_word(at + 1, ",") or text.find(at + 1, "place")
    return bool(last) and text.is_word(at, *_VERBS) and text.any_in(range(at - 12, at), "do")


def is_verb(text: Text, at: int) -> bool:
    """Does an unknown word stand where a verb stands: 'holes coming in from the side', 'the hub overtops the rim'?"""
    noun = text.is_kind(at - 1, Kind.WORD) and text.find(at - 1, "noun", "whole", "pronoun")
    behind_noun = noun and not text.is_word(at - 1, "one")  # 'one guiding lug'
    if text.words[at].endswith(("ing", "ed")) and (behind_noun or text.find(at + 1, "article", "place")):
        return True
    bare = not text.find(at - 1, "article", "adjective", "number", "ask", "quantifier", "each", "place", "scale")
    return bool(bare and text.find(at + 1, "article", "count"))
