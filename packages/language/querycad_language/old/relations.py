"""Modifiers that relate parts to other parts or to the model: closest to, above, in, deeper than, centred."""

from __future__ import annotations

from collections.abc import Callable
from typing import TypeAlias

from querycad_contracts import Side

from . import modifiers
from .draft import Draft
from .lexicon import LEXICON
from .meaning import (
    Bound,
    ByDistance,
    ByPlace,
    Centered,
    Get,
    Measure,
    Origin,
    Phrase,
    Placed,
    Rank,
    Relation,
    Selection,
    Target,
    Whole,
    Within,
)
from .text import Text
from .tokens import Kind

Nested: TypeAlias = Callable[[Text, int, int], Target | None]
"""Reads the noun phrase that a modifier holds."""

_AXES = "xyz"
_WITHIN = "A part counts as in another one when its centre lies in the other's box."


def of_whole(text: Text, start: int, end: int) -> int | None:
    """Where does 'of the (whole) object' end that stands at `start`? None when it does not stand there."""
    at = text.after("whole_of", start, end)
    return None if at is None else whole_noun(text, at, end)


def whole_noun(text: Text, start: int, end: int) -> int | None:
    """Where does 'the entire CAD model' end that stands at `start`?"""
    at = text.skip(start, end, "article", "quantifier")
    while True:
        noun = text.match("whole", at, end)
        adjective = text.after("whole_adjective", at, end)
        if noun and text.words[at] in ("this", "it") and modifiers.starts_noun(text, noun[1], end):
            return None  # 'this heat sink'
        if noun and not (adjective and text.match("whole", adjective, end)):
            return None if text.word_at(at, end, "solid") and _is_name(text, noun[1], end) else noun[1]
        if adjective is None:
            alone = not modifiers.starts_noun(text, at, end)
            return start if at > start and text.words[at - 1] in ("this", "it") and alone else None
        at = adjective


def _is_name(text: Text, at: int, end: int) -> bool:
    """Is the word at `at` one that parts are named with: 'solid standoffs'?"""
    if at >= end or text.tokens[at].kind is not Kind.WORD:
        return False
    return (
        text.words[at] not in LEXICON.words
        or LEXICON.match("noun", (LEXICON.singular(text.words[at]),), 0, 1) is not None
    )


def without_axis(text: Text) -> tuple[Text, int | None]:
    """The text without '… along the x axis', 'in y direction', 'along the width of the object', and that axis."""
    end = len(text.tokens)
    for at in range(end):
        if "centered" in text.words[max(0, at - 3) : at]:
            continue
        found = text.match("axis", at, end) if text.match("axis_adverb", at, end) else None
        if found is None and (after := text.after("axis_preposition", at, end)):
            found = text.match("axis", text.skip(after, end, "article"), end)
        if found is None:
            continue
        if text.words[found[1] - 1] in ("vertical", "horizontal") and modifiers.starts_noun(text, found[1], end):
            continue  # 'in the vertical leg'
        of_part = text.word_at(found[1], end, "of") and text.match("article", found[1] + 1, end)
        if of_part and text.word_at(at, end, "along"):
            stop = _end_of_noun(text, text.skip(found[1] + 1, end), end)  # 'along the width of the cover'
            return text.rearranged([*range(at), *range(stop, end)]), int(found[0])
        lettered = text.words[found[1] - 1] in _AXES  # 'the width in x of the pin', but not 'the width of the pin'
        if text.word_at(found[1], end, "of") and not lettered and not of_whole(text, found[1], end):
            continue
        if text.match("axis_vague", at, end) and text.words[found[1] - 1] not in ("axis", "direction"):
            continue
        stop = text.skip(found[1], end, "side_noun")
        stop = of_whole(text, stop, end) or stop
        return text.rearranged([*range(at), *range(stop, end)]), int(found[0])
    return text, None


def bound_by_part(text: Text, start: int, end: int, nested: Nested) -> tuple[Bound, int] | None:
    """'deeper than the M5 hole', 'with the same diameter as the shaft', 'as deep as the pocket'."""
    at = text.skip(start, end, "lead")
    compared = modifiers.comparative(text, at, end)
    if compared:
        measure, relation, after = compared
    else:
        same = text.after("same", at, end)
        found = text.match("property", same, end) if same else None
        if found is None and text.word_at(at, end, "as"):
            found = text.match("scale.positive", at + 1, end)
        if found is None or not text.word_at(found[1], end, "as", "like"):
            return None
        measure, relation, after = Measure(found[0]), Relation.EQUAL, found[1] + 1
    while text.word_at(after, end, "that", "those", "of", "the"):
        after += 1
    reference = None if text.number(after, end) else nested(text, after, end)
    return (Bound(measure, relation, Get((measure,), reference)), end) if reference is not None else None


