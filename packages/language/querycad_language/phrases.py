"""Noun phrases: 'the two 5 mm holes in the flange that are visible from the top' as a typed query for parts.

One reader for all: questions, the grounding's free text, and the phrases that language models write.
"""

from __future__ import annotations

from collections.abc import Iterable
from dataclasses import dataclass, field, replace

from querycad_contracts import Measure, PartQuery, Place, Rank, Relation, Side, SizeFilter

from .lexicon import Adjective, Noun, Scale, Span
from .text import Text
from .tokens import Kind

MAX_DEPTH = 3
"""Places within places within places: deeper ones are no questions."""
GENERIC = frozenset(("object", "body", "section"))
"""Nouns that behind another one add nothing: 'the pipe piece', 'the adapter plate body'."""
_GAP = ("be", "do", "seeing", "function", "have")
_COMPARISONS = {"more": Relation.MORE, "less": Relation.LESS}


@dataclass(frozen=True, slots=True)
class Mention:
    """A noun phrase of the question. `query` is None where the whole model is meant as such ('the part', 'it')."""

    start: int
    end: int
    query: PartQuery | None
    used: frozenset[int]
    """Tokens whose meaning is in the query, function words of the phrase included."""
    head: int
    pronoun: bool = False
    each: bool = False
    plural: bool = False
    article: bool = False


@dataclass(slots=True)
class _Draft:
    """What is gathered of a phrase while it is read."""

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
    article: bool = False
    used: set[int] = field(default_factory=set)


