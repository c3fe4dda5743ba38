"""Requests of nobody: what they cost before the service knows who asks. Loopback only, bounded in count and time."""

from __future__ import annotations

import asyncio
import contextlib
import itertools
import socket
import threading
import time
from collections.abc import AsyncIterator, Iterator
from contextlib import contextmanager
from pathlib import Path
from typing import Any

import httpx
import psutil
import pytest
import uvicorn
from starlette.types import Message, Receive, Scope, Send
from tests.api.fakes import STEP

from querycad_api import connections
from querycad_api.accounts.keys import KeyRing
from querycad_api.app import make_app
from querycad_api.connections import HEAD_BYTES, limits
from querycad_api.models import body_limit
from querycad_api.settings import ApiSettings

HEAD_S = 1.0
OF_ONE = 12


@pytest.fixture
def settings(redis_url: str, tmp_path: Path) -> ApiSettings:
    return ApiSettings(redis_url=redis_url, home=tmp_path, upload_mib=64, auth=True, sandbox_url="http://127.0.0.1:1")


@pytest.fixture
def port(settings: ApiSettings) -> Iterator[int]:
    with served(make_app(settings)) as port:
        yield port


@contextmanager
def served(app: Any) -> Iterator[int]:
    """Serves as `python -m querycad_api.app` does, with shorter times and fewer connections."""
    with socket.socket() as listener:
        listener.bind(("127.0.0.1", 0))
        config = uvicorn.Config(
            app, log_level="critical", lifespan="on", timeout_graceful_shutdown=2, **limits(100, OF_ONE, HEAD_S)
        )
        server = uvicorn.Server(config)
        thread = threading.Thread(target=server.run, kwargs={"sockets": [listener]}, daemon=True)
        thread.start()
        while not server.started and thread.is_alive():
            time.sleep(0.01)
        try:
            yield listener.getsockname()[1]
        finally:
            server.should_exit = True
            thread.join()


def connected(port: int) -> socket.socket:
    return socket.create_connection(("127.0.0.1", port), timeout=10)


def said(connection: socket.socket) -> bytes:
    """What comes until the other end closes."""
    found = bytearray()
    with contextlib.suppress(ConnectionError):
        while chunk := connection.recv(65536):
            found += chunk
    return bytes(found)


def slowly(pause_s: float, count: int) -> Iterator[bytes]:
    for _ in range(count):
        time.sleep(pause_s)
        yield b"a"


def sent(connection: socket.socket, pieces: Iterator[bytes], most_s: float = 8.0) -> int:
    """How many bytes could be sent until the other end had enough?"""
    count, end = 0, time.monotonic() + most_s
    connection.settimeout(1.0)
    with contextlib.suppress(OSError):
        for piece in pieces:
            if time.monotonic() > end:
                break
            count += connection.send(piece)
    return count


def test_nobodys_upload_is_refused_by_its_head_and_leaves_nothing_on_disk(port: int, tmp_path: Path) -> None:
    head = b"POST /v1/models HTTP/1.1\r\nHost: x\r\nContent-Type: multipart/form-data; boundary=b\r\n"
    with connected(port) as connection:
        connection.sendall(head + b"Content-Length: 60000000\r\n\r\n--b\r\n")
        assert connection.recv(65536).startswith(b"HTTP/1.1 401 ")
        assert list(tmp_path.rglob("*")) == []


def test_who_is_refused_cannot_go_on_sending(port: int) -> None:
    head = b"POST /v1/models HTTP/1.1\r\nHost: x\r\nContent-Length: 60000000\r\n\r\n"
    with connected(port) as connection:
        connection.sendall(head)
        assert connection.recv(65536).startswith(b"HTTP/1.1 401 ")
        assert sent(connection, slowly(0.1, 200), most_s=15) < 120  # it is closed after some seconds


@pytest.mark.parametrize("whole", [True, False])
def test_who_was_refused_keeps_the_connection_if_the_body_came(
    port: int, monkeypatch: pytest.MonkeyPatch, whole: bool
) -> None:
    monkeypatch.setattr(connections, "LINGER_S", 0.5)
    with connected(port) as connection:
        connection.sendall(b"POST /v1/models HTTP/1.1\r\nHost: x\r\nContent-Length: 9\r\n\r\n")
        assert connection.recv(65536).startswith(b"HTTP/1.1 401 ")
        connection.sendall(b"123456789" if whole else b"12345678")
        time.sleep(0.7)
        with contextlib.suppress(OSError):
            connection.sendall(b"GET /livez HTTP/1.1\r\nHost: x\r\nConnection: close\r\n\r\n")
        assert said(connection)[:12] == (b"HTTP/1.1 200" if whole else b"")


@pytest.mark.parametrize(
    "path", ["/v1/models", "/v1/models/x/questions", "/v1/nothing", "//v1/models", "/v1/../v1/models", "/v1%2fmodels"]
)
def test_no_path_reads_a_body_before_it_knows_who_asks(port: int, path: str) -> None:
    with connected(port) as connection:
        connection.sendall(f"POST {path} HTTP/1.1\r\nHost: x\r\nContent-Length: 1000\r\n\r\n".encode())
        assert connection.recv(65536)[9:12] in (b"401", b"404")


def test_headers_without_end_are_cut_off(port: int) -> None:
    with connected(port) as connection:
        line = b"X-A: " + b"a" * 1000 + b"\r\n"
        count = sent(connection, (piece for piece in [b"GET /v1/models HTTP/1.1\r\n", *[line] * 50_000]))
    assert count < HEAD_BYTES + 8 * 2**20  # what the sockets of both ends buffer; 50 MB were offered


