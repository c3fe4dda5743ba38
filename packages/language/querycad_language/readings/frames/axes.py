"""Axes that a question names: 'in y direction', 'along its longer side'."""

from __future__ import annotations

from collections.abc import Iterator
from collections.abc import Set as AbstractSet
from itertools import chain

from querycad_contracts import Measure
from querycad_language.forms import HORIZONTAL, LONGEST, SHORTER, VERTICAL
from querycad_language.lexicon import lexicon
from querycad_language.readings.question import Question
from querycad_language.text import Text

ALONG = {Measure.HEIGHT: 2, Measure.LENGTH: LONGEST, Measure.WIDTH: SHORTER}
"""The axes that the measures of a whole run along."""
_SIDES = {"long": LONGEST, "longer": LONGEST, "length": LONGEST, "short": SHORTER, "shorter": SHORTER}
_LEVELS = {"vertical": 2, "height": 2, "level": 2, "horizontal": HORIZONTAL}
_LED = {"along": {"width": 0, "depth": 1, "height": 2}, "across": {"width": SHORTER}}


def axis_named(question: Question, taken: AbstractSet[int] = frozenset()) -> tuple[int | None, set[int]]:
    """Along which axis is measured: 0, 1, 2 for x, y, z, LONGEST or SHORTER; and the tokens that say so."""
    text = question.text
    if (found := next(chain(_along_whole(question), _led(text, taken)), None)) is not None:
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


def _led(text: Text, taken: AbstractSet[int]) -> Iterator[tuple[int, set[int]]]:
    """'along its length', 'across the width': the axes that prepositions lead to."""
    for at in sorted(text.at_phrases("axis_preposition") - taken):
        owned = next((i + 1 for i in range(at + 1, at + 8) if text.is_possessive(i)), at + 1)  # 'the plate's width'
        side = text.find(text.skip(owned, "article", "pronoun"), "measure", "adjective")
        word, lengths = text.words[side.start] if side is not None else "", _LED.get(text.words[at], {})
        if side is not None and word in _SIDES:
            yield _SIDES[word], set(range(at, text.skip(side.end, "side_noun")))
        elif side is not None and word in lengths:
            yield lengths[word], set(range(at, side.end))


def _along_whole(question: Question) -> Iterator[tuple[int, set[int]]]:
    """'Along the slide' is along its longest side, 'across the slide' along the other one."""
    for mention in question.mentions:  # of the whole model, or of what is called by the name of a product
        noun = lexicon().nouns.get(mention.query.noun) if mention.query is not None else None
        whole = mention.query is None or (noun is not None and noun.product and not mention.query.places)
        before = mention.start - 1
        if whole and question.text.is_word(before, "along", "across"):
            yield LONGEST if question.text.is_word(before, "along") else SHORTER, {before, *mention.used}


def own_axis_named(question: Question) -> set[int]:
    """The words that say 'along its own axis': 'axially', 'along the pipe axis', 'along its bore'."""
    text = question.text
    found = text.at_words("axially") | text.covered("facewise")
    for at in text.at_words("along", "in"):
        end = next((i for i in range(at + 1, at + 5) if text.is_word(i, "axis", "direction")), at)
        told = text.is_word(end, "axis") or text.is_word(end - 1, "axial")
        if end > at and told and not any(text.find(i, "axis") for i in range(at + 1, end)):
            found |= {*range(at, end + 1)}
        noun = text.find(text.skip(at + 1, "article"), "noun")
        found |= set(range(at, noun.end)) if noun is not None and text.is_word(at, "along") else set()
    return found


def axes_listed(question: Question) -> tuple[tuple[int, ...], set[int]]:
    """The axes where several are named, with their tokens: 'in x and in y', 'lengthwise and across'."""
    text = question.text
    for at in text.at_words("and", "by", "x", "/", "&"):
        levels = (text.words[at - 1], *text.words[at + 1 : at + 2])
        if {*levels} == {"horizontal", "vertical"}:
            return tuple(VERTICAL if level == "vertical" else HORIZONTAL for level in levels), {at - 1, at, at + 1}
    named = text.covered("axis")
    times = {at for at in text.at_words("x") if {at - 1, at, at + 1} <= named}  # 'long way x short way'
    spans: dict[int, int] = {at: one.value for one in text.all("axis") for at in one.tokens if at not in times}
    crossing = {at for at in text.at_words("cross", "transverse") if text.is_word(at + 1, "direction")}
    led = {at for at in text.at_words("along", "across") if text.find(at + 1, "article", "noun", "adjective", "axis")}
    lengthwise = text.at_words("long", "along", "longer") - led
    if lengthwise or LONGEST in spans.values():
        spans |= dict.fromkeys(lengthwise, LONGEST)
        spans |= dict.fromkeys((text.at_words("short", "across", "shorter") | crossing) - led, SHORTER)
    led_to = [*_led(text, set())]
    if len(dict(led_to)) > 1 and not spans:  # 'along the length and across the width'
        return tuple(axis for axis, _ in led_to), set().union(*(tokens for _, tokens in led_to))
    for at in text.at_words("both", "each", "two", "either"):  # 'the spacing in both directions'
        if (text.is_word(at + 1, "direction", "way", "axis") or text.find(at + 1, "distance")) and not spans:
            return (LONGEST, SHORTER), {at - 1, at, at + 1}
    axes = tuple(dict.fromkeys(spans[at] for at in sorted(spans)))
    return (axes, {i for at in spans for i in (at - 1, at)}) if len(axes) > 1 else ((), set())
