from __future__ import annotations

import json
import os
import subprocess
import sys
from pathlib import Path

import pytest

from querycad.cli import main


@pytest.fixture
def repository(folder: Path, tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> Path:
    """A folder with the tiny benchmark where the development half of CAD-Q&A would be; the current one."""
    root = tmp_path / "repository"
    (root / "benchmark").mkdir(parents=True)
    (tmp_path / "shared").mkdir()
    folder.rename(tmp_path / "shared" / "cad-qa-dev")
    monkeypatch.chdir(root)
    return root


def test_a_run_prints_the_score_and_writes_results_and_report(
    folder: Path, tmp_path: Path, adapter: str, capsys: pytest.CaptureFixture[str]
) -> None:
    out = tmp_path / "out"
    assert main(["bench", "run", str(folder), "--out", str(out), "--jobs", "1", "--system", adapter]) == 0
    assert "tiny: score" in capsys.readouterr().out
    results = json.loads((out / "results.json").read_text(encoding="utf-8"))["results"]
    wanted = {"set", "id", "index", "question", "answer", "label", "strict", "tolerant", "code", "codegen", "parts"}
    assert wanted | {"seconds", "status", "failure", "message"} <= set(results[0])
    assert (out / "report.html").is_file()


def test_a_resumed_run_keeps_the_overrides_beside_the_results(folder: Path, tmp_path: Path, adapter: str) -> None:
    out = tmp_path / "out"
    out.mkdir()
    override = {"shop/bracket/0": {"failure": "label", "note": "measured"}}
    (out / "overrides.json").write_text(json.dumps(override), encoding="utf-8")
    arguments = ["bench", "run", str(folder), "--out", str(out), "--jobs", "1", "--system", adapter]
    assert main(arguments) == main([*arguments, "--resume"]) == 0
    results = json.loads((out / "results.json").read_text(encoding="utf-8"))["results"]
    assert [result["failure"] for result in results][2] == "label"


@pytest.mark.parametrize("again", ["resume", "score"])
def test_a_judgement_that_comes_after_the_run_is_taken_over(
    folder: Path, tmp_path: Path, adapter: str, again: str, capsys: pytest.CaptureFixture[str]
) -> None:
    out = tmp_path / "out"
    run = ["bench", "run", str(folder), "--out", str(out), "--jobs", "1", "--system", adapter]
    assert main(run) == 0
    override = {
        "shop/bracket/0": {"failure": "label", "note": "measured"},
        "abc/001/1": {"failure": "label", "note": "no"},
    }
    (out / "overrides.json").write_text(json.dumps(override), encoding="utf-8")
    score = ["bench", "score", str(folder), str(out / "results.json"), "--out", str(out)]
    assert main([*run, "--resume"] if again == "resume" else score) == 0
    results = {
        f"{r['set']}/{r['id']}/{r['index']}": r for r in json.loads((out / "results.json").read_text())["results"]
    }
    assert (results["shop/bracket/0"]["failure"], results["shop/bracket/0"]["note"]) == ("label", "measured")
    assert (results["abc/001/1"]["tolerant"], results["abc/001/1"]["failure"]) == (True, None)
    assert "no type told" in capsys.readouterr().out


def test_scoring_and_comparing_need_no_system(folder: Path, tmp_path: Path, capsys: pytest.CaptureFixture[str]) -> None:
    for name, holes in (("a", 4), ("b", 5)):
        (tmp_path / f"{name}.json").write_text(json.dumps({"abc/001/1": holes}), encoding="utf-8")
        arguments = ["bench", "score", str(folder), str(tmp_path / f"{name}.json"), "--out", str(tmp_path / name)]
        assert main(arguments) == 0
    capsys.readouterr()
    assert main(["bench", "compare", str(tmp_path / "a"), str(tmp_path / "b" / "results.json")]) == 0
    assert "broken: 1" in capsys.readouterr().out


def test_an_ablation_runs_once_a_value(
    folder: Path, tmp_path: Path, adapter: str, capsys: pytest.CaptureFixture[str]
) -> None:
    out = tmp_path / "out"
    values = ["parser", "llm:large"]
    arguments = ["--option", "codegen", "--values", *values, "--out", str(out), "--jobs", "1", "--system", adapter]
    assert main(["bench", "ablate", str(folder), *arguments]) == 0
    rows = [line.split() for line in capsys.readouterr().out.splitlines()]
    assert {value for value in values if any(value in row for row in rows)} == set(values)
    assert sorted(path.name for path in out.iterdir()) == ["codegen-llm_large", "codegen-parser"]


def test_an_unknown_option_of_an_ablation_is_refused(folder: Path, capsys: pytest.CaptureFixture[str]) -> None:
    assert main(["bench", "ablate", str(folder), "--option", "colour", "--values", "red"]) == 2
    assert "codegen" in capsys.readouterr().err


def test_the_benchmark_as_a_whole_fails_below_the_floor_and_records_nothing_then(
    repository: Path, adapter: str, capsys: pytest.CaptureFixture[str]
) -> None:
    arguments = ["bench", "--jobs", "1", "--system", adapter]
    assert main(arguments) == 0
    assert not any((repository / "benchmark").iterdir())
    assert main([*arguments, "--record"]) == 0
    floor = json.loads((repository / "benchmark" / "floor.json").read_text(encoding="utf-8"))
    assert floor["cad-qa-dev"]["abc"] == {"questions": 2, "strict": 1, "tolerant": 1}
    floor["cad-qa-dev"]["abc"]["strict"] = 2
    (repository / "benchmark" / "floor.json").write_text(json.dumps(floor), encoding="utf-8")
    capsys.readouterr()
    assert main([*arguments, "--record"]) == 1
    assert "below the floor" in capsys.readouterr().err
    assert len((repository / "benchmark" / "trend.jsonl").read_text(encoding="utf-8").splitlines()) == 1


@pytest.mark.parametrize(
    "arguments",
    [
        ["run", "nowhere"],
        ["compare", "nowhere", "nowhere"],
        ["perf", "nowhere.step"],
        ["service", "nowhere.step"],
        ["run", ".", "--overrides", "nowhere.json"],
    ],
)
def test_bad_input_is_one_sentence_and_exit_code_2(
    arguments: list[str], tmp_path: Path, monkeypatch: pytest.MonkeyPatch, capsys: pytest.CaptureFixture[str]
) -> None:
    monkeypatch.chdir(tmp_path)
    assert main(["bench", *arguments]) == 2
    assert capsys.readouterr().err.startswith("querycad: ")


def test_an_adapter_that_takes_no_options_is_said_to_be_none(
    folder: Path, tmp_path: Path, monkeypatch: pytest.MonkeyPatch, capsys: pytest.CaptureFixture[str]
) -> None:
    (tmp_path / "bare_adapter.py").write_text("class Bare:\n    pass\n", encoding="utf-8")
    monkeypatch.syspath_prepend(str(tmp_path))
    command = ["bench", "run", str(folder), "--out", str(tmp_path / "out"), "--system", "bare_adapter:Bare"]
    assert main([*command, "--jobs", "1"]) == 2
    assert capsys.readouterr().err.startswith("querycad: bare_adapter:Bare is not made with the options of a run")


def test_the_help_of_the_command_loads_no_service() -> None:
    program = (
        "import sys, querycad\n"
        "known = set(sys.modules)\n"
        "from querycad.cli import main\n"
        "try:\n    main(['bench', '--help'])\n"
        "except SystemExit:\n"
        "    assert not {'OCP', 'numpy', 'rich', 'pydantic_monty', 'querycad_segworker'} & (set(sys.modules) - known)"
    )
    assert subprocess.run([sys.executable, "-c", program], check=False, stdout=subprocess.DEVNULL).returncode == 0


BUILD = """
import pathlib, sys
folder = pathlib.Path(sys.argv[1])
folder.mkdir(parents=True, exist_ok=True)
(folder / "nut.step").write_text("ISO-10303-21;")
with open("built", "a") as log:
    log.write("x")
"""


def test_own_models_are_built_when_missing_or_older_than_their_scripts(
    repository: Path, adapter: str, capsys: pytest.CaptureFixture[str]
) -> None:
    own = repository / "benchmark"
    for folder in (own / "models", own / "questions"):
        folder.mkdir()
    (own / "build_all.py").write_text(BUILD, encoding="utf-8")
    script = own / "models" / "build_nut.py"
    script.write_text("", encoding="utf-8")
    question = {"question": "How many holes?", "value": 4, "type": "count"}
    (own / "questions" / "nut.json").write_text(
        json.dumps({"model": "nut.step", "split": "dev", "items": [question]}), encoding="utf-8"
    )
    arguments = ["bench", "--jobs", "1", "--system", adapter]
    assert main(arguments) == main(arguments) == 0
    assert (repository / "built").read_text(encoding="utf-8") == "x", "the second run finds the models"
    later = (repository / "build" / "benchmark" / "nut.step").stat().st_mtime + 5
    os.utime(script, (later, later))
    assert main(arguments) == 0
    assert (repository / "built").read_text(encoding="utf-8") == "xx"
    (own / "build_all.py").write_text("raise SystemExit('no kernel')", encoding="utf-8")
    script.touch()
    os.utime(script, (later + 5, later + 5))
    capsys.readouterr()
    assert main(arguments) == 2
    assert "no kernel" in capsys.readouterr().err
