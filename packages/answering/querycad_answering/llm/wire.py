"""The two ways of speaking to a language model: OpenAI's chat completions, and Anthropic's messages; both streamed.

Azure, vLLM, Ollama, llama.cpp and others speak the first.
"""

from __future__ import annotations

import json
from base64 import b64encode
from dataclasses import dataclass
from typing import Any, Protocol

import httpx

from querycad_contracts import TokenUse

from .forms import Form, anthropic_tools, constraint
from .messages import LlmBusy, LlmRefused, Message, Role
from .settings import LlmApi, LlmSettings

ANTHROPIC_VERSION = "2023-06-01"
BUSY_ERRORS = (
    "overloaded_error",
    "rate_limit_error",
    "api_error",
    "timeout_error",
    "server_error",
    "rate_limit_exceeded",
)
"""Kinds of errors, told inside a stream or in a body, after which another try may succeed."""
MESSAGE_CHARS = 300
CACHED = {"type": "ephemeral"}
"""Anthropic's mark: what comes up to here is kept for some minutes, and read from there at a tenth of its price."""
DONE = "[DONE]"
"""What OpenAI's streams end with."""

Json = dict[str, Any]


@dataclass(frozen=True, slots=True)
class Piece:
    """A part of a streamed reply. `ended` says that the model was done; `cut`, that it was at its longest."""

    text: str = ""
    call: str = ""
    """Of the arguments of a tool call, as JSON."""
    ended: bool = False
    cut: bool = False
    tokens: TokenUse | None = None


class Wire(Protocol):
    """How one kind of server is spoken to."""

    def url(self) -> httpx.URL:
        """Where do requests go?"""
        ...

    def headers(self) -> dict[str, str]:
        """Which headers do they need, the key among them?"""
        ...

    def body(self, conversation: tuple[Message, ...], temperature: float) -> Json:
        """What is sent?"""
        ...

    def piece(self, event: Json) -> Piece:
        """What does one event of the stream, or a body that was not streamed, say? Raises LlmBusy or LlmRefused."""
        ...


def wire_of(settings: LlmSettings, form: Form | None = None) -> Wire:
    """How is the server of these settings spoken to?"""
    return AnthropicWire(settings, form) if settings.api is LlmApi.ANTHROPIC else OpenAiWire(settings, form)


def openai_messages(conversation: tuple[Message, ...]) -> list[Json]:
    """The conversation as chat completions have it; pictures are data URLs behind their message's text."""
    return [
        {"role": message.role.value, "content": _openai_content(message) if message.images else message.text}
        for message in conversation
    ]


def _openai_content(message: Message) -> list[Json]:
    urls = [f"data:image/png;base64,{b64encode(image).decode()}" for image in message.images]
    return [{"type": "text", "text": message.text}, *({"type": "image_url", "image_url": {"url": url}} for url in urls)]


class OpenAiWire:
    """Chat completions."""

    def __init__(self, settings: LlmSettings, form: Form | None = None) -> None:
        self._settings = settings
        self._form = form

    def url(self) -> httpx.URL:
        """`<base>/chat/completions`; a query such as Azure's `api-version` stays."""
        return _below(self._settings.llm_base_url, "chat/completions")

    def headers(self) -> dict[str, str]:
        """The key, as a bearer token and as Azure reads it; none for servers without keys."""
        key = self._settings.llm_api_key.get_secret_value()
        is_azure = self.url().host.endswith(".azure.com")
        return ({"api-key": key} if is_azure else {"Authorization": f"Bearer {key}"}) if key else {}

    def body(self, conversation: tuple[Message, ...], temperature: float) -> Json:
        """The request; `max_tokens` and the rest are renamed or left out for servers that do not accept them."""
        model = {"model": self._settings.llm_model} if self._settings.llm_model else {}
        return {
            **model,
            "messages": openai_messages(conversation),
            "max_tokens": self._settings.llm_tokens,
            "temperature": temperature,
            **constraint(self._form, self._settings.constrained),
            "stream": True,
            "stream_options": {"include_usage": True},
        }

    def piece(self, event: Json) -> Piece:
        """One chunk, or the whole completion of a server that does not stream."""
        _raise_error(event)
        usage = event.get("usage") or {}
        tokens = TokenUse(input=usage.get("prompt_tokens") or 0, output=usage.get("completion_tokens") or 0)
        choice: Json = next(iter(event.get("choices") or ()), {})
        said = choice.get("delta") or choice.get("message") or {}
        finish = choice.get("finish_reason")
        call: Json = next(iter(said.get("tool_calls") or ()), {})
        arguments = (call.get("function") or {}).get("arguments") or ""
        text = said.get("content") or ""
        return Piece(text, arguments, finish is not None, finish == "length", tokens if usage else None)


