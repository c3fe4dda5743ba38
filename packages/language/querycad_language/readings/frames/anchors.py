"""Anchors: parts, planes and places that a distance can be measured from."""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from itertools import pairwise
from typing import Literal, NamedTuple, TypeAlias

from querycad_contracts import Measure, PartQuery, Side
from querycad_language.forms import LONGEST, SHORTER, Anchor, Boundary, MassCentre, Origin, Plane, Target
from querycad_language.lexicon import lexicon
from querycad_language.measures import ENDS
from querycad_language.phrases import Mention, placed_in, places_of, replace_fields, without
from querycad_language.readings.question import Question
from querycad_language.text import Text

from .related_parts import floored, is_cut, rimmed

_ROUND_WALLS = {Measure.OUTER_DIAMETER: "outer cylinder", Measure.INNER_DIAMETER: "inner cylinder"}
WHOLE = PartQuery(noun="object", words=("object",))
_ENDS = ("end", "end face")
_RIMS = ("rim", "edge", "border", "outline", "outer edge", "plate edge", "outside edge")
NEAREST = ("nearest", "closest", "nearer", "closer")
End: TypeAlias = PartQuery | Boundary | Literal["each other"]


def ends_between(query: Target) -> Iterator[tuple[PartQuery, End]]:
    """The two ends of 'the gap between the nut and the lever', 'the web between the slots'."""
    for _, first in places_of(query, "between"):
        one, second = floored(first) or first, next(iter(first.also), None)
        edge = second is not None and _is_edge(second)  # 'between the floor of the pocket and the slot'
        end: End = Boundary(None) if edge else (second and floored(second)) or second or "each other"
        yield replace_fields(one, also=(), plural=one.plural or second is None), end


def pairs_named(parts: Sequence[Mention], *relations: str) -> list[tuple[PartQuery, PartQuery, frozenset[int]]]:
    """Every two parts named one after the other, and what stands in such a relation to another: 'the pin in the hub'.

    With the tokens that name both.
    """
    placed = [(without(m.part, at), what, m.used) for m in parts for at, what in places_of(m.part, *relations)]
    return [*((a.part, b.part, a.used | b.used) for a, b in pairwise(parts)), *placed]


class Spot(NamedTuple):
    """An anchor, where it is named, and the tokens that name it."""

    at: int
    anchor: Anchor
    used: set[int]
    mate: bool = False  # is it the bore for what is named: 'the motor axis' of a mount?

    @property
    def placed(self) -> bool:
        """Is it more than a border or the origin: a part, a plane of one, the centre of mass?"""
        return isinstance(self.anchor, PartQuery | Plane | MassCentre)


def anchors_of(question: Question) -> list[Spot]:
    """All that a distance can be measured from, from left to right."""
    text = question.text
    found: list[Spot] = []
    for mention in question.parts:
        query, used = mention.part, set(mention.used)
        edges = [span for span in text.all("edge") if span.end == mention.start - 1 and text.is_word(span.end, "of")]
        used |= {i for one in edges if is_cut(query) for i in (*one.tokens, one.end)}  # 'the edge of the hole'
        found.append(Spot(mention.head, query, used))
        noun = text.lexicon.nouns.get(query.noun)
        members = places_of(query, "", "of") if noun is not None and noun.senses[0].kind == ("pattern",) else ()
        found += [Spot(mention.head, replace_fields(member, plural=True), used) for _, member in members]
        body = noun is not None and (noun.product or "body" in noun.senses[0].kind)
        if body and text.is_word(mention.end, "axis", "center", "centerline") and not (query.places or query.sizes):
            bore = PartQuery(noun="bore", words=("bore",), definite=True)
            found.append(Spot(mention.head, bore, {*used, mention.end}, mate=True))
        if (ground := text.find(mention.head, "ground")) and not (query.places or query.adjectives):
            found.append(Spot(mention.head, Boundary(ground.value), used))  # 'how high above the floor'
        if query.noun in _ENDS and not (query.places or query.adjectives or query.unknown or query.ranks):
            found += [Spot(mention.head, Plane(None, owner), used) for owner in _owners(question, mention.head)]
        others = (floored(query) or rimmed(query), plane_of(query))
        found += [Spot(mention.head, other, used) for other in others if other is not None]
    free = set(range(len(text))).difference(*(spot.used for spot in found))
    found += [spot for at in sorted(free) if (spot := _of_model(text, at))]
    found += [*planes_of(question), *_nearer_ends(question), *_outsides(question)]
    return sorted(found, key=lambda one: one.at)


