"""Setting up finds a Python that runs, or says what is missing."""

from __future__ import annotations

import hashlib
import shutil
import subprocess
import sys
from pathlib import Path

import pytest

ROOT = Path(__file__).parents[2]
TOOLS = ["sh", "dirname", "pwd", "cat", "sha256sum", "id", "awk", "rm", "ls"]
PACKAGES = [
    "packages/contracts",
    "packages/language",
    "packages/answering",
    "packages/querycad",
    "services/api",
    "services/segworker",
    "services/llm_sandbox",
]
INPUTS = ["requirements.lock", "VERSION", "scripts/setup.sh", *(f"{package}/pyproject.toml" for package in PACKAGES)]


@pytest.fixture
def clone(tmp_path: Path) -> Path:
    """A tree with all that setup reads, and a folder `bin` that stands for PATH: the usual tools, but no Python."""
    for name in INPUTS:
        (tmp_path / name).parent.mkdir(parents=True, exist_ok=True)
        shutil.copy2(ROOT / name, tmp_path / name)
    (tmp_path / "bin").mkdir()
    for tool in TOOLS:
        found = shutil.which(tool)
        assert found, f"this machine has no {tool}"
        (tmp_path / "bin" / tool).symlink_to(found)
    return tmp_path


def script(path: Path, *lines: str) -> None:
    path.write_text("\n".join(["#!/bin/sh", *lines]) + "\n")
    path.chmod(0o755)


def set_up(clone: Path) -> subprocess.CompletedProcess[str]:
    environment = {"PATH": str(clone / "bin")}
    return subprocess.run(["scripts/setup.sh"], cwd=clone, env=environment, capture_output=True, text=True, check=False)


def test_without_a_python_it_says_which_one_it_needs(clone: Path) -> None:
    result = set_up(clone)
    assert result.returncode == 1
    assert "no Python from 3.11 to 3.14 found" in result.stderr
    assert len(result.stderr.splitlines()) == 1


def test_a_shim_that_does_not_run_and_an_old_python_are_passed_over(clone: Path) -> None:
    script(clone / "bin" / "python3.14", "exit 127")
    script(clone / "bin" / "python3", 'echo "no version of mine" >&2', "exit 1")
    assert "no Python from 3.11 to 3.14 found" in set_up(clone).stderr


def test_a_python_that_cannot_make_environments_is_named_with_the_package_that_mends_it(clone: Path) -> None:
    # a Python as Debian ships it: complete but for ensurepip
    script(
        clone / "bin" / "python3.11",
        f'case "$2" in *ensurepip*) exit 1 ;; *) exec {sys.executable} "$@" ;; esac',
    )
    result = set_up(clone)
    assert result.returncode == 1
    assert "apt-get install python3." in result.stderr
    assert "-venv" in result.stderr


def test_a_finished_setup_is_not_done_again(clone: Path) -> None:
    (clone / ".venv" / "bin").mkdir(parents=True)
    script(clone / ".venv" / "bin" / "python", f'exec {sys.executable} "$@"')
    state = hashlib.sha256(f"{clone}\n".encode() + b"".join((clone / name).read_bytes() for name in INPUTS))
    (clone / ".venv" / "setup-stamp").write_text(f"{state.hexdigest()}  -\n")
    result = set_up(clone)
    assert result.returncode == 0
    assert "installing what" not in result.stderr
    assert "made .venv" not in result.stderr
    assert "ready" not in result.stderr
