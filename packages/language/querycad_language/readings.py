"""Readings of a question: what it can mean, each with the words that it used and those that it passed over.

Nothing is decided here. Every measure that is named may be asked of every part that is named, or of the whole model; the
features say how the words link them, and what was skipped. Which reading is meant is ranked on the model.
"""

from __future__ import annotations

import math
from collections.abc import Iterable, Iterator, Sequence
from dataclasses import dataclass, field, replace
from typing import Literal

from querycad_contracts import Measure, PartQuery, Place, Relation, Side, SizeFilter

from .forms import (
    LONGEST,
    SHORTER,
    Anchor,
    Angle,
    Behind,
    Boundary,
    Check,
    Combine,
    Count,
    Distance,
    Every,
    Exists,
    Form,
    Get,
    Origin,
    Parallel,
    Parts,
    Plane,
    Reduce,
    Target,
    Uniform,
)
from .lexicon import Span
from .phrases import Mention, Phrases, replace_fields
from .text import Text
from .tokens import DENSITY, Kind

MAX_READINGS = 14
"""More are never looked at; those that the words link best come first."""

Features = dict[str, float]
VECTORS = frozenset((Measure.AXIS, Measure.NORMAL, Measure.DIRECTION, Measure.POSITION, Measure.TIP, Measure.OPENING))
POINTS = frozenset((Measure.POSITION, Measure.TIP, Measure.OPENING))
ADDITIVE = frozenset((Measure.AREA, Measure.VOLUME, Measure.LENGTH, Measure.MASS))
_CENTRE_OF = frozenset(("center", "middle", "axis", "position", "centroid"))


@dataclass(frozen=True, slots=True)
class Reading:
    """One thing that a question can mean."""

    form: Form
    features: Features
    skipped: tuple[tuple[str, str], ...] = ()
    """(class, word) of every word that the form does not reflect, function words aside."""
    used: frozenset[int] = frozenset()


@dataclass(frozen=True, slots=True)
class _Asked:
    """A measure that is named: where, which, and how."""

    start: int
    end: int
    measures: tuple[Measure, ...]
    how: Literal["noun", "how", "verb", "reach", "where"]
    reduce: Reduce | None = None
    used: frozenset[int] = frozenset()


@dataclass(slots=True)
class _Draft:
    form: Form
    features: Features = field(default_factory=dict)
    used: set[int] = field(default_factory=set)


