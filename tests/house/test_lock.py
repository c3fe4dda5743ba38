"""requirements.lock pins everything, by hash, and says nothing of where it comes from."""

from __future__ import annotations

import json
import re
import tomllib
from pathlib import Path
from typing import Any

import pytest
from packaging.requirements import Requirement
from packaging.utils import canonicalize_name
from packaging.version import Version

ROOT = Path(__file__).parents[2]
LOCK = (ROOT / "requirements.lock").read_text()
ENTRY = re.compile(
    r"^(?P<name>[a-z0-9.-]+)==(?P<version>[^ ;]+)(?: ;[^\\]+)? \\\n(?:    --hash=.*\n)+",
    re.MULTILINE,
)
PINNED = {match["name"]: Version(match["version"]) for match in ENTRY.finditer(LOCK)}
PROJECTS = sorted([*ROOT.glob("packages/*/pyproject.toml"), *ROOT.glob("services/*/pyproject.toml")])


def read(path: Path) -> dict[str, Any]:
    return tomllib.loads(path.read_text())


def declared() -> list[tuple[str, Requirement]]:
    own = {read(path)["project"]["name"] for path in PROJECTS}
    found = [
        (path.parent.name, Requirement(line)) for path in PROJECTS for line in read(path)["project"]["dependencies"]
    ]
    groups = read(ROOT / "pyproject.toml")["dependency-groups"]
    locked = [groups[entry["include-group"]] for entry in groups["dev"]]  # `parity` is installed by itself
    found += [("development", Requirement(line)) for group in locked for line in group]
    return [(where, requirement) for where, requirement in found if requirement.name not in own]


def test_every_line_belongs_to_a_pinned_and_hashed_entry() -> None:
    assert len(PINNED) > 50
    rest = ENTRY.sub("", LOCK)
    assert rest.strip() == ""
    hashes = [line for line in LOCK.splitlines() if line.startswith(" ")]
    assert all(re.fullmatch(r"    --hash=sha256:[0-9a-f]{64}( \\)?", line) for line in hashes)


@pytest.mark.parametrize("word", ["://", "--index", "--extra-index", "--find-links", " @ ", "file:", "-e "])
def test_no_address_or_index_is_recorded(word: str) -> None:
    assert word not in LOCK


def test_the_projects_own_packages_are_installed_from_the_tree() -> None:
    assert not [name for name in PINNED if name.startswith("querycad")]


@pytest.mark.parametrize(("where", "requirement"), declared(), ids=str)
def test_each_declared_dependency_is_pinned_within_its_range(where: str, requirement: Requirement) -> None:
    version = PINNED.get(canonicalize_name(requirement.name))
    assert version is not None, f"{where} needs {requirement}: run `make lock`"
    assert version in requirement.specifier


def test_the_pages_packages_are_pinned_by_hash_without_where_they_come_from() -> None:
    lock = json.loads((ROOT / "web/package-lock.json").read_text())["packages"]
    wanted = json.loads((ROOT / "web/package.json").read_text())
    named = {**wanted["dependencies"], **wanted["devDependencies"]}
    assert {name: lock[f"node_modules/{name}"]["version"] for name in named} == named
    packages = [entry for place, entry in lock.items() if place]
    assert all(entry["integrity"].startswith("sha512-") for entry in packages)
    assert not any("resolved" in entry for entry in packages)


def test_no_deep_learning_framework_comes_along() -> None:
    assert not {"torch", "tensorflow", "jax"} & set(PINNED)
