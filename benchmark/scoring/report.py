"""The results as one web page that needs no other file: every question, its answer, its code and what was found."""

from __future__ import annotations

import base64
from collections.abc import Sequence
from html import escape
from importlib.resources import files
from itertools import groupby
from pathlib import Path
from string import Template

from .results import Result, Results, counts
from .tables import share


def write_report(results: Results, path: Path) -> None:
    """Writes the page. Pictures are looked for beside it, as `Result.picture` says, and put into it."""
    template = Template(files(__package__).joinpath("report.html").read_text(encoding="utf-8"))
    total, strict, tolerant = counts(results.results)
    codegen = results.options.codegen if results.options else "answers given elsewhere"
    groups = groupby(results.results, key=lambda result: (result.set, result.id))
    page = template.substitute(
        title=escape(f"Benchmark {results.benchmark}"),
        lead=escape(
            f"{total} questions; {strict} right by the published rule ({share(strict, total)}), "
            f"{tolerant} within tolerance ({share(tolerant, total)}). Code: {codegen}."
        ),
        scores="".join(_score_row(name, group) for name, group in _sets(results.results)),
        models="\n".join(_model(f"{name[0]}/{name[1]}", list(group), path.parent) for name, group in groups),
    )
    path.write_text(page, encoding="utf-8")


def _sets(results: Sequence[Result]) -> list[tuple[str, list[Result]]]:
    names = dict.fromkeys(result.set for result in results)
    return [(name, [result for result in results if result.set == name]) for name in names]


def _score_row(name: str, results: Sequence[Result]) -> str:
    total, strict, tolerant = counts(results)
    cells = (f"{strict} ({share(strict, total)})", f"{tolerant} ({share(tolerant, total)})")
    return f"<tr><td>{escape(name)}</td><td>{total}</td>" + "".join(f"<td>{cell}</td>" for cell in cells) + "</tr>"


def _model(name: str, results: Sequence[Result], folder: Path) -> str:
    total, _, tolerant = counts(results)
    articles = "\n".join(_question(result, folder) for result in results)
    return f"<section><h2>{escape(name)}: {tolerant} of {total}</h2>\n{articles}</section>"


def _question(result: Result, folder: Path) -> str:
    state = "" if result.strict and result.tolerant else "strict-wrong" if result.tolerant else "wrong"
    failure = f'<span class="badge">{escape(result.failure.value)}</span>' if result.failure else ""
    rows = [
        ("answer", f"<code>{escape(result.answer)}</code>" if result.answer is not None else "none"),
        ("read as", escape(result.text)),
        ("label", f"<code>{escape(result.label)}</code>"),
        ("rests on", escape("; ".join(f"{part.id}: {part.label}" for part in result.parts))),
        ("said", escape(result.message)),
        ("noted", escape(result.note)),
        ("time", f"{result.seconds * 1e3:.0f} ms" if result.seconds is not None else ""),
    ]
    listed = "".join(f"<dt>{name}</dt><dd>{value}</dd>" for name, value in rows if value)
    code = ""
    if result.code:
        summary = f"<summary>code, by {escape(result.codegen or 'unknown')}</summary>"
        code = f"<details>{summary}<pre>{escape(result.code)}</pre></details>"
    badges = _badge("strict", result.strict) + _badge("tolerant", result.tolerant) + failure
    heading = f'<h3>{escape(result.question)} <span class="key">{escape(result.key)}</span></h3>'
    return f'<article class="{state}">{heading}{badges}<dl>{listed}</dl>{code}{_picture(result, folder)}</article>'


def _badge(rule: str, is_right: bool) -> str:
    state = "right" if is_right else "wrong"
    return f'<span class="badge {state}">{rule}: {state}</span>'


def _picture(result: Result, folder: Path) -> str:
    if result.picture is None or not (folder / result.picture).is_file():
        return ""
    data = base64.b64encode((folder / result.picture).read_bytes()).decode("ascii")
    shown = f'<img loading="lazy" alt="What was found" src="data:image/png;base64,{data}">'
    return f"<details><summary>what was found</summary>{shown}</details>"
