"""`querycad keys` as docs/service.md tells it, and what `querycad serve` makes of keys."""

from __future__ import annotations

import os
import re
import shlex
import subprocess
import sys
from pathlib import Path

import pytest

from querycad.serve import reached_at
from querycad_api.accounts.keys import KeyRing

ROOT = Path(__file__).parents[2]
TOLD = re.findall(r"^querycad (keys .*)$", (ROOT / "docs/service.md").read_text(encoding="utf-8"), re.MULTILINE)


def querycad(home: Path, *arguments: str, **variables: str) -> subprocess.CompletedProcess[str]:
    command = [sys.executable, "-m", "querycad.cli", *arguments]
    environment = os.environ | {"QUERYCAD_HOME": str(home)} | variables
    return subprocess.run(command, env=environment, capture_output=True, text=True, timeout=60, check=False)


def test_what_is_told_of_keys_works(tmp_path: Path) -> None:
    create, list_, revoke = TOLD
    made = querycad(tmp_path, *shlex.split(create))
    key = made.stdout.strip()
    assert KeyRing(tmp_path / "keys.json").find(key) is not None
    assert "acme" in querycad(tmp_path, *shlex.split(list_)).stdout
    *words, _ = shlex.split(revoke)
    assert querycad(tmp_path, *words, key.split("_")[1]).returncode == 0
    assert KeyRing(tmp_path / "keys.json").find(key) is None


@pytest.mark.parametrize(
    ("variables", "said"), [({"QUERYCAD_AUTH": "0"}, "QUERYCAD_AUTH is off"), ({}, "there is no API key yet")]
)
def test_a_service_for_others_does_not_start_without_keys(tmp_path: Path, variables: dict[str, str], said: str) -> None:
    done = querycad(tmp_path, "serve", "--host", "0.0.0.0", "--port", "0", **variables)  # noqa: S104 - it is refused
    assert done.returncode == 2
    assert said in done.stderr


@pytest.mark.parametrize(
    ("arguments", "variables", "said"),
    [
        (["--port", "65536"], {}, "--port: must be between 0 and 65535"),
        ([], {"QUERYCAD_KEY_RATE": "lots"}, "QUERYCAD_KEY_RATE: "),
        (["--host", "::1"], {"QUERYCAD_AUTH": "1"}, "there is no API key yet"),
    ],
)
def test_what_serve_cannot_start_with_is_said_in_a_line(
    tmp_path: Path, arguments: list[str], variables: dict[str, str], said: str
) -> None:
    done = querycad(tmp_path, "serve", "--port", "0", *arguments, **variables)
    assert done.returncode == 2
    assert said in done.stderr
    assert "Traceback" not in done.stderr


@pytest.mark.parametrize(
    ("host", "url"),
    [("127.0.0.1", "http://127.0.0.1:80"), ("0.0.0.0", "http://127.0.0.1:80"), ("::", "http://[::1]:80")],  # noqa: S104
)
def test_serve_says_where_it_is_reached_from_this_machine(host: str, url: str) -> None:
    assert reached_at(host, 80) == url
