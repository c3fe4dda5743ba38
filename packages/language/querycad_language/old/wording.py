"""Plainer wording of what people say in passing: contractions, how they look at the model, what they leave out.

The turns of speech are data, in `wording.toml`: each is said in many forms, and is rewritten into the form that the
grammar reads.
"""

from __future__ import annotations

import re
import tomllib
from importlib import resources

from .lexicon import LEXICON

_WHOLE = (
    r"(?:it|this|that|them|(?:the|this|your|my) (?:whole |entire |complete |cad |3d |step )?"
    r"(?:object|part|model|piece|component|body|thing|assembly|workpiece|shape|item|file|drawing))"
)
_VIEWING = (
    r"(?:(?:if|when|while|as|once|and|suppose|assuming|imagine|say)\s+)?"
    r"(?:(?:i|you|we|one|someone)\s+(?:am\s+|are\s+|is\s+|would\s+|were\s+to\s+)?)?"
    r"(?:looking|looks?|viewing|views?|inspect(?:ing)?|see(?:ing)?|turn(?:ing)?)"
    rf"(?:\s+(?:straight\s+|directly\s+)?(?:at|onto|on|upon|into|over)\s+{_WHOLE}|\s+{_WHOLE}(?:\s+over)?"
    r"|\s+straight|\s+directly)?"
)
_ONCE = re.compile(
    r"\b(?:no|without(?: any)?) (?:duplicate|repetition|repeat)s?\b|\b(?:only|just) once\b", re.IGNORECASE
)
_ASKS_LEVEL = re.compile(
    r"\b(?:at\s+(?:what|which)\s+(?:height|[xyz])|how\s+(?:high|far)|(?:what|which)\s+[xyz]\b|where\s+(?:is|does|do|are)"
    r"|what(?:\s+is|'s)\s+the\s+(?:distance|height|spacing|[xyz]))\b",
    re.IGNORECASE,
)
_LINE = r"(?:center\s?|centre\s?)?(?:axis|line)"
_AXIS_OF = re.compile(rf"\bthe\s+{_LINE}\s+of\s+(?=the\b)|(?<=\w)(?:'s|s')\s+{_LINE}\b", re.IGNORECASE)

_WORD = re.compile(r"\b([A-Za-z]+)\b(\.(?=\s+[a-z(]))?")
_CONTRACTED = ("whats", "wheres")
_SHORT = 4
"""Abbreviations have at most so many letters; a dot behind a longer word ends a sentence."""
_ASKS_HEIGHT = re.compile(r"\b(?:at\s+(?:what|which)\s+height|how\s+high)\b", re.IGNORECASE)
_CENTER_OF = re.compile(r"\bthe\s+(?:cent(?:er|re)|middle|midpoint)\s+of\s+(?=the\b)", re.IGNORECASE)


def _rewrites(table: str) -> tuple[tuple[re.Pattern[str], str], ...]:
    data = tomllib.loads(resources.files(__package__).joinpath("wording.toml").read_text(encoding="utf-8"))
    said = [turn["said"].replace("{WHOLE}", _WHOLE).replace("{VIEWING}", _VIEWING) for turn in data[table]]
    plain = [turn["plain"] for turn in data[table]]
    return tuple((re.compile(one, re.IGNORECASE), other) for one, other in zip(said, plain, strict=True))


_COURTESIES = _rewrites("courtesy")
_TURNS = _rewrites("turn")


def _spelled(word: re.Match[str]) -> str:
    """A word in its usual spelling: 'teh' is 'the', 'dia.' is 'diameter'."""
    usual = LEXICON.spelling.get(word[1].lower()) if word[1].lower() not in _CONTRACTED else None
    if usual is None:
        return word[0]
    return usual if len(word[1]) <= _SHORT else usual + (word[2] or "")


def plainly(question: str) -> str:
    """The question in plainer words; the same text where nothing was said in passing."""
    for said, plain in _COURTESIES * 2:  # 'Hi, so …'
        question = said.sub(plain, question)
    question = _WORD.sub(_spelled, question)
    if _ASKS_HEIGHT.search(question):
        question = _CENTER_OF.sub("", question)
    if _ASKS_LEVEL.search(question):  # how high the axis of a bore lies is how high the bore does
        question, axes = _AXIS_OF.subn("", question)
        if axes > 1:  # from one axis to another one
            question = f"{question.rstrip(' ?.')}, center to center?"
    for said, plain in _TURNS:
        question = said.sub(plain, question)
    return question


def asks_each_once(question: str) -> bool:
    """Is every value to be named only once: 'no duplicates'?"""
    return _ONCE.search(question) is not None
