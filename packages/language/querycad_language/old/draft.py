"""A noun phrase while it is read, and what it means in the end."""

from __future__ import annotations

from dataclasses import dataclass, field

from querycad_contracts import Side

from .lexicon import LEXICON
from .meaning import (
    AnyOf,
    Bound,
    ByDistance,
    ByPlace,
    Described,
    Filter,
    Holding,
    NounClass,
    Phrase,
    Placed,
    Rank,
    Selection,
    Target,
    Whole,
    Within,
)
from .readings import bounded, ranked
from .text import Text

MODEL_NOUN = "body"
"""The noun that SegCAD knows for one body of the model, whatever the question calls it."""


@dataclass(slots=True)
class Draft:
    """What has been read of a phrase so far."""

    words: list[str] = field(default_factory=list)
    """The head noun and the adjectives before it."""
    tail: list[str] = field(default_factory=list)
    """What stays in the description behind the head: 'with ring'."""
    located: list[str] = field(default_factory=list)
    """Where the parts are, for SegCAD to look up: 'in flange'."""
    elsewhere: list[list[str]] = field(default_factory=list)
    """Where they are not: 'not in flange'."""
    sides: list[Side] = field(default_factory=list)
    filters: list[Filter] = field(default_factory=list)
    ranks: list[Rank] = field(default_factory=list)
    described: list[tuple[list[str], bool]] = field(default_factory=list)
    """Words said of the parts behind the head ('… are threaded'), and whether they hold."""
    count: int = 0
    """How many there are, as the question has it: 'the four holes'; SegCAD chooses by it where there are more."""
    plural: bool = False
    whole: bool = False
    body: bool = False
    """The noun may mean one body among others: 'the component on the top'."""
    closed: bool = False
    """The head is complete: further words are said of it."""
    negated: bool = False
    """The next modifier is denied. One that is left so at the end was not understood."""
    refused: bool = False
    """A word was left over that changes the meaning: the phrase is not understood."""
    sample: bool = False
    """Any one of them will do: 'one of the holes'."""
    singular: bool = False
    """One of a plural is meant: 'the deepest of the holes'."""
    ends: list[Side] = field(default_factory=list)
    """Sides named as ends: 'at the left end of the shaft'."""
    seen: bool = False
    """The sides are those that the parts are looked at from."""
    at: bool = False
    """They are said to be at the top, the left …: at that end, where nothing is visible from there."""
    this: bool = False
    """'This knob': the one that the file is about."""
    highest: bool = False
    """The 'upper' or 'lower' ones: those highest up or down, whichever way they look."""
    leading: list[Side] = field(default_factory=list)
    """Sides said like an adjective: 'the left leg'."""
    side_noun: str = ""
    """'face' in 'the top face', the head when no other follows."""

    @property
    def in_tail(self) -> bool:
        """Do further words belong to a prepositional modifier that stays in the description?"""
        return bool(self.tail) and not self.closed

    def describe(self, word: str, continued: bool) -> None:
        """Something is said of the parts; `continued` when it goes on with what was said last."""
        if continued and self.described:
            self.described[-1][0].append(word)
        else:
            self.described.append(([word], not self.negated))
        self.negated = False

    def said(self, head: str) -> tuple[list[str], tuple[Described, ...]]:
        """The adjectives that hold, and filters against those that do not; `head` is the noun they are said of."""
        groups = [([LEXICON.singular(word) for word in words], holds) for words, holds in self.described]
        groups = [([word for word in words if word != head], holds) for words, holds in groups]
        adjectives = [word for words, holds in groups if holds for word in words]
        denied = tuple(Described(" ".join([*words, head]), False) for words, holds in groups if not holds and words)
        return adjectives, denied

    def close(self, after: int) -> int:
        """The head, if there is one, is complete; reading goes on at `after`, which is given back."""
        self.closed = bool(self.words)
        return after


_CIRCLES = ("bolt circle", "pitch circle", "hole circle")


def noun_class(description: str) -> NounClass:
    """How is the size of what a head noun names meant? Judged by its longest known ending."""
    words = description.split()
    for start in range(len(words)):
        if (found := LEXICON.match("noun", words, start, len(words))) and found[1] == len(words):
            return NounClass(found[0])
    return NounClass.OTHER


