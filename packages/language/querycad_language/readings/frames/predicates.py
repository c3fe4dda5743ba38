"""Yes or no: what a verb says of parts: that they come out somewhere, run all along, lie in the middle or in line."""

from __future__ import annotations

from collections.abc import Iterator
from typing import Literal

from querycad_contracts import PartQuery, Relation
from querycad_language.forms import AtBothEnds, Check, Count, Distance, Every, Facing, Parallel
from querycad_language.lexicon import Span
from querycad_language.phrases import Mention, Phrases, placed_in, places_of, replace_fields, without
from querycad_language.readings.parses import Parse
from querycad_language.readings.question import Question, used_by
from querycad_language.text import Text

from .anchors import WHOLE
from .axes import ALONG, axis_named

_SAYS = {"predicate": 1.0}
_CENTRED = ("centered", "central", "centrally", "midway")
_ENDS = ("end", "end face", "shaft end")


def predicates(question: Question) -> Iterator[Parse]:
    """'Does the keyway come out at the bottom?', 'Does the drilling break into the slot?'"""
    start = verb_start(question)
    if start is not None:
        yield from (parse.with_more({"check": 1.0}, {start}) for parse in _said(question, start))


def _said(question: Question, start: int) -> Iterator[Parse]:
    """What the clause that begins here says of its subject."""
    text = question.text
    for says, cue in (
        (_openings, first_of(text, start, "opening", "emerging")),
        (_middles, first_of(text, start + 1, "halfway")),
        (_in_line, first_of(text, start + 1, "in_line")),
    ):
        subject = _subject(question, start, cue.start) if cue is not None else None
        yield from says(question, cue, subject) if cue is not None and subject is not None else ()
    for says_more in (_facing, _traits, _both):
        yield from says_more(question, start)


def verb_start(question: Question) -> int | None:
    """Where a clause begins that is answered by yes or no."""
    text, (start, end) = question.text, question.asking
    if question.claims or question.offers_yes_no:
        return start
    if text.any_in(range(start, end), "ask", "where", "count"):
        return None
    if question.closed and question.whether is not None:
        return question.whether
    behind = [i + 1 for i in range(start, end - 1) if text.is_word(i, ",") and text.find(i + 1, "be", "do", "modal")]
    if behind and not text.is_word(behind[0] + 1, "there"):
        return behind[0]  # 'Going by the model, is it …?'
    leading = next((i for i in range(start, end) if not _leads(text, i)), end)
    verbs = (i for i in range(start, min(leading + 1, end)) if text.find(i, "be", "do", "have", "modal"))
    verb = next(verbs, start if text.is_word(end, "?") and text.is_word(start, "go") else None)
    return None if verb is None or text.is_word(verb - 1, "there") else verb


def _leads(text: Text, at: int) -> bool:
    """May the word stand before a yes-or-no question: 'please tell me whether'?"""
    names = text.find(at, "ask", "where", "count", "noun", "measure") and not text.is_word(at, "that", "this")
    leads = text.is_word(at, ",", "if", "whether") or text.find(at, "chatter", "courtesy", "imperative", "function")
    return bool(leads and not names)


def all_such(query: PartQuery, *more: str) -> PartQuery:
    """All that are as is said, however many: the ones that the parts in question must be among. `more`: adjectives."""
    return replace_fields(query, adjectives=query.adjectives + more, plural=True, sample=True, ranks=(), count=None)


