"""`querycad features`, as a user runs it."""

from __future__ import annotations

import json
import os
import subprocess
import sys
from pathlib import Path

import pytest

BRACKET = Path(__file__).resolve().parents[2] / "examples" / "bracket.step"

pytestmark = pytest.mark.skipif(not BRACKET.is_file(), reason="examples/bracket.step is not built")


@pytest.fixture(scope="module")
def home(tmp_path_factory: pytest.TempPathFactory) -> Path:
    return tmp_path_factory.mktemp("home")


def run(home: Path, *arguments: str) -> subprocess.CompletedProcess[str]:
    command = [sys.executable, "-m", "querycad.cli", "features", *arguments]
    environment = {**os.environ, "QUERYCAD_HOME": str(home)}
    return subprocess.run(command, capture_output=True, text=True, env=environment, timeout=300, check=False)


def test_features_of_one_kind_are_listed_with_their_faces(home: Path) -> None:
    done = run(home, str(BRACKET), "--kind", "hole", "--all")
    assert done.returncode == 0, done.stderr
    lines = done.stdout.splitlines()
    assert lines
    assert all(line.startswith("hole-") and "faces" in line for line in lines)
    as_json = run(home, str(BRACKET), "--kind", "holes", "--json")
    assert len(json.loads(as_json.stdout)) == len(lines)


def test_like_features_are_one_line_with_their_ids(home: Path) -> None:
    lines = [" ".join(line.split()) for line in run(home, str(BRACKET)).stdout.splitlines()]
    assert lines[0] == "lengths in mm"
    assert "4x Ø5.5 THRU, countersink Ø11.2 x 90° hole-3..6" in lines
    assert "2x slot 9 x 22 THRU cutout-1..2" in lines
    assert lines[-1].startswith("surfaces by shape: 12 cylinders")


def test_what_was_refused_is_listed_with_its_reason(home: Path) -> None:
    refused = json.loads(run(home, str(BRACKET), "--refused", "--json").stdout)
    assert refused
    assert all(row["reason"] and row["faces"] and row["kind"] for row in refused)
    assert "no hole: its wall covers" in run(home, str(BRACKET), "--refused").stdout


def test_a_file_that_is_none_is_said_in_one_line(home: Path, tmp_path: Path) -> None:
    (tmp_path / "empty.step").write_bytes(b"")
    done = run(home, str(tmp_path / "empty.step"))
    assert done.returncode == 2
    assert len(done.stderr.splitlines()) == 1