def plane_of(query: PartQuery) -> Plane | Boundary | None:
    """Of 'the top face of the flange', 'the left face', 'the floor of the slot': the plane that is meant."""
    side = next(iter((*query.ends, *query.sides)), None)
    around = rimmed(query) if query.noun in _RIMS else None
    if _is_edge(query) or (around is not None and not is_cut(around)):  # 'the outer rim of the flange'
        return Boundary(None)
    if (cut := floored(query)) is not None:
        return Plane(Side.BOTTOM, cut)
    whose, _, piece = query.noun.rpartition(" ")
    if piece == "end" and whose in lexicon().nouns:  # 'the shaft end'
        return Plane(side, PartQuery(noun=whose, words=(whose,), definite=True))
    if query.noun not in ("face", "surface", "end", "end face", "side face", "flat face"):
        return None
    return next((Plane(side, holder) for _, holder in places_of(query)), Boundary(side) if side is not None else None)


def _owners(question: Question, at: int) -> list[PartQuery]:
    """Whose is 'its end'? What is named before may have it, or what that is in."""
    before = [mention.part for mention in question.parts if mention.head < at and mention.part.noun not in _ENDS]
    holders = [what for part in before[-1:] for _, what in places_of(part)]
    return [*holders, *before[-1:], *(before[:1] if len(before) > 1 else ()), WHOLE]


def _is_edge(query: PartQuery) -> bool:
    """'the edge', but no edge of a part."""
    return not query.places and any(category == "edge" for category, _ in lexicon().phrases.get(query.noun, ()))


def _of_model(text: Text, at: int) -> Spot | None:
    """What a word means of the model: its edge, its origin, the ground it stands on, one of its sides."""
    if edge := text.find(at, "edge"):
        joining = text.is_word(at, "edge") and text.is_word(edge.end, "to")  # 'edge to edge'
        return None if joining else Spot(at, Boundary(None), set(edge.tokens))
    if text.is_word(at, "outside") and text.is_word(at - 1, "and", "to"):
        return Spot(at, Boundary(None), {at})  # 'between the bore and outside'
    if (measure := text.find(at, "measure")) and measure.value is Measure.CENTER_OF_MASS:
        return Spot(at, MassCentre(), set(measure.tokens))
    if (middle := _box_middle(text, at)) is not None:
        return Spot(at, None, middle)
    if span := text.find(at, "origin", "ground"):
        return Spot(at, Origin() if span.category == "origin" else Boundary(span.value), set(span.tokens))
    side, leading = text.find(at, "side"), ("article", "side_preposition", "place")
    paired = text.is_word(at - 1, "and") and text.find(at - 2, "side")
    if side and (at == 0 or text.find(at - 1, *leading) or text.is_possessive(at - 1) or paired):  # 'the left side'
        return Spot(at, Boundary(side.value), set(range(at, text.skip(side.end, "side_noun"))))
    return None


def _box_middle(text: Text, at: int) -> set[int] | None:
    """'from the centre', 'the middle of the part', 'the bounding box centre': that of the whole model."""
    if not text.is_word(at, "center", "middle", "midpoint"):
        return None
    behind = text.skip(at + 2, "article") if text.is_word(at + 1, "of") else at
    boxes = (span for span in text.all("boxes") if span.end == at)
    if (around := next(boxes, text.find(behind, "boxes", "whole"))) is not None:
        return {at, *range(at, behind), *around.tokens}
    alone = behind == at and not text.find(at + 1, "noun", "adjective", "measure")  # not 'to the centre hole'
    return {at} if alone and text.is_word(at - 1, "the") and text.is_word(at - 2, "from", "to", "off") else None


def _outsides(question: Question) -> Iterator[Spot]:
    """'the flange's outside diameter', 'the outer diameter of the hub', 'the outside of the hub': its outer wall."""
    text = question.text
    spans = [(one.start, one.end, _ROUND_WALLS[one.value]) for one in text.all("measure") if one.value in _ROUND_WALLS]
    outsides = (at for at in text.at_words("outside", "exterior") if text.is_word(at + 1, "of"))
    spans += [(at, at + 1, "outer cylinder") for at in outsides]
    for start, end, noun in spans:
        behind = question.phrases.at(end + 1, 1) if text.is_word(end, "of") else None
        owner = behind or next((m for m in question.parts if m.head < start <= m.end + 1), None)
        inner = question.phrases.at(start - 1, 1, joined=False) if owner is not behind else None
        owner = inner if inner is not None and inner.end == start and inner.query is not None else owner
        if owner is not None and owner.query is not None:
            names = tuple(name for name in owner.part.adjectives if name not in ("outer", "inner"))
            wall = PartQuery(noun=noun, words=tuple(noun.split()), definite=True)
            wall = placed_in(wall, "of", replace_fields(owner.part, adjectives=names))
            yield Spot(start, wall, set(range(min(owner.start, start), max(owner.end, end))))


