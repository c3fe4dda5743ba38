"""The head of a noun phrase, and the mention that it becomes."""

from __future__ import annotations

from collections.abc import Sequence
from typing import Any

from querycad_contracts import Measure, PartQuery, Place
from querycad_language.lexicon import Span
from querycad_language.text import Text
from querycad_language.tokens import Kind

from .mention import GENERIC, Mention, PhraseBuilder, replace_fields

_GATHERED = ("adjectives", "lacking", "sizes", "threads", "colors", "ranks", "sides", "unseen", "ends", "excluded",
             "also", "ids")  # fmt: skip
"""What is gathered for the fields of the query that have the same names."""


def head_of(text: Text, build: PhraseBuilder, start: int, at: int) -> Mention | int | None:
    """Where the head ends; a finished mention for pronouns and the whole model; None where this is no noun phrase."""
    if build.nouns or build.unknown:
        return at
    adjective = text.find(at, "whole_adjective")
    whole = text.find(at, "whole") or (text.find(adjective.end, "whole") if adjective else None)
    if whole is not None:
        return _whole(text, build, start, whole)
    if (end := _without_noun(text, build, start, at)) is not None:
        return end
    pointing = text.is_word(start, "this", "that", "these", "those", "them", "one")
    if (at <= start + 1) if pointing else (at == start and text.find(at, "pronoun")):
        return Mention(start, start + 1, None, frozenset((start,)), start, pronoun=True)
    return None


def _whole(text: Text, build: PhraseBuilder, start: int, whole: Span) -> Mention | int:
    """'the part' is the whole model; 'the parts', 'which part', 'the part that is red' are bodies of it."""
    last = whole.end - 1
    plural = text.tokens[last].plural
    restricted = build.count or build.ranks or build.colors or build.adjectives or build.ends
    if plural or restricted or text.is_word(start - 1, "which") or text.is_word(whole.end, "that"):
        own = text.words[last] if not plural and text.words[last] in text.lexicon.nouns else "body"
        build.nouns.append(Span(whole.start, whole.end, "noun", text.lexicon.nouns[own]))
        build.used.update(range(start, whole.end))
        return whole.end
    return Mention(start, whole.end, None, frozenset(range(start, whole.end)), last)


def _without_noun(text: Text, build: PhraseBuilder, start: int, at: int) -> int | None:
    """Where a phrase without a noun ends: 'the small one', 'the 8 mm', 'the largest'; None where it is no phrase."""
    if (build.sizes or build.threads) and not build.adjectives:
        round_size = any(size.measure in (Measure.DIAMETER, Measure.RADIUS) for size in build.sizes)
        if round_size or build.threads or build.article:
            return at
    if text.find(at, "measure", "distance", "gap") or text.find(at - 1, "outside_to_outside"):
        return None  # 'the straight distance', 'the opposite side'
    restricted = build.adjectives or build.ranks or (build.ends and text.is_word(at, "and", "or"))
    return at if restricted and build.article and at > start + 1 else None


def mention_of(text: Text, start: int, end: int, build: PhraseBuilder) -> Mention:
    """The mention that was gathered."""
    nouns = build.nouns
    while len(nouns) > 1 and nouns[-1].value.name in GENERIC:
        nouns = nouns[:-1]
    noun = nouns[-1] if nouns else None
    names = [n.value.name for n in nouns]
    compound = [PartQuery(noun=name, words=(name,)) for name in names[:-1] if name != names[-1]]
    places = (*build.places, *(Place(relation="", what=query) for query in compound))
    unknown = tuple(text.words[at] for at in build.unknown)
    naming: Sequence[int] = noun.tokens if noun is not None else build.unknown
    named = " ".join(text.words[at] for at in naming)
    if noun is not None and named not in text.lexicon.nouns:
        named = noun.value.name
    owned = any(place.relation == "of" and place.what for place in build.places)
    if names[-1:] == ["object"] and owned and (build.adjectives or build.ranks or build.ends):
        named = "section"  # 'the thinnest part of the shaft'
    known = noun is not None or not unknown
    head = naming[-1] if naming else start
    plural = any(text.tokens[i].plural for i in (noun.tokens if noun is not None else (head,)))
    gathered: dict[str, Any] = {name: tuple(dict.fromkeys(getattr(build, name))) for name in _GATHERED}
    gathered |= {name: getattr(build, name) for name in ("count", "definite", "sample", "deictic")}
    query = PartQuery(
        noun=named,
        known=known,
        words=tuple(text.words[at] for at in range(start, noun.end if noun else end) if _says(text, at, build, noun)),
        plural=plural or build.each or (build.count or 1) > 1,
        places=places,
        unknown=unknown if known else (),
        **gathered,
    )
    among = places[0].what if not naming and places and places[0].relation == "of" else None
    if among is not None and among.plural and (build.ranks or build.adjectives):  # 'the largest of the slots'
        chosen = {name: (*getattr(among, name), *getattr(query, name)) for name in ("ranks", "adjectives")}
        query = replace_fields(among, **chosen, plural=query.plural, definite=True, count=build.count)
    return Mention(start, end, query, frozenset(build.used.union(naming)), head, plural=query.plural)


def _says(text: Text, at: int, build: PhraseBuilder, noun: Span | None) -> bool:
    """Is it a word of the phrase that says what is meant?"""
    says = text.is_content(at) or text.find(at, "noun", "side", "color", "adjective")
    if not says or not text.is_kind(at, Kind.WORD) or text.find(at, "article"):
        return False
    return noun is not None or at in build.unknown or text.find(at, "side", "adjective") is not None
