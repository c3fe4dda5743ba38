"""Measures that a question names: how they are asked for, and which are asked together."""

from __future__ import annotations

from collections.abc import Iterable, Sequence
from collections.abc import Set as AbstractSet
from dataclasses import dataclass, replace
from typing import Literal, TypeAlias

from querycad_contracts import AnswerType, Measure
from querycad_language.forms import Reduce
from querycad_language.lexicon import Span
from querycad_language.measures import EXTENTS, answer_type
from querycad_language.text import Text
from querycad_language.tokens import DENSITY, Kind

from .question import Question

UNITS = {-1: Measure.MASS, 0: Measure.ANGLE, 1: Measure.MAGNITUDE, 2: Measure.AREA, 3: Measure.VOLUME}
"""What a unit is of, by its power of lengths."""
SIZES = (Measure.MAGNITUDE, Measure.SIZE)
"""What 'how big' and 'size' ask for."""
_BY_VERB = (Measure.MASS, Measure.NAME, Measure.DIAMETER, Measure.INCLINATION)
_WIDE = (Measure.POSITION, Measure.DIRECTION, *SIZES)
"""Measures that narrower ones are of: the position of the tip, the size of the diameter."""
_EXTENDING = {Measure.LENGTH, Measure.WIDTH, Measure.HEIGHT, Measure.DEPTH, *SIZES, Measure.VOLUME}
"""Measures that a hollow part has twice: outside, and of the space within."""
_NEAR = ("under", "behind", "around", "below", "beneath", "above")
_BY = ("and", ",", "x", "by", "/")
_JOINTS = (*_BY, "&", "+", "plus", "its", "as", "well", "followed", "then")
_INTO = ("into", "inside", "in")
_GOING = (
    "push", "insert", "slide", "screw", "plug", "go", "goe", "goes", "milled", "cut", "drilled", "bored", "machined",
    "run", "extend", "reach", "sink", "let",
)  # fmt: skip
_MEASURED = ("its", "the", "a", "when", "it", "is", "measured", "taken", "so", "as", "i", "e", "meaning", "that", "be")
_ACROSS = (Measure.ACROSS_FLATS, Measure.ACROSS_CORNERS, Measure.DIAGONAL)
_RADIAL = (Measure.WIDTH, Measure.THICKNESS, Measure.HEIGHT, Measure.WALL_THICKNESS)
_WHICH_WAY = (Measure.DIRECTION, Measure.APPROACH)
EXTREMES = {"most": Reduce.LARGEST, "least": Reduce.SMALLEST}
_ROUND = (Measure.OUTER_DIAMETER, Measure.INNER_DIAMETER)
_REDUCES = {**EXTREMES, "mean": Reduce.MEAN, "different": Reduce.DIFFERENT, "total": Reduce.TOTAL}
How: TypeAlias = Literal["noun", "how", "verb", "reach", "where"]


@dataclass(frozen=True, slots=True)
class Requested:
    """A measure that is named: where, which, and how."""

    start: int
    end: int
    measures: tuple[Measure, ...]
    how: How
    reduce: Reduce | None = None
    used: frozenset[int] = frozenset()
    inside: bool | None = None
    """'Inner length', 'internal height': of the space within; False: of what is around it."""


def _asked(how: How, measure: Measure, start: int, end: int, more: Iterable[int] = ()) -> Requested:
    """What the words from one to another ask for, with those of the tokens `more`."""
    return Requested(start, end, (measure,), how, used=frozenset((*range(start, end), *more)))


def asked_in(question: Question) -> list[Requested]:
    """The measures that are named, from left to right."""
    taken = {i for mention in question.mentions for i in mention.used}
    stuff = min((span.start for span in question.text.all("stuff", "gap")), default=len(question.text))
    between = min((i for i in question.text.at_words("between") if i > stuff), default=len(question.text))
    found: list[Requested] = []
    at = 0
    while at < len(question.text):
        asked = _asked_at(question, at, taken)
        if asked is not None and not (asked.start > between and asked.measures[0] in _ROUND):  # 'between A and B OD'
            found.append(_narrowed(question, asked))
        at = asked.end if asked is not None else at + 1
    return _specified(question.text, found) or _implied(question.text)


