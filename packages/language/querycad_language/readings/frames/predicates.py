"""Yes or no: what a verb says of parts: that they come out somewhere, run all along, lie in the middle or in line."""

from __future__ import annotations

from collections.abc import Iterator
from typing import Literal

from querycad_contracts import PartQuery, Relation
from querycad_language.forms import AtBothEnds, Check, Count, Distance, Every, Facing, Parallel
from querycad_language.lexicon import Span
from querycad_language.phrases import Mention, Phrases, placed_in, replace_fields, without
from querycad_language.readings.parses import Parse
from querycad_language.readings.question import Question
from querycad_language.text import Text

from .axes import ALONG, axis_named

_SAYS = {"predicate": 1.0}
_CENTRED = ("centered", "central", "centrally", "midway")
_ENDS = ("end", "end face", "shaft end")


def predicates(question: Question) -> Iterator[Parse]:
    """'Does the keyway come out at the bottom?', 'Does the drilling break into the slot?'"""
    start = verb_start(question)
    if start is None:
        return
    for says in (_openings, _middles, _in_line, _facing, _traits, _both):
        yield from (parse.with_more({"check": 1.0}, {start}) for parse in says(question, start))


def verb_start(question: Question) -> int | None:
    """Where a clause begins that is answered by yes or no."""
    text, (start, end) = question.text, question.asking
    if question.claims or question.offers_yes_no:
        return start
    if any(text.find(i, "ask", "where", "count") for i in range(start, end)):
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
    if text.find(at, "ask", "where", "count", "noun", "measure") and not text.is_word(at, "that", "this"):
        return False
    polite = text.find(at, "chatter", "courtesy", "imperative", "function")
    return polite is not None or text.is_word(at, ",", "if", "whether")


def all_such(query: PartQuery) -> PartQuery:
    """All that are as is said, however many: the ones that the parts in question must be among."""
    return replace_fields(query, plural=True, sample=True, ranks=(), count=None)


def _openings(question: Question, start: int) -> Iterator[Parse]:
    """'Does the hole come out at the top?', '… go right through?', '… break into the bore?'"""
    text = question.text
    verb = _first(text, start, "opening", "emerging")
    subject = _subject(question, start, verb.start) if verb is not None else None
    if verb is None or subject is None:
        return
    end = _clause_end(text, verb.end)
    ways = [span for span in text.all("all_through") if verb.start <= span.start < end]
    used = {*subject.used, *verb.tokens}
    if ways:
        lengthwise = any(text.is_word(i, "end", "across") for i in range(verb.start, end))
        way = "open at both ends" if lengthwise else "through"
        said = replace_fields(subject.part, adjectives=(*subject.part.adjectives, way))
        yield Parse(Every(subject.part, all_such(said)), _SAYS, {*used, *range(verb.start, end)})
    for at in range(verb.end, end) if not ways else ():
        side = text.find(at, "side")
        if side is not None and not text.is_word(at - 1, "same"):
            such = all_such(replace_fields(subject.part, sides=(side.value,)))
            yield Parse(Every(subject.part, such), _SAYS, {*used, *side.tokens})
            return
    other = next((m for m in _behind(question, verb.end) if m.start < end), None)
    if other is not None and other.part.noun in _ENDS and not ways:
        said = replace_fields(subject.part, adjectives=(*subject.part.adjectives, "open at the end"))
        yield Parse(Every(subject.part, all_such(said)), _SAYS, used | other.used)
    elif other is not None and not ways and not text.is_word(other.start - 1, "through"):
        meets = Check(Distance(subject.part, other.part, "surfaces"), Relation.AT_MOST, 0.0)
        yield Parse(meets, _SAYS, used | other.used | {other.start - 1})


