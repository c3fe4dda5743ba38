"""Which statements of the readers change no right answer? What is needless goes.

`python -m benchmark.needless OUT.txt [--at-most 1] [--only readings/]` asks all collected questions once, and keeps the
reading that is right and comes first; where the right answer is to refuse, the one that comes first. Then each
statement of `querycad_language` is left out in turn, and the questions that reach it are read again: those whose
reading is gone are lost. Statements that lose few are written to OUT.txt, with how many they lose of how many, and one.
Some minutes to collect, half an hour to leave out. Run it in the repository's root.

Ranking is not repeated: a guard that only keeps wrong readings out seems needless here. Cross-validate before it goes.
"""

from __future__ import annotations

import argparse
import ast
import functools
import importlib
import signal
import sys
import types
from collections import defaultdict
from collections.abc import Iterator, Sequence
from concurrent.futures import ProcessPoolExecutor
from contextlib import contextmanager
from dataclasses import dataclass
from itertools import groupby
from pathlib import Path
from typing import Any, cast

import querycad_language
from benchmark.scoring.own_models import own_models
from benchmark.understanding.data import MISSING, Question, asked, is_right, questions
from querycad_answering.affinity import Affinity
from querycad_answering.candidates import Candidate, candidates, with_value
from querycad_contracts import RunStatus
from querycad_language.forms import Form
from querycad_language.readings import read
from querycad_language.readings.reader import Reader
from querycad_sandbox import Sandbox
from querycad_segworker.errors import FileProblem
from querycad_segworker.grounding.names import vocabulary
from querycad_segworker.ingest import ingest
from querycad_segworker.local import LocalPartFinder
from querycad_segworker.model import ModelStore

ROOT = Path(querycad_language.__file__).parent
STORE = Path("build/understanding")
MOST_REACHED = 1500
"""A statement that more questions reach is needed."""
PATIENCE_S = 3
"""A loop without its end is lost after so long."""


@dataclass(frozen=True, slots=True)
class Asked:
    """A question that is answered rightly, the words of its file's names, and the form that does it."""

    question: str
    names: tuple[str, ...]
    form: Form


@dataclass(frozen=True, slots=True)
class Statement:
    """One statement of a function: where it stands in its module, and how often it is passed by no question."""

    module: str
    function: tuple[str, ...]
    first: int
    last: int
    reached: int
    """The line that is reached when it is carried out."""
    number: int


def _winners(group: Sequence[Question]) -> list[Asked]:
    """The questions about one model that are answered rightly."""
    try:
        finder = LocalPartFinder(ingest(group[0].file, ModelStore(STORE)))
    except FileProblem:
        return []
    names = tuple(sorted(vocabulary(finder.model.parts)))
    whole = next(part for part in finder.model.parts if part.kind == "model")
    found = []
    with Sandbox(workers=1) as sandbox:
        for one in group:
            done: list[tuple[Candidate, bool]] = []
            reader = Reader(one.question, names)
            affinity = Affinity(reader.text.words, whole)
            for candidate in candidates(reader.readings, finder.ground, whole, affinity):
                expects = candidate.written.expects
                try:
                    outcome = sandbox.run(candidate.written.code, finder, expects=expects, check=False)
                except FileProblem:  # a measurement that the kernel could not make
                    continue
                if outcome.status is RunStatus.OK:
                    value = outcome.value
                    done.append((with_value(candidate, value, whole.extents), is_right(value, one)))
            best = max(done, key=lambda pair: pair[0].score, default=None)
            if best is not None and (best[1] or one.kind == MISSING):
                found.append(Asked(one.question, names, best[0].reading.form))
    return found


def collected(jobs: int) -> list[Asked]:
    """All of the collected and specified questions that are answered rightly now."""
    own_models(jobs)
    own_models(jobs, last_look=True)
    data = [*questions(), *(one for file in sorted(Path("benchmark/specified").glob("*.json")) for one in asked(file))]
    data.sort(key=lambda one: str(one.file))
    groups = [list(group) for _, group in groupby(data, key=lambda one: str(one.file))]
    with ProcessPoolExecutor(jobs) as pool:
        return [one for found in pool.map(_winners, groups) for one in found]


def reached(all_asked: Sequence[Asked]) -> dict[tuple[str, int], set[int]]:
    """Which questions, by their number, reach which line of which file?"""
    found: dict[tuple[str, int], set[int]] = defaultdict(set)
    number, inside = 0, str(ROOT)

    def trace(frame: types.FrameType, event: str, _: Any) -> Any:
        name = frame.f_code.co_filename
        if not name.startswith(inside):
            return None
        if event == "line":
            found[name, frame.f_lineno].add(number)
        return trace

    sys.settrace(trace)
    try:
        for number, one in enumerate(all_asked):  # noqa: B007 - the tracer reads it
            read(one.question, one.names)
    finally:
        sys.settrace(None)
    return found


def statements(module: Path) -> Iterator[Statement]:
    """The statements that stand in functions, from top to bottom: expressions, sums, loops, cases, and what ifs do."""
    tree = ast.parse(module.read_text(encoding="utf-8"))
    for number, (holder, index, function) in enumerate(_places(tree, ())):
        node = holder[index]
        first = node.pattern.lineno if isinstance(node, ast.match_case) else node.lineno
        body = node.body if isinstance(node, ast.If | ast.match_case) else [node]
        yield Statement(str(module), function, first, body[-1].end_lineno or first, body[0].lineno, number)


