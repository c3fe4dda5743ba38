"""Noun phrases: which parts does a stretch of the question mean?

A phrase is read from left to right. What selects by number, side, place or rank becomes a filter; function words are
passed over; every other word is description, kept for SegCAD to ground.
"""

from __future__ import annotations

import re
from collections.abc import Callable
from dataclasses import replace
from typing import TypeAlias

from . import modifiers, relations
from .draft import MODEL_NOUN, Draft, finished
from .lexicon import LEXICON
from .meaning import AnyOf, Bottom, Described, Filter, NounClass, Phrase, Seen, Selection, Target, Whole
from .readings import bounded
from .text import Text
from .tokens import Kind

Rule: TypeAlias = Callable[[Text, int, int, Draft], int | None]
"""Reads one modifier into the draft: where does it end? None when it does not stand there."""

_SHORTEST_CLAUSE = 3
"""'the shaft enters': an article, a noun and a verb."""
_MOST_COUNTED = 99
"""More than these nobody counts in a question."""
_DENIED = re.compile(r"(?:non-?|un)(\w+(?:ed|unk))")
"""'non-threaded', 'unthreaded': not threaded."""
_NO_CONJUNCT = ("light", "verb", "negation", "place", "centered")
"""What follows 'and' and goes on about the same parts."""


def target(text: Text, start: int, end: int, like: Target | None = None) -> Target | None:
    """Which parts, or the whole model, does `start:end` mean? `like` is what 'the one' and 'it' stand for."""
    return text.attempt(_target, start, end, like)


def selection(text: Text, start: int, end: int, like: Target | None = None) -> Selection | None:
    """Which parts does `start:end` mean? Nouns for the whole model mean its bodies here."""
    found = target(text, start, end, like)
    return Selection((Phrase(MODEL_NOUN, NounClass.BODY),)) if isinstance(found, Whole) else found


def predicate(text: Text, start: int, end: int, owner: Selection) -> tuple[Filter, ...] | None:
    """What is said of parts in 'are … (threaded, visible from the top, 10 mm deep)'? None when not clear."""
    head = owner.phrases[0].noun
    draft = Draft(words=[head], closed=True)
    at = start
    while at < end:
        at = _step(text, at, end, draft)
    if draft.refused or draft.ranks or draft.tail or draft.words != [head] or len(draft.sides) > 1:
        return None
    adjectives, denied = draft.said(head)
    filters: list[Filter] = [bounded(condition, owner.noun_class, text) for condition in draft.filters]
    filters += [Seen(side, True) for side in draft.sides]
    filters += [Described(" ".join([*adjectives, head]), True)] if adjectives else []
    filters += denied
    return tuple(filters) or None


def _target(text: Text, start: int, end: int, like: Target | None) -> Target | None:
    draft = Draft()
    others: Selection | None = None
    at = start
    while at < end and others is None:
        if (same := _apposed(text, at, end, draft)) is not None:
            first = finished(text, draft, like)
            if isinstance(first, Selection) and (is_known(first) or not is_known(same)):
                text.leave_out(at, end)
                return first
            text.leave_out(start, at)
            return same
        others = _conjunct(text, at, end, draft)
        at = at if others else _step(text, at, end, draft)
    first = finished(text, draft, like)
    if others is None or first is None:
        return first if others is None else None
    if isinstance(first, Whole):
        return others
    head = first.phrases[-1]
    if not head.sides and not head.filters:  # 'holes and slots on the top': both on the top
        head = replace(head, sides=others.phrases[-1].sides, filters=others.phrases[-1].filters)
    return Selection((*first.phrases[:-1], head, *others.phrases))


def _apposed(text: Text, at: int, end: int, draft: Draft) -> Selection | None:
    """'the socket, the small cylinder inside the shade': the same part in other words, and no list of parts."""
    if not text.word_at(at, end, ",") or not draft.words or not text.match("article", at + 1, end):
        return None
    if any(text.match("conjunction", i, end) and not text.word_at(i, end, ",") for i in range(at + 1, end)):
        return None
    stop = end - text.word_at(end - 1, end, ",")
    if any(text.word_at(i, stop, ",", "one", "ones") for i in range(at + 1, stop)):
        return None
    other = target(text, at + 1, stop)
    return other if isinstance(other, Selection) and not other.phrases[0].ranks else None


