"""Related parts: what is asked of one part, and a part in it, at its end or around it has."""

from __future__ import annotations

from collections.abc import Iterator
from collections.abc import Set as AbstractSet
from dataclasses import replace

from querycad_contracts import Measure, PartKind, PartQuery, Place, Rank, Side
from querycad_language.forms import Get, Reduce, Target
from querycad_language.lexicon import lexicon
from querycad_language.measures import ENDS
from querycad_language.phrases import bare_of, placed_in, places_of, replace_fields
from querycad_language.readings.owners import CIRCLES, kinds_of
from querycad_language.readings.parses import Parse
from querycad_language.readings.question import Question, used_by
from querycad_language.readings.requested_measures import Requested
from querycad_language.text import Text

_ARRANGED = ("arranged", "distributed", "positioned", "located", "placed", "laid", "lie", "sit", "set", "spaced")
_INSIDE = (Measure.INNER_RADIUS, Measure.INNER_DIAMETER)
_OUTSIDE = (Measure.OUTER_RADIUS, Measure.OUTER_DIAMETER)
_BOLT_CIRCLE = PartQuery(noun="bolt circle", definite=True)
_OUTER_ENDS = ("rim", "edge", "end", "end face", "face", "top", "top face", "outer edge")
_FLANKS = ("flank", "side", "wall", "side wall")
_BOUNDS = {
    **dict.fromkeys((Measure.ANGLE, Measure.INCLUDED_ANGLE, Measure.DRAFT), _FLANKS),
    Measure.WIDTH: ("opening", "mouth", "entry", "entrance"),
    Measure.DIAMETER: ("bottom", "floor", "root", "base"),
}
"""What bounds a cut has its measure."""
_THERE: dict[Measure, dict[tuple[str, ...], Measure]] = {
    Measure.WIDTH: {
        ("mouth", "opening", "top", "rim"): Measure.MOUTH_WIDTH,
        ("bottom", "floor", "foot", "root", "base"): Measure.BOTTOM_WIDTH,
    },
    Measure.DIAMETER: {("mouth", "opening", "entry", "entrance"): Measure.MOUTH_WIDTH},
    Measure.RADIUS: {("outside",): Measure.OUTER_RADIUS, ("inside",): Measure.INNER_RADIUS},
    Measure.POSITION: {("surface", "face", "mouth", "underside", "wall", "plane"): Measure.OPENING},
}  # fmt: skip
"""What a measure is at one end or on one side, and the words for those, which follow one of these within so many."""
_AT, _NEAR = ("at", "on", "pierce", "enter", "meet", "cross", "leave", "cut", "hit", "exit"), 6
_OWNERS = {Measure.ROOT_DIAMETER: "gear", Measure.CENTRELINE_RADIUS: "bend", Measure.DRAFT: "cone"}
"""What has a measure that the whole has not."""


def of_related(question: Question, asked: Requested, get: Get, parse: Parse) -> Iterator[Parse]:
    """Of a related part: 'What is the top diameter of the spigot?', 'What inner diameter has the lever?'"""
    yield from _circle(question, asked, get, parse)
    yield from _root_fillet(question, get, parse)
    yield from _of_its_round(get, parse)
    yield from _of_its_side(get, parse)
    yield from _of_its_end(question, asked, get, parse)
    if get.target is not None:
        yield from _across(get.target, get, parse)
        yield from _there(question, get.target, get, parse)
        yield from _of_piece(question.text, get.target, get, parse)
    match get.measures:
        case (Measure.BOTTOM_THICKNESS,):  # 'the floor thickness of the tray'
            yield _of(replace(get, measures=(Measure.THICKNESS,)), parse, PartQuery(noun="floor", definite=True))
        case (Measure.ACROSS_FLATS,) if get.target is None and question.text.has("allen"):  # 'what allen key fits it'
            yield _of(get, parse, PartQuery(noun="hex socket", words=("hex", "socket"), definite=True))
        case (measure,) if measure in _OWNERS and (get.target is None or measure is Measure.ROOT_DIAMETER):
            yield _of(get, parse, PartQuery(noun=_OWNERS[measure], definite=True))


def _of(get: Get, parse: Parse, target: PartQuery, *features: str, used: AbstractSet[int] = frozenset()) -> Parse:
    """What is asked of another part instead, with features for it and the further words that it reflects."""
    return Parse(replace(get, target=target), parse.features | dict.fromkeys(features, 1.0), parse.used | used)


