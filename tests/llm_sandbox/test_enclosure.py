"""The walls around the service itself: what its process cannot do once it serves."""

from __future__ import annotations

import json
import os
import socket
import subprocess
import sys
from pathlib import Path

import landlockpy
import pytest

pytestmark = pytest.mark.skipif(sys.platform != "linux", reason="these are walls of Linux")

TRIES = """
import json, os, socket, sys
from querycad_sandbox.walls.enclosure import clean_environment, enclose
from querycad_sandbox.settings import SandboxSettings
settings = SandboxSettings.read()
clean_environment(settings)
layers = enclose(settings)
def attempt(name, call):
    try:
        call()
        found[name] = "done"
    except OSError as error:
        found[name] = type(error).__name__
found = {"variables": sorted(os.environ), "layers": layers}
attempt("read a file", lambda: open("/etc/passwd").read())
attempt("write a file", lambda: open(sys.argv[1] + "/written", "w"))
attempt("write a temporary file", lambda: open("/tmp/written", "w"))
attempt("connect to the broker", lambda: socket.create_connection(("127.0.0.1", int(sys.argv[2]))))
attempt("connect elsewhere", lambda: socket.create_connection(("127.0.0.1", int(sys.argv[3]))))
attempt("listen", lambda: socket.create_server(("127.0.0.1", 0)))
attempt("load what it needs later", lambda: __import__("querycad_sandbox.app"))
print(json.dumps(found))
"""


@pytest.mark.skipif(landlockpy.abi_version() < 4, reason="the kernel's Landlock knows no ports")
def test_a_service_reads_its_installation_and_reaches_its_broker_and_nothing_else(tmp_path: Path) -> None:
    script = tmp_path / "tries.py"
    script.write_text(TRIES, encoding="utf-8")
    with socket.create_server(("127.0.0.1", 0)) as broker, socket.create_server(("127.0.0.1", 0)) as other:
        ports = [str(each.getsockname()[1]) for each in (broker, other)]
        environment = {**os.environ, "QUERYCAD_REDIS_URL": f"redis://127.0.0.1:{ports[0]}/0", "A_SECRET": "hunter2"}
        command = [sys.executable, str(script), str(tmp_path), *ports]
        done = subprocess.run(command, env=environment, capture_output=True, text=True, timeout=60, check=False)
    assert done.returncode == 0, done.stderr
    found = json.loads(done.stdout)
    variables, layers = found.pop("variables"), found.pop("layers")
    assert "A_SECRET" not in variables
    assert "QUERYCAD_REDIS_URL" in variables
    assert layers.keys() == {"clean_environment", "unprivileged_user", "landlock"}
    assert layers["landlock"]
    assert {name for name, how in found.items() if how == "done"} == {
        "connect to the broker",
        "load what it needs later",
    }
    assert {how for how in found.values() if how != "done"} == {"PermissionError"}