def is_known(parts: Selection) -> bool:
    """Is it a word of the trade, by which people explain others?"""
    noun = (parts.phrases[0].noun,)
    return any(LEXICON.match(category, noun, 0, 1) for category in ("noun", "common_noun"))


def _conjunct(text: Text, at: int, end: int, draft: Draft) -> Selection | None:
    """'… and slots': the other phrases. 'blind and through holes' lends its noun to the first."""
    joined = text.after("conjunction", at, end)
    if joined is None or not draft.words:
        return None
    rest = text.skip(joined, end, "conjunction", "article")
    if _goes_on_about(text, at, rest, end, draft) or text.match("minus", rest, end):
        return None
    same_parts = any(rule(text, rest, end) for rule in (modifiers.bound, modifiers.sides, modifiers.rank))
    if rest >= end or same_parts or any(text.after(category, rest, end) for category in _NO_CONJUNCT):
        return None
    others = target(text, rest, end)
    if not isinstance(others, Selection):
        return None
    words = others.phrases[0].description.split()
    if len(words) == 1 and len(others.phrases) == 1 and text.find("ones", rest, min(end, rest + 3)):
        named = f"{words[0]} {LEXICON.singular(draft.words[-1])}"  # 'the blind holes and the threaded ones'
        return Selection((replace(others.phrases[0], description=named, plural=True),))
    adjective = not draft.tail and not draft.closed and not LEXICON.is_plural(draft.words[-1])
    if adjective and others.phrases[-1].plural and len(words) > 1:
        draft.words += words[1:]
    return others


def _goes_on_about(text: Text, at: int, rest: int, end: int, draft: Draft) -> bool:
    """Is it still the same part: 'the lid, the round one', 'the tube without keyway and rim', 'with pins and ribs'?"""
    if text.word_at(at, end, ",") and text.find("ones", rest, min(end, rest + 3)):
        return True
    bare = rest == at + 1 and text.word_at(at, end, "and", "or")
    return draft.in_tail and ("without" in draft.tail or (draft.tail[0] == "with" and bare))


def _step(text: Text, at: int, end: int, draft: Draft) -> int:
    """Read one modifier or word; where does it end?"""
    negated, places, filters = draft.negated, len(draft.located), len(draft.filters)
    for rule in _RULES:
        after = rule(text, at, end, draft)
        if after is None or after <= at:
            continue
        if negated and draft.negated and len(draft.located) > places:
            draft.elsewhere.append(draft.located[places:])
            del draft.located[places:]
            draft.negated = False
        draft.refused = draft.refused or (negated and draft.negated and len(draft.filters) > filters)
        return after
    return at + 1


def _relation(rule: Callable[[Text, int, int, Draft, relations.Nested], int | None]) -> Rule:
    """A rule that reads a noun phrase within this one."""
    return lambda text, at, end, draft: rule(text, at, end, draft, target)


def _quantifier(text: Text, at: int, end: int, draft: Draft) -> int | None:
    if draft.in_tail:
        return None
    if (after := text.after("sample", at, end)) and not draft.words:
        draft.sample = True
        return after
    number = text.number(at, end)
    if number and number.power == 0:
        text.leave_out(at, at + 1)  # '45 degree bevel'
        return at + 1
    if number and number.power is None and not draft.words and number.value == int(number.value):
        if modifiers.bound(text, at, end) or modifiers.rank(text, at, end):
            return None
        draft.plural = draft.plural or number.value > 1
        definite = at > 0 and text.word_at(at - 1, end, "the", "these", "those", "its", "both")
        counted = definite and 1 < number.value <= _MOST_COUNTED
        draft.count = int(number.value) if counted else draft.count
        return at + 1
    if after := text.after("each", at, end):
        draft.plural = True
        return after
    if text.word_at(at, end, "one", "ones") and not draft.words:
        draft.plural = draft.plural or text.words[at] == "ones"
        return at + 1
    return text.after("quantifier", at, end)


