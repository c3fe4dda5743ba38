"""The client waits, tries again where that does no harm, and says what the service said."""

from __future__ import annotations

import asyncio
import inspect
import socket
from collections.abc import Callable
from json import loads
from pathlib import Path
from typing import Any

import httpx
import pytest
from pydantic import BaseModel

from querycad import flows as module
from querycad.cli import main
from querycad.client import AsyncClient, Client, ServerProblem, ServerUnreachable
from querycad.commands.server import KEY_VARIABLE
from querycad.flows import NobodyThere
from querycad_contracts import (
    AnswerRecord,
    AnswerType,
    Job,
    JobEvent,
    JobEventKind,
    JobStatus,
    LengthUnit,
    ModelResource,
    ParameterRequest,
    ParameterSet,
    ParametersRequest,
    Problem,
    RunOutcome,
    RunStatus,
    Status,
)

MODEL, JOB = "a" * 64, "b" * 32
RECORD = AnswerRecord(
    question="?", status=Status.ANSWERED, answer=None, code=None, codegen=None, parts=(), timings_ms={}, warnings=()
)
QUEUED = Job.model_validate(
    {"id": JOB, "model": MODEL, "question": "?", "unit": "mm", "status": "queued", "created": "2026-01-01T00:00:00Z"}
)
DONE = QUEUED.model_copy(update={"record": RECORD, "status": JobStatus.DONE})
AWAY = Problem(title="Service unavailable", status=503, detail="away", retryable=True)


def json(body: BaseModel, status: int = 200) -> httpx.Response:
    return httpx.Response(status, content=body.model_dump_json(), headers={"Content-Type": "application/json"})


def client(*answers: httpx.Response | Exception) -> tuple[Client, list[httpx.Request]]:
    left, requests = list(answers), []

    def answer(request: httpx.Request) -> httpx.Response:
        requests.append(request)
        following = left.pop(0)
        if isinstance(following, Exception):
            raise following
        return following

    return Client("http://service", transport=httpx.MockTransport(answer)), requests


