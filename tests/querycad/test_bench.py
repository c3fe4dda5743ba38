"""`querycad bench` finds the benchmark in the checkout, or says in a line where it is."""

from __future__ import annotations

import subprocess
import sys
import tomllib
from pathlib import Path

import pytest

from querycad.commands.bench import run

ROOT = Path(__file__).parents[2]


def test_without_a_checkout_it_says_in_a_line_how_to_get_it(tmp_path: Path, capsys: pytest.CaptureFixture[str]) -> None:
    assert run(["--record"], tmp_path) == 2
    (line,) = capsys.readouterr().err.splitlines()
    assert "get the sources" in line


@pytest.mark.parametrize(
    ("arguments", "said"),
    [(["--help"], "--record"), (["run", "--help"], "--resume"), (["perf", "-h"], "--only PART")],
)
def test_from_any_folder_all_that_follows_is_the_benchmarks_own(
    tmp_path: Path, arguments: list[str], said: str
) -> None:
    command = [sys.executable, "-m", "querycad.cli", "bench", *arguments]
    done = subprocess.run(command, cwd=tmp_path, capture_output=True, text=True, check=True)
    assert done.stdout.startswith("usage: querycad bench")
    assert said in done.stdout


def test_the_package_has_none_of_it() -> None:
    said = tomllib.loads((ROOT / "packages/querycad/pyproject.toml").read_text(encoding="utf-8"))
    assert said["tool"]["hatch"]["build"]["targets"]["wheel"]["packages"] == ["querycad"]
    assert not (ROOT / "packages/querycad/querycad/commands/bench").exists()