def _middles(question: Question, start: int) -> Iterator[Parse]:
    """'Is the groove in the middle of the rim?', '… midway between the lugs?', '… at mid-height?'"""
    text = question.text
    cue = _first(text, start + 1, "halfway")
    said = cue is not None and any(text.find(i, "be", "do") or text.is_word(i, "sit", "lie") for i in range(cue.start))
    subject = _subject(question, start, cue.start) if cue is not None and said else None
    if cue is None or subject is None:
        return
    others = _behind(question, cue.end)
    used = {*subject.used, *cue.tokens, *(others[0].used if others else ())}
    first = others[0] if others and text.is_word(cue.end - 1, "between") and not others[0].plural else None
    second = question.phrases.at(first.end + 1, 1) if first and text.is_word(first.end, "and") else None
    if first is not None and second is not None and second.query is not None:
        far, near = (Distance(subject.part, m.part, "centers") for m in (first, second))
        yield Parse(Check(far, Relation.EQUAL, near), _SAYS, used | second.used)
        return
    measures = (text.find(i, "measure") for i in range(cue.start, min(cue.end + 5, len(text))))
    side = next((one for one in measures if one is not None and one.value in ALONG), None)
    axis, used = (ALONG[side.value], used | set(side.tokens)) if side is not None else (None, used)
    if axis is None and text.is_word(cue.start, *_CENTRED):
        axis, along = axis_named(question, set())
        used |= along
    owner = others[0].part if others and others[0].query is not None else PartQuery(noun="object", words=("object",))
    yield Parse(Check(Distance(subject.part, owner, "centers", axis), Relation.AT_MOST, 0.0), _SAYS, used)


def _in_line(question: Question, start: int) -> Iterator[Parse]:
    """'Are the two bores in line?', 'Is the pin on the same axis as the bore?'"""
    text = question.text
    cue = _first(text, start + 1, "in_line")
    subject = _subject(question, start, cue.start) if cue is not None else None
    if cue is None or subject is None:
        return
    joined = _subject(question, subject.end, cue.start) if text.is_word(subject.end, "and") else None
    other = next(iter(_behind(question, cue.end)), joined)  # 'are the bore and the pin coaxial'
    used = {*subject.used, *cue.tokens, *(other.used if other is not None else ())}
    strict = any(text.is_word(i, "axis", "coaxial", "concentric") for i in range(cue.start, len(text)))
    second = other.query if other is not None else None
    yield Parse(Parallel(subject.part, second, in_line="axis" if strict else "row"), _SAYS, used)


def _facing(question: Question, start: int) -> Iterator[Parse]:
    """'Are the hub and the pin on the same side?', 'Are the two lugs opposite each other?'"""
    text = question.text
    for at in sorted(text.at_words("same", "opposite")):
        sided = text.is_word(at + 1, "side", "face", "direction")
        subject = _subject(question, start, at)
        if subject is None or not (sided or text.is_word(at + 1, "each", "one")):
            continue
        joined = next((m for m in _behind(question, subject.end + 1) if m.start < at), None)
        other = joined if text.is_word(subject.end, "and") else None
        if other is None and sided and not subject.plural:  # '… on the same side as the pin'
            other = next(iter(_behind(question, at + 3)), None)
        second = other.part if other is not None else None
        used = {*subject.used, *range(subject.end, at + 3 - sided), *(other.used if other is not None else ())}
        used |= {i for m in question.parts if m.start > at for i in m.used} if sided else set()  # '… of the web'
        how: Literal["same", "opposite", "across"] = "opposite" if text.is_word(at, "opposite") else "same"
        how = how if sided else "across"
        yield Parse(Facing(subject.part, second, how), _SAYS, used)


def _traits(question: Question, start: int) -> Iterator[Parse]:
    """'Is the boss hollow?', 'Is the bottom of the pocket flat?': nouns that are adjectives here."""
    text, end = question.text, question.asking[1]
    said = next((span for span in text.all("adjective") if span.end == end and text.find(span.start, "noun")), None)
    subject = _subject(question, start, said.start) if said is not None else None
    if said is not None and subject is not None and said.value.tags and text.find(start, "be"):
        such = replace_fields(subject.part, adjectives=(*subject.part.adjectives, said.value.name))
        yield Parse(Every(subject.part, all_such(such)), _SAYS, {*subject.used, *said.tokens})


