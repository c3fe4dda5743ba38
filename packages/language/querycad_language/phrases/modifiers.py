"""What stands behind the noun: 'with a thread', 'larger than 5 mm', 'except the one in the middle'."""

from __future__ import annotations

from typing import TYPE_CHECKING

from querycad_contracts import Measure, Place, Rank
from querycad_language.lexicon import Span
from querycad_language.text import Text
from querycad_language.tokens import Kind

from .mention import MAX_DEPTH, Draft, Mention
from .places import along, central, nearest, placed, seen, sideways
from .sizes import stated_size
from .words import is_noun, noun_follows, superlative

if TYPE_CHECKING:
    from .reader import Phrases

_GAP = ("be", "do", "seeing", "function", "have")
"""Words that may lead to a modifier: 'that are', 'which has'."""


def modifiers(phrases: Phrases, at: int, draft: Draft, depth: int, joined: bool) -> int:
    """Where the modifiers that begin here end."""
    end = at
    while (after := _modifier(phrases, end, draft, depth, joined)) > end:
        end = after
    return end


def _modifier(phrases: Phrases, at: int, draft: Draft, depth: int, joined: bool) -> int:
    """Where a modifier that begins here, or behind words such as 'that are', ends; `at` where none does."""
    text = phrases.text
    start, relative = at, False
    for _ in range(6):
        if at >= len(text):
            return start
        if text.is_word(at, "(") or (text.is_word(at, ",") and at == start):
            if (after := _left_out(phrases, at + 1, draft, depth)) > at:
                draft.used.update(range(start, after))
                return after
            if not _opens(text, at):
                return start
            at += 1
            continue
        if text.tokens[at].kind is Kind.SYMBOL and not text.find(at, "relation"):
            return start
        if (after := _one_modifier(phrases, at, draft, depth, joined)) > at:
            draft.used.update(range(start, after))
            if text.is_word(after, ")") and any(text.is_word(i, "(") for i in range(start, after)):
                draft.used.add(after)
                after += 1
            return after
        relative = relative or text.is_word(at, "that", "which", "who")
        if not _leads(text, at) and not (relative and _is_verb(text, at)):
            return start
        at += 1
    return start


def _is_verb(text: Text, at: int) -> bool:
    """May the word be the verb of a relative clause, or an adverb: 'which pass vertically through the plate'?"""
    known = text.find(at, "noun", "measure", "scale", "adjective", "side", "place", "ask", "count", "be", "article")
    return text.tokens[at].kind is Kind.WORD and known is None


def _opens(text: Text, at: int) -> bool:
    """Does a modifier follow a comma or a bracket?"""
    if text.find(at + 1, "seeing", "except") or text.is_word(at + 1, "which", "that", "with"):
        return True
    if text.is_word(at + 1, "not", "no", "without") and text.find(at + 2, "side_preposition", "trait"):
        return True
    counted = any(text.find(i, "count") for i in range(at))
    if text.words[at] == "," and counted and stated_size(text, at + 1):
        return True  # 'how many holes, diameter over 5 mm'
    return text.words[at] == "(" and text.tokens[min(at + 1, len(text) - 1)].kind in (Kind.QUANTITY, Kind.THREAD)


def _leads(text: Text, at: int) -> bool:
    """May the word stand between a noun and a modifier of it?"""
    if text.find(at, *_GAP) is None or text.find(at, "measure", "scale") or text.is_word(at, "a", "an", "the"):
        return False
    verb = text.is_word(at, "do", "does", "how", "what", "have", "has")
    return not verb or text.is_word(at - 1, "that", "which")


def _one_modifier(phrases: Phrases, at: int, draft: Draft, depth: int, joined: bool) -> int:
    text = phrases.text
    if (end := seen(phrases, at, draft, depth)) > at:
        return end
    own = depth == 0 or text.is_word(at - 1, "that", "which", "are", "is")  # else the noun around it is meant
    restricting = (_through, sideways, along, _colored, _ranked, _fitted, _stated_size)
    for read in restricting if own else (_fitted, _stated_size):
        if (end := read(text, at, draft)) > at:
            return end
    for nested in (_trait, _exception, nearest, central):
        if (end := nested(phrases, at, draft, depth)) > at:
            return end
    negated = text.is_word(at, "not")
    adjective = text.find(at + negated, "adjective")
    if adjective and not negated and draft.nouns and (face := _shaped(text, adjective, draft.nouns[-1])):
        draft.nouns[-1] = face
        return face.end
    if own and adjective and not is_noun(text, adjective.end) and adjective.value.tags and not text.find(at, "place"):
        (draft.lacking if negated else draft.adjectives).append(adjective.value.name)
        return adjective.end
    if (end := placed(phrases, at, draft, depth)) > at:
        return end
    if joined and text.is_word(at, "and", "or", "&", "plus") and (other := phrases.at(at + 1, depth + 1, False)):
        return _also(text, other, draft, at)
    return at


