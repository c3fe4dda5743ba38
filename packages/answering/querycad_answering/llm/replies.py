"""Keeps replies, so that the same request need not be sent twice.

In a folder, for good: a benchmark can be repeated without the model. In a transcript, of one question: it goes on where
it was interrupted.
"""

from __future__ import annotations

import hashlib
import json
from collections import deque
from collections.abc import Iterable
from pathlib import Path
from typing import Protocol

from pydantic import TypeAdapter, ValidationError

from .messages import ChatModel, Message, Reply, TimeLimit
from .settings import Constrained, LlmSettings

_REPLY = TypeAdapter(Reply)
"""As it is kept: JSON."""


class KeptReplies:
    """A language model whose replies are kept in a folder, by all that they depend on."""

    def __init__(self, model: ChatModel, settings: LlmSettings) -> None:
        assert settings.llm_replies is not None
        self._model = model
        self._folder = settings.llm_replies
        self._settings = settings

    def reply(self, conversation: tuple[Message, ...], temperature: float, sample: int, deadline: TimeLimit) -> Reply:
        """What did it say to this, or what does it say now? Raises LlmError."""
        path = self._folder / f"{_request(self._settings, conversation, temperature, sample)}.json"
        try:
            return _REPLY.validate_json(path.read_bytes())
        except (OSError, ValidationError):
            reply = self._model.reply(conversation, temperature, sample, deadline)
            self._keep(path, reply)
            return reply

    def _keep(self, path: Path, reply: Reply) -> None:
        self._folder.mkdir(parents=True, exist_ok=True)
        partial = path.with_suffix(".part")
        partial.write_bytes(_REPLY.dump_json(reply))
        partial.replace(path)


class Transcript(Protocol):
    """What was said about one question until now, wherever it is kept."""

    def said(self) -> Iterable[tuple[str, str]]:
        """Each request and its reply, in order."""
        ...

    def say(self, request: str, reply: str) -> None:
        """Adds one."""
        ...


class ResumedReplies:
    """A language model that is not asked again for what it said before the question was interrupted.

    Each such reply is given once: who asks the same again, to draw another, is answered anew.
    """

    def __init__(self, model: ChatModel, settings: LlmSettings, transcript: Transcript) -> None:
        self._model = model
        self._settings = settings
        self._transcript = transcript
        self._before: dict[str, deque[str]] = {}
        for request, reply in transcript.said():
            self._before.setdefault(request, deque()).append(reply)

    def reply(self, conversation: tuple[Message, ...], temperature: float, sample: int, deadline: TimeLimit) -> Reply:
        """What did it say, or what does it say now? Raises LlmError."""
        request = _request(self._settings, conversation, temperature, sample)
        if before := self._before.get(request):
            return _REPLY.validate_json(before.popleft())
        reply = self._model.reply(conversation, temperature, sample, deadline)
        self._transcript.say(request, _REPLY.dump_json(reply).decode())
        return reply


def _request(settings: LlmSettings, conversation: tuple[Message, ...], temperature: float, sample: int) -> str:
    """A digest of all that a reply depends on."""
    who: list[str | int] = [settings.llm_command or settings.llm_base_url, settings.llm_model, settings.llm_tokens]
    if settings.constrained is not Constrained.NONE:
        who.append(settings.constrained.value)
    turns = [
        [message.role.value, message.text, *(hashlib.sha256(image).hexdigest() for image in message.images)]
        for message in conversation
    ]
    return hashlib.sha256(json.dumps([*who, turns, temperature, sample]).encode()).hexdigest()
