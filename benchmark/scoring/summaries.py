"""What a merge request shows of a run: a summary in Markdown, and the questions in JUnit's form."""

from __future__ import annotations

from collections.abc import Sequence
from pathlib import Path
from xml.etree import ElementTree

from .compare import Change, Comparison
from .floor import Fall
from .results import Result, Results, counts

SHOWN = 20
"""Questions that are named; the results hold them all."""


def markdown(runs: Sequence[Results], fallen: Sequence[Fall]) -> str:
    """A table of the sets, and what is below the floor."""
    lines = ["## Benchmark", "", "| set | questions | strict | tolerant |", "|---|---|---|---|"]
    for run in runs:
        for name in sorted({result.set for result in run.results}):
            of_set = [result for result in run.results if result.set == name]
            questions, strict, tolerant = counts(of_set)
            lines.append(f"| {run.benchmark}, {name} | {questions} | {strict} | {tolerant} |")
    lines += (
        ["", *(f"**Below the floor**: {fall}" for fall in fallen)] if fallen else ["", "Nothing is below the floor."]
    )
    return "\n".join(lines) + "\n"


def markdown_comparison(found: Comparison) -> str:
    """What a change fixed, and what it broke."""
    lines = ["## Against the base", "", f"Fixed {len(found.fixed)}, broken {len(found.broken)}.", ""]
    for title, changes in (("Broken", found.broken), ("Fixed", found.fixed)):
        if changes:
            lines += [f"### {title}", "", "| question | before | after | label |", "|---|---|---|---|"]
            lines += [_row(change) for change in changes[:SHOWN]]
            lines += ["", f"… and {len(changes) - SHOWN} more", ""] if len(changes) > SHOWN else [""]
    return "\n".join(lines)


def junit(runs: Sequence[Results], fallen: Sequence[Fall], path: Path) -> None:
    """Writes every question as a test: a wrong one is skipped with its answer, and a set below its floor has failed."""
    root = ElementTree.Element("testsuites", name="querycad bench")
    for run in runs:
        for name in sorted({result.set for result in run.results}):
            of_set = [result for result in run.results if result.set == name]
            below = [fall for fall in fallen if (fall.benchmark, fall.set) == (run.benchmark, name)]
            wrong = [result for result in of_set if not result.tolerant]
            numbers = {"tests": len(of_set) + 1, "failures": len(below), "skipped": len(wrong)}
            told = {"name": f"{run.benchmark}.{name}"} | {key: str(number) for key, number in numbers.items()}
            suite = ElementTree.SubElement(root, "testsuite", told)
            floor = ElementTree.SubElement(suite, "testcase", classname=suite.attrib["name"], name="floor")
            for fall in below:
                ElementTree.SubElement(floor, "failure", message=str(fall))
            for result in of_set:
                seconds = {"time": f"{result.seconds:.3f}"} if result.seconds is not None else {}
                named = {"classname": suite.attrib["name"], "name": f"{result.key} {result.question}"}
                case = ElementTree.SubElement(suite, "testcase", named | seconds)
                if not result.tolerant:
                    message = f"{_shown(result)} (label {result.label})"
                    ElementTree.SubElement(case, "skipped", message=message)
    path.parent.mkdir(parents=True, exist_ok=True)
    ElementTree.ElementTree(root).write(path, encoding="utf-8", xml_declaration=True)


def _row(change: Change) -> str:
    cells = (change.after.question, _shown(change.before), _shown(change.after), change.after.label)
    return "| " + " | ".join(cell.replace("|", "\\|").replace("\n", " ") for cell in cells) + " |"


def _shown(result: Result) -> str:
    return result.answer or result.message or "no answer"