def _bottom(text: Text, at: int, end: int, draft: Draft) -> int | None:
    """'with a conical bottom', 'flat-bottomed'."""
    form = text.match("bottom_form", text.skip(at, end, "lead"), end)
    noun = text.after("bottom_noun", form[1], end) if form else None
    if form is None or noun is None or not (draft.words or text.words[noun - 1] == "bottomed"):
        return None
    draft.filters.append(Bottom(form[0], not draft.negated))
    draft.negated = False
    return draft.close(noun)


def _filter(text: Text, at: int, end: int, draft: Draft) -> int | None:
    found = modifiers.bound(text, at, end) or relations.bound_by_part(text, at, end, target)
    if found is None:
        return None
    condition, after = found
    if draft.negated and not isinstance(condition, AnyOf):
        condition = replace(condition, relation=condition.relation.negated)
        draft.negated = False
    draft.filters.append(condition)
    return draft.close(after)


def _called(text: Text, at: int, end: int, draft: Draft) -> int | None:
    """'(the part) called cover plate': the name is the description."""
    after = text.after("called", at, end)
    if after is None or after >= end or not (draft.words or draft.whole):
        return None
    draft.words.clear()
    draft.whole = draft.closed = False
    return after


def _related(text: Text, at: int, end: int, draft: Draft) -> int | None:
    """'(the screws) hold the cover': parts that others touch, carry or surround; SegCAD looks whether they do."""
    found = text.match("relating_verb", at, end)
    if found is None or not draft.words:
        return None
    link, after = found
    if not text.match("article", after, end):
        return None
    noun = stop = text.skip(after, end)
    stops = ("container", "verb", "light", "conjunction", "lead")
    while stop < end and (stop == noun or not any(text.match(category, stop, end) for category in stops)):
        stop += 1
        if text.word_at(stop, end, "to", "with", "against"):  # 'fix the cover to the housing'
            stop = noun = text.skip(stop + 1, end)
    other = target(text, after, stop)
    if isinstance(other, Selection) and not other.phrases[0].filters and not other.phrases[0].ranks:
        draft.located += [link, *other.phrases[0].description.split()]
    elif not isinstance(other, Whole):
        text.leave_out(at, stop)
    return draft.close(stop)


def _rank(text: Text, at: int, end: int, draft: Draft) -> int | None:
    found = modifiers.rank(text, at, end)
    if found is None:
        return None
    chosen, after = found
    if draft.words and not draft.closed and text.tokens[at - 1].kind is Kind.POSSESSIVE:  # 'the tube's wider bore'
        draft.located += ["in", *(LEXICON.singular(word) for word in draft.words)]
        draft.words.clear()
    draft.ranks.append(chosen)
    draft.plural = draft.plural or chosen.count > 1
    if draft.words:
        return draft.close(after)
    if text.word_at(after, end, "of", "among"):
        draft.singular = chosen.count == 1
        return after + 1
    return after


def _side(text: Text, at: int, end: int, draft: Draft) -> int | None:
    verbs = not text.match("noun_verb", at, end) or (bool(draft.words) and not _only_adjectives(draft))
    found = modifiers.sides(text, at, end, verbs)
    if found is None:
        return None
    named, after = found
    if draft.in_tail and not named.prepositional and not named.noun:
        draft.tail.extend(side.value for side in named.sides)
        return after  # 'the bevel around the upper rim'
    if draft.negated or named.all_of_them:
        draft.filters.extend(Seen(side, not draft.negated) for side in named.sides)
        draft.negated = False
    else:
        draft.sides.extend(side for side in named.sides if side not in draft.sides)
        draft.ends.extend(named.sides if named.noun in ("end", "ends") else ())
        draft.seen, draft.at = draft.seen or named.seen, draft.at or named.at
        if not draft.words and not named.prepositional and not named.noun:
            draft.leading.extend(named.sides)
            draft.highest = draft.highest or text.word_at(after - 1, after, "upper", "lower")
    itself = text.match("side_itself", after - 1, end) is not None and not named.prepositional and not draft.closed
    if itself and draft.words and _only_adjectives(draft):
        draft.words.append("face")  # 'the flat underside'
    elif not draft.words and not named.prepositional:
        draft.side_noun = named.noun or ("face" if itself else "")
    return draft.close(after)