def _places(node: ast.AST, function: tuple[str, ...]) -> Iterator[tuple[list[Any], int, tuple[str, ...]]]:
    for _, block in ast.iter_fields(node):
        for index, child in enumerate(block if isinstance(block, list) else ()):
            if isinstance(child, ast.FunctionDef | ast.ClassDef):
                yield from _places(child, (*function, child.name))
                continue
            told = isinstance(child, ast.Expr) and isinstance(child.value, ast.Constant)
            if (
                function
                and not told
                and isinstance(child, ast.If | ast.Expr | ast.AugAssign | ast.For | ast.match_case)
            ):
                yield block, index, function
            if isinstance(child, ast.stmt | ast.match_case):
                yield from _places(child, function)


@contextmanager
def without(one: Statement) -> Iterator[bool]:
    """The module's function without the statement, for a while; False where it cannot be left out."""
    path = Path(one.module)
    tree = ast.parse(path.read_text(encoding="utf-8"))
    holder, index, _ = next(place for i, place in enumerate(_places(tree, ())) if i == one.number)
    node = holder[index]
    if isinstance(node, ast.If) and node.orelse:
        node.test = ast.copy_location(ast.Constant(value=False), node.test)
    elif isinstance(node, ast.match_case):
        node.body = [ast.copy_location(ast.Pass(), node.body[0])]
    else:
        holder[index] = ast.copy_location(ast.Pass(), node)
    outer = cast("ast.FunctionDef", _node(tree, one.function))
    outer.body.insert(0, ast.parse("if False:\n    yield").body[0] if _yields(path, one.function) else ast.Pass())
    ast.fix_missing_locations(tree)
    name = f"querycad_language.{'.'.join(path.relative_to(ROOT).with_suffix('').parts)}"
    function, depth = _function(importlib.import_module(name), one.function)
    code = None if function is None else _code(compile(tree, str(path), "exec"), one.function[:depth])
    if function is None or code is None or code.co_freevars != function.__code__.co_freevars:
        yield False
        return
    kept = function.__code__
    function.__code__ = code
    try:
        yield True
    finally:
        function.__code__ = kept


def _node(tree: ast.AST, names: tuple[str, ...]) -> ast.AST:
    """The class or function of these names, one within the other."""
    for name in names:
        inner = (one for one in ast.walk(tree) if isinstance(one, ast.FunctionDef | ast.ClassDef) and one.name == name)
        tree = next(inner)
    return tree


def _yields(path: Path, names: tuple[str, ...]) -> bool:
    """Is the function a generator? Without its last yield it still has to be one."""
    node = _node(ast.parse(path.read_text(encoding="utf-8")), names)
    return any(isinstance(one, ast.Yield | ast.YieldFrom) for one in ast.walk(node))


def _function(module: types.ModuleType, names: tuple[str, ...]) -> tuple[types.FunctionType | None, int]:
    """The function that a statement stands in, or that its own function stands in; how many names lead to it."""
    found: Any = module.__dict__.get(names[0])
    depth = 1
    while isinstance(found, type) and depth < len(names):
        found, depth = found.__dict__.get(names[depth]), depth + 1
    while True:
        if isinstance(found, property):
            found = found.fget
        elif isinstance(found, functools.cached_property):
            found = found.func
        elif hasattr(found, "__wrapped__"):
            found = found.__wrapped__
        else:
            return (found if isinstance(found, types.FunctionType) else None), depth


def _code(code: types.CodeType, names: tuple[str, ...]) -> types.CodeType | None:
    for name in names:
        inner = [one for one in code.co_consts if isinstance(one, types.CodeType) and one.co_name == name]
        if not inner:
            return None
        code = inner[0]
    return code


def lost(one: Statement, all_asked: Sequence[Asked], numbers: Sequence[int], at_most: int) -> list[str] | None:
    """The questions whose reading is gone without the statement; None where it cannot be left out, or many are."""
    found: list[str] = []
    with without(one) as left_out:
        for number in numbers if left_out else ():
            asked_one = all_asked[number]
            signal.setitimer(signal.ITIMER_REAL, PATIENCE_S)
            try:
                there = any(reading.form == asked_one.form for reading in read(asked_one.question, asked_one.names))
            except Exception:  # a program without one of its statements may fail in any way
                there = False
            finally:
                signal.setitimer(signal.ITIMER_REAL, 0)
            found += [] if there else [asked_one.question]
            if len(found) > at_most:
                return None
    return found if left_out else None


def _too_long(*_: object) -> None:
    raise TimeoutError


def main() -> int:
    """Runs the command; returns the exit code."""
    parser = argparse.ArgumentParser(prog="python -m benchmark.needless", description=__doc__)
    parser.add_argument("out", type=Path)
    parser.add_argument("--at-most", type=int, default=1, help="questions that a needless statement may lose")
    parser.add_argument("--only", default="", help="modules whose path holds this")
    parser.add_argument("--jobs", type=int, default=2)
    options = parser.parse_args()
    all_asked = collected(options.jobs)
    lines = reached(all_asked)
    signal.signal(signal.SIGALRM, _too_long)
    print(f"{len(all_asked)} questions")
    with options.out.open("w", encoding="utf-8") as out:
        for module in sorted(path for path in ROOT.rglob("*.py") if options.only in str(path.relative_to(ROOT))):
            for one in statements(module):
                numbers = sorted(lines.get((one.module, one.reached), ()))
                if len(numbers) > MOST_REACHED:
                    continue
                gone = lost(one, all_asked, numbers, options.at_most)
                if gone is not None:
                    where = f"{module.relative_to(ROOT)}:{one.first}-{one.last}"
                    print(
                        f"{len(gone)} of {len(numbers)}", where, ".".join(one.function), *gone[:1], sep="\t", file=out
                    )
    return 0


if __name__ == "__main__":
    raise SystemExit(main())
