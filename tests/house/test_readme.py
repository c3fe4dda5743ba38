"""What README and docs tell to type works, and what they link to exists."""

from __future__ import annotations

import os
import re
import shlex
import subprocess
import sys
from pathlib import Path

import pytest

ROOT = Path(__file__).parents[2]
PAGES = sorted([*ROOT.glob("*.md"), *ROOT.glob("docs/**/*.md"), *ROOT.glob("examples/*.md")])
README = (ROOT / "README.md").read_text()
BLOCKS = re.findall(r"^```sh\n(.*?)^```", README, re.MULTILINE | re.DOTALL)
COMMANDS = [line for block in BLOCKS for line in block.splitlines()]
ASKED = [line for line in COMMANDS if line.startswith("querycad ask ")]


def querycad(line: str, folder: Path) -> subprocess.CompletedProcess[str]:
    arguments = [str(folder / word) if word.startswith("build/") else word for word in shlex.split(line)[1:]]
    code = "import sys; from querycad.cli import main; sys.exit(main())"
    command = [sys.executable, "-c", code, *arguments]
    environment = os.environ | {"QUERYCAD_HOME": str(folder / "home")}
    return subprocess.run(command, cwd=ROOT, env=environment, capture_output=True, text=True, check=False, timeout=120)


def test_the_first_commands_are_two_targets_of_the_makefile() -> None:
    assert COMMANDS[:2] == ["make demo", "make test"]


def test_the_targets_that_are_named_exist() -> None:
    targets = set(re.findall(r"^([a-z]+):", (ROOT / "Makefile").read_text(), re.MULTILINE))
    table = re.findall(r"^\| (`[a-z`, ]+`) \|", README, re.MULTILINE)
    named = {word for row in table for word in re.findall(r"`([a-z]+)`", row)}
    assert {"setup", "demo", "test", "check", "serve", "bench", "openapi"} <= named
    assert named <= targets


def test_make_demo_asks_what_the_readme_shows() -> None:
    planned = subprocess.run(["make", "--dry-run", "demo"], cwd=ROOT, capture_output=True, text=True, check=True).stdout
    assert ASKED[0] in planned


@pytest.mark.parametrize("line", ASKED)
def test_a_question_of_the_readme_is_answered(line: str, tmp_path: Path) -> None:
    (tmp_path / "build").mkdir()
    result = querycad(line, tmp_path)
    assert result.returncode == 0, result.stderr
    assert result.stdout.strip()
    if "--picture" in line:
        assert (tmp_path / "build" / "demo.png").read_bytes().startswith(b"\x89PNG")


def test_the_demo_prints_what_the_readme_shows(tmp_path: Path) -> None:
    """Line by line, but for times and the confidence of the last fit; where the page has '…', lines are left out."""
    shown = re.search(r"<!-- demo output: begin -->\n```text\n(.*?)```", README, re.DOTALL)
    assert shown is not None
    (tmp_path / "build").mkdir()
    printed = querycad(ASKED[0], tmp_path).stdout.replace(f"{tmp_path}/", "")
    lines = [".*" if line.strip() == "…" else re.escape(line) for line in shown[1].splitlines()]
    pattern = re.sub(r"\d+\\\.\d+(?=\\ ms|\\\))", r"\\d+\\.\\d+", "\n".join(lines))
    assert re.fullmatch(pattern, printed.rstrip("\n"), re.DOTALL), printed


@pytest.mark.parametrize("page", PAGES, ids=lambda page: str(page.relative_to(ROOT)))
def test_links_lead_to_files(page: Path) -> None:
    text = page.read_text()
    targets = re.findall(r"\]\(([^)#\s]+)", text) + re.findall(r'src="([^"]+)"', text)
    missing = [target for target in targets if "://" not in target and not (page.parent / target).exists()]
    assert missing == []
