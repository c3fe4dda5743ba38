"""The Makefile says what it can do, and can do what it says."""

from __future__ import annotations

import os
import re
import subprocess
from pathlib import Path

import pytest

ROOT = Path(__file__).parents[2]
TARGETS = (
    "help setup demo test attack audit soak parity check format serve web bench fit openapi examples lock sbom dist "
    "clean"
)
PROMISED = set(TARGETS.split())


def make(*arguments: str) -> str:
    environment = {name: value for name, value in os.environ.items() if not name.startswith(("MAKE", "MFLAGS"))}
    command = ["make", *arguments]
    return subprocess.run(command, cwd=ROOT, env=environment, check=True, capture_output=True, text=True).stdout


def test_help_is_what_plain_make_says_and_lists_every_target() -> None:
    listed = {line.split()[0] for line in make().splitlines()}
    declared = re.search(r"^\.PHONY: (.+)$", (ROOT / "Makefile").read_text(), re.MULTILINE)
    assert declared is not None
    assert listed == set(declared[1].split()) == PROMISED


@pytest.mark.parametrize("target", sorted(PROMISED - {"help", "clean", "setup"}))
def test_every_target_sets_up_first(target: str) -> None:
    commands = [line for line in make("--dry-run", target).splitlines() if line.strip()]
    assert commands[0] == "scripts/setup.sh"
    assert len(commands) > 1


def test_check_never_edits() -> None:
    commands = make("--dry-run", "check")
    assert "--fix" not in commands
    assert re.search(r"ruff format(?! --check)", commands) is None


def test_continuous_integration_runs_checks_and_tests() -> None:
    script = ROOT / ".ci" / "run"
    assert script.stat().st_mode & 0o111
    text = script.read_text()
    assert "make check" in text
    assert text.index("make check") < text.index("make test")
