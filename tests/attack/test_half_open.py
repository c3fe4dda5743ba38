"""1,000 requests that never end, against an api that may open 1,024 files. Loopback only, bounded in count and time."""

from __future__ import annotations

import contextlib
import os
import resource
import socket
import subprocess
import sys
import time
from collections.abc import Iterator
from pathlib import Path

import psutil
import pytest

from querycad_contracts.infrastructure import end_with_parent

FILES = 1024
HALF_OPEN = 1000
START_S = 60.0
OTHER = "127.0.0.99"

pytestmark = pytest.mark.skipif(sys.platform != "linux", reason="every address of 127/8 is this machine's on Linux")


@pytest.fixture(scope="module", autouse=True)
def more_files_here() -> Iterator[None]:
    """This end of the connections needs files, too."""
    soft, hard = resource.getrlimit(resource.RLIMIT_NOFILE)
    if hard != resource.RLIM_INFINITY and hard < 4 * HALF_OPEN:
        pytest.skip("too few open files are allowed here")
    resource.setrlimit(resource.RLIMIT_NOFILE, (max(soft, 4 * HALF_OPEN), hard))
    yield
    resource.setrlimit(resource.RLIMIT_NOFILE, (soft, hard))


@pytest.fixture
def api(redis_url: str, tmp_path: Path) -> Iterator[tuple[int, psutil.Process]]:
    """The api as it is started, with 1,024 files for good: its port and process."""
    with socket.socket() as free:
        free.bind(("127.0.0.1", 0))
        port = int(free.getsockname()[1])

    def limited() -> None:
        resource.setrlimit(resource.RLIMIT_NOFILE, (FILES, FILES))
        end_with_parent()

    environment = {
        **os.environ,
        "QUERYCAD_HOME": str(tmp_path),
        "QUERYCAD_REDIS_URL": redis_url,
        "QUERYCAD_API_PORT": str(port),
        "QUERYCAD_SANDBOX_URL": "http://127.0.0.1:1",
    }
    with (tmp_path / "log").open("wb") as log:
        process = subprocess.Popen(
            [sys.executable, "-m", "querycad_api.app"],
            env=environment,
            stderr=log,
            preexec_fn=limited,  # noqa: PLW1509 - no other thread runs here
        )
    try:
        end = time.monotonic() + START_S
        while not (status := asked(port, OTHER)).startswith(b"HTTP/1.1 200"):
            assert process.poll() is None, (tmp_path / "log").read_text()
            assert time.monotonic() < end, status
            time.sleep(0.2)
        yield port, psutil.Process(process.pid)
    finally:
        process.terminate()
        process.wait(30)


def connected(port: int, address: str) -> socket.socket:
    return socket.create_connection(("127.0.0.1", port), timeout=10, source_address=(address, 0))


def asked(port: int, address: str, path: str = "/livez") -> bytes:
    """What is answered to this address until the connection ends, however it does."""
    found = bytearray()
    with contextlib.suppress(OSError), connected(port, address) as connection:
        connection.sendall(f"GET {path} HTTP/1.1\r\nHost: localhost\r\nConnection: close\r\n\r\n".encode())
        while chunk := connection.recv(65536):
            found += chunk
    return bytes(found)


@contextlib.contextmanager
def half_open(port: int, addresses: list[str]) -> Iterator[list[socket.socket]]:
    """So many connections, in turn from these addresses, with half a head each."""
    with contextlib.ExitStack() as stack:
        held = []
        for n in range(HALF_OPEN):
            connection = stack.enter_context(connected(port, addresses[n % len(addresses)]))
            with contextlib.suppress(OSError):  # it was refused
                connection.sendall(b"GET /v1/models HTTP/1.1\r\nHost: localhost\r\n")
            held.append(connection)
        yield held


def test_who_comes_from_another_address_is_served(api: tuple[int, psutil.Process]) -> None:
    port, process = api
    with half_open(port, ["127.0.0.2"]):
        answers = [asked(port, OTHER, path) for path in ("/livez", "/v1/models", "/livez")]
        assert [each[:12] for each in answers] == [b"HTTP/1.1 200"] * 3
        assert process.num_fds() < FILES // 2


def test_when_all_connections_are_taken_others_are_told_to_come_again_and_served_then(
    api: tuple[int, psutil.Process],
) -> None:
    port, process = api
    with half_open(port, [f"127.0.0.{n}" for n in range(2, 10)]):
        told = asked(port, OTHER)
        assert told.startswith(b"HTTP/1.1 503 "), told
        assert b"retry-after: " in told.lower()
        assert process.num_fds() < FILES
        end = time.monotonic() + 60
        while not asked(port, OTHER, "/v1/models").startswith(b"HTTP/1.1 200"):  # heads have ten seconds
            assert time.monotonic() < end
            time.sleep(0.5)
    assert process.is_running()
    assert asked(port, OTHER).startswith(b"HTTP/1.1 200")
    assert process.num_fds() < FILES // 4