def _of_piece(text: Text, target: PartQuery, get: Get, parse: Parse) -> Iterator[Parse]:
    """'The wall of the standoff', 'the centre of the sleeve's lower rim', 'the surface of the lever'."""
    match get.measures:
        case (Measure.AREA | Measure.MAGNITUDE | Measure.SIZE,) if bare_of(target, "surface", "face"):
            yield Parse(Get((Measure.AREA,), None), {**parse.features, "topology": 1.0}, parse.used)  # 'all faces'
        case (Measure.THICKNESS,) if target.noun == "wall" and not target.adjectives:
            for _, of in places_of(target, "of", "around", "")[:1]:  # 'the thickness of the wall of the standoff'
                yield _of(replace(get, measures=(Measure.WALL_THICKNESS,)), parse, of, "its_walls")
        case (Measure.THICKNESS,) if target.noun in ("roof", "floor", "top", "bottom", "end wall", "crown"):  # of a cap
            yield _of(replace(get, measures=(Measure.BOTTOM_THICKNESS,)), parse, within(None), "closes_inside")
        case (Measure.POSITION,) if (cut := floored(target)) is not None:
            yield _of(replace(get, measures=(Measure.FLOOR_CENTER,)), parse, cut)
        case (Measure.POSITION,) if target.noun in _BOUNDS[Measure.WIDTH]:  # 'the middle of the slot's opening'
            for cut in [cut for _, cut in places_of(target, "of", "") if is_cut(cut)] or [target] * bool(target.sides):
                mouth = replace_fields(cut, sides=cut.sides or target.sides)
                yield _of(replace(get, measures=(Measure.OPENING,)), parse, mouth, "its_end")
        case (Measure.POSITION,) if target.noun in _OUTER_ENDS:  # 'the middle of the left end of the spindle'
            sides = (*target.ends, *target.sides, *(rank.side for rank in target.ranks if rank.side is not None))
            end = next((measure for measure, side in ENDS.items() if side in sides[:1]), Measure.TIP)
            for _, holder in places_of(target, "of")[:1]:
                yield _of(replace(get, measures=(end,)), parse, holder, "its_end")
        case (Measure.INCLUDED_ANGLE,) if PartKind.HOLE in kinds_of(target):  # 'the point angle at the hole's bottom'
            point = PartQuery(noun="conical bottom", words=("conical", "bottom"), definite=True)
            yield _of(get, parse, placed_in(point, "of", target), "its_end", used=text.at_words("bottom"))
        case (Measure.LENGTH,) if said := text.covered("center_to_center") | text.at_words("straight"):
            # 'how long is the keyway between its arc centres?', 'the length of the straight part'
            part = replace_fields(target, adjectives=tuple(name for name in target.adjectives if name != "straight"))
            yield _of(replace(get, measures=(Measure.CENTRE_LENGTH,)), parse, part, "there", used=said)


def _circle(question: Question, asked: Requested, get: Get, parse: Parse) -> Iterator[Parse]:
    """'On what diameter are the studs arranged?' asks for that of the circle that they stand on."""
    text, target = question.text, get.target
    if target is None:
        return
    leads = {i for i in range(asked.start - 3, asked.start) if text.is_word(i, "on", "at", "around")}
    is_round = get.measures[0] in (Measure.DIAMETER, Measure.RADIUS)
    asked_on = {i for i in leads if text.is_word(i, "on") and text.find(i + 1, "ask")}  # 'on which diameter are they?'
    if is_round and target.noun in CIRCLES and not target.places:
        links = text.at_words("on", "through", "which", "do", "are")  # 'on which the studs stand', 'through the holes'
        for mention in [one for one in question.parts if any(asked.end <= i < one.start for i in links)][:1]:
            on = placed_in(replace_fields(target, noun="bolt circle"), "", mention.part)
            yield _of(get, parse, on, used=mention.used | text.at_words("on", "through", "which"))
    if get.measures == (Measure.PITCH_DIAMETER,) and target.noun != "gear":
        yield _of(replace(get, measures=(Measure.DIAMETER,)), parse, placed_in(_BOLT_CIRCLE, "", target))
    if leads and is_round and (said := text.at_words(*_ARRANGED) | asked_on):
        circle = replace_fields(_BOLT_CIRCLE, places=(Place(relation="", what=target),))
        yield _of(replace(get, reduce=Reduce.ONE), parse, circle, "arranged", used=leads | said)


