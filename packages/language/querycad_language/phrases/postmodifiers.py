"""What stands behind the noun: 'with a thread', 'larger than 5 mm', 'except the one in the middle'."""

from __future__ import annotations

from querycad_contracts import Place, Rank, Relation
from querycad_language.text import Text
from querycad_language.tokens import Kind

from .mention import MAX_DEPTH, PhraseBuilder, gather
from .places import along, central, leads_away, nearest, placed, seen, sideways
from .sizes import stated_size
from .words import is_noun, noun_follows, scale_at, superlative

_OPENING = ("open", "opens", "break", "breaks", "out")
_GAP = ("be", "do", "seeing", "function", "have")  # words that may lead to a modifier: 'that are', 'which has'


def modifiers(text: Text, at: int, build: PhraseBuilder) -> int:
    """Where the modifiers that begin here end."""
    while (end := _modifier(text, at, build)) > at:
        at = end
    return at


def _modifier(text: Text, start: int, build: PhraseBuilder) -> int:
    """Where a modifier that begins here, or behind words such as 'that are', ends; `start` where none does."""
    relative = False
    for at in range(start, min(len(text), start + 6)):
        opening = text.find(at, "emerging")
        to_side = text.find(opening.end if opening else at + 1, "side_preposition")
        to_side = to_side if to_side and not text.is_word(to_side.end, "both", "one") else None
        if text.is_word(at, "(") or (text.is_word(at, ",") and at == start):
            after = _joins(text, at, build) or _left_out(text, at + 1, build)
            if after == at + 1 and _opens(text, at):
                continue
        elif to_side and (opening or text.is_word(at, *_OPENING)):
            continue  # 'that open on the top', 'break into the bore', 'come out in the pocket'
        elif text.tokens[at].kind is Kind.SYMBOL and not text.find(at, "relation"):
            return start
        else:
            after = _one_modifier(text, at, build)
        if after > at + text.is_word(at, "(", ","):
            after += text.is_word(after, ")") and "(" in text.words[start:after]
            build.used.update(range(start, after))
            return after
        relative = relative or text.is_word(at, "that", "which", "who", "where")
        if text.is_word(at, "and") and text.has("between") and not build.adjectives:
            return start  # 'between the keyway and outside'
        again = at == start and text.is_word(at, "and", "but") and text.find(at + 1, "relation", "scale")
        if not _leads(text, at) and not (relative and _is_verb(text, at)) and not (again and build.adjectives):
            return start
    return start


def _is_verb(text: Text, at: int) -> bool:
    """May the word be the verb of a relative clause, or an adverb: 'which pass vertically through the plate'?"""
    known = text.find(at, "noun", "measure", "scale", "adjective", "side", "place", "ask", "count", "be", "article")
    return text.is_kind(at, Kind.WORD) and known is None


def _opens(text: Text, at: int) -> bool:
    """Does a modifier follow a comma or a bracket?"""
    if text.find(at + 1, "seeing", "except") or text.is_word(at + 1, "which", "that", "with"):
        return True
    if text.is_word(at + 1, "neither", "no", "without") and text.any_in(range(at), "count"):
        return text.find(text.skip(at + 2, "article"), "trait", "adjective") is not None  # 'slots, no chamfer'
    size = stated_size(text, at + 1)
    apart = size is not None and size[0].measure is not None and text.is_word(size[1], ",")  # 'the slot, 5 mm wide,'
    if size is not None and (apart or size[0].relation is not Relation.EQUAL or "=" in text.words[at : size[1]]):
        return True  # 'slots, width > 5 mm'
    return text.words[at] == "(" and text.is_kind(at + 1, Kind.QUANTITY, Kind.THREAD)


def _leads(text: Text, at: int) -> bool:
    """May the word stand between a noun and a modifier of it?"""
    going = text.find(at, "passing") and text.find(at + 1, "relation", "scale")  # 'that go deeper than 5 mm'
    if going or (text.is_word(at, "both") and text.find(at - 1, "be")):
        return True  # 'that are both through and wider than 6 mm'
    own = text.find(at, "measure", "scale") or text.is_word(at, "a", "an", "the")
    if own or text.find(at, *_GAP) is None or text.is_possessive(at):
        return False  # "the flange's corners" are no corner flange
    verb = text.is_word(at, "do", "does", "how", "what", "have", "has")
    return not verb or text.is_word(at - 1, "that", "which", "where")