def _shaped(text: Text, adjective: Span, noun: Span) -> Span | None:
    """'faces that are cylindrical' are cylindrical faces: a noun of its own."""
    said = " ".join(text.words[adjective.start : adjective.end])
    found = text.lexicon.nouns.get(f"{said} face") if noun.value.name == "face" else None
    return Span(noun.start, adjective.end, "noun", found) if found is not None else None


def _also(text: Text, other: Mention, draft: Draft, at: int) -> int:
    """'holes and slots': both kinds count; not where a measure of its own follows."""
    query = other.query
    if query is None or not draft.nouns or not query.known or not query.noun or not query.plural:
        return at
    if text.find(other.end, "measure", "be", "do") or not any(text.tokens[i].plural for i in draft.nouns[-1].tokens):
        return at
    draft.also.append(query)
    return other.end


def _through(text: Text, at: int, draft: Draft) -> int:
    """'that go all the way through', 'do not pass through the part', 'are through'."""
    end = text.skip(at, "passing", "do", "negation")
    if (out := text.find(end, "emerging")) or text.find(end, "stopping"):
        return _ending(text, at, end, draft, "through" if out else "blind")
    negated = any(text.find(i, "negation") for i in range(at, end)) or text.is_word(at - 1, "not")
    tags = draft.lacking if negated else draft.adjectives
    if end > at and text.is_word(end, "from") and text.is_word(end + 1, "one") and text.find(end + 2, "side_noun"):
        ahead = range(end + 3, min(len(text), end + 10))  # 'that go from one side of the part out to the other'
        if other := next((i for i in ahead if text.is_word(i, "other", "opposite")), 0):
            tags.append("through")
            return other + 1
    if not text.is_word(end, "through") or (end == at and not text.find(at - 1, "be", "negation")):
        return at
    inner = text.skip(end + 1, "each", "article")
    whole = text.find(inner, "whole") or text.is_word(inner, "side", "way", "thickness", "wall")
    if whole and not text.is_word(inner + 1, "of"):
        stop = inner + 1
    elif noun_follows(text, end + 1):
        return at  # 'through the lid': a place
    else:
        stop = end + 1
    tags.append("through")
    return stop


def _ending(text: Text, at: int, verb: int, draft: Draft, tag: str) -> int:
    """'that come out on the other side', 'that stop inside the material'."""
    end = text.skip(verb, "emerging", "stopping")
    place = text.skip(end, "place", "side_preposition", "article")
    if place == end and not text.is_word(end, "to"):
        return at
    if text.is_word(place, "to", "other", "far", "opposite", "back"):
        across = next((i for i in range(place, min(len(text), place + 5)) if text.find(i, "side_noun")), None)
        stop = None if across is None or tag == "blind" else across + 1
    else:
        stop = place + 1 if tag == "blind" and text.find(place, "stuff", "whole") else None
    if stop is None:
        return at
    negated = any(text.find(i, "negation") for i in range(at, verb)) or text.is_word(at - 1, "not")
    (draft.lacking if negated else draft.adjectives).append(tag)
    return stop


def _colored(text: Text, at: int, draft: Draft) -> int:
    """'which bodies are red'."""
    color = text.find(at, "color")
    if color is None or not text.find(at - 1, "be") or is_noun(text, color.end):
        return at
    draft.colors.append(color.value)
    return color.end


def _stated_size(text: Text, at: int, draft: Draft) -> int:
    """'with a diameter of 5 mm', 'larger than 5 mm', 'from 4 to 6 mm', '5 mm deep', 'Ø8.5'."""
    found = stated_size(text, at)
    if found is None:
        return at
    noun, place = text.find(found[1], "noun"), text.find(found[1], "measure", "place", "seeing")
    if is_noun(text, found[1]) and (place is None or (noun and noun.end > place.end)):
        return at  # '… around the 13 mm holes', '… 5 mm through holes': the size is another noun's
    draft.sizes.append(found[0])
    return found[1]


def _fitted(text: Text, at: int, draft: Draft) -> int:
    """'that are M6', 'that take an M6 bolt', 'would an M6 bolt fit'."""
    begin = text.skip(at, "modal")
    start = text.skip(text.skip(begin, "fits"), "article")
    if start >= len(text) or text.tokens[start].kind is not Kind.THREAD:
        return at
    noun = text.find(start + 1, "noun")
    end = noun.end if noun is not None else start + 1
    behind = text.find(end, "fits")
    if noun is not None and not text.find(begin, "fits") and behind is None:
        return at  # '… are M6 holes': the thread is another noun's
    draft.threads.append(text.tokens[start].word)
    return behind.end if behind is not None else end


