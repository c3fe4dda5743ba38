"""Parts: which they are, on which side they lie, and questions that name nothing but a part."""

from __future__ import annotations

from collections.abc import Iterator
from itertools import pairwise

from querycad_contracts import Measure, PartQuery, Side
from querycad_language.forms import Count, Get, Parts, Towards
from querycad_language.lexicon import lexicon
from querycad_language.phrases import placed_in, replace_fields
from querycad_language.readings.parses import Parse
from querycad_language.readings.question import Question
from querycad_language.text import Text

from .related_parts import is_cut
from .values import material

MATES_WITHIN = 6  # words between a part and the verb that says where it goes
_TURNED = ("open", "opens", "face", "facing", "point", "lean", "look", "looks")
"""Verbs of which way something is turned."""
_UP_DOWN = {Side.TOP: ("up", "upward", "upwards"), Side.BOTTOM: ("down", "downward", "downwards")}


def parts(question: Question) -> Iterator[Parse]:
    """'Which ribs are higher than 11 mm?', 'On which side is the keyway?', 'What is the largest rib?'"""
    text = question.text
    start = question.asking[0]
    side = next((i for i in range(start, len(text)) if _asks_for_side(text, i)), None)
    offered, named = _offered(text)
    yield from (compared := list(_side_by_numbers(question, offered, named)))
    side, offered = (None, ()) if compared else (side, offered)
    begin = 0 if side is not None or offered else start  # 'the lug, which side?'
    at = text.skip(side + 3, "article") if side is not None and text.is_word(side + 2, "of") else -1
    owner = next((m for m in question.parts if m.start <= at < m.end), None)  # 'on which side of the plate is the lug'
    mentions = [m for m in question.parts if m.start >= begin and (m is not owner or len(question.parts) < 2)]
    compared_by = {i for i, word in enumerate(text.words) if text.lexicon.is_comparative(word)}
    for index, mention in enumerate(mentions[:3]):
        query = mention.part
        used = {*mention.used, *(owner.used if owner else ()), *(range(side - 1, side + 2) if side is not None else ())}
        features = {"which_side": 1.0, "count_far": float(index)}
        measured = not used.issuperset(compared_by)
        is_side = side is not None and mention.start <= side + 1 < mention.end  # 'in which wall is the window'
        if (offered or side is not None) and not (measured or is_side):  # 'which is thicker, the upper or the lower'
            bare = tuple(name for name in query.adjectives if name != "open")  # 'which way does the seat open'
            towards = Towards(replace_fields(query, sides=(), ends=(), adjectives=bare), offered or tuple(Side))
            turned = {i for i in text.at_words(*_TURNED) if i >= start}
            yield Parse(towards, {**features, "sides_offered": float(bool(offered))}, named | used | turned)
            if index == 0 and not is_cut(query) and (opens := text.at_words("open")):  # 'which side is the box open on'
                inside = Towards(PartQuery(noun="inside", words=("inside",), definite=True), towards.sides)
                yield Parse(inside, {**features, "opens": 1.0}, named | used | opens)
        lead = range(start, mention.start + 1)
        said = {i for i in lead if not text.is_content(i)} | mention.used
        way = any(text.is_word(i, "which") and text.is_word(i + 1, "way", "direction") for i in lead)
        listed = any(text.is_word(i, "list", "listed") for i in range(*question.asking))  # 'slots < 8 mm, list'
        value = any(text.find(i, "distance", "gap", "measure") for i in lead)  # 'find the distance from the lug'
        led = any(text.is_word(i, "which", "name") or (text.find(i, "showing") and not value) for i in lead)
        what = any(text.is_word(i, "what") and not text.find(i + 1, "operation") for i in lead)
        if (listed or led) and not way and index == 0:
            yield Parse(Parts(query), {"which": 1.0}, said)
            yield Parse(Get((Measure.NAME,), query), {"which": 1.0}, said)
        elif what and index == 0 and not value:
            yield Parse(Get((_named_by(query),), query), {"named_only": 1.0}, said)


def _side_by_numbers(question: Question, offered: tuple[Side, ...], named: set[int]) -> Iterator[Parse]:
    """'Which side has the most holes?', 'Are there more lugs on the left or on the right?', 'Which sides have none?'"""
    text, asking = question.text, range(*question.asking)
    faces = {i for i in asking if text.is_word(i, "side", "face")}
    most = {i for i in asking if text.is_word(i, "most") or (text.is_word(i, "more") and offered)}
    part = next((m for m in question.parts if m.used.isdisjoint(faces)), None)
    if part is None:
        return
    if most and (faces or offered):
        target = replace_fields(part.part, plural=True, ranks=(), sides=())
        towards = Towards(target, offered or tuple(Side), "most")
        yield Parse(towards, {"which_side": 1.0}, named | faces | most | part.used)
    none = {i for i in asking if text.is_word(i, "no", "without", "none", "free", "zero", *["not"] * (i < part.start))}
    if faces and none and not text.at_phrases("count"):  # 'Name the sides without lugs.'
        target = replace_fields(part.part, plural=True, places=(), count=None)
        yield Parse(Towards(target, tuple(Side), "none"), {"which_side": 1.0}, faces | none | part.used)