def _one_modifier(text: Text, at: int, build: PhraseBuilder) -> int:
    be = text.is_word(at - 1, "are", "is")  # 'the holes of the rail are stepped': said of the noun around it
    own = build.depth == 0 or text.is_word(at - 1 - be, "that", "which")
    restricting = [_through, sideways, along, _colored, _ranked] if own else []
    for read in [seen, *restricting, _fitted, _stated_size, _trait, _exception, nearest, central]:
        if (end := read(text, at, build)) > at:
            return end
    negated = text.is_word(at, "not")
    begin = at + 2 if text.is_word(at, "on", "in", "around") and text.is_word(at + 2, "inside", "outside") else at
    adjective, measure = text.find(begin + negated, "adjective"), text.find(begin, "measure")
    if measure is not None and adjective is not None and measure.end > adjective.end:
        return at  # 'boss vertical extent'
    place = begin == at and text.find(at, "place")
    sided = text.is_word(at, "side")  # 'on each side': no attribute
    asked = text.find(begin, "verbs") is not None and text.has("much", "degree")  # 'how much is it tilted'
    if own and adjective and not (sided or asked or is_noun(text, adjective.end) or place) and adjective.value.tags:
        return gather(build.lacking if negated else build.adjectives, adjective.value.name, adjective.end)
    end = placed(text, at, build)
    return end if end > at else _joins(text, at, build) or at


def _joins(text: Text, at: int, build: PhraseBuilder) -> int:
    """Where another kind ends that is joined here: 'holes and slots', 'screws, washers and nuts'; 0 where none is."""
    plural = build.nouns and any(text.tokens[i].plural for i in build.nouns[-1].tokens)
    if not (plural and build.joined and text.is_word(at, "and", "or", "&", "plus", ",")):
        return 0
    other = build.read(at + 1, min(build.depth + 1, MAX_DEPTH), False)
    if other is None or other.query is None or not (other.query.known and other.query.noun and other.query.plural):
        return 0
    there = text.is_word(other.end + 1, "there")  # 'how many holes and slots are there'
    own = text.find(other.end, "measure", "be", "do") and not there  # a measure of its own follows
    if own or (text.is_word(at, ",") and not text.is_word(other.end, ",", "and", "&")):
        return 0
    return gather(build.also, other.query, other.end)


def _through(text: Text, at: int, build: PhraseBuilder) -> int:
    """'that go all the way through', 'do not pass through the part', 'are through'."""
    end = text.skip(at, "passing", "do", "negation")
    negated = text.any_in(range(at, end), "negation") or text.is_word(at - 1, "not")
    tags = build.lacking if negated else build.adjectives
    if text.find(end, "emerging", "stopping"):
        return _ending(text, at, end, tags)
    if not text.is_word(end, "through") or (end == at and not text.find(at - 1, "be", "negation", "each")):
        return at
    inner = text.skip(end + 1, "each", "article")
    whole = text.find(inner, "whole") or text.is_word(inner, "side", "way", "thickness", "wall")
    all_of_it = whole and not text.is_word(inner + 1, "of")
    if not all_of_it and noun_follows(text, end + 1):
        return at  # 'through the lid': a place
    tags.append("through")
    side = text.find(text.skip(end + 2, "article"), "side") if text.is_word(end + 1, "to") else None  # 'to the back'
    return inner + 1 if all_of_it else side.end if side is not None else end + 1


def _ending(text: Text, at: int, verb: int, tags: list[str]) -> int:
    """'that come out on the other side', 'that stop inside the material'."""
    place = text.skip(text.skip(verb, "emerging", "stopping"), "place", "side_preposition", "article")
    if text.find(verb, "stopping") and text.find(place, "stuff", "whole"):
        return gather(tags, "blind", place + 1)
    across = text.find(verb, "emerging") and text.is_word(place, "to", "other", "far", "opposite", "back")
    side = next((i for i in range(place, place + 5) if across and text.find(i, "side_noun")), None)
    return gather(tags, "through", side + 1) if side is not None else at


def _colored(text: Text, at: int, build: PhraseBuilder) -> int:
    """'which bodies are red'."""
    color = text.find(at + text.is_word(at, "colored", "painted"), "color")
    if color is None or not (text.find(at - 1, "be") or color.start > at) or is_noun(text, color.end):
        return at
    return gather(build.colors, color.value, color.end)


def _stated_size(text: Text, at: int, build: PhraseBuilder) -> int:
    """'with a diameter of 5 mm', 'larger than 5 mm', 'from 4 to 6 mm', '5 mm deep', 'Ø8.5'."""
    found = stated_size(text, at)
    if found is None:
        return at
    size, end = found
    noun, place = text.find(end, "noun"), text.find(end, "measure", "place", "seeing")
    if is_noun(text, end) and (place is None or (noun and noun.end > place.end)):
        return at  # '… around the 13 mm holes', '… 5 mm through holes': the size is another noun's
    sizes = [size]
    again = stated_size(text, end + 1) if text.is_word(end, "and", "but", ",") else None
    if again is not None and Relation.EQUAL not in (size.relation, again[0].relation):  # 'over 4 but under 8 mm'
        measure, sizes, end = size.measure or again[0].measure, [size, again[0]], again[1]
        sizes = [one.model_copy(update={"measure": one.measure or measure}) for one in sizes]
    build.sizes += sizes
    return end


