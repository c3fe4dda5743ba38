"""Keys go to their own address and into no log, record, error or kept reply."""

from __future__ import annotations

import logging
from collections.abc import Callable
from pathlib import Path

import httpx
import pytest
from tests.answering.llm.conftest import Script, said, status

from querycad_answering.eyes.mark_voting import Eyes
from querycad_answering.llm.client import HttpChatModel, open_model
from querycad_answering.llm.messages import LlmError, Message, Role, TimeLimit
from querycad_answering.llm.settings import LlmSettings

KEY, EYES_KEY = "sk-secret-of-the-writer", "sk-secret-of-the-eyes"
ASKED = (Message(Role.USER, "How many?"),)


@pytest.mark.parametrize("api", ["openai", "anthropic"])
@pytest.mark.parametrize("answer", ["said", "refused", "busy", "echo", "redirect", "broken"])
def test_a_key_is_in_no_log_and_no_error_whatever_the_server_says(
    scripted: Callable[[Script], str], caplog: pytest.LogCaptureFixture, tmp_path: Path, api: str, answer: str
) -> None:
    answers = {
        "said": said("three"),
        "refused": status(401, {"error": {"message": "wrong key"}}),
        "busy": status(503, Retry_After="0"),
        "echo": status(400, {"error": {"message": f"Incorrect API key provided: {KEY}"}}),
        "redirect": status(302, {}, Location="http://127.0.0.1:9/elsewhere"),
        "broken": said("half a", finish=None),
    }
    script = Script([answers[answer]])
    settings = LlmSettings.model_validate(
        {
            "llm_base_url": scripted(script),
            "llm_api": api,
            "llm_api_key": KEY,
            "llm_retries": 0,
            "llm_replies": tmp_path,
        }
    )
    told = ""
    with caplog.at_level(logging.DEBUG):
        try:
            told = open_model(settings).reply(ASKED, 0.0, 1, TimeLimit(10)).text
        except LlmError as error:
            told = f"{error} {error!r} {error.__cause__!r}"
    assert script.bodies
    assert KEY in str(script.headers)
    assert KEY not in told + caplog.text + repr(settings) + str(settings.model_dump())
    assert all(KEY not in path.read_text(encoding="utf-8") for path in tmp_path.rglob("*.json"))


def test_the_key_of_one_address_never_goes_to_the_other() -> None:
    sent: list[httpx.Request] = []

    def answer(request: httpx.Request) -> httpx.Response:
        sent.append(request)
        return httpx.Response(200, json={"choices": [{"message": {"content": "x"}, "finish_reason": "stop"}]})

    settings = LlmSettings.model_validate(
        {"llm_base_url": "http://writer/v1", "llm_api_key": KEY, "eyes_base_url": "http://eyes/v1"}
    )
    for eyes_key in ("", EYES_KEY):
        given = LlmSettings.model_validate({**settings.model_dump(), "llm_api_key": KEY, "eyes_api_key": eyes_key})
        eyes = given.eyes()
        assert eyes is not None
        for chosen in (given, eyes):
            HttpChatModel(chosen, httpx.MockTransport(answer)).reply(ASKED, 0.0, 1, TimeLimit(10))
    assert [(one.url.host, one.headers.get("authorization", "")) for one in sent] == [
        ("writer", f"Bearer {KEY}"),
        ("eyes", ""),
        ("writer", f"Bearer {KEY}"),
        ("eyes", f"Bearer {EYES_KEY}"),
    ]


def test_a_secret_in_a_command_is_not_the_name_of_the_eyes() -> None:
    eyes = LlmSettings(eyes_command=f"look --key {EYES_KEY}").eyes()
    assert eyes is not None
    assert EYES_KEY not in Eyes(eyes).name
    assert eyes.llm_images
