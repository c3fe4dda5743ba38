"""Plainer wording of what people say in passing: contractions, how they look at the model, what they leave out.

The turns of speech are data, in `wording.toml`: each is said in many forms, and is rewritten into the form that the
grammar reads.
"""

from __future__ import annotations

import re
import tomllib
from functools import cache
from importlib import resources

_WHOLE = (
    r"(?:it|this|that|them|(?:the|this|your|my) (?:whole |entire )?"
    r"(?:object|part|model|piece|component|body|thing|assembly|workpiece|shape|item|file|drawing))"
)
_VIEWING = (
    r"(?:(?:if|when|while|as|once|and|suppose|assuming)\s+)?"
    r"(?:(?:i|you|we|one|someone)\s+(?:am\s+|are\s+|is\s+|would\s+|were\s+to\s+)?)?"
    r"(?:looking|looks?|viewing|views?|inspect(?:ing)?|see(?:ing)?|turn(?:ing)?)"
    rf"(?:\s+(?:straight\s+|directly\s+)?(?:at|onto|on|upon|into|over)\s+{_WHOLE}|\s+{_WHOLE}(?:\s+over)?"
    r"|\s+straight|\s+directly)?"
)
_ONCE = re.compile(
    r"\b(?:no|without(?: any)?) (?:duplicate|repetition|repeat)s?\b|\b(?:only|just) once\b", re.IGNORECASE
)
_ASKS_LEVEL = re.compile(
    r"\s*(?:at\s+(?:what|which)\s+height|how\s+(?:high|far)|what(?:\s+is|'s)\s+the\s+(?:distance|height|spacing))\b",
    re.IGNORECASE,
)
_LINE = r"(?:center\s?|centre\s?)?(?:axis|line)"
_AXIS_OF = re.compile(rf"\bthe\s+{_LINE}\s+of\s+(?=the\b)|(?<=\w)(?:'s|s')\s+{_LINE}\b", re.IGNORECASE)


@cache
def _turns() -> tuple[tuple[re.Pattern[str], str], ...]:
    data = tomllib.loads(resources.files(__package__).joinpath("wording.toml").read_text(encoding="utf-8"))
    said = [turn["said"].replace("{WHOLE}", _WHOLE).replace("{VIEWING}", _VIEWING) for turn in data["turn"]]
    plain = [turn["plain"] for turn in data["turn"]]
    return tuple((re.compile(one, re.IGNORECASE), other) for one, other in zip(said, plain, strict=True))


def plainly(question: str) -> str:
    """The question in plainer words; the same text where nothing was said in passing."""
    if _ASKS_LEVEL.match(question):  # how high the axis of a bore lies is how high the bore does
        question = _AXIS_OF.sub("", question)
    for said, plain in _turns():
        question = said.sub(plain, question)
    return question


def asks_each_once(question: str) -> bool:
    """Is every value to be named only once: 'no duplicates'?"""
    return _ONCE.search(question) is not None
