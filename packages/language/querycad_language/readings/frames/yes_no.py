"""Yes or no: whether a value is as stated, and whether parts are as is said of them."""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from dataclasses import replace
from itertools import pairwise

from querycad_contracts import Measure, PartQuery, Rank, Relation, SizeFilter
from querycad_language import forms
from querycad_language.forms import Check, Count, Distance, Every, Exists, Get, Plane, Reduce, mapped
from querycad_language.phrases import Mention, placed_in, places_of, replace_fields, stated_size
from querycad_language.readings.parses import Parse
from querycad_language.readings.question import Question
from querycad_language.readings.requested_measures import Requested, asked_in
from querycad_language.text import Text

from .anchors import WHOLE, pairs_named
from .distances import angles, distances, overhangs
from .predicates import all_such, first_of, verb_start
from .values import density_of

_WIDE = ("wide", "big", "large", "long", "deep", "high", "tall", "thick")
_BODIES = PartQuery(noun="body", words=("body",), plural=True)
_LARGEST_BORE = PartQuery(noun="bore", words=("bore",), definite=True, ranks=(Rank(measure=Measure.DIAMETER),))


def yes_no(question: Question) -> Iterator[Parse]:
    """'Is the keyway 8 mm wide?', 'Are all ribs equally high?', 'Are the slots of the lever parallel?'"""
    start = verb_start(question)
    yield from _overlapping(question, start) if start is not None else ()
    for first, second, used in pairs_named(question.parts) if (flush := question.text.at_phrases("flush")) else ():
        faced = next(iter(question.text.all("side")), None)  # 'is the cap flush with the sleeve at the top?'
        side, said = (faced.value, {*faced.tokens}) if faced is not None else (None, set())
        one, other = (Plane(side, replace_fields(part, sides=())) for part in (first, second))
        yield Parse(Check(Distance(one, other), Relation.AT_MOST, 0.0), {"check": 1.0}, used | flush | said)
    yield from (either := list(_either(question)))
    if start is not None and not either:
        yield from (parse.with_more({"check": 1.0}, {start}) for parse in _claims(question, start))


def _claims(question: Question, start: int) -> Iterator[Parse]:
    """What the clause that begins here asks to confirm."""
    text = question.text
    yield from _apart(question, start)
    asked = [one for one in asked_in(question) if one.start >= start]
    parts = [m for m in question.mentions if m.start >= start and not (m.pronoun and len(question.mentions) > 1)]
    parts = parts or [one for one in [question.antecedent(start)] if one is not None]
    yield from _alike(text, start, parts, asked)
    if text.is_word(start + 1, "there"):
        return
    yield from _of_kind(question, start)
    yield from _fits(question, start)
    if not parts and asked and (found := _size_after(question, start, len(text))) is not None:  # 'width > 80 mm?'
        yield _checked(text, None, found[0], asked).with_more({}, found[1])
    for index, mention in enumerate(parts[: 3 if question.claims else 2]):
        behind = next((m for m in parts if m.start > mention.end), None)
        said = _restricted(text, start, mention, behind) if mention.query is not None else ()
        for parse in (*_sized(question, mention, asked), *_predicates(text, mention, parts[index + 1 :]), *said):
            yield parse.with_more({"count_far": float(index)}, mention.used)


def _sized(question: Question, mention: Mention, asked: Sequence[Requested]) -> Iterator[Parse]:
    """'Is the 8 mm keyway …?', 'Is the keyway 8 mm wide?', 'Do the holes lie on a circle of 50 mm?'"""
    text, target = question.text, mention.query
    if question.claims and target is not None and target.count:  # 'It has ten holes. Is that right?'
        yield Parse(Check(Count(replace_fields(target, count=None)), Relation.EQUAL, float(target.count)))
    if target is not None and target.sizes:
        yield _checked(text, replace_fields(target, sizes=target.sizes[:-1]), target.sizes[-1], asked)
    if (found := _size_after(question, mention.end)) is not None:
        yield _checked(text, target, found[0], asked).with_more({}, found[1])
    for inner in (one for one in _around(target) if one.sizes):
        yield _checked(text, replace_fields(inner, sizes=()), inner.sizes[-1], ())