def finished(text: Text, draft: Draft, like: Target | None) -> Target | None:
    """What does a phrase mean that has been read to its end? None when it names nothing.

    `like` is what 'the one' and a phrase without noun ('on the front') stand for.
    """
    if draft.refused or draft.negated:
        return None
    words = [LEXICON.singular(word) for word in draft.words]
    plural = (draft.plural or bool(words and words[-1] != draft.words[-1])) and not draft.singular
    if not words and draft.side_noun:
        words = [LEXICON.singular(draft.side_noun)]
        plural = plural or words[0] != draft.side_noun
    if len(draft.words) == 1 and LEXICON.match("whole_plural", draft.words, 0, 1):
        words = [MODEL_NOUN]
    if not words and draft.whole:
        one_body = draft.body and draft.sides
        if not draft.ranks and not draft.filters and not draft.plural and not one_body:
            return _whole(text, draft)
        words = [MODEL_NOUN]
    if not words:
        return _like(text, draft, like)
    if any(LEXICON.match(category, words, len(words) - 1, len(words)) for category in ("unanswerable", "measure_noun")):
        return None
    measures = ("radius", "diameter", "width", "height", "length", "thickness", "volume", "area", "distance")
    if words[0] in measures and not (words[0] == "volume" and len(words) > 1):  # but the 'volume knob'
        return None  # a measure whose part was not understood
    tail = [LEXICON.singular(word) for word in draft.tail]
    return Selection((_phrase(text, draft, [*words, *tail], noun_class(" ".join(words)), plural),))


def _phrase(text: Text, draft: Draft, words: list[str], noun: NounClass, plural: bool) -> Phrase:
    adjectives, denied = draft.said(words[-1])
    denied += tuple(Described(" ".join([*words, *place]), False) for place in draft.elsewhere)
    at_end = draft.ends and draft.ends == draft.sides and noun is NounClass.AXIAL and not plural
    placed = [
        one.reference for one in draft.filters if isinstance(one, Placed) and isinstance(one.reference, Selection)
    ]
    ranks = list(draft.ranks)
    if at_end and len(draft.ends) == 1:
        outward = draft.ends[0].outward
        axis = next(i for i, value in enumerate(outward) if value)
        ranks.append(Rank(ByPlace(axis), outward[axis] > 0))
    elif placed and not plural and not ranks:
        text.note("Of several parts there, the one nearest to the other part is meant.")
        ranks.append(Rank(ByDistance(placed[0]), False))
    sides = list(draft.sides)
    apart = len(sides) > 1 and draft.seen and not plural
    if len(draft.leading) == 1 and (apart or draft.highest) and noun is not NounClass.FACE:
        outward = draft.leading[0].outward  # 'the left leg' is the leftmost one
        axis = next(i for i, value in enumerate(outward) if value)
        sides.remove(draft.leading[0])
        ranks.append(Rank(ByPlace(axis), outward[axis] > 0))
    said_there = len(sides) == 1 and not draft.seen and not at_end
    stands = said_there and (noun is NounClass.AXIAL or (draft.at and noun is NounClass.HOLE))
    if draft.this and not plural and not (draft.filters or ranks or sides or draft.located):
        adjectives = ["whole", *adjectives]
    if draft.count and not (draft.filters or draft.ranks):
        adjectives = [str(draft.count), *adjectives]
    said = tuple(bounded(condition, noun, text) for condition in draft.filters)
    filters = _of_members(text, draft, [*adjectives, *words]) or said
    return Phrase(
        description=" ".join([*adjectives, *words, *draft.located]),
        noun_class=noun,
        plural=plural,
        sides=() if at_end else tuple(sides),
        filters=(*filters, *denied),
        ranks=tuple(ranked(rank, noun, text) for rank in ranks),
        sample=draft.sample,
        stands=stands,
    )


def _of_members(text: Text, draft: Draft, words: list[str]) -> tuple[Filter, ...]:
    """'The bolt circle of the 6.6 mm holes': the size is that of the holes, not of their circle, which holds them."""
    members, circle = words[:-2], " ".join(words[-2:])
    if circle not in _CIRCLES:
        return ()
    within = [one.reference for one in draft.filters if isinstance(one, Within)]
    if within and len(within) == len(draft.filters) and all(of.noun_class is NounClass.HOLE for of in within):
        return tuple(Holding(of) for of in within)
    if not members or not all(isinstance(one, Bound | AnyOf) for one in draft.filters):
        return ()
    noun = noun_class(" ".join(members))
    filters = tuple(bounded(condition, noun, text) for condition in draft.filters)
    holes = Phrase(" ".join([*members, *draft.located]), noun, True, filters=filters)
    return (Holding(Selection((holes,))),) if filters and noun is NounClass.HOLE else ()


def _whole(text: Text, draft: Draft) -> Whole:
    if draft.sides:
        text.note("The whole model is meant, whichever side it is seen from.")
    return Whole()


def _like(text: Text, draft: Draft, like: Target | None) -> Target | None:
    """'the one on the front': the phrase that it stands for, selected anew."""
    if not isinstance(like, Selection):
        return None
    base = like.phrases[0]
    return Selection((_phrase(text, draft, base.description.split(), base.noun_class, draft.plural),))
