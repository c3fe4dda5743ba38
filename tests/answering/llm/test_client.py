"""Asking a language model over HTTP: bounded in time and length, patient with busy servers, discreet with the key."""

from __future__ import annotations

import json
import logging
import threading
from collections.abc import Callable
from datetime import UTC, datetime, timedelta
from email.utils import format_datetime
from pathlib import Path
from typing import Any

import pytest
from tests.answering.llm.conftest import FakeModel, Script, said, status, stream

from querycad_answering.llm.client import HttpChatModel
from querycad_answering.llm.messages import LlmBusy, LlmRefused, LlmTooSlow, Message, Reply, Role, TimeLimit
from querycad_answering.llm.replies import KeptReplies
from querycad_answering.llm.settings import LlmSettings

ASKED = (Message(Role.SYSTEM, "rules"), Message(Role.USER, "How many holes?"))
Start = Callable[[Script], str]


def ask(url: str, seconds: float = 5.0, sleeps: list[float] | None = None, **more: Any) -> Reply:
    settings = LlmSettings.model_validate({"llm_base_url": url, "llm_model": "m", "llm_api_key": "secret", **more})
    pauses = sleeps if sleeps is not None else []
    return HttpChatModel(settings, sleep=pauses.append).reply(ASKED, 0.0, 1, TimeLimit(seconds))


def test_a_streamed_reply_comes_whole_with_its_tokens(scripted: Start) -> None:
    script = Script([said("solution = 1", usage={"prompt_tokens": 12, "completion_tokens": 3})])
    reply = ask(scripted(script))
    assert (reply.text, reply.cut) == ("solution = 1", False)
    assert (reply.tokens.input, reply.tokens.output) == (12, 3)
    assert script.paths == ["/v1/chat/completions"]
    assert script.headers[0]["authorization"] == "Bearer secret"
    assert script.bodies[0]["messages"] == [
        {"role": "system", "content": "rules"},
        {"role": "user", "content": "How many holes?"},
    ]


def test_a_server_that_does_not_stream_is_understood(scripted: Start) -> None:
    whole = {"choices": [{"message": {"content": "x = 1"}, "finish_reason": "length"}], "usage": {"prompt_tokens": 2}}
    reply = ask(scripted(Script([status(200, whole)])))
    assert (reply.text, reply.cut, reply.tokens.input) == ("x = 1", True, 2)


@pytest.mark.parametrize("code", [429, 500, 503, 529])
def test_a_busy_server_is_asked_again_after_growing_pauses(scripted: Start, code: int) -> None:
    pauses: list[float] = []
    script = Script([status(code), status(code), said("done")])
    assert ask(scripted(script), 60, pauses).text == "done"
    assert len(script.bodies) == 3
    assert 0.25 <= pauses[0] <= 0.5 <= pauses[1] <= 1.0


@pytest.mark.parametrize(
    ("header", "low", "high"),
    [
        ({"Retry_After": "7"}, 7, 7),
        ({"Retry_After": "{in 40 s}"}, 1, 40),
        ({"retry_after_ms": "1500", "Retry_After": "7"}, 1.5, 1.5),
        ({"Retry_After": "soon"}, 0.25, 0.5),
    ],
)
def test_a_server_says_how_long_it_wants_to_be_left_alone(
    scripted: Start, header: dict[str, str], low: float, high: float
) -> None:
    pauses: list[float] = []
    soon = format_datetime(datetime.now(UTC) + timedelta(seconds=40), usegmt=True)
    header = {name: value.replace("{in 40 s}", soon) for name, value in header.items()}
    assert ask(scripted(Script([status(429, **header), said("done")])), 100, pauses).text == "done"
    assert len(pauses) == 1
    assert low <= pauses[0] <= high


def test_a_pause_longer_than_the_time_left_is_not_waited_for(scripted: Start) -> None:
    pauses: list[float] = []
    with pytest.raises(LlmBusy, match="429"):
        ask(scripted(Script([status(429, Retry_After="3600")])), 5, pauses)
    assert pauses == []


def test_retries_are_bounded(scripted: Start) -> None:
    script = Script([status(500)])
    with pytest.raises(LlmBusy):
        ask(scripted(script), 100, llm_retries=2)
    assert len(script.bodies) == 3


@pytest.mark.parametrize("code", [400, 401, 403, 404])
def test_a_refusal_is_not_repeated_and_never_tells_the_key(scripted: Start, code: int) -> None:
    script = Script([status(code, {"error": {"message": "no such thing", "type": "invalid_request_error"}})])
    with pytest.raises(LlmRefused, match=f"{code}: no such thing") as refused:
        ask(scripted(script))
    assert len(script.bodies) == 1
    assert "secret" not in str(refused.value)