def nearness(text: Text, at: int, end: int, draft: Draft, nested: Nested) -> int | None:
    """'closest to the shaft', 'nearest the edge', 'farthest from the centre of the object'."""
    found = text.match("near", text.skip(at, end, "lead"), end)
    if found is None or not (draft.words or text.word_at(found[1] - 1, end, "to", "from")):
        return None
    rest = text.skip(found[1], end, "article")
    point = text.after("center", rest, end)
    reference: Target | Origin | None
    side = text.match("side", rest, end)
    stop = text.skip(side[1], end, "side_noun", "edge") if side else end
    if side is not None and (of_whole(text, stop, end) or stop) >= end:  # 'nearest to the front'
        outward = Side(side[0]).outward
        axis = next(i for i, value in enumerate(outward) if value)
        draft.ranks.append(Rank(ByPlace(axis), (outward[axis] > 0) == (found[0] == "near")))
        return draft.close(end)
    if text.match("edge", rest, end):
        reference = None
    elif text.match("origin", rest, end):
        reference = Origin()
    elif rest == end or (point is not None and (point == end or of_whole(text, point, end) is not None)):
        reference = Whole()
    else:
        reference = nested(text, rest, end)
        if reference is None:
            return None
    draft.ranks.append(Rank(ByDistance(reference), found[0] == "far"))
    return draft.close(end)


def place(text: Text, at: int, end: int, draft: Draft, nested: Nested) -> int | None:
    """'above the middle', 'left of the shaft', 'centred in x and y', 'in the upper half of the object'."""
    if draft.in_tail:
        return None
    start = at
    if text.word_at(start, end, "have", "has", "with") and text.word_at(start + 1, end, "their", "its", "the"):
        start += 1
    if text.word_at(start, end, "whose", "with", "its", "their", "the") and (
        center := text.after("center", start + 1, end)
    ):
        start = text.skip(center, end, "be", "verb", "light")
    start = text.skip(start, end, "verb")
    if found := text.match("place", start, end):
        axis, relation = _AXES.index(found[0][1]), Relation.MORE if found[0][0] == "+" else Relation.LESS
        return _beyond(text, found[1], end, draft, nested, axis, relation)
    if half := _half(text, start, end):
        draft.filters.append(half[0])
        return draft.close(half[1])
    return _centered(text, start, end, draft)


def _beyond(
    text: Text, start: int, end: int, draft: Draft, nested: Nested, axis: int, relation: Relation
) -> int | None:
    """What follows 'above', 'left of': the middle of the model, or a part."""
    rest = text.skip(start, end)
    if text.number(rest, end) or text.word_at(rest, end, "ground"):
        return None
    point = text.after("center", rest, end)
    whole = of_whole(text, point, end) if point else None
    if point and (whole is not None or not text.word_at(point, end, "of")):
        draft.filters.append(Placed(axis, relation, Whole()))
        return draft.close(whole or point)
    reference = nested(text, point + 1 if point else rest, end)
    if not isinstance(reference, Selection) or not draft.words:
        return None
    draft.filters.append(Placed(axis, relation, reference))
    return draft.close(end)


def _half(text: Text, start: int, end: int) -> tuple[Placed, int] | None:
    """'in the left half of the object'."""
    at = text.skip(text.skip(start, end, "side_preposition"), end, "article")
    side = text.match("side", at, end)
    after = text.after("half", side[1], end) if side else None
    if side is None or after is None:
        return None
    outward = Side(side[0]).outward
    axis = next(i for i, value in enumerate(outward) if value)
    relation = Relation.MORE if outward[axis] > 0 else Relation.LESS
    return Placed(axis, relation, Whole()), of_whole(text, after, end) or after


def _centered(text: Text, start: int, end: int, draft: Draft) -> int | None:
    """'centred in x and y direction', 'in the middle of the object'."""
    led = text.skip(start, end, "lead") if draft.words else start
    after = text.after("centered", start, end) or text.after("centered", led, end)
    if after is None:
        return None
    axes: list[int] = []
    rest = text.skip(after, end, "axis_preposition", "article")
    while found := text.match("axis", rest, end):
        axes.append(int(found[0]))
        after = found[1]
        rest = text.skip(after, end, "conjunction", "axis_preposition", "article")
    after = text.skip(after, end, "side_noun") if axes else after
    draft.filters.append(Centered(tuple(axes)))
    return draft.close(of_whole(text, after, end) or after)


def owner(text: Text, at: int, end: int, draft: Draft, nested: Nested) -> int | None:
    """'(how many holes) does the flange have', '(how many holes) has the top of the object'."""
    verb = text.after("do", at, end) or (at + 1 if text.word_at(at, end, "has", "have") else None)
    if verb is None or not draft.words or not text.match("article", verb, end):
        return None
    noun = text.skip(verb, end)  # 'the stand' is no verb
    have = next((i for i in range(end - 1, noun, -1) if text.match("have", i, end)), end)
    named = modifiers.sides(text, verb, have)
    if named and (of_whole(text, named[1], have) or named[1]) >= have:
        draft.sides.extend(named[0].sides)
        return draft.close(end)
    stop = _end_of_noun(text, noun, have)
    whole = whole_noun(text, verb, have)
    if whole is not None and whole > noun:
        return draft.close(whole if whole < have else end if have == end else have + 1)
    after = stop if stop < have else end if have == end else have
    return _inside(text, draft, nested(text, verb, stop), after)


