from __future__ import annotations

import io
import json
from pathlib import Path
from typing import TYPE_CHECKING

import pytest
from benchmark.scoring.answers import score_answers
from benchmark.scoring.compare import compare, print_comparison, side_by_side
from benchmark.scoring.failures import FailureClass
from benchmark.scoring.items import BadBenchmark, read_benchmark
from benchmark.scoring.report import write_report
from benchmark.scoring.results import Results
from benchmark.scoring.running import run_benchmark
from benchmark.scoring.systems import Reply, SystemOptions
from benchmark.scoring.tables import print_results
from rich.console import Console

if TYPE_CHECKING:
    from tests.benchmark.conftest import TableOpener


@pytest.fixture
def before(folder: Path, tmp_path: Path, opener: TableOpener) -> Results:
    return run_benchmark(read_benchmark(folder), SystemOptions(), tmp_path / "before", opener=opener)


@pytest.fixture
def after(before: Results, folder: Path, tmp_path: Path, opener: TableOpener) -> Results:
    opener.table.update({"How many holes?": Reply(4), "Which radii?": Reply([0.0025]), "How wide?": Reply(0.14662)})
    return run_benchmark(read_benchmark(folder), SystemOptions(), tmp_path / "after", opener=opener)


def printed(show: object) -> str:
    stream = io.StringIO()
    Console(file=stream, width=160).print(show)
    return stream.getvalue()


def test_fixed_and_broken_answers_are_told_apart(before: Results, after: Results) -> None:
    found = compare(before, after)
    assert [change.after.key for change in found.fixed] == ["abc/001/1"]
    assert [change.after.key for change in found.broken] == ["abc/001/0"]
    assert [change.after.key for change in found.strict_fixed] == ["shop/bracket/0"]
    assert found.strict_broken == ()


def test_a_comparison_the_other_way_round_swaps_fixed_and_broken(before: Results, after: Results) -> None:
    there, back = compare(before, after), compare(after, before)
    assert [c.after.key for c in there.fixed] == [c.before.key for c in back.broken]
    assert [c.after.key for c in there.strict_fixed] == [c.before.key for c in back.strict_broken]


def test_a_question_with_another_label_is_not_compared(before: Results, after: Results) -> None:
    changed = after.results[0].model_copy(update={"label": "[0.0025]"})
    found = compare(before, after.model_copy(update={"results": (changed, *after.results[1:])}))
    assert found.broken == ()
    assert (found.only_before, found.only_after) == (("abc/001/0",), ("abc/001/0",))


def test_the_comparison_is_printed_with_both_answers(before: Results, after: Results) -> None:
    stream = io.StringIO()
    print_comparison(before, after, ("old", "new"), Console(file=stream, width=160))
    text = stream.getvalue()
    for shown in ("fixed: 1", "broken: 1", "fixed, strict rule only: 1", "How many holes?", "[0.0025]"):
        assert shown in text


def test_runs_stand_beside_each_other_by_set(before: Results, after: Results) -> None:
    text = printed(side_by_side([("old", before), ("new", after)]))
    assert "1 / 2 of 4" in text
    assert "2 / 2 of 4" in text


def test_the_tables_say_how_many_and_which_are_wrong(before: Results) -> None:
    stream = io.StringIO()
    print_results(before, Console(file=stream, width=160))
    text = stream.getvalue()
    assert "tiny: score" in text
    assert "there is no slot" in text
    assert "abc/001/0" not in text, "right answers are not listed"


def test_wrong_answers_of_the_held_out_half_are_counted_but_not_listed(before: Results) -> None:
    held = tuple(result.model_copy(update={"set": "held_out"}) for result in before.results)
    stream = io.StringIO()
    print_results(before.model_copy(update={"results": held}), Console(file=stream, width=160))
    text = stream.getvalue()
    assert "held_out" in text
    assert "there is no slot" not in text
    assert "How many holes?" not in text


def test_the_report_needs_no_other_file_and_shows_every_question(before: Results, tmp_path: Path) -> None:
    hostile = before.results[0].model_copy(update={"question": "<script>alert(1)</script>", "picture": "a.png"})
    (tmp_path / "a.png").write_bytes(b"\x89PNG")
    write_report(before.model_copy(update={"results": (hostile, *before.results[1:])}), tmp_path / "report.html")
    page = (tmp_path / "report.html").read_text(encoding="utf-8")
    assert page.count("<article") == 4
    assert page.count('<article class="wrong">') == 2
    assert "<script>alert" not in page
    assert "data:image/png;base64,iVBORw==" in page
    assert "http" not in page
    assert "$" not in page


def answers(tmp_path: Path, given: object) -> Path:
    path = tmp_path / "answers.json"
    path.write_text(json.dumps(given), encoding="utf-8")
    return path


def test_answers_of_another_system_are_scored_from_one_file(folder: Path, tmp_path: Path) -> None:
    given = {"abc/001/0": "[0.0025, 0.005]", "abc/001/1": 4, "shop/bracket/0": "rubbish", "shop/bracket/1": None}
    results = score_answers(read_benchmark(folder), answers(tmp_path, given), {}).results
    assert [r.strict for r in results] == [True, True, False, False]
    assert [r.failure for r in results] == [None, None, FailureClass.SYNTAX, FailureClass.REASONING]


def test_answers_of_another_system_are_scored_from_a_folder(folder: Path, tmp_path: Path) -> None:
    (tmp_path / "theirs" / "abc" / "001").mkdir(parents=True)
    (tmp_path / "theirs" / "abc" / "001" / "answers.txt").write_text("\n4\n", encoding="utf-8")
    results = score_answers(read_benchmark(folder), tmp_path / "theirs", {}).results
    assert [r.strict for r in results] == [False, True, False, False]


def test_results_scored_anew_give_the_same_score(folder: Path, tmp_path: Path, before: Results) -> None:
    again = score_answers(read_benchmark(folder), tmp_path / "before" / "results.json", {})
    assert again.results == before.results


def test_answers_to_unknown_questions_are_refused(folder: Path, tmp_path: Path) -> None:
    benchmark = read_benchmark(folder)
    with pytest.raises(BadBenchmark, match="no question abc/999/0"):
        score_answers(benchmark, answers(tmp_path, {"abc/999/0": 4}), {})
    with pytest.raises(BadBenchmark, match="no JSON object"):
        score_answers(benchmark, answers(tmp_path, [4]), {})
    with pytest.raises(BadBenchmark, match=r"answers\.txt"):
        score_answers(benchmark, tmp_path, {})
    with pytest.raises(BadBenchmark, match="No such file"):
        score_answers(benchmark, tmp_path / "missing.json", {})
