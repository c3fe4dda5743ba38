"""Asks a language model over HTTP: streamed, bounded in time and length, tried again when the server is busy."""

from __future__ import annotations

import random
import re
import time
from collections.abc import Callable, Iterator
from contextlib import suppress
from dataclasses import replace
from datetime import UTC, datetime
from email.utils import parsedate_to_datetime

import httpx

from querycad_contracts import TokenUse

from .breaker import gate_of
from .forms import Form, as_reply
from .messages import ChatModel, LlmBusy, LlmError, LlmRefused, LlmTooSlow, Message, Reply, TimeLimit
from .process import ProcessChatModel
from .replies import KeptReplies
from .settings import LlmSettings
from .wire import DONE, Json, event_of, parsed, told, wire_of

CONNECT_S = 5.0
FIRST_PAUSE_S, LONGEST_PAUSE_S = 0.5, 8.0
"""Between tries, doubled each time, and between half and all of that: clients that failed together come back apart."""
BUSY = frozenset({408, 409, 429, 500, 502, 503, 504, 529})
"""Statuses after which another try may succeed; 529 is Anthropic's for overload."""
NAMES_FIELDS = frozenset({400, 422, 500, 501})
"""Statuses of a request with a field that the server does not accept."""
TOKEN_CHARS = 12
"""Longer than a token ever is on average: a reply of more characters comes from a server that keeps no limit."""
BODY_BYTES = 2**20
OTHER_NAMES = {"max_tokens": "max_completion_tokens"}
"""What OpenAI's reasoning models call it."""
OPTIONAL = frozenset(
    {"max_tokens", "temperature", "stream_options", "response_format", "grammar", "structured_outputs", "tools"}
)


def open_model(settings: LlmSettings, form: Form | None = None) -> ChatModel:
    """The language model of these settings, a command before an address; its replies are kept where they say so.

    `form`: what its replies are held to, where the settings say how.
    """
    model = ProcessChatModel(settings) if settings.llm_command else HttpChatModel(settings, form=form)
    return model if settings.llm_replies is None else KeptReplies(model, settings)


class HttpChatModel:
    """A language model behind an address. Thread safe; `transport` and `sleep` replace network and clock."""

    def __init__(
        self,
        settings: LlmSettings,
        transport: httpx.BaseTransport | None = None,
        sleep: Callable[[float], None] = time.sleep,
        form: Form | None = None,
    ) -> None:
        self._settings = settings
        self._form = form
        self._wire = wire_of(settings, form)
        self._gate = gate_of(str(self._wire.url()), settings.llm_parallel, settings.llm_per_minute)
        self._http = httpx.Client(transport=transport, follow_redirects=False)  # a redirect would take the key along
        self._sleep = sleep
        self._unwanted: set[str] = set()

    def reply(self, conversation: tuple[Message, ...], temperature: float, sample: int, deadline: TimeLimit) -> Reply:  # noqa: ARG002
        """What does it say? Raises LlmError. `sample` does not matter: every request is drawn anew."""
        busy = 0
        while True:
            body = self._accepted(self._wire.body(conversation, temperature))
            try:
                with self._gate.passed(deadline):
                    reply = self._send(body, deadline)
                return replace(reply, text=as_reply(reply.text)) if self._form is not None else reply
            except LlmRefused as error:
                if error.parameter not in body.keys() & OPTIONAL:
                    raise
                self._unwanted.add(error.parameter)
            except LlmBusy as error:
                if busy >= self._settings.llm_retries:
                    raise
                self._pause(error, busy, deadline)
                busy += 1

    def _accepted(self, body: Json) -> Json:
        """The body without what the server refused before."""
        for name in self._unwanted & body.keys():
            value = body.pop(name)
            if name in OTHER_NAMES:
                body[OTHER_NAMES[name]] = value
        return body

    def _pause(self, error: LlmBusy, tries: int, deadline: TimeLimit) -> None:
        """Waits before another try, as long as the server asks for. Raises the error where there is no time for it."""
        pause = min(FIRST_PAUSE_S * 2**tries, LONGEST_PAUSE_S)
        pause_s = error.retry_after_s or pause * random.uniform(0.5, 1.0)  # noqa: S311 - no secret
        if pause_s >= deadline.left_s():
            raise error
        self._sleep(pause_s)

    def _send(self, body: Json, deadline: TimeLimit) -> Reply:
        """One request. A server may say the key that it refuses: that is taken out of what it said."""
        try:
            return self._exchange(body, deadline)
        except LlmError as error:
            key = self._settings.llm_api_key.get_secret_value()
            if key and key in str(error):
                error.args = (str(error).replace(key, "…"), *error.args[1:])
            raise

    def _exchange(self, body: Json, deadline: TimeLimit) -> Reply:
        left_s = deadline.left_s()
        timeout = httpx.Timeout(left_s, connect=min(CONNECT_S, left_s))
        try:
            with self._http.stream(
                "POST", self._wire.url(), json=body, headers=self._wire.headers(), timeout=timeout
            ) as response:
                if not response.is_success:
                    raise _refusal(response, body)
                return self._read(response, deadline)
        except httpx.ConnectTimeout as error:
            raise LlmBusy(f"{self._host} cannot be reached") from error
        except httpx.TimeoutException as error:
            raise LlmTooSlow("the language model did not answer in time") from error
        except httpx.HTTPError as error:
            raise LlmBusy(f"{self._host} does not answer: {error}") from error

    @property
    def _host(self) -> str:
        return f"the language model at {self._wire.url().netloc.decode('ascii')}"

    def _read(self, response: httpx.Response, deadline: TimeLimit) -> Reply:
        """The whole reply, of a stream or at once."""
        if "text/event-stream" not in response.headers.get("content-type", "text/event-stream"):
            piece = self._wire.piece(parsed(b"".join(_bounded(response.iter_bytes(), deadline))))
            return Reply(_joined(piece.text, piece.call), piece.cut, piece.tokens or TokenUse())
        text, call, ended, cut, tokens = "", "", False, False, TokenUse()
        for line in _lines(response, deadline):
            ended = ended or line.removeprefix("data:").strip() == DONE
            event = event_of(line)
            if event is None:
                continue
            piece = self._wire.piece(event)
            text += piece.text
            call += piece.call
            ended, cut = ended or piece.ended, cut or piece.cut
            if piece.tokens is not None:
                tokens = TokenUse(
                    input=max(tokens.input, piece.tokens.input), output=max(tokens.output, piece.tokens.output)
                )
            if len(text) + len(call) > TOKEN_CHARS * self._settings.llm_tokens:
                return Reply(text, True, tokens)
        if not ended:
            raise LlmBusy("the language model's reply broke off")
        return Reply(_joined(text, call), cut, tokens)