class Reader:
    """Finds the readings of one question. `names`: words of product names in the file."""

    def __init__(self, question: str, names: Iterable[str] = ()) -> None:
        self.text = Text(question, frozenset(names))
        self.phrases = Phrases(self.text)
        self.mentions = self.phrases.mentions()
        self.asking = self._asking_sentence()

    def readings(self) -> list[Reading]:
        """The readings, those that the words link best first."""
        drafts: list[_Draft] = []
        for frame in (
            self._counts,
            self._distances,
            self._overhangs,
            self._angles,
            self._combined,
            self._yes_no,
            self._gets,
            self._which,
            self._exists,
        ):
            drafts.extend(frame())
        if not drafts:
            drafts.extend(self._bare())
        best: dict[Form, Reading] = {}
        for draft in drafts:
            reading = self._finished(draft)
            known = best.get(reading.form)
            if known is None or _prior(reading) > _prior(known):
                best[reading.form] = reading
        return sorted(best.values(), key=_prior, reverse=True)[:MAX_READINGS]

    # The sentence that asks, and what is skipped

    def _asking_sentence(self) -> tuple[int, int]:
        """The sentence that asks: the last one with a question word or an order, else the last one."""
        text = self.text
        best: tuple[int, tuple[int, int]] = (-1, (0, len(text)))
        for index, (start, end) in enumerate(text.sentences):
            score = 0
            if end < len(text) and text.is_word(end, "?"):
                score += 4
            if any(text.find(i, "ask", "count", "exists", "imperative", "where") for i in range(start, end)):
                score += 3
            if any(text.find(i, "measure", "distance", "gap") for i in range(start, end)):
                score += 2
            best = max(best, (score * 100 + index, (start, end)))
        return best[1]

    def _in_question(self, at: int) -> bool:
        return self.asking[0] <= at < self.asking[1]

    def _finished(self, draft: _Draft) -> Reading:
        """The reading with what it skips, by class; of other sentences than the asking one apart."""
        text = self.text
        features = dict(draft.features)
        skipped: list[tuple[str, str]] = []
        depth = 0
        aside = self._axis_asides() | {i for span in text.all("aside") for i in range(span.start - 3, span.end + 3)}
        for at, token in enumerate(text.tokens):
            depth += text.is_word(at, "(") - text.is_word(at, ")")
            if at in draft.used or token.kind is Kind.SYMBOL or at in aside:
                continue
            kind = self._class(at)
            if kind in ("function", "courtesy"):
                continue
            skipped.append((kind, token.raw))
            where = "skip" if self._in_question(at) and depth <= 0 else "aside"
            name = f"{where}_{kind}"
            features[name] = features.get(name, 0.0) + 1.0
        edits = sum(token.corrected for at, token in enumerate(text.tokens) if at in draft.used)
        if edits:
            features["corrected"] = float(edits)
        return Reading(draft.form, features, tuple(skipped), frozenset(draft.used))

    def _axis_asides(self) -> set[int]:
        """'along its axis': the words say how a length is taken, and hardly ever which."""
        text = self.text
        found: set[int] = set()
        for at in range(len(text)):
            if text.find(at, "axis_preposition") and not text.is_word(at, "in", "by"):
                end = next(
                    (i for i in range(at + 1, min(len(text), at + 5)) if text.is_word(i, "axis", "centerline")), None
                )
                if end is not None:
                    found |= set(range(at, end + 1))
        return found

    def _class(self, at: int) -> str:
        """Which class has a word that is passed over?"""
        text, token = self.text, self.text.tokens[at]
        if token.kind in (Kind.QUANTITY, Kind.THREAD, Kind.TIMES) or token.kind is Kind.NUMBER:
            return "number"
        if token.kind is Kind.POSSESSIVE:
            return "function"
        own = {span.category for span in text.spans[at]}
        for other in range(max(0, at - 3), at):  # inside a longer phrase that begins before
            own |= {
                span.category
                for span in text.spans[other]
                if span.end > at and span.category not in ("noun", "measure", "adjective")
            }
        if "courtesy" in own:
            return "courtesy"
        if "side" in own or "view" in own:
            return "function" if text.is_word(at, "back", "right") and "chatter" in own else "side"
        if "negation" in own or ("except" in own and text.is_word(at, "except", "excluding")):
            return "negation"
        if "noun" in own:
            return "noun"
        if "whole" in own or "pronoun" in own or "ask" in own:
            return "function"
        if "measure" in own or "distance" in own or "gap" in own:
            return "measure"
        if "scale" in own or "same" in own or "most" in own or "least" in own or "different" in own:
            return "comparison"
        if "function" in own or "be" in own or "side_preposition" in own:
            return "function"
        if own & {"chatter", "imperative", "have", "relation", "place", "quantifier", "each", "ask"}:
            return "chatter"
        if "adjective" in own:
            adjectives = [span.value for span in text.spans[at] if span.category == "adjective"]
            return "adjective" if any(a.tags or a.order for a in adjectives) else "chatter"
        return (
            "function"
            if own & {"side_noun", "article", "axis_preposition", "total"}
            else "chatter"
            if own
            else "unknown"
        )

    # Measures that are named

    def _asked(self) -> list[_Asked]:
        text = self.text
        taken = {i for mention in self.mentions for i in mention.used}
        found: list[_Asked] = []
        at = 0
        while at < len(text):
            asked = self._asked_at(at, taken)
            if asked is not None:
                found.append(asked)
                at = asked.end
            else:
                at += 1
        return found

    def _asked_at(self, at: int, taken: set[int]) -> _Asked | None:
        text = self.text
        if text.is_word(at, "how") and text.is_word(at + 1, "many") and self._is_unit(at + 2):
            scale = next(
                (
                    s
                    for i in range(at + 3, min(len(text), at + 9))
                    if (s := text.find(i, "scale")) and s.value.degree == "positive"
                ),
                None,
            )
            measure = scale.value.measure if scale else Measure.MAGNITUDE
            used = {at, at + 1, at + 2} | (set(range(scale.start, scale.end)) if scale else set())
            named = any(text.find(i, "measure", "distance", "reach") for i in range(len(text)))
            return None if scale is None and named else _Asked(at, at + 3, (measure,), "how", used=frozenset(used))
        if text.is_word(at, "how"):
            start = at + 1 + text.is_word(at + 1, "much", "far", "exactly")
            scale = text.find(start, "scale")
            if scale and scale.value.degree == "positive":
                return self._joined_scales(at, scale)
            if text.is_word(at + 1, "far", "much"):
                for i in range(at + 2, min(len(text), at + 14)):
                    if reach := text.find(i, "reach"):
                        return _Asked(
                            at,
                            at + 2,
                            (reach.value,),
                            "reach",
                            used=frozenset((at, at + 1, *range(reach.start, reach.end))),
                        )
            return None
        if (verb := text.find(at, "verbs")) and verb.value is Measure.MASS and at not in taken:
            return _Asked(at, verb.end, (verb.value,), "verb", used=frozenset(range(at, verb.end)))
        if (
            (reach := text.find(at, "reach"))
            and at not in taken
            and any(text.is_word(i, "far", "much") for i in range(len(text)))
        ):
            return _Asked(at, reach.end, (reach.value,), "reach", used=frozenset(range(at, reach.end)))
        if where := text.find(at, "where"):
            return _Asked(at, where.end, (Measure.POSITION,), "where", used=frozenset(range(at, where.end)))
        span = text.find(at, "measure")
        noun = text.find(at, "noun")
        if span is None or at in taken or (noun and noun.end > span.end):
            return None
        if span.value is Measure.AXIS and any(
            text.find(i, "axis_preposition") and not text.is_word(i, "in", "by") for i in range(max(0, at - 4), at)
        ):
            return None  # 'along the screw axis' says how a length is taken
        if text.is_word(at, "across", "middle", "tip") and span.end == at + 1 and noun:
            return None
        return self._joined_measures(span, taken)

    def _is_unit(self, at: int) -> bool:
        return at < len(self.text) and self.text.tokens[at].raw.lower() in self.text.lexicon.units

    def _joined_scales(self, at: int, scale: Span) -> _Asked:
        """'How long and wide is …?'"""
        text = self.text
        measures, end = [scale.value.measure], scale.end
        while text.is_word(end, "and", ",") and (more := text.find(end + 1 + text.is_word(end + 1, "how"), "scale")):
            measures.append(more.value.measure)
            end = more.end
        return _Asked(at, end, tuple(measures), "how", used=frozenset(range(at, end)))

    def _joined_measures(self, span: Span, taken: set[int]) -> _Asked:
        """'length, width and height': several measures of one owner; a word before them may say what becomes of them."""
        text = self.text
        measures, end = [span.value], span.end
        while True:
            after = end
            while text.is_word(after, "and", ",", "x", "/", "&", "+", "as", "well"):
                after += 1
            after = text.skip(after, "article")
            more = text.find(after, "measure")
            if after == end or more is None or more.value in measures:
                break
            measures.append(more.value)
            end = more.end
        start, reduce = span.start, None
        used = set(range(span.start, end))
        while start > 0:
            before = start - 1
            for category, meaning in (
                ("most", Reduce.LARGEST),
                ("least", Reduce.SMALLEST),
                ("mean", Reduce.MEAN),
                ("different", Reduce.DIFFERENT),
                ("total", Reduce.TOTAL),
            ):
                word = text.find(before, category)
                if (
                    word is not None
                    and word.end == start
                    and before not in taken
                    and not text.is_word(before - 1, "i", "we", "you")
                ):
                    reduce = reduce or meaning
                    used.add(before)
                    break
            else:
                break
            start = before
        return _Asked(start, end, tuple(measures), "noun", reduce, frozenset(used))

    # Owners of measures

    def _link(self, asked: _Asked, mention: Mention) -> str:
        """How do the words link a measure to a part?"""
        text = self.text
        if mention.end <= asked.start:
            between = range(mention.end, asked.start)
            if self._sentence_of(mention.start) != self._sentence_of(asked.start):
                return "earlier"
            if not between:
                return "compound"
            if any(text.tokens[i].kind is Kind.POSSESSIVE for i in between):
                return "possessive"
            if any(text.is_word(i, ",", "(", "-") for i in between):
                return "topic"
            if any(text.find(i, "have", "ask") for i in between):
                return "having"
            return "before" if all(not text.is_content(i) for i in between) else "far_before"
        if mention.start >= asked.end:
            between = range(asked.end, mention.start)
            if self._sentence_of(mention.start) != self._sentence_of(asked.start):
                return "later"
            words = [text.words[i] for i in between]
            crossed = any(
                asked.end <= other.start and other.end <= mention.start and not other.pronoun for other in self.mentions
            )
            if crossed:
                return "far"
            if any(text.is_content(i) for i in between):
                return "far"
            if words[:1] in (["of"], ["for"]):
                return "of"
            if not words:
                return "of" if asked.how == "noun" else "subject"
            if any(text.find(i, "be", "do", "have") for i in between) or asked.how != "noun":
                return "subject"
            return "preposition" if any(text.find(i, "place") for i in between) else "after"
        return "overlap"

    def _sentence_of(self, at: int) -> int:
        return next((i for i, (start, end) in enumerate(self.text.sentences) if start <= at < end), -1)

    def _owners(self, asked: _Asked) -> Iterator[tuple[Target, str, set[int], Features]]:
        """(target, link, tokens used, features) of all that the measure may be asked of."""
        text = self.text
        strong = ("of", "subject", "compound", "possessive", "having", "preposition")
        linked = [(mention, self._link(asked, mention)) for mention in self.mentions]
        linked = [(m, link) for m, link in linked if link != "overlap"]
        pronoun = text.is_word(asked.start - 1, "its", "their") or any(
            m.pronoun and link in strong for m, link in linked
        )
        owned = any(link in strong and not m.pronoun for m, link in linked)
        nearest = 0
        for mention, link in sorted(linked, key=lambda pair: abs(pair[0].head - asked.start)):
            if mention.pronoun or (mention.query is None and link not in strong):
                continue
            features = {f"link_{link}": 1.0}
            if pronoun and link in ("earlier", "before", "far_before", "topic", "having"):
                features = {"link_pronoun": 1.0, "pronoun_steps": float(nearest)}
            if owned and link not in strong:
                features["owner_passed"] = 1.0
            nearest += 1
            used = set(mention.used)
            if mention.start >= asked.end:
                used |= (
                    {i for i in range(asked.end, mention.start) if not text.is_content(i)}
                    if link in ("of", "subject", "preposition", "after")
                    else set()
                )
            yield mention.query, link, used, features
        before = next((m for m, link in linked if link == "compound" and m.query is not None), None)
        behind = next(
            (m for m, link in linked if link in ("of", "preposition") and m.query is not None and not m.pronoun), None
        )
        if before is not None and behind is not None and before.query is not None and behind.query is not None:
            # 'the counterbore diameter of the small holes': of the counterbores of those
            joined = replace_fields(
                before.query,
                places=(*before.query.places, Place(relation="of", what=behind.query)),
                plural=behind.query.plural,
            )
            yield (
                joined,
                "compound",
                set(before.used | behind.used | set(range(asked.end, behind.start))),
                {"link_compound": 1.0, "link_compound_of": 1.0},
            )
        features = {"link_whole": 1.0}
        if owned:
            features["owner_passed"] = 1.0
        if pronoun:
            features = {"link_whole_pronoun": 1.0}
        mentioned = sum(not m.pronoun and m.query is not None for m in self.mentions)
        if mentioned:
            features["parts_passed"] = 1.0
        sides = {i for m in self.mentions if m.pronoun or m.query is None for i in m.used}
        yield None, "whole", sides, features

    def _gets(self) -> Iterator[_Draft]:
        """A measure of a part, or of the whole."""
        text = self.text
        asked_for = self._asked()
        density = next((t.value for t in text.tokens if t.kind is Kind.QUANTITY and t.power == DENSITY), None)
        wide = {i for i in range(len(text)) if text.find(i, "each", "different", "total", "mean")}
        for asked in asked_for:
            if not self._in_question(asked.start) and any(self._in_question(other.start) for other in asked_for):
                continue
            for target, link, used, features in self._owners(asked):
                reduce, more = self._reduce(asked, target, link)
                measures = asked.measures
                get = Get(measures, target, reduce, density if Measure.MASS in measures else None)
                base = {**features, f"asked_{asked.how}": 1.0}
                if asked.how == "noun" and measures[0] in VECTORS:
                    base["asked_vector"] = 1.0
                overall = {
                    i
                    for i in range(max(0, asked.start - 2), asked.start)
                    if text.is_word(i, "overall", "total", "complete", "entire", "whole", "full", "maximum")
                }
                if overall or text.is_word(asked.start, "overall", "total"):
                    base["overall_whole" if target is None else "overall_part"] = 1.0
                tokens = set(asked.used) | used | more | (wide & more) | overall
                if len(asked_for) > 1 and asked is not asked_for[0]:
                    base["later_measure"] = 1.0
                if density is not None and Measure.MASS in measures:
                    tokens |= {i for i, t in enumerate(text.tokens) if t.power == DENSITY} | {
                        s for span in text.all("density") for s in range(span.start, span.end)
                    }
                yield from self._with_axis(_Draft(get, base, tokens))
                if asked.how == "where":
                    for measure in (Measure.TIP, Measure.OPENING):
                        if any(
                            text.find(i, "measure") and text.find(i, "measure").value is measure
                            for i in range(len(text))
                        ):  # type: ignore[union-attr]
                            yield _Draft(
                                replace(get, measures=(measure,)),
                                {**base, "where_point": 1.0},
                                tokens
                                | {
                                    i for i in range(len(text)) if (s := text.find(i, "measure")) and s.value is measure
                                },
                            )
                yield from self._less(get, base, tokens)
                yield from self._material(get, base, tokens)

    def _material(self, get: Get, features: Features, used: set[int]) -> Iterator[_Draft]:
        """'How thick is the bar between the windows?', 'What thickness remains under the pocket?'"""
        text = self.text
        if get.measures[0] not in (
            Measure.THICKNESS,
            Measure.WIDTH,
            Measure.WALL_THICKNESS,
            Measure.LENGTH,
            Measure.HEIGHT,
        ):
            return
        for place in get.target.places if get.target is not None else ():
            if place.relation == "between" and place.what is not None:
                what = place.what
                second: Anchor | Literal["each other"] = what.also[0] if what.also else "each other"
                first = replace_fields(what, also=(), plural=what.plural or not what.also)
                yield _Draft(Distance(first, second, "surfaces"), {**features, "material_between": 1.0}, used)
        remaining = {i for i in range(len(text)) if text.find(i, "remaining")}
        under = {i for i in range(len(text)) if text.is_word(i, "under", "below", "beneath", "underneath", "behind")}
        if remaining or under:
            for mention in self.mentions:
                if mention.query is not None:
                    cut = mention.query
                    holder = next((p.what for p in cut.places if p.what is not None and p.relation == "of"), None)
                    if cut.noun in ("floor", "bottom", "ground", "base") and holder is not None:
                        cut = holder
                    yield _Draft(
                        Distance(cut, Behind(), "surfaces"),
                        {**features, "material_under": 1.0},
                        used | remaining | under | mention.used,
                    )

    def _with_axis(self, draft: _Draft) -> Iterator[_Draft]:
        """'How long is it in y direction?' is the extent along y."""
        text = self.text
        axis, used = self._axis(draft.used)
        get = draft.form
        assert isinstance(get, Get)
        along = (
            Measure.LENGTH,
            Measure.WIDTH,
            Measure.HEIGHT,
            Measure.DEPTH,
            Measure.MAGNITUDE,
            Measure.SIZE,
            Measure.THICKNESS,
        )
        if axis is not None and axis < LONGEST and len(get.measures) == 1:
            if get.measures[0] in along:
                extent = (Measure.X_EXTENT, Measure.Y_EXTENT, Measure.Z_EXTENT)[axis]
                yield _Draft(replace(get, measures=(extent,)), {**draft.features, "along_axis": 1.0}, draft.used | used)
            elif get.measures[0] is Measure.POSITION:
                point = (Measure.X, Measure.Y, Measure.Z)[axis]
                yield _Draft(replace(get, measures=(point,)), {**draft.features, "along_axis": 1.0}, draft.used | used)
        if get.measures == (Measure.WIDTH,) and any(text.is_word(i, "flat") for i in range(len(text))):
            flats = {i for i in range(len(text)) if text.is_word(i, "across", "over", "flat", "between")}
            yield _Draft(
                replace(get, measures=(Measure.ACROSS_FLATS,)),
                {**draft.features, "along_axis": 1.0},
                draft.used | flats,
            )
        yield draft

    def _axis(self, taken: set[int]) -> tuple[int | None, set[int]]:
        text = self.text
        for at in range(len(text) - 1):
            if text.find(at, "axis_preposition") and (
                side := text.find(text.skip(at + 1, "article"), "measure", "adjective")
            ):
                words = text.words[side.start : side.end]
                named = {"width": 0, "depth": 1, "height": 2}.get(words[0] if words else "")
                if named is not None and text.is_word(at, "along") and at not in taken:
                    return named, set(range(at, side.end))
                if words[:1] in (["long"], ["longer"], ["length"]) and at not in taken:
                    return LONGEST, set(range(at, text.skip(side.end, "side_noun")))
                if words[:1] in (["short"], ["shorter"]) and at not in taken:
                    return SHORTER, set(range(at, text.skip(side.end, "side_noun")))
        for span in text.all("axis"):
            if span.start in taken:
                continue
            lead = text.find(span.start - 1, "axis_preposition") or (
                text.is_word(span.start - 1, "the") and text.find(span.start - 2, "axis_preposition")
            )
            if lead or span.end - span.start > 1 or text.is_word(span.start, "horizontally", "vertically"):
                return span.value, set(range(max(0, span.start - 2), span.end))
        return None, set()

    def _less(self, get: Get, features: Features, used: set[int]) -> Iterator[_Draft]:
        """'How high is the object without the shaft?': less what the shaft has of it."""
        text = self.text
        lengths = (Measure.HEIGHT, Measure.LENGTH, Measure.DEPTH, Measure.WIDTH, Measure.THICKNESS, Measure.VOLUME)
        if get.measures[0] not in lengths or len(get.measures) > 1:
            return
        for span in text.all("minus"):
            other = self.phrases.at(text.skip(span.end, "article", "measure", "function"), joined=False)
            if other is None or other.query is None or span.start < 2:
                continue
            target = get.target
            if target is not None:
                target = replace_fields(target, places=tuple(p for p in target.places if not p.negated), excluded=())
            owned = used | set(range(span.start, other.end))
            combine = Combine("minus", replace(get, target=target), Get(get.measures, other.query))
            yield _Draft(combine, {**features, "less_part": 1.0}, owned)

    def _reduce(self, asked: _Asked, target: Target, link: str) -> tuple[Reduce, set[int]]:
        """What becomes of the values: one each, the shared one, the different ones, their sum, …?"""
        text = self.text
        used: set[int] = set()
        if asked.reduce is not None:
            if asked.reduce is not Reduce.TOTAL or (
                target is not None
                and target.plural
                and asked.measures[0] in ADDITIVE | {Measure.THICKNESS, Measure.WIDTH, Measure.DEPTH}
            ):
                return asked.reduce, used
        start, end = self.asking
        for category, meaning in (("different", Reduce.DIFFERENT), ("mean", Reduce.MEAN), ("total", Reduce.TOTAL)):
            for at in range(start, end):
                span = text.find(at, category)
                if span is None or text.is_word(at - 1, "i", "we", "you"):
                    continue
                if meaning is Reduce.TOTAL and not (
                    target is not None and target.plural and asked.measures[0] in ADDITIVE
                ):
                    used |= set(range(at, span.end))
                    continue
                return meaning, set(range(at, span.end))
        if target is None:
            return Reduce.ONE, used
        each = {i for i in range(start, end) if text.find(i, "each")}
        plural_measure = any(text.tokens[i].plural for i in range(asked.start, asked.end))
        if each or (target.plural and not target.sample):
            return Reduce.EACH, used | each
        return (
            Reduce.EACH
            if plural_measure and not target.definite and asked.measures[0] not in (Measure.SIZE,) and target.plural
            else Reduce.ONE
        ), used

    # Counting

    def _counts(self) -> Iterator[_Draft]:
        text = self.text
        for span in text.all("count"):
            if (
                text.is_word(span.start, "how")
                and text.is_word(span.start + 1, "much")
                and text.find(span.end, "scale")
            ):
                continue
            if self._is_unit(span.end) or (text.is_word(span.start + 1, "much") and text.is_word(span.start - 1, "by")):
                continue
            if text.find(span.start, "measure") and text.words[span.start] not in ("number",):
                continue
            used = set(range(span.start, span.end))
            elsewhere: Features = {} if self._in_question(span.start) else {"count_elsewhere": 1.0}
            at = span.end + text.is_word(span.end, "of")
            at = text.skip(at, "article")
            different = text.find(at, "different")
            inner = different.end if different else at
            measure = text.find(inner, "measure")
            noun_here = text.find(inner, "noun")
            if measure is not None and not (noun_here and noun_here.end >= measure.end):
                yield from self._different_counts(used | set(range(at, measure.end)), measure)
            yield from self._treated(at, used)
            after = [m for m in self.mentions if m.head >= at and not m.pronoun]
            before = [m for m in self.mentions if m.end <= span.start and not m.pronoun]
            for index, mention in enumerate(after[:3]):
                link = (
                    "count_next"
                    if index == 0 and all(not text.is_content(i) for i in range(at, max(at, mention.start)))
                    else "count_far"
                )
                yield from self._count_of(mention, used, {link: 1.0, **elsewhere}, after[index + 1 :] + before)
            for mention in before[-2:]:
                yield from self._count_of(mention, used, {"count_before": 1.0, **elsewhere}, [])

    def _treated(self, at: int, used: set[int]) -> Iterator[_Draft]:
        """'How many edges are chamfered?' counts chamfered edges: what was done to an edge or corner names a part."""
        text = self.text
        if not text.is_word(at, "edge", "corner"):
            return
        for other in range(at + 1, len(text)):
            adjective = text.find(other, "adjective")
            phrase = f"{' '.join(text.words[adjective.start : adjective.end])} {text.words[at]}" if adjective else ""
            if adjective is not None and phrase in text.lexicon.nouns:
                query = PartQuery(noun=phrase, words=tuple(phrase.split()), plural=True)
                yield _Draft(
                    Count(query),
                    {"count_next": 1.0, "treated": 1.0},
                    used | {at, *range(adjective.start, adjective.end)},
                )

    def _different_counts(self, used: set[int], measure: Span) -> Iterator[_Draft]:
        for mention in self.mentions:
            if mention.query is not None and mention.start >= measure.end:
                yield _Draft(
                    Count(mention.query, measure.value), {"count_next": 1.0, "count_values": 1.0}, used | mention.used
                )

    def _count_of(
        self, mention: Mention, used: set[int], features: Features, others: Sequence[Mention]
    ) -> Iterator[_Draft]:
        """How many of them; of another part's where one is named: 'how many teeth does the gear have?'"""
        query = mention.query
        if query is None:
            if mention.plural or not mention.pronoun:
                query = PartQuery(noun="body", words=("body",), plural=True)
            else:
                return
        query = replace_fields(query, plural=True)
        yield _Draft(Count(query), features, used | mention.used)
        for owner in others[:2]:
            if owner.query is not None and not owner.pronoun:
                placed = replace_fields(query, places=(*query.places, Place(relation="of", what=owner.query)))
                link = "owner_after" if owner.start > mention.start else "owner_before"
                yield _Draft(Count(placed), {**features, link: 1.0}, used | mention.used | owner.used)

    def _exists(self) -> Iterator[_Draft]:
        text = self.text
        for span in text.all("exists"):
            if not self._in_question(span.start) or text.find(span.start, "count"):
                continue
            if span.start > 0 and text.find(span.start - 1, "count", "ask", "noun", "scale"):
                continue
            for index, mention in enumerate(
                [m for m in self.mentions if m.start >= span.start and m.query is not None][:2]
            ):
                if mention.query is not None:
                    yield _Draft(
                        Exists(mention.query),
                        {"exists": 1.0, "count_far": float(index)},
                        set(range(span.start, span.end)) | mention.used,
                    )
        start = self.asking[0]
        if text.find(start, "do", "have") or text.is_word(start, "any"):
            owned = [m for m in self.mentions if m.start >= start]
            for index, mention in enumerate(owned[:2]):
                if mention.query is not None:
                    yield _Draft(
                        Exists(mention.query), {"exists": 1.0, "count_far": float(index)}, {start} | mention.used
                    )
                    if index == 1 and owned[0].query is not None:
                        placed = replace_fields(
                            mention.query, places=(*mention.query.places, Place(relation="of", what=owned[0].query))
                        )
                        yield _Draft(
                            Exists(placed), {"exists": 1.0, "owner_before": 1.0}, {start} | mention.used | owned[0].used
                        )

    # Distances and angles

    def _distances(self) -> Iterator[_Draft]:
        text = self.text
        for start, end, mode, used in self._distance_words():
            axis, along = self._axis(set())
            reduce, extreme = self._extreme(used, start, end)
            mode, centred = self._mode(mode)
            base: Features = {"distance": 1.0}
            anchors = self._anchors(start, end)
            for first, second, more, features in self._pairs(anchors, start, end):
                form = Distance(first, second, mode, axis, reduce)  # type: ignore[arg-type]
                yield _Draft(form, {**base, **features}, used | more | along | extreme | centred)

    def _overhangs(self) -> Iterator[_Draft]:
        """'By how much does the tube project above the nut?': between the outer planes of both on that side."""
        text = self.text
        reach = next((span for span in text.all("reach")), None)
        nouns = [m for m in self.mentions if m.query is not None and not m.pronoun]
        word = next(
            (
                i
                for i in range(len(text))
                if text.is_word(i, "above", "over", "beyond", "past", "below", "proud", "higher", "out")
            ),
            None,
        )
        if (
            word is None
            or len(nouns) < 1
            or not (
                reach
                or any(text.is_word(i, "projection", "overhang", "protrusion", "much", "far") for i in range(len(text)))
            )
        ):
            return
        planes = [one for one in self._planes() if isinstance(one[1], Plane)]
        plane = next((one for one in planes if one[0] >= word), None)
        first = nouns[0].query
        assert first is not None
        used = set(nouns[0].used) | ({*range(reach.start, reach.end)} if reach else set()) | {word}
        used |= {i for i in range(len(text)) if text.is_word(i, "how", "much", "far", "projection", "overhang")}
        if plane is not None and isinstance(plane[1], Plane):
            yield _Draft(Distance(Plane(plane[1].side, first), plane[1]), {"overhang": 1.0}, used | plane[2])
        elif len(nouns) > 1 and nouns[1].query is not None and nouns[1].head > word:
            side = Side.BOTTOM if text.is_word(word, "below") else Side.TOP
            yield _Draft(
                Distance(Plane(side, first), Plane(side, nouns[1].query)),
                {"overhang": 1.0, "overhang_side": 1.0},
                used | nouns[1].used,
            )
        if first.places:
            for place in first.places:
                if place.what is not None and place.relation in ("above", "below", "of", "on"):
                    bare = replace_fields(first, places=tuple(p for p in first.places if p is not place))
                    side = place.side or (Side.BOTTOM if place.relation == "below" else Side.TOP)
                    yield _Draft(
                        Distance(Plane(side, bare), Plane(side, place.what)),
                        {"overhang": 1.0, "overhang_side": 1.0},
                        used,
                    )

    def _distance_words(self) -> Iterator[tuple[int, int, str, set[int]]]:
        text = self.text
        named = any(
            text.find(i, "distance", "gap", "count")
            or ((s := text.find(i, "measure")) and s.value is not Measure.POSITION)
            for i in range(len(text))
        )
        centred = any(text.find(i, "center_to_center") for i in range(len(text)))
        joined = any(text.is_word(i, "to", "above", "from") for i in range(1, len(text) - 1)) and len(self.mentions) > 1
        if not named and (centred or joined):
            yield (
                0,
                0,
                "centers" if centred else "usual",
                {i for i in range(len(text)) if text.is_word(i, "to", "above", "from")},
            )
        for span in text.all("distance", "gap"):
            if self._in_question(span.start):
                yield (
                    span.start,
                    span.end,
                    "surfaces" if span.category == "gap" else "usual",
                    set(range(span.start, span.end)),
                )
        for at in range(*self.asking):
            if text.is_word(at, "how") and (
                text.is_word(at + 1, "far")
                or (
                    text.is_word(at + 1, "much")
                    and any(text.find(i, "gap") for i in range(at + 2, min(at + 5, len(text))))
                )
            ):
                if not any(text.find(i, "reach") for i in range(at + 2, min(at + 14, len(text)))):
                    apart = {
                        i for i in range(at, len(text)) if text.is_word(i, "apart", "away", "from", "each", "other")
                    }
                    yield at, at + 2, "usual", {at, at + 1} | apart
            elif (
                text.is_word(at, "how")
                and (scale := text.find(at + 1, "scale"))
                and scale.value.measure is Measure.HEIGHT
            ):
                if any(text.is_word(i, "above", "over", "below", "from", "off") for i in range(at + 2, len(text))):
                    yield at, scale.end, "height", set(range(at, scale.end))
            elif (span := text.find(at, "measure")) and span.value in (
                Measure.HEIGHT,
                Measure.THICKNESS,
                Measure.Z,
                Measure.WIDTH,
                Measure.LENGTH,
                Measure.DEPTH,
            ):
                above = any(
                    text.is_word(i, "above", "over", "below", "between", "from", "off")
                    for i in range(span.end, len(text))
                )
                if above:
                    yield (
                        span.start,
                        span.end,
                        "height" if span.value in (Measure.HEIGHT, Measure.Z) else "surfaces",
                        set(range(span.start, span.end)),
                    )

    def _mode(self, mode: str) -> tuple[str, set[int]]:
        text = self.text
        centred = {i for span in text.all("center_to_center") for i in range(span.start, span.end)}
        if centred:
            return "centers", centred
        facing = {i for span in text.all("surface_to_surface") for i in range(span.start, span.end)}
        facing |= {
            i
            for i in range(len(text))
            if text.find(i, "remaining") and any(text.is_word(j, "between") for j in range(len(text)))
        }
        named = {i for i in range(len(text)) if text.words[i] in _CENTRE_OF and text.is_word(i + 1, "of")}
        if named:
            return "centers", named
        return ("surfaces", facing) if facing else ("centers" if mode == "height" else mode, set())

    def _extreme(self, used: set[int], start: int, end: int) -> tuple[Reduce, set[int]]:
        text = self.text
        for at in range(max(0, start - 2), min(end + 1, len(text))):
            if text.find(at, "most"):
                return Reduce.LARGEST, {at}
            if text.find(at, "least"):
                return Reduce.SMALLEST, {at}
        each = {i for i in range(*self.asking) if text.find(i, "different")}
        return (Reduce.DIFFERENT, each) if each else (Reduce.ONE, set())

    def _anchors(self, start: int, end: int) -> list[tuple[int, Anchor, set[int], bool]]:
        """(position, anchor, tokens, plural) of all that a distance can be measured from, from left to right."""
        text = self.text
        found: list[tuple[int, Anchor, set[int], bool]] = []
        taken: set[int] = set()
        for mention in self.mentions:
            if mention.pronoun or mention.query is None:
                continue
            found.append((mention.head, mention.query, set(mention.used), mention.query.plural))
            taken |= mention.used
            sides = (*mention.query.ends, *mention.query.sides)
            if mention.query.noun in ("face", "surface", "end face", "side face", "flat face") and sides:
                holder = next((p.what for p in mention.query.places if p.what is not None), None)
                plane: Anchor = Plane(sides[0], holder) if holder is not None else Boundary(sides[0])
                found.append((mention.head, plane, set(mention.used), False))
        for at in range(len(text)):
            if at in taken:
                continue
            if edge := text.find(at, "edge"):
                if not (edge.end <= len(text) and text.is_word(at, "edge") and text.is_word(edge.end, "to")):
                    found.append((at, Boundary(None), set(range(at, edge.end)), False))
            elif origin := text.find(at, "origin"):
                found.append((at, Origin(), set(range(at, origin.end)), False))
            elif ground := text.find(at, "ground"):
                found.append((at, Boundary(ground.value), set(range(at, ground.end)), False))
            elif (
                (side := text.find(at, "side"))
                and at > 0
                and (text.find(at - 1, "article") or text.find(at - 1, "side_preposition"))
            ):
                found.append((at, Boundary(side.value), set(range(at, text.skip(side.end, "side_noun"))), False))
        found += self._planes()
        found.sort(key=lambda one: one[0])
        return found

    def _planes(self) -> list[tuple[int, Anchor, set[int], bool]]:
        """'the underside of the head', 'the flange's top face', 'the plate top': outer planes of parts."""
        text = self.text
        found: list[tuple[int, Anchor, set[int], bool]] = []
        for at in range(len(text)):
            side = text.find(at, "side")
            if side is None:
                continue
            after = text.skip(side.end, "side_noun")
            if text.is_word(after, "of") and (other := self.phrases.at(after + 1, 1)) and other.query is not None:
                found.append((at, Plane(side.value, other.query), set(range(at, other.end)), False))
                continue
            before = next((m for m in self.mentions if m.query is not None and m.head < at <= m.head + 2), None)
            if (
                before is not None
                and before.query is not None
                and (after > side.end or text.is_word(at, "top", "bottom", "underside"))
            ):
                bare = replace_fields(before.query, sides=(), ends=())
                found.append((at, Plane(side.value, bare), set(before.used) | set(range(before.head, after)), False))
        return found

    def _pairs(
        self, anchors: list[tuple[int, Anchor, set[int], bool]], start: int, end: int
    ) -> Iterator[tuple[Anchor, object, set[int], Features]]:
        """Which two of the anchors; every two parts of a plural one; one from the middle or the outside of the model."""
        after = [one for one in anchors if one[0] >= start]
        before = [one for one in anchors if one[0] < start]
        text = self.text
        neighbors = {i for i in range(len(text)) if text.find(i, "neighbor")}
        for at, anchor, used, plural in [*after[:3], *before[-2:]]:
            if isinstance(anchor, PartQuery):
                features: Features = {"each_other": 1.0, "each_other_singular": float(not plural and not neighbors)}
                features["count_two"] = float(anchor.count == 2)
                if at < start:
                    features["anchor_before"] = 1.0
                yield anchor, "each other", used | neighbors, features
        pairs = list(zip(after, after[1:], strict=False)) + ([(before[-1], after[0])] if before and after else [])
        pairs += [(after[0], after[2])] if len(after) > 2 else []
        for index, (one, two) in enumerate(pairs):
            features = {"two_anchors": 1.0, "pair_passed": float(index)}
            if not isinstance(one[1], PartQuery | Plane) and not isinstance(two[1], PartQuery | Plane):
                continue
            if one[2] & two[2] and not (isinstance(one[1], PartQuery) and isinstance(two[1], PartQuery)):
                continue
            yield one[1], two[1], one[2] | two[2], features
        middle = {i for i in range(len(text)) if text.is_word(i, "center", "middle")}
        for at, anchor, used, _ in [*after[:2], *before[-1:]]:
            if isinstance(anchor, Plane):
                yield (
                    anchor,
                    Boundary(Side.BOTTOM if anchor.side is Side.TOP else anchor.side.opposite),
                    used,
                    {"from_plane": 1.0},
                )
            if isinstance(anchor, PartQuery):
                if middle:
                    yield anchor, None, used | middle, {"from_middle": 1.0}
                for place in anchor.places:
                    if place.what is not None and place.relation in ("of", "above", "below", "on", "in", "near"):
                        bare = replace_fields(anchor, places=tuple(p for p in anchor.places if p is not place))
                        yield bare, place.what, used, {"place_as_anchor": 1.0}
                for side in anchor.sides:
                    yield (
                        replace_fields(anchor, sides=tuple(s for s in anchor.sides if s is not side)),
                        Boundary(side),
                        used,
                        {"side_as_anchor": 1.0},
                    )

    def _angles(self) -> Iterator[_Draft]:
        text = self.text
        for span in text.all("measure"):
            if span.value is not Measure.ANGLE or not self._in_question(span.start):
                continue
            parts = [m for m in self.mentions if m.query is not None and not m.pronoun and m.start >= span.end]
            used = set(range(span.start, span.end))
            if not any(text.find(i, "between") for i in range(span.end, min(len(text), span.end + 3))) or not parts:
                continue
            first = parts[0].query
            assert first is not None
            if (first.places and first.places[-1].relation == "between") or first.plural:
                yield _Draft(Angle(first, None), {"angle_between": 1.0}, used | parts[0].used)
            if len(parts) > 1 and parts[1].query is not None:
                yield _Draft(Angle(first, parts[1].query), {"angle_between": 1.0}, used | parts[0].used | parts[1].used)

    # Two measures

    def _combined(self) -> Iterator[_Draft]:
        """'How much longer is A than B?', 'the ratio of … to …', 'the difference between …'."""
        text = self.text
        parts = [m for m in self.mentions if not m.pronoun]
        than = next((i for i in range(len(text)) if text.is_word(i, "than")), None)
        start = self.asking[0]
        comparative = next(
            (
                text.find(i, "scale")
                for i in range(start, len(text))
                if (s := text.find(i, "scale")) and s.value.degree in ("more", "less")
            ),
            None,
        )
        if than is not None and comparative is not None:
            left = [m for m in parts if m.end <= than or m.start < than]
            right = [m for m in parts if m.start > than]
            if left and right and text.tokens[than + 1].kind not in (Kind.QUANTITY, Kind.NUMBER):
                measure = comparative.value.measure
                used = {than} | set(range(comparative.start, comparative.end)) | left[-1].used | right[0].used
                a, b = Get((measure,), left[-1].query), Get((measure,), right[0].query)
                if any(text.is_word(i, "much") for i in range(start, comparative.start)):
                    yield _Draft(
                        Combine("apart", a, b), {"combined": 1.0}, used | {i for i in range(start, comparative.start)}
                    )
                elif text.find(start, "be", "do") or text.is_word(start, "which"):
                    relation = Relation.MORE if comparative.value.degree == "more" else Relation.LESS
                    yield _Draft(Check(a, relation, b), {"check": 1.0}, used | {start})
        word = next((i for i in range(start, len(text)) if text.is_word(i, "ratio", "difference", "sum")), None)
        if word is None:
            return
        operation: Literal["ratio", "apart", "plus"] = {"ratio": "ratio", "difference": "apart", "sum": "plus"}[
            text.words[word]
        ]  # type: ignore[assignment]
        asked = [one for one in self._asked() if one.start > word]
        owners = [m for m in parts if m.start > word]
        if not asked:
            return
        used = {word} | {i for one in asked[:2] for i in one.used} | {i for m in owners[:2] for i in m.used}
        measures = [measure for one in asked for measure in one.measures]
        if len(measures) > 1:
            targets: list[Target] = (
                [m.query for m in owners[:2]] if len(owners) > 1 else [owners[0].query] * 2 if owners else [None, None]
            )
            yield _Draft(
                Combine(operation, Get((measures[0],), targets[0]), Get((measures[1],), targets[1])),
                {"combined": 1.0},
                used,
            )
        elif len(owners) > 1:
            yield _Draft(
                Combine(operation, Get((measures[0],), owners[0].query), Get((measures[0],), owners[1].query)),
                {"combined": 1.0},
                used,
            )

    # Yes or no

    def _yes_no(self) -> Iterator[_Draft]:
        """'Is the bore 25 mm?', 'Is the hole on the front threaded?', 'Are all holes equally deep?'"""
        text = self.text
        start = self._verb_start()
        if start is None:
            return
        asked = [one for one in self._asked() if one.start > start]
        parts = [m for m in self.mentions if m.start >= start and not (m.pronoun and len(self.mentions) > 1)]
        if text.is_word(start + 1, "there"):
            return
        if (
            len(parts) > 1
            and parts[0].query is not None
            and parts[1].query is not None
            and text.is_word(parts[1].start, "a", "an")
        ):
            yield _Draft(
                Every(parts[0].query, replace_fields(parts[1].query, plural=True)),
                {"check": 1.0, "predicate": 1.0},
                {start} | parts[0].used | parts[1].used,
            )
        for index, mention in enumerate(parts[:2]):
            target = mention.query
            base: Features = {"check": 1.0, "count_far": float(index)}
            used = {start} | mention.used
            same = {i for i in range(start, len(text)) if text.find(i, "same")}
            if same and target is not None:
                for one in asked or [_Asked(0, 0, (Measure.MAGNITUDE,), "noun")]:
                    yield _Draft(
                        Uniform(Get(one.measures, replace_fields(target, plural=True))), base, used | same | one.used
                    )
            for word, square in (("parallel", False), ("perpendicular", True)):
                at = {i for i in range(start, len(text)) if text.find(i, word)}
                if at and target is not None:
                    second = next((m.query for m in parts if m.start > mention.end), None)
                    more = next((m.used for m in parts if m.start > mention.end), frozenset())
                    yield _Draft(Parallel(target, second, square), base, used | at | more)
            if target is not None and target.sizes:
                size = target.sizes[-1]
                bare = replace_fields(target, sizes=target.sizes[:-1])
                yield from self._checked(bare, size, asked, base, used)
            found = self._size_after(mention.end)
            if found is not None:
                size, tokens = found
                yield from self._checked(target, size, asked, base, used | tokens)
            if target is not None:
                yield from self._predicates(mention, target, base, used)
            if target is not None and (target.adjectives or target.lacking):
                bare = replace_fields(
                    target,
                    adjectives=target.adjectives[:-1] if not target.lacking else target.adjectives,
                    lacking=target.lacking[:-1],
                )
                if self._adjective_last(mention):
                    yield _Draft(Every(bare, target), base, used)
            if target is not None and target.sides:
                yield _Draft(Every(replace_fields(target, sides=()), target), {**base, "check_side": 1.0}, used)

    def _predicates(self, mention: Mention, target: PartQuery, base: Features, used: set[int]) -> Iterator[_Draft]:
        """'Are the ports really round?': what is said of them behind the noun."""
        text = self.text
        for at in range(mention.end, len(text)):
            span = text.find(at, "adjective")
            if span is None or at in used or not span.value.tags:
                continue
            said = replace_fields(target, adjectives=(*target.adjectives, span.value.name))
            if text.is_word(at - 1, "not", "non"):
                said = replace_fields(target, lacking=(*target.lacking, span.value.name))
            yield _Draft(Every(target, said), {**base, "predicate": 1.0}, used | set(range(span.start, span.end)))
            return

    def _verb_start(self) -> int | None:
        """Where a clause begins that is answered by yes or no."""
        text = self.text
        start, end = self.asking
        if any(text.is_word(i, "y", "yes") and text.is_word(i + 1, "/", "or") for i in range(len(text))) or (
            text.is_word(len(text) - 1, "?") and text.is_word(len(text) - 2, "y/n")
        ):
            return start
        for at in range(start, end):
            if text.find(at, "be", "do") and not text.find(at, "ask", "count"):
                lead = range(start, at)
                if text.is_word(at - 1, "there") or any(
                    text.is_word(i, "what", "how", "which", "where") for i in range(start, end)
                ):
                    return None
                if all(
                    text.find(i, "chatter", "courtesy", "imperative", "function")
                    or text.is_word(i, ",", "if", "whether")
                    for i in lead
                ) and not any(
                    text.find(i, "ask", "where", "count", "noun", "measure") and not text.is_word(i, "that", "this")
                    for i in lead
                ):
                    return at
                return None
        return None

    def _size_after(self, at: int) -> tuple[SizeFilter, set[int]] | None:
        text = self.text
        for begin in range(at, min(len(text), at + 6)):
            found = self.phrases.size(begin)
            if found is not None:
                return found[0], set(range(begin, found[1]))
        return None

    def _checked(
        self, target: Target, size: SizeFilter, asked: Sequence[_Asked], base: Features, used: set[int]
    ) -> Iterator[_Draft]:
        measure = size.measure or (asked[0].measures[0] if asked else Measure.MAGNITUDE)
        tokens = set(used)
        for one in asked:
            tokens |= one.used
        relation = (
            Relation.AT_LEAST
            if size.relation is Relation.EQUAL and any(self.text.is_word(i, "least") for i in range(len(self.text)))
            else size.relation
        )
        yield _Draft(Check(Get((measure,), target), relation, size.low, size.high), base, tokens)

    def _adjective_last(self, mention: Mention) -> bool:
        return (
            self.text.find(mention.end - 1, "adjective", "trait") is not None
            and self.text.find(mention.end - 1, "noun") is None
        ) or mention.head < mention.end - 1

    # Which, and nothing but a part

    def _which(self) -> Iterator[_Draft]:
        """'Which holes are deeper than 11 mm?', 'On which side is the slot?', 'What is the largest hole?'"""
        text = self.text
        start = self.asking[0]
        side = next(
            (
                i
                for i in range(start, len(text) - 1)
                if text.is_word(i, "which", "what")
                and (text.is_word(i + 1, "side") or (text.is_word(i + 1, "face") and text.is_word(i - 1, "on", "in")))
            ),
            None,
        )
        for index, mention in enumerate([m for m in self.mentions if m.query is not None and m.start >= start][:3]):
            query = mention.query
            assert query is not None
            if side is not None:
                yield _Draft(
                    Get((Measure.SIDES,), query),
                    {"which_side": 1.0, "count_far": float(index)},
                    {side - 1, side, side + 1} | mention.used,
                )
            lead = range(start, mention.start + 1)
            if any(text.is_word(i, "which", "list", "show", "name", "mark", "highlight") for i in lead) and index == 0:
                yield _Draft(Parts(query), {"which": 1.0}, {i for i in lead if not text.is_content(i)} | mention.used)
            elif any(text.is_word(i, "what") for i in lead) and index == 0:
                used = {i for i in lead if not text.is_content(i)} | mention.used
                yield _Draft(Get((Measure.MAGNITUDE,), query), {"named_only": 1.0}, used)
                if query.ranks:
                    yield _Draft(Parts(query), {"which": 1.0, "named_only": 1.0}, used)

    def _bare(self) -> Iterator[_Draft]:
        """No measure is named at all: 'mounting holes?'"""
        for mention in self.mentions[:3]:
            if mention.query is not None:
                yield _Draft(Get((Measure.MAGNITUDE,), mention.query), {"named_only": 1.0}, set(mention.used))
                if mention.query.plural:
                    yield _Draft(Count(mention.query), {"named_only": 1.0}, set(mention.used))