def _openings(question: Question, verb: Span, subject: Mention) -> Iterator[Parse]:
    """'Does the hole come out at the top?', '… go right through?', '… break into the bore?'"""
    text, part = question.text, subject.part
    end = next((i for i in range(verb.end, len(text)) if text.is_break(i) or text.is_word(i, ",")), len(text))
    sides = (text.find(at, "side") for at in range(verb.end, end) if not text.is_word(at - 1, "same"))
    side, other, used = next(filter(None, sides), None), _behind(question, verb.end, end), {*subject.used, *verb.tokens}
    if any(verb.start <= span.start < end for span in text.all("all_through")):
        said = {*text.words[verb.start : end]}
        way = "through both walls" if said & {"side", "wall"} else "through"
        way = "open at both ends" if said & {"end", "across"} else way
        yield Parse(Every(part, all_such(part, way)), _SAYS, {*used, *range(verb.start, end)})
    elif side is not None:
        yield Parse(Every(part, all_such(replace_fields(part, sides=(side.value,)))), _SAYS, {*used, *side.tokens})
    elif other is not None and other.part.noun in _ENDS:
        yield Parse(Every(part, all_such(part, "open at the end")), _SAYS, used | other.used)
    elif other is not None and not text.is_word(other.start - 1, "through"):
        meets = Check(Distance(part, other.part, "surfaces"), Relation.AT_MOST, 0.0)
        yield Parse(meets, _SAYS, used | other.used | {other.start - 1})


def _middles(question: Question, cue: Span, subject: Mention) -> Iterator[Parse]:
    """'Is the groove in the middle of the rim?', '… of the holes?', '… midway between the lugs?', '… at mid-height?'"""
    text = question.text
    if not any(text.find(i, "be", "do") or text.is_word(i, "sit", "lie") for i in range(cue.start)):
        return
    first = _behind(question, cue.end)
    used = used_by(subject, first).union(cue.tokens)
    between = first is not None and text.is_word(cue.end - 1, "between") and not first.plural
    second = question.phrases.at(first.end + 1, 1) if first and between and text.is_word(first.end, "and") else None
    if first is not None and second is not None and second.query is not None:
        far, near = (Distance(subject.part, m.part, "centers") for m in (first, second))
        yield Parse(Check(far, Relation.EQUAL, near), _SAYS, used | second.used)
        return
    measures = (text.find(i, "measure") for i in range(cue.start, cue.end + 5))
    side = next((one for one in measures if one is not None and one.value in ALONG), None)
    axis, along = (ALONG[side.value], set(side.tokens)) if side is not None else (None, set())
    if axis is None and text.is_word(cue.start, *_CENTRED):
        axis, along = axis_named(question)
    mode: Literal["amid", "centers"] = "amid" if first is not None and first.plural else "centers"
    middle = Distance(subject.part, first.part if first is not None else WHOLE, mode, axis)
    yield Parse(Check(middle, Relation.AT_MOST, 0.0), _SAYS, used | along)


def _in_line(question: Question, cue: Span, subject: Mention) -> Iterator[Parse]:
    """'Are the two bores in line?', 'Is the pin on the same axis as the bore?'"""
    text = question.text
    joined = _subject(question, subject.end, cue.start) if text.is_word(subject.end, "and") else None
    other = _behind(question, cue.end) or joined  # 'are the bore and the pin coaxial'
    strict = any(text.is_word(i, "axis", "coaxial", "concentric") for i in range(cue.start, len(text)))
    form = Parallel(subject.part, other.query if other is not None else None, in_line="axis" if strict else "row")
    yield Parse(form, _SAYS, used_by(subject, other).union(cue.tokens))


def _facing(question: Question, start: int) -> Iterator[Parse]:
    """'Are the hub and the pin on the same side?', 'Are the two lugs opposite each other?'"""
    text = question.text
    for at in sorted(text.at_words("same", "opposite")):
        sided = text.is_word(at + 1, "side", "face", "direction")
        subject = _subject(question, start, at)
        if subject is None or not (sided or text.is_word(at + 1, "each", "one")):
            continue
        other = _behind(question, subject.end + 1, at) if text.is_word(subject.end, "and") else None
        if other is None and sided and not subject.plural:  # '… on the same side as the pin'
            other = _behind(question, at + 3)
        used = used_by(subject, other, *(m for m in question.parts if sided and m.start > at))  # '… of the web'
        how: Literal["same", "opposite"] = "opposite" if text.is_word(at, "opposite") else "same"
        form = Facing(subject.part, other.part if other is not None else None, how if sided else "across")
        yield Parse(form, _SAYS, used.union(range(subject.end, at + 3 - sided)))