def _joined(text: str, call: str) -> str:
    """What was said, and the program of a tool's call as a code block."""
    return f"{text.strip()}\n{as_reply(call)}".strip() if call else text


def _lines(response: httpx.Response, deadline: TimeLimit) -> Iterator[str]:
    """The stream's lines; a line, and the time, are bounded."""
    rest = b""
    for chunk in response.iter_bytes():
        deadline.left_s()
        *lines, rest = (rest + chunk).split(b"\n")
        yield from (line.decode("utf-8", "replace").rstrip("\r") for line in lines)
        if len(rest) > BODY_BYTES:
            raise LlmBusy("the language model's reply is not as documented")
    if rest:
        yield rest.decode("utf-8", "replace")


def _bounded(chunks: Iterator[bytes], deadline: TimeLimit) -> Iterator[bytes]:
    size = 0
    for chunk in chunks:
        deadline.left_s()
        size += len(chunk)
        if size > BODY_BYTES:
            raise LlmBusy("the language model's reply is not as documented")
        yield chunk


def _refusal(response: httpx.Response, sent: Json) -> LlmError:
    """Which error is a response without success to what was sent?

    Many servers name the field that they do not accept in their sentence alone, some with a status 500.
    """
    body: Json = {}
    with suppress(httpx.HTTPError, LlmError):
        body = parsed(b"".join(_bounded(response.iter_bytes(), TimeLimit(CONNECT_S))))
    _, message, parameter = told(body)
    said = f"the language model's server answered {response.status_code}" + (f": {message}" if message else "")
    if parameter is None and response.status_code in NAMES_FIELDS:
        parameter = next((name for name in sorted(sent.keys() & OPTIONAL) if _names(message, name)), None)
    if response.status_code in BUSY and parameter is None:
        return LlmBusy(said, _retry_after_s(response.headers))
    return LlmRefused(said, parameter)


def _names(message: str, field: str) -> bool:
    """Does the sentence name the field: 'tools param requires --jinja', 'the model does not support tools'?"""
    return re.search(rf"\b{field.removesuffix('s')}s?\b", message, re.IGNORECASE) is not None


def _retry_after_s(headers: httpx.Headers) -> float | None:
    """How long does the server ask to be left alone? Seconds or a date (RFC 9110), or OpenAI's milliseconds."""
    milliseconds, told_s = headers.get("retry-after-ms"), headers.get("retry-after")
    with suppress(ValueError):
        if milliseconds is not None:
            return max(0.0, float(milliseconds) / 1e3)
    if told_s is None:
        return None
    with suppress(ValueError):
        return max(0.0, float(told_s))
    with suppress(ValueError, TypeError):
        return max(0.0, (parsedate_to_datetime(told_s) - datetime.now(UTC)).total_seconds())
    return None