def _root_fillet(question: Question, get: Get, parse: Parse) -> Iterator[Parse]:
    """'The radius between hub and flange', 'the radius where the arm meets the boss': of the fillet there."""
    text = question.text
    between = text.at_words("between") | (text.at_words("where") - {0})
    if get.measures != (Measure.RADIUS,) or not between or text.has("blend"):
        return
    ends = [m for m in question.parts if m.start > min(between)][:2]
    meeting = [*(m.part for m in ends), *(what for m in ends[:1] for _, what in places_of(m.part))][:2]
    if len(meeting) == 2:
        fillet = PartQuery(noun="fillet", words=("fillet",), definite=True)
        fillet = placed_in(placed_in(fillet, "on", replace_fields(meeting[0], places=())), "on", meeting[1])
        used = between | text.at_words("meet", "join", "and", "to") | used_by(*ends)
        yield _of(get, parse, fillet, "its_end", used=used)


def _of_its_round(get: Get, parse: Parse) -> Iterator[Parse]:
    """'The inner diameter of the clamp' is that of its largest bore; 'the wall thickness' of all its walls."""
    noun = lexicon().nouns.get(get.target.noun) if get.target is not None else None
    whole = get.target is None or (noun is not None and (noun.product or "model" in noun.senses[0].kind))
    if whole and get.measures == (Measure.WALL_THICKNESS,):
        wall = PartQuery(noun="wall", words=("wall",), definite=True)
        yield Parse(Get((Measure.THICKNESS,), wall), {**parse.features, "its_walls": 1.0}, parse.used)
    sides = ((_INSIDE, "bore"), (_INSIDE, "inner cylinder"), (_OUTSIDE, "outer cylinder"))
    for measures, name in sides if whole else ():
        if get.measures[0] in measures and len(get.measures) == 1:
            largest = PartQuery(noun=name, words=(name,), definite=True, ranks=(Rank(measure=Measure.DIAMETER),))
            largest = largest if get.target is None else placed_in(largest, "of", get.target)
            measure = Measure.DIAMETER if measures.index(get.measures[0]) else Measure.RADIUS
            yield _of(replace(get, measures=(measure,)), parse, largest, "its_round")


def _of_its_side(get: Get, parse: Parse) -> Iterator[Parse]:
    """'The outer bend radius' is the outer radius of the bend."""
    pairs = {Measure.RADIUS: (_INSIDE[0], _OUTSIDE[0]), Measure.DIAMETER: (_INSIDE[1], _OUTSIDE[1])}
    if get.target is None or len(get.measures) > 1 or "link_compound" not in parse.features:
        return
    for tag, measure in zip(("inner", "outer"), pairs.get(get.measures[0], ()), strict=False):
        kept = tuple(name for name in get.target.adjectives if tag not in lexicon().adjectives[name].tags)
        if kept != get.target.adjectives:
            yield _of(replace(get, measures=(measure,)), parse, replace_fields(get.target, adjectives=kept))


def _across(target: PartQuery, get: Get, parse: Parse) -> Iterator[Parse]:
    """'How wide is the pulley?', 'the width of the mouth of the slot', 'the angle of the flanks of the groove'."""
    match get.measures:
        case measures if Measure.WIDTH in measures and target.noun in lexicon().turning:
            along = (Measure.AXIAL_EXTENT if one is Measure.WIDTH else one for one in measures)
            yield _of(replace(get, measures=tuple(along)), parse, target, "turning")
        case (Measure.WIDTH,) if (cut := floored(target)) is not None:  # 'how wide is the floor of the groove'
            yield _of(replace(get, measures=(Measure.BOTTOM_WIDTH,)), parse, cut)
        case (Measure.INNER_RADIUS | Measure.OUTER_RADIUS | Measure.RADIUS,) if target.noun in ("inside", "outside"):
            said = _INSIDE[0] if target.noun == "inside" else _OUTSIDE[0]  # 'the radius on the inside of the bend'
            for _, bend in places_of(target, "of")[:1]:
                yield _of(replace(get, measures=(said,)), parse, bend, "there")
        case (measure,) if target.noun in _BOUNDS.get(measure, ()):
            for _, holder in places_of(target, "of", ""):
                if is_cut(holder):
                    yield _of(get, parse, holder, "its_end")
                elif measure in (Measure.ANGLE, Measure.DRAFT):  # of the flanks of a tongue
                    yield _of(replace(get, measures=(Measure.DRAFT,)), parse, holder, "its_end")