def within(text: Text, at: int, end: int, draft: Draft, nested: Nested) -> int | None:
    """'in the flange', 'of the base plate': the part lies within another part.

    What follows the other part's own words is said of the first one: 'holes in the flange that are 5 mm deep'.
    """
    inside = text.after("container", at, end)
    if inside is None or not draft.words or draft.in_tail:
        return None
    adjectives = all(LEXICON.match("shape_adjective", (word,), 0, 1) for word in draft.words)
    if adjectives and not draft.closed and text.word_at(at, end, "inside"):
        return None  # 'the rectangular inside of the box'
    link = text.words[at] if text.words[at] in ("on", "at") else "in"
    noun = text.skip(inside, end, "article", "each")
    if noun == inside:
        return None
    place = text.after("border", noun, end)
    if place is not None and (place >= end or text.word_at(place, end, "of", ",")):
        if text.word_at(noun, end, "corner", "corners"):
            draft.words.insert(0, "corner")
        else:
            text.leave_out(at, place)
        if place >= end or not text.word_at(place, end, "of"):
            return draft.close(place)
        inside, noun = place + 1, text.skip(place + 1, end, "article", "each")
    else:
        place = None
    stop = _end_of_noun(text, noun, end)
    holder = nested(text, inside, stop)
    if place is not None:
        return draft.close(stop) if isinstance(holder, Whole) or holder is None else _inside(text, draft, holder, stop)
    return _inside(text, draft, holder, stop, link)


def between(text: Text, at: int, end: int, draft: Draft, nested: Nested) -> int | None:
    """'the arcs between the slots', 'the web between the hub and the rim': SegCAD looks where they lie."""
    if not text.word_at(at, end, "between") or not draft.words or draft.in_tail or text.number(at + 1, end):
        return None
    stop = _end_of_noun(text, text.skip(at + 1, end, "article", "each"), end)
    first = nested(text, at + 1, stop)
    if not isinstance(first, Selection) or len(first.phrases) > 1:
        return None
    places = [first.phrases[0].description]
    if text.word_at(stop, end, "and") and not first.plural:
        after = _end_of_noun(text, text.skip(stop + 1, end, "article", "each"), end)
        second = nested(text, stop + 1, after)
        if not isinstance(second, Selection):
            return None
        places.append(second.phrases[0].description)
        stop = after
    elif not first.plural:
        return None
    draft.located += ["between", *" and ".join(places).split()]
    return draft.close(stop)


def _end_of_noun(text: Text, noun: int, end: int) -> int:
    """Where do the words of a noun phrase end that begins at `noun`? A side before the noun belongs to it."""
    lead = modifiers.sides(text, noun, end, verbs=False)
    stop = lead[1] if lead and not lead[0].noun and modifiers.starts_noun(text, lead[1], end) else noun
    stops = ("verb", "light", "conjunction", "lead")
    while stop < end and not modifiers.sides(text, stop, end):
        as_noun = text.match("noun_verb", stop, end)
        if any(text.match(c, stop, end) for c in stops) and not (as_noun and stop == noun):
            break
        stop += 1
    return stop


def _end_named(phrase: Phrase) -> tuple[str, ...]:
    """'upper', where the phrase means the one at that end: SegCAD knows 'the upper plate' by name or place."""
    if len(phrase.ranks) != 1 or not isinstance(phrase.ranks[0].order, ByPlace):
        return ()
    axis, largest = phrase.ranks[0].order.axis, phrase.ranks[0].largest
    return ((("left", "right"), ("front", "back"), ("lower", "upper"))[axis][largest],)


def _inside(text: Text, draft: Draft, holder: Target | None, after: int, link: str = "in") -> int | None:
    """The place goes into the description where words can say it, else into a filter."""
    if not isinstance(holder, Selection):
        return None
    text.note(_WITHIN)
    phrase = holder.phrases[0]
    end = _end_named(phrase)
    if len(holder.phrases) == 1 and not phrase.filters and (not phrase.ranks or end) and len(phrase.sides) < 2:
        draft.plural = draft.plural or phrase.plural  # 'the bore of the counterbored holes': one each
        words = phrase.description.removeprefix("whole ").split()
        draft.located += [link, *end, *(side.value for side in phrase.sides), *words]
        return draft.close(after)
    draft.plural = draft.plural or holder.plural
    draft.filters.append(Within(holder))
    return draft.close(after)