class Phrases:
    """Reads the noun phrases of one text; each stretch once."""

    def __init__(self, text: Text) -> None:
        self.text = text
        self._known: dict[tuple[int, int, bool], Mention | None] = {}

    def at(self, start: int, depth: int = 0, joined: bool = True) -> Mention | None:
        """The longest noun phrase that begins here. `joined`: 'and' may add a further kind."""
        if self.text.find(self.text.skip(start, "article"), "aside"):
            return None
        key = (start, depth, joined)
        if key not in self._known:
            self._known[key] = self._read(start, depth, joined)
        return self._known[key]

    def mentions(self) -> list[Mention]:
        """The noun phrases of the text from left to right, none inside another."""
        found: list[Mention] = []
        at = 0
        while at < len(self.text):
            aside = self.text.find(at, "aside")
            mention = self.at(at) if aside is None else None
            if aside is not None:
                at = aside.end
            elif mention is not None:
                found.append(self._resolved(mention, found))
                at = mention.end
            else:
                at += 1
        return found

    def _resolved(self, mention: Mention, before: list[Mention]) -> Mention:
        """'the 14 mm ones': of the noun that was mentioned before."""
        query = mention.query
        if query is None or query.noun or query.ids:
            return mention
        named = next((m.query for m in reversed(before) if m.query is not None and m.query.noun), None)
        if named is None or (not self.text.is_word(mention.end - 1, "one") and not query.adjectives):
            return mention
        return replace(
            mention, query=query.model_copy(update={"noun": named.noun, "known": named.known, "words": named.words})
        )

    # What stands before the noun

    def _read(self, start: int, depth: int, joined: bool) -> Mention | None:
        text = self.text
        draft = _Draft()
        at = start
        while at < len(text):
            after = self._before_noun(at, draft)
            if after == at:
                break
            draft.used.update(range(at, after))
            at = after
        head = self._head(draft, start, at)
        if head is None:
            return None
        mention, at = head
        if mention is not None:
            return mention
        end = self._modifiers(at, draft, depth, joined)
        return self._mention(start, end, draft)

    def _before_noun(self, at: int, draft: _Draft) -> int:
        """Where the next piece of the phrase ends; `at` where nothing here belongs to it."""
        text, token = self.text, self.text.tokens[at]
        empty = not (draft.nouns or draft.unknown)
        if token.kind is Kind.TIMES:
            draft.count = int(token.value)
            return at + 1
        if token.kind is Kind.THREAD:
            draft.threads.append(token.word)
            return at + 1
        if token.kind is Kind.QUANTITY:
            return self._size_before(at, draft) if empty else at
        if token.kind is Kind.NUMBER:
            return self._number(at, draft)
        if token.kind is not Kind.WORD:
            return at
        if empty and (end := self._determiner(at, draft)) > at:
            return end
        return self._word(at, draft)

    def _determiner(self, at: int, draft: _Draft) -> int:
        text = self.text
        if text.is_word(at, "one", "any") and text.is_word(at + 1, "of"):
            draft.sample = True
            return at + 2
        if span := text.find(at, "each"):
            draft.each = True
            return span.end
        if span := text.find(at, "quantifier"):
            return span.end
        if (span := text.find(at, "article")) and not (text.find(at, "pronoun") and not self._noun_follows(span.end)):
            draft.definite = draft.definite or text.words[at] not in ("a", "an", "such")
            draft.article = True
            return span.end
        span = text.find(at, "number")
        if span is not None and self._noun_follows(span.end):
            draft.count = (
                span.value if text.words[at] not in ("single", "one") else (1 if text.words[at] == "single" else None)
            )
            return span.end
        return at

    def _noun_follows(self, at: int) -> bool:
        """Does a word that can be part of a noun phrase stand here?"""
        text = self.text
        if at >= len(text) or text.tokens[at].kind in (Kind.SYMBOL, Kind.POSSESSIVE):
            return False
        if text.tokens[at].kind is not Kind.WORD:
            return True
        open_class = text.find(
            at,
            "noun",
            "adjective",
            "whole",
            "side",
            "color",
            "scale",
            "ordinal",
            "place_extreme",
            "number",
            "article",
            "measure",
            "whole_adjective",
            "stock",
            "distance",
            "gap",
            "ground",
        )
        return open_class is not None or text.is_content(at)

    def _size_before(self, at: int, draft: _Draft) -> int:
        """'5 mm holes', 'Ø8.5 bores', 'the 40 mm deep pocket', '12 x 40 mm slot'."""
        text, token = self.text, self.text.tokens[at]
        if token.power != 1:
            return at
        after = at + 1
        scale = text.find(after, "scale")
        measure = token.measure
        if scale is not None and scale.value.degree == "positive":
            measure, after = scale.value.measure, scale.end
        elif (noun := text.find(after, "measure")) and self._noun_follows(noun.end) and not text.find(noun.end, "be"):
            measure, after = noun.value, noun.end
        draft.sizes.append(SizeFilter(measure=measure, low=token.value))
        while text.is_word(after, "x") and after + 1 < len(text) and text.tokens[after + 1].kind is Kind.QUANTITY:
            draft.sizes.append(SizeFilter(low=text.tokens[after + 1].value))
            after += 2
        return after

    def _number(self, at: int, draft: _Draft) -> int:
        """'4 holes' says how many; 'hole 4' names one."""
        text, token = self.text, self.text.tokens[at]
        if token.value != int(token.value):
            return at
        if draft.nouns and not draft.unknown and draft.nouns[-1].end == at and token.value < 10_000:
            draft.ids.append(f"{draft.nouns[-1].value.name}-{int(token.value)}")
            return at + 1
        if not draft.nouns and self._noun_follows(at + 1):
            draft.count = int(token.value)
            return at + 1
        return at

    def _word(self, at: int, draft: _Draft) -> int:
        """An adjective, a rank, a side, a colour, a noun, or a word that is not known."""
        text = self.text
        noun, adjective = text.find(at, "noun"), text.find(at, "adjective")
        measure = text.find(at, "measure")
        if draft.nouns and text.tokens[draft.nouns[-1].end - 1].plural and not draft.unknown:
            return at  # the nouns of a compound are singular: 'standoffs stand' has a verb
        if (
            noun
            and not (draft.article and at > 0 and text.find(at - 1, "article", "adjective"))
            and text.find(at, "reach")
        ):
            noun = None  # 'ring sticks up': a verb, but behind an article
        if noun and (draft.nouns or draft.unknown) and noun.end == at + 1 and self._ends_do_question(at):
            return at  # 'does the axis of the bore run?'
        if noun and draft.nouns and text.is_word(at, "inside", "interior") and noun.end == at + 1:
            return at  # 'the board inside'
        if measure and not (noun and noun.end > measure.end) and not (adjective and adjective.end > measure.end):
            if not (
                noun
                and noun.end == measure.end
                and draft.article is False
                and not draft.nouns
                and self._is_owner(noun.end)
            ):
                return at
        if (ordinal := text.find(at, "ordinal")) and (scale := self._superlative(ordinal.end)):
            return self._rank(scale, draft, ordinal.value)
        if (scale := self._superlative(at)) and self._noun_follows(scale.end):
            return self._rank(scale, draft, 1)
        if (extreme := text.find(at, "place_extreme")) and self._noun_follows(extreme.end):
            draft.ranks.append(Rank(side=extreme.value, count=draft.count or 1))
            return extreme.end
        generic = adjective and noun and adjective.end == noun.end and self._is_generic(noun.end)
        if noun and (generic or not (adjective and adjective.end >= noun.end and self._is_noun(adjective.end))):
            whole = text.find(at, "whole")
            if whole is None or whole.end < noun.end or draft.nouns or draft.adjectives:
                draft.nouns.append(noun)
                return noun.end
        if (
            adjective
            and (self._noun_follows(adjective.end) or draft.nouns)
            and not (text.find(at, "side") and not adjective)
        ):
            if draft.nouns and not self._is_noun(adjective.end):
                return at
            self._adjective(adjective, draft)
            return adjective.end
        if (side := text.find(at, "side")) and not draft.nouns and self._is_noun(side.end):
            draft.ends.append(side.value)
            return side.end
        if (color := text.find(at, "color")) and self._noun_follows(color.end):
            draft.colors.append(color.value)
            return color.end
        if text.is_word(at, "non", "un", "not") and (negated := text.find(at + 1, "adjective")):
            draft.lacking.append(negated.value.name)
            return negated.end
        if draft.nouns or not text.is_content(at) or measure or text.find(at, "whole", "side", "scale"):
            return at
        if text.find(at, "ground", "verbs", "reach", "aside") or text.is_word(at, "s"):
            return at
        draft.unknown.append(at)
        return at + 1

    def _ends_do_question(self, at: int) -> bool:
        """Is it the last word of a question with 'do', where a verb stands?"""
        text = self.text
        last = at + 1 >= len(text) or text.is_break(at + 1) or text.is_word(at + 1, ",")
        return (
            last
            and any(text.find(i, "do") and text.words[i] != "done" for i in range(max(0, at - 12), at))
            and text.is_word(at, "run", "stand", "rest", "lead", "seat", "stop", "project", "lie", "end", "slide")
        )

    def _is_generic(self, at: int) -> bool:
        """Does a noun follow that adds nothing to the one before it: 'ring body'?"""
        noun = self.text.find(at, "noun")
        return noun is not None and noun.value.name in GENERIC

    def _is_owner(self, at: int) -> bool:
        """Is what ends here asked for a measure: 'mouth diameter'?"""
        return self.text.find(at, "measure") is not None

    def _is_noun(self, at: int) -> bool:
        text = self.text
        if at >= len(text) or text.tokens[at].kind is not Kind.WORD:
            return at < len(text) and text.tokens[at].kind in (Kind.QUANTITY, Kind.THREAD)
        if text.find(at, "noun", "adjective", "color", "whole"):
            return True
        return text.is_content(at) and text.find(at, "measure", "side", "side_noun", "scale", "ground") is None

    def _superlative(self, at: int) -> Span | None:
        span = self.text.find(at, "scale")
        return span if span is not None and span.value.degree in ("most", "least") else None

    def _rank(self, span: Span, draft: _Draft, nth: int) -> int:
        scale: Scale = span.value
        draft.ranks.append(Rank(measure=scale.measure, most=scale.degree == "most", nth=nth, count=draft.count or 1))
        return span.end

    def _adjective(self, span: Span, draft: _Draft) -> None:
        adjective: Adjective = span.value
        phrase = " ".join(self.text.words[span.start : span.end])
        draft.adjectives.append(phrase if phrase in self.text.lexicon.adjectives else adjective.name)

    # The noun itself

    def _head(self, draft: _Draft, start: int, at: int) -> tuple[Mention | None, int] | None:
        """None where this is no noun phrase; a finished mention for pronouns and the whole model."""
        text = self.text
        if draft.nouns:
            return None, at
        whole = text.find(at, "whole")
        if whole is None and (adjective := text.find(at, "whole_adjective")):
            whole = text.find(adjective.end, "whole")
        if whole is not None and not draft.unknown:
            if (
                text.tokens[whole.end - 1].plural
                or draft.count
                or draft.ranks
                or draft.colors
                or draft.adjectives
                or draft.ends
            ):
                body = text.lexicon.nouns[
                    "body"
                    if text.tokens[whole.end - 1].plural
                    else text.words[whole.end - 1]
                    if text.words[whole.end - 1] in text.lexicon.nouns
                    else "body"
                ]
                draft.nouns.append(Span(whole.start, whole.end, "noun", body))
                draft.used.update(range(start, whole.end))
                return None, whole.end
            used = frozenset(range(start, whole.end))
            return Mention(start, whole.end, None, used, whole.end - 1, article=draft.article), whole.end
        if draft.unknown:
            return None, at
        if draft.adjectives or draft.ranks or draft.sizes or draft.ends or draft.threads:
            if text.is_word(at, "one"):
                draft.used.add(at)
                return None, at + 1
        if (draft.sizes or draft.threads) and not draft.adjectives:
            hints = any(size.measure in (Measure.DIAMETER, Measure.RADIUS) for size in draft.sizes) or draft.threads
            if hints or draft.article:
                return None, at
        if draft.adjectives or draft.ranks:
            return (None, at) if draft.article and at > start + 1 else None
        if at == start and text.find(at, "pronoun") and not text.is_word(at, "one", "that", "this", "these", "those"):
            return Mention(start, at + 1, None, frozenset((start,)), start, pronoun=True), at + 1
        if text.is_word(start, "this", "that", "these", "those", "them", "one") and at <= start + 1:
            return Mention(start, start + 1, None, frozenset((start,)), start, pronoun=True), start + 1
        return None

    def _mention(self, start: int, end: int, draft: _Draft) -> Mention:
        text = self.text
        nouns = draft.nouns
        while len(nouns) > 1 and nouns[-1].value.name in GENERIC:
            nouns = nouns[:-1]
        head_span = nouns[-1] if nouns else None
        words: list[str] = []
        for at in range(start, end):
            if head_span is not None and at >= head_span.end:
                break
            if text.tokens[at].kind is Kind.WORD and (
                text.is_content(at) or text.find(at, "noun", "side", "color", "adjective")
            ):
                if not text.find(at, "article") and (
                    head_span or at in draft.unknown or text.find(at, "side", "adjective")
                ):
                    words.append(text.words[at])
        places = list(draft.places)
        for span in nouns[:-1]:
            if span.value.name != nouns[-1].value.name:
                places.append(Place(relation="", what=_of_noun(span)))
        unknown = tuple(text.words[at] for at in draft.unknown)
        noun, known = "", True
        if head_span is not None:
            noun = head_span.value.name
            phrase = " ".join(text.words[head_span.start : head_span.end])
            noun = phrase if phrase in text.lexicon.nouns else noun
        elif unknown:
            noun, known = " ".join(unknown), False
        head = head_span.end - 1 if head_span is not None else (draft.unknown[-1] if draft.unknown else start)
        plural = text.tokens[head].plural or (
            head_span is not None and any(text.tokens[i].plural for i in range(head_span.start, head_span.end))
        )
        query = PartQuery(
            noun=noun, known=known, words=tuple(words), adjectives=tuple(dict.fromkeys(draft.adjectives)),
            lacking=tuple(draft.lacking), sizes=tuple(draft.sizes), threads=tuple(draft.threads), colors=tuple(draft.colors),
            count=draft.count, plural=plural or (draft.count or 1) > 1, definite=draft.definite, sample=draft.sample,
            ranks=tuple(draft.ranks), places=tuple(places), sides=tuple(dict.fromkeys(draft.sides)), unseen=tuple(draft.unseen),
            ends=tuple(dict.fromkeys(draft.ends)), excluded=tuple(draft.excluded), also=tuple(draft.also),
            unknown=() if not known else unknown, ids=tuple(draft.ids),
        )  # fmt: skip
        used = frozenset(draft.used | (set(range(head_span.start, head_span.end)) if head_span else set(draft.unknown)))
        return Mention(start, end, query, used, head, each=draft.each, plural=query.plural, article=draft.article)

    # What stands behind the noun

    def _modifiers(self, at: int, draft: _Draft, depth: int, joined: bool) -> int:
        end = at
        while (after := self._modifier(end, draft, depth, joined)) > end:
            end = after
        return end

    def _modifier(self, at: int, draft: _Draft, depth: int, joined: bool) -> int:
        """Where a modifier that begins here, or behind words such as 'that are', ends; `at` where none does."""
        text = self.text
        start = at
        for _ in range(6):
            if at >= len(text) or (
                text.tokens[at].kind is Kind.SYMBOL
                and not (text.is_word(at, "(") or (text.is_word(at, ",") and at > start - 1 and at == start))
            ):
                return start
            if text.is_word(at, ",", "("):
                if not (
                    text.find(at + 1, "seeing", "except")
                    or text.is_word(at + 1, "which", "that", "with")
                    or (
                        text.words[at] == "("
                        and text.tokens[min(at + 1, len(text) - 1)].kind in (Kind.QUANTITY, Kind.THREAD)
                    )
                ):
                    return start
                at += 1
                continue
            if (after := self._one_modifier(at, draft, depth, joined)) > at:
                draft.used.update(range(start, after))
                if text.is_word(after, ")") and any(text.is_word(i, "(") for i in range(start, after)):
                    draft.used.add(after)
                    after += 1
                return after
            span = text.find(at, *_GAP)
            if (
                span is None
                or text.find(at, "measure", "scale")
                or text.is_word(at, "a", "an", "the")
                or (
                    text.is_word(at, "do", "does", "how", "what", "have", "has")
                    and not text.is_word(at - 1, "that", "which")
                )
            ):
                return start
            at += 1
        return start

    def _one_modifier(self, at: int, draft: _Draft, depth: int, joined: bool) -> int:
        for read in (
            self._seen,
            self._ranked,
            self._stated_size,
            self._trait,
            self._exception,
            self._nearest,
            self._central,
        ):
            if (end := read(at, draft, depth)) > at:
                return end
        negated = self.text.is_word(at, "not")
        adjective = self.text.find(at + negated, "adjective")
        if adjective and not self._is_noun(adjective.end) and adjective.value.tags and not self.text.find(at, "place"):
            (draft.lacking if negated else draft.adjectives).append(adjective.value.name)
            return adjective.end
        if (end := self._placed(at, draft, depth)) > at:
            return end
        if joined and self.text.is_word(at, "and", "or", "&", "plus") and (other := self.at(at + 1, depth + 1, False)):
            return self._also(other, draft, at)
        return at

    def _also(self, other: Mention, draft: _Draft, at: int) -> int:
        """'holes and slots': both kinds count; not where a measure of its own follows."""
        plain = other.query is not None and draft.nouns and other.query.known and other.query.noun
        if not plain or self.text.find(other.end, "measure") or self.text.find(other.end, "be", "do"):
            return at
        if other.query is None or not (
            other.query.plural
            and any(self.text.tokens[i].plural for i in range(draft.nouns[-1].start, draft.nouns[-1].end))
        ):
            return at
        draft.also.append(other.query)
        return other.end

    def _seen(self, at: int, draft: _Draft, depth: int) -> int:
        """'visible from the top', 'on the left side', 'not seen from above'."""
        text = self.text
        negated = text.is_word(at, "not", "invisible", "hidden")
        start = at + negated
        seeing = text.find(start, "seeing")
        start = text.skip(start, "seeing")
        if view := text.find(start, "view"):
            sides, end = [view.value], view.end
        else:
            sides, end = self._sides(start)
        if not sides or (negated and seeing is None):
            return at
        if text.is_word(end, "of") and (other := self.at(end + 1, depth + 1)) and depth < MAX_DEPTH:
            if other.query is not None:  # 'on the left side of the flange'
                draft.places.append(Place(relation="of", what=other.query, side=sides[0]))
                return other.end
            end = other.end
        (draft.unseen if negated else draft.sides).extend(sides)
        return end

    def _sides(self, at: int) -> tuple[list[Side], int]:
        """Sides behind a preposition: 'from the top or the bottom side'."""
        text = self.text
        if (prep := text.find(at, "side_preposition")) is None:
            return [], at
        sides: list[Side] = []
        end = prep.end
        while True:
            inner = text.skip(end, "article", "each")
            span = text.find(inner, "side")
            if span is None:
                break
            after = text.skip(span.end, "side_noun")
            if after == span.end and self._is_noun(span.end) and not text.find(span.end, "side_noun", "be", "function"):
                return ([], at) if not sides else (sides, end)
            sides.append(span.value)
            end = after
            if not text.is_word(end, "and", "or", ",", "&") or not (
                text.find(text.skip(end + 1, "article", "side_preposition"), "side")
            ):
                break
            end = text.skip(end + 1, "side_preposition")
        return (sides, end) if sides else ([], at)

    def _stated_size(self, at: int, draft: _Draft, depth: int) -> int:
        """'with a diameter of 5 mm', 'larger than 5 mm', 'from 4 to 6 mm', '5 mm deep', 'Ø8.5'."""
        found = self.size(at)
        if found is None or (self._is_noun(found[1]) and not self.text.find(found[1], "measure", "place", "seeing")):
            return at  # '… around the 13 mm holes': the size is another noun's
        size, end = found
        draft.sizes.append(size)
        return end

    def _ranked(self, at: int, draft: _Draft, depth: int) -> int:
        """'with the smallest diameter'."""
        text = self.text
        place = text.find(at, "place")
        if place is None or place.value not in ("with", "of"):
            return at
        start = text.skip(place.end, "article")
        span = text.find(start, "most", "least") or self._superlative(start)
        if span is None or (measure := text.find(span.end, "measure")) is None:
            return at
        most = span.category == "most" or (span.category == "scale" and span.value.degree == "most")
        draft.ranks.append(Rank(measure=measure.value, most=most))
        return measure.end

    def size(self, at: int) -> tuple[SizeFilter, int] | None:
        """A stated size that begins here, and where it ends."""
        text = self.text
        at = text.skip(at, "article") if not text.find(at, "relation") else at
        start = at
        measure: Measure | None = None
        relation = Relation.EQUAL
        for _ in range(7):
            if at >= len(text):
                return None
            token = text.tokens[at]
            if token.kind is Kind.QUANTITY and token.power in (0, 1):
                return self._sized(at, measure or token.measure, relation)
            if (
                token.kind is Kind.NUMBER
                and measure is not None
                and not text.is_word(at + 1, "hole")
                and at + 1 <= len(text)
                and not self._noun_follows(at + 1)
            ):
                return SizeFilter(measure=measure, relation=relation, low=token.value * 1e-3), at + 1
            if scale := text.find(at, "scale"):
                if scale.value.degree in ("most", "least") or not text.is_word(scale.end, "than"):
                    return None
                measure = scale.value.measure if scale.value.measure is not Measure.MAGNITUDE else measure
                relation, at = _COMPARISONS.get(scale.value.degree, Relation.EQUAL), scale.end + 1
            elif span := text.find(at, "relation"):
                if not text.is_word(at, "of") or relation is Relation.EQUAL:
                    relation = span.value if not text.is_word(at, "of") else relation
                at = span.end
            elif (span := text.find(at, "measure")) and measure is None:
                measure, at = span.value, span.end
            elif text.is_word(
                at,
                "with",
                "of",
                "a",
                "an",
                "the",
                "is",
                "are",
                "between",
                "from",
                "in",
                "whose",
                "having",
                "at",
                "=",
                "measuring",
                "be",
                "measure",
                "about",
                "size",
                "sized",
                "range",
                "have",
                "has",
            ):
                at += 1
            else:
                return None
            if at - start > 8:
                return None
        return None

    def _sized(self, at: int, measure: Measure | None, relation: Relation) -> tuple[SizeFilter, int]:
        text, token = self.text, self.text.tokens[at]
        low, high, end = token.value, None, at + 1
        if (
            text.is_word(end, "to", "and", "-", "up to")
            and end + 1 < len(text)
            and text.tokens[end + 1].kind is Kind.QUANTITY
        ):
            if relation is Relation.EQUAL and (
                text.words[end] != "and" or any(text.is_word(i, "between") for i in range(max(0, at - 3), at))
            ):
                high, end, relation = text.tokens[end + 1].value, end + 2, Relation.BETWEEN
        if behind := text.find(end, "behind"):
            relation, end = behind.value, behind.end
        scale = text.find(end, "scale")
        if scale is not None and scale.value.degree == "positive" and measure is None:
            measure, end = scale.value.measure, scale.end
        elif measure is None:
            after = end + 1 if text.is_word(end, "in", "of") else end
            if (span := text.find(after, "measure")) and not text.is_word(span.end, "of"):
                measure, end = span.value, span.end
        return SizeFilter(measure=measure, relation=relation, low=low, high=high), end

    def _trait(self, at: int, draft: _Draft, depth: int) -> int:
        """'with a thread', 'without counterbore', 'having four holes'."""
        text = self.text
        place = text.find(at, "place")
        if place is None or place.value not in ("with", "without"):
            return at
        lacking = place.value == "without"
        start = place.end
        if text.is_word(start, "no", "any"):
            lacking = lacking or text.is_word(start, "no")
            start += 1
        start = text.skip(start, "article")
        span = text.find(start, "trait")
        longer = text.find(start, "noun")
        if span is not None and not (longer and longer.end > span.end) and not text.find(span.end, "relation"):
            (draft.lacking if lacking else draft.adjectives).append(span.value.name)
            return span.end
        other = self.at(start, depth + 1, False) if depth < MAX_DEPTH else None
        if other is None or other.query is None:
            return at
        draft.places.append(Place(relation="with", what=other.query, negated=lacking))
        return other.end

    def _exception(self, at: int, draft: _Draft, depth: int) -> int:
        text = self.text
        span = text.find(at, "except")
        if span is None or depth >= MAX_DEPTH:
            return at
        other = self.at(span.end, depth + 1)
        if other is None or other.query is None:
            return at
        draft.excluded.append(other.query)
        return other.end

    def _nearest(self, at: int, draft: _Draft, depth: int) -> int:
        text = self.text
        span = text.find(at, "near", "far")
        if span is None or depth >= MAX_DEPTH:
            return at
        most = span.category == "far"
        start = span.end + text.is_word(span.end, "to", "from")
        inner = text.skip(start, "article")
        if edge := text.find(inner, "edge"):
            draft.ranks.append(Rank(edge=True, most=most))
            return edge.end
        if side := text.find(inner, "side"):
            draft.ranks.append(Rank(side=side.value if not most else side.value.opposite))
            return text.skip(side.end, "side_noun")
        other = self.at(start, depth + 1, False)
        if other is None or other.query is None:
            return at
        draft.ranks.append(Rank(near=other.query, most=most))
        return other.end

    def _central(self, at: int, draft: _Draft, depth: int) -> int:
        """'in the middle of the plate', 'in the four corners'."""
        text = self.text
        span = text.find(at, "center")
        if span is None:
            if not text.find(at, "place") or not text.is_word(
                end := text.skip(at + 1, "article", "each", "number"), "corner"
            ):
                return at
            draft.adjectives.append("corner")
            other = self.at(end + 2, depth + 1, False) if text.is_word(end + 1, "of") and depth < MAX_DEPTH else None
            if other is not None and other.query is not None:
                draft.places.append(Place(relation="in", what=other.query))
            return other.end if other is not None else end + 1
        end = span.end
        if (text.is_word(end, "of") or text.is_word(end - 1, "of")) and depth < MAX_DEPTH:
            other = self.at(end + text.is_word(end, "of"), depth + 1, False)
            if other is not None:
                end = other.end
                if other.query is not None:
                    draft.places.append(Place(relation="in", what=other.query))
        draft.adjectives.append("central")
        return end

    def _placed(self, at: int, draft: _Draft, depth: int) -> int:
        """'in the flange', 'between the lugs', 'above the pocket'."""
        text = self.text
        span = text.find(at, "place")
        if span is None or depth >= MAX_DEPTH:
            return at
        if (
            text.find(at, "relation")
            and span.end < len(text)
            and text.tokens[span.end].kind in (Kind.QUANTITY, Kind.NUMBER)
        ):
            return at
        start = span.end
        if span.value == "through" and text.is_word(
            text.skip(start, "each", "article"), "side", "way", "part", "thickness", "wall"
        ):
            draft.adjectives.append("through")
            return text.skip(start, "each", "article") + 1
        inner = text.skip(start, "article", "each")
        piece = text.skip(inner, "side_noun", "edge")
        if piece > inner and text.is_word(piece, "of"):  # 'in the side of the foot' is in the foot
            start = piece + 1
        other = self.at(start, depth + 1, joined=span.value == "between")
        if other is None:
            return at
        if other.query is None:
            return other.end if span.value in ("in", "on", "of", "through") and not other.pronoun else at
        if text.find(other.end, "measure") and not text.is_word(other.end, "of"):
            return at  # 'holes in plate thickness direction'
        what = other.query
        if span.value == "between" and text.is_word(other.end, "and"):
            second = self.at(other.end + 1, depth + 1, False)
            if second is not None and second.query is not None:
                draft.places.append(
                    Place(relation="between", what=what.model_copy(update={"also": (*what.also, second.query)}))
                )
                return second.end
        draft.places.append(Place(relation=span.value, what=what))
        return other.end


