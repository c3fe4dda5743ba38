"""The kernel's process: what a file that takes it over would find, and what of a file's names gets out of it."""

from __future__ import annotations

from pathlib import Path

import psutil
import pytest

from querycad_segworker.ingest import IngestLimits, ingest
from querycad_segworker.kernel_process import _host, start_host
from querycad_segworker.model import ModelStore

EXAMPLE = Path("examples/flange.step")


def test_the_kernels_process_knows_no_password_of_the_services(monkeypatch: pytest.MonkeyPatch) -> None:
    _host.stop()
    monkeypatch.setenv("QUERYCAD_REDIS_URL", "redis://:hunter2@store:6379/0")
    monkeypatch.setenv("QUERYCAD_LLM_API_KEY", "hunter2")
    monkeypatch.setenv("AWS_SECRET_ACCESS_KEY", "hunter2")
    start_host()
    assert _host._process is not None
    environment = psutil.Process(_host._process.pid).environ()
    assert "PATH" in environment
    assert not [name for name, value in environment.items() if "hunter2" in value]


def test_control_characters_of_a_name_are_left_behind(tmp_path: Path) -> None:
    text = EXAMPLE.read_text(encoding="utf-8")
    name = text.split("PRODUCT('", 1)[1].split("'", 1)[0]
    evil = "a\\X2\\001B\\X0\\]0;owned\\X2\\0007\\X0\\\\X2\\202E\\X0\\b"
    (tmp_path / "evil.step").write_text(text.replace(f"'{name}'", f"'{evil}'"), encoding="utf-8")
    model = ingest(tmp_path / "evil.step", ModelStore(tmp_path / "store")).model.read_text(encoding="utf-8")
    assert "owned" in model
    assert not [char for char in ("\x1b", "\\u001b", "\x07", "\\u0007", "\u202e", "\\u202e") if char in model]


def test_memory_of_the_kernels_process_is_limited_as_a_rule(tmp_path: Path) -> None:
    assert IngestLimits().memory_bytes == 4 * 2**30
    assert ingest(EXAMPLE, ModelStore(tmp_path)).model.is_file()