class AnthropicWire:
    """Messages."""

    def __init__(self, settings: LlmSettings, form: Form | None = None) -> None:
        self._settings = settings
        self._form = form

    def url(self) -> httpx.URL:
        """`<base>/v1/messages`, whether or not the base names the version."""
        base = self._settings.llm_base_url
        return _below(base, "messages" if httpx.URL(base).path.rstrip("/").endswith("/v1") else "v1/messages")

    def headers(self) -> dict[str, str]:
        """The key and the version of the interface."""
        return {"x-api-key": self._settings.llm_api_key.get_secret_value(), "anthropic-version": ANTHROPIC_VERSION}

    def body(self, conversation: tuple[Message, ...], temperature: float) -> Json:
        """The request; what the system says has a field of its own, which the server keeps for the next question.

        What is the same for all models is kept apart from what is told of this one.
        """
        turns: list[dict[str, Any]] = [
            {"role": message.role.value, "content": _anthropic_content(message)}
            for message in conversation
            if message.role is not Role.SYSTEM
        ]
        if len(turns) > 1:  # a conversation goes on: all that was said so far is read once, too
            turns[-1]["content"][-1]["cache_control"] = CACHED
        return {
            "model": self._settings.llm_model,
            "system": [
                {"type": "text", "text": text, "cache_control": CACHED}
                for message in conversation
                if message.role is Role.SYSTEM
                for text in (message.text[: message.fixed], message.text[message.fixed :])
                if text
            ],
            "messages": turns,
            "max_tokens": self._settings.llm_tokens,
            "temperature": min(temperature, 1.0),
            **anthropic_tools(self._form, self._settings.constrained),
            "stream": True,
        }

    def piece(self, event: Json) -> Piece:
        """One event, or the whole message of a server that does not stream."""
        _raise_error(event)
        match event.get("type"):
            case "message_start":
                return Piece(tokens=_anthropic_tokens(event.get("message") or {}))
            case "content_block_delta":
                delta = event.get("delta") or {}
                return Piece(delta.get("text") or "", delta.get("partial_json") or "")
            case "message_delta":
                reason = (event.get("delta") or {}).get("stop_reason")
                return Piece(ended=reason is not None, cut=reason == "max_tokens", tokens=_anthropic_tokens(event))
            case "message":
                blocks = event.get("content") or ()
                text = "".join(block.get("text") or "" for block in blocks)
                call = next((json.dumps(block["input"]) for block in blocks if block.get("input")), "")
                return Piece(text, call, True, event.get("stop_reason") == "max_tokens", _anthropic_tokens(event))
        return Piece()


def _anthropic_content(message: Message) -> list[Json]:
    """Pictures first, then the words about them."""
    sources = [{"type": "base64", "media_type": "image/png", "data": b64encode(one).decode()} for one in message.images]
    return [*({"type": "image", "source": source} for source in sources), {"type": "text", "text": message.text}]


def _anthropic_tokens(holder: Json) -> TokenUse:
    usage = holder.get("usage") or {}
    cached = (usage.get("cache_read_input_tokens") or 0) + (usage.get("cache_creation_input_tokens") or 0)
    return TokenUse(input=(usage.get("input_tokens") or 0) + cached, output=usage.get("output_tokens") or 0)


def _below(base: str, path: str) -> httpx.URL:
    url = httpx.URL(base)
    return url.copy_with(path=f"{url.path.rstrip('/')}/{path}")


def _raise_error(event: Json) -> None:
    """Raises what an error inside a stream, or in a body with status 200, says."""
    error = event.get("error")
    if not error:
        return
    kind, message, _ = told(event)
    raise (LlmBusy if kind in BUSY_ERRORS else LlmRefused)(message)


def told(body: Json) -> tuple[str, str, str | None]:
    """What does an error's body say: its kind, its message, and the parameter that it is about?"""
    error = body.get("error")
    if isinstance(error, str):
        return "", error[:MESSAGE_CHARS], None
    if not isinstance(error, dict):
        return "", str(body.get("message") or body.get("detail") or "")[:MESSAGE_CHARS], None
    parameter = error.get("param")
    kind = str(error.get("code") or error.get("type") or "")
    return kind, str(error.get("message") or "")[:MESSAGE_CHARS], parameter if isinstance(parameter, str) else None


def event_of(line: str) -> Json | None:
    """The JSON object in a line of server-sent events; None for other lines. Raises LlmBusy for what is no JSON."""
    field, _, data = line.partition(":")
    if field != "data" or data.strip() in ("", DONE):
        return None
    return parsed(data)


def parsed(data: str | bytes) -> Json:
    """The JSON object that `data` is. Raises LlmBusy: a proxy's error page, or half a reply."""
    try:
        value = json.loads(data)
    except ValueError as error:
        raise LlmBusy("the language model's reply is not as documented") from error
    if not isinstance(value, dict):
        raise LlmBusy("the language model's reply is not as documented")
    return value