def _of_whole(text: Text, at: int, end: int, draft: Draft) -> int | None:
    if (draft.words or draft.whole) and (after := relations.of_whole(text, at, end)) is not None:
        return draft.close(after)
    after = relations.whole_noun(text, at, end)
    if after is None:
        return None
    if draft.words and not draft.closed and text.words[at - 1] == draft.words[-1]:
        return None  # 'circular part': the noun belongs to its adjective
    draft.whole = draft.whole or not draft.words
    draft.body = draft.body or text.match("body_noun", after - 1, end) is not None
    return after + text.word_at(after, end, "'s")


def _negation(text: Text, at: int, end: int, draft: Draft) -> int | None:
    left_out = text.after("excluded", at, end)
    if left_out is not None and (left_out >= end or text.words[left_out] == ","):
        draft.refused = True  # 'the threaded ones not counted'
        return left_out
    after = text.after("negation", at, end)
    draft.negated = draft.negated or after is not None
    return after


def _contact_clause(text: Text, at: int, end: int, draft: Draft) -> int | None:
    """'(the plate) the shaft comes out of': a clause without pronoun; it is left out aloud."""
    if not draft.words or draft.closed or draft.in_tail or not text.match("article", at, end):
        return None
    directly = text.words[at - 1] == draft.words[-1]
    last = text.match("preposition", end - 1, end) or text.match("verb", end - 1, end)
    if not directly or not last or end - at < _SHORTEST_CLAUSE:
        return None
    text.leave_out(at, end)
    return draft.close(end)


def _function_word(text: Text, at: int, end: int, draft: Draft) -> int | None:
    if text.tokens[at].kind is Kind.POSSESSIVE:
        return at + 1
    if text.word_at(at, end, ","):
        more = draft.words and not draft.closed and _only_adjectives(draft)  # 'the inner, smaller cylinder'
        return at + 1 if more else draft.close(at + 1)
    if text.word_at(at, end, "of", "among", "amongst") and not draft.words:
        return at + 1
    if after := text.after("article", at, end) or text.after("noise", at, end):
        draft.this = draft.this or (text.words[at] == "this" and not draft.words)
        return after
    if after := text.after("light", at, end):
        return after if not draft.words else draft.close(after)
    return _verb(text, at, end, draft)


def _verb(text: Text, at: int, end: int, draft: Draft) -> int | None:
    """'visible', 'located', 'drilled'; not where the word is the noun: 'the rectangular opening in …'."""
    after = text.after("verb", at, end)
    if after is None or (draft.in_tail and text.match("noun_verb", at, end)):
        return None
    if text.match("noun_verb", at, end) and not draft.closed:
        if draft.words and _only_adjectives(draft):
            return None
        leads = text.match("side_preposition", after, end) or text.match("axis_adverb", after, end)
        leads = leads or text.match("preposition", after, end)
        if not draft.words or not leads:
            return None
    return draft.close(after)


