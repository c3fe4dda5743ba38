"""Every package says what it needs, is typed, and has the one version."""

from __future__ import annotations

import ast
import re
import subprocess
import sys
import tomllib
from importlib import metadata
from itertools import chain
from pathlib import Path
from typing import Any

import pytest
from packaging.requirements import Requirement
from packaging.utils import canonicalize_name

ROOT = Path(__file__).parents[2]
VERSION = (ROOT / "VERSION").read_text().strip()
PROJECTS = sorted([*ROOT.glob("packages/*/pyproject.toml"), *ROOT.glob("services/*/pyproject.toml")])
DISTRIBUTIONS = metadata.packages_distributions()


def read(project: Path) -> dict[str, Any]:
    return tomllib.loads(project.read_text())


def module_of(project: Path) -> Path:
    (name,) = read(project)["tool"]["hatch"]["build"]["targets"]["wheel"]["packages"]
    return project.parent / str(name)


def imported(module: Path) -> set[str]:
    """Top-level names that the sources import, outside the standard library and the package itself."""
    names = set()
    for path in module.rglob("*.py"):
        for node in ast.walk(ast.parse(path.read_text())):
            if isinstance(node, ast.Import):
                names |= {alias.name.partition(".")[0] for alias in node.names}
            elif isinstance(node, ast.ImportFrom) and node.level == 0 and node.module:
                names.add(node.module.partition(".")[0])
    return names - sys.stdlib_module_names - {module.name}


def test_there_are_seven_packages() -> None:
    assert {module_of(project).name for project in PROJECTS} == {
        "querycad",
        "querycad_answering",
        "querycad_api",
        "querycad_contracts",
        "querycad_language",
        "querycad_sandbox",
        "querycad_segworker",
    }


@pytest.mark.parametrize("project", PROJECTS, ids=lambda project: project.parent.name)
def test_a_package_declares_what_it_imports(project: Path) -> None:
    said = read(project)["project"]
    lines = [*said["dependencies"], *chain.from_iterable(said.get("optional-dependencies", {}).values())]
    declared = {canonicalize_name(Requirement(line).name) for line in lines}
    for name in imported(module_of(project)):
        # a distribution of the import's own name may be a shell about the one that holds the files
        provided_by = {canonicalize_name(distribution) for distribution in [*DISTRIBUTIONS.get(name, []), name]}
        assert provided_by & declared, f"{project.parent.name} imports {name}"


@pytest.mark.parametrize("project", PROJECTS, ids=lambda project: project.parent.name)
def test_a_package_is_typed_and_takes_its_version_from_the_one_place(project: Path) -> None:
    settings = read(project)
    assert (module_of(project) / "py.typed").exists()
    assert settings["project"]["dynamic"] == ["version"]
    version = settings["tool"]["hatch"]["version"]
    source = (project.parent / version["path"]).resolve()
    assert source == ROOT / "VERSION"
    found = re.search(version["pattern"], source.read_text())
    assert found is not None
    assert found["version"] == VERSION


def test_the_installed_command_has_that_version() -> None:
    try:
        installed = metadata.version("querycad")
    except metadata.PackageNotFoundError:
        pytest.skip("the packages are on the path but not installed; `make test` installs them")
    assert installed == VERSION


def test_starting_the_command_loads_no_cad_kernel() -> None:
    code = "import sys, querycad.cli; print(sorted({'OCP', 'build123d', 'scipy', 'sklearn'} & set(sys.modules)))"
    result = subprocess.run([sys.executable, "-c", code], capture_output=True, text=True, check=True)
    assert result.stdout.strip() == "[]"
