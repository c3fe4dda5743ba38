from __future__ import annotations

import os
import subprocess
import sys
import time
from pathlib import Path
from typing import TYPE_CHECKING

import psutil
import pytest
from benchmark.scoring.failures import FailureClass, Override
from benchmark.scoring.items import BadBenchmark, read_benchmark
from benchmark.scoring.results import as_literal, load_results
from benchmark.scoring.running import run_benchmark
from benchmark.scoring.systems import Reply, System, SystemOptions, UnknownSystem, open_system

if TYPE_CHECKING:
    from tests.benchmark.conftest import TableOpener

OPTIONS = SystemOptions(store=Path("somewhere"))


def test_every_question_is_asked_scored_and_classed(folder: Path, tmp_path: Path, opener: TableOpener) -> None:
    results = run_benchmark(read_benchmark(folder), OPTIONS, tmp_path / "out", opener=opener).results
    assert [(r.key, r.answer, r.strict, r.tolerant, r.failure) for r in results] == [
        ("abc/001/0", "[0.005, 0.0025]", True, True, None),
        ("abc/001/1", "5", False, False, FailureClass.MASKS),
        ("shop/bracket/0", "0.14651", False, True, None),
        ("shop/bracket/1", None, False, False, FailureClass.MASKS),
    ]
    assert results[0].seconds == 0.25
    assert results[1].seconds is not None
    assert (results[1].code, results[1].codegen) == ('solution = len(find_parts("hole"))', "table")
    assert [r.status for r in results] == ["answered", "answered", "answered", "not_grounded"]


def test_a_system_is_opened_once_a_model_and_closed(folder: Path, tmp_path: Path, opener: TableOpener) -> None:
    run_benchmark(read_benchmark(folder), OPTIONS, tmp_path / "out", opener=opener)
    assert [system.closed for system in opener.opened] == [True, True]


def test_the_file_of_results_holds_what_was_returned(folder: Path, tmp_path: Path, opener: TableOpener) -> None:
    results = run_benchmark(read_benchmark(folder), OPTIONS, tmp_path / "out", opener=opener)
    assert load_results(tmp_path / "out" / "results.json") == results
    assert results.options is not None
    assert results.options.store is None, "a folder of this machine says nothing about the run"


def test_what_a_system_raises_is_the_failure_of_one_question(folder: Path, tmp_path: Path, opener: TableOpener) -> None:
    opener.table["Which radii?"] = IndexError("out of range")
    first, second, *_ = run_benchmark(read_benchmark(folder), OPTIONS, tmp_path / "out", opener=opener).results
    assert (first.status, first.failure) == ("internal", FailureClass.INTERFACE)
    assert first.message == "IndexError: out of range"
    assert second.status == "answered"


def test_a_question_without_end_is_stopped_and_the_next_one_asked(
    folder: Path, tmp_path: Path, opener: TableOpener
) -> None:
    endless = _Endless(opener)
    options = SystemOptions(timeout_s=0.05)
    first, second, *_ = run_benchmark(read_benchmark(folder), options, tmp_path / "out", opener=endless).results
    assert (first.status, first.failure, first.message) == ("limit", FailureClass.SYNTAX, "no answer within 0.05 s")
    assert second.status == "answered"
    assert [system.closed for system in opener.opened] == [True, True, True], "a system that was stopped is opened anew"


class _Endless:
    """Opens systems that never answer one of the questions, and take any exception for an error of their own."""

    def __init__(self, opener: TableOpener) -> None:
        self._opener = opener

    def __call__(self, options: SystemOptions) -> System:
        system = self._opener(options)
        answer = system.ask

        def ask(file: Path, question: str) -> Reply:
            while question == "Which radii?":
                try:
                    time.sleep(0.001)
                except Exception:
                    return Reply(0.0)
            return answer(file, question)

        system.ask = ask  # type: ignore[method-assign]
        return system


def test_progress_counts_every_question_once(folder: Path, tmp_path: Path, opener: TableOpener) -> None:
    told: list[int] = []
    run_benchmark(read_benchmark(folder), OPTIONS, tmp_path / "out", opener=opener, progress=told.append)
    assert sum(told) == 4


def test_an_interrupted_run_goes_on_with_what_is_left(folder: Path, tmp_path: Path, opener: TableOpener) -> None:
    out, benchmark = tmp_path / "out", read_benchmark(folder)
    opener.table["How wide?"] = KeyboardInterrupt()  # type: ignore[assignment]
    with pytest.raises(BaseException) as stop:  # noqa: PT011 - Ctrl-C is what it is
        run_benchmark(benchmark, OPTIONS, out, opener=_Interrupted(opener))
    assert stop.type is KeyboardInterrupt
    assert [r.key for r in load_results(out / "results.json").results] == ["abc/001/0", "abc/001/1"]
    opener.asked.clear()
    opener.table["How wide?"] = Reply(0.14662)
    results = run_benchmark(benchmark, OPTIONS, out, opener=opener, resume=True)
    assert opener.asked == ["How wide?", "Where is the slot?"]
    assert len(results.results) == 4


