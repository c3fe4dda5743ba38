"""Units that people ask for beside mm, cm, m and inch: 'in pounds', 'how many litres', 'in feet'."""

from __future__ import annotations

import re

from querycad_contracts import Answer, LengthUnit

from .numbers import significant

_SI: dict[str, tuple[str, int, float]] = {
    "pounds?|lbs?": ("lb", 0, 0.45359237),
    "ounces?|oz": ("oz", 0, 0.028349523125),
    "grams?|grammes?|g": ("g", 0, 1e-3),
    "(?:metric )?tons?|tonnes?": ("t", 0, 1e3),
    "feet|foot|ft": ("ft", 1, 0.3048),
    "microns?|micromet(?:er|re)s?|µm|um": ("µm", 1, 1e-6),
    "thous?": ("thou", 1, 2.54e-5),
    "lit(?:er|re)s?": ("l", 3, 1e-3),
    "millilit(?:er|re)s?|ml": ("ml", 3, 1e-6),
    "cc|ccm": ("cm³", 3, 1e-6),
    "(?:us )?gallons?": ("US gal", 3, 3.785411784e-3),
    "millimet(?:er|re)s?": ("mm", 1, 1e-3),
    "centimet(?:er|re)s?": ("cm", 1, 1e-2),
    "inch(?:es)?": ("in", 1, 0.0254),
}
"""Name to sign, power of lengths (0 of a mass in kg), and value in SI (NIST SP 811, appendix B)."""
_POWERS = {"square": 2, "cubic": 3}
_WHAT = {0: "what mass", 2: "what area", 3: "what volume"}
_SIGNS = {1: "", 2: "²", 3: "³"}
_ASKED = re.compile(
    rf"\b(?:in|how many|number of) (?:(square|cubic) )?(?:{'|'.join(f'({names})' for names in _SI)})\b(?! \d)",
    re.IGNORECASE,
)
_SCALES = re.compile(r" (?:long|wide|deep|high|tall|thick)\b", re.IGNORECASE)
_TOLD = re.compile(r"(?<![\w.])([\d.]+)(?: to ([\d.]+))? (kg|mm|cm|m|in)(²|³)?(?!\w)")


def _unit(asked: re.Match[str]) -> tuple[str, int, float]:
    """Sign, power of lengths and value in SI of the unit that is asked for."""
    sign, power, factor = list(_SI.values())[(asked.lastindex or 0) - 2]
    if asked[1] is None or power != 1:
        return sign, power, factor
    power = _POWERS[asked[1].lower()]
    return sign + _SIGNS[power], power, factor**power


def without_asked_unit(question: str) -> str:
    """The question as it is without the unit, which says nothing of what is asked: 'how much does it weigh?'"""
    if not (found := list(_ASKED.finditer(question))):
        return question
    before, said, after = question[: found[-1].start()], found[-1][0].lower(), question[found[-1].end() :]
    if said.startswith("in "):
        return f"{before.rstrip()}{after}"
    if not said.startswith("how"):
        return question
    _, power, _ = _unit(found[-1])
    if power == 1 and not _SCALES.match(after):
        return question  # feet are parts, too
    asked = "how" if _SCALES.match(after) else "how much" if "weigh" in after else _WHAT[power]
    return f"{before}{asked}{after}"


def in_asked_unit(question: str, answer: Answer) -> Answer:
    """The answer with its text in the unit that the words ask for; as it is where they ask for none of these."""
    found = list(_ASKED.finditer(question))
    if not found:
        return answer
    sign, power, factor = _unit(found[-1])

    def told(match: re.Match[str]) -> str:
        own = 0 if match[3] == "kg" else next(n for n, mark in _SIGNS.items() if mark == (match[4] or ""))
        if own != power:
            return match[0]
        scale = (LengthUnit(match[3]).metres ** own if own else 1.0) / factor
        numbers = [significant(float(each) * scale) for each in match.group(1, 2) if each]
        return f"{' to '.join(numbers)} {sign}"

    return answer.model_copy(update={"text": _TOLD.sub(told, answer.text)})
