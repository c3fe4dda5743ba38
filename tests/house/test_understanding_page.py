"""docs/understanding.md explains every feature that has a weight, and shows what the command prints."""

from __future__ import annotations

import re
from pathlib import Path

import pytest

from querycad.cli import main
from querycad_language.weights import weights

ROOT = Path(__file__).parents[2]
PAGE = (ROOT / "docs/understanding.md").read_text()
EXPLAINED = re.findall(r"^\| `(\w+)` \| (.+) \|$", PAGE, re.MULTILINE)


def test_every_feature_that_has_a_weight_is_explained_once() -> None:
    names = [name for name, _ in EXPLAINED]
    fitted = {name for name in weights() if " " not in name}  # 'depth of hole' explains itself
    assert fitted - set(names) == set()
    assert len(names) == len(set(names))


def test_the_worked_example_is_what_the_command_prints(
    capsys: pytest.CaptureFixture[str], monkeypatch: pytest.MonkeyPatch, tmp_path: Path
) -> None:
    """Its readings; their scores change whenever weights are fitted."""
    monkeypatch.setenv("QUERYCAD_HOME", str(tmp_path))
    monkeypatch.chdir(ROOT)
    found = re.search(r'`querycad explain (\S+) "([^"]+)"`', PAGE)
    assert found is not None
    assert main(["explain", found[1], found[2]]) == 0
    printed = capsys.readouterr().out.splitlines()
    shown = PAGE.partition("explain output: begin")[2].splitlines()
    first = next(line for line in shown if line.startswith("1. "))
    assert first in printed
    assert any(line.startswith("   score ") for line in printed)
