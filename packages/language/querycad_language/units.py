"""Which unit does a question want its answer in?"""

from __future__ import annotations

import re

from querycad_contracts import LengthUnit

_ASKED = re.compile(
    r"\bin (?:square |cubic |sq\.? |cu\.? )?(mm|cm|m|in|inch(?:es)?|(?:milli|centi)?met(?:er|re)s?)"
    r"(?:\^?[23]|[²³])?(?![a-z0-9])(?! (?:dia|hole|bore|thick|wide|long|deep))",
    re.IGNORECASE,
)
_UNITS = {"mm": LengthUnit.MM, "mi": LengthUnit.MM, "cm": LengthUnit.CM, "ce": LengthUnit.CM, "in": LengthUnit.IN,
          "me": LengthUnit.M, "m": LengthUnit.M}  # fmt: skip


def asked_unit(question: str) -> LengthUnit | None:
    """The unit of lengths that the words ask for: 'in inches', 'in mm'; None where they name none.

    A unit behind a number belongs to that number: '5 in' asks for nothing.
    """
    found = list(_ASKED.finditer(" ".join(question[:2000].split())))
    return _UNITS[found[-1][1].lower()[:2]] if found else None