def _there(question: Question, target: PartQuery, get: Get, parse: Parse) -> Iterator[Parse]:
    """'How wide is the dovetail at its mouth?', 'the radius on the outside of the bend'."""
    text = question.text
    low = {i for i in text.at_words("bottom") - parse.used if text.is_word(i + 1, "of") or text.is_possessive(i - 1)}
    if low and is_cut(target) and get.measures == (Measure.POSITION,):
        yield _of(replace(get, measures=(Measure.FLOOR_CENTER,)), parse, target, used=low)  # 'the hole's bottom'
    for words, measure in _THERE.get(get.measures[0], {}).items():
        led = ((i, at) for i in text.at_words(*_AT) for at in text.at_words(*words) if i < at <= i + _NEAR)
        for start, end in sorted(led)[:1]:
            faced = tuple(side.value for side in text.all("side") if start <= side.start <= end)
            sides = faced if measure is Measure.OPENING else ()  # 'its centre on the bottom face'
            form = replace(get, measures=(measure,), target=replace_fields(target, sides=sides))
            said = {name: value for name, value in parse.features.items() if not name.startswith("link_")}
            named = used_by(*(m for m in question.parts if m.start <= end < m.end))
            yield Parse(form, said | {"link_of": 1.0, "there": 1.0}, parse.used | {*range(start, end + 1)} | named)


def _of_its_end(question: Question, asked: Requested, get: Get, parse: Parse) -> Iterator[Parse]:
    """'The top diameter of the cone', 'the diameter of the knob at its bottom': of the face there."""
    target, text = get.target, question.text
    behind = text.find(text.skip(asked.end + 1, "article"), "side") if text.is_word(asked.end, "at", "on") else None
    before = text.find(asked.start - 1, "side") or behind
    sides: tuple[Side, ...] = (before.value,) if before is not None else ()
    if target is not None and not sides and text.has("at") and set(target.sides) <= {Side.TOP, Side.BOTTOM}:
        sides = target.sides
    owned = target is None and behind is not None and text.is_word(behind.end, "of")
    round_ones = (Measure.DIAMETER, Measure.RADIUS, *_INSIDE, *_OUTSIDE)
    hollow = is_cut(target) or (target is not None and target.noun in CIRCLES)
    if get.measures[0] not in round_ones or len(sides) != 1 or owned or hollow:
        return
    said = set(before.tokens) if before is not None else set()
    if get.measures[0] is Measure.RADIUS and target is not None:  # 'R at the top of the lugs'
        ends = PartQuery(noun="rounded end", adjectives=("outer",), definite=True)
        yield _of(get, parse, placed_in(ends, "on", replace_fields(target, sides=())), "its_end", used=said)
    face = PartQuery(noun="face", words=("face",), sides=sides, definite=True)
    face = face if target is None else placed_in(face, "of", replace_fields(target, sides=()))
    yield _of(get, parse, face, "its_end", used=said)


def within(target: Target) -> PartQuery:
    """The space within a part; a cut is such a space itself."""
    if target is None:
        return PartQuery(noun="inside", words=("inside",), definite=True)
    return target if is_cut(target) else placed_in(within(None), "of", target)


def is_cut(target: Target) -> bool:
    """Is it a space, not what is around one?"""
    kinds = kinds_of(target)
    return bool(kinds) and all(PartKind(kind).cuts_in or kind in ("ring", "pipe", "cavity") for kind in kinds)


def floored(query: PartQuery) -> PartQuery | None:
    """The cut of 'the floor of the keyway', 'the bottom of the groove', 'the counterbore floor'."""
    whose, _, piece = query.noun.rpartition(" ")
    if piece in ("floor", "bottom") and is_cut(one := replace_fields(query, noun=whose, words=(whose,))):
        return one  # 'the pocket floor'
    if query.noun not in ("floor", "bottom", "ground", "base", "flat bottom", "flat floor"):
        return None
    said = [PartQuery(noun=name, words=(name,)) for name in query.adjectives if name in lexicon().nouns]
    return next((cut for _, cut in places_of(query, "of", "below", "")), next(iter(said), None))


def rimmed(query: PartQuery) -> PartQuery | None:
    """The cut of 'the rim of the bore', 'the edge of the slot': a distance between surfaces begins there."""
    named = {"rim", "edge", "border", "wall", "outline", "flank", "side"} & {*query.noun.split()[-1:]}
    return next((cut for _, cut in places_of(query, "of") if named), None)