def _specified(text: Text, found: Sequence[Requested]) -> list[Requested]:
    """'How big is the wheel in diameter?', 'I need the window size, width and height': the size by what names it."""
    kept: list[Requested] = []
    for asked in found:
        begin = asked.start
        while text.is_word(begin - 1, *_MEASURED):
            begin -= 1
        wider = (*SIZES, *_ACROSS) if kept and begin == kept[-1].end else SIZES  # 'hex size across …'
        size = kept[-1] if kept and kept[-1].measures[0] in wider else None
        joined = text.is_word(begin - 1, "in", "by", "(") or asked.measures[0] in _ACROSS
        joined = joined or (text.is_word(begin - 1, ",") and not text.find(begin, "ask"))
        narrower = asked.how == "noun" and asked.measures[0] not in SIZES
        if size and asked.how == "verb" and asked.measures == size.measures:  # 'how many mm does it measure in height'
            kept[-1] = replace(size, used=size.used | asked.used)
        elif size and len(size.measures) == 1 and narrower and joined:
            used = size.used | asked.used | {*range(begin - 1, asked.start)}
            kept[-1] = replace(size, measures=asked.measures, reduce=size.reduce or asked.reduce, used=used)
        else:
            kept.append(asked)
    return kept


def _narrowed(question: Question, asked: Requested) -> Requested:
    """'How large is the window in square millimetres?' asks for an area; 'How wide is the ledge, measured radially?'"""
    unit, radially = question.unit_asked, question.text.covered("radially")
    match asked.measures:
        case (measure,) if unit is not None and measure in SIZES:
            return replace(asked, measures=(UNITS[unit[1]],), used=asked.used | unit[0])
        case (measure,) if radially and measure in _RADIAL:
            return replace(asked, measures=(Measure.RADIAL_WIDTH,), used=asked.used | radially)
    return asked


def _implied(text: Text) -> list[Requested]:
    """Who states a density, and names no measure, asks for the mass; 'What is left below the slot?' asks how thick."""
    stated = [at for at, token in enumerate(text.tokens) if token.power == DENSITY]
    if stated:
        return [_asked("verb", Measure.MASS, stated[0], stated[0] + 1)]
    said = text.at_phrases("remaining")
    under = text.at_words("under", "below", "beneath", "underneath", "behind", "between")
    if not said or not under or text.at_phrases("distance", "gap", "count"):
        return []
    return [_asked("verb", Measure.THICKNESS, min(said), min(said) + 1, said | under)]


def _asked_at(question: Question, at: int, taken: set[int]) -> Requested | None:
    """The measure that is named from here on."""
    text = question.text
    if text.is_word(at, "how"):
        unit = question.unit(at + 2) if text.is_word(at + 1, "many") else None
        return _how_many(text, at, *unit) if unit is not None else _how(text, at, taken)
    return _said(text, at, taken) or _named(text, at, taken)


def _how_many(text: Text, at: int, end: int, power: int) -> Requested:
    """'How many millimetres deep is …?', 'How many degrees …?'; without a measure in the question: how large."""
    ahead = (text.find(i, "scale") for i in range(end, end + 6) if power == 1)
    scale = next((span for span in ahead if span and span.value.degree == "positive"), None)
    if scale is not None:
        return _asked("how", scale.value.measure, at, end, scale.tokens)
    return _asked("how", UNITS[power], at, end)


def _how(text: Text, at: int, taken: set[int]) -> Requested | None:
    """'How deep is …?', 'How far does … stick out?'"""
    stuff = text.stuff(at) if text.is_word(at + 1, "much") else None
    if stuff is not None:  # 'how much metal is left under the slot?', 'how much metal is in it?'
        near = text.at_phrases("remaining", "gap", "between") or text.has(*_NEAR)
        around = text.at_words("around")
        measure = Measure.WALL_THICKNESS if around else Measure.THICKNESS if near else Measure.VOLUME
        return _asked("how", measure, at, stuff.end, around)
    scale = text.find(at + 1, "scale") or text.find(at + 1 + text.is_word(at + 1, "much", "far", "exactly"), "scale")
    if scale and scale.value.degree == "positive":
        of = text.find(text.skip(scale.end, "be", "article"), "measure")
        if scale.value.measure is Measure.MAGNITUDE and of and not text.find(of.start, "noun"):  # 'how big is a radius'
            return _asked("noun", of.value, at, of.end)
        lies = text.at_words("sit", "lie") | ({scale.end} if text.is_word(scale.end, "up") else set())
        if scale.value.measure is Measure.HEIGHT and lies and not text.has("above", "over", "from"):  # where it is
            return _asked("how", Measure.CENTER_HEIGHT, at, scale.end, lies)
        measures, end = [scale.value.measure], scale.end
        while text.is_word(end, *_BY) and (more := text.find(end + 1 + text.is_word(end + 1, "how"), "scale")):
            measures, end = [*measures, more.value.measure], more.end  # 'how long and wide is …?'
        return Requested(at, end, tuple(measures), "how", used=frozenset(range(at, end)))
    free = (i for i in range(at + 2, at + 14) if i not in taken or not text.find(i, "noun"))  # a recess is not recessed
    ahead = (text.find(i, "reach") for i in free if text.is_word(at + 1, "far", "much"))
    if (reach := next(filter(None, ahead), None)) is not None:
        return _asked("reach", reach.value, at, at + 2, reach.tokens)
    into, going = ({i for i in text.at_words(*words) if at < i < at + 14} for words in (_INTO, _GOING))
    if text.is_word(at + 1, "far") and into and going:  # 'how far into the hub is the slot milled'
        return _asked("reach", Measure.DEPTH, at, at + 2, into | going)
    return None


