"""Axes that a question names: 'in y direction', 'along its longer side'."""

from __future__ import annotations

from collections.abc import Iterator
from collections.abc import Set as AbstractSet
from itertools import chain

from querycad_contracts import Measure, PartQuery
from querycad_language.forms import HORIZONTAL, LONGEST, SHORTER, VERTICAL
from querycad_language.lexicon import lexicon
from querycad_language.readings.question import Question
from querycad_language.text import Text

ALONG = {Measure.HEIGHT: 2, Measure.LENGTH: LONGEST, Measure.WIDTH: SHORTER}
"""The axes that the measures of a whole run along."""
_SIDES = {"long": LONGEST, "longer": LONGEST, "length": LONGEST, "short": SHORTER, "shorter": SHORTER}
_LEVELS = {"vertical": 2, "height": 2, "level": 2, "horizontal": HORIZONTAL}
_WAYS = dict.fromkeys(("long", "longer", "along", "longitudinal"), LONGEST) | {"horizontal": HORIZONTAL}
_WAYS |= dict.fromkeys(("short", "shorter", "across", "transverse", "cross"), SHORTER) | {"vertical": VERTICAL}
_LED = {"along": {"width": 0, "depth": 1, "height": 2}, "across": {"width": SHORTER}}


def axis_named(question: Question, taken: AbstractSet[int] = frozenset()) -> tuple[int | None, set[int]]:
    """Along which axis is measured: 0, 1, 2 for x, y, z, LONGEST or SHORTER; and the tokens that say so."""
    text = question.text
    if (found := next(chain(_along_whole(question), _led(text, taken)), None)) is not None:
        return found
    for at in sorted(text.at_words(*_LEVELS) - taken):
        told = text.is_word(at, "vertical") and text.find(at + 1, "measure") and not text.find(at + 1, "noun")
        if text.find(at + 1, "distance", "gap") or (told and question.in_question(at)):
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
        axes = _SIDES | _LED.get(text.words[at], {})
        if side is not None and text.words[side.start] in axes:
            yield axes[text.words[side.start]], set(range(at, text.skip(side.end, "side_noun")))


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


def axes_listed(question: Question) -> tuple[tuple[int | PartQuery, ...], set[int]]:
    """The axes where several are named, with their tokens: 'in x and in y', 'first along the bore, then across it'."""
    text, found = question.text, dict[int, tuple[int | PartQuery, set[int]]]()
    named, sides = text.covered("axis"), {min(used): (axis, used) for axis, used in _led(text, set())}
    for span in text.all("axis"):
        told = {span.start - 2} if text.is_word(span.start - 1, "(") else set[int]()  # 'crosswise (y)'
        if not (text.is_word(span.start, "x") and {span.start - 1, span.start + 1} <= named):  # 'long way x short way'
            begin = next((at for at, (_, said) in found.items() if said & told), span.start)
            found[begin] = span.value, {*told, span.start - 1, *span.tokens}
    ways = {at for at, word in enumerate(text.words) if word in _WAYS and at + 1 not in named} - named
    levels = text.at_words("horizontal", "vertical")
    ways -= {at - 1 for at in text.at_words("first")} | (levels if len(levels) == 1 else set())
    led = {
        at for at in text.at_words("along", "across") if text.find(at + 1, "article", "pronoun", "noun", "adjective")
    }
    if {text.words[at] for at in ways} < {"along", "across"} and LONGEST not in {axis for axis, _ in found.values()}:
        ways -= led  # 'how far across the slot'
    whole = {min(used) for _, used in _along_whole(question)}
    holder = next((m.part for m in question.parts if m.start - 1 in led - whole and m.part.known), None)
    for at in ways - {at for at in ways - led if text.find(at + 1, "noun")}:
        end = next((m.end for m in question.mentions if at in led and m.start == at + 1), at + 1)
        end = next((i + 1 for i in range(end, end + 3) if text.is_word(i, "side", "edge")), end)
        along = holder if holder and _WAYS[text.words[at]] == LONGEST else _WAYS[text.words[at]]
        found[at] = sides.get(at) or (along, {*range(at - 1, end)})
    for at in text.at_words("both", "each", "two", "either") if not found else ():  # 'the spacing in both directions'
        if text.is_word(at + 1, "direction", "way", "axis") or text.find(at + 1, "distance"):
            return (LONGEST, SHORTER), {at - 1, at, at + 1}
    axes = tuple(dict.fromkeys(found[at][0] for at in sorted(found)))
    return (axes, set().union(*(used for _, used in found.values()))) if len(axes) > 1 else ((), set())
