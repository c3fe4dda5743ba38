"""Counts: how many parts or values, and whether there is one."""

from __future__ import annotations

from collections.abc import Iterator, Sequence

from querycad_contracts import Measure, PartQuery, Relation, Side
from querycad_language.forms import Check, Combine, Count, Exists, Towards
from querycad_language.lexicon import Span
from querycad_language.phrases import Mention, bare_of, placed_in, places_of, replace_fields
from querycad_language.readings.parses import Features, Parse
from querycad_language.readings.question import Question, used_by
from querycad_language.readings.requested_measures import SIZES
from querycad_language.text import Text

_LEADING = ("courtesy", "chatter")
_TOPOLOGY = {"face": Measure.FACE_COUNT, "surface": Measure.FACE_COUNT, "edge": Measure.EDGE_COUNT}
_PRESENT = ("present", "included", "used", "provided", "fitted", "there", "available", "exist", "exists", "found")


def counts(question: Question) -> Iterator[Parse]:
    """'How many blind slots are there?', 'What is the number of different depths of the keyways?'"""
    text = question.text
    for span in text.all("count"):
        if not _counts(question, span) or (text.is_word(span.end, "more", "fewer") and text.has("than")):
            continue  # 'how many more slots than lugs'
        used = set(span.tokens)
        at = text.skip(span.end + text.is_word(span.end, "of"), "article")
        different = text.find(at, "different")
        inner = different.end if different else at
        measure = text.find(inner, "measure")
        noun_here = text.find(inner, "noun")
        named = question.mentions
        valued: list[tuple[Mention, Measure, set[int]]] = []
        if measure is not None and not (noun_here and noun_here.end >= measure.end):
            named = question.parts
            valued += [(m, measure.value, {*range(at, measure.end)}) for m in named if m.start >= measure.end]
        for owner in (m for m in question.parts if different and m.start == inner):
            if size := text.find(owner.end, "measure"):  # 'how many different hole sizes'
                measured = Measure.DIAMETER if size.value in SIZES else size.value
                valued.append((owner, measured, {*range(at, inner), *size.tokens}))
        for mention, value, said in valued:
            values = Count(replace_fields(mention.part, plural=True), value)
            yield Parse(values, {"count_next": 1.0, "count_values": 1.0}, used | mention.used | said)
        if different and (measure or valued):
            continue  # nobody counts the holes themselves by 'how many different diameters'
        yield from _treated(question, at, used)
        restricted = text.at_phrases("side", "adjective", "operation", "with")
        yield from (of_all := [] if restricted else list(_topology(question, at, used)))
        after = [m for m in named if m.head >= at and not m.pronoun and not of_all]
        before = [m for m in named if m.end <= span.start and not m.pronoun]
        before = [m for m in before if m.end < span.start or not (m.query and m.query.ranks)]  # 'highest hole count'
        for index, mention in enumerate(after[:3]):
            next_to = index == 0 and not any(map(text.is_content, range(at, mention.start)))
            link = "count_next" if next_to else "count_far"
            yield from _count_of(text, mention, used, {link: 1.0}, after[index + 1 :] + before)
        for mention in before[-2:]:
            yield from _count_of(text, mention, used, {"count_before": 1.0}, [])


def _counts(question: Question, span: Span) -> bool:
    """Does the phrase ask for a number of parts: not 'how many millimetres'?"""
    text = question.text
    unit = question.unit(span.end) is not None and not text.find(span.end, "noun")  # feet are both
    if unit or text.find(span.end, "stuff") or text.tokens[span.start].raw == "counts":
        return False  # 'amount of metal left', 'it counts'
    return not text.find(span.start, "measure") or text.is_word(span.start, "number")


def _treated(question: Question, at: int, used: set[int]) -> Iterator[Parse]:
    """'How many edges are chamfered?' counts chamfered edges: what was done to an edge or corner names a part."""
    text = question.text
    if not text.is_word(at, "edge", "corner"):
        return
    for adjective in filter(None, (text.find(i, "adjective") for i in range(at + 1, len(text)))):
        phrase = " ".join((*text.words[adjective.start : adjective.end], text.words[at]))
        if phrase in text.lexicon.nouns:
            query = PartQuery(noun=phrase, words=tuple(phrase.split()), plural=True)
            yield Parse(Count(query), {"count_next": 1.0, "treated": 1.0}, used | {at, *adjective.tokens})


def _topology(question: Question, at: int, used: set[int]) -> Iterator[Parse]:
    """'How many faces does the part have?': of all shapes, and 'how many edges'."""
    measure = _TOPOLOGY.get(question.text.words[at]) if at < len(question.text) else None
    if measure is not None and len(question.parts) < 2 and all(bare_of(m.part, *_TOPOLOGY) for m in question.parts):
        said = used_by(*(m for m in question.mentions if m.query is None))
        whole = Count(PartQuery(noun="object", definite=True), measure)
        yield Parse(whole, {"count_next": 1.0, "topology": 1.0}, used | said | {at})