def test_one_header_without_end_costs_no_memory(port: int) -> None:
    before = psutil.Process().memory_info().rss
    with connected(port) as connection:
        sent(connection, (piece for piece in [b"GET / HTTP/1.1\r\nX-A: ", *[b"a" * 65536] * 1000]))
    assert psutil.Process().memory_info().rss - before < 32 * 2**20


def test_half_a_request_is_not_waited_for(port: int) -> None:
    with connected(port) as silent, connected(port) as half:
        half.sendall(b"GET /v1/models HTTP/1.1\r\nHost: x\r\n")
        start = time.monotonic()
        assert said(half) == said(silent) == b""
        assert time.monotonic() - start < 8  # the socket's own limit is 10


def test_a_head_that_trickles_is_not_waited_for(port: int) -> None:
    with connected(port) as connection:
        assert sent(connection, slowly(0.2, 60), most_s=15) < 20


def test_one_address_has_so_many_connections_and_others_are_told_to_come_again(port: int) -> None:
    with contextlib.ExitStack() as stack:
        held = [stack.enter_context(connected(port)) for _ in range(3 * OF_ONE)]
        refused = [connection for connection in held[OF_ONE:] if b"503" in said(connection)]
        assert len(refused) == 2 * OF_ONE
    time.sleep(0.2)
    assert httpx.get(f"http://127.0.0.1:{port}/livez", trust_env=False).status_code == 200


def test_a_form_of_many_parts_costs_no_memory(port: int, settings: ApiSettings) -> None:
    key = KeyRing(settings.keys).create("acme")
    part = b'--b\r\nContent-Disposition: form-data; name="x"\r\n\r\n' + b"a" * 900_000 + b"\r\n"
    content = itertools.chain(itertools.repeat(part, 200), [b"--b--\r\n"])
    headers = {"Authorization": f"Bearer {key}", "Content-Type": "multipart/form-data; boundary=b"}
    before = psutil.Process().memory_info().rss
    with contextlib.suppress(httpx.WriteError):  # it is refused before it has all been sent
        url = f"http://127.0.0.1:{port}/v1/models"
        assert httpx.post(url, content=content, headers=headers, trust_env=False, timeout=30).status_code == 400
    assert psutil.Process().memory_info().rss - before < 32 * 2**20


def test_a_form_that_is_no_multipart_form_is_small(port: int, settings: ApiSettings) -> None:
    key = KeyRing(settings.keys).create("acme")
    headers = {"Authorization": f"Bearer {key}", "Content-Type": "application/x-www-form-urlencoded"}
    url = f"http://127.0.0.1:{port}/v1/models"
    response = httpx.post(url, content=b"a=" + b"a" * 2 * 2**20, headers=headers, trust_env=False)
    assert response.status_code == 413


def test_a_body_that_stops_is_not_waited_for(
    port: int, settings: ApiSettings, monkeypatch: pytest.MonkeyPatch, tmp_path: Path
) -> None:
    monkeypatch.setattr(body_limit, "PAUSE_S", 1.0)
    key = KeyRing(settings.keys).create("acme")
    head = f"POST /v1/models HTTP/1.1\r\nHost: x\r\nAuthorization: Bearer {key}\r\n".encode()
    head += b"Content-Type: multipart/form-data; boundary=b\r\nContent-Length: 9000\r\n\r\n"
    with connected(port) as connection:
        connection.sendall(head + b'--b\r\nContent-Disposition: form-data; name="file"; filename="a"\r\n\r\nISO-')
        assert connection.recv(65536).startswith(b"HTTP/1.1 408 ")
    assert [each for each in tmp_path.rglob("*") if not each.name.startswith("keys")] == []


def test_a_response_that_takes_long_is_not_cut_off_for_a_body_that_nobody_read(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(body_limit, "PAUSE_S", 0.1)
    came: list[str] = []

    async def late(_scope: Scope, receive: Receive, _send: Send) -> None:
        await asyncio.sleep(0.3)
        came.append((await receive())["type"])

    async def receive() -> Message:
        await asyncio.sleep(0)
        return {"type": "http.request", "body": b"", "more_body": False}

    async def send(_message: Message) -> None:
        raise AssertionError("nothing is refused")

    scope = {"type": "http", "path": "/v1/models/x/glb", "headers": []}
    asyncio.run(body_limit.BodyLimit(late, "/v1/models", 2**20)(scope, receive, send))
    assert came == ["http.request"]


def test_a_body_that_trickles_is_not_waited_for(
    port: int, settings: ApiSettings, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setattr(body_limit, "PAUSE_S", 1.5)
    key = KeyRing(settings.keys).create("acme")

    async def trickle() -> AsyncIterator[bytes]:
        for _ in range(20):
            yield b" "
            await asyncio.sleep(0.2)

    async def post() -> int:
        headers = {"Authorization": f"Bearer {key}", "Content-Type": "application/json"}
        async with httpx.AsyncClient(trust_env=False) as client:
            url = f"http://127.0.0.1:{port}/v1/models/{'0' * 64}/questions"
            return (await client.post(url, content=trickle(), headers=headers)).status_code

    assert asyncio.run(post()) == 408


def test_a_whole_upload_of_somebody_is_taken(port: int, settings: ApiSettings) -> None:
    key = KeyRing(settings.keys).create("acme")
    url, headers = f"http://127.0.0.1:{port}/v1/models", {"Authorization": f"Bearer {key}"}
    response = httpx.post(url, files={"file": ("a.step", STEP)}, headers=headers, trust_env=False)
    assert response.status_code == 202
