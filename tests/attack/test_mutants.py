"""Mutants of STEP files: each is answered, refused in one line, or crashes in its own process, leaving nothing behind.

`make attack` has 2,000, else there are 25. Those that crashed or were stopped once are kept by their seed.
"""

from __future__ import annotations

import json
import os
from collections import Counter
from concurrent.futures import ThreadPoolExecutor
from pathlib import Path
from tempfile import TemporaryDirectory

import pytest
from tests.attack.mutants import Parent, Verdict, judge, mutant

COUNT = 2000 if os.environ.get("QUERYCAD_ATTACK") == "whole" else 25
KEPT = Path(__file__).with_name("crashing_mutants.json")
KEPT_SEEDS: list[int] = json.loads(KEPT.read_text(encoding="utf-8"))[: max(10, COUNT)]
ENDS = {"answered", "refused", "crashed", "stopped"}
GROWN_BYTES = 64 * 2**20


def judged(seeds: list[int], folder: Path) -> list[Verdict]:
    """What came of the mutants; the parent is looked at before and after, once it has done its first."""

    def one(seed: int) -> Verdict:
        with TemporaryDirectory(dir=folder) as own:
            return judge(seed, Path(own))

    one(0)
    before = Parent.now()
    with ThreadPoolExecutor(os.cpu_count()) as pool:  # each is read in a process of its own
        verdicts = list(pool.map(one, seeds))
    after = Parent.now()
    assert after.resident_bytes - before.resident_bytes < GROWN_BYTES
    assert (after.handles, after.children) == (before.handles, before.children)
    return verdicts


def test_every_mutant_ends_as_it_may(tmp_path: Path) -> None:
    verdicts = judged(list(range(COUNT)), tmp_path)
    assert [each for each in verdicts if each.end not in ENDS] == []
    assert len({each.end for each in verdicts}) >= 2, Counter(each.end for each in verdicts)


def test_mutants_that_crashed_once_end_in_their_process(tmp_path: Path) -> None:
    verdicts = judged(KEPT_SEEDS, tmp_path)
    assert [each for each in verdicts if each.end not in ENDS] == []


@pytest.mark.parametrize("seed", [0, 7, 1999])
def test_a_seed_makes_the_same_mutant(seed: int) -> None:
    assert mutant(seed) == mutant(seed)
    assert mutant(seed)[1] != mutant(seed + 1)[1]


@pytest.mark.parametrize("seed", [32, 251, 391])
def test_geometry_that_contradicts_itself_is_refused_in_one_line(seed: int, tmp_path: Path) -> None:
    """They ended as 'exit code 1': a face whose area is 0, an empty label of the kernel's, a body without an edge."""
    verdict = judge(seed, tmp_path)
    assert verdict.end in ("answered", "refused"), verdict
