"""What the documentation and docstrings say lies somewhere does lie there."""

from __future__ import annotations

import ast
import re
from collections.abc import Iterator
from itertools import chain
from pathlib import Path

import pytest

ROOT = Path(__file__).parents[2]
PAGES = [*ROOT.glob("*.md"), *ROOT.glob("docs/**/*.md"), *ROOT.glob("benchmark/*.md")]
PACKAGES = [path.parent for top in ("packages", "services") for path in (ROOT / top).glob("*/*/py.typed")]
TOPS = [ROOT, *{path.parent for path in PACKAGES}, *PACKAGES]
PATH = re.compile(r"`((?:[\w-]+/)+[\w-]+\.(?:py|pyi|toml|md))`")
MODULE = re.compile(r"`(querycad_\w+(?:\.\w+)+)`")
HISTORY = "CHANGELOG.md"


def texts() -> Iterator[tuple[str, str]]:
    for page in PAGES:
        if page.name != HISTORY:
            yield str(page.relative_to(ROOT)), page.read_text(encoding="utf-8")
    for module in chain.from_iterable(package.rglob("*.py") for package in PACKAGES):
        tree = ast.parse(module.read_text(encoding="utf-8"))
        holders = (ast.Module, ast.FunctionDef, ast.ClassDef)
        said = [ast.get_docstring(node) or "" for node in ast.walk(tree) if isinstance(node, holders)]
        yield str(module.relative_to(ROOT)), "\n".join(said)


def is_there(name: str) -> bool:
    """Is it a module, a folder, or a name that one of them has?"""
    path, attributes = name.replace(".", "/"), list[str]()
    while path:
        for top in TOPS:
            if (top / path).is_dir() and not attributes:
                return True
            for module in (top / f"{path}.py", top / path / "__init__.py"):
                if module.exists():
                    return all(one in module.read_text(encoding="utf-8") for one in attributes)
        path, _, last = path.rpartition("/")
        attributes.append(last)
    return False


@pytest.mark.parametrize("kind", ["path", "module"])
def test_every_place_that_is_named_exists(kind: str) -> None:
    stale = []
    for where, text in texts():
        if kind == "path":
            stale += [(where, name) for name in PATH.findall(text) if not any((top / name).exists() for top in TOPS)]
        else:
            stale += [(where, name) for name in MODULE.findall(text) if not is_there(name)]
    assert stale == []