def _nearer_ends(question: Question) -> Iterator[Spot]:
    """'the nearest end of the base', 'the end of the panel nearest to it', 'the plate's long edge': the nearer one."""
    text = question.text
    for at in sorted(text.at_words("end", "edge", "side")):
        across = text.is_word(at - 1, "long", "longer", "longest")
        sized = across or text.is_word(at - 1, "short", "shorter", "shortest")
        end = text.skip(at + 1, "side_noun")
        other = question.phrases.at(end + 1, 1) if text.is_word(end, "of") else None
        last = other.end if other is not None else end
        whose = text.words[at - 1] if text.is_word(at - 2, *NEAREST) and text.find(at - 1, "noun") else ""
        lead = at - 2 if whose else at - sized - text.is_word(at - 1 - sized, "near", *NEAREST)  # 'nearest plate end'
        near = {i for i in text.at_words(*NEAREST, "next", "beside") if last - 3 <= i <= last}  # may be in the phrase
        after = {i for i in near if text.is_word(i + 1 + text.is_word(i + 1, "to"), "it", "them")}
        along = text.find(lead - 1 - (text.find(lead - 1, "article") is not None), "axis_preposition")
        if along is not None or not (sized or ((lead < at or after) and text.is_word(at, "end"))):
            continue  # 'along the long side' says how a distance is taken
        holder = other or next((m for m in question.mentions if m.end == lead - 1 and text.is_possessive(m.end)), None)
        used = {*range(lead, last), *(holder.used if holder is not None else ()), *after}
        used |= {i for at in after for i in (at + 1, at + 2) if text.is_word(i, "to", "it", "them")}
        of = PartQuery(noun=whose, words=(whose,), definite=True) if whose else holder.query if holder else None
        of = replace_fields(of, ranks=(), places=()) if of is not None and after else of
        yield Spot(at, Boundary(None, of, SHORTER if across else LONGEST), used)


def planes_of(question: Question) -> Iterator[Spot]:
    """'the underside of the head', 'the flange's top face', 'the plate top': outer planes of parts."""
    text = question.text
    for at in sorted(text.at_words("lowest", "highest")):  # 'the lowest point of the bore'
        pointed = question.phrases.at(at + 3, 1) if text.is_word(at + 1, "point", "spot") else None
        if pointed is not None and pointed.query is not None:
            outermost = Plane(Side.BOTTOM if text.is_word(at, "lowest") else Side.TOP, pointed.query)
            yield Spot(at, outermost, set(range(at, pointed.end)))
    for at in range(len(text)):
        side, end = text.find(at, "side"), text.find(at, "measure")
        if end is not None and (end.value is Measure.TIP or end.value in ENDS):
            ended = question.phrases.at(end.end + 1, 1) if text.is_word(end.end, "of") else None
            alone = ended is None and not text.find(end.end, "noun", "edge")
            owners = _owners(question, at) if alone else [ended.query] if ended and ended.query else []
            used = set(range(at, ended.end if ended else end.end))  # 'the tip of the shank', 'its free end'
            yield from (Spot(at, Plane(ENDS.get(end.value), owner), used) for owner in owners)
        if side is None:
            continue
        after = text.skip(side.end, "side_noun")
        if text.is_word(after, "of") and (other := question.phrases.at(after + 1, 1)) and other.query is not None:
            yield Spot(at, Plane(side.value, other.query), set(range(at, other.end)))
            continue
        before = next((m for m in question.parts if m.head < at <= m.head + 2), None)
        if any(m.start <= at < m.end and m is not before for m in question.mentions):
            continue  # 'the base plate and the top plate'
        flat = places_of(before.part, "of") if before and before.part.noun == "flat" else ()  # 'the lid's flat back'
        if before is not None and (flat or after > side.end or text.is_word(at, "top", "bottom", "underside")):
            bare = replace_fields(flat[0][1] if flat else before.part, sides=(), ends=())
            yield Spot(at, Plane(side.value, bare), {*before.used, *range(before.head, after)})