def _said(text: Text, at: int, taken: set[int]) -> Requested | None:
    """What a verb asks for: 'weigh', 'stick out', 'where'."""
    verb = text.find(at, "verbs")
    named = verb is not None and any((span := text.find(i, "measure")) and span.end > verb.end for i in verb.tokens)
    if verb and at not in taken and not named:  # 'what does it measure across the flats'
        ways = {i for i in text.at_words("way", "direction") if text.find(i - 1, "ask")}
        ways |= text.at_words("how") if text.is_word(at, "oriented", "orientated") else set()
        if verb.value in _BY_VERB or (verb.value in _WHICH_WAY and ways):  # 'which way does the port face'
            return _asked("verb", verb.value, at, verb.end, ways)
    what = text.is_word(at, "measure") and any(text.is_word(i, "what", "does", "do") for i in range(at - 8, at))
    if what and at not in taken and not text.find(at + 1, "measure"):  # 'what does the arm measure end to end'
        return _asked("verb", Measure.MAGNITUDE, at, at + 1)
    if (reach := text.find(at, "reach")) and at not in taken and text.has("far", "much"):
        return _asked("reach", reach.value, at, reach.end)
    if where := text.find(at, "where"):
        span = text.find(text.skip(where.end, "be", "article"), "measure")
        if span and span.start not in taken and answer_type(span.value) is AnswerType.POINT:  # 'where is the tip of …'
            return Requested(at, span.end, (span.value,), "where", used=frozenset((*where.tokens, *span.tokens)))
        mouth = text.at_phrases("emerging") | text.at_words("meet", "leave", "enter", "pierce")
        if mouth and text.find(where.end, "do"):  # 'where does the axis of the bore meet the end face'
            return _asked("where", Measure.OPENING, at, where.end, mouth | text.at_words("axis", "through"))
        return _asked("where", Measure.POSITION, at, where.end)
    return None


def _named(text: Text, at: int, taken: set[int]) -> Requested | None:
    """A noun such as 'depth'; the adjective of 'slot, wide and deep?'."""
    span, noun = text.find(at, "measure") or _bare_scale(text, at, taken), text.find(at, "noun")
    if span is None or at in taken or (noun and noun.end > span.end) or text.find(at, "aside"):
        return None
    led = any(text.find(i, "axis_preposition") and not text.is_word(i, "in", "by") for i in range(at - 4, at))
    if span.value is Measure.AXIS and led and not text.find(at - 1, "ask"):
        return None  # 'along the screw axis' says how a length is taken
    verbs = [verb for verb in text.all("verbs") if verb.value in _WHICH_WAY]
    if span.value is Measure.DIRECTION and verbs and all(verb.value is Measure.APPROACH for verb in verbs):
        drilled = (i for verb in verbs for i in verb.tokens)  # 'from which direction is it drilled'
        return _asked("noun", Measure.APPROACH, span.start, span.end, drilled)
    return _of_measure(text, span, taken) or _joined_measures(text, span, taken)


def _bare_scale(text: Text, at: int, taken: AbstractSet[int] = frozenset()) -> Span | None:
    """'slot, wide and deep?', 'collar: diameter, thick?': an adjective that stands alone asks how much."""
    scale = text.find(at, "scale")
    if scale is None or scale.value.degree != "positive":
        return None
    last = scale.end >= len(text) or _ends(text, scale.end) or text.is_word(scale.end, "over", "from")
    behind = at - 1 in taken and not text.find(at - 1, "article", "adjective", "be")
    closed = any(text.find(i, "be", "do", "how") for i in range(at))
    stands_alone = last and not closed and (behind or _ends(text, at - 1))
    return replace(scale, value=scale.value.measure) if stands_alone else None


def _ends(text: Text, at: int) -> bool:
    """Does a symbol or an 'and' stand here?"""
    return text.is_word(at, "and", "plus") or text.is_kind(at, Kind.SYMBOL)


