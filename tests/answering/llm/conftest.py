"""A scripted language model on loopback, and a language model in memory, for tests of what they may do."""

from __future__ import annotations

import json
import threading
from collections.abc import Callable, Iterator
from contextlib import contextmanager
from dataclasses import dataclass, field
from http.server import BaseHTTPRequestHandler, ThreadingHTTPServer
from typing import Any

import pytest

from querycad_answering.llm.messages import LlmError, Message, Reply, TimeLimit

Answer = Callable[[BaseHTTPRequestHandler], None]


@dataclass
class Script:
    """What a server does with one request after the other, the last again and again; and what it was sent."""

    answers: list[Answer]
    bodies: list[dict[str, Any]] = field(default_factory=list)
    headers: list[dict[str, str]] = field(default_factory=list)
    paths: list[str] = field(default_factory=list)


def status(code: int, body: Any = None, **headers: str) -> Answer:
    """Answers at once with this status and a JSON body."""

    def answer(handler: BaseHTTPRequestHandler) -> None:
        content = json.dumps(body if body is not None else {"error": {"message": f"status {code}"}}).encode()
        handler.send_response(code)
        handler.send_header("Content-Type", "application/json")
        handler.send_header("Content-Length", str(len(content)))
        for name, value in headers.items():
            handler.send_header(name.replace("_", "-"), value)
        handler.end_headers()
        handler.wfile.write(content)

    return answer


def stream(*chunks: str, hold: threading.Event | None = None) -> Answer:
    """Streams these chunks of text as they are, and then ends, or holds the connection until told to go."""

    def answer(handler: BaseHTTPRequestHandler) -> None:
        handler.send_response(200)
        handler.send_header("Content-Type", "text/event-stream")
        handler.end_headers()
        for chunk in chunks:
            handler.wfile.write(chunk.encode())
            handler.wfile.flush()
        if hold is not None:
            hold.wait(10)

    return answer


def said(text: str, finish: str | None = "stop", usage: dict[str, int] | None = None) -> Answer:
    """Streams a text as OpenAI-compatible servers do."""
    events: list[dict[str, Any]] = [
        {"choices": [{"index": 0, "delta": {"content": word}}]} for word in (text[:7], text[7:])
    ]
    if finish is not None:
        events.append({"choices": [{"index": 0, "delta": {}, "finish_reason": finish}]})
    if usage is not None:
        events.append({"choices": [], "usage": usage})
    lines = [f"data: {json.dumps(event)}\n\n" for event in events]
    return stream(*lines, *(["data: [DONE]\n\n"] if finish is not None else []))


def program(code: str) -> str:
    """A reply that holds a program, as asked for."""
    return f"I need that.\n```python\n{code}\n```"


@pytest.fixture
def scripted() -> Iterator[Callable[[Script], str]]:
    """Starts a server that follows a script; its base address."""
    servers: list[ThreadingHTTPServer] = []

    def start(script: Script) -> str:
        class Handler(BaseHTTPRequestHandler):
            protocol_version = "HTTP/1.0"

            def do_POST(self) -> None:
                length = int(self.headers["Content-Length"])
                script.bodies.append(json.loads(self.rfile.read(length)))
                script.headers.append({name.lower(): value for name, value in self.headers.items()})
                script.paths.append(self.path)
                number = min(len(script.bodies), len(script.answers)) - 1
                try:
                    script.answers[number](self)
                except (BrokenPipeError, ConnectionResetError):
                    self.close_connection = True

            def log_message(self, *_: object) -> None:
                pass

        server = ThreadingHTTPServer(("127.0.0.1", 0), Handler)
        server.daemon_threads = True
        threading.Thread(target=server.serve_forever, kwargs={"poll_interval": 0.01}, daemon=True).start()
        servers.append(server)
        return f"http://127.0.0.1:{server.server_address[1]}/v1"

    yield start
    for server in servers:
        server.shutdown()
        server.server_close()


class FakeModel:
    """A language model that says one reply after the other, the last again and again; and keeps what it was told."""

    def __init__(self, *replies: str | LlmError | Reply) -> None:
        self.replies = list(replies)
        self.told: list[tuple[Message, ...]] = []
        self.temperatures: list[float] = []

    def reply(self, conversation: tuple[Message, ...], temperature: float, sample: int, deadline: TimeLimit) -> Reply:
        self.told.append(conversation)
        self.temperatures.append(temperature)
        reply = self.replies[min(len(self.told), len(self.replies)) - 1]
        if isinstance(reply, LlmError):
            raise reply
        return reply if isinstance(reply, Reply) else Reply(reply)


@contextmanager
def nothing() -> Iterator[None]:
    """A context in which nothing is expected to be raised."""
    yield