def _description(text: Text, at: int, end: int, draft: Draft) -> int:
    """Take one word into the description, or note that it was not used."""
    word = text.words[at]
    joined = text.after("conjunction", at, end)
    if joined or text.tokens[at].kind is Kind.SYMBOL:
        draft.refused = draft.refused or word == "or"
        link = draft.tail[0] if joined and draft.in_tail else ""
        if link in ("with", "without"):
            draft.tail.append(link)  # 'without keyway and collar'
        return joined or at + 1
    named = word == "half" and not draft.closed  # 'the clamp half', 'the half round notch'
    named = named and (bool(draft.words) or text.word_at(at + 1, end, "round", "circular", "circle", "moon"))
    if text.after("relational", at, end) and not named:
        draft.refused = True
        return at + 1
    if (draft.whole and not draft.words) or text.after("unnameable", at, end):
        text.leave(at)
        return at + 1
    if denied := _DENIED.fullmatch(word):
        draft.described.append(([denied[1]], False))
        return at + 1
    if draft.closed and (adjective := text.match("axis_adjective", at, end)):
        draft.describe(adjective[0], False)
        return at + 1
    preposition = text.after("preposition", at, end)
    if _is_noun(text, at, end, draft):
        draft.words.append(word)
        return at + 1
    if preposition and draft.words:
        return _prepositional(text, at, preposition, end, draft)
    if draft.in_tail:
        draft.tail.append(word)
    elif draft.closed:
        draft.describe(word, _goes_on(text, at))
    elif not preposition or text.after("adjective_preposition", at, end):
        draft.words.append(word)
    return at + 1


def _only_adjectives(draft: Draft) -> bool:
    """Is the noun still to come: 'the round …'?"""
    return all(LEXICON.match("shape_adjective", (word,), 0, 1) for word in draft.words)


def _is_noun(text: Text, at: int, end: int, draft: Draft) -> bool:
    """Is 'inside' a noun here: 'the rectangular inside (of the box)'?"""
    if not text.word_at(at, end, "inside", "outside", "interior", "exterior") or draft.closed or draft.tail:
        return False
    if not _only_adjectives(draft):
        return False
    return not draft.words or at + 1 >= end or not text.match("article", at + 1, end)


def _goes_on(text: Text, at: int) -> bool:
    """Is the word before part of the same predicate, as 'through' in 'are through holes'?"""
    return not any(text.after(category, at - 1, at) for category in (*_NO_CONJUNCT, "article", "conjunction"))


def _prepositional(text: Text, at: int, after: int, end: int, draft: Draft) -> int:
    """'with (a) ring' stays in the description; 'with no' is 'without'."""
    word = text.words[at]
    if word == "with" and text.word_at(after, end, "no"):
        word, after = "without", after + 1
    if after < end:
        draft.tail.append(word)
        draft.closed = False
    return after


def _having(text: Text, at: int, end: int, draft: Draft) -> int | None:
    """'(standoffs) that have a hole', '(standoffs) have no hole': a trait, for SegCAD to look at."""
    verb = text.skip(at, end, "relative")
    if not text.word_at(verb, end, "have", "has", "having") or not draft.words:
        return None
    if not text.word_at(verb + 1, end, "a", "an", "no") and verb == at:
        return None
    if modifiers.bound(text, at, end) or modifiers.rank(text, at, end) or text.find("same", verb, end):
        return None
    noun = text.skip(verb + 1, end)
    noun += text.word_at(noun, end, "no")
    stop = noun
    while stop < end and not any(text.match(c, stop, end) for c in ("verb", "light", "conjunction", "relative")):
        if modifiers.sides(text, stop, end) or text.match("property", stop, end):
            break
        stop += 1
    other = target(text, noun, stop)
    if not isinstance(other, Selection) or other.phrases[0].filters or other.phrases[0].ranks:
        return None
    link = "without" if text.word_at(noun - 1, end, "no") else "with"
    draft.located += [link, *other.phrases[0].description.split()]
    return draft.close(stop)


_RULES: tuple[Rule, ...] = (
    _called,
    _having,
    _related,
    _quantifier,
    _bottom,
    _filter,
    _rank,
    _relation(relations.nearness),
    _relation(relations.place),
    _side,
    _of_whole,
    _relation(relations.owner),
    _relation(relations.within),
    _relation(relations.between),
    _negation,
    _contact_clause,
    _function_word,
    _description,
)
"""In the order in which they are tried: what selects comes before what is passed over, and description last."""
