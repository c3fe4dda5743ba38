"""Recorded replies of each kind of server, written after the public descriptions of their interfaces."""

from __future__ import annotations

import json
from pathlib import Path
from typing import Any

import httpx
import pytest

from querycad_answering.llm.client import HttpChatModel
from querycad_answering.llm.messages import LlmBusy, LlmError, LlmRefused, Message, Reply, Role, TimeLimit
from querycad_answering.llm.prompt import conversation
from querycad_answering.llm.settings import LlmApi, LlmSettings
from querycad_answering.llm.wire import wire_of

RECORDED = Path(__file__).parent / "replies"
TALK = (
    Message(Role.SYSTEM, "rules"),
    Message(Role.USER, "example"),
    Message(Role.ASSISTANT, "its answer"),
    Message(Role.USER, "question"),
)
BASES = {
    "openai": "https://api.openai.com/v1",
    "azure": "https://some.openai.azure.com/openai/deployments/mine?api-version=2024-10-21",
    "vllm": "http://127.0.0.1:8000/v1",
    "ollama": "http://127.0.0.1:11434/v1/",
    "llama_cpp": "http://127.0.0.1:8080/v1",
    "anthropic": "https://api.anthropic.com",
}
URLS = {
    "openai": "https://api.openai.com/v1/chat/completions",
    "azure": "https://some.openai.azure.com/openai/deployments/mine/chat/completions?api-version=2024-10-21",
    "vllm": "http://127.0.0.1:8000/v1/chat/completions",
    "ollama": "http://127.0.0.1:11434/v1/chat/completions",
    "llama_cpp": "http://127.0.0.1:8080/v1/chat/completions",
    "anthropic": "https://api.anthropic.com/v1/messages",
}
KEYS = {
    "azure": {"api-key": "secret"},
    "anthropic": {"x-api-key": "secret", "anthropic-version": "2023-06-01"},
}


class Server(httpx.BaseTransport):
    """Answers every request with one recorded body, and keeps the request."""

    def __init__(self, content: bytes, content_type: str = "text/event-stream", status: int = 200) -> None:
        self.answer = (status, {"Content-Type": content_type}, content)
        self.requests: list[httpx.Request] = []

    def handle_request(self, request: httpx.Request) -> httpx.Response:
        self.requests.append(request)
        status, headers, content = self.answer
        return httpx.Response(status, headers=headers, content=content)


def ask(server: Server, base: str, **more: Any) -> Reply:
    given = {"llm_base_url": base, "llm_model": "mine", "llm_api_key": "secret", "llm_retries": 0, **more}
    return HttpChatModel(LlmSettings.model_validate(given), server).reply(TALK, 0.5, 1, TimeLimit(60))


@pytest.mark.parametrize("kind", list(BASES))
def test_each_server_is_asked_its_way_and_its_reply_is_read(kind: str) -> None:
    server = Server((RECORDED / f"{kind}.sse").read_bytes())
    reply = ask(server, BASES[kind])
    assert reply.text == 'I need all holes and count them.\n```python\nsolution = len(find_parts("hole"))\n```'
    assert not reply.cut
    assert (reply.tokens.input, reply.tokens.output) == (1523, 31)
    (request,) = server.requests
    assert str(request.url) == URLS[kind]
    headers = KEYS.get(kind, {"authorization": "Bearer secret"})
    assert {name: request.headers[name] for name in headers} == headers


def test_openai_gets_all_turns_as_messages() -> None:
    server = Server((RECORDED / "openai.sse").read_bytes())
    ask(server, BASES["openai"])
    body = json.loads(server.requests[0].content)
    assert [message["role"] for message in body["messages"]] == ["system", "user", "assistant", "user"]
    assert (body["model"], body["temperature"], body["stream"]) == ("mine", 0.5, True)


def test_anthropic_gets_the_rules_apart_from_the_turns() -> None:
    server = Server((RECORDED / "anthropic.sse").read_bytes())
    ask(server, "https://api.anthropic.com/v1")
    assert str(server.requests[0].url) == URLS["anthropic"]
    body = json.loads(server.requests[0].content)
    assert body["system"] == [{"type": "text", "text": "rules", "cache_control": {"type": "ephemeral"}}]
    assert [message["role"] for message in body["messages"]] == ["user", "assistant", "user"]
    assert body["max_tokens"] > 0