def _overlapping(question: Question, start: int) -> Iterator[Parse]:
    """'Do the rollers overlap?', 'Is the key in contact with the hub?', 'What volume do they share in overlap?'"""
    text, last = question.text, question.asking[1] - 1
    meeting = {last} if text.is_word(last, "meet", "intersect", "cross") else set()  # 'do the bores meet?'
    for contact, said in ((False, text.at_phrases("overlap")), (True, text.at_phrases("contact") | meeting)):
        named = [m for m in question.mentions if m.start >= start and m.used.isdisjoint(said)][:2]
        named = named[:1] if len(named) > 1 and named[1].pronoun else named  # 'do they touch one another'
        meant = [one.query or _BODIES for one in named] or [_BODIES]
        shared = Distance(meant[0], meant[1] if len(meant) > 1 else "each other", "overlap", reduce=Reduce.SMALLEST)
        touching = Check(replace(shared, mode="surfaces"), Relation.AT_MOST, 0.0)
        if said:
            form = touching if contact else Check(shared, Relation.MORE, 0.0)
            yield Parse(form, {"check": 1.0}, {start, *said}.union(*(one.used for one in named)))


def _either(question: Question) -> Iterator[Parse]:
    """'Are the bores blind or through?', 'Is it solid or hollow?'"""
    text = question.text
    for at in text.at_words("or") if question.closed else ():
        first = next((span for span in text.all("adjective") if span.end == at - text.is_word(at - 1, ",")), None)
        second = text.find(text.skip(at + 1, "article", "pronoun", "be", "completely"), "adjective")
        mention = next((m for m in question.mentions if m.start < at), None)
        if first is not None and second is not None and mention is not None:
            names = (first.value.name, second.value.name)
            query = mention.query or WHOLE
            kept = {k: tuple(v for v in getattr(query, k) if v not in names) for k in ("adjectives", "lacking")}
            bare = replace_fields(query, **kept)
            said, or_said = (" ".join(text.words[each.start : each.end]) for each in (first, second))
            form = forms.Either(bare, (said, or_said), (all_such(bare, names[0]), all_such(bare, names[1])))
            yield Parse(form, {"predicate": 1.0}, {*mention.used, *range(first.start, second.end)})


def _fits(question: Question, start: int) -> Iterator[Parse]:
    """'Does a 12.5 mm gauge enter the small bore?', 'Is the slot wide enough to let a 6 mm pin pass?'"""
    text = question.text
    verb, threads = first_of(text, start, "fits"), text.lexicon.threads
    sizes = [(i, token.value) for i, token in enumerate(text.tokens) if token.power == 1]
    sizes += [(i, threads[word]["nominal"]) for i, word in enumerate(text.words) if "nominal" in threads.get(word, ())]
    if verb is not None and sizes:
        hole = next((m for m in reversed(question.parts) if m.start >= verb.end), None)
        query = hole.query if hole is not None else _LARGEST_BORE if text.has("through") else None  # 'pass through?'
        part = next((what for _, what in places_of(query, "through", "in")), query)  # 'put a shaft through this bore'
        used = {sizes[0][0], *verb.tokens, *(hole.used if hole is not None else text.at_words("through", "center"))}
        used |= {i for m in question.parts if m.end <= verb.start for i in m.used}
        used |= {i for i in text.at_phrases("measure") if i < verb.start}
        if part is not None:
            said = tuple(name for name in part.adjectives if name != "through")  # 'would it go through the lug?'
            wide: Get | Distance = Get((Measure.DIAMETER,), replace_fields(part, sizes=(), adjectives=said))
            if hole is not None and text.is_word(hole.start - 1, "between"):  # 'between the lugs'
                wide = Distance(replace_fields(part, plural=True, count=None), "each other", "surfaces")
                used.add(hole.start - 1)
            yield Parse(Check(wide, Relation.AT_LEAST, sizes[0][1]), {"mating": 1.0}, used)
    for at in text.at_words("enough"):
        scale = next((one for one in text.all("scale") if one.end == at and text.words[one.start] in _WIDE), None)
        owner = next((m for m in question.parts if m.end <= at), None)
        found = next((one for one in sizes if one[0] > at), None)
        if scale is not None and owner is not None and found is not None:
            large = scale.value.measure is Measure.MAGNITUDE
            get = Get((Measure.DIAMETER if large else scale.value.measure,), owner.query)
            used = {at, found[0], *owner.used, *scale.tokens}.union(*(m.used for m in question.parts if m.start > at))
            used |= text.at_phrases("fits") | text.at_words("let", "through")
            yield Parse(Check(get, Relation.AT_LEAST, found[1]), {"mating": 1.0}, used)


