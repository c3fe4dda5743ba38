"""Every regular expression of the code, on text that grows: twice the text takes twice the processor time or so."""

from __future__ import annotations

import importlib
import pkgutil
import re
import sys
import time
from collections.abc import Iterable, Iterator
from functools import cache
from typing import Any

import pytest
from tests.attack.test_questions import LEANING, REPEATED

PACKAGES = (
    "querycad_language", "querycad_answering", "querycad_contracts", "querycad_sandbox", "querycad_api",
    "querycad_segworker", "querycad",
)  # fmt: skip
NOT_HERE = ("querycad_segworker.brep", "querycad_sandbox.inside", ".__main__")
"""The kernel's own process imports it; the interpreter does; a command does."""
SIZE = 2000
QUICK_S = 0.004
"""What takes no longer is not looked at twice."""
HOPELESS_S = 0.2
"""What takes longer is not measured with twice the text."""


@cache
def patterns() -> dict[re.Pattern[Any], str]:
    """All that modules hold compiled, and where: alone, or in tuples, lists and dicts."""
    for name in PACKAGES:
        for module in pkgutil.walk_packages(importlib.import_module(name).__path__, f"{name}."):
            if not any(part in module.name for part in NOT_HERE):
                importlib.import_module(module.name)
    ours = [(name, module) for name, module in sys.modules.items() if name.split(".")[0] in PACKAGES]
    return {
        each: f"{name}.{named}" for name, module in ours for named, value in vars(module).items() for each in _in(value)
    }


def _in(value: object) -> Iterator[re.Pattern[Any]]:
    if isinstance(value, re.Pattern):
        yield value
    elif isinstance(value, tuple | list | frozenset | set | dict):
        inner: Iterable[object] = value.values() if isinstance(value, dict) else value
        for each in inner:
            yield from _in(each)


def pieces(pattern: re.Pattern[Any]) -> list[str]:
    """What may hurt it when it is repeated: what hurts others, its own words, and its own signs."""
    source = pattern.pattern if isinstance(pattern.pattern, str) else pattern.pattern.decode("latin-1")
    words = [word + behind for word in re.findall(r"[a-zA-Z]{2,20}", source)[:12] for behind in ("", " ", ", ")]
    signs = [before + sign for sign in {*source} - {*"\\"} for before in ("", "1", "a")]
    return sorted({*REPEATED, *LEANING, *words, *signs})


def seconds(pattern: re.Pattern[Any], piece: str, size: int) -> float:
    """Of processor time, to look for the pattern everywhere in the piece repeated up to this size."""
    text: Any = (piece * (size // len(piece) + 1))[:size] + "!"
    if isinstance(pattern.pattern, bytes):
        text = text.encode("utf-8", "surrogatepass")
    start = time.thread_time()
    for _ in pattern.finditer(text):
        pass
    return time.thread_time() - start


def slow(pattern: re.Pattern[Any]) -> list[str]:
    """Pieces with which twice the text takes thrice the time, or more."""
    return [piece for piece in pieces(pattern) if _grows(pattern, piece)]


def _grows(pattern: re.Pattern[Any], piece: str) -> bool:
    if (once := seconds(pattern, piece, SIZE)) < QUICK_S:
        return False
    if once > HOPELESS_S:
        return True
    small, large = (min(seconds(pattern, piece, size) for _ in range(4)) for size in (SIZE, 2 * SIZE))
    return large > 3 * small + QUICK_S


def test_all_patterns_are_found() -> None:
    assert len(patterns()) > 90
    assert "querycad_answering.addressing._NUMBER" in patterns().values()


def test_a_pattern_with_overlapping_repetition_is_noticed() -> None:
    assert slow(re.compile(r"\s*a?b?c?d?e?x"))


@pytest.mark.parametrize("package", PACKAGES)
def test_no_pattern_takes_more_than_its_share_of_time(package: str) -> None:
    """One took 4 s for 2,000 blanks, four others grew with the square of the text."""
    found = {where: slow(each) for each, where in patterns().items() if where.startswith(f"{package}.")}
    assert {where: said for where, said in found.items() if said} == {}
