"""Two collections of the same questions beside each other: what a change of the code gained, and what it lost."""

from __future__ import annotations

from collections.abc import Sequence

from querycad_language.weights import calibration, weights

from .collect import Row
from .cross_validation import SURE
from .fit import Answered, answered, sure

SHOWN = 80
"""Questions that are printed of each kind."""


def compared(old: Sequence[Row], new: Sequence[Row]) -> str:
    """The questions whose answer became right or wrong, with today's weights, and how many are right in each."""
    table, doubts = weights(), calibration()
    before = {(row.question.model, row.question.question): row for row in old}
    both = [(before[at], row) for row in new if (at := (row.question.model, row.question.question)) in before]
    was, now = ([answered(row, table) for row in rows] for rows in zip(*both, strict=True))
    lines = []
    for title, gain in (("gained", 1), ("lost", -1)):
        of = [(row, a, b) for (_, row), a, b in zip(both, was, now, strict=True) if b.right - a.right == gain]
        lines.append(f"{title}: {len(of)}")
        for row, a, b in of[:SHOWN]:
            asked = row.question
            lines.append(f"  {asked.question!r} of {asked.model}, {asked.writer}: {asked.truth!r:.80}")
            lines += [f"    {_shown(one)}" for one in (a, b)]
    for name, answers, rows in (("before", was, old), ("now", now, new)):
        wrong = sum(not one.right and sure(one, doubts) >= SURE for one in answers)
        reach = sum(any(one.right for one in row.tried) for row in rows)
        right = sum(one.right for one in answers)
        lines.append(f"{name}: {right} of {len(answers)} right, {reach} reachable, {wrong} wrong and sure")
    return "\n".join(lines)


def _shown(one: Answered) -> str:
    return "no value" if one.by is None else f"{one.by.value!r:.80} by {one.by.code.strip()[:160]!r}"