def _fitted(text: Text, at: int, build: PhraseBuilder) -> int:
    """'that are M6', 'that take an M6 bolt', 'would an M6 bolt fit'."""
    begin = text.skip(at, "modal")
    start = text.skip(text.skip(begin, "fits"), "article")
    if not text.is_kind(start, Kind.THREAD):
        return at
    noun = text.find(start + 1, "noun")
    end = noun.end if noun is not None else start + 1
    behind = text.find(end, "fits")
    if noun is not None and not text.find(begin, "fits") and behind is None:
        return at  # '… are M6 holes': the thread is another noun's
    return gather(build.threads, text.tokens[start].word, behind.end if behind is not None else end)


def _ranked(text: Text, at: int, build: PhraseBuilder) -> int:
    """'with the smallest diameter', 'is the largest'."""
    the, which = text.is_word(at + 1, "the"), text.is_word(0, "which")
    alone = superlative(text, at + 2) if the else scale_at(text, at + 1, "more", "less") if which else None
    if alone is not None and text.find(at, "be"):
        ends = alone.end >= len(text) or text.is_break(alone.end)
        if not noun_follows(text, alone.end) if the else ends:  # 'which lug is thicker'
            most = alone.value.degree in ("most", "more")
            return gather(build.ranks, Rank(measure=alone.value.measure, most=most), alone.end)
    place = text.find(at, "place", "have")
    counted = ("in", "on") if text.any_in(range(at), "count") else ()  # 'how many holes at max diameter'
    if place is None or place.value not in ("with", "of", "have", *counted):
        return at
    start = text.skip(place.end, "article")
    span = text.find(start, "most", "least") or superlative(text, start)
    if span is None and place.value == "with":  # 'with the greater depth'
        span = scale_at(text, start, "more", "less")
    measure = text.find(span.end, "measure") if span is not None else None
    if span is None or measure is None or leads_away(text, at):
        return at
    most = getattr(span.value, "degree", span.category) in ("most", "more")
    return gather(build.ranks, Rank(measure=measure.value, most=most), measure.end)


def _trait(text: Text, at: int, build: PhraseBuilder) -> int:
    """'with a thread', 'without counterbore', 'having four holes'."""
    place = text.find(at, "place")
    place = place if place is not None and place.value in ("with", "without") else None
    counts = build.depth == 0 and text.any_in(range(at), "count")  # 'how many holes have a thread'
    lead = place or text.find(at, "have")
    start = lead.end if lead is not None else at
    none = text.is_word(start, "no", "neither")  # 'have neither a thread nor a chamfer', 'no thread no chamfer'
    if not (place or none or (lead and counts)):
        return at
    lacking = none or (place is not None and place.value == "without")
    start = text.skip(start + text.is_word(start, "no", "any", "neither"), "article")
    span = text.find(start, "trait", *["adjective"] * bool(none))
    longer = text.find(start, "noun")
    if span is not None and not (longer and longer.end > span.end) and not text.find(span.end, "relation"):
        (build.lacking if lacking else build.adjectives).append(span.value.name)
        return _further(text, span.end, build) if lacking else span.end
    other = build.inner(start) if place is not None else None
    if other is None:
        return at
    return gather(build.places, Place(relation="with", what=other.part, negated=lacking), other.end)


def _further(text: Text, at: int, build: PhraseBuilder) -> int:
    """'without thread, or chamfer', '… and without chamfer': the further attributes that parts must not have."""
    end = at
    while text.is_word(end, "nor", "or", "and", ",", "no", "without", "any", "neither"):
        end += 1
    span = text.find(text.skip(end, "article"), "trait", "adjective")
    if end == at or span is None or text.find(span.end, "relation"):
        return at
    build.lacking.append(span.value.name)
    return _further(text, span.end, build)


def _left_out(text: Text, at: int, build: PhraseBuilder) -> int:
    """', the dowel holes left out', ', dowel holes not counted'."""
    other = build.inner(at) if build.depth == 0 else None
    if other is None or (span := text.find(other.end, "left_out")) is None:
        return at
    return gather(build.excluded, other.part, span.end)


def _exception(text: Text, at: int, build: PhraseBuilder) -> int:
    """'except the one in the middle'."""
    if build.depth > 0:
        return at  # 'holes in the ring except the large one' excludes a hole
    scale, span = text.find(at, "scale"), text.find(at, "except", "minus")
    below = scale is not None and text.is_word(scale.end, "than") and text.skip(scale.end + 1, "article")
    if span is None and not (below and superlative(text, below)):  # 'smaller than the largest'
        return at
    start = span.end if span is not None else int(below) - 1
    inner = text.skip(start, "article")
    ranked = inner > start and superlative(text, inner) is not None  # 'minus the largest'
    other = build.within(start, joined=True) if ranked or span is None or span.category == "except" else None
    if other is None or other.query is None:
        return at
    build.excluded.append(other.query)
    more = text.skip(other.end + 1, "except") if text.is_word(other.end, "and", "or", ",") else other.end
    again = span is not None and (more > other.end + 1 or (more > other.end and text.find(more, "article")))
    second = build.within(more, joined=True) if again else None  # 'besides the slit and (besides) the keyway'
    build.excluded += [second.query] if second is not None and second.query is not None else []
    return second.end if second is not None else other.end
