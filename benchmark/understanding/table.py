"""The fitted weights as the readable table that `querycad_language.weights` reads."""

from __future__ import annotations

import json
from pathlib import Path

from querycad_language.weights import ALONE

from .fit import Table

FILE = Path("packages/language/querycad_language/data/weights.toml")
LEAST = 0.15
"""Smaller weights are not written."""
FAMILY = 8
"""Of fewer features with one first word each stands alone."""
GROUPS = ("of", "as")
"""Of each measure: how natural it is of a kind of part, and what it means there: 'depth of hole'."""


def write(table: Table, doubts: Table, fitted: str) -> None:
    """The weights as a readable table into the checkout. `fitted`: what they were fitted on."""
    lines = [
        "# Written by `make fit`; docs/understanding.md explains each feature. Positive weights speak for a reading.",
        f"# {fitted}.",
        f"calibration = {_inline(doubts, 0.0)}",
        "[weights]", *(f"{name} = {_inline(of)}" for name, of in families(table).items()),
        "[measures]",
    ]  # fmt: skip
    for measure, groups in grouped(table).items():
        told = {group: of for group, of in groups.items() if max(map(abs, of.values())) >= LEAST}
        if told:
            lines.append(f"{measure} = {{ {', '.join(f'{group} = {_inline(of)}' for group, of in told.items())} }}")
    FILE.write_text("\n".join([*lines, ""]), encoding="utf-8")


def _inline(table: Table, least: float = LEAST) -> str:
    """A table on one line, without what weighs next to nothing."""
    told = (f"{json.dumps(name)} = {weight}" for name, weight in table.items() if abs(weight) >= least)
    return f"{{ {', '.join(told)} }}"


def families(table: dict[str, float]) -> dict[str, dict[str, float]]:
    """The weights of plain features as the file holds them, by the first word of their names, or `ALONE`."""
    found: dict[str, dict[str, float]] = {ALONE: {}}
    for name, weight in sorted(table.items()):
        if " " not in name:
            first, _, rest = name.partition("_")
            found.setdefault(first, {})[rest] = weight
    for first, of in list(found.items()):
        if len(of) < FAMILY and first != ALONE:
            found[ALONE] |= {"_".join(filter(None, (first, rest))): weight for rest, weight in found.pop(first).items()}
    return found


def grouped(table: dict[str, float]) -> dict[str, dict[str, dict[str, float]]]:
    """The weights of measures as the file holds them: measure, group, then kind or expression."""
    found: dict[str, dict[str, dict[str, float]]] = {}
    for name, weight in sorted(table.items()):
        measure, group, of = (*name.split(" ", 2), "", "")[:3]
        if group in GROUPS:
            found.setdefault(measure, {}).setdefault(group, {})[of] = weight
    return found
