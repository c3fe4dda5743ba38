"""What a sentence says beside what it asks: appositions, and how a measure is to be taken.

Such words would otherwise be read as parts. They are left out before the grammar reads the question, each with a note;
what they tell of a distance (`between centres`, `the free space`) is kept.
"""

from __future__ import annotations

import re
from collections.abc import Callable
from dataclasses import replace
from typing import TypeAlias

from . import modifiers
from .asking import EXTENTS
from .distances import between_planes
from .lexicon import LEXICON
from .meaning import Distance, Get, Measure, NounClass, Query, Reduce, Selection
from .phrases import is_known, target
from .text import LEFT_OUT, Text
from .tokens import Kind, Token, tokenize

_ONE_VALUE = re.compile(r"\b(?:one|single) (?:number|value|figure)\b(?! (?:per|for each|each))", re.IGNORECASE)
_INCLUDED = re.compile(
    r"\b(?:included|including|inclusive|(?<!together )with (?:the|its|their) \w+\W*$)", re.IGNORECASE
)
_ENABLING = (
    "makes", "make", "lets", "let", "allows", "allow", "enables", "enable", "helps", "help", "prevents", "prevent",
    "ensures", "ensure", "gives", "give", "stops", "stop",
)  # fmt: skip
_SPAN = 8
"""An aside of one sentence has fewer words than this."""

Rule: TypeAlias = Callable[[Text, int, int], int | None]
"""Where does the aside end that stands at a token? None when none does."""


def bracketed(text: str) -> tuple[str, ...]:
    """What stands in brackets: '(clear opening)' tells which distance is meant."""
    return tuple(re.findall(r"\(([^()]*)\)", text))


def _plain(text: Text) -> Text:
    """'go all the way through' is 'are through'; 'exactly' before no number says nothing."""
    kept: list[Token] = []
    at, end = 0, len(text.tokens)
    while at < end:
        if through := text.after("through_phrase", at, end):
            kept += [Token("are", "are"), Token("through", "through")]
            if through < end and text.match("article", through, end):
                kept.append(Token("in", "in"))
            at = through
        elif text.word_at(at, end, "exactly", "precisely") and text.number(at + 1, end) is None:
            at += 1
        else:
            kept.append(text.tokens[at])
            at += 1
    return text if tuple(kept) == text.tokens else Text(tuple(kept), text.book)


def without_asides(text: Text) -> Text:
    """The question without its asides, each of which is noted."""
    text = _bracketed_adjectives(_plain(text))
    kept: list[int] = []
    at, end = 0, len(text.tokens)
    while at < end:
        after = next((stop for rule in _RULES if (stop := rule(text, at, end))), None) if at else None
        if after is None:
            kept.append(at)
            at += 1
        else:
            text.leave_out(at, after)
            at = after
    return text if len(kept) == end else text.rearranged(kept)


def hinted(meaning: Query, asked: str, hints: tuple[str, ...], text: Text, before: str = "") -> Query:
    """The meaning with what the asides tell of a distance: between centres, the free space, of opposite parts."""
    stated = Text(tokenize(before))
    if isinstance(meaning, Distance) and meaning.reduce is Reduce.EACH:
        if stated.find("opposite", 0, len(stated.tokens)):
            meaning = replace(meaning, reduce=Reduce.LARGEST)
    for hint in hints:
        text.note(f"{LEFT_OUT} {hint.strip()}")
    if isinstance(meaning, Get):
        meaning = _measured_so(meaning, asked)
    if isinstance(meaning, Get) and meaning.reduce is Reduce.EACH and isinstance(meaning.target, Selection):
        if any(_ONE_VALUE.search(hint) for hint in (*hints, *asked.split(",")[1:])):
            text.note("One value is given for all; several where they differ.")
            return replace(meaning, reduce=Reduce.ONE)
    if not isinstance(meaning, Distance):
        return meaning
    for said in (*hints, *bracketed(asked), asked):
        words = Text(tokenize(said))
        end = len(words.tokens)
        for at in range(end):
            point = words.match("point_to_point", at, end)
            if point or (said is not asked and (point := words.match("distance", at, end)) and point[0] == "surfaces"):
                return replace(meaning, centers=point[0] == "centers")
    return meaning


