"""Axes that a question names: 'in y direction', 'along its longer side'."""

from __future__ import annotations

from collections.abc import Set as AbstractSet

from querycad_contracts import Measure, PartQuery
from querycad_language.forms import HORIZONTAL, LONGEST, SHORTER
from querycad_language.lexicon import lexicon
from querycad_language.readings.question import Question
from querycad_language.text import Text

ALONG = {Measure.HEIGHT: 2, Measure.LENGTH: LONGEST, Measure.WIDTH: SHORTER}
"""The axes that the measures of a whole run along."""
_SIDES = {"long": LONGEST, "longer": LONGEST, "length": LONGEST, "short": SHORTER, "shorter": SHORTER}
_LEVELS = {"vertical": 2, "height": 2, "level": 2, "horizontal": HORIZONTAL}
_MEASURES = {"width": 0, "depth": 1, "height": 2}


def axis_named(question: Question, taken: AbstractSet[int]) -> tuple[int | None, set[int]]:
    """Along which axis is measured: 0, 1, 2 for x, y, z, LONGEST or SHORTER; and the tokens that say so."""
    return _of_whole(question) or _said(question, taken)


def _said(question: Question, taken: AbstractSet[int]) -> tuple[int | None, set[int]]:
    """The axis that is named."""
    text = question.text
    for at in sorted(text.at_phrases("axis_preposition") - taken):
        if (found := _along(text, at)) is not None:
            return found
    for at in sorted(text.at_words(*_LEVELS) - taken):
        apart = text.find(at + 1, "distance", "gap")
        if text.find(at + 1, "noun") and not apart:
            continue  # 'the vertical drill holes'
        if apart or (text.is_word(at, "vertical") and text.find(at + 1, "measure") and question.in_question(at)):
            return _LEVELS[text.words[at]], {at}  # 'the vertical distance', 'the height offset'
    for span in (one for one in text.all("axis") if one.start not in taken):
        that = max((i for i in text.at_words("that", "which") if i < span.start), default=span.start)
        if any(text.find(i, "passing") for i in range(that, span.start)):
            continue  # 'the holes that run along Y'
        lead = text.find(span.start - 1 - text.is_word(span.start - 1, "the"), "axis_preposition")
        letter = span.end == span.start + 1 and len(text.words[span.start]) == 1
        if lead or text.find(span.end, "distance", "gap") or not letter:
            return span.value, set(range(max(0, span.start - 2), span.end))
    return None, set()


def _along(text: Text, at: int) -> tuple[int, set[int]] | None:
    """'along its length', 'across the width': the axis that a preposition here leads to."""
    owned = next((i + 1 for i in range(at + 1, at + 8) if text.is_possessive(i)), at + 1)  # 'the plate's width'
    side = text.find(text.skip(owned, "article", "pronoun"), "measure", "adjective")
    word = text.words[side.start] if side is not None else ""
    if side is None or not (word in _SIDES or word in _MEASURES):
        return None
    if word == "width" and text.is_word(at, "across"):
        return SHORTER, set(range(at, side.end))
    if word in _SIDES:
        return _SIDES[word], set(range(at, text.skip(side.end, "side_noun")))
    return (_MEASURES[word], set(range(at, side.end))) if text.is_word(at, "along") else None


def _of_whole(question: Question) -> tuple[int, set[int]] | None:
    """'Along the slide' is along its longest side, 'across the slide' along the other one."""
    for mention in question.mentions:
        for word, axis in (("along", LONGEST), ("across", SHORTER)):
            if _is_whole(mention.query) and question.text.is_word(mention.start - 1, word):
                return axis, {mention.start - 1, *mention.used}
    return None


def _is_whole(query: PartQuery | None) -> bool:
    """Is it the whole model, or the name of a product?"""
    noun = lexicon().nouns.get(query.noun) if query is not None else None
    return query is None or (noun is not None and noun.product and not query.places)


def own_axis_named(question: Question) -> set[int]:
    """The words that say 'along its own axis': 'axially', 'along the pipe axis', 'along its bore'."""
    text = question.text
    found = text.at_words("axially") | text.covered("facewise")
    for at in text.at_words("along", "in"):
        ends = [i for i in range(at + 1, min(len(text), at + 5)) if text.is_word(i, "axis", "direction")]
        told = ends and all(text.find(i, "axis") is None for i in range(at + 1, ends[0]))
        if told and (text.is_word(ends[0], "axis") or text.is_word(ends[0] - 1, "axial")):
            found |= set(range(at, ends[0] + 1))
        noun = text.find(text.skip(at + 1, "article"), "noun")
        found |= set(range(at, noun.end)) if noun is not None and text.is_word(at, "along") else set()
    return found


def axes_listed(question: Question) -> tuple[tuple[int, ...], set[int]]:
    """The axes where several are named, with their tokens: 'in x and in y', 'lengthwise and across'."""
    text = question.text
    for at in text.at_words("and", "by", "x", "/", "&"):
        if {text.words[at - 1], *text.words[at + 1 : at + 2]} == {
            "horizontal",
            "vertical",
        }:  # 'horizontal and vertical'
            return (_LEVELS[text.words[at - 1]], _LEVELS[text.words[at + 1]]), {at - 1, at, at + 1}
    spans: dict[int, int] = {at: span.value for span in text.all("axis") for at in span.tokens}
    crossing = {at for at in text.at_words("cross", "transverse") if text.is_word(at + 1, "direction")}
    times = {at for at in spans if text.is_word(at, "x") and {at - 1, at + 1} <= spans.keys()}
    spans = {at: axis for at, axis in spans.items() if at not in times}  # 'long way x short way'
    led = {at for at in text.at_words("along", "across") if text.find(at + 1, "article", "noun", "adjective", "axis")}
    if LONGEST in spans.values() or text.at_words("long", "along", "longer") - led:
        spans |= dict.fromkeys(text.at_words("long", "along", "longer") - led, LONGEST)
        spans |= dict.fromkeys((text.at_words("short", "across", "shorter") | crossing) - led, SHORTER)
    led_to = [found for at in sorted(text.at_phrases("axis_preposition")) if (found := _along(text, at)) is not None]
    if len(dict(led_to)) > 1 and not spans:  # 'along the length and across the width'
        return tuple(axis for axis, _ in led_to), set().union(*(tokens for _, tokens in led_to))
    for at in text.at_words("both", "each", "two", "either"):  # 'the spacing in both directions'
        if (text.is_word(at + 1, "direction", "way", "axis") or text.find(at + 1, "distance")) and not spans:
            return (LONGEST, SHORTER), {at - 1, at, at + 1}
    axes = tuple(dict.fromkeys(spans[at] for at in sorted(spans)))
    return (axes, {i for at in spans for i in (at - 1, at)}) if len(axes) > 1 else ((), set())
