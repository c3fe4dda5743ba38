"""What people say and do not write: hesitations, and numbers in words before a unit."""

from __future__ import annotations

import re
from functools import cache

from text_to_num import alpha2digit

from .lexicon import lexicon

_HESITATION = re.compile(r"(?<!\d )\b(?:u[hm]+|erm?|hm+)\b,? ?", re.IGNORECASE)
_FRACTIONS = {"half": "0.5", "a half": "0.5", "a quarter": "0.25", "three quarters": "0.75"}


def written(text: str) -> str:
    """'wider than, um, five millimetres' as it is written: 'wider than, 5 millimetres'."""
    return _numbers().sub(_digits, _HESITATION.sub("", text))


def _digits(found: re.Match[str]) -> str:
    """The number in digits; as it is where no unit follows, as others are names and counts."""
    if not _unit().match(found.string, found.end()):
        return found[0]
    if fraction := found["fraction"]:
        return _FRACTIONS[fraction.lower()]
    said = re.sub(r"\ba (?=hundred|thousand)", "one ", found[0].lower().replace("-", " "))
    whole = re.sub(r" and a half\b", "", said)
    digits = str(alpha2digit(whole, "en", threshold=0.0))
    return re.sub(r"\d+$", lambda last: f"{int(last[0]) + 0.5:g}", digits) if whole != said else digits


@cache
def _numbers() -> re.Pattern[str]:
    """Numbers in words, some joined by 'by' or 'to'."""
    word = "|".join(sorted({*lexicon().words("number"), "thousand", "point"} - {"single", "pair", "couple", "dozen"}))
    number = rf"(?:a )?(?:{word})(?:[ -](?:and )?(?:{word})\b)*(?: and a half)?"
    fraction = rf"(?P<fraction>{'|'.join(_FRACTIONS)})(?: an?| of an?)?"
    return re.compile(rf"\b(?:{fraction}|{number}(?: (?:by|to|or|x) {number})*)\b", re.IGNORECASE)


@cache
def _unit() -> re.Pattern[str]:
    parts = {"in", "foot", "feet"}  # 'the two feet' are parts
    names = sorted(name for name in lexicon().units if name.isalpha() and len(name) > 1 and name not in parts)
    return re.compile(rf"[ -](?:square |cubic )?(?:{'|'.join(names)}|times)\b", re.IGNORECASE)
