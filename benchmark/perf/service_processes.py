"""A service of one's own to measure or to hurt: `querycad serve` on a free port, its data in a folder that is given."""

from __future__ import annotations

import contextlib
import os
import signal
import subprocess
import sys
import time
from collections.abc import Iterator, Mapping
from contextlib import contextmanager
from pathlib import Path

import psutil

from querycad_contracts.infrastructure import end_with_parent

START_S = 120.0
STOP_S = 60.0
_READY = "ready at "


class ServiceTrouble(Exception):
    """The service did not start, or did not come back."""


class Service:
    """A running `querycad serve`."""

    def __init__(self, process: subprocess.Popen[bytes], url: str, home: Path) -> None:
        self._process = process
        self.home = home
        self.main_pid = process.pid
        self.url = url

    def pid(self, module: str, queue: str = "") -> int:
        """The child that runs the module, on that queue where one is given. Raises ServiceTrouble."""
        for child in psutil.Process(self._process.pid).children():
            try:
                line, variables = child.cmdline(), child.environ()
            except psutil.Error:
                continue
            runs = any(part == module or f"/{module}" in part for part in line)  # the store writes more into its title
            if runs and (not queue or variables.get("QUERYCAD_SEGWORKER_QUEUES") == queue):
                return child.pid
        raise ServiceTrouble(f"{module} does not run")

    def processor_s(self) -> float:
        """How much processor time have the service's processes used, all together?"""
        used = 0.0
        for process in psutil.Process(self._process.pid).children(recursive=True):
            with contextlib.suppress(psutil.Error):
                times = process.cpu_times()
                used += times.user + times.system
        return used

    def kill(self, module: str, queue: str = "") -> None:
        """Kills a child as a crash would."""
        os.kill(self.pid(module, queue), signal.SIGKILL)

    def pause(self, module: str, queue: str = "", seconds: float = 3.0) -> None:
        """Stops a child and all that it has started for a while, as a machine that swaps would."""
        child = psutil.Process(self.pid(module, queue))
        stopped = [child, *child.children(recursive=True)]
        for process in stopped:
            with contextlib.suppress(psutil.Error):
                process.suspend()
        time.sleep(seconds)
        for process in stopped:
            with contextlib.suppress(psutil.Error):
                process.resume()

    def inner(self) -> list[psutil.Process]:
        """What the service's processes have started themselves: tasks' processes, interpreters, the kernel's."""
        children = psutil.Process(self._process.pid).children()
        return [process for child in children for process in child.children(recursive=True)]

    def restart_store(self) -> None:
        """Ends the store as an operator would; the supervisor starts it again."""
        os.kill(self.pid("valkey-server"), signal.SIGTERM)


@contextmanager
def running(home: Path, workers: int = 1, settings: Mapping[str, str] | None = None) -> Iterator[Service]:
    """A service that is ready, until the block ends; `settings` are variables of it. Raises ServiceTrouble."""
    home.mkdir(parents=True, exist_ok=True)
    environment = {name: value for name, value in os.environ.items() if not name.startswith("QUERYCAD_")}
    command = [sys.executable, "-m", "querycad.cli", "serve", "--port", "0", "--workers", str(workers)]
    said = home / "serve.log"
    with said.open("wb") as log:
        process = subprocess.Popen(
            command,
            env={**environment, **(settings or {}), "QUERYCAD_HOME": str(home)},
            stderr=log,
            preexec_fn=end_with_parent,  # noqa: PLW1509 - no other thread runs when a service is started
        )
    try:
        yield Service(process, _ready(process, said), home)
    finally:
        process.terminate()
        try:
            process.wait(STOP_S)
        except subprocess.TimeoutExpired:
            process.kill()
            process.wait()


def _ready(process: subprocess.Popen[bytes], said: Path) -> str:
    deadline = time.monotonic() + START_S
    while time.monotonic() < deadline and process.poll() is None:
        text = said.read_text(encoding="utf-8")
        if _READY in text:
            return text.partition(_READY)[2].split()[0]
        time.sleep(0.1)
    raise ServiceTrouble(f"the service did not start: {said.read_text(encoding='utf-8')}")
