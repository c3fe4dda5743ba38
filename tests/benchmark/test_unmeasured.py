"""Lengths that people ask for and no part has."""

from __future__ import annotations

from pathlib import Path

import pytest
from benchmark import unmeasured
from benchmark.understanding.data import Question
from tests.segworker.shapes import DOWN, cut, cylinder, plate, write_step


def asked(file: Path, truth: float) -> Question:
    return Question("m", file, "somebody", f"{truth}?", truth, "length")


def test_what_no_part_measures_is_told_and_what_one_does_is_not(
    tmp_path: Path, capsys: pytest.CaptureFixture[str], monkeypatch: pytest.MonkeyPatch
) -> None:
    step = write_step(tmp_path / "plate.step", cut(plate(80, 60, 20), cylinder(5, 12, (-25, 0, 0), DOWN)))
    truths = (0.010, 0.005, 0.012, 0.080, 0.0333)  # the hole's diameter, radius and depth, the length, nothing's
    monkeypatch.setattr(unmeasured, "questions", lambda: [asked(step, truth) for truth in truths])
    assert unmeasured.main(["--store", str(tmp_path / "store")]) == 0
    assert capsys.readouterr().out.splitlines() == [
        "plate.step: 33.3 mm: 0.0333?",
        "lengths: 5, no part's: 1, models: 1",
    ]
