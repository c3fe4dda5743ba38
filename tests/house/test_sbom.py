"""The bill of materials names everything that the lock files pin, and no place where it came from."""

from __future__ import annotations

import json
import re
import subprocess
import sys
from importlib import metadata
from pathlib import Path
from typing import Any

import pytest
from packaging.utils import canonicalize_name

ROOT = Path(__file__).parents[2]


def written() -> str:
    return subprocess.run(
        [sys.executable, str(ROOT / "scripts/sbom.py")], check=True, capture_output=True, text=True, timeout=60
    ).stdout


@pytest.fixture(scope="module")
def text() -> str:
    return written()


@pytest.fixture(scope="module")
def sbom(text: str) -> dict[str, Any]:
    return dict(json.loads(text))


def test_every_pinned_package_that_is_installed_is_there_with_its_version(sbom: dict[str, Any]) -> None:
    pinned = set(re.findall(r"^([a-z0-9._-]+)==([^ ;]+)", (ROOT / "requirements.lock").read_text(), re.MULTILINE))
    installed = {canonicalize_name(each.name) for each in metadata.distributions()}
    listed = {(one["name"], one["version"]) for one in sbom["components"]}
    assert len(pinned) > 150
    assert {(name, version) for name, version in pinned if canonicalize_name(name) in installed} <= listed


def test_what_runs_is_told_apart_from_what_only_builds_and_tests(sbom: dict[str, Any]) -> None:
    scopes = {one["name"]: one["scope"] for one in sbom["components"]}
    assert {scopes[name] for name in ("cadquery-ocp-novtk", "uvicorn", "onnxruntime", "mcp", "querycad-api")} == {
        "required"
    }
    assert {scopes[name] for name in ("pytest", "ruff", "quiddity", "axe-core")} == {"excluded"}
    assert scopes["three"] == "required"


def test_references_are_unique_and_lead_to_components(sbom: dict[str, Any]) -> None:
    root = sbom["metadata"]["component"]["bom-ref"]
    refs = [root, *(one["bom-ref"] for one in sbom["components"])]
    assert len(refs) == len(set(refs))
    needed = {one["ref"]: one["dependsOn"] for one in sbom["dependencies"]}
    assert {each for others in needed.values() for each in others} | set(needed) <= set(refs)
    assert len(needed[root]) > 3


def test_nearly_all_say_their_licence(sbom: dict[str, Any]) -> None:
    assert sum("licenses" not in one for one in sbom["components"]) < 10


def test_the_same_environment_gives_the_same_text_without_addresses(text: str) -> None:
    assert "://" not in text
    assert text == written()