@pytest.fixture(autouse=True)
def no_pause(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(module, "PAUSE_S", 0.0)


def test_an_answer_that_is_there_in_time_takes_one_request() -> None:
    with (made := client(json(DONE)))[0] as asking:
        assert asking.ask(MODEL, "?", LengthUnit.IN) == RECORD
    (request,) = made[1]
    assert request.headers["prefer"] == f"wait={module.WAIT_S}"
    assert request.url.path == f"/v1/models/{MODEL}/questions"
    assert b'"unit":"in"' in request.content


def test_an_answer_that_takes_longer_is_waited_for() -> None:
    with (made := client(json(QUEUED, 202), json(QUEUED), json(DONE)))[0] as asking:
        assert asking.ask(MODEL, "?") == RECORD
    assert [request.url.path for request in made[1][1:]] == [f"/v1/jobs/{JOB}"] * 2


def test_waiting_ends() -> None:
    with client(json(QUEUED))[0] as asking, pytest.raises(TimeoutError):
        asking.wait(JOB, 0.0)


@pytest.mark.parametrize("trouble", [lambda: json(AWAY, 503), lambda: httpx.ReadError("cut off")])
def test_a_request_that_changes_nothing_is_tried_again(trouble: Callable[[], httpx.Response | Exception]) -> None:
    with (made := client(trouble(), trouble(), json(DONE)))[0] as asking:
        assert asking.wait(JOB) == RECORD
    assert len(made[1]) == 3


def test_a_question_that_is_sent_again_is_the_same_question() -> None:
    with (made := client(json(AWAY, 503), httpx.ReadError("cut off"), json(DONE)))[0] as asking:
        assert asking.ask(MODEL, "?") == RECORD
    keys = {request.headers["idempotency-key"] for request in made[1]}
    assert (len(made[1]), len(keys)) == (3, 1)


def test_two_questions_are_two_questions() -> None:
    with (made := client(json(DONE), json(DONE)))[0] as asking:
        asking.ask(MODEL, "?")
        asking.ask(MODEL, "?")
    assert len({request.headers["idempotency-key"] for request in made[1]}) == 2


def test_a_phrase_is_asked_for_once() -> None:
    with (made := client(json(AWAY, 503)))[0] as asking, pytest.raises(ServerProblem, match="away"):
        asking.find_parts(MODEL, "hole")
    assert len(made[1]) == 1


def test_a_program_is_run_once_and_its_outcome_comes_back() -> None:
    with (made := client(json(RunOutcome(status=RunStatus.OK, value=3))))[0] as asking:
        assert asking.run(MODEL, "solution = 3", AnswerType.COUNT).value == 3
    assert made[1][0].url.path == f"/v1/models/{MODEL}/programs"
    assert b'"expects":"count"' in made[1][0].content
    with (made := client(json(AWAY, 503)))[0] as asking, pytest.raises(ServerProblem, match="away"):
        asking.run(MODEL, "solution = 3")
    assert len(made[1]) == 1


def test_the_key_goes_with_every_request() -> None:
    requests: list[httpx.Request] = []

    def answer(request: httpx.Request) -> httpx.Response:
        requests.append(request)
        return json(DONE)

    with Client("http://service", "qc_1_2", httpx.MockTransport(answer)) as asking:
        asking.ask(MODEL, "?")
    assert requests[0].headers["authorization"] == "Bearer qc_1_2"


def test_an_upload_tells_how_far_it_is_and_begins_anew_when_it_is_sent_again(tmp_path: Path) -> None:
    file = tmp_path / "a.step"
    file.write_bytes(b"x" * 200_000)
    model = ModelResource.model_validate(
        {"id": MODEL, "file_name": "a", "size_bytes": 1, "created": "2026-01-01T00:00:00Z", "status": "ready"}
    )
    told: list[tuple[int, int]] = []
    with (made := client(json(AWAY, 503), json(model)))[0] as asking:
        assert asking.upload(file, progress=lambda sent, size: told.append((sent, size))) == model
    assert {size for _, size in told} == {200_000}
    assert [sent for sent, _ in told].count(65536) == 2
    assert max(told) == told[-1] == (200_000, 200_000)
    assert all(request.read().count(b"x" * 200_000) == 1 for request in made[1])


def stream(*events: JobEvent) -> httpx.Response:
    blocks = [f"id: {each.kind}-1\nevent: {each.kind}\ndata: {each.model_dump_json()}\n\n" for each in events]
    return httpx.Response(200, text=": ping\n\n" + "".join(blocks), headers={"Content-Type": "text/event-stream"})


STEPS = [
    JobEvent(kind=kind, at=QUEUED.created, record=RECORD if kind is JobEventKind.DONE else None)
    for kind in (JobEventKind.QUEUED, JobEventKind.STARTED, JobEventKind.DONE)
]


def test_events_go_on_where_the_connection_broke() -> None:
    with (made := client(stream(STEPS[0]), httpx.ReadError("cut off"), stream(*STEPS[1:])))[0] as asking:
        assert list(asking.events(JOB)) == STEPS
    assert [request.headers.get("last-event-id") for request in made[1]] == [None, "queued-1", "queued-1"]


def test_events_of_no_job_are_refused() -> None:
    problem = Problem(title="No such job", status=404)
    with client(json(problem, 404))[0] as asking, pytest.raises(ServerProblem, match="No such job"):
        list(asking.events(JOB))


def test_the_asynchronous_client_does_the_same() -> None:
    left = [json(AWAY, 503), json(QUEUED, 202), json(DONE), stream(*STEPS)]
    asynchronous = AsyncClient("http://service", transport=httpx.MockTransport(lambda _: left.pop(0)))

    async def ask() -> tuple[AnswerRecord, list[JobEvent]]:
        async with asynchronous as asking:
            return await asking.ask(MODEL, "?"), [event async for event in asking.events(JOB)]

    assert asyncio.run(ask()) == (RECORD, STEPS)


def test_both_clients_have_the_same_methods() -> None:
    def methods(kind: type) -> dict[str, list[str]]:
        public = {name: value for name, value in vars(kind).items() if callable(value) and not name.startswith("_")}
        return {name: list(inspect.signature(value).parameters) for name, value in public.items()}

    assert methods(Client) == methods(AsyncClient)
    assert len(methods(Client)) > 15


def test_trouble_that_stays_is_told() -> None:
    with client(*[httpx.ReadError("cut off")] * 5)[0] as asking, pytest.raises(ServerUnreachable, match="cut off"):
        asking.model(MODEL)


REFUSED = [httpx.ConnectError("refused"), httpx.ConnectTimeout("timed out")]


@pytest.mark.parametrize("error", REFUSED, ids=lambda error: type(error).__name__)
def test_where_nothing_ever_answered_is_said_at_once(error: httpx.HTTPError) -> None:
    for act in (lambda one: one.health(), lambda one: list(one.events(JOB)), lambda one: one.ask(MODEL, "?")):
        asking, requests = client(error)
        with asking, pytest.raises(NobodyThere, match=r"no service answers at http://service.*querycad serve"):
            act(asking)
        assert len(requests) == 1


def test_a_service_that_answered_before_is_waited_for_while_it_starts_again() -> None:
    with (made := client(json(DONE), *REFUSED, json(DONE)))[0] as asking:
        assert asking.job(JOB) == DONE
        assert asking.job(JOB) == DONE
    assert len(made[1]) == 4


def test_the_asynchronous_client_says_so_too() -> None:
    def refuse(_: httpx.Request) -> httpx.Response:
        raise httpx.ConnectError("refused")

    async def ask() -> None:
        async with AsyncClient("http://service", transport=httpx.MockTransport(refuse)) as asking:
            with pytest.raises(NobodyThere):
                await asking.health()
            with pytest.raises(NobodyThere):
                _ = [event async for event in asking.events(JOB)]

    asyncio.run(ask())


@pytest.mark.parametrize("kind", [Client, AsyncClient])
@pytest.mark.parametrize("url", ["localhost:8000", "127.0.0.1", "", "ftp://service"])
def test_what_is_no_address_of_a_service_is_refused(kind: type[Client | AsyncClient], url: str) -> None:
    with pytest.raises(ValueError, match="begins with http:// or https://, not "):
        kind(url)


def test_a_port_where_nobody_listens_is_refused_by_the_system_itself() -> None:
    with socket.socket() as free:
        free.bind(("127.0.0.1", 0))
        with Client(f"http://127.0.0.1:{free.getsockname()[1]}") as asking, pytest.raises(NobodyThere, match="refused"):
            asking.health()


def test_a_refusal_tells_why() -> None:
    problem = Problem(title="No such model", status=404, detail="upload its file first")
    with client(json(problem, 404))[0] as asking, pytest.raises(ServerProblem) as refused:
        asking.model(MODEL)
    assert refused.value.problem == problem


@pytest.mark.parametrize("status", [502, 503, 504])
def test_a_proxy_whose_service_is_away_is_asked_again(status: int) -> None:
    away = httpx.Response(
        status, text="<html>Bad Gateway</html>", headers={"Retry-After": "Sat, 01 Jan 2028 00:00:00 GMT"}
    )
    with (made := client(away, json(DONE)))[0] as asking:
        assert asking.wait(JOB) == RECORD
    assert len(made[1]) == 2
    with client(*[away] * 5)[0] as asking, pytest.raises(ServerUnreachable, match=f"answered {status}"):
        asking.model(MODEL)


@pytest.mark.parametrize("status", [200, 404, 500])
def test_an_answer_of_some_other_server_is_no_answer(status: int) -> None:
    strange = httpx.Response(status, text="<html>It works!</html>")
    with client(strange)[0] as asking, pytest.raises(ServerUnreachable, match="not as a QueryCAD service"):
        asking.model(MODEL)


PARAMETER = {"name": "holes", "type": "count"}


@pytest.mark.parametrize(
    ("asked", "options"),
    [
        (ParametersRequest.model_validate({"parameters": [PARAMETER], "unit": "in"}), {}),
        ({"parameters": [PARAMETER], "unit": "in"}, {}),
        ([PARAMETER], {"unit": "in"}),
        ([ParameterRequest.model_validate(PARAMETER)], {"unit": "in"}),
    ],
)
def test_parameters_are_asked_for_by_a_request_or_its_fields(asked: Any, options: dict[str, Any]) -> None:
    found = ParameterSet.model_validate({"unit": "in", "angle_unit": "rad", "parameters": [], "open": []})
    with (made := client(json(found)))[0] as asking:
        assert asking.parameters(MODEL, asked, **options) == found
    assert loads(made[1][0].content) == {"parameters": [PARAMETER], "unit": "in"}


def test_a_file_that_is_not_there_is_not_uploaded(tmp_path: Path) -> None:
    with client()[0] as asking, pytest.raises(FileNotFoundError):
        asking.upload(tmp_path / "none.step")


@pytest.mark.parametrize(
    ("question", "key", "said"),
    [
        ("", "", "bad input: the question is empty"),
        ("?" * 2001, "", "bad input: the question has"),
        ("?", "schlüssel", KEY_VARIABLE),
    ],
)
def test_what_no_service_would_take_is_one_line_of_the_command(
    question: str,
    key: str,
    said: str,
    monkeypatch: pytest.MonkeyPatch,
    capsys: pytest.CaptureFixture[str],
    tmp_path: Path,
) -> None:
    (tmp_path / "a.step").write_text("ISO-10303-21;")
    ready = ModelResource.model_validate(
        {"id": MODEL, "file_name": "a", "size_bytes": 1, "created": "2026-01-01T00:00:00Z", "status": "ready"}
    )
    transport = httpx.MockTransport(lambda _: json(ready))
    monkeypatch.setenv(KEY_VARIABLE, key)
    monkeypatch.setattr("querycad.commands.server.Client", lambda url, key: Client(url, key, transport))
    assert main(["ask", str(tmp_path / "a.step"), question, "--server", "http://service"]) == 2
    out, err = capsys.readouterr()
    assert out == ""
    assert err.startswith(f"querycad: {said}")
    assert err.count("\n") == 1
