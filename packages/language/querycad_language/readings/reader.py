"""From a question to its readings: all frames are tried, and the readings that the words link best come first."""

from __future__ import annotations

import math
from collections.abc import Callable, Iterable, Iterator
from dataclasses import replace
from functools import cached_property
from itertools import islice

from querycad_language.forms import Combine, Distance, Form, Several, Towards, mapped, queries
from querycad_language.phrases import Mention, replace_fields
from querycad_language.weights import weights

from .frames.comparisons import comparisons
from .frames.counts import counts, exists
from .frames.distances import angles, distances, insertions, named_distances, opposites, overhangs
from .frames.parts import bare, mating, parts
from .frames.predicates import predicates
from .frames.values import values, wholes
from .frames.yes_no import yes_no
from .parses import Parse, Reading
from .question import Holder, Question
from .skipped_words import CLOSED, finished, passable

MAX_VIEWS = 2  # sides that are said apart from a part; nobody says more
MAX_READINGS = 14  # more are never looked at; those that the words link best come first
MAX_DRAFTS = 150  # parses of one frame: twice as many as any question that was collected has
FRAMES: tuple[Callable[[Question], Iterator[Parse]], ...] = (
    counts, named_distances, distances, overhangs, insertions, opposites, angles, comparisons, yes_no, predicates,
    values, wholes, mating, parts, exists,
)  # fmt: skip
"""Of two readings with one form and equal priors that of the earlier frame is kept."""


class Reader(Question):
    """Finds the readings of one question."""

    @cached_property
    def readings(self) -> list[Reading]:
        """The readings, those that the words link best first."""
        parses = [parse for frame in FRAMES for parse in islice(frame(self), MAX_DRAFTS)] or list(bare(self))
        parses += [one for parse in parses for view in self.views[:MAX_VIEWS] for one in _viewed(parse, view)]
        parses += [one for parse in parses for holder in self.holders[:MAX_VIEWS] for one in _held(parse, holder)]
        words, sided = passable(self), self.text.has("side")  # 'which side, in the file's axes' asks for no axis
        named = any(not (sided and self.text.tokens[i].plural) for i in self.text.at_words("axis"))
        best: dict[Form, Reading] = {}
        for parse in parses:
            if isinstance(parse.form, Towards) and (self.text.has("+") or named):
                parse = replace(parse, form=replace(parse.form, axes=True))
            reading = finished(self, parse, words)
            known = best.get(reading.form)
            if known is None or _prior(reading) > _prior(known):
                best[reading.form] = reading
        operations = {i for i in self.text.at_phrases("operation") if self.in_question(i)}
        if operations and any(isinstance(one.form, Combine) and operations <= one.used for one in best.values()):
            best = {form: one for form, one in best.items() if not operations.isdisjoint(one.used)}
        if any("named_only" not in one.features and not one.skipped for one in best.values()):  # every word is read
            best = {form: one for form, one in best.items() if "named_only" not in one.features}
        decided = [one for one in best.values() if isinstance(one.form, CLOSED)] if self.closed else []
        whole = any(not one.skipped for one in decided)  # yes or no to every word: no value is asked
        return sorted(decided if whole else best.values(), key=_prior, reverse=True)[:MAX_READINGS]


def _viewed(parse: Parse, view: Mention) -> Iterator[Parse]:
    """The form of the parts that are seen from a side that stands apart from them."""
    target = next(queries(parse.form), None)
    named = parse.used & view.used  # the part is named in the side: 'on the underside of the foot'
    if target and not (target.sides or target.unseen or named or isinstance(parse.form, Distance | Several)):
        names = ("sides", "unseen", "places", "adjectives")
        seen = replace_fields(target, **{name: (*getattr(target, name), *getattr(view.part, name)) for name in names})
        form = mapped(parse.form, lambda query: seen if query == target else query)
        yield Parse(form, {**parse.features, "view_apart": 1.0}, parse.used | view.used)


def _held(parse: Parse, holder: Holder) -> Iterator[Parse]:
    """The form of the parts that are so by what was named before: 'Small boss: bore diameter?'"""
    target = next(queries(parse.form), None)
    if target is not None and holder.noun in (None, target.noun) and not parse.used & holder.used:
        placed = replace_fields(target, places=(*target.places, holder.place))
        form = mapped(parse.form, lambda query: placed if query == target else query)
        yield Parse(form, {**parse.features, holder.feature: 1.0}, parse.used | holder.used)


def _prior(reading: Reading) -> float:
    """What the fitted weights say of the words alone."""
    table = weights()
    return math.fsum(table.get(name, 0.0) * value for name, value in reading.features.items())


def read(question: str, names: Iterable[str] = ()) -> list[Reading]:
    """What can a question mean? The readings that the words link best come first; none where nothing is asked."""
    return Reader(question, names).readings
