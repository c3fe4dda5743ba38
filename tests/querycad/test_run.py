"""`querycad run`: a program against a file on this machine."""

from __future__ import annotations

from pathlib import Path

import pytest

from querycad.cli import main


def test_a_program_is_run_against_a_file(
    flange: Path, tmp_path: Path, capsys: pytest.CaptureFixture[str], monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setenv("QUERYCAD_HOME", str(tmp_path / "home"))
    program = tmp_path / "program.py"
    program.write_text("solution = max(p.diameter for p in find_parts('hole'))", encoding="utf-8")
    assert main(["run", str(program), "--model", str(flange)]) == 0
    assert float(capsys.readouterr().out) == pytest.approx(0.054)


def test_a_file_that_is_none_is_exit_code_2(
    tmp_path: Path, capsys: pytest.CaptureFixture[str], monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setenv("QUERYCAD_HOME", str(tmp_path / "home"))
    program = tmp_path / "program.py"
    program.write_text("solution = 1", encoding="utf-8")
    assert main(["run", str(program), "--model", str(tmp_path / "nowhere.step")]) == 2
    assert "nowhere.step" in capsys.readouterr().err
