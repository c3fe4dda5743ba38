"""How well is answered what needs a conversation, a selection, printed ids, a unit or a table?

`python -m benchmark.talks [HAND …]` asks all questions of the JSON files beside it, in process and without a language
model, and prints how many of each topic and hand are right, and how many are wrong and sure; `--wrong` prints those
that are not right too. README.md tells of the hands and the types of truths. Run it in the repository's root.
"""

from __future__ import annotations

import argparse
import importlib
import json
import math
import re
import sys
from collections import Counter
from collections.abc import Iterator, Sequence
from dataclasses import dataclass
from functools import cache
from pathlib import Path
from typing import Any

import querycad
from benchmark.scoring.own_models import own_models
from benchmark.understanding.cross_validation import SURE
from benchmark.understanding.data import Question, is_right, model_file
from querycad_contracts import PartKind, Status

FOLDER = Path(__file__).parent
_SI = {"length": 1e-3, "lengths": 1e-3, "point": 1e-3, "size": 1e-3, "area": 1e-6, "volume": 1e-9}
_NUMBER = re.compile(r"(?<![\w.])[ØRCM]?(\d+(?:\.\d+)?)")


@dataclass(frozen=True, slots=True)
class Talk:
    """One question with what stands around it, and its truth in SI units."""

    hand: str
    topic: str
    model: str
    question: str
    type: str
    truth: Any
    before: tuple[str, ...] = ()
    select: tuple[str, ...] = ()
    seen: dict[str, tuple[float, float]] | None = None
    """Where the writer saw the parts of printed ids: x and y of their middles, millimetres."""
    says: tuple[str, ...] = ()
    """What the text says; of a table its kind, and the names of the columns that are compared."""


@dataclass(frozen=True, slots=True)
class Outcome:
    """What came of one: is it right, is it told as sure, and what was said?"""

    talk: Talk
    right: bool
    sure: bool
    said: str


def talks(hands: Sequence[str] = ()) -> Iterator[Talk]:
    """All questions, or those of some hands. Their truths are computed from the dimensions of the models' scripts."""
    for path in sorted(FOLDER.glob("*.json")):
        data = json.loads(path.read_text(encoding="utf-8"))
        if hands and data["hand"] not in hands:
            continue
        for item in data["items"]:
            lists = {key: tuple(item[key]) for key in ("before", "select", "says") if key in item}
            yield Talk(data["hand"], **item | lists | {"truth": _truth(item)})


def _truth(item: dict[str, Any]) -> Any:
    truth = eval(item["truth"], {"p": _dimensions(item["model"]), "pi": math.pi})  # noqa: S307 - text of this repository
    scale = _SI.get(item["type"], 1)
    if item["type"] in _SI:
        return [value * scale for value in truth] if isinstance(truth, list | tuple) else truth * scale
    return list(truth) if isinstance(truth, tuple) else truth


@cache
def _dimensions(model: str) -> Any:
    """The dimensions in a model's script: its dataclass `P`, or the one an example is called after."""
    name = model.removeprefix("own:")
    if model_file(model).parent.name != "examples":
        return importlib.import_module(f"benchmark.models.build_{name}").P()
    script = importlib.import_module(f"build_{name}")
    return getattr(script, name.title().replace("_", ""))()


def is_stale(talk: Talk, model: querycad.Model) -> bool:
    """Has a printed id moved to another part since the question was written?"""
    for name, at in (talk.seen or {}).items():
        center = model.part(name).center
        if math.dist(center[:2], (at[0] * 1e-3, at[1] * 1e-3)) > 1e-4:
            return True
    return False


def ask(talk: Talk, model: querycad.Model) -> Outcome:
    """What comes of it?"""
    if talk.type == "table":
        kind, *names = talk.says
        kind, _, grouped = kind.partition(" ")
        table = model.table(kind, bool(grouped) or (None if kind != "holes" else False))
        places = [[column.name for column in table.columns].index(name) for name in names]
        rows = [[row[place] for place in places] for row in table.rows]
        return Outcome(talk, _same_rows(rows, talk.truth), True, str(rows))
    reply = model.ask(talk.question, context=talk.before, select=talk.select)
    sure = reply.status is Status.ANSWERED and (reply.confidence or 0) >= SURE
    if talk.type == "declined":
        return Outcome(talk, reply.answer is None, sure, reply.text)
    right = reply.answer is not None and _is_right(talk, reply, model)
    right = right and (talk.type == "callout" or all(each in reply.text for each in talk.says))
    return Outcome(talk, right, sure, f"{reply.status.value} {reply.confidence or 0:.2f}: {reply.text[:120]}")


def _is_right(talk: Talk, reply: querycad.Reply, model: querycad.Model) -> bool:
    ids = {part.id for part in reply.parts}
    match talk.type:
        case "callout":
            said = set(map(float, _NUMBER.findall(reply.text)))
            return all(v in reply.text if isinstance(v, str) else v in said for v in talk.truth)
        case "ids":
            return ids == set(talk.truth)
        case "names":
            bodies = {part.label for part in model.parts if part.kind is PartKind.BODY and part.id in ids}
            values = reply.value if isinstance(reply.value, list) else [reply.value]
            named = {value for value in values if isinstance(value, str)}
            return (named or bodies) == set(talk.truth)
        case kind:
            return is_right(reply.value, Question(talk.model, Path(), talk.hand, talk.question, talk.truth, kind))


def _same_rows(rows: list[list[Any]], truth: list[tuple[Any, ...]]) -> bool:
    """The same rows, in any order? Lengths of a truth are millimetres, of a table metres."""
    said = Counter(tuple(v if isinstance(v, str | int) else round(v * 1e3, 2) for v in row) for row in rows)
    return said == Counter(tuple(v if isinstance(v, str) else round(v, 2) for v in row) for row in truth)


def main(argv: Sequence[str] | None = None) -> int:
    """Asks and prints; returns the exit code."""
    parser = argparse.ArgumentParser(prog="python -m benchmark.talks", description=__doc__.splitlines()[0])
    parser.add_argument("hands", nargs="*", metavar="HAND", help="detailer, fitter, estimator; all where none is named")
    parser.add_argument("--wrong", action="store_true", help="print what is not right, too")
    options = parser.parse_args(argv)
    sys.path.insert(0, "examples")
    own_models(jobs=1)
    opened: dict[str, querycad.Model] = {}
    outcomes: list[Outcome] = []
    for talk in talks(options.hands):
        model = opened.setdefault(talk.model, querycad.open(model_file(talk.model)))
        if is_stale(talk, model):
            print(f"renumbered: {talk.model}: {talk.question}")
        outcomes.append(ask(talk, model))
    for title, name in (("hand", "hand"), ("topic", "topic")):
        print(f"| {title} | asked | right | wrong and sure |\n|---|--:|--:|--:|")
        groups = dict.fromkeys(getattr(one.talk, name) for one in outcomes)
        for group in [*groups, "all"]:
            of = [one for one in outcomes if group in ("all", getattr(one.talk, name))]
            print(f"| {group} | {len(of)} | {sum(o.right for o in of)} | {sum(o.sure and not o.right for o in of)} |")
        print()
    for one in outcomes if options.wrong else ():
        if not one.right:
            before = f" (after {one.talk.before or one.talk.select})" if one.talk.before or one.talk.select else ""
            print(f"{one.talk.hand} {one.talk.model}: {one.talk.question}{before}\n  {one.talk.truth}\n  {one.said}")
    return 0


if __name__ == "__main__":
    raise SystemExit(main())