def _of_noun(span: Span) -> PartQuery:
    noun: Noun = span.value
    return PartQuery(noun=noun.name, words=(noun.name,))


def noun_phrase(description: str, names: Iterable[str] = ()) -> PartQuery:
    """Which parts does free text ask for: 'counterbored hole', 'the red body'? Unknown words are kept as the noun."""
    text = Text(description, frozenset(names))
    phrases = Phrases(text)
    for at in range(len(text)):
        mention = phrases.at(at)
        if mention is not None:
            if mention.query is None:
                return PartQuery(noun="object", words=("object",))
            left = [
                text.words[i]
                for i in range(len(text))
                if i not in mention.used and text.is_content(i) and not at <= i < mention.end
            ]
            return mention.query.model_copy(update={"unknown": (*mention.query.unknown, *left)})
    words = tuple(text.words)
    return PartQuery(noun=" ".join(words), known=False, words=words)


def plain(query: PartQuery) -> PartQuery:
    """The query without what stands behind its noun."""
    return replace_fields(query, places=(), sides=(), excluded=(), also=())


def replace_fields(query: PartQuery, **fields: object) -> PartQuery:
    """The query with other values of some fields."""
    return query.model_copy(update=fields)


__all__ = ["Mention", "Phrases", "noun_phrase", "plain", "replace", "replace_fields"]