def _named_by(query: PartQuery) -> Measure:
    noun = lexicon().nouns.get(query.noun)
    return noun.measure if noun is not None else Measure.MAGNITUDE


def _asks_for_side(text: Text, at: int) -> bool:
    """'which side', 'on what face', 'which way does it face', 'the side on which', 'side with the lug'."""
    behind = range(at + 2, min(at + 9, len(text)))
    if text.is_word(at, "which", "what"):
        turned = text.is_word(at + 1, "way", "direction") and text.has(*_TURNED)
        carries = any(text.find(i, "have", "carry") for i in behind) or text.is_word(at - 1, "on", "in", "at")
        carries = carries or any(text.is_word(i, "on", "in", "at") and text.is_word(i + 1, "?") for i in behind)
        end = text.is_word(at + 1, "face", "wall", "end", "edge", "flank")
        return text.is_word(at + 1, "side") or turned or (end and carries)
    side = text.is_word(at + 1, "side") and not text.find(at, "side", "place", "side_preposition")
    carries = text.find(at + 2, "have", "carry") is not None or text.is_word(at + 2, "with", "carrying", "having")
    where = carries or any(text.is_word(i, "where", "which", "that") for i in behind)
    return where and (side or (text.is_word(at, "the") and text.is_word(at + 1, "end")))


def _offered(text: Text) -> tuple[tuple[Side, ...], set[int]]:
    """The sides to choose from, and where they stand: 'left or right', 'on the top, the front or the back'."""
    said = [(i, i + 1, side) for side, words in _UP_DOWN.items() for i in text.at_words(*words)]
    said = sorted([*said, *((span.start, span.end, span.value) for span in text.all("side"))])
    gaps = [range(one[1], other[0]) for one, other in pairwise(said)]
    joined = [n for n, gap in enumerate(gaps) if len(gap) < 6 and any(text.is_word(i, "or", "/") for i in gap)]
    if not joined:
        return (), set()
    verbs = text.at_phrases("be", "do", "have", "ask")
    apart = (n for n in range(joined[-1], 0, -1) if len(gaps[n - 1]) >= 6 or not verbs.isdisjoint(gaps[n - 1]))
    chosen = said[next(apart, 0) : joined[-1] + 2]  # not: 'seen from the front, is it left or right'
    sides = tuple(dict.fromkeys(side for _, _, side in chosen))
    return sides, {i for i in range(chosen[0][0], chosen[-1][1]) if not text.find(i, "noun")}


def mating(question: Question) -> Iterator[Parse]:
    """'Which shaft does the bore fit?', 'How thick a pin goes through the lugs?': as wide as what it goes in."""
    text, verbs = question.text, question.text.all("fits")
    nouns = [mention for mention in question.parts if mention.part.known]
    for index, male in enumerate(nouns):
        lead = range(max(question.asking[0], male.start - 4), male.start + 1)
        asked = next((i for i in lead if text.is_word(i, "what", "which", "how") or text.find(i, "most")), None)
        near = (span for span in verbs if male.start - 4 <= span.start < male.end + MATES_WITHIN)
        verb = next((span for span in near if span.start not in male.used), None)
        if asked is None or verb is None or any(text.find(i, "be", "do") for i in range(asked, male.start)):
            continue
        own = (f"{male.part.noun} {hole}" for hole in ("hole", "bore"))
        noun = next((one for one in own if one in text.lexicon.nouns), "main bore")
        bore = PartQuery(noun=noun, words=tuple(noun.split()))
        others = nouns[index + 1 : index + 3] or nouns[max(0, index - 1) : index]  # 'The slots: which bolt will pass?'
        fitted = [(one.part, one.used) for one in others] or [(bore, frozenset())]
        solid = [one for one in fitted if not is_cut(male.part) and not is_cut(one[0])]  # 'what bore does it need?'
        fitted += [(placed_in(bore, "in", part), more) for part, more in solid]
        used = {*range(asked, male.end), *verb.tokens, *text.at_phrases("most", "relation")}
        for query, more in fitted:
            yield Parse(Get((Measure.DIAMETER,), query), {"mating": 1.0}, used | more)


def bare(question: Question) -> Iterator[Parse]:
    """No measure is named at all: 'keyways of the spindle?', 'the spindle?'"""
    for mention in question.mentions[:3]:
        if (query := mention.query) is not None:
            get = Get((_named_by(query),), query)
            yield Parse(get, {"named_only": 1.0}, mention.used)
            yield from material(question, get, {"named_only": 1.0}, mention.used)  # 'the wall between the keyways'
            verb = any(question.text.find(i + 1, "be", "do", "have") for i in question.text.at_words("much"))
            if query.plural and not verb:  # not 'how much do the straps overlap', but 'how much holes' by who learns
                yield Parse(Count(query), {"named_only": 1.0}, mention.used)
