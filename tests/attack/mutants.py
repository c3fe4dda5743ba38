"""Mutants of STEP files by seed, and how each ends: `python -m tests.attack.mutants --count 2000`.

A mutant is one of the examples with one to three of its entities, references, numbers, counts, names or bytes changed
as `MUTATIONS` say. The same seed makes the same mutant.
"""

from __future__ import annotations

import argparse
import gc
import json
import random
import re
import sys
import tempfile
import time
from collections import Counter
from collections.abc import Callable
from dataclasses import asdict, dataclass
from functools import cache
from pathlib import Path
from typing import Any

import psutil

from querycad_segworker.errors import FileProblem, KernelDied
from querycad_segworker.ingest import IngestLimits, ingest
from querycad_segworker.local import LocalPartFinder
from querycad_segworker.model import ModelStore
from querycad_segworker.summary import summary

BASES = tuple(Path("examples") / f"{name}.step" for name in ("flange", "bracket", "sheet_metal", "bearing_assembly"))
LIMITS = IngestLimits(duration_s=15.0, memory_bytes=3 * 2**30)
"""A mutant takes 0.2 s of processor time; one of a hundred hangs, and would take much of the time."""
LINE = 400
"""What a refusal may be long: one line for a user."""
_STATEMENT = re.compile(r"(#\d+) = (.*?);\n", re.DOTALL)
_REFERENCE = re.compile(r"#\d+")
_NUMBER = re.compile(r"(?<![#\w'.])-?\d+\.\d*(?:E[+-]?\d+)?")
_INTEGER = re.compile(r"(?<=[(,])\d{1,3}(?=[,)])")

Rng = random.Random


@dataclass(slots=True)
class Text:
    """A file in pieces: what stands before its entities, the entities as (id, what it is), what stands after."""

    head: str
    entities: list[tuple[str, str]]
    tail: str

    def written(self) -> str:
        """The file."""
        return self.head + "".join(f"{name} = {body};\n" for name, body in self.entities) + self.tail


@cache
def _base(path: Path) -> tuple[str, tuple[tuple[str, str], ...], str]:
    text = path.read_text(encoding="utf-8")
    found = list(_STATEMENT.finditer(text))
    return text[: found[0].start()], tuple((each[1], each[2]) for each in found), text[found[-1].end() :]


def _change(text: Text, rng: Rng, pattern: re.Pattern[str], new: Callable[[str], str]) -> None:
    """One match of the pattern, in some entity that has one, becomes something else."""
    order = list(range(len(text.entities)))
    rng.shuffle(order)
    for at in order:
        name, body = text.entities[at]
        if found := list(pattern.finditer(body)):
            one = rng.choice(found)
            text.entities[at] = (name, body[: one.start()] + new(one[0]) + body[one.end() :])
            return


def _reference(text: Text, rng: Rng) -> None:
    _change(text, rng, _REFERENCE, lambda _: rng.choice(text.entities)[0])


def _lost_reference(text: Text, rng: Rng) -> None:
    lost = rng.choice(("#0", "#999999", "#99999999999999999999", "#" + "7" * 4000, "$", "*", "()", "''", "1.", "#-1"))
    _change(text, rng, _REFERENCE, lambda _: lost)


def _cycle(text: Text, rng: Rng) -> None:
    at = rng.randrange(len(text.entities))
    name, body = text.entities[at]
    text.entities[at] = (name, _REFERENCE.sub(lambda each: name if rng.random() < 0.5 else each[0], body))


def _long_cycle(text: Text, rng: Rng) -> None:
    """What is referred to refers back."""
    name, body = rng.choice(text.entities)
    asked = _REFERENCE.findall(body)
    for at, (other, its) in enumerate(text.entities):
        if other in asked:
            text.entities[at] = (other, _REFERENCE.sub(name, its, count=1))


def _number(text: Text, rng: Rng) -> None:
    said = (
        "0.", "-0.", "1.E-300", "1.E12", "-1.E12", "1.E99", "NaN", "INF", "1.E300", "-1.E400", "1.E", "1..2", "1.E+-3",
        "9" * 300 + ".", "0." + "0" * 300 + "1", "1", "$", "''", ".T.", "1,5", "0x10",
    )  # fmt: skip
    chosen = rng.choice(said)
    _change(text, rng, _NUMBER, lambda _: chosen)


def _nudge(text: Text, rng: Rng) -> None:
    factor = rng.choice((-1.0, 1 + 1e-7, 1 + 1e-3, 2.0, 1e3, 1e-3, 1e6))
    _change(text, rng, _NUMBER, lambda each: repr(float(each) * factor).replace("e", "E"))


def _count(text: Text, rng: Rng) -> None:
    many = rng.choice(("0", "-1", "26", "1000", "2147483647", "4294967296", "9" * 30))
    _change(text, rng, _INTEGER, lambda _: many)


