"""Units that people ask for: 'in inches', 'in pounds', 'how many litres', 'in square feet'."""

from __future__ import annotations

import re
from collections.abc import Mapping
from functools import cache

from querycad_contracts import Answer, AnswerType, LengthUnit
from querycad_language.lexicon import lexicon

from .numbers import significant

_LENGTHS = re.compile(
    r"\bin (?:square |cubic |sq\.? |cu\.? )?(mm|cm|m|in|inch(?:es)?|(?:milli|centi)?met(?:er|re)s?)"
    r"(?:\^?[23]|[²³])?(?![a-z0-9])(?! (?:dia|hole|bore|thick|wide|long|deep))",
    re.IGNORECASE,
)
_LENGTH_UNITS = {
    "mm": LengthUnit.MM, "mi": LengthUnit.MM, "cm": LengthUnit.CM, "ce": LengthUnit.CM, "in": LengthUnit.IN,
    "me": LengthUnit.M, "m": LengthUnit.M,
}  # fmt: skip
_MASS = -1
"""The power of lengths in a mass, as the lexicon has it, whose factor is in kg."""
_MORE: Mapping[str, tuple[float, int]] = {
    **dict.fromkeys(("milliliters", "milliliter", "millilitres", "millilitre", "ml"), (1e-6, 3)),
    **dict.fromkeys(("US gallons", "US gallon"), (3.785411784e-3, 3)),
}
"""What the lexicon has no unit for, by name: value in SI and power of lengths (NIST SP 811, appendix B)."""
_KILOGRAMS = {"kg": 1.0, "g": 1e-3}
_POWERS = {"square": 2, "cubic": 3}
_MARKS = {"": 1, "²": 2, "³": 3}
_WHAT = {_MASS: "what mass", 2: "what area", 3: "what volume"}
_SCALES = re.compile(r" (?:long|wide|deep|high|tall|thick)\b", re.IGNORECASE)
_ONE = r"-?\d[\d.]{0,30}(?:e[+-]?\d{1,3})?"
_TOLD = re.compile(rf"(?<![\w.-])({_ONE}(?:(?: x | to |, ){_ONE}){{0,30}})(\)?) (kg|g|mm|cm|m|in)(²|³)?(?!\w)")
"""'12 mm', '8.5 to 54 mm', '170 x 170 x 53 mm', '(0, 0, 7.5) mm'."""
_NAMES = (AnswerType.PARTS, AnswerType.TEXT, AnswerType.TEXTS)


def asked_unit(question: str) -> LengthUnit | None:
    """The unit of lengths that the words ask for: 'in inches', 'in mm'; None where they name none.

    A unit behind a number belongs to that number: '5 in' asks for nothing.
    """
    found = list(_LENGTHS.finditer(" ".join(question[:2000].split())))
    return _LENGTH_UNITS[found[-1][1].lower()[:2]] if found else None


@cache
def _units() -> Mapping[str, tuple[float, int]]:
    """The units that are asked for by a word: name to value in SI and power of lengths."""
    words = {name: unit for name, unit in lexicon().units.items() if name.isalpha() and name not in ("in", "m")}
    return {name.lower(): unit for name, unit in (words | dict(_MORE)).items() if unit[1] != 0}


@cache
def _asking() -> re.Pattern[str]:
    names = "|".join(map(re.escape, sorted(_units(), key=len, reverse=True)))
    return re.compile(rf"\b(in|how many) ((?:(square|cubic) )?({names}))\b(?! \d)", re.IGNORECASE)


def _asked(question: str) -> tuple[re.Match[str], float, int] | None:
    """Where a unit is asked for, its value in SI and its power; None where `asked_unit` tells, or none is."""
    found = list(_asking().finditer(question))
    if not found or asked_unit(question) is not None:
        return None
    factor, power = _units()[found[-1][4].lower()]
    if found[-1][3] is not None and power == 1:
        power = _POWERS[found[-1][3].lower()]
        factor **= power
    return found[-1], factor, power


def without_asked_unit(question: str) -> str:
    """The question as it is without the unit, which says nothing of what is asked: 'how much does it weigh?'"""
    if (asked := _asked(question)) is None:
        return question
    match, _, power = asked
    before, after = question[: match.start()], question[match.end() :]
    if match[1].lower() == "in":
        return f"{before.rstrip()}{after}"
    if power == 1 and not _SCALES.match(after):
        return question  # feet are parts, too
    words = "how" if _SCALES.match(after) else "how much" if "weigh" in after else _WHAT[power]
    return f"{before}{words}{after}"


def in_asked_unit(question: str, answer: Answer) -> Answer:
    """The answer with its text in the unit that the words ask for; as it is where they ask for none of these."""
    if answer.type in _NAMES or (asked := _asked(question)) is None:
        return answer
    match, factor, power = asked

    def told(text: re.Match[str]) -> str:
        own = _MASS if text[3] in _KILOGRAMS else _MARKS[text[4] or ""]
        if own != power:
            return text[0]
        scale = (LengthUnit(text[3]).metres ** own if own > 0 else _KILOGRAMS[text[3]]) / factor
        numbers = re.sub(_ONE, lambda one: significant(float(one[0]) * scale), text[1])
        return f"{numbers}{text[2]} {match[2].lower()}"

    return answer.model_copy(update={"text": _TOLD.sub(told, answer.text)})
