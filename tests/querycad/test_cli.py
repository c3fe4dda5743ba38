"""The command line as a whole: version, examples, completion; tables, descriptions, and what is told before work."""

from __future__ import annotations

import argparse
import csv
import io
import json
import os
import subprocess
import sys
from pathlib import Path

import pytest

from querycad.cli import main
from querycad.commands.arguments import make_parser

ROOT = Path(__file__).parents[2]
FLANGE = str(ROOT / "examples" / "flange.step")
NAMES = sorted(path.stem for path in (ROOT / "examples").glob("*.step"))


def subcommands(parser: argparse.ArgumentParser) -> dict[str, argparse.ArgumentParser]:
    groups = [action for action in parser._actions if isinstance(action, argparse._SubParsersAction)]
    return dict(groups[0].choices) if groups else {}


@pytest.fixture(autouse=True, scope="module")
def _home(tmp_path_factory: pytest.TempPathFactory) -> object:
    with pytest.MonkeyPatch.context() as patch:
        patch.setenv("QUERYCAD_HOME", str(tmp_path_factory.mktemp("home")))
        yield


def run(capsys: pytest.CaptureFixture[str], *arguments: str) -> tuple[int, str, str]:
    try:
        code = main(arguments)
    except SystemExit as ended:
        code = int(ended.code or 0)
    out, err = capsys.readouterr()
    return code, out, err


def test_the_version_is_that_of_the_project(capsys: pytest.CaptureFixture[str]) -> None:
    code, out, _ = run(capsys, "--version")
    assert (code, out) == (0, f"querycad {(ROOT / 'VERSION').read_text().strip()}\n")


@pytest.mark.parametrize("name", sorted(set(subcommands(make_parser())) - {"bench"}))
def test_every_help_text_has_examples_that_parse(name: str) -> None:
    parser = make_parser()
    epilog = subcommands(parser)[name].epilog or ""
    examples = [line.strip() for line in epilog.splitlines() if line.startswith("  querycad ")]
    assert examples
    import shlex

    for example in examples:
        words = shlex.split(example, comments=True)
        words = words[: next((i for i, word in enumerate(words) if word in (">", ">>", "<")), len(words))]
        assert parser.parse_args(words[1:]).command == name


@pytest.mark.parametrize("shell", ["bash", "zsh", "fish"])
def test_completion_is_printed_for_shells(capsys: pytest.CaptureFixture[str], shell: str) -> None:
    code, out, _ = run(capsys, "completion", shell)
    assert code == 0
    assert "querycad" in out


def test_a_shell_is_told_the_commands(tmp_path: Path) -> None:
    """As argcomplete's script asks: the line in the environment, the words on the ninth file descriptor."""
    environment = os.environ | {
        "_ARGCOMPLETE": "1",
        "COMP_LINE": "querycad de",
        "COMP_POINT": "11",
        "_ARGCOMPLETE_STDOUT_FILENAME": str(tmp_path / "words"),
        "_ARGCOMPLETE_SUPPRESS_SPACE": "1",
    }
    subprocess.run([sys.executable, "-m", "querycad.cli"], env=environment, check=True, capture_output=True)
    assert (tmp_path / "words").read_text() == "describe"


def test_a_table_of_holes_has_a_row_each_in_every_form(capsys: pytest.CaptureFixture[str]) -> None:
    code, out, err = run(capsys, "table", FLANGE, "holes", "--format", "csv")
    rows = list(csv.DictReader(io.StringIO(out)))
    assert (code, err, len(rows)) == (0, "", 11)
    assert {row["callout"] for row in rows} == {"Ø16 THRU, counterbore Ø26 depth 8", "Ø8.5 THRU", "Ø54 THRU"}
    assert {(row["x [mm]"], row["y [mm]"]) for row in rows} > {("67", "0"), ("0", "-67")}
    assert len(json.loads(run(capsys, "table", FLANGE, "holes", "--format", "json")[1])["rows"]) == 11
    grouped = run(capsys, "table", FLANGE, "holes", "--format", "markdown", "--grouped", "--unit", "in")[1]
    assert len(grouped.splitlines()) == 5
    assert "[in]" in grouped


