"""From a question to its readings: all frames are tried, and the readings that the words link best come first."""

from __future__ import annotations

import math
from collections.abc import Callable, Iterable, Iterator
from functools import cached_property
from itertools import islice

from querycad_language.forms import Form

from .drafts import Draft, Reading
from .frames.comparisons import comparisons
from .frames.counts import counts, exists
from .frames.distances import angles, distances
from .frames.overhangs import overhangs
from .frames.parts import bare, parts
from .frames.values import values
from .frames.yes_no import yes_no
from .passed import finished, passable
from .question import Question

MAX_READINGS = 14
"""More are never looked at; those that the words link best come first."""
MAX_DRAFTS = 150
"""Drafts of one frame: twice as many as any question that was collected has."""
FRAMES: tuple[Callable[[Question], Iterator[Draft]], ...] = (
    counts, distances, overhangs, angles, comparisons, yes_no, values, parts, exists,
)  # fmt: skip
"""Of two readings with one form and equal priors that of the earlier frame is kept."""


class Reader(Question):
    """Finds the readings of one question."""

    @cached_property
    def readings(self) -> list[Reading]:
        """The readings, those that the words link best first."""
        drafts = [draft for frame in FRAMES for draft in islice(frame(self), MAX_DRAFTS)] or list(bare(self))
        words = passable(self)
        best: dict[Form, Reading] = {}
        for draft in drafts:
            reading = finished(self, draft, words)
            known = best.get(reading.form)
            if known is None or _prior(reading) > _prior(known):
                best[reading.form] = reading
        return sorted(best.values(), key=_prior, reverse=True)[:MAX_READINGS]


_PRIOR = {
    "skip_number": -3.0, "skip_side": -3.0, "skip_noun": -2.0, "skip_measure": -1.5, "skip_negation": -3.0,
    "skip_comparison": -1.5, "skip_unknown": -1.0, "skip_adjective": -1.0, "skip_chatter": -0.1,
    "aside_number": -0.5, "aside_side": -0.5, "aside_noun": -0.3, "aside_measure": -0.3,
    "link_of": 2.0, "link_subject": 2.0, "link_compound": 2.0, "link_possessive": 2.0, "link_having": 1.5,
    "link_preposition": 1.5, "link_pronoun": 1.0, "link_before": 0.5, "link_topic": 0.7, "link_earlier": 0.2,
    "link_later": -0.5, "link_far": -1.0, "link_far_before": -0.5, "owner_passed": -2.0, "parts_passed": -0.5,
    "later_measure": -0.3, "count_next": 2.0, "count_far": -1.0, "count_before": 0.5, "owner_after": 0.3,
    "distance": 0.5, "named_only": -2.5, "along_axis": 1.0, "less_part": 1.0, "two_anchors": 0.5,
    "pair_passed": -1.0, "exists": 1.0, "check": 1.0,
}  # fmt: skip
"""Rough weights that only decide which readings are looked at; the fitted ones rank them."""


def _prior(reading: Reading) -> float:
    return math.fsum(_PRIOR.get(name, 0.0) * value for name, value in reading.features.items())


def read(question: str, names: Iterable[str] = ()) -> list[Reading]:
    """What can a question mean? The readings that the words link best come first; none where nothing is asked."""
    return Reader(question, names).readings