def test_a_parameter_that_is_not_accepted_is_renamed_or_left_out(scripted: Start) -> None:
    def refuses(name: str) -> Any:
        return status(400, {"error": {"message": "unsupported", "param": name, "code": "unsupported_parameter"}})

    script = Script([refuses("max_tokens"), refuses("temperature"), said("done")])
    assert ask(scripted(script), llm_tokens=123).text == "done"
    assert script.bodies[0].keys() - script.bodies[2].keys() == {"max_tokens", "temperature"}
    assert script.bodies[2]["max_completion_tokens"] == 123


def test_a_server_that_says_nothing_is_given_up_in_time(scripted: Start) -> None:
    hold = threading.Event()
    try:
        with pytest.raises(LlmTooSlow):
            ask(scripted(Script([stream(hold=hold)])), 0.3)
    finally:
        hold.set()


def test_a_server_that_trickles_without_end_is_given_up_in_time(scripted: Start) -> None:
    moment = iter(range(10_000))
    limit = TimeLimit(5.0, clock=lambda: float(next(moment)))
    settings = LlmSettings(llm_base_url=scripted(Script([stream(*[": alive\n\n"] * 50)])))
    with pytest.raises(LlmTooSlow):
        HttpChatModel(settings).reply(ASKED, 0.0, 1, limit)


def test_a_stream_that_is_cut_is_tried_again(scripted: Start) -> None:
    script = Script([said("half of a pro", finish=None), said("whole")])
    assert ask(scripted(script), 60).text == "whole"
    assert len(script.bodies) == 2


def test_an_endless_reply_is_cut(scripted: Start) -> None:
    event = f"data: {json.dumps({'choices': [{'delta': {'content': 'x = 1; ' * 100}}]})}\n\n"
    reply = ask(scripted(Script([stream(*[event] * 500)])), llm_tokens=100)
    assert reply.cut
    assert len(reply.text) < 3000


def test_an_endless_line_is_no_reply(scripted: Start) -> None:
    with pytest.raises(LlmBusy, match="not as documented"):
        ask(scripted(Script([stream(*["x" * 2**16] * 40)])), llm_retries=0)


@pytest.mark.parametrize("body", ["data: <html>\n\n", "data: [1]\n\n"])
def test_what_is_no_json_is_no_reply(scripted: Start, body: str) -> None:
    with pytest.raises(LlmBusy, match="not as documented"):
        ask(scripted(Script([stream(body)])), llm_retries=0)


def test_a_server_that_is_not_there_is_busy() -> None:
    with pytest.raises(LlmBusy, match=r"the language model at 127\.0\.0\.1:1 does not answer"):
        ask("http://127.0.0.1:1/v1", llm_retries=0)


def test_an_error_inside_a_stream_is_told(scripted: Start) -> None:
    event = 'data: {"error": {"message": "the model crashed", "type": "server_error"}}\n\n'
    script = Script([stream(event), said("done")])
    assert ask(scripted(script), 60).text == "done"


def test_a_redirect_takes_the_key_nowhere(scripted: Start) -> None:
    other = Script([said("stolen")])
    target = scripted(other)
    with pytest.raises(LlmRefused):
        ask(scripted(Script([status(307, {}, Location=f"{target}/chat/completions")])))
    assert other.bodies == []


def test_kept_replies_are_asked_for_once(tmp_path: Path) -> None:
    settings = LlmSettings(llm_base_url="http://127.0.0.1:1/v1", llm_replies=tmp_path / "replies")
    model = FakeModel("first", "second", "third")
    kept = KeptReplies(model, settings)
    limit = TimeLimit(5)
    assert [kept.reply(ASKED, 0.0, 1, limit).text for _ in range(2)] == ["first", "first"]
    assert kept.reply(ASKED, 0.7, 1, limit).text == "second"
    assert kept.reply(ASKED, 0.7, 2, limit).text == "third"
    assert KeptReplies(FakeModel("new"), settings).reply(ASKED, 0.0, 1, limit).text == "first"


def test_the_key_is_in_no_log_however_much_is_logged(scripted: Start, caplog: pytest.LogCaptureFixture) -> None:
    script = Script([status(401), said("x")])
    caplog.set_level(logging.DEBUG)
    url = scripted(script)
    with pytest.raises(LlmRefused):
        ask(url)
    ask(url)
    assert script.headers[1]["authorization"] == "Bearer secret"
    told = " ".join(f"{record.getMessage()} {record.args}" for record in caplog.records)
    assert "POST" in told
    assert "secret" not in told
