"""'… not counting the bore': parts that are taken out of those that a question counts or measures one by one."""

from __future__ import annotations

import re
from dataclasses import replace

from .meaning import Count, Described, Exists, Get, NounClass, Phrase, Query, Reduce, Selection
from .phrases import target
from .text import Text
from .tokens import tokenize

_LEADING = (
    r"(?:not|without)\s+(?:counting|including)|except(?:ing|\s+for)?|excluding|excluded|exclusive\s+of|(?:apart|aside)\s+from"
    r"|besides|other\s+than|leaving\s+(?:out|aside)|ignoring|disregarding|but\s+not|minus"
    r"|(?:if|when)\s+(?:you|i|we|one)\s+(?:(?:do\s+not|don['’]?t)\s+(?:count|include|consider)|leave\s+out|ignore|exclude)"
)
_ARTICLE = r"(?:the|any|an?|its|their|those|these|all)\s+"
_BEHIND = re.compile(rf"(?P<rest>.+?),?\s+(?:{_LEADING})\s+(?P<but>{_ARTICLE}[^?,.;:]+?)\s*[?.]*\s*", re.IGNORECASE)
_BEFORE = re.compile(
    rf"\s*(?:{_LEADING}|without)\s+(?P<but>{_ARTICLE}[^?,.;:]+?)\s*,\s*(?P<rest>.+)", re.IGNORECASE | re.DOTALL
)
_WITHIN = re.compile(
    rf"(?P<rest>[^,]+),\s*(?:{_LEADING}|without)\s+(?P<but>{_ARTICLE}[^?,.;:]+?)\s*,\s*(?P<more>(?:is|are|do|does|has|have)\b.+)",
    re.IGNORECASE,
)
_COMMA = re.compile(rf"(?P<rest>.+?),\s+without\s+(?P<but>{_ARTICLE}[^?,.;:]+?)\s*[?.]*\s*", re.IGNORECASE)
_ONES = re.compile(
    rf"(?P<rest>.+?),?\s+without\s+(?P<but>{_ARTICLE}[^?,.;:]+?\s+ones?)\s*[?.]*\s*", re.IGNORECASE
)  # 'holes without the ring' are such as have none
_LEFT_OUT = re.compile(
    r"(?P<rest>.+?),\s*(?:and\s+|but\s+)?(?P<but>[^?,.;:]+?)\s+(?:(?:is|are)\s+)?"
    r"(?:not\s+(?:to\s+be\s+)?(?:counted|included)|excluded|ignored|disregarded|omitted|left\s+out)\s*[?.]*\s*",
    re.IGNORECASE,
)
_ONE = re.compile(r"\bones?\s*$", re.IGNORECASE)


def exception(asked: str) -> tuple[str, str] | None:
    """The question without its exception, and what is excepted; None where nothing is."""
    if found := _WITHIN.fullmatch(asked):
        return f"{found['rest']} {found['more']}", found["but"]
    for said in (_BEHIND, _BEFORE, _COMMA, _ONES, _LEFT_OUT):
        if found := said.fullmatch(asked):
            return found["rest"], found["but"]
    return None


def without(meaning: Query, excepted: str, text: Text) -> Query | None:
    """The same asked of all parts but the excepted ones; None where it asks for no parts one by one.

    'The length of the screw without the head' is a shorter length: there nothing is taken out of several parts.
    """
    measured = isinstance(meaning, Get)
    if not isinstance(meaning, Count | Exists | Get) or (
        isinstance(meaning, Get) and meaning.reduce is not Reduce.EACH
    ):
        return None
    of = meaning.target
    if not isinstance(of, Selection) or len(of.phrases) > 1 or of.phrases[0].ranks:
        return None
    if not of.phrases[0].plural and not isinstance(meaning, Exists):
        return None
    noun = of.phrases[0].noun
    named_so = _ONE.sub(lambda one: f"{noun}s" if one[0].lower() == "ones" else noun, excepted)
    words = Text(tokenize(named_so), text.book)
    others = target(words, 0, len(words.tokens), of)
    if not isinstance(others, Selection) or any(one.filters or one.sides for one in others.phrases):
        return None
    if measured and not all(_alike(one, of.phrases[0]) for one in others.phrases):
        return None
    if any(one.ranks for one in others.phrases):  # 'the main bore' is a term as well
        named: tuple[str, ...] = (" ".join(words.words),)
    else:
        named = tuple(one.description if one.plural else f"the {one.description}" for one in others.phrases)
    denied = tuple(Described(description, False) for description in named)
    text.note(f"Not counted: {excepted}.")
    return replace(meaning, target=Selection((replace(of.phrases[0], filters=(*of.phrases[0].filters, *denied)),)))


def _alike(one: Phrase, other: Phrase) -> bool:
    """Can one be among the others: holes, or parts of one noun? The head of a screw is no screw."""
    return one.noun == other.noun or one.noun_class is other.noun_class is NounClass.HOLE
