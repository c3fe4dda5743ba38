"""Questions about the model as such: 'what is this part', 'list all features', 'what can I ask'."""

from __future__ import annotations

import re
from collections.abc import Sequence

from querycad_contracts import Description, LengthUnit, Part
from querycad_language.tokens import Kind, Token, tokenize

from .addressing import Addressed
from .drawing.callouts import callouts, ids_text
from .drawing.describing import Ask, describe
from .drawing.numbers import unit_name
from .understanding import ModelView

# fmt: off
_SUBJECT = frozenset((
    "this", "that", "it", "part", "model", "file", "object", "thing", "component", "assembly", "piece", "geometry",
    "shape", "design", "drawing", "step",
))
"""Words for the model as such."""
_TOPIC = frozenset((
    "describe", "description", "overview", "summary", "summarize", "feature", "contain", "content", "inventory", "ask",
    "asked", "question", "help", "recognize", "recognized", "detect", "detected", "explain",
))
"""Words that ask for a description, or for what can be asked."""
_AROUND = frozenset((
    "please", "can", "could", "would", "should", "may", "might", "you", "me", "i", "we", "us", "my", "the", "a", "an",
    "of", "about", "all", "its", "in", "for", "to", "do", "does", "is", "are", "am", "be", "there", "have", "has",
    "what", "which", "kind", "sort", "type", "give", "show", "tell", "list", "print", "want", "like", "need", "with",
    "on", "just", "at", "look", "looking", "short", "brief", "briefly", "quick", "quickly", "every", "each", "full",
    "complete", "possible", "available", "some", "any", "exactly", "actually", "really", "so", "see", "know", "get",
    "let", "hi", "hello", "hey", "thanks", "thank", "and", "or", "by", "here", "found",
))
"""Words around these that ask for nothing else."""
# fmt: on
_ABOUT_PARTS = frozenset(
    (
        "what",
        "is",
        "are",
        "describe",
        "explain",
        "tell",
        "me",
        "us",
        "about",
        "show",
        "please",
        "the",
        "and",
        "a",
        "can",
        "you",
        "exactly",
        "s",
    )
)
_WORD = re.compile(r"[a-z]+")
_YES_OR_NO = frozenset(("is", "are", "do", "does", "have", "has"))


def asks_for_overview(question: str) -> bool:
    """Is the question about the model as such, and about no part or measure of it?

    'What is this part?' 'Describe the model.' It is where no word of it says anything else.
    """
    tokens = tokenize(question)
    words = [token.raw.lower() if token.raw.lower() in _AROUND else token.word for token in tokens if _is_word(token)]
    if not words or words[0] in _YES_OR_NO or any(token.kind not in (Kind.WORD, Kind.SYMBOL) for token in tokens):
        return False
    if not all(word in _SUBJECT or word in _TOPIC or word in _AROUND for word in words):
        return False
    if any(word in _TOPIC for word in words):
        return True
    return words[0] in ("what", "tell", "show") and words[-1] in _SUBJECT


def asks_what_parts_are(addressed: Addressed) -> bool:
    """Is asked what the parts are that the question names: 'what is hole 4', 'describe face 36'?"""
    if not addressed.names:
        return False
    names = "|".join(map(str, addressed.names))
    bare = re.sub(rf"\b(?:ring )?[a-z]+ (?:{names})\b", " ", addressed.texts[0])
    words = _WORD.findall(bare.lower())
    return bool(words) and words[0] not in _YES_OR_NO and all(word in _ABOUT_PARTS for word in words)


def told_parts(told: Sequence[Part], parts: Sequence[Part], unit: LengthUnit) -> str:
    """What a drawing would say of some of all parts, like ones together; lengths are in `unit`."""
    found = callouts(told, unit, {part.id: part for part in parts})
    return "; ".join(f"{one.text} ({ids_text(one.ids)})" for one in found) + f", in {unit_name(unit)}"


def _is_word(token: Token) -> bool:
    return token.kind is Kind.WORD and token.word not in ".?!,"


def overview(view: ModelView, unit: LengthUnit, ask: Ask | None = None) -> Description | None:
    """The description of the model that the view is of, or None where its contents are not known here.

    Questions are suggested where `ask` answers them.
    """
    if view.contents is None:
        return None
    summary, parts = view.contents()
    return describe(summary, parts, unit, ask)