def _count_of(
    text: Text, mention: Mention, used: set[int], features: Features, others: Sequence[Mention]
) -> Iterator[Parse]:
    """How many of them; on each side, or of another part, or of each: 'how many ribs does the lever have?'"""
    each, used = text.at_words("each", "every", "per"), used | mention.used
    query = replace_fields(mention.query or PartQuery(noun="body", words=("body",)), plural=True)
    among = not each.isdisjoint(range(mention.head + 1, mention.end))
    held = places_of(query, "in", "on", "of", "through")[:1] if among else []
    for _, holder in held:  # 'how many holes are in each flange'
        shares = Combine("per", Count(query), Count(replace_fields(holder, plural=True)))
        yield Parse(shares, {**features, "owner_placed": 1.0}, used | each)
    if any(text.is_word(i + 1, "side", "face") for i in each):
        yield Parse(Towards(query, tuple(Side), "each"), features, used | {i + 1 for i in each} | each)
    elif not held:
        yield Parse(Count(query), features, used)
    for owner in (m for m in others[:2] if m.query is not None):
        stands = text.find(owner.start - 1, "place")
        relation, said = (stands.value, stands.tokens) if stands is not None else ("of", ())
        order = "owner_after" if owner.start > mention.start else "owner_before"
        owned = Count(placed_in(query, relation, owner.part))
        shared = each & {owner.start, owner.start - 1}
        form = Combine("per", owned, Count(replace_fields(owner.part, plural=True))) if shared else owned
        link = "owner_placed" if stands is not None else order
        yield Parse(form, {**features, link: 1.0}, (used | owner.used | each).union(said))


def exists(question: Question) -> Iterator[Parse]:
    """'Is there a keyway in the shaft?', 'Does the lever have a rib?'"""
    text = question.text
    gap = text.at_phrases("gap") - used_by(*question.parts)
    if gap or text.at_phrases("overlap", "contact") or any(text.is_word(i + 1, "many") for i in text.at_words("as")):
        return  # whether there are the bodies that touch, or have play, or as many, is not asked
    for span in text.all("exists"):
        lead = text.find(span.start, "count") or text.find(span.start - 1, "count", "ask", "noun", "scale", "measure")
        if question.in_question(span.start) and not lead:
            yield from _existing(text, [m for m in question.mentions if m.start >= span.start][:2], set(span.tokens))
    has = min(filter(question.in_question, text.at_phrases("have") - text.at_words("with")), default=len(text))
    owner = next((m for m in reversed(question.parts) if m.end <= has), None)
    owns = next((m for m in question.parts if m.start > has), None)
    several = used_by(owner, owns) & text.at_words("both", "each", "every") and not text.has("end", "side")
    start = _having(question)
    owned = [m for m in question.parts if start is not None and m.start >= start and not several][:2]
    if question.closed and owner is not None and owns is not None and not (owns.part.count or several):
        in_it = Exists(placed_in(owns.part, "of", owner.part))  # 'does the bore have a keyway'
        yield Parse(in_it, {"exists": 1.0, "count_far": 1.0}, owner.used | owns.used | {*range(owner.end, owns.start)})
        owned = [m for m in owned if m not in (owner, owns)]
    yield from _existing(text, owned, {start or 0})
    said = text.at_words(*_PRESENT)
    present = [m for m in question.mentions if not said.isdisjoint((m.end - 1, m.end))]
    if question.closed and said:  # 'Is a lug present?', 'Can any slots be found?'
        yield from _existing(text, present[:1] or question.mentions[:1], said)
    elif question.offers_yes_no and len(question.mentions) == 1:  # 'lugs, yes or no?', 'has_lug: true or false?'
        yield from _existing(text, question.mentions, set(text.at_phrases("have")))


def _existing(text: Text, mentions: Sequence[Mention], used: set[int]) -> Iterator[Parse]:
    """Whether there is the first of them, or less likely the second; of 'more than 8 lugs' whether so many."""
    compared = {span.end: span for span in text.all("relation")}
    for index, mention in enumerate(mentions):
        query, span = mention.query, compared.get(mention.start)
        if query is None or not mention.used.isdisjoint(text.at_words("both", "each", "every")):
            continue  # 'in both flanges', 'at both ends': one is not enough
        features = {"exists": 1.0, "count_far": float(index)}
        many = query.count or text.is_word(mention.start, "one")
        several, said = Count(replace_fields(query, count=None, plural=True, sample=False)), used | mention.used
        if many and span is not None:
            yield Parse(Check(several, span.value, float(many)), features, said | {*span.tokens})
        elif no := {i for i in (mention.start - 1, mention.start) if text.is_word(i, "no")}:  # 'are there no slots?'
            yield Parse(Check(several, Relation.EQUAL, 0.0), features, said | no)
        else:
            yield Parse(Exists(query), features, said)
            if query.count and query.count > 1 and not query.definite:  # 'has it three legs?'
                yield Parse(Check(several, Relation.EQUAL, float(query.count)), {**features, "stated_count": 1.0}, said)


def _having(question: Question) -> int | None:
    """Where a clause begins that asks what something has: 'does it have', 'any'."""
    text, (start, end) = question.text, question.asking
    said = (at for at in range(start, end) if text.find(at, "ask", "do", "have") or not text.find(at, *_LEADING))
    first = next(said, start)
    has = any(text.find(i, "have") and not text.is_word(i, "with") for i in range(first, end))
    asks = has and text.find(first, "do", "have")  # 'do they touch' asks for nothing
    return first if asks or text.is_word(first, "any") else None
