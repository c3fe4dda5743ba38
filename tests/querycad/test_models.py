"""`querycad models` as a user meets it."""

from __future__ import annotations

from pathlib import Path

import pytest

from querycad.cli import main
from querycad_segworker.segcad.engines.weights import known_models


@pytest.fixture
def weights(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> Path:
    monkeypatch.setenv("QUERYCAD_HOME", str(tmp_path / "home"))
    return tmp_path / "home/weights"


def test_the_list_says_what_is_there_and_what_is_missing(weights: Path, capsys: pytest.CaptureFixture[str]) -> None:
    assert main(["models", "list"]) == 0
    printed = capsys.readouterr().out
    assert all(model.name in printed and model.repository in printed for model in known_models())
    assert f"no weights of a detector and of a segmenter in {weights}: `querycad models pull` gets them" in printed


def test_weights_of_one_s_own_are_listed_and_used(weights: Path, capsys: pytest.CaptureFixture[str]) -> None:
    for name in ("encoder.onnx", "decoder.onnx"):
        (weights / "mine").mkdir(parents=True, exist_ok=True)
        (weights / "mine" / name).touch()
    main(["models", "list"])
    printed = capsys.readouterr().out
    assert any("mine" in line and "yes, used" in line for line in printed.splitlines())
    assert "no weights of a detector in" in printed


def test_files_that_are_not_the_right_ones_are_refused(
    weights: Path, tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    source = tmp_path / "elsewhere/mobile-sam"
    source.mkdir(parents=True)
    for name in ("encoder.onnx", "decoder.onnx"):
        (source / name).write_bytes(b"no network")
    assert main(["models", "pull", "mobile-sam", "--from", str(tmp_path / "elsewhere")]) == 1
    assert "encoder.onnx of mobile-sam has the wrong checksum and was not kept" in capsys.readouterr().err
    assert not list(weights.rglob("*.onnx*"))


def test_a_mirror_that_is_not_there_is_one_clear_line(weights: Path, capsys: pytest.CaptureFixture[str]) -> None:
    assert main(["models", "pull", "slimsam-77", "--from", str(weights / "nowhere")]) == 2
    assert capsys.readouterr().err == f"querycad: {weights / 'nowhere'}: no such folder\n"


def test_an_unknown_name_is_answered_with_the_known_ones(weights: Path, capsys: pytest.CaptureFixture[str]) -> None:
    assert main(["models", "pull", "sam9"]) == 2
    error = capsys.readouterr().err
    assert error.startswith("querycad: no model is called sam9; there are: grounding-dino-tiny")


def test_verify_names_what_is_wrong_and_what_is_missing(weights: Path, capsys: pytest.CaptureFixture[str]) -> None:
    assert main(["models", "verify"]) == 0
    assert "nothing to verify" in capsys.readouterr().out
    (weights / "mobile-sam").mkdir(parents=True)
    (weights / "mobile-sam/encoder.onnx").write_bytes(b"no network")
    assert main(["models", "verify"]) == 1
    printed = capsys.readouterr().out
    assert "mobile-sam/encoder.onnx: checksum mismatch" in printed
    assert "mobile-sam/decoder.onnx: absent" in printed
