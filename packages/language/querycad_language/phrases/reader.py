"""Reads the noun phrases of a text, each from its first word to its last modifier."""

from __future__ import annotations

from collections.abc import Iterable
from dataclasses import replace
from functools import cached_property

from querycad_contracts import PartQuery, Place
from querycad_language.lexicon import Span
from querycad_language.text import Text
from querycad_language.tokens import Kind

from .head import head_of, mention_of
from .mention import MAX_DEPTH, Mention, PhraseBuilder, placed_in, replace_fields
from .places import placed, seen
from .postmodifiers import modifiers
from .premodifiers import before_noun

MAX_LEAD = 20  # tokens of a phrase up to its noun; twice as many as people say


class Phrases:
    """Reads the noun phrases of one text; each stretch once."""

    def __init__(self, text: Text) -> None:
        self.text = text
        self._known: dict[tuple[int, int, bool], Mention | None] = {}

    def at(self, start: int, depth: int = 0, joined: bool = True) -> Mention | None:
        """The longest noun phrase here; none within too many others. `joined`: 'and' may add a further kind."""
        if depth > MAX_DEPTH or self._aside(self.text.skip(start, "article")):
            return None
        key = (start, depth, joined)
        if key not in self._known:
            mention = self._read(start, depth, joined)
            self._known[key] = self._owned(mention, depth, joined) if mention is not None else None
        return self._known[key]

    def place(self, start: int) -> tuple[Place | None, int]:
        """The place by another part that begins here, apart from what is there, and where it ends."""
        for read in (placed, seen):
            build = PhraseBuilder(self.at)
            end = read(self.text, start, build)
            if build.places:
                return build.places[0], end
        return None, start

    def mentions(self) -> list[Mention]:
        """The noun phrases of the text from left to right, none inside another."""
        found: list[Mention] = []
        at = 0
        while at < len(self.text):
            mention = self.at(at) if self._aside(at) is None else None
            passed = mention or self._aside(at) or self.text.find(at, "measure")
            at = passed.end if passed is not None else at + 1  # 'width across flats' names no flats
            found += [self._resolved(mention, found)] if mention is not None else []
        return self._without([self._shared(mention, found[i + 1 :]) for i, mention in enumerate(found)])

    def _aside(self, at: int) -> Span | None:
        """'without the drill point' says how a depth is taken; else the point itself is meant."""
        text, span = self.text, self.text.find(at, "aside")
        if span is None:
            return None
        said = text.at_phrases("except", "leaving", "left_out", "minus", "negation", "beginning")
        return span if any(span.start - 4 <= i < span.end + 3 for i in said) else None

    def _without(self, found: list[Mention]) -> list[Mention]:
        """'Forget the largest one, how many lugs remain?': what is left out is an exception to the others."""
        left = [m for m in found if m.query is not None and self._leaving(m)]
        found = [m for m in found if m.head not in self.included]
        kept = [m for m in found if m not in left]
        named = next((m for m in kept if m.plural and m.part.noun and not self.text.is_word(m.start - 1, "or")), None)
        if left and named is None and left[0].part.noun and (others := self.text.at_words("other", "rest")):
            named = replace(left[0], query=replace_fields(left[0].part, ranks=(), plural=True))
            kept = [replace(named, used=named.used | others)]  # 'without the tallest lugs, the others are how many'
            left, named = left[:1], kept[0]
        if not left or named is None:
            return found
        used = named.used.union(*(m.used | set(self._leaving(m)) for m in left))
        query = replace_fields(named.part, excluded=(*named.part.excluded, *(m.part for m in left)))
        return [replace(m, query=query, used=used) if m is named else m for m in kept]

    def _leaving(self, mention: Mention) -> range:
        """The words that leave a mention out, before or behind it."""
        for at in range(max(0, mention.start - 4), mention.start):
            begins = mention.part.ranks and any(start == at for start, _ in self.text.sentences)
            span = self.text.find(at, "leaving", *(("except", "minus") if begins else ()))
            if span is not None and self.text.skip(span.end, "article") >= mention.start:
                return range(at, span.end)
            but = self.text.is_word(at, "not") and self.text.is_word(at - 1, ",", "(", "but")
            if but and at + 1 == mention.start and mention.part.definite:
                return range(at, at + 1)  # 'lugs (the long ones, not the ribs)'
        sure = mention.query and (mention.query.ranks or not self.text.is_word(mention.end, "out", "aside"))
        out = self.text.find(mention.end, "left_out") if sure else None  # 'the slot does not count'
        return range(mention.end, out.end) if out is not None else range(0)

    @cached_property
    def included(self) -> frozenset[int]:
        """The words that say that parts count as well, which they do anyway: ', the big one included'."""
        text, found = self.text, set[int]()
        for end in text.at_words("included", "counted"):
            start = next((i + 1 for i in range(end - 1, 0, -1) if text.is_kind(i, Kind.SYMBOL)), end)
            if not text.any_in(range(start, end), "negation", "minus", "ask", "count", "be"):
                found.update(range(start, end + 1 + text.is_word(end + 1, "too")) if start < end else ())
        for start in text.at_words("including", "incl", "counting", *["with"] * bool(text.at_phrases("over_all"))):
            other = self.at(start + 1) if not text.find(start - 1, "negation", "minus") else None
            found.update(range(start, other.end) if other and not text.find(start + 1, "each") else ())
        return frozenset(found)

    def _shared(self, mention: Mention, after: list[Mention]) -> Mention:
        """'the largest and the smallest hole': of the noun that both share."""
        query, other = mention.query, after[0].query if after else None
        joined = self.text.is_word(mention.end, "and", "or", "to", "&") and after and after[0].start == mention.end + 1
        if query is None or query.noun or query.ids or not joined or other is None or not other.noun:
            return mention
        shared = {name: getattr(other, name) for name in ("noun", "known", "words", "plural")}
        query = replace_fields(query, **shared, places=query.places or other.places)
        return replace(mention, query=query, plural=other.plural)

    def _owned(self, mention: Mention, depth: int, joined: bool) -> Mention:
        """'the cover's holes': the holes of the cover."""
        own = self.at(mention.end + 1, depth, joined) if self.text.is_possessive(mention.end) else None
        if own is None or own.query is None:
            return mention
        query = own.query if mention.query is None else placed_in(own.query, "of", mention.query)
        query = replace_fields(query, definite=True)
        return replace(own, start=mention.start, query=query, used=mention.used | {mention.end} | own.used)

    def _resolved(self, mention: Mention, before: list[Mention]) -> Mention:
        """'the 14 mm ones': of the noun that was mentioned before."""
        query = mention.query
        if query is None or query.noun or query.ids:
            return mention
        nouns = [m.query for m in reversed(before) if m.query is not None and m.query.noun]
        named = max(nouns, key=lambda one: (one.known, one.known and one.plural), default=None)  # one of several
        if named is None or not (query.adjectives or query.ranks or self.text.is_word(mention.end - 1, "one")):
            return mention
        return replace(mention, query=replace_fields(query, noun=named.noun, known=named.known, words=named.words))

    def _read(self, start: int, depth: int, joined: bool) -> Mention | None:
        build, at = PhraseBuilder(self.at, depth=depth, joined=joined), start
        while at < min(len(self.text), start + MAX_LEAD) and (after := before_noun(self.text, at, build)) > at:
            build.used.update(range(at, after))
            at = after
        head = head_of(self.text, build, start, at)
        if not isinstance(head, int):
            return head
        return mention_of(self.text, start, modifiers(self.text, head, build), build)

    def view(self, at: int) -> Mention | None:
        """A side that is said here apart from a part, as a mention without a noun."""
        build = PhraseBuilder(self.at, depth=1)
        end = seen(self.text, at, build)
        end = end if end > at else self._side(at, build)
        build.used.update(range(at, end))
        return mention_of(self.text, at, end, build) if end > at else None

    def _side(self, at: int, build: PhraseBuilder) -> int:
        """Where a side ends that has something ('the top of the part has') or stands alone: 'lugs, underside only'."""
        text = self.text
        start = text.skip(at, "article")
        if (side := text.find(start, "side")) is None:
            return at
        end = text.skip(side.end, "side_noun")
        owner = text.skip(text.skip(end + 1, "article") if text.is_word(end, "of") else end, "whole")
        if start > at and (text.find(owner, "have") or text.find(at - 1, "have")):  # 'does the top have?'
            build.sides.append(side.value)
            return owner
        half = text.is_word(end - 1, "half")
        end += text.is_word(end, "only", "alone")
        whole = text.skip(text.skip(end + 1, "article"), "whole") if text.is_word(end, "of") else end
        lead = at - text.is_word(at - 1, "only", "just")
        begun = text.is_word(at - 1, "and", "or", "/") or not (lead == 0 or text.is_kind(lead - 1, Kind.SYMBOL))
        if begun or (whole < len(text) and not text.is_kind(whole, Kind.SYMBOL)):
            return at
        build.seen_on([side.value], half)
        return whole


def noun_phrase(description: str, names: Iterable[str] = ()) -> PartQuery:
    """Which parts does free text ask for: 'counterbored hole', 'the red body'? Unknown words are kept as the noun."""
    text = Text(description, frozenset(names))
    mention = next(filter(None, map(Phrases(text).at, range(len(text)))), None)
    if mention is None:
        return PartQuery(noun=" ".join(text.words), known=False, words=tuple(text.words))
    if mention.query is None:
        return PartQuery(noun="object", words=("object",))
    named = mention.used.union(range(mention.start, mention.end))
    left = [text.words[i] for i in range(len(text)) if i not in named and text.is_content(i)]
    return replace_fields(mention.query, unknown=(*mention.query.unknown, *left))