def _apart(question: Question, start: int) -> Iterator[Parse]:
    """'Is there at least 10 mm between the slot and the edge?', 'Is there any gap …?', 'Does the pin stick out?'"""
    text = question.text
    asks_gap = text.is_word(start + 1, "there") and bool(text.at_phrases("gap"))
    found, beyond = _size_after(question, start, len(text)), () if text.has("come") else overhangs(question)
    size, used = found or (SizeFilter(relation=Relation.MORE, low=0.0), {start, start + asks_gap})
    for parse in beyond:
        if isinstance(parse.form, Distance):
            both = [at for at in text.at_words("both") if text.is_word(at + 1, "side", "end")]
            over = replace(parse.form, mode="beyond both" if both else "beyond")
            said = {at + i for at in both for i in (0, 1)}
            yield Parse(Check(over, size.relation, size.low, size.high), parse.features, parse.used | used | said)
    between = angles if size.measure is Measure.ANGLE else distances  # 'is the angle between the legs 90 degrees?'
    for parse in between(question) if found or asks_gap else ():
        form = mapped(parse.form, lambda query: replace_fields(query, sizes=tuple(s for s in query.sizes if s != size)))
        if isinstance(form, Distance | forms.Angle):
            yield Parse(Check(form, size.relation, size.low, size.high), parse.features, parse.used | used)


def _around(query: PartQuery | None) -> Iterator[PartQuery]:
    """The parts that say where a part is, and where those are."""
    for _, other in places_of(query):
        yield other
        yield from _around(other)


def _of_kind(question: Question, start: int) -> Iterator[Parse]:
    """'Are all lugs 5 mm round lugs?', 'Is the hole a counterbore?', 'Is this a washer?'"""
    text = question.text
    for first, second in list(pairwise(m for m in question.mentions if m.start >= start))[:1]:
        said = text.is_word(second.start, "a", "an") or (second.plural and second.start == first.end)
        has = any(text.find(i, "have") for i in range(first.end, second.start))  # 'does the shaft have a flat'
        before = question.antecedent(start) if first.pronoun else None
        target = (before or first).query or PartQuery(noun="object", words=("object",))
        one = second.query is not None and second.query.noun in ("body", "object", "part")
        one = one and text.is_word(second.head - 1, "one", "single")
        several = text.is_word(second.head, "assembly") and text.is_word(second.start, "a", "an")
        if target.noun == "object" and (several or one):
            number = Check(Count(_BODIES), Relation.EQUAL if one else Relation.MORE, 1.0)
            yield Parse(number, {"predicate": 1.0}, first.used | second.used)  # 'is this one body?'
        elif first.end == second.head and target.noun == "object" and (trait := text.find(second.head, "adjective")):
            yield Parse(
                Every(_BODIES, all_such(_BODIES, trait.value.name)), {"predicate": 1.0}, first.used | second.used
            )
        elif said and not has and second.query:
            every = Every(target, replace_fields(second.query, plural=True, sample=True))
            yield Parse(every, {"predicate": 1.0}, first.used | second.used.union(*(m.used for m in [before] if m)))


def _alike(text: Text, start: int, parts: Sequence[Mention], asked: Sequence[Requested]) -> Iterator[Parse]:
    """'Are the holes all the same size?', 'Is there only one size of hole?', 'Are the lug and the rib equally high?'"""
    same = {i for i in text.at_phrases("same") if i >= start}
    first, second = next(iter(parts), None), next(iter(parts[1:]), None)
    if not same or first is None or first.query is None:
        return
    scale = text.find(max(same) + 1, "scale")
    if scale is not None:  # 'equally thick'
        asked = [Requested(scale.start, scale.end, (scale.value.measure,), "how", used=frozenset(scale.tokens))]
    for one in asked or [Requested(0, 0, (Measure.MAGNITUDE,), "noun")]:
        get, used = Get(one.measures, replace_fields(first.query, plural=True)), first.used | same | one.used
        yield Parse(forms.Uniform(get), used=used)
        if second is not None and second.query is not None and text.is_word(first.end, "and"):
            form = Check(replace(get, target=first.query), Relation.EQUAL, replace(get, target=second.query))
            yield Parse(form, {"check": 1.0}, used | second.used)
        for right, said in _others(text, max(same), first.query, parts):  # 'the same size as those in the hub'
            other = replace(get, target=right)
            wide = text.find(max(said) + 2, "scale") if text.find(max(said) + 1, "be") else None
            if wide is not None:  # 'as the rim is wide'
                other, said = Get((wide.value.measure,), right), {*said, max(said) + 1, *wide.tokens}
            yield Parse(Check(get, Relation.EQUAL, other), {"check": 1.0}, used | said)


