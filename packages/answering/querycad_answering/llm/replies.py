"""Keeps replies, so that the same request need not be sent twice: a benchmark can be repeated without the model."""

from __future__ import annotations

import hashlib
import json
from pathlib import Path

from pydantic import ValidationError

from querycad_contracts import Frozen, TokenUse

from .messages import ChatModel, Message, Reply, TimeLimit
from .settings import Constrained, LlmSettings


class _Kept(Frozen):
    """One reply, in a file named by its request."""

    text: str
    cut: bool
    tokens: TokenUse


class KeptReplies:
    """A language model whose replies are kept in a folder, by all that they depend on."""

    def __init__(self, model: ChatModel, settings: LlmSettings) -> None:
        assert settings.llm_replies is not None
        self._model = model
        self._folder = settings.llm_replies
        self._who: list[str | int] = [
            settings.llm_command or settings.llm_base_url,
            settings.llm_model,
            settings.llm_tokens,
        ]
        if settings.constrained is not Constrained.NONE:
            self._who.append(settings.constrained.value)

    def reply(self, conversation: tuple[Message, ...], temperature: float, sample: int, deadline: TimeLimit) -> Reply:
        """What did it say to this, or what does it say now? Raises LlmError."""
        path = self._path(conversation, temperature, sample)
        try:
            kept = _Kept.model_validate_json(path.read_bytes())
        except (OSError, ValidationError):
            reply = self._model.reply(conversation, temperature, sample, deadline)
            self._keep(path, _Kept(text=reply.text, cut=reply.cut, tokens=reply.tokens))
            return reply
        return Reply(kept.text, kept.cut, kept.tokens)

    def _path(self, conversation: tuple[Message, ...], temperature: float, sample: int) -> Path:
        turns = [
            [message.role.value, message.text, *(hashlib.sha256(image).hexdigest() for image in message.images)]
            for message in conversation
        ]
        asked = json.dumps([*self._who, turns, temperature, sample])
        return self._folder / f"{hashlib.sha256(asked.encode()).hexdigest()}.json"

    def _keep(self, path: Path, kept: _Kept) -> None:
        self._folder.mkdir(parents=True, exist_ok=True)
        partial = path.with_suffix(".part")
        partial.write_text(kept.model_dump_json(), encoding="utf-8")
        partial.replace(path)