class _Interrupted:
    """Opens systems that are stopped from the keyboard where the table says so."""

    def __init__(self, opener: TableOpener) -> None:
        self._opener = opener

    def __call__(self, options: SystemOptions) -> _Interrupted:
        self._system = self._opener(options)
        return self

    def ask(self, file: Path, question: str) -> Reply:
        reply = self._opener.table[question]
        if isinstance(reply, KeyboardInterrupt):
            raise reply
        return self._system.ask(file, question)

    def close(self) -> None:
        self._system.close()


def test_a_changed_label_is_asked_again(folder: Path, tmp_path: Path, opener: TableOpener) -> None:
    out = tmp_path / "out"
    run_benchmark(read_benchmark(folder), OPTIONS, out, opener=opener)
    (folder / "abc" / "001" / "solution.txt").write_text("[0.0025, 0.005]\n5\n", encoding="utf-8")
    opener.asked.clear()
    results = run_benchmark(read_benchmark(folder), OPTIONS, out, opener=opener, resume=True).results
    assert opener.asked == ["How many holes?"]
    assert results[1].strict


def test_results_of_other_options_are_not_mixed(folder: Path, tmp_path: Path, opener: TableOpener) -> None:
    benchmark, out = read_benchmark(folder), tmp_path / "out"
    run_benchmark(benchmark, OPTIONS, out, opener=opener)
    with pytest.raises(BadBenchmark, match="other options"):
        run_benchmark(benchmark, SystemOptions(codegen="llm:large"), out, opener=opener, resume=True)


def test_an_override_changes_the_class_but_not_the_score(folder: Path, tmp_path: Path, opener: TableOpener) -> None:
    overrides = {
        key: Override(failure=FailureClass.LABEL, note="there are 5, counted") for key in ("abc/001/0", "abc/001/1")
    }
    right, wrong, *_ = run_benchmark(
        read_benchmark(folder), OPTIONS, tmp_path / "out", opener=opener, overrides=overrides
    ).results
    assert (wrong.failure, wrong.note, wrong.tolerant) == (FailureClass.LABEL, "there are 5, counted", False)
    assert (right.failure, right.note) == (None, "")


def test_pictures_lie_beside_the_results(folder: Path, tmp_path: Path, opener: TableOpener) -> None:
    opener.table["How wide?"] = Reply(0.1, picture_png=b"\x89PNG")
    results = run_benchmark(read_benchmark(folder), OPTIONS, tmp_path / "out", opener=opener).results
    assert results[2].picture == "pictures/shop-bracket-0.png"
    assert (tmp_path / "out" / "pictures" / "shop-bracket-0.png").read_bytes() == b"\x89PNG"


def test_parallel_processes_find_the_same_as_one(folder: Path, tmp_path: Path, adapter: str) -> None:
    options, benchmark = SystemOptions(system=adapter), read_benchmark(folder)
    alone = run_benchmark(benchmark, options, tmp_path / "one")
    together = run_benchmark(benchmark, options, tmp_path / "two", jobs=2)
    assert [(r.key, r.answer) for r in alone.results] == [(r.key, r.answer) for r in together.results]
    assert [r.answer for r in alone.results] == ["0.1", "4", "0.1", "0.1"]


@pytest.mark.parametrize("name", ["nowhere:System", "json:Nothing", "json", ""])
def test_an_unknown_system_is_refused(name: str) -> None:
    with pytest.raises(UnknownSystem, match="there is no system"):
        open_system(SystemOptions(system=name))


def test_the_embedded_runtime_refuses_a_code_generator_that_it_does_not_have() -> None:
    with pytest.raises(UnknownSystem, match="oracle"):
        open_system(SystemOptions(codegen="oracle"))


def test_answers_are_written_without_noise() -> None:
    assert as_literal([0.010999999999999999, -0.0, (1, 2)]) == "[0.011, 0.0, [1, 2]]"
    assert as_literal("a 'b'") == repr("a 'b'")


ROOT = Path(__file__).parents[3]
NEVER_ENDS = """
import os, sys, time
from pathlib import Path
from benchmark.scoring.items import read_benchmark
from benchmark.scoring.running import run_benchmark
from benchmark.scoring.systems import SystemOptions

class Sleeper:
    def ask(self, file, question):
        Path(f"{sys.argv[2]}/{os.getpid()}").touch()
        time.sleep(60)

    def close(self):
        pass

def opener(options):
    return Sleeper()

if __name__ == "__main__":
    run_benchmark(read_benchmark(Path(sys.argv[1])), SystemOptions(), Path(sys.argv[2]), jobs=2, opener=opener)
"""


@pytest.mark.skipif(sys.platform != "linux", reason="elsewhere a process is not told of its parent's death")
def test_no_worker_outlives_a_run_that_is_killed(folder: Path, tmp_path: Path) -> None:
    script, out = tmp_path / "never_ends.py", tmp_path / "out"
    script.write_text(NEVER_ENDS)
    out.mkdir()
    environment = {**os.environ, "PYTHONPATH": str(ROOT)}
    with subprocess.Popen([sys.executable, str(script), str(folder), str(out)], env=environment) as process:
        deadline = time.monotonic() + 60
        while len(list(out.glob("[0-9]*"))) < 2:
            assert process.poll() is None
            assert time.monotonic() < deadline
            time.sleep(0.05)
        workers = [psutil.Process(int(path.name)) for path in out.glob("[0-9]*")]
        process.kill()
    _, alive = psutil.wait_procs(workers, timeout=20)
    assert not alive