def _long_list(text: Text, rng: Rng) -> None:
    times = rng.choice((100, 10_000, 100_000))
    _change(text, rng, re.compile(r"#\d+(?=,#)|-?\d+\.(?=,)"), lambda each: ",".join([each] * times))


def _nesting(text: Text, rng: Rng) -> None:
    deep = rng.choice((10, 1_000, 100_000))
    closed = ")" * rng.choice((deep, 0, deep + 1))
    _change(text, rng, _REFERENCE, lambda each: "(" * deep + each + closed)


def _duplicate(text: Text, rng: Rng) -> None:
    at = rng.randrange(len(text.entities))
    name, _ = text.entities[at]
    text.entities.insert(rng.randrange(len(text.entities)), (name, rng.choice(text.entities)[1]))


def _copies(text: Text, rng: Rng) -> None:
    text.entities += [rng.choice(text.entities)] * rng.choice((10, 1_000, 30_000))


def _drop(text: Text, rng: Rng) -> None:
    for _ in range(rng.choice((1, 1, 5, len(text.entities) // 4))):
        text.entities.pop(rng.randrange(len(text.entities)))


def _keyword(text: Text, rng: Rng) -> None:
    other = rng.choice(text.entities)[1].split("(", 1)[0]
    new = rng.choice((other, other, "NOTHING_KNOWN", "", "A" * 10_000))
    _change(text, rng, re.compile(r"^\w+"), lambda _: new)


def _swap(text: Text, rng: Rng) -> None:
    one, two = rng.randrange(len(text.entities)), rng.randrange(len(text.entities))
    (first, its), (second, others) = text.entities[one], text.entities[two]
    text.entities[one], text.entities[two] = (first, others), (second, its)


def _argument(text: Text, rng: Rng) -> None:
    new = rng.choice(("", ",$", ",*", ",1.,2.,3.", ",()", ",'',''", ",.T.,.F.", ",(((#1)))"))
    _change(text, rng, re.compile(r",[^,()']+"), lambda _: new)


def _flag(text: Text, rng: Rng) -> None:
    new = rng.choice((".T.", ".F.", ".U.", ".X.", "$", ".MILLI.", ".METRE."))
    _change(text, rng, re.compile(r"\.[A-Z_]+\."), lambda _: new)


def _name(text: Text, rng: Rng) -> None:
    new = rng.choice((
        "'\\X2\\D800\\X0\\'", "'\\X4\\FFFFFFFF\\X0\\'", "'\\X2\\00'", "'\\X\\1B[2J'", "'\\S\\'", "'\\P'",
        "'" + "ü" * 999 + "'", "'../../../../etc/passwd'", "'\x00'", "'\x1b]0;x\x07'", "'\ufeff\u202e'", "'", "''''",
        "'" + "x" * 10**6 + "'",
    ))  # fmt: skip
    _change(text, rng, re.compile(r"'[^']*'"), lambda _: new)


def _header(text: Text, rng: Rng) -> None:
    old, new = rng.choice((
        ("AUTOMOTIVE_DESIGN", "CONFIG_CONTROL_DESIGN"), ("AUTOMOTIVE_DESIGN", "IFC4"), ("FILE_SCHEMA", "FILE_SCHEMAS"),
        ("ENDSEC;\nDATA;", "DATA;"), ("DATA;", "DATA;DATA;"), ("'2;1'", "'9;9'"), ("HEADER;", ""),
        ("DATA;", "DATA('a',('b'));"),
    ))  # fmt: skip
    text.head = text.head.replace(old, new)


def _tail(text: Text, rng: Rng) -> None:
    text.tail = rng.choice(
        ("END-ISO-10303-21;", text.tail * 3, text.tail + text.head, "ENDSEC;END-ISO-10303-21;" + "x" * 9999)
    )


def _truncate(text: Text, rng: Rng) -> None:
    del text.entities[rng.randrange(1, len(text.entities)) :]


def _unit(text: Text, rng: Rng) -> None:
    for at, (name, body) in enumerate(text.entities):
        if "SI_UNIT" in body:
            text.entities[at] = (name, body.replace(".MILLI.", rng.choice(("$", ".KILO.", ".EXA.", ".ATTO.", ".X."))))


MUTATIONS: tuple[Callable[[Text, Rng], None], ...] = (
    _reference, _reference, _lost_reference, _cycle, _long_cycle, _number, _number, _nudge, _nudge, _count, _long_list,
    _nesting, _duplicate, _copies, _drop, _keyword, _swap, _argument, _flag, _name, _header, _tail, _truncate, _unit,
)  # fmt: skip


def mutant(seed: int) -> tuple[str, bytes]:
    """What is done to which file, and what comes of it."""
    rng = Rng(seed)
    path = rng.choice(BASES)
    head, entities, tail = _base(path)
    text = Text(head, list(entities), tail)
    done = rng.choices(MUTATIONS, k=rng.choice((1, 1, 2, 3)))
    for change in done:
        if text.entities:
            change(text, rng)
    data = bytearray(text.written().encode("utf-8", "surrogatepass"))
    if rng.random() < 0.1:
        for _ in range(rng.choice((1, 20))):
            data[rng.randrange(len(data))] = rng.randrange(256)
        return f"{path.stem}: {' '.join(each.__name__ for each in done)} bytes", bytes(data)
    return f"{path.stem}: {' '.join(each.__name__ for each in done)}", bytes(data)


@dataclass(frozen=True, slots=True)
class Verdict:
    """How a mutant ended."""

    seed: int
    done: str
    end: str
    """'answered', 'refused', 'crashed' in its child, 'stopped' at a limit of time or memory, or what must not be."""
    said: str
    seconds: float


def judge(seed: int, folder: Path) -> Verdict:
    """Reads the mutant and asks for what every question needs. What must not be is named in `end`."""
    done, data = mutant(seed)
    path = folder / "mutant.step"
    path.write_bytes(data)
    start = time.monotonic()
    store = ModelStore(folder / "store")
    said = ""
    try:
        model = LocalPartFinder(ingest(path, store, LIMITS))
        told = (
            summary(model.model).model_dump_json() + model.artefacts.model.read_text() + str(model.find_parts("holes"))
        )
        bad = re.search(r"\b(?:NaN|nan|Infinity|inf)\b|[\x00-\x08\x0b-\x1f\x7f]", told)
        end = f"ANSWERED WITH {bad[0]!r}" if bad else "answered"
    except KernelDied as problem:
        said = str(problem)
        end = "crashed" if "crashed" in said or "gave up" in said else "stopped"
    except FileProblem as problem:
        end, said = "refused", str(problem)
    except Exception as error:
        end, said = f"RAISED {type(error).__name__}", str(error)
    if len(said) > LINE or any(ord(char) < 32 for char in said):
        end = "SAID TOO MUCH"
    if left := [each.name for each in (folder / "store").glob("ingest-*")]:
        end = f"LEFT {left}"
    return Verdict(seed, done, end, said[:LINE], round(time.monotonic() - start, 2))


@dataclass(frozen=True, slots=True)
class Parent:
    """What the process that has files read holds."""

    resident_bytes: int
    handles: int
    children: int

    @classmethod
    def now(cls) -> Parent:
        """As it is after a look for garbage."""
        gc.collect()
        process = psutil.Process()
        children = [each for each in process.children(recursive=True) if each.status() != psutil.STATUS_ZOMBIE]
        return cls(process.memory_info().rss, process.num_fds(), len(children))


def main() -> None:
    """Judges many mutants and writes what came of them."""
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("--count", type=int, default=2000)
    parser.add_argument("--first", type=int, default=0, help="the first seed")
    parser.add_argument("--seconds", type=float, default=1e9, help="no mutant is begun after so many")
    parser.add_argument("--out", type=Path, default=Path("build/mutants.json"))
    asked = parser.parse_args()
    verdicts: list[Verdict] = []
    parents: list[Parent] = [Parent.now()]
    start = time.monotonic()
    for seed in range(asked.first, asked.first + asked.count):
        if time.monotonic() - start > asked.seconds:
            break
        with tempfile.TemporaryDirectory() as folder:
            verdicts.append(judge(seed, Path(folder)))
        if len(verdicts) % 20 == 0 or seed == asked.first + asked.count - 1:
            parents.append(Parent.now())
            report = _report(verdicts, parents, time.monotonic() - start)
            asked.out.parent.mkdir(parents=True, exist_ok=True)
            asked.out.write_text(json.dumps(report, indent=1), encoding="utf-8")
            sys.stdout.write(f"{report['minutes']} min: {len(verdicts)} mutants, {dict(report['ends'])}\n")


def _report(verdicts: list[Verdict], parents: list[Parent], seconds: float) -> dict[str, Any]:
    """What came of them. The parent's memory is told from the second time on: the first read warms it up."""
    refusals = Counter(re.sub(r"[#\d.]+", "#", each.said)[:80] for each in verdicts if each.end == "refused")
    return {
        "count": len(verdicts),
        "minutes": round(seconds / 60, 1),
        "ends": Counter(each.end for each in verdicts),
        "slowest_s": max(each.seconds for each in verdicts),
        "parent": [asdict(parents[1]), asdict(parents[-1])],
        "not answered or refused": [asdict(each) for each in verdicts if each.end not in ("answered", "refused")],
        "refusals": refusals.most_common(),
    }


if __name__ == "__main__":
    main()