def test_a_long_table_for_people_groups_and_says_so(
    capsys: pytest.CaptureFixture[str], monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setattr("querycad.commands.table.ROWS_SHOWN", 5)
    _, out, err = run(capsys, "table", FLANGE, "holes")
    assert len(out.splitlines()) == 4
    assert "11 holes in 3 groups; --all prints each" in err
    assert len(run(capsys, "table", FLANGE, "holes", "--all")[1].splitlines()) == 12
    assert len(run(capsys, "table", FLANGE, "holes", "--format", "csv")[1].splitlines()) == 12


@pytest.mark.parametrize("command", [("table", FLANGE, "holes"), ("describe", FLANGE)])
def test_a_service_that_is_away_is_one_line(capsys: pytest.CaptureFixture[str], command: tuple[str, ...]) -> None:
    code, out, err = run(capsys, *command, "--server", "http://127.0.0.1:1")
    assert (code, out) == (1, "")
    assert err.startswith("querycad: no service answers at http://127.0.0.1:1")
    assert err.count("\n") == 1


def test_a_model_without_such_parts_is_said(capsys: pytest.CaptureFixture[str]) -> None:
    code, out, err = run(capsys, "table", FLANGE, "bends")
    assert (code, out) == (2, "")
    assert "no bends" in err
    assert run(capsys, "table", FLANGE, "bends", "--format", "csv")[1].count("\n") == 1, "programs get the head alone"


@pytest.mark.parametrize("name", NAMES)
def test_every_question_that_a_description_suggests_has_a_sure_answer(
    capsys: pytest.CaptureFixture[str], name: str, tmp_path: Path
) -> None:
    file = str(ROOT / "examples" / f"{name}.step")
    code, out, _ = run(capsys, "describe", file, "--json")
    suggested = json.loads(out)["questions"]
    assert code == 0
    assert len(suggested) >= 5
    (tmp_path / "questions.txt").write_text("\n".join(suggested), encoding="utf-8")
    records = run(capsys, "ask", file, "--questions", str(tmp_path / "questions.txt"), "--json")[1].splitlines()
    assert {json.loads(record)["status"] for record in records} == {"answered"}


@pytest.mark.parametrize("question", ["What is this part?", "List all features", "What can I ask?"])
def test_questions_about_the_model_as_such_are_answered_with_its_description(
    capsys: pytest.CaptureFixture[str], question: str
) -> None:
    code, out, _ = run(capsys, "ask", FLANGE, question)
    described = run(capsys, "describe", FLANGE)[1]
    assert code == 0
    assert out.startswith(described)
    assert "8x Ø16 THRU, counterbore Ø26 depth 8" in out


def test_a_description_is_of_another_type_than_a_length(capsys: pytest.CaptureFixture[str]) -> None:
    code, _, err = run(capsys, "ask", FLANGE, "What is this part?", "--expect", "length")
    assert code == 2
    assert len(err.splitlines()) == 1


@pytest.mark.parametrize(
    ("arguments", "says"),
    [
        (["features", FLANGE, "--kind", "nonsense"], "no kind of part is called 'nonsense'"),
        (["features", FLANGE, "--kind", "bend"], "the model has no bend"),
        (["features", FLANGE, "--refused", "--kind", "nonsense"], "nothing was refused as 'nonsense'"),
        (["ask", FLANGE, "How many holes?", "--picture", "holes.jpg"], "end the name in .png"),
        (["table", FLANGE, "nonsense"], "nonsense"),
        (["describe", "nowhere.step"], "no such file"),
        (["table", "nowhere.step", "holes"], "no such file"),
    ],
)
def test_bad_input_is_told_in_one_line(capsys: pytest.CaptureFixture[str], arguments: list[str], says: str) -> None:
    code, out, err = run(capsys, *arguments)
    assert (code, out) == (2, "")
    assert says in err.splitlines()[-1]


@pytest.mark.parametrize("command", ["ask", "features", "describe", "table"])
def test_a_home_that_cannot_be_written_is_told_with_what_to_do(
    capsys: pytest.CaptureFixture[str], monkeypatch: pytest.MonkeyPatch, tmp_path: Path, command: str
) -> None:
    (tmp_path / "file").write_bytes(b"")
    monkeypatch.setenv("QUERYCAD_HOME", str(tmp_path / "file" / "home"))
    more = {"ask": ["How many holes?"], "table": ["holes"]}.get(command, [])
    code, out, err = run(capsys, command, FLANGE, *more)
    assert (code, out) == (2, "")
    assert len(err.splitlines()) == 1
    assert "set QUERYCAD_HOME" in err


def test_a_kernel_crash_is_one_line_in_a_process_of_its_own(tmp_path: Path) -> None:
    file = ROOT.parent / "shared" / "robustness" / "derived" / "missing_entities.step"
    if not file.is_file():
        pytest.skip(f"{file} is not there")
    environment = os.environ | {"QUERYCAD_HOME": str(tmp_path)}
    command = [sys.executable, "-m", "querycad.cli", "describe", str(file)]
    done = subprocess.run(command, env=environment, capture_output=True, text=True, check=False, timeout=300)
    assert (done.returncode, done.stdout) == (2, "")
    assert len(done.stderr.splitlines()) == 1
    assert "crashed on this file" in done.stderr


def test_the_symbols_of_drawings_are_written_on_request(capsys: pytest.CaptureFixture[str]) -> None:
    assert "8x Ø16 THRU, ⌴Ø26 ↧8" in run(capsys, "features", FLANGE, "--symbols")[1]
    assert run(capsys, "ask", FLANGE, "What is hole 1?", "--symbols")[1].startswith("Ø16 THRU, ⌴Ø26 ↧8 (hole-1)")
    answer = run(capsys, "ask", FLANGE, "How many counterbored holes are there?", "--symbols")[1]
    assert "8x Ø16 THRU, ⌴Ø26 ↧8" in answer


def test_an_answer_lists_like_parts_once_and_each_on_request(capsys: pytest.CaptureFixture[str]) -> None:
    question = "How many counterbored holes are there?"
    out = run(capsys, "ask", FLANGE, question, "--unit", "in")[1]
    assert "  parts, in inches:\n    8x Ø0.6299 THRU, counterbore Ø1.0236 depth 0.315  hole-1..3" in out
    each = run(capsys, "ask", FLANGE, question, "--all")[1]
    assert each.count("counterbore Ø26 depth 8 (faces ") == 8
    assert "visible from: top, bottom" in each