def _measured_so(meaning: Get, asked: str) -> Get:
    """Which measure is it when brackets name a side, an axis is given, or all is to be included?"""
    if meaning.measures in ((Measure.WIDTH,), (Measure.LENGTH,)):
        sides = [Text(tokenize(said)).match("property", 0, 2) for said in bracketed(asked)]
        named = [Measure(side[0]) for side in sides if side and side[0] in (Measure.SHORT_SIDE, Measure.LONG_SIDE)]
        meaning = replace(meaning, measures=(named[0],)) if named else meaning
    if isinstance(meaning.target, Selection) and _is_along_axis(asked):
        of = meaning.target
        meaning = replace(meaning, measures=tuple(_along_axis(one, of) for one in meaning.measures))
    if meaning.reduce is Reduce.TOTAL and _INCLUDED.search(asked):
        meaning = replace(meaning, reduce=Reduce.EACH)  # 'the total length of the screws, head included' is overall
    return meaning


def _is_along_axis(asked: str) -> bool:
    """Is a measure asked for 'along the axis'?"""
    words = Text(tokenize(asked))
    end = len(words.tokens)
    return any(_own_axis(words, at, end) for at in range(1, end))


def _along_axis(measure: Measure, of: Selection) -> Measure:
    """What an extent of a round part is when it is taken along the part's axis."""
    standing = LEXICON.match("standing_noun", (of.phrases[0].noun,), 0, 1) is not None
    if measure not in EXTENTS | {Measure.THICKNESS, Measure.AXIAL_LENGTH}:
        return measure
    if not of.noun_class.is_round and not standing:
        return measure
    return Measure.DEPTH if of.noun_class is NounClass.HOLE else Measure.AXIAL_LENGTH


def _ends(text: Text, at: int, end: int) -> bool:
    """Is nothing said at `at` any more, or something after a comma?"""
    return at >= end or text.words[at] == ","


def _led(text: Text, at: int, end: int) -> int:
    """Behind a comma or a bracket and 'measured'."""
    at = text.skip_commas(at, end)
    return at + text.word_at(at, end, "measured", "taken")


def _parenthesis(text: Text, at: int, end: int) -> int | None:
    """'(flat rings)', '(shorter side)', '(the bore, not the bevel)': says again what stands before the bracket.

    Not where it selects: '(on the top)', '(5.5 mm)', '(visible from below)'; a second value after a value ('9/16 inch
    (14.2875 mm)') is the same again.
    """
    if text.tokens[at].raw != "(":
        return None
    close = next((i for i in range(at + 1, end) if text.tokens[i].raw == ")"), end)
    if close == at + 1:
        return None
    after = min(close + 1, end)
    if text.number(at + 1, close):
        return after if text.number(at - 1, at) else None
    selecting = ("side_word", "extreme", "scale.most", "than", "verb", "quantifier")
    selects = any(text.match(category, at + 1, close) for category in selecting) and close > at + 2
    if selects and close - at <= _SPAN:
        return None
    if (named := modifiers.sides(text, at + 1, close)) and named[1] >= close and not named[0].noun:
        return None
    if text.word_at(at + 1, close, "the") and text.match("ones", at + 2, close):
        return None  # '(the one on the left)'
    if text.match("article", at + 1, close) and _explains(text, at, close):
        return None
    return after


def _explains(text: Text, at: int, close: int) -> bool:
    """Does a bracket say in words of the trade what the unusual one before it is: 'the seat (the slot)'?"""
    other = target(text, at + 1, close)
    before = (LEXICON.singular(text.words[at - 1]),)
    usual = any(LEXICON.match(category, before, 0, 1) for category in ("noun", "common_noun"))
    return isinstance(other, Selection) and is_known(other) and not usual and modifiers.starts_noun(text, at - 1, at)


def _bracketed_adjectives(text: Text) -> Text:
    """'holes (threaded)' is 'holes that are threaded'."""
    tokens = list(text.tokens)
    for at in range(len(tokens) - 3, 0, -1):
        one = tokens[at].raw == "(" and tokens[at + 2].raw == ")" and tokens[at + 1].kind is Kind.WORD
        word = tokens[at + 1].word
        behind = LEXICON.is_plural(tokens[at - 1].word) or not modifiers.starts_noun(text, at + 3, len(text.tokens))
        if (
            one
            and behind
            and not LEXICON.is_plural(word)
            and not any(text.match(c, at + 1, at + 2) for c in _NO_ADJECTIVE)
        ):
            tokens[at : at + 3] = [Token("that", "that"), Token("are", "are"), tokens[at + 1]]
    return text if tuple(tokens) == text.tokens else Text(tuple(tokens), text.book)


def axes(text: Text, start: int, end: int) -> int | None:
    """Where does a list of three axes or extents end: 'x, y and z', 'width, depth, height'?"""
    found: set[str] = set()
    at = after = start
    while named := text.match("axis", at, end) or text.match("property", at, end):
        found.add(named[0])
        after = named[1]
        at = text.skip(after, end, "conjunction", "article", "axis_preposition")
    return after if len(found) >= 3 else None


