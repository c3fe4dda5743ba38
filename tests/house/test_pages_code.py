"""Every block of code on the pages for users runs, and prints what the page says."""

from __future__ import annotations

import json
import os
import re
import shlex
import shutil
import subprocess
import sys
from collections.abc import Iterator
from pathlib import Path

import pytest

ROOT = Path(__file__).parents[2]
PAGES = [ROOT / name for name in ("README.md", "docs/python.md", "docs/tutorial.md", "docs/mcp.md", "docs/install.md")]
PAGES += [ROOT / "packages/querycad/README.md"]
BLOCK = re.compile(r"(<!-- with a service -->\n)?^```(\w*)\n(.*?)^```", re.MULTILINE | re.DOTALL)
SERVED = "<!-- with a service -->\n"
ELSEWHERE = ("make ", "pip install ", "querycad serve", "querycad mcp", "docker compose ", "curl ")
"""Commands that other tests run: the targets, the wheels, the service, the MCP server, the containers."""
SHOWN = re.compile(r"^print\(.*\)  # (.+)$|^# (.+)$", re.MULTILINE)


def blocks(page: Path, language: str) -> list[str]:
    """Those that need no service; what the others do, tests/e2e and tests/querycad/test_model.py run."""
    found = BLOCK.findall(page.read_text(encoding="utf-8"))
    return [code for served, kind, code in found if kind == language and not served]


@pytest.fixture
def folder(tmp_path: Path) -> Path:
    """A folder with the examples in it, as a user has them; part.step is one of them."""
    shutil.copytree(ROOT / "examples", tmp_path / "examples", ignore=shutil.ignore_patterns("*.py", "*.png"))
    shutil.copy(ROOT / "examples/flange.step", tmp_path / "part.step")
    (tmp_path / "build").mkdir()
    return tmp_path


@pytest.fixture(autouse=True, scope="module")
def _home(tmp_path_factory: pytest.TempPathFactory) -> Iterator[None]:
    """What was read once is known to all pages."""
    with pytest.MonkeyPatch.context() as patch:
        patch.setenv("QUERYCAD_HOME", str(tmp_path_factory.mktemp("home")))
        yield


def run(arguments: list[str], folder: Path) -> subprocess.CompletedProcess[str]:
    environment = dict(os.environ)
    return subprocess.run(
        [sys.executable, *arguments], cwd=folder, env=environment, capture_output=True, text=True, check=False
    )


@pytest.mark.parametrize("page", PAGES, ids=lambda page: str(page.relative_to(ROOT)))
def test_the_python_of_a_page_prints_what_it_says(page: Path, folder: Path) -> None:
    code = "\n".join(blocks(page, "python"))
    if not code:
        pytest.skip("no Python on this page")
    expected = [first or second for first, second in SHOWN.findall(re.sub(r"^ +(?=print)", "", code, flags=re.M))]
    assert expected
    done = run(["-c", code], folder)
    assert done.returncode == 0, done.stderr
    assert done.stdout.splitlines() == expected


@pytest.mark.parametrize("page", PAGES, ids=lambda page: str(page.relative_to(ROOT)))
def test_the_commands_of_a_page_run(page: Path, folder: Path) -> None:
    lines = [line for block in blocks(page, "sh") for line in re.sub(r"\\\n", " ", block).splitlines() if line.strip()]
    assert lines or blocks(page, "python")
    for line in lines:
        if line.startswith(ELSEWHERE):
            continue
        words = shlex.split(line)
        assert words[0] == "querycad", line
        done = run(["-m", "querycad.cli", *words[1:]], folder)
        assert done.returncode == 0, f"{line}: {done.stderr}"
        assert done.stdout.strip(), line


def test_what_the_tutorial_shows_is_printed(folder: Path) -> None:
    (shown,) = blocks(ROOT / "docs/tutorial.md", "text")
    printed = run(["-m", "querycad.cli", "describe", "examples/gear_shaft.step"], folder).stdout.splitlines()
    assert {line for line in shown.splitlines() if line != "…"} <= set(printed)


def test_the_entry_for_agents_is_json_and_names_a_command() -> None:
    (entry,) = blocks(ROOT / "docs/mcp.md", "json")
    server = json.loads(entry)["mcpServers"]["querycad"]
    assert [server["command"], server["args"][0]] == ["querycad", "mcp"]


def test_every_block_has_a_language_that_is_run() -> None:
    for page in PAGES:
        assert {kind for _, kind, _ in BLOCK.findall(page.read_text(encoding="utf-8"))} <= {
            "python",
            "sh",
            "text",
            "json",
        }


def test_the_notebook_runs_and_prints_what_it_shows(folder: Path) -> None:
    notebook = json.loads((ROOT / "examples/first_steps.ipynb").read_text(encoding="utf-8"))
    cells = [cell for cell in notebook["cells"] if cell["cell_type"] == "code"]
    assert len(cells) >= 5
    sources = ["".join(cell["source"]) for cell in cells]
    code = f"""
import io, json, contextlib
from IPython.core.interactiveshell import InteractiveShell
from IPython.utils.capture import capture_output
shell = InteractiveShell.instance()
told = []
for source in {sources!r}:
    with capture_output() as caught:
        result = shell.run_cell(source, silent=False)
    result.raise_error()
    shown = result.result
    rich = shown is not None and any(hasattr(shown, name) for name in ("_repr_html_", "_repr_png_"))
    if rich:
        assert shell.display_formatter.format(shown)[0].keys() & {{"text/html", "image/png"}}
    told.append(caught.stdout if shown is None else "")
print(json.dumps(told))
"""
    (folder / "examples").mkdir(exist_ok=True)
    done = run(["-c", code], folder / "examples")
    assert done.returncode == 0, done.stderr
    printed = json.loads(done.stdout.splitlines()[-1])
    for cell, text in zip(cells, printed, strict=True):
        stored = "".join(line for out in cell["outputs"] if out["output_type"] == "stream" for line in out["text"])
        assert text == stored
