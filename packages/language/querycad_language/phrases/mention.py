"""What a noun phrase becomes: a mention, with what is gathered while it is read."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass, field
from typing import TypeVar

from querycad_contracts import PartQuery, Place, Rank, Side, SizeFilter
from querycad_language.lexicon import Span

MAX_DEPTH = 3  # places within places within places: deeper ones are no questions
GENERIC = frozenset(("object", "body", "section"))
"""Nouns that behind another one add nothing: 'the pipe piece', 'the adapter plate body'."""


T = TypeVar("T")


@dataclass(frozen=True, slots=True)
class Mention:
    """A noun phrase of the question. `query` is None where the whole model is meant as such ('the part', 'it')."""

    start: int
    end: int
    query: PartQuery | None
    used: frozenset[int]  # tokens whose meaning is in the query, function words of the phrase included
    head: int
    pronoun: bool = False
    plural: bool = False

    @property
    def part(self) -> PartQuery:
        """The query of a mention that names parts, as those of `Question.parts` do."""
        assert self.query is not None
        return self.query


@dataclass(slots=True)
class PhraseBuilder:
    """What is gathered of a phrase while it is read. `read`: `Phrases.at`, for the phrases within this one."""

    read: Callable[[int, int, bool], Mention | None]
    adjectives: list[str] = field(default_factory=list)
    lacking: list[str] = field(default_factory=list)
    sizes: list[SizeFilter] = field(default_factory=list)
    threads: list[str] = field(default_factory=list)
    colors: list[str] = field(default_factory=list)
    ranks: list[Rank] = field(default_factory=list)
    places: list[Place] = field(default_factory=list)
    sides: list[Side] = field(default_factory=list)
    unseen: list[Side] = field(default_factory=list)
    ends: list[Side] = field(default_factory=list)
    excluded: list[PartQuery] = field(default_factory=list)
    also: list[PartQuery] = field(default_factory=list)
    nouns: list[Span] = field(default_factory=list)
    unknown: list[int] = field(default_factory=list)
    ids: list[str] = field(default_factory=list)
    count: int | None = None
    definite: bool = False
    each: bool = False
    sample: bool = False
    deictic: bool = False
    article: bool = False
    depth: int = 0  # in how many other phrases it stands
    joined: bool = False  # may 'and' add a further kind?
    used: set[int] = field(default_factory=set)

    def within(self, at: int, joined: bool = False) -> Mention | None:
        """The noun phrase within this one that begins here. `joined`: 'and' may add a further kind to it."""
        return self.read(at, self.depth + 1, joined)

    def inner(self, at: int) -> Mention | None:
        """The parts that are named here within this phrase."""
        mention = self.within(at)
        return mention if mention is not None and mention.query is not None else None

    def seen_on(self, sides: list[Side], half: bool) -> None:
        """They are seen on the sides, or lie in those halves of the model."""
        if half:
            self.adjectives += [f"{side.value} half" for side in sides]
        else:
            self.sides += sides


def gather(into: list[T], what: T, end: int) -> int:
    """Gathers what the words up to `end` mean; returns that end."""
    into.append(what)
    return end


def replace_fields(query: PartQuery, **fields: object) -> PartQuery:
    """The query with other values of some fields."""
    return query.model_copy(update=fields)


def placed_in(query: PartQuery, relation: str, other: PartQuery) -> PartQuery:
    """The parts, where they are so by the other ones: 'in the flange'. 'In the flange, but not the bore': of them."""
    excluded, other = (*query.excluded, *other.excluded), replace_fields(other, excluded=())
    return replace_fields(query, excluded=excluded, places=(*query.places, Place(relation=relation, what=other)))


def without(query: PartQuery, place: Place) -> PartQuery:
    """The part without that place."""
    return replace_fields(query, places=tuple(one for one in query.places if one is not place))


def places_of(query: PartQuery | None, *relations: str) -> list[tuple[Place, PartQuery]]:
    """Where the parts are by other parts, in any of the relations, with those others."""
    places = query.places if query is not None else ()
    return [(one, one.what) for one in places if one.what and (not relations or one.relation in relations)]


def bare_of(query: PartQuery, *nouns: str) -> bool:
    """Is it one of the nouns and nothing that restricts it: 'the surfaces', 'all faces'?"""
    plain = replace_fields(query, plural=False, definite=False, sense=0)
    return query.noun in nouns and plain == PartQuery(noun=query.noun, words=query.words) and len(query.words) == 1
