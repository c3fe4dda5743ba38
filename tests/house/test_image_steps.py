"""The Dockerfiles' own install steps, run without an engine: what they install is enough for the service to start."""

from __future__ import annotations

import os
import shlex
import shutil
import subprocess
import sys
from pathlib import Path

import pytest
import yaml

ROOT = Path(__file__).parents[2]
SERVICES = yaml.safe_load((ROOT / "docker-compose.yml").read_text(encoding="utf-8"))["services"]
DOCKERFILES = sorted(ROOT.glob("services/*/Dockerfile"))

pytestmark = pytest.mark.skipif(sys.platform != "linux", reason="the containers' system")


def instructions(dockerfile: Path) -> list[tuple[str, str]]:
    lines = [line for line in dockerfile.read_text(encoding="utf-8").splitlines() if not line.lstrip().startswith("#")]
    whole = "\n".join(lines).replace("\\\n", " ")
    return [(name, rest.strip()) for name, _, rest in (line.partition(" ") for line in whole.splitlines() if line)]


def copy(rest: str, context: Path, workdir: Path, root: Path) -> None:
    """As COPY does: folders by what is in them, into the work folder or an absolute place under the new root."""
    *sources, target = rest.split()
    place = root / target.lstrip("/") if target.startswith("/") else workdir / target
    for source in sources:
        if (context / source).is_dir():
            shutil.copytree(context / source, place, dirs_exist_ok=True)
        else:
            place.mkdir(parents=True, exist_ok=True)
            shutil.copy(context / source, place)


@pytest.mark.parametrize("path", DOCKERFILES, ids=lambda path: path.parent.name)
def test_what_an_image_installs_is_enough_for_its_services(path: Path, tmp_path: Path) -> None:
    root, work = tmp_path / "root", tmp_path / "root/build"
    work.mkdir(parents=True)
    venv = root / "opt/venv"
    subprocess.run([sys.executable, "-m", "venv", "--without-pip", str(venv)], check=True)
    environment = os.environ | {"PATH": f"{Path(sys.executable).parent}:{os.environ['PATH']}"}
    ran = 0
    for name, rest in instructions(path):
        if name == "COPY" and "--from=" not in rest:
            copy(rest, ROOT, work, root)
        elif name == "RUN" and "> direct.in" in rest:
            # another root, and what was downloaded before is not downloaded again
            step = rest.replace("/opt/venv", shlex.quote(str(venv))).replace("--no-cache", "")
            done = subprocess.run(["sh", "-ec", step], cwd=work, env=environment, capture_output=True, text=True)  # noqa: PLW1510
            assert done.returncode == 0, done.stderr
            ran += 1
    assert ran == 1
    modules = {
        service["command"][-1]
        for service in SERVICES.values()
        if "build" in service and service["build"]["dockerfile"] == str(path.relative_to(ROOT))
    }
    for module in modules:
        started = subprocess.run(
            [str(venv / "bin/python"), "-c", f"import {module}"],
            cwd=root / "app",
            env={"PATH": "/usr/bin:/bin", "PYTHONPATH": str(root / "app"), "HOME": str(tmp_path)},
            capture_output=True,
            text=True,
            check=False,
        )
        assert started.returncode == 0, started.stderr
