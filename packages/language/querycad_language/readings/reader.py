"""From a question to its readings: all frames are tried, and the readings that the words link best come first."""

from __future__ import annotations

import math
from collections.abc import Callable, Iterable, Iterator
from functools import cached_property
from itertools import islice

from querycad_language.forms import Distance, Form, Several, mapped, queries
from querycad_language.phrases import Mention
from querycad_language.weights import weights

from .drafts import Draft, Reading
from .frames.comparisons import comparisons
from .frames.contacts import contacts
from .frames.counts import counts, exists
from .frames.distances import angles, distances
from .frames.overhangs import overhangs
from .frames.parts import bare, mating, parts
from .frames.values import values, wholes
from .frames.yes_no import within, yes_no
from .passed import finished, passable
from .question import Question, seen_from

MAX_VIEWS = 2
"""Sides that are said apart from a part; nobody says more."""
MAX_READINGS = 14
"""More are never looked at; those that the words link best come first."""
MAX_DRAFTS = 150
"""Drafts of one frame: twice as many as any question that was collected has."""
FRAMES: tuple[Callable[[Question], Iterator[Draft]], ...] = (
    counts, distances, overhangs, angles, comparisons, yes_no, within, values, wholes, mating, parts, contacts, exists,
)  # fmt: skip
"""Of two readings with one form and equal priors that of the earlier frame is kept."""


class Reader(Question):
    """Finds the readings of one question."""

    @cached_property
    def readings(self) -> list[Reading]:
        """The readings, those that the words link best first."""
        drafts = [draft for frame in FRAMES for draft in islice(frame(self), MAX_DRAFTS)] or list(bare(self))
        drafts += [one for draft in drafts for view in self.views[:MAX_VIEWS] for one in _viewed(draft, view)]
        words = passable(self)
        best: dict[Form, Reading] = {}
        for draft in drafts:
            reading = finished(self, draft, words)
            known = best.get(reading.form)
            if known is None or _prior(reading) > _prior(known):
                best[reading.form] = reading
        return sorted(best.values(), key=_prior, reverse=True)[:MAX_READINGS]


def _viewed(draft: Draft, view: Mention) -> Iterator[Draft]:
    """The form of the parts that are seen from a side that stands apart from them."""
    target = next(queries(draft.form), None)
    if target is None or target.sides or target.unseen or isinstance(draft.form, Distance | Several):
        return
    if draft.used & view.used:
        return  # the part is named in the side: 'on the underside of the foot'
    form = mapped(draft.form, lambda query: seen_from(query, view) if query == target else query)
    yield Draft(form, {**draft.features, "view_apart": 1.0}, draft.used | view.used)


def _prior(reading: Reading) -> float:
    """What the fitted weights say of the words alone."""
    table = weights()
    return math.fsum(table.get(name, 0.0) * value for name, value in reading.features.items())


def read(question: str, names: Iterable[str] = ()) -> list[Reading]:
    """What can a question mean? The readings that the words link best come first; none where nothing is asked."""
    return Reader(question, names).readings