def _of_measure(text: Text, span: Span, taken: set[int]) -> Requested | None:
    """'position of the center of mass', 'center of mass position': the narrower of two measures is asked for."""
    of = text.is_word(span.end, "of")
    other = text.find(text.skip(span.end + of, "article") if of else span.end, "measure")
    if other is None or other.start in taken:
        return None
    wide, narrow = (span, other) if of else (other, span)
    same = wide.value is narrow.value is Measure.POSITION  # 'the coordinates of the centre of the bore'
    if not same and (wide.value not in _WIDE or answer_type(wide.value) is not answer_type(narrow.value)):
        return None
    deeper = _of_measure(text, other, taken) if same and of else None  # 'the position of the middle of the opening'
    end, value = (deeper.end, deeper.measures[0]) if deeper else (other.end, narrow.value)
    return _asked("noun", value, span.start, end)


def _both(text: Text, span: Span) -> tuple[int, list[Measure]] | None:
    """Two measures that share their last word, and where they begin: 'inner and (the) outer diameter'."""
    second = span.start if span.end - span.start == 2 else span.start - 1
    joint = second - 1 - text.is_word(second - 1, "the")
    if joint < 1 or not text.is_word(joint, "and", "&", "/"):
        return None
    named = (f"{text.words[at]} {text.words[span.end - 1]}" for at in (joint - 1, second))
    found = [dict(text.lexicon.phrases.get(phrase, ())).get("measure") for phrase in named]
    return (joint - 1, [measure for measure in found if measure]) if all(found) else None


def _joined_measures(text: Text, span: Span, taken: set[int]) -> Requested:
    """'length, width and height': several measures of one owner; a word before them may say what becomes of them."""
    measures, end = _listed(text, span)
    start, reduce = span.start, None
    if (both := _both(text, span)) is not None:  # 'inner and outer diameter'
        measures, start = [*both[1], *measures[1:]], both[0]
    while start - 1 not in taken and not text.is_word(start - 2, "i", "we", "you"):
        words = ((text.find(start - 1, category), meaning) for category, meaning in _REDUCES.items())
        meant = next((meaning for word, meaning in words if word is not None and word.end == start), None)
        if meant is None:
            break
        reduce, start = reduce or meant, start - 1
    side = text.find(start - 1, "adjective") if set(measures) <= _EXTENDING and start - 1 not in taken else None
    inside = {"inner": True, "outer": False}.get(side.value.name) if side is not None else None
    start -= inside is not None
    return Requested(start, end, tuple(measures), "noun", reduce, frozenset(range(start, end)), inside)


def _listed(text: Text, span: Span) -> tuple[list[Measure], int]:
    """The measure that is named here and those that are joined to it, and where the list ends."""
    measures, end = [span.value], span.end
    while True:
        after = end
        while text.is_word(after, *_JOINTS):
            after += 1
        after = text.skip(after, "article")
        again = after > end and text.find(after, "adjective") is not None and span.start > 0
        after += again and text.is_word(after, text.words[span.start - 1])  # 'inner length and inner width'
        if after > end and (extent := _extent_along(text, after, measures[-1])):
            measures, end = [*measures, extent.value], extent.end  # 'extents in x, y and z'
            continue
        more = text.find(after, "measure") or _bare_scale(text, after)
        if after == end or more is None or more.value in measures or text.find(after, "aside"):
            break
        of_others = more.value is Measure.ANGLE and text.is_word(more.end, "between")
        of_others |= answer_type(more.value) is answer_type(span.value) is AnswerType.POINT  # 'mouth, as coordinates'
        overall = text.is_word(after, "overall", "total") and not text.is_word(span.start, "overall", "total")
        alike = answer_type(more.value) is answer_type(measures[-1])  # not: 'the holes in the cone tips, Ø?'
        if of_others or overall or not (alike or text.is_word(end, "and", "&", "+")):
            break  # 'outer diameter and overall length'
        ahead = text.skip(more.end, "axis_preposition", "article")
        along = _extent_along(text, ahead, measures[-1]) if ahead > more.end else None
        last = along or more  # 'length along y, height along z'
        measures, end = [*measures, last.value], last.end
    lengths = [one for one in measures if one not in SIZES]
    named = len(lengths) > 1 or (lengths and text.is_word(span.end, ","))  # 'size, width by height' asks for two
    return lengths if named else measures, end


def _extent_along(text: Text, at: int, before: Measure) -> Span | None:
    """The extent that an axis stands for behind another extent."""
    axis = text.find(at, "axis") if before in EXTENTS else None
    return replace(axis, value=EXTENTS[axis.value]) if axis is not None and axis.value < len(EXTENTS) else None