def _traits(question: Question, start: int) -> Iterator[Parse]:
    """'Is the boss hollow?', 'Is the bottom of the pocket flat?': nouns that are adjectives here."""
    text, end = question.text, question.asking[1]
    for said in text.all("adjective") if text.find(start, "be") else ():
        subject = _subject(question, start, said.start) if said.end == end and text.find(said.start, "noun") else None
        if subject is not None and said.value.tags:
            such = all_such(subject.part, said.value.name)
            yield Parse(Every(subject.part, such), _SAYS, {*subject.used, *said.tokens})


def _both(question: Question, start: int) -> Iterator[Parse]:
    """'Is there a slot in both flanges?', 'Does each lug have a hole?', 'Are there chamfers at both ends?'"""
    text = question.text
    at = next((i for i in sorted(text.at_words("both", "each")) if i >= start), None)
    if at is None:
        return
    holder = next((m for m in question.parts if m.start == at), None)
    held = next((m for m in question.parts if m.start > at), None) if holder is not None else None
    if holder is not None and held is not None:
        if any(text.find(i, "have", "carry") for i in range(holder.head + 1, held.start)):
            yield Parse(_in_each(held.part, "of", holder.part), _SAYS, held.used | holder.used)
        return
    on_both = next((m for m in question.parts if m.start < at < m.end), None)
    what = on_both or next((m for m in reversed(question.parts) if m.end <= at), None)
    if what is None or (text.find(at + 1, "noun", "side_noun") is None and on_both is None):
        return
    places = places_of(on_both.query if on_both is not None else None)[-1:]
    ends, used = text.find(at + 1, "side_noun"), {*what.used, at, at + 1}
    if ends is None:
        for place, other in places:
            yield Parse(_in_each(without(what.part, place), place.relation, other), _SAYS, used)
    elif not (text.is_word(at - 1, "through") or "open at both ends" in what.part.adjectives):
        bare, named = _several(what.part), " ".join(text.words[at + 1 : ends.end])
        for place in (place for place, other in places if other.noun == named):
            bare = without(bare, place)
        owner = next((m for m in question.parts if m.end <= what.start), None)
        if owner is not None and any(text.find(i, "have") for i in range(owner.end, what.start)):
            bare, used = placed_in(bare, "of", owner.part), used | owner.used
        yield Parse(AtBothEnds(bare), _SAYS, used)


def _in_each(query: PartQuery, relation: str, holder: PartQuery) -> Check:
    """Are there at least as many of them as of what each is in?"""
    held = replace_fields(holder, count=None, plural=True)
    return Check(Count(placed_in(_several(query), relation, held)), Relation.AT_LEAST, Count(held))


def _several(query: PartQuery) -> PartQuery:
    """However many there are of them."""
    return replace_fields(query, plural=True, count=None, definite=False)


def first_of(text: Text, start: int, *categories: str) -> Span | None:
    """The first phrase of the categories from a token on."""
    return next((span for span in text.all(*categories) if span.start >= start), None)


def _subject(question: Question, start: int, end: int) -> Mention | None:
    """The parts that are named from a clause's verb to another token, whatever is said of them behind it."""
    at = next((m.start for m in question.parts if start <= m.start and (m.head < end or m.start < end < m.end)), None)
    if at is None:
        return question.antecedent(start)
    clipped = Text(" ".join(token.raw for token in question.text.tokens[:end]))
    mention = Phrases(clipped).at(at) if clipped.words == question.text.words[:end] else None
    return mention if mention is not None and mention.query is not None else None


def _behind(question: Question, at: int, end: int | None = None) -> Mention | None:
    """The parts that are named first behind a token, and before the end."""
    inner = (question.phrases.at(i, 1, joined=False) for i in range(at, min(at + 4, len(question.text))))
    first = next((m for m in inner if m is not None and m.query is not None), None)
    return first if first is not None and (end is None or first.start < end) else None
