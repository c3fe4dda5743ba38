"""Walls that are not up: no program runs, nothing is ready, unless a setting says so by name; and then it is told."""

from __future__ import annotations

import json
import subprocess
import sys
from pathlib import Path
from typing import Any, cast

import httpx
import landlockpy
import pytest
import seccompy

from querycad_contracts import PartFinder
from querycad_contracts.infrastructure import Walls, WallsMissing
from querycad_sandbox.app import make_app
from querycad_sandbox.sandbox import Sandbox
from querycad_sandbox.settings import SandboxSettings
from querycad_sandbox.walls import confinement
from querycad_sandbox.walls.confinement import Confinement

needs_walls = pytest.mark.skipif(
    not (sys.platform == "linux" and landlockpy.supported() and seccompy.supported()), reason="the kernel has not both"
)
NO_MODEL = cast("PartFinder", None)
RUN = """
import json
from querycad_sandbox.sandbox import Sandbox
with Sandbox(workers=1) as sandbox:
    outcome = sandbox.run("solution = 6 * 7", None)
    print(json.dumps({"layers": sandbox.layers, "value": outcome.value, "missing": outcome.walls_missing}))
"""


@pytest.fixture
def no_seccomp(monkeypatch: pytest.MonkeyPatch) -> None:
    def absent() -> bytes:
        raise OSError("the kernel has no seccomp")

    monkeypatch.setattr(confinement, "seccomp_program", absent)


@needs_walls
@pytest.mark.parametrize("folder", ["a folder", "f" * 200 + "/" + "g" * 200, "ü 'quoted' \"so\""])
def test_walls_are_up_whatever_the_path_of_the_installation(folder: str, tmp_path: Path) -> None:
    place = tmp_path / folder / "environment"
    place.parent.mkdir(parents=True)
    place.symlink_to(sys.prefix)
    command = [str(place / "bin" / "python"), "-c", RUN]
    done = subprocess.run(command, capture_output=True, text=True, timeout=60, check=False)
    assert done.returncode == 0, done.stderr
    told = json.loads(done.stdout)
    assert all(told["layers"].values())
    assert (told["value"], told["missing"]) == (42, [])


def test_without_a_wall_no_program_is_run(no_seccomp: None) -> None:
    with Sandbox(workers=1, walls=Walls.REQUIRED) as sandbox, pytest.raises(WallsMissing, match=r"seccomp.*available"):
        sandbox.run("solution = 1", NO_MODEL)


def test_no_wall_is_lost_with_another(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(Confinement, "_starts", lambda _: False)
    with Sandbox(workers=1, walls=Walls.REQUIRED) as sandbox, pytest.raises(WallsMissing, match="resource_limits"):
        sandbox.warm()
    assert not any(sandbox.layers[name] for name in ("empty_environment", "resource_limits", "unprivileged_user"))


def test_where_it_is_said_a_program_runs_without_a_wall_and_tells_so(no_seccomp: None) -> None:
    with Sandbox(workers=1, walls=Walls.AVAILABLE) as sandbox:
        outcome = sandbox.run("solution = 1", NO_MODEL)
    assert (outcome.value, outcome.walls_missing) == (1, ("seccomp",))


@pytest.mark.parametrize("walls", list(Walls))
def test_a_service_without_a_wall_is_ready_only_where_that_is_said(
    walls: Walls, no_seccomp: None, serving: Any, redis_url: str
) -> None:
    settings = SandboxSettings(redis_url=redis_url, sandbox_processes=1, sandbox_runs=1, walls=walls)
    with serving(make_app(settings)) as client:
        ready, ran = client.get("/readyz"), run(client)
    assert ready.json()["missing"] == ["seccomp"]
    assert ready.json()["walls"] == walls
    assert (ready.status_code, ran.status_code) == ((503, 503) if walls is Walls.REQUIRED else (200, 200))
    if walls is Walls.REQUIRED:
        assert ran.json()["title"] == "Walls missing"


def test_a_service_without_its_own_wall_is_not_ready(serving: Any, redis_url: str) -> None:
    settings = SandboxSettings(redis_url=redis_url, sandbox_processes=1, sandbox_runs=1)
    with serving(make_app(settings, service_layers={"landlock": False})) as client:
        assert client.get("/readyz").json()["missing"] == ["service_landlock"]
        assert run(client).status_code == 503


def run(client: httpx.Client) -> httpx.Response:
    return client.post("/runs", json={"model": "0" * 64, "code": "solution = 1"})


def test_a_command_without_a_wall_says_so_in_one_line(tmp_path: Path) -> None:
    script = (
        "from querycad_sandbox.walls import confinement\n"
        "confinement.Confinement._starts = lambda _: False\n"
        "import sys; from querycad.cli import main\n"
        "sys.exit(main(['ask', 'examples/flange.step', 'How many holes are there?']))\n"
    )
    done = subprocess.run([sys.executable, "-c", script], capture_output=True, text=True, timeout=120, check=False)
    last = done.stderr.strip().splitlines()[-1]
    assert (done.returncode, done.stdout) == (1, "")
    assert last.startswith("querycad: no program is run: these walls")
    assert "QUERYCAD_WALLS" in last
    assert "Traceback" not in done.stderr
