from __future__ import annotations

import datetime
import json
from pathlib import Path
from typing import TYPE_CHECKING

import pytest
from benchmark.scoring.floor import Count, falls, read_floor, record, summary
from benchmark.scoring.items import BadBenchmark, read_benchmark
from benchmark.scoring.results import Results
from benchmark.scoring.running import run_benchmark
from benchmark.scoring.systems import Reply, SystemOptions

if TYPE_CHECKING:
    from tests.benchmark.conftest import TableOpener

DAY = datetime.date(2026, 1, 31)


@pytest.fixture
def run(folder: Path, tmp_path: Path, opener: TableOpener) -> Results:
    return run_benchmark(read_benchmark(folder), SystemOptions(), tmp_path / "out", opener=opener)


def count(strict: int, tolerant: int) -> Count:
    return Count(questions=2, strict=strict, tolerant=tolerant)


@pytest.mark.parametrize(
    ("strict", "tolerant", "falls_below"), [(1, 1, False), (0, 1, False), (2, 1, True), (1, 2, True)]
)
def test_fewer_right_answers_by_either_rule_are_a_fall(
    run: Results, strict: int, tolerant: int, falls_below: bool
) -> None:
    found = falls([run], {"tiny": {"abc": count(strict, tolerant)}})
    assert bool(found) is falls_below
    if falls_below:
        assert str(found[0]).startswith("tiny, abc: 1 strict and 1 tolerant of 2; the floor is")


def test_a_set_that_has_vanished_is_a_fall_but_a_benchmark_not_run_is_none(run: Results) -> None:
    assert [fall.set for fall in falls([run], {"tiny": {"lost": count(1, 1)}})] == ["lost"]
    assert falls([run], {"other": {"abc": count(1, 1)}}) == ()


def test_a_recorded_run_becomes_floor_trend_and_summary(run: Results, tmp_path: Path) -> None:
    written = record([run], tmp_path, DAY)
    assert [path.name for path in written] == ["trend.jsonl", "results-2026-01-31.json", "floor.json"]
    assert read_floor(tmp_path / "floor.json") == {"tiny": {"abc": count(1, 1), "shop": count(0, 1)}}
    kept = json.loads((tmp_path / "results-2026-01-31.json").read_text(encoding="utf-8"))
    assert kept["wrong"] == {"tiny": ["abc/001/1", "shop/bracket/1"]}
    assert kept["failures"] == {"tiny": {"masks": 2}}


def test_the_trend_grows_by_a_line_a_record(run: Results, tmp_path: Path) -> None:
    record([run], tmp_path, DAY)
    record([run], tmp_path, DAY)
    lines = (tmp_path / "trend.jsonl").read_text(encoding="utf-8").splitlines()
    assert [json.loads(line)["date"] for line in lines] == ["2026-01-31", "2026-01-31"]


def test_the_floor_rises_and_never_sinks(folder: Path, run: Results, tmp_path: Path, opener: TableOpener) -> None:
    record([run], tmp_path, DAY)
    opener.table.update({"How many holes?": Reply(4), "Which radii?": Reply([0.0025]), "How wide?": Reply(0.3)})
    other = run_benchmark(read_benchmark(folder), SystemOptions(), tmp_path / "other", opener=opener)
    record([other], tmp_path, DAY)
    assert read_floor(tmp_path / "floor.json") == {"tiny": {"abc": count(1, 1), "shop": count(0, 1)}}


def test_the_summary_counts_by_set(run: Results) -> None:
    found = summary([run], DAY)
    assert (found.codegen, found.scores) == ("parser", {"tiny": {"abc": count(1, 1), "shop": count(0, 1)}})


def test_no_floor_is_recorded_without_a_file_and_a_broken_one_is_refused(tmp_path: Path) -> None:
    assert read_floor(tmp_path / "floor.json") == {}
    (tmp_path / "floor.json").write_text('{"tiny": 3}', encoding="utf-8")
    with pytest.raises(BadBenchmark, match=r"floor\.json"):
        read_floor(tmp_path / "floor.json")