def _is_sized(text: Text, end: int) -> bool:
    """Does the question ask for a value with three components?"""
    return any(
        ((named := text.match("property", at, end)) and named[0] in ("size", "magnitude", "half_size", "position"))
        or ((scale := text.match("scale.positive", at, end)) and scale[0] == "magnitude")
        or text.words[at] == "where"
        for at in range(end)
    )  # fmt: skip


def _axis_list(text: Text, at: int, end: int) -> int | None:
    """'along x, y and z'."""
    led = text.after("axis_preposition", _led(text, at, end), end)
    listed = text.skip_commas(at, end)
    led = listed if led is None and listed > at else led  # 'the dimensions of the part: width, depth and height'
    after = axes(text, text.skip(led, end, "article"), end) if led is not None else None
    if after is None or not _is_sized(text, end):
        return None
    after = text.skip(after, end, "side_noun", "axis_noun")
    return after if _ends(text, after, end) else None


_NOT_SHORTENED = frozenset(("radius", "diameter", "inner_diameter", "outer_diameter", "thickness", "wall_thickness"))


def _excepting(text: Text, at: int, end: int) -> int | None:
    """', without the bevel', ', not the counterbore': what a diameter or a thickness is not taken of."""
    led = text.skip_commas(at, end)
    excepting = text.after("minus", led, end) or (led + 1 if text.word_at(led, end, "not") else None)
    if led == at or excepting is None or end - led > _SPAN or any(text.word_at(i, end, ",") for i in range(led, end)):
        return None
    found = [text.match(c, i, at) for i in range(at) for c in ("property", "scale.positive")]
    return end if any(one and one[0] in _NOT_SHORTENED for one in found) else None


def _clause(text: Text, at: int, end: int) -> int | None:
    """', where the lens goes in', ', which the shaft sits in': a clause about the part behind a whole question."""
    led = text.skip_commas(at, end)
    relative = text.word_at(led, end, "where", "which", "that", "whose") or text.word_at(led + 1, end, "which")
    asked = any(text.match(c, i, at) for i in range(at) for c in ("property", "scale.positive", "count"))
    later = any(text.match(c, i, end) for i in range(led, end) for c in ("property", "count", "number"))
    verbal = any(text.match(c, i, end) for i in range(led, end) for c in ("verb", "sink", "protrude", "be", "do"))
    alone = led > at and relative and asked and verbal and not later
    return end if alone and end - led <= _SPAN and not text.word_at(led + 1, end, "is", "are") else None


def _enabling(text: Text, at: int, end: int) -> int | None:
    """'(the slit) that makes the clamp elastic', '(the rib) which lets the lid close': what a part is good for."""
    asked = any(text.match(c, i, at) for i in range(at) for c in ("property", "scale.positive", "count", "distance"))
    if not asked or not text.word_at(at, end, "that", "which") or not text.word_at(at + 1, end, *_ENABLING):
        return None
    stop = next((i for i in range(at, end) if text.words[i] == ","), end)
    return None if any(text.number(i, stop) for i in range(at, stop)) else stop


def _one_value(text: Text, at: int, end: int) -> int | None:
    """', one value', ', just a single number please': how it is to be answered."""
    led = text.skip_commas(at, end)
    led = text.skip(led, end, "noise") if led > at else end
    led += text.word_at(led, end, "as")
    led = text.skip(led, end, "article", "noise")
    number = text.word_at(led, end, "one", "single")
    return end if number and text.word_at(led + 1, end, "value", "number", "figure") else None


def _own_axis(text: Text, at: int, end: int) -> int | None:
    """'measured along the axis', 'along their axis'."""
    led = _led(text, at, end)
    if text.word_at(led, end, "over", "across") and text.words[led - 1] == "," and text.match("article", led + 1, end):
        return end if end - led <= _SPAN and not any(text.word_at(i, end, ",") for i in range(led, end)) else None
    if not text.word_at(led, end, "along", "parallel"):
        return None
    noun = text.skip(led + 1 + text.word_at(led + 1, end, "to"), end, "article")
    noun += text.word_at(noun, end, "own", "rotation", "center")
    axial = text.word_at(noun, end, "axis", "axes", "centerline")
    axial = axial or (text.word_at(noun - 1, end, "its", "their") and text.word_at(noun, end, "bore", "bores", "hole"))
    return noun + 1 if axial and _ends(text, noun + 1, end) else None


