"""The sandbox's port: who knows the token may ask for runs, and without one this machine's own processes alone."""

from __future__ import annotations

import os
import subprocess
import sys
from collections.abc import Callable
from typing import Any

import httpx
import pytest
from pydantic import SecretStr

from querycad_sandbox.app import make_app
from querycad_sandbox.settings import SandboxSettings

RUN = {"model": "0" * 64, "code": "solution = 6 * 7"}


@pytest.fixture
def door(serving: Any, redis_url: str) -> Callable[[str], Any]:
    def opened(token: str) -> Any:
        settings = SandboxSettings(redis_url=redis_url, sandbox_processes=1, sandbox_runs=1)
        return serving(make_app(settings.model_copy(update={"sandbox_token": SecretStr(token)})))

    return opened


def ask(client: httpx.Client, **headers: str) -> int:
    sent = {name.replace("_", "-"): value for name, value in headers.items()}
    return client.post("/runs", json=RUN, headers=sent).status_code


def test_with_a_token_nobody_else_runs_or_ends_a_program(door: Callable[[str], Any]) -> None:
    with door("secret") as client:
        assert ask(client) == ask(client, authorization="Bearer guess") == ask(client, authorization="secrets") == 401
        assert client.delete("/runs/" + "0" * 32).status_code == 401
        assert ask(client, authorization="Bearer secret") == 200
        assert ask(client, authorization="Bearer secret", host="sandbox:8101") == 200
        assert client.get("/readyz").status_code == 200


def test_no_page_of_a_browser_runs_a_program(door: Callable[[str], Any]) -> None:
    with door("") as client:
        assert ask(client) == 200
        assert ask(client, origin="http://127.0.0.1:8101") == ask(client, origin="null") == 403
        assert ask(client, host="rebound.example:8101") == 403
        assert ask(client, content_type="text/plain") == 415
        assert ask(client, content_type="application/json; charset=utf-8") == 200


def test_a_sandbox_that_others_can_reach_does_not_start_without_a_token(redis_url: str) -> None:
    environment = os.environ | {"QUERYCAD_REDIS_URL": redis_url, "QUERYCAD_SANDBOX_HOST": "0.0.0.0"}  # noqa: S104
    command = [sys.executable, "-m", "querycad_sandbox.service"]
    done = subprocess.run(command, capture_output=True, text=True, timeout=60, check=False, env=environment)
    assert done.returncode == 1
    assert "QUERYCAD_SANDBOX_TOKEN is needed" in done.stderr
    assert "Traceback" not in done.stderr
