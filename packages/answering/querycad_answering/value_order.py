"""In which order several values are wanted: 'larger one first', 'from the highest to the lowest', 'ascending'."""

from __future__ import annotations

from typing import Literal

from querycad_contracts import AnswerType
from querycad_language.measures import SCALARS, of_several
from querycad_language.text import Text
from querycad_language.tokens import Kind

_REACH = 4
"""Words between an adjective and the 'first' that it goes with: 'smaller of the two first'."""
_LISTS = {AnswerType.SIZE, *SCALARS, *map(of_several, SCALARS)}

Order = Literal["ascending", "descending"]


def order_of(text: Text) -> Order | None:
    """Which order do the words ask for?"""
    if text.has("ascending", "increasing"):
        return "ascending"
    if text.has("descending", "decreasing"):
        return "descending"
    for at in range(len(text)):
        order, behind = _direction(text, at), range(at + 1, at + 1 + _REACH)
        if order is None:
            continue
        first = any(stands_first(text, i) for i in behind)
        to = next((i for i in behind if text.is_word(i, "to", "then")), None)
        turns = to is not None and any(_direction(text, i) not in (None, order) for i in range(to, to + _REACH))
        if first or turns:
            return order
    return None


def stands_first(text: Text, at: int) -> bool:
    """Does 'first' or 'last' here say where in a list something comes, and not which part: 'the first slot'?"""
    alone = at + 1 >= len(text) or text.tokens[at + 1].kind is not Kind.WORD
    return text.is_word(at, "first", "last") and (alone or text.is_word(at + 1, "then", "and", "please"))


def _direction(text: Text, at: int) -> Order | None:
    """From which end does a list begin that begins with 'larger', 'lowest', 'small'?"""
    scale, adjective = text.find(at, "scale"), text.find(at, "adjective")
    if scale is not None and scale.value.degree != "positive":
        return "descending" if scale.value.degree in ("more", "most") else "ascending"
    if adjective is not None and adjective.value.order:
        return "descending" if adjective.value.most else "ascending"
    return None


def in_order(code: str, expects: AnswerType, order: Order) -> str:
    """The program with its values in that order, where it gives a list of numbers."""
    if expects not in _LISTS:
        return code
    before, _, result = code.rpartition("solution = ")
    backwards = ", reverse=True" if order == "descending" else ""
    ordered = f"sorted(found{backwards}) if isinstance(found, list | tuple) else found"
    return f"{before}found = {result}\nsolution = {ordered}"
