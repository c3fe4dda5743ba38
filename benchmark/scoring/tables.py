"""How did it go? Tables for the terminal."""

from __future__ import annotations

from collections.abc import Callable, Sequence

from rich.console import Console
from rich.markup import escape
from rich.table import Table

from .failures import FailureClass
from .results import Result, Results, counts

Key = Callable[[Result], str]

HELD_OUT = "held_out"
"""The half of the project's own questions whose score is reported and whose questions are not worked with."""


def print_results(results: Results, console: Console) -> None:
    """Score by set and by what is asked for, then every wrong answer."""
    listed = results.results
    console.print(score_table(f"{results.benchmark}: score", "set", listed, lambda result: result.set))
    console.print(score_table("by what is asked for", "property or type", listed, lambda result: result.topic))
    if any(not result.tolerant for result in listed):
        console.print(failure_table(listed))
        console.print(wrong_table([result for result in listed if result.set != HELD_OUT]))
    if any(result.set == HELD_OUT for result in listed):
        console.print(f"wrong answers of the set {HELD_OUT} are in results.json only: nobody is to work towards them")


def score_table(title: str, heading: str, results: Sequence[Result], key: Key) -> Table:
    """How many are right in each group, and in all?"""
    table = Table(heading, title=title, title_justify="left")
    for name in ("questions", "strict", "", "tolerant", "", "median s"):
        table.add_column(name, justify="right")
    groups = sorted({key(result) for result in results})
    for group in groups:
        table.add_row(escape(group), *_score_cells([result for result in results if key(result) == group]))
    if len(groups) > 1:
        table.add_section()
        table.add_row("total", *_score_cells(results), style="bold")
    return table


def _score_cells(results: Sequence[Result]) -> tuple[str, ...]:
    total, strict, tolerant = counts(results)
    seconds = sorted(result.seconds for result in results if result.seconds is not None)
    median = f"{seconds[len(seconds) // 2]:.3f}" if seconds else ""
    return (str(total), str(strict), share(strict, total), str(tolerant), share(tolerant, total), median)


def share(part: int, whole: int) -> str:
    """`part` of `whole` in per cent."""
    return f"{100 * part / whole:.1f} %" if whole else "–"


def failure_table(results: Sequence[Result]) -> Table:
    """Why were the wrong ones wrong?"""
    table = Table("set", title="wrong, by class of failure", title_justify="left")
    for failure in FailureClass:
        table.add_column(failure.value, justify="right")
    sets = sorted({result.set for result in results})
    for name in sets:
        wrong = [result.failure for result in results if result.set == name and not result.tolerant]
        table.add_row(escape(name), *(str(wrong.count(failure)) for failure in FailureClass))
    return table


def wrong_table(results: Sequence[Result]) -> Table:
    """Which answers are not right by both rules?"""
    table = Table(title="not right by both rules", title_justify="left", show_lines=True)
    for name, ratio in (("question", 5), ("answer", 3), ("label", 3), ("strict", 1), ("tolerant", 1), ("class", 2)):
        table.add_column(name, ratio=ratio, overflow="fold")
    for result in results:
        if result.strict and result.tolerant:
            continue
        table.add_row(
            f"[dim]{escape(result.key)}[/dim]\n{escape(result.question)}",
            escape(cut(result.answer or result.message or result.status)),
            escape(cut(result.label)),
            mark(result.strict),
            mark(result.tolerant),
            result.failure.value if result.failure else "",
        )
    return table


def mark(is_right: bool) -> str:
    """A word for right and wrong, so that colour is not needed."""
    return "[green]right[/green]" if is_right else "[red]wrong[/red]"


def cut(text: str, length: int = 160) -> str:
    """The text, shortened where it is too long for a cell."""
    return text if len(text) <= length else text[: length - 1] + "…"