@pytest.mark.parametrize(
    ("kind", "body"),
    [
        ("anthropic", {"type": "message", "content": [{"type": "text", "text": "x"}], "stop_reason": "max_tokens"}),
        ("openai", {"choices": [{"message": {"role": "assistant", "content": "x"}, "finish_reason": "length"}]}),
    ],
)
def test_a_whole_reply_that_was_cut_says_so(kind: str, body: dict[str, Any]) -> None:
    reply = ask(Server(json.dumps(body).encode(), "application/json"), BASES[kind])
    assert (reply.text, reply.cut) == ("x", True)


@pytest.mark.parametrize(
    ("kind", "status", "body", "error"),
    [
        ("anthropic", 529, {"type": "error", "error": {"type": "overloaded_error", "message": "Overloaded"}}, LlmBusy),
        ("anthropic", 401, {"type": "error", "error": {"type": "authentication_error", "message": "key"}}, LlmRefused),
        ("openai", 404, {"error": {"message": "no such model", "code": "model_not_found", "param": None}}, LlmRefused),
        ("ollama", 404, {"error": "model 'mine' not found"}, LlmRefused),
        ("vllm", 400, {"object": "error", "message": "too long", "code": 400}, LlmRefused),
        ("llama_cpp", 503, {"error": {"code": 503, "message": "Loading model", "type": "unavailable_error"}}, LlmBusy),
    ],
)
def test_each_servers_errors_are_told_in_its_words(
    kind: str, status: int, body: dict[str, Any], error: type[LlmError]
) -> None:
    with pytest.raises(error) as raised:
        ask(Server(json.dumps(body).encode(), "application/json", status), BASES[kind])
    inner = body.get("error", body)
    message = inner if isinstance(inner, str) else inner["message"]
    assert str(raised.value) == f"the language model's server answered {status}: {message}"


def test_an_overload_inside_anthropics_stream_may_be_tried_again() -> None:
    event = {"type": "error", "error": {"type": "overloaded_error", "message": "Overloaded"}}
    with pytest.raises(LlmBusy, match="Overloaded"):
        ask(Server(f"event: error\ndata: {json.dumps(event)}\n\n".encode()), BASES["anthropic"])


def test_the_way_of_speaking_can_be_set_where_the_address_does_not_tell() -> None:
    server = Server((RECORDED / "anthropic.sse").read_bytes())
    assert ask(server, "http://127.0.0.1:9000", llm_api=LlmApi.ANTHROPIC).tokens.output == 31
    assert server.requests[0].url.path == "/v1/messages"


def test_pictures_go_along_as_each_kind_of_server_reads_them() -> None:
    shown = (Message(Role.USER, "Which?", images=(b"PNG",)),)
    openai = wire_of(LlmSettings(llm_base_url=BASES["openai"])).body(shown, 0.0)["messages"][0]["content"]
    assert openai == [
        {"type": "text", "text": "Which?"},
        {"type": "image_url", "image_url": {"url": "data:image/png;base64,UE5H"}},
    ]
    anthropic = wire_of(LlmSettings(llm_base_url=BASES["anthropic"], llm_api=LlmApi.ANTHROPIC)).body(shown, 0.0)
    source = {"type": "base64", "media_type": "image/png", "data": "UE5H"}
    assert anthropic["messages"][0]["content"] == [
        {"type": "image", "source": source},
        {"type": "text", "text": "Which?"},
    ]


def test_anthropic_keeps_what_is_the_same_for_all_models_then_the_model_then_the_conversation() -> None:
    wire = wire_of(LlmSettings(llm_base_url=BASES["anthropic"], llm_api=LlmApi.ANTHROPIC))
    first = conversation("How many holes are there?", None)
    system = wire.body(first, 0.0)["system"]
    assert [block["cache_control"] for block in system] == [{"type": "ephemeral"}] * 2
    assert system[1]["text"].startswith("# The model that is asked about")
    assert "find_parts" in system[0]["text"]
    longer = (*first, Message(Role.ASSISTANT, "x"), Message(Role.USER, "y"))
    body = wire.body(longer, 0.0)
    marked = [turn for turn in body["messages"] if any("cache_control" in block for block in turn["content"])]
    assert marked == [body["messages"][-1]]
    assert sum("cache_control" in block for turn in body["messages"] for block in turn["content"]) + len(system) <= 4