def _both(question: Question, start: int) -> Iterator[Parse]:
    """'Is there a slot in both flanges?', 'Does each lug have a hole?', 'Are there chamfers at both ends?'"""
    text = question.text
    at = next((i for i in sorted(text.at_words("both", "each")) if i >= start), None)
    if at is None:
        return
    holder = next((m for m in question.parts if m.start == at), None)
    what = next((m for m in question.parts if m.start > at and holder is not None and m is not holder), None)
    if holder is not None and what is not None:
        has = any(text.find(i, "have", "carry") for i in range(holder.head + 1, what.start))
        held = replace_fields(holder.part, count=None, plural=True)
        enough = Check(Count(placed_in(_several(what.part), "of", held)), Relation.AT_LEAST, Count(held))
        yield from [Parse(enough, _SAYS, what.used | holder.used)] if has else ()
        return
    on_both = next((m for m in question.parts if m.start < at < m.end), None)
    what = on_both or next((m for m in reversed(question.parts) if m.end <= at), None)
    if what is None or (text.find(at + 1, "noun", "side_noun") is None and on_both is None):
        return
    place = next((one for one in reversed(what.part.places) if on_both is not None and one.what), None)
    ends, used = text.find(at + 1, "side_noun"), {*what.used, at, at + 1}
    if ends is not None and not (text.is_word(at - 1, "through") or {"open at both ends"} & {*what.part.adjectives}):
        named = " ".join(text.words[at + 1 : ends.end])
        at_end = place is not None and place.what is not None and place.what.noun == named
        bare = _several(without(what.part, place) if place is not None and at_end else what.part)
        owner = next((m for m in question.parts if m.end <= what.start), None)
        if owner is not None and any(text.find(i, "have") for i in range(owner.end, what.start)):
            bare, used = placed_in(bare, "of", owner.part), used | owner.used
        yield Parse(AtBothEnds(bare), _SAYS, used)
    elif ends is None and place is not None and place.what is not None:
        held, bare = replace_fields(place.what, count=None, plural=True), _several(without(what.part, place))
        enough = Check(Count(placed_in(bare, place.relation, held)), Relation.AT_LEAST, Count(held))
        yield Parse(enough, _SAYS, used)


def _several(query: PartQuery) -> PartQuery:
    """However many there are of them."""
    return replace_fields(query, plural=True, count=None, definite=False)


def _first(text: Text, start: int, *categories: str) -> Span | None:
    return next((span for span in text.all(*categories) if span.start >= start), None)


def _subject(question: Question, start: int, end: int) -> Mention | None:
    """The parts that are named from a clause's verb to another token, whatever is said of them behind it."""
    at = next((m.start for m in question.parts if start <= m.start and (m.head < end or m.start < end < m.end)), None)
    if at is None:
        return question.antecedent(start)
    clipped = Text(" ".join(token.raw for token in question.text.tokens[:end]))
    mention = Phrases(clipped).at(at) if clipped.words == question.text.words[:end] else None
    return mention if mention is not None and mention.query is not None else None


def _behind(question: Question, at: int) -> list[Mention]:
    """The parts that are named behind a token."""
    inner = (question.phrases.at(i, 1, joined=False) for i in range(at, min(at + 4, len(question.text))))
    first = next((m for m in inner if m is not None and m.query is not None), None)
    return [first, *(m for m in question.parts if m.start >= first.end)] if first is not None else []


def _clause_end(text: Text, at: int) -> int:
    return next((i for i in range(at, len(text)) if text.is_break(i) or text.is_word(i, ",")), len(text))