def _drill_tip(text: Text, at: int, end: int) -> int | None:
    """'not counting the drill tip', 'drill point excluded': the depth of a hole ends where its cone begins."""
    start = text.skip_commas(at, end)
    led = text.after("minus", start, end) or (start + 1 if text.word_at(start, end, "no") else None)
    noun = text.after("drill_tip", text.skip(led or start, end, "article"), end)
    if noun is None:
        return None
    after = noun if led else text.after("excluded", text.skip(noun, end, "be"), end)
    return after + (after < end and text.tokens[after].raw == ")") if after is not None else None


def _included(text: Text, at: int, end: int) -> int | None:
    """', rod included', 'including the round ends', ', with the pins': the measure of what is found takes it in."""
    if text.word_at(at, end, ","):
        verb = next((i for i in range(at + 1, min(end, at + _SPAN)) if text.words[i] in (",", "included")), end)
        if text.word_at(verb, end, "included") and verb > at + 1:
            return verb + 1
        led = at + 1 if text.word_at(at + 1, end, "with", "including") else None
        noun = text.skip(led + 1, end, "quantifier") if led else None
        if noun is None or not text.match("article", noun, end):
            return None
    elif text.word_at(at, end, "including"):
        noun = text.skip(at + 1, end)
    else:
        return None
    said = any(
        text.number(i, end) or text.match("property", i, end) or text.word_at(i, end, ",") for i in range(noun, end)
    )
    return None if said or noun >= end else end


def _together(text: Text, at: int, end: int) -> int | None:
    """', head and shank together': what a total takes in."""
    last = text.word_at(end - 1, end, "together", "altogether", "combined")
    if not text.word_at(at, end, ",") or not last or end - at > _SPAN or text.match("count", 0, end):
        return None
    return end


def _stated(text: Text, at: int, end: int) -> int | None:
    """', half-way between top and bottom', ', measured from the rim', ', the bore not counted': how, not what."""
    led = text.skip_commas(at, end)
    if led == at and not text.word_at(at, end, "measured", "taken"):
        return None
    if text.after("manner", led, end) and not modifiers.sides(text, led + text.word_at(led, end, "as"), end):
        return next((i for i in range(led, end) if text.word_at(i, end, ",")), end)
    last = (
        text.after("excluded", end - 1, end)
        or text.after("excluded", end - 2, end)
        or text.after("excluded", end - 3, end)
    )
    selects = any(text.word_at(i, end, "one", "ones") for i in range(led, end))  # 'the threaded ones not counted'
    return end if led > at and last == end and end - led <= _SPAN and not selects else None


def _from_to(text: Text, at: int, end: int) -> int | None:
    """'(how long is the tube) from face to face': where an extent begins and ends."""
    led = _led(text, at, end)
    if text.match("axis", led + 1, end):
        return None  # 'from left to right' is an axis
    if not text.word_at(led, end, "from") or (led == at and text.match("verb", at - 1, end)) or _is_distance(text, end):
        return None
    if between_planes(text, led, end) is not None:
        return None  # that is what is measured
    to = next((i for i in range(led + 2, end - 1) if text.words[i] == "to"), None)
    if to is None or any(text.number(i, end) for i in range(led, end)):
        return None
    return end


def _is_distance(text: Text, end: int) -> bool:
    """Is something else asked for than an extent?"""
    extents = ("height", "length", "width", "depth", "size", "magnitude")
    asked = any(
        (found := text.match(category, at, end)) and found[0] in extents
        for at in range(end)
        for category in ("scale.positive", "property")
    )
    return not asked or text.match("count", 0, end) is not None or any(
        text.word_at(at, end, "far") or text.match("distance", at, end) or text.match("spacing", at, end)
        for at in range(end)
    )  # fmt: skip


def _point_to_point(text: Text, at: int, end: int) -> int | None:
    """'center to center', behind what is measured."""
    after = text.after("point_to_point", _led(text, at, end), end)
    if after is None:
        return None
    along = text.after("axis_preposition", after, end)  # 'center to center in y direction'
    axis = along is not None and text.match("axis", text.skip(along, end, "article"), end)
    return after if axis or _ends(text, after, end) else None


_SELECTING = ("negation", "preposition", "side", "side_word", "light", "extreme", "scale.more", "scale.most")
_NO_ADJECTIVE = (
    "side",
    "side_word",
    "scale.positive",
    "axis",
    "property",
    "spacing",
    "distance",
    "noun",
    "noise",
    "light",
    "quantifier",
    "unit",
)
_RULES: tuple[Rule, ...] = (
    _parenthesis, _drill_tip, _excepting, _clause, _enabling, _one_value,
    _point_to_point, _axis_list, _own_axis, _from_to, _included, _together, _stated,
)  # fmt: skip