def _ranked(text: Text, at: int, draft: Draft) -> int:
    """'with the smallest diameter', 'is the largest'."""
    place = text.find(at, "place", "have")
    alone = superlative(text, at + 2) if text.find(at, "be") and text.is_word(at + 1, "the") else None
    if alone is not None and not noun_follows(text, alone.end):
        draft.ranks.append(Rank(measure=alone.value.measure, most=alone.value.degree == "most"))
        return alone.end
    nth = text.find(text.skip(at, "be"), "ordinal")
    if nth is not None and text.is_word(nth.end, "in", "by") and text.find(nth.end + 1, "measure", "scale"):
        draft.ranks.append(Rank(measure=Measure.MAGNITUDE, most=True, nth=nth.value))  # 'is second in size'
        return nth.end + 2
    if place is None or place.value not in ("with", "of", "have"):
        return at
    start = text.skip(place.end, "article")
    span = text.find(start, "most", "least") or superlative(text, start)
    if span is None or (measure := text.find(span.end, "measure")) is None:
        return at
    most = span.category == "most" or (span.category == "scale" and span.value.degree == "most")
    draft.ranks.append(Rank(measure=measure.value, most=most))
    return measure.end


def _trait(phrases: Phrases, at: int, draft: Draft, depth: int) -> int:
    """'with a thread', 'without counterbore', 'having four holes'."""
    text = phrases.text
    place = text.find(at, "place")
    if place is not None and place.value not in ("with", "without"):
        place = None
    if (end := _neither(text, at, draft)) > at:
        return end
    counts = depth == 0 and any(text.find(i, "count") for i in range(at))  # 'how many holes have a thread'
    lead = place or (text.find(at, "have") if counts else None)
    if lead is None:
        return at
    lacking = place is not None and place.value == "without"
    start = lead.end
    if text.is_word(start, "no", "any"):
        lacking = lacking or text.is_word(start, "no")
        start += 1
    start = text.skip(start, "article")
    span = text.find(start, "trait")
    longer = text.find(start, "noun")
    if span is not None and not (longer and longer.end > span.end) and not text.find(span.end, "relation"):
        (draft.lacking if lacking else draft.adjectives).append(span.value.name)
        return _further(text, span.end, draft) if lacking else span.end
    other = phrases.at(start, depth + 1, False) if depth < MAX_DEPTH and place is not None else None
    if other is None or other.query is None:
        return at
    draft.places.append(Place(relation="with", what=other.query, negated=lacking))
    return other.end


def _neither(text: Text, at: int, draft: Draft) -> int:
    """'have neither a thread nor a chamfer', 'no thread no chamfer'."""
    start = text.skip(at, "have")
    if not text.is_word(start, "neither", "no"):
        return at
    span = text.find(text.skip(start + 1, "article"), "trait")
    if span is None:
        return at
    draft.lacking.append(span.value.name)
    return _further(text, span.end, draft)


def _further(text: Text, at: int, draft: Draft) -> int:
    """'without thread, or chamfer', '… and without chamfer': the further attributes that parts must not have."""
    end = at
    while text.is_word(end, "nor", "or", "and", ",", "no", "without", "any", "neither"):
        end += 1
    span = text.find(text.skip(end, "article"), "trait")
    if end == at or span is None or text.find(span.end, "relation"):
        return at
    draft.lacking.append(span.value.name)
    return _further(text, span.end, draft)


def _left_out(phrases: Phrases, at: int, draft: Draft, depth: int) -> int:
    """', the dowel holes left out'."""
    other = phrases.at(at, depth + 1, False) if depth == 0 else None
    span = phrases.text.find(other.end, "left_out") if other is not None and other.query is not None else None
    if other is None or other.query is None or span is None:
        return 0
    draft.excluded.append(other.query)
    return span.end


def _exception(phrases: Phrases, at: int, draft: Draft, depth: int) -> int:
    """'except the one in the middle'."""
    text = phrases.text
    than = text.find(at, "scale") if text.is_word(at + 1, "than") and text.is_word(at + 2, "the") else None
    if than and than.value.degree in ("more", "less") and (end := superlative(text, at + 3)) and depth == 0:
        opposed = (than.value.degree == "less") == (end.value.degree == "most")  # 'smaller than the largest'
        other = phrases.at(at + 2, depth + 1) if opposed else None
        if other is not None and other.query is not None:
            draft.excluded.append(other.query)
            return other.end
    span = text.find(at, "except", "minus")
    if span is None or depth > 0:
        return at  # 'holes in the ring except the large one' excludes a hole
    inner = text.skip(span.end, "article")
    if span.category == "minus" and not (inner > span.end and superlative(text, inner)):
        return at  # 'minus the largest'
    other = phrases.at(span.end, depth + 1)
    if other is None or other.query is None:
        return at
    draft.excluded.append(other.query)
    return other.end
