"""Which part is a measure asked of? The words between them link the two."""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from typing import NamedTuple

from querycad_contracts import Measure, PartKind, PartQuery, Side
from querycad_language.forms import Target
from querycad_language.lexicon import lexicon
from querycad_language.phrases import Mention, noun_follows, placed_in, places_of, replace_fields, without
from querycad_language.text import Text

from .parses import Features
from .question import Question, used_by
from .requested_measures import Requested

STRONG = ("of", "subject", "compound", "possessive", "having", "preposition")
"""Links that grammar makes: where there is one, other parts are hardly meant."""
_CUTS = frozenset(kind.value for kind in PartKind if kind.cuts_in)
CIRCLES = ("circle", "bolt circle", "hole circle", "pitch circle")
_SECTIONS = ("part", "section", "portion", "end")
_PLATES = {Side.TOP: "roof", Side.BOTTOM: "floor"}  # what closes a hollow model there
_CUT_BY = {
    "counterbored": "counterbore", "countersunk": "countersink", "spotfaced": "spotface", "chamfered": "chamfer",
    "bored": "bore", "grooved": "groove", "filleted": "fillet", "slotted": "slot", "recessed": "recess",
    "rounded": "round", "notched": "notch", "beveled": "bevel",
}  # fmt: skip
MAX_OWNERS = 12  # parts further away are hardly meant; no question that was collected names more


def kinds_of(query: Target) -> tuple[str, ...]:
    """Of which kinds are such parts, in the narrowest sense of their noun? None where it is not known."""
    noun = lexicon().nouns.get(query.noun) if query is not None else None
    return noun.senses[0].kind if noun is not None else ()


class Owner(NamedTuple):
    """What a measure may be asked of. `used`: the tokens that name and link it."""

    target: Target
    used: set[int]
    features: Features


def owners_of(question: Question, asked: Requested) -> Iterator[Owner]:
    """All that the measure may be asked of."""
    text = question.text
    near = sorted(question.mentions, key=lambda mention: abs(mention.head - asked.start))[:MAX_OWNERS]
    apart = (m for m in sorted(near, key=lambda one: one.start) if m.end <= asked.start or m.start >= asked.end)
    linked = [(m, _link(question, asked, m)) for m in apart]
    each = any(not noun_follows(text, at + 1) for at in text.at_words("each"))  # 'the holes and the diameter of each'
    named = any(text.is_word(i, "its", "their") for i in {asked.start - 1, *asked.used})
    pronoun = each or named or any(m.pronoun and link in STRONG for m, link in linked)
    owned = any(link in STRONG and not m.pronoun for m, link in linked)
    owners = [(m, link) for m, link in linked if not m.pronoun and (m.query is not None or link in STRONG)]
    if asked.measures == (Measure.ANGLE,):  # 'the angle between neighbouring slots' is none of a slot
        owners = [(m, at) for m, at in owners if at != "preposition" or not (m.plural and text.at_phrases("between"))]
    for nearest, (mention, link) in enumerate(sorted(owners, key=lambda pair: abs(pair[0].head - asked.start))):
        features = {f"link_{link}": 1.0}
        if pronoun and link in ("earlier", "before", "far_before", "topic", "having"):
            features = {"link_pronoun": 1.0, "pronoun_steps": float(nearest)}
        if owned and link not in STRONG:
            features["owner_passed"] = 1.0
        before = mention.query is not None and question.sentence_of(mention.start) < question.sentence_of(asked.start)
        if before and not owned and not mention.part.definite:  # what is asked names no part of its own
            features["introduced"] = 1.0
        one = "link_pronoun" in features and mention.plural and text.has("its", "it") and not text.has("they", "their")
        features |= {"pronoun_number": 1.0} if one else {}
        linking = range(asked.end, mention.start) if link in ("of", "subject", "preposition", "after") else ()
        used = {*mention.used, *(i for i in linking if not text.is_content(i))}
        yield Owner(mention.query, used, features)
        for holder in _part_of(mention.query, one) if mention.query is not None else ():
            yield Owner(holder, used, {**features, "pronoun_number": 0.0})
    yield from _compound_of(text, linked, asked)
    yield from _cut_at(question, asked, linked)
    for span in text.all("side") if asked.measures in ((Measure.AREA,), (Measure.THICKNESS,)) else ():
        if text.find(span.start - 1, "article") and not any(span.start in m.used for m in question.mentions):
            thick = asked.measures == (Measure.THICKNESS,)  # 'the thickness of the top', 'the area of the underside'
            noun = _PLATES.get(span.value, "wall") if thick else "face"
            query = PartQuery(noun=noun, sides=() if noun in _PLATES.values() else (span.value,), definite=True)
            yield Owner(query, set(range(span.start - 1, text.skip(span.end, "side_noun"))), {"link_of": 1.0})
    features = {} if pronoun else {"link_whole": 1.0, "owner_passed": float(owned)}
    features["parts_passed"] = float(bool(question.parts))
    yield Owner(None, used_by(*(m for m in question.mentions if m.pronoun or m.query is None)), features)