_PRIOR = {
    "skip_number": -3.0, "skip_side": -3.0, "skip_noun": -2.0, "skip_measure": -1.5, "skip_negation": -3.0, "skip_comparison": -1.5, "skip_unknown": -1.0,
    "skip_adjective": -1.0, "skip_chatter": -0.1, "aside_number": -0.5, "aside_side": -0.5, "aside_noun": -0.3, "aside_measure": -0.3, "link_of": 2.0, "link_subject": 2.0, "link_compound": 2.0,
    "link_possessive": 2.0, "link_having": 1.5, "link_preposition": 1.5, "link_pronoun": 1.0, "link_before": 0.5, "link_topic": 0.7, "link_earlier": 0.2, "link_later": -0.5, "link_far": -1.0,
    "link_far_before": -0.5, "owner_passed": -2.0, "parts_passed": -0.5, "later_measure": -0.3, "count_next": 2.0, "count_far": -1.0, "count_before": 0.5, "owner_after": 0.3, "distance": 0.5, "named_only": -2.5,
    "along_axis": 1.0, "less_part": 1.0, "two_anchors": 0.5, "pair_passed": -1.0, "exists": 1.0, "check": 1.0,
}  # fmt: skip
"""Rough weights that only decide which readings are looked at; the fitted ones rank them."""


def _prior(reading: Reading) -> float:
    return math.fsum(_PRIOR.get(name, 0.0) * value for name, value in reading.features.items())


def read(question: str, names: Iterable[str] = ()) -> list[Reading]:
    """What can a question mean? The readings that the words link best come first; none where nothing is asked."""
    return Reader(question, names).readings()


__all__ = ["Features", "Reader", "Reading", "Side", "read"]
