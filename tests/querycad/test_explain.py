"""`querycad explain` shows readings with scores; `querycad ask` says how sure it is."""

from __future__ import annotations

import json
from pathlib import Path

import pytest

from querycad.cli import main

FLANGE = str(Path(__file__).parents[2] / "examples" / "flange.step")


@pytest.fixture(autouse=True, scope="module")
def _home(tmp_path_factory: pytest.TempPathFactory) -> object:
    with pytest.MonkeyPatch.context() as patch:
        patch.setenv("QUERYCAD_HOME", str(tmp_path_factory.mktemp("home")))
        yield


def test_readings_come_with_score_probability_value_and_features(capsys: pytest.CaptureFixture[str]) -> None:
    assert main(["explain", FLANGE, "How deep is the smallest hole?", "--json"]) == 0
    told = json.loads(capsys.readouterr().out)
    assert told["refused"] is None
    shares = [reading["probability"] for reading in told["readings"]]
    assert shares == sorted(shares, reverse=True)
    assert sum(shares) == pytest.approx(1.0, abs=0.01)
    best = told["readings"][0]
    assert best["understood_as"].startswith("depth of the")
    assert best["value"] == pytest.approx(0.022)
    assert best["parts"]
    added = sum(feature["adds"] for feature in best["features"].values())
    assert added == pytest.approx(best["score"], abs=0.02)


def test_a_refusal_is_told_with_what_was_tried(capsys: pytest.CaptureFixture[str]) -> None:
    assert main(["explain", FLANGE, "How much does it cost?"]) == 0
    assert "refused: a STEP file holds no price" in capsys.readouterr().out


def test_a_bad_file_is_one_line(capsys: pytest.CaptureFixture[str]) -> None:
    assert main(["explain", "nowhere.step", "How many holes?"]) == 2
    assert len(capsys.readouterr().err.splitlines()) == 1


def test_an_unsure_answer_shows_the_readings_and_is_no_error(capsys: pytest.CaptureFixture[str]) -> None:
    question = "How deep is the hole?"
    assert main(["ask", FLANGE, question, "--least-confidence", "1", "--json"]) == 0
    record = json.loads(capsys.readouterr().out)
    assert record["status"] == "unsure"
    assert record["answer"]["text"].startswith("perhaps ")
    assert record["alternatives"][0]["answer"]["text"] in record["answer"]["text"]
    assert main(["ask", FLANGE, question, "--least-confidence", "0"]) == 0
    out = capsys.readouterr().out
    assert not out.startswith("perhaps")
    assert "understood as: depth of the" in out


def test_a_threshold_that_is_no_probability_is_refused(capsys: pytest.CaptureFixture[str]) -> None:
    assert main(["ask", FLANGE, "How many holes?", "--least-confidence", "7"]) == 2
    assert "least_confidence" in capsys.readouterr().err
