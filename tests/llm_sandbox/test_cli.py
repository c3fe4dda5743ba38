"""`python -m querycad_sandbox run`: the service's own code on the command line."""

from __future__ import annotations

import argparse
import io
import json
from collections.abc import Iterator
from pathlib import Path

import pytest
from tests.llm_sandbox.conftest import MODEL, FakePartFinder, FakeSegworker

from querycad_sandbox.arguments import add_run_arguments
from querycad_sandbox.cli import main, run_program


@pytest.fixture
def program(tmp_path: Path) -> Path:
    path = tmp_path / "program.py"
    path.write_text("print('looking')\nsolution = [p.id for p in find_parts('boss')]", encoding="utf-8-sig")
    return path


@pytest.fixture
def segworker(redis_url: str, monkeypatch: pytest.MonkeyPatch) -> Iterator[FakeSegworker]:
    monkeypatch.setenv("QUERYCAD_REDIS_URL", redis_url)
    made = FakeSegworker(redis_url)
    made.start()
    yield made
    made.stop()


def run(*arguments: str) -> tuple[int, str]:
    parser = argparse.ArgumentParser()
    add_run_arguments(parser)
    out = io.StringIO()
    code = run_program(parser.parse_args(arguments), lambda _: FakePartFinder(), out)
    return code, out.getvalue()


def test_a_program_runs_and_its_value_is_printed(program: Path) -> None:
    assert run(str(program)) == (0, "looking\n['boss-1']\n")


def test_the_outcome_can_be_had_as_json(program: Path) -> None:
    code, out = run(str(program), "--json")
    assert (code, json.loads(out)["value"]) == (0, ["boss-1"])


def test_the_events_can_be_had_a_line_each(program: Path) -> None:
    code, out = run(str(program), "--events")
    assert code == 0
    assert [json.loads(line)["kind"] for line in out.splitlines()] == ["printed", "call", "answer", "ended"]


def test_a_program_that_fails_is_exit_code_1(program: Path, capsys: pytest.CaptureFixture[str]) -> None:
    program.write_text("while True:\n    pass", encoding="utf-8")
    assert run(str(program), "--seconds", "0.1") == (1, "")
    assert capsys.readouterr().err == "querycad: timed_out: the program ran out of time\n"


@pytest.mark.parametrize(
    ("arguments", "complaint"),
    [
        (["nowhere.py"], "querycad: nowhere.py: No such file or directory\n"),
        (["-", "--seconds", "-1"], "duration_s: Input should be greater than 0"),
        (["-", "--memory", "100000"], "memory_bytes: Input should be less than"),
        (["-", "--expects", "poem"], "'poem' is not a valid AnswerType"),
    ],
)
def test_what_cannot_be_run_is_exit_code_2(
    arguments: list[str], complaint: str, capsys: pytest.CaptureFixture[str], monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setattr("sys.stdin", io.StringIO("solution = 1"))
    assert run(*arguments) == (2, "")
    assert complaint in capsys.readouterr().err


def test_a_model_of_the_segworkers_is_asked_by_its_id(
    program: Path, segworker: FakeSegworker, capsys: pytest.CaptureFixture[str]
) -> None:
    assert main(["run", str(program), "--model", MODEL]) == 0
    assert capsys.readouterr().out == "looking\n['boss-1']\n"
    assert segworker.models == {MODEL}


def test_a_model_s_id_that_is_none_is_exit_code_2(program: Path, capsys: pytest.CaptureFixture[str]) -> None:
    assert main(["run", str(program), "--model", "12"]) == 2
    assert "'12'" in capsys.readouterr().err