def _others(text: Text, at: int, own: PartQuery, parts: Sequence[Mention]) -> Iterator[tuple[PartQuery, set[int]]]:
    """What parts are compared with: 'the same as the bore', 'the same as those in the hub'."""
    than = next((i for i in sorted(text.at_words("as", "like")) if i > at), None)
    other = next((m for m in parts if than is not None and m.start > than), None)
    if than is None or other is None:
        return
    those = any(text.is_word(i, "those", "that", "one", "ones") for i in range(than, other.start))
    place = text.find(other.start - 1, "place")
    held = placed_in(replace_fields(own, places=()), place.value if place is not None else "of", other.part)
    yield held if those else other.part, {*other.used, *range(than, other.start)}


def _restricted(text: Text, start: int, mention: Mention, other: Mention | None) -> Iterator[Parse]:
    """'Are the slots parallel?', 'Is the hole on the front threaded?': what restricts the phrase is what is asked."""
    target = mention.part
    second, more = (other.query, other.used) if other is not None else (None, frozenset[int]())
    for word in ("parallel", "perpendicular"):
        if at := {i for i in text.at_phrases(word) if i >= start}:
            form = forms.Parallel(target, second, square=word == "perpendicular")
            yield Parse(form, used=at | more | text.at_words("axis"))
    said = [text.lexicon.adjectives.get(name) for name in (*target.adjectives, *target.lacking)[-1:]]
    restricted, last = any(one and (one.tags or one.order or one.lacks) for one in said), mention.end - 1
    behind = mention.head < last or (text.find(last, "adjective", "trait") and not text.find(last, "noun"))
    if restricted and _any_of(text, mention):
        yield Parse(Exists(target), {"predicate": 1.0})
    elif restricted and behind:
        adjectives = target.adjectives if target.lacking else target.adjectives[:-1]
        yield Parse(Every(replace_fields(target, adjectives=adjectives, lacking=target.lacking[:-1]), all_such(target)))
    if target.sides:  # 'Do the keyways on the left emerge at the top?'
        such = all_such(replace_fields(target, sides=target.sides[-1:]))
        yield Parse(Every(replace_fields(target, sides=target.sides[:-1]), such), {"check_side": 1.0})
    if target.places and target.places[-1].relation:  # 'Do the cross holes run into the bore?', no compound
        yield Parse(Every(replace_fields(target, places=target.places[:-1]), all_such(target)), {"check_place": 1.0})
    end = text.skip(mention.end, "passing")
    if end > mention.end and text.is_word(end, "through") and not target.threads:  # 'Do they go right through?'
        used = {*range(mention.end, end + 1), *(more if other is not None and other.start <= end + 2 else ())}
        yield Parse(Every(target, all_such(target, "through")), {"predicate": 1.0}, used)


def _any_of(text: Text, mention: Mention) -> bool:
    """Is one enough: 'any of the holes', 'a hole'?"""
    before = range(mention.start - 2, mention.head)
    return text.is_word(mention.start, "a", "an") or any(text.is_word(i, "any", "one", "some") for i in before)


def _predicates(text: Text, mention: Mention, others: Sequence[Mention]) -> Iterator[Parse]:
    """'Are the ports really round?', 'Is the lever red?': what is said of them behind the noun."""
    named, target = mention.query, mention.query or PartQuery(noun="object")
    spans = (text.find(at, "adjective") for at in range(mention.end, len(text)) if at not in mention.used)
    said = (one for one in spans if one is not None and one.value.tags and not text.is_word(one.start, "side"))
    span = next(said, None)
    if span is None or any(span.start in one.used for one in others):
        return  # said of another part
    if named is None and not span.value.decided:  # tags of bodies: 'is it hollow?'
        named = target = _BODIES
    such = replace_fields(target, adjectives=(*target.adjectives, span.value.name))
    every = named is not None and not _any_of(text, mention)
    yield Parse(Every(target, all_such(such)) if every else Exists(such), {"predicate": 1.0}, set(span.tokens))


def _size_after(question: Question, at: int, within: int = 6) -> tuple[SizeFilter, set[int]] | None:
    text = question.text
    for begin in range(at, min(len(text), at + within)):
        if (found := stated_size(text, begin)) is not None:
            return found[0], set(range(begin, found[1]))
    return None


def _checked(text: Text, target: forms.Target, size: SizeFilter, asked: Sequence[Requested]) -> Parse:
    measure = asked[0].measures[0] if asked and size.measure in (None, Measure.AREA, Measure.VOLUME) else size.measure
    density, said = density_of(text) if measure is Measure.MASS else (None, set())
    relation = Relation.AT_LEAST if size.relation is Relation.EQUAL and text.has("least") else size.relation
    check = Check(Get((measure or Measure.MAGNITUDE,), target, density=density), relation, size.low, size.high)
    return Parse(check, used=said.union(*(one.used for one in asked)))
