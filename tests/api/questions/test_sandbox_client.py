"""The question worker's connection to the sandbox: one, kept while it is good, and told apart from a bad program."""

from __future__ import annotations

import json
import socket
import threading
from collections.abc import Iterator
from http.server import BaseHTTPRequestHandler, ThreadingHTTPServer
from typing import Any

import pytest

from querycad_api.questions.sandbox import RunRefused, SandboxClient, SandboxUnavailable
from querycad_contracts import Problem, Program, RunOutcome, RunStatus

MODEL = "0123456789abcdef" * 4
BY_PARSER = Program(code="solution = 1", codegen="parser")
BY_LLM = Program(code="solution = 1", codegen="llm:some")
DONE = RunOutcome(status=RunStatus.OK, value=1)


class Sandbox(ThreadingHTTPServer):
    """Answers every run alike; keeps what it was asked, and from which connections."""

    daemon_threads = True

    def __init__(self) -> None:
        super().__init__(("127.0.0.1", 0), Handler)
        self.status, self.body = 200, DONE.model_dump_json()
        self.asked: list[dict[str, Any]] = []
        self.callers: list[tuple[str, int]] = []
        self.hangs_up = False
        """After each answer, as a server does with connections that nobody uses."""
        self.answers = threading.Event()
        self.answers.set()
        self.hung_up = threading.Event()

    @property
    def url(self) -> str:
        return f"http://127.0.0.1:{self.server_port}"


class Handler(BaseHTTPRequestHandler):
    protocol_version = "HTTP/1.1"
    server: Sandbox

    def do_POST(self) -> None:
        assert self.path == "/runs"
        self.server.asked.append(json.loads(self.rfile.read(int(self.headers["Content-Length"]))))
        self.server.callers.append(self.client_address)
        if not self.server.answers.is_set():
            assert self.connection.recv(1) == b""
            self.close_connection = True
            return
        body = self.server.body.encode()
        self.send_response(self.server.status)
        self.send_header("Content-Length", str(len(body)))
        self.end_headers()
        self.wfile.write(body)
        self.close_connection = self.server.hangs_up

    def finish(self) -> None:
        super().finish()
        self.connection.shutdown(socket.SHUT_RDWR)
        self.server.hung_up.set()

    def log_message(self, *_: object) -> None:
        pass


@pytest.fixture
def sandbox() -> Iterator[Sandbox]:
    with Sandbox() as server:
        thread = threading.Thread(target=server.serve_forever)
        thread.start()
        yield server
        server.shutdown()
        thread.join()


@pytest.fixture
def client(sandbox: Sandbox) -> Iterator[SandboxClient]:
    made = SandboxClient(sandbox.url, 5.0)
    yield made
    made.close()


def test_runs_share_one_connection(sandbox: Sandbox, client: SandboxClient) -> None:
    assert [client.run(BY_PARSER, MODEL) for _ in range(3)] == [DONE] * 3
    assert len(set(sandbox.callers)) == 1


def test_one_that_was_closed_meanwhile_is_opened_anew(sandbox: Sandbox, client: SandboxClient) -> None:
    sandbox.hangs_up = True
    for _ in range(3):
        assert client.run(BY_PARSER, MODEL) == DONE
        assert sandbox.hung_up.wait(5)
        sandbox.hung_up.clear()
    assert len(set(sandbox.callers)) == 3


def test_only_what_a_language_model_wrote_is_checked(sandbox: Sandbox, client: SandboxClient) -> None:
    client.run(BY_PARSER, MODEL)
    client.run(BY_LLM, MODEL)
    assert [asked["check"] for asked in sandbox.asked] == [False, True]


def test_a_sandbox_that_is_not_there_or_talks_nonsense_may_be_asked_again(sandbox: Sandbox) -> None:
    with socket.socket() as free:
        free.bind(("127.0.0.1", 0))
        away = SandboxClient(f"http://127.0.0.1:{free.getsockname()[1]}", 5.0)
        with pytest.raises(SandboxUnavailable):
            away.run(BY_PARSER, MODEL)
    sandbox.body = "<html>"
    client = SandboxClient(sandbox.url, 5.0)
    with pytest.raises(SandboxUnavailable):
        client.run(BY_PARSER, MODEL)
    client.close()


@pytest.mark.parametrize(("status", "category"), [(422, "bad_input"), (500, "internal")])
def test_a_refusal_says_whose_fault_it_is(sandbox: Sandbox, client: SandboxClient, status: int, category: str) -> None:
    sandbox.status, sandbox.body = status, Problem(title="No", status=status, detail="why").model_dump_json()
    with pytest.raises(RunRefused, match="why") as refused:
        client.run(BY_PARSER, MODEL)
    assert refused.value.failure.category == category


def test_what_may_succeed_later_is_no_refusal(sandbox: Sandbox, client: SandboxClient) -> None:
    sandbox.status, sandbox.body = 503, Problem(title="Busy", status=503, retryable=True).model_dump_json()
    with pytest.raises(SandboxUnavailable):
        client.run(BY_PARSER, MODEL)


def test_who_waits_too_long_hangs_up_and_can_ask_again(sandbox: Sandbox) -> None:
    client = SandboxClient(sandbox.url, 0.2)
    sandbox.answers.clear()
    with pytest.raises(SandboxUnavailable):
        client.run(BY_PARSER, MODEL)
    assert sandbox.hung_up.wait(5)
    sandbox.answers.set()
    assert client.run(BY_PARSER, MODEL) == DONE
    client.close()
