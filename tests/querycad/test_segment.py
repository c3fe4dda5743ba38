"""`querycad segment`, as a user runs it."""

from __future__ import annotations

import os
import subprocess
import sys
from pathlib import Path

import pytest
from PIL import Image

from querycad.cli import main

BRACKET = Path(__file__).resolve().parents[2] / "examples" / "bracket.step"
STAGES = ("1-rendered", "2-boxes", "3-masks", "4-faces")

pytestmark = pytest.mark.skipif(not BRACKET.is_file(), reason="examples/bracket.step is not built")


@pytest.fixture(scope="module")
def home(tmp_path_factory: pytest.TempPathFactory) -> Path:
    return tmp_path_factory.mktemp("home")


def run(home: Path, *arguments: str) -> subprocess.CompletedProcess[str]:
    command = [sys.executable, "-m", "querycad.cli", "segment", str(BRACKET), *arguments]
    environment = {**os.environ, "QUERYCAD_HOME": str(home)}
    return subprocess.run(command, capture_output=True, text=True, env=environment, timeout=300, check=False)


def test_every_stage_of_every_view_is_drawn_with_known_parts(home: Path, tmp_path: Path) -> None:
    done = run(home, "countersunk hole", "--known", "--size", "640x360", "--out", str(tmp_path))
    assert done.returncode == 0, done.stderr
    assert done.stdout.count("hole-") >= 1
    views = ("top", "bottom", "left", "right", "front", "back")
    wanted = {f"{view}-{stage}.png" for view in views for stage in STAGES} | {"sheet.png"}
    assert {path.name for path in tmp_path.iterdir()} == wanted
    with Image.open(tmp_path / "top-4-faces.png") as picture:
        assert picture.size == (640, 360)


def test_without_weights_it_renders_and_says_what_is_missing(home: Path, tmp_path: Path) -> None:
    done = run(home, "logo", "--size", "320x180", "--views", "8", "--shaded", "--out", str(tmp_path))
    assert done.returncode == 2
    assert done.stderr.startswith("querycad: only rendered: no weights of a detector and of a segmenter")
    assert len(list(tmp_path.glob("*-1-rendered.png"))) == 8


def test_a_phrase_that_means_no_known_part_is_said(home: Path, tmp_path: Path) -> None:
    done = run(home, "quux", "--known", "--out", str(tmp_path))
    assert done.returncode == 2
    assert "not grounded" in done.stderr


def test_known_parts_need_flat_colours(home: Path, tmp_path: Path) -> None:
    done = run(home, "hole", "--known", "--shaded", "--out", str(tmp_path))
    assert done.returncode == 2
    assert "--shaded" in done.stderr


def test_every_number_of_the_stages_is_an_option(home: Path, tmp_path: Path) -> None:
    """As published, the only body would be most of the model in every view, and no part."""
    numbers = ("--largest-mask", "1", "--face-share", "0", "--covered", "1", "--no-join-neighbours", "--azimuth", "2")
    done = run(home, "body", "--known", "--size", "320x180", "--out", str(tmp_path), *numbers)
    assert done.returncode == 0, done.stderr
    assert done.stdout.startswith("body-1: ")


def test_a_share_above_one_is_refused(capsys: pytest.CaptureFixture[str]) -> None:
    with pytest.raises(SystemExit) as refused:
        main(["segment", str(BRACKET), "body", "--out", "nowhere", "--covered", "2"])
    assert refused.value.code == 2
    assert "must be between 0 and 1" in capsys.readouterr().err