def _part_of(query: PartQuery, one: bool) -> Iterator[PartQuery]:
    """'The narrower section of the keyway', 'the cone at its slender end': the cut or cone, as wide as is said.

    `one`: 'The holes lie on a circle. How broad is it?' asks of the circle.
    """
    yield from (what for _, what in places_of(query) if one and not what.plural)
    for place, what in places_of(query, "on"):  # 'the holes lie on a circle of which diameter?'
        if what.noun in CIRCLES:
            yield placed_in(replace_fields(what, noun=CIRCLES[-1]), "of", without(query, place))
    for relation, ends in (("of", _CUTS | {"cone"}), ("", {"cone"})):
        for _, holder in places_of(query, relation) if query.noun in _SECTIONS else ():
            if (kinds := kinds_of(holder)) and ends.issuperset(kinds):
                yield replace_fields(holder, adjectives=(*holder.adjectives, *query.adjectives))


def _compound_of(text: Text, linked: Sequence[tuple[Mention, str]], asked: Requested) -> Iterator[Owner]:
    """'the counterbore diameter of the small holes': of the counterbores of those."""
    before = next((m for m, link in linked if link == "compound" and m.query is not None), None)
    held = (m for m, link in linked if link in ("of", "preposition") or text.find(m.end, "have"))
    if before and (of := next((m for m in held if m.query is not None and m is not before), None)):
        joined = replace_fields(placed_in(before.part, "of", of.part), plural=of.part.plural)
        used = {*before.used, *of.used, *range(asked.end, of.start)}
        yield Owner(joined, used, {"link_compound": 1.0, "link_compound_of": 1.0})


def _cut_at(question: Question, asked: Requested, linked: Sequence[tuple[Mention, str]]) -> Iterator[Owner]:
    """'To which width are the lugs chamfered?', 'Countersunk to what size?': what was cut at them."""
    text = question.text
    sentence = range(*next(((a, b) for a, b in text.sentences if a <= asked.start < b), question.asking))
    named = any(m.query is not None and m.start in sentence for m, _ in linked)
    for at in sorted(text.at_words(*_CUT_BY)):
        cut = _CUT_BY[text.words[at]]
        said = at in sentence or text.is_word(sentence.start, "to")  # '… are chamfered: to what width?'
        said = said or (at < sentence.start and not named)  # 'The bore is counterbored. How deep?'
        said = (said or any(text.is_word(i, cut) for i in sentence)) and not text.find(at, "trait")
        adjective, holder = text.find(at, "adjective"), next((m for m, _ in reversed(linked) if m.start < at), None)
        if said and adjective is not None and not noun_follows(text, adjective.end) and holder is not None:
            held = PartQuery(noun=cut, words=(cut,), plural=holder.plural)
            if (of := holder.query) is not None:
                kept = tuple(name for name in of.adjectives if name != adjective.value.name)
                held = placed_in(held, "of", replace_fields(of, adjectives=kept))
            yield Owner(held, {*holder.used, at, at + 1}, {"link_compound": 1.0, "link_compound_of": 1.0})


def _link(question: Question, asked: Requested, mention: Mention) -> str:
    """How do the words link a measure to a part before or behind it?"""
    text, between = question.text, range(mention.end, asked.start)
    if question.sentence_of(mention.start) != question.sentence_of(asked.start):
        return "earlier" if mention.end <= asked.start else "later"
    if mention.end > asked.start:
        return _link_behind(question, asked, mention)
    if not between:
        return "compound"
    if any(map(text.is_possessive, between)):
        return "possessive"
    if any(text.is_word(i, ",", "(", "-") for i in between):
        return "topic"
    if any(text.find(i, "have", "ask") for i in between):
        return "having"
    return "far_before" if any(map(text.is_content, between)) else "before"


def _link_behind(question: Question, asked: Requested, mention: Mention) -> str:
    """The part is named behind the measure."""
    text, between = question.text, range(asked.end, mention.start)
    others = (other for other in question.mentions if not other.pronoun)
    passed = any(asked.end <= other.start and other.end <= mention.start for other in others)
    if passed or any(map(text.is_content, between)):
        return "far"
    of = between and text.is_word(asked.end, "of", "for") and not text.is_word(asked.end - 1, "out")
    if of or (not between and asked.how == "noun"):
        return "of"
    if asked.how != "noun" or any(text.find(i, "be", "do", "have") for i in between):
        return "subject"
    return "preposition" if any(text.find(i, "place") for i in between) else "after"
