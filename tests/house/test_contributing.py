"""The examples of CONTRIBUTING.md can be followed: on a copy each applies, passes the linter, and passes its tests."""

from __future__ import annotations

import ast
import os
import re
import shutil
import subprocess
import sys
from collections.abc import Iterator
from itertools import chain
from pathlib import Path

import pytest

ROOT = Path(__file__).parents[2]
PAGE = (ROOT / "CONTRIBUTING.md").read_text(encoding="utf-8")
PROSE = re.sub(r"^```.*?^```$", "", PAGE, flags=re.MULTILINE | re.DOTALL)
EXAMPLES = dict(re.findall(r"^### (.+?)\n(.*?)(?=^### |\Z)", PAGE, re.MULTILINE | re.DOTALL))
COPIED = ("packages", "services", "tests", "docs", "examples")
NAMED = re.findall(r"`([\w./]+(?:/|\.py|\.pyi|\.toml|\.md))(?::(\w+))?`", PROSE)
SOURCES = [
    path.read_text(encoding="utf-8")
    for path in [
        ROOT / "pyproject.toml",
        *(p for top in ("packages", "services", "tests") for p in (ROOT / top).rglob("*.py")),
    ]
    if path != Path(__file__)
]
MAX_LINES = 150
MAX_STEPS = 9


def steps(example: str) -> str:
    """An example without its code."""
    return re.sub(r"^```.*?^```$", "", example, flags=re.MULTILINE | re.DOTALL)


def places(name: str) -> Iterator[Path]:
    """Where a file or folder is that is named from the root, from its package, or alone."""
    tops = [ROOT, *ROOT.glob("packages/*"), *ROOT.glob("services/*")]
    found = [top / name for top in tops if (top / name).exists()]
    yield from found
    if not found and "/" not in name:
        yield from chain.from_iterable((ROOT / top).rglob(name) for top in ("packages", "services"))


def defined(path: Path) -> set[str]:
    """The names that a module defines at its top."""
    names = set()
    for node in ast.parse(path.read_text(encoding="utf-8")).body:
        if isinstance(node, ast.FunctionDef | ast.ClassDef):
            names.add(node.name)
        names |= {one.id for one in ast.walk(node) if isinstance(one, ast.Name) and isinstance(one.ctx, ast.Store)}
    return names


@pytest.mark.parametrize(("name", "symbol"), sorted(set(NAMED)))
def test_every_file_that_is_named_is_there_with_what_it_defines(name: str, symbol: str) -> None:
    found = list(places(name))
    assert found, f"no {name}"
    assert not symbol or symbol in defined(found[0]), f"no {symbol} in {name}"


@pytest.mark.parametrize("name", sorted(set(re.findall(r"`([A-Za-z_]\w*)`", "".join(map(steps, EXAMPLES.values()))))))
def test_every_name_in_a_step_is_one_of_the_sources(name: str) -> None:
    pattern = rf"^class {name}\b" if name[0].isupper() else rf"\b{name}\b"
    assert any(re.search(pattern, source, re.MULTILINE) for source in SOURCES), name


@pytest.mark.parametrize("name", ["chamfer_size"])
def test_a_field_named_as_a_pattern_is_in_both_kinds_of_parts(name: str) -> None:
    assert f"`{name}`" in PROSE
    for path in ("geometry.py", "guest_api.pyi"):
        assert re.search(
            rf"^    {name}: float", (ROOT / "packages/contracts/querycad_contracts" / path).read_text(), re.M
        )


def test_the_page_stays_short_and_its_examples_too() -> None:
    assert len(PAGE.splitlines()) <= MAX_LINES
    assert len(EXAMPLES) == 4
    for text in EXAMPLES.values():
        assert 2 <= len(re.findall(r"^\d\. ", text, re.MULTILINE)) <= MAX_STEPS


def parts(text: str) -> Iterator[tuple[str, str, list[str]]]:
    """What an example does to files: '---' to change or '+++' to add, the path, the lines."""
    for block in re.findall(r"^```diff\n(.*?)^```$", text, re.MULTILINE | re.DOTALL):
        for head in re.split(r"^(?=(?:---|\+\+\+) )", block, flags=re.MULTILINE)[1:]:
            first, *lines = head.splitlines()
            how, path = first.split(" ")
            yield how, path, lines


def change(path: Path, lines: list[str]) -> None:
    """Applies a diff without line numbers: what it says is old must be in the file, once."""
    text = path.read_text(encoding="utf-8")
    for old, new in hunks(lines):
        assert text.count(old) == 1, f"{path.name} has {text.count(old)} times:\n{old}"
        text = text.replace(old, new)
    path.write_text(text, encoding="utf-8")


def add(path: Path, lines: list[str]) -> None:
    """Puts lines at the end of a file, or makes it of them."""
    assert path.parent.exists(), path
    assert all(line.startswith("+") for line in lines)
    before = path.read_text(encoding="utf-8") + "\n\n" if path.exists() else ""
    path.write_text(before + "\n".join(line[1:] for line in lines) + "\n", encoding="utf-8")


def hunks(lines: list[str]) -> Iterator[tuple[str, str]]:
    """Old and new text of each group of context and change; one ends where what follows is no longer added."""
    old: list[str] = []
    new: list[str] = []
    for index, line in enumerate(lines):
        if line[0] in " -":
            old.append(line[1:])
        if line[0] in " +":
            new.append(line[1:])
        after = lines[index + 1][0] if index + 1 < len(lines) else None
        if after is None or (line[0] == "+" and after != "+" and old):
            yield "\n".join(["", *old, ""]), "\n".join(["", *new, ""])
            old, new = [], []


def overlay(tree: Path) -> None:
    """A copy of the sources and of the data that their tests read."""
    ignored = shutil.ignore_patterns("__pycache__", "*.step", "*.png")
    for folder in COPIED:
        shutil.copytree(ROOT / folder, tree / folder, ignore=ignored)
    for name in ("pyproject.toml", "VERSION"):
        shutil.copy(ROOT / name, tree)


def run_in(tree: Path, *module: str) -> subprocess.CompletedProcess[str]:
    """Runs a module of Python on the copy."""
    folders = [*tree.glob("packages/*"), *tree.glob("services/*")]
    return subprocess.run(
        [sys.executable, "-m", *module], cwd=tree, capture_output=True, text=True, check=False,
        env={**os.environ, "PYTHONPATH": os.pathsep.join(map(str, folders)), "PYTHONDONTWRITEBYTECODE": "1"},
    )  # fmt: skip


def test_all_examples_can_be_followed(tmp_path: Path) -> None:
    overlay(tmp_path)
    chosen, written = [], set()
    for name, text in EXAMPLES.items():
        added = [path for how, path, _ in parts(text) if how == "+++"]
        assert any(path.startswith("tests/") for path in added), f"{name}: no test"
        for how, path, lines in parts(text):
            (change if how == "---" else add)(tmp_path / path, lines)
            written |= {path} if path.endswith(".py") else set()
            if path.startswith("tests/"):
                chosen += [f"{path}::{found[1]}" for line in lines if (found := re.match(r"\+def (test_\w+)", line))]
    for lint in (("check",), ("format", "--diff")):
        linted = run_in(tmp_path, "ruff", *lint, "--no-cache", *sorted(written))
        assert linted.returncode == 0, linted.stdout + linted.stderr
    done = run_in(tmp_path, "pytest", "-q", "-p", "no:cacheprovider", *chosen)
    assert done.returncode == 0, done.stdout[-3000:] + done.stderr
    assert len(chosen) >= len(EXAMPLES)
    assert f"{len(chosen)} passed" in done.stdout
