"""What is a thread called, and which threads does a plain hole suit?"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass

from querycad_contracts import Answer, AnswerType, Part, PartKind, Unit
from querycad_language.lexicon import lexicon
from querycad_language.readings.question import Question

NEAR = 0.02
"""A modelled thread's diameter and pitch differ from the nominal ones by less than this share; the next size is 12 %
away or more (ISO 261, from M1.6 to M64)."""
SAME = 2e-5
"""A hole has a diameter of the tables when it differs by less than this, metres: they have two decimals of a
millimetre, or four of an inch."""

_LIKELY = ("medium", "close", "loose", None)
"""Fits of holes that screws go through, then taps."""
_FASTENERS = frozenset(("screw", "bolt", "stud", "fastener", "thread"))
_ASKED_WITHIN = 4
"""Words between 'what' and the fastener: 'what size of metric screw'."""


@dataclass(frozen=True, slots=True)
class Suited:
    """What a plain hole may be meant for: a screw that goes through it with a `fit`, or else a thread cut into it."""

    thread: str
    """As drawings have it: 'M6', 'G1/4'."""
    fit: str | None = None
    """'close', 'medium' or 'loose'; None of a hole for a tap."""

    def __str__(self) -> str:
        return f"tap drill {self.thread}" if self.fit is None else f"clears {self.thread} ({self.fit})"


def thread_name(part: Part) -> str | None:
    """What is the modelled thread of a hole or shaft called: 'M6', 'M8x1', '1/4-20', 'G1/4'? None where it is none."""
    if "threaded" not in part.tags or part.pitch is None or part.diameter is None:
        return None
    drawn = "core" if part.kind == "hole" else "nominal"
    found: list[tuple[float, str]] = []
    for name, holes in lexicon().threads.items():
        if "pitch" not in holes:
            continue
        off, off_pitch = abs(part.diameter - holes[drawn]), abs(part.pitch - holes["pitch"])
        if off < NEAR * holes["nominal"] and off_pitch < 2 * NEAR * holes["pitch"]:
            found.append((off / holes["nominal"] + off_pitch / holes["pitch"], name))
    return _written(min(found, key=lambda one: (round(one[0], 9), len(one[1])))[1]) if found else None


def suits(part: Part) -> tuple[Suited, ...]:
    """Which threads may a plain round hole be meant for: 'tap drill M6', 'clears M5 (medium)', 'tap drill G1/4'?

    By its diameter alone, after ISO 2306, ISO 273, ASME B1.1, ASME B18.2.8, ISO 228-1 and ASME B1.20.1, without metric
    fine pitches: a hole of another purpose may have it, too.
    """
    if part.kind != "hole" or part.diameter is None or "threaded" in part.tags:
        return ()
    found = []
    for name, holes in lexicon().threads.items():
        if name.startswith("m") and "x" in name:
            continue
        if abs(part.diameter - holes["tap drill"]) < SAME:
            found.append(Suited(_written(name)))
        screw = _written(name).partition("-")[0]
        fits = (fit for fit in ("close", "medium", "loose") if fit in holes)
        found += [Suited(screw, fit) for fit in fits if abs(part.diameter - holes[fit]) < SAME]
    return tuple(dict.fromkeys(found))


def asks_for_screw(question: Question) -> bool:
    """Does the question ask which screw fits: 'what bolt fits the holes', 'which screw are the holes made for'?"""
    text = question.text
    asks = {at + i for at in text.at_words("what", "which") for i in range(1, _ASKED_WITHIN + 1)}
    named = any(mention.part.noun in _FASTENERS and mention.head in asks for mention in question.parts)
    return named and bool(text.at_phrases("fits"))


def with_screw(answer: Answer, parts: Sequence[Part]) -> Answer:
    """The answer by the threads that holes of this diameter are modelled with, or suit; as it is where there is none.

    A clearance comes before a tap drill, medium before close and loose, metric before inch.
    """
    holes = [part for part in parts if part.kind is PartKind.HOLE]
    if answer.type not in (AnswerType.LENGTH, AnswerType.LENGTHS) or not holes or len(holes) < len(parts):
        return answer
    told = [(name, "has that thread") if (name := thread_name(part)) else _best(suits(part)) for part in holes]
    names = list(dict.fromkeys(name for name, _ in told))
    if not all(names):
        return answer
    text = f"{', '.join(names)} ({answer.text}: {', '.join(dict.fromkeys(why for _, why in told))})"
    one = len(names) == 1
    value = names[0] if one else names
    return Answer(value=value, type=AnswerType.TEXT if one else AnswerType.TEXTS, unit=Unit.NONE, text=text)


def _best(suited: Sequence[Suited]) -> tuple[str, str]:
    """The likeliest of what a hole suits, as a name and in words; nothing where it suits nothing."""
    likely = min(suited, key=lambda one: (not one.thread.startswith("M"), _LIKELY.index(one.fit)), default=None)
    return (likely.thread, str(likely)) if likely is not None else ("", "")


def _written(name: str) -> str:
    """A thread as drawings have it: 'M8x1', '#10-32', '1/4 NPT'."""
    if name.endswith("npt"):
        return f"{name.removesuffix('npt')} NPT"
    if name[0] in "mg":
        return name[0].upper() + name[1:]
    return f"#{name}" if name.partition("-")[0].isdecimal() else name
