"""What changed between runs: which answers were fixed, which broken?"""

from __future__ import annotations

from collections import Counter
from collections.abc import Sequence
from dataclasses import dataclass

from rich.console import Console
from rich.markup import escape
from rich.table import Table

from .results import Result, Results, counts
from .tables import cut, share

ONLY_SHOWN = 5
"""Questions named that only one run has."""


@dataclass(frozen=True, slots=True)
class Change:
    """The same question in two runs."""

    before: Result
    after: Result


@dataclass(frozen=True, slots=True)
class Comparison:
    """Fixed and broken by the tolerant rule; `strict_fixed` and `strict_broken` only by the strict one.

    `only_before` and `only_after` are keys of questions that the other run does not have with the same label.
    """

    fixed: tuple[Change, ...]
    broken: tuple[Change, ...]
    strict_fixed: tuple[Change, ...]
    strict_broken: tuple[Change, ...]
    only_before: tuple[str, ...]
    only_after: tuple[str, ...]


def compare(before: Results, after: Results) -> Comparison:
    """Which questions are answered right in one run and wrong in the other?"""
    old = {(result.key, result.question, result.label): result for result in before.results}
    new = {(result.key, result.question, result.label): result for result in after.results}
    changes = [Change(old[key], new[key]) for key in old if key in new]
    fixed = tuple(c for c in changes if c.after.tolerant and not c.before.tolerant)
    broken = tuple(c for c in changes if c.before.tolerant and not c.after.tolerant)
    rest = [c for c in changes if c.before.tolerant == c.after.tolerant]
    return Comparison(
        fixed=fixed,
        broken=broken,
        strict_fixed=tuple(c for c in rest if c.after.strict and not c.before.strict),
        strict_broken=tuple(c for c in rest if c.before.strict and not c.after.strict),
        only_before=tuple(key[0] for key in old if key not in new),
        only_after=tuple(key[0] for key in new if key not in old),
    )


def print_comparison(before: Results, after: Results, names: tuple[str, str], console: Console) -> None:
    """The scores beside each other, then every answer that was fixed or broken."""
    found = compare(before, after)
    console.print(side_by_side([(names[0], before), (names[1], after)]))
    sections = (
        ("fixed", found.fixed),
        ("broken", found.broken),
        ("fixed, strict rule only", found.strict_fixed),
        ("broken, strict rule only", found.strict_broken),
    )
    for title, changes in sections:
        if changes:
            console.print(_change_table(f"{title}: {len(changes)}", changes))
    if not any(changes for _, changes in sections):
        console.print("no answer was fixed or broken")
    for name, keys in zip(names, (found.only_before, found.only_after), strict=True):
        if keys:
            shown = ", ".join(keys[:ONLY_SHOWN]) + (" …" if len(keys) > ONLY_SHOWN else "")
            console.print(f"only in {escape(name)}: {len(keys)}, {escape(shown)}")


def side_by_side(runs: Sequence[tuple[str, Results | str]], title: str = "", heading: str = "run") -> Table:
    """How many are right in each run, by set? One row a run. A text in the place of results: why there are none."""
    measured = [run for _, run in runs if isinstance(run, Results)]
    sets = sorted({result.set for run in measured for result in run.results})
    title = f"{title}: right, strict / tolerant, of all".removeprefix(": ")
    table = Table(heading, title=title, title_justify="left")
    for name in (*sets, "total", "tolerant", "median s"):
        table.add_column(escape(name), justify="right")
    table.add_column("programs by", overflow="fold")
    for name, run in runs:
        if isinstance(run, str):
            table.add_row(escape(name), *["–"] * (len(sets) + 3), f"[red]not measured:[/red] {escape(run)}")
            continue
        groups = [[result for result in run.results if result.set == group] for group in sets]
        total, _, tolerant = counts(run.results)
        cells = [_cell(group) for group in (*groups, run.results)]
        table.add_row(escape(name), *cells, share(tolerant, total), _median(run.results), escape(_writers(run.results)))
    return table


def _median(results: Sequence[Result]) -> str:
    seconds = sorted(result.seconds for result in results if result.seconds is not None)
    return f"{seconds[len(seconds) // 2]:.3f}" if seconds else ""


def _writers(results: Sequence[Result]) -> str:
    """Whose programs were they? Where a language model is not reached, the parser answers in its place."""
    written = Counter(result.codegen for result in results if result.codegen is not None)
    return ", ".join(f"{name}: {count}" for name, count in sorted(written.items()))


def _cell(results: Sequence[Result]) -> str:
    total, strict, tolerant = counts(results)
    return f"{strict} / {tolerant} of {total}"


def _change_table(title: str, changes: Sequence[Change]) -> Table:
    table = Table(title=title, title_justify="left", show_lines=True)
    for name, ratio in (("question", 4), ("before", 3), ("after", 3), ("label", 3)):
        table.add_column(name, ratio=ratio, overflow="fold")
    for change in changes:
        table.add_row(
            f"[dim]{escape(change.after.key)}[/dim]\n{escape(change.after.question)}",
            escape(_said(change.before)),
            escape(_said(change.after)),
            escape(cut(change.after.label)),
        )
    return table


def _said(result: Result) -> str:
    return cut(result.answer or result.message or result.status)
