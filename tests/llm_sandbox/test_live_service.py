"""The service as it is deployed: its streams, how a run is cancelled, what a dead interpreter costs, its walls."""

from __future__ import annotations

import json
import os
import signal
import threading
from collections.abc import Iterator
from concurrent.futures import ThreadPoolExecutor
from contextlib import contextmanager
from pathlib import Path
from typing import Any
from uuid import uuid4

import httpx
import pytest
from pydantic import TypeAdapter
from tests.llm_sandbox.conftest import MODEL, OTHER_MODEL, Service

from querycad_contracts import (
    GuestAnswer,
    GuestCall,
    Printed,
    RunEnded,
    RunEvent,
    RunLimits,
    RunOutcome,
    RunStarted,
    RunStatus,
)

FOR_EVER = "print('on')\nwhile True:\n    pass"
LONG = RunLimits(duration_s=30)


@contextmanager
def streaming(
    service: Service, code: str, limits: RunLimits | None = None, **more: Any
) -> Iterator[Iterator[RunEvent]]:
    """The events of a run, as they come."""
    body = {"code": code, "model": MODEL, "limits": (limits or RunLimits()).model_dump(), **more}
    headers = {"Accept": "text/event-stream"}
    with service.client.stream("POST", "/runs", content=json.dumps(body), headers=headers) as response:
        assert response.headers["content-type"].startswith("text/event-stream")
        yield events(response)


def events(response: httpx.Response) -> Iterator[RunEvent]:
    reader: TypeAdapter[RunEvent] = TypeAdapter(RunEvent)
    for line in response.iter_lines():
        if line.startswith("data: "):
            yield reader.validate_json(line.removeprefix("data: "))


def test_the_trace_that_a_run_belongs_to_goes_on_to_the_segworker(service: Service) -> None:
    trace = f"00-{'a' * 32}-{'b' * 16}-01"
    body = {"code": "solution = len(find_parts('hole'))", "model": MODEL}
    for accept in ("application/json", "text/event-stream"):
        service.segworker.traces.clear()
        service.client.post("/runs", json=body, headers={"traceparent": trace, "Accept": accept})
        assert set(service.segworker.traces) == {trace}
    service.segworker.traces.clear()
    service.client.post("/runs", json=body, headers={"traceparent": "anything else"})
    assert set(service.segworker.traces) == {None}


def test_a_stream_tells_what_happens_and_ends_with_the_outcome(service: Service) -> None:
    code = "parts = find_parts('hole', sides=['top'])\nprint(len(parts))\nsolution = parts[0].distance_to(parts[1])"
    with streaming(service, code) as told:
        heard = list(told)
    assert isinstance(heard[0], RunStarted)
    assert [type(event) for event in heard[1:]] == [
        GuestCall, GuestAnswer, Printed, GuestCall, GuestAnswer, RunEnded
    ]  # fmt: skip
    last = heard[-1]
    assert isinstance(last, RunEnded)
    assert (last.outcome.status, last.outcome.value, last.outcome.printed) == (RunStatus.OK, 0.007, "3\n")


def test_what_is_printed_comes_while_the_program_runs_and_is_cut(service: Service) -> None:
    limits = RunLimits(duration_s=30, output_bytes=100)
    run = uuid4().hex
    with streaming(service, "while True:\n    print('a' * 60)", limits, run=run) as told:
        assert next(told) == RunStarted(run=run)
        texts = ""
        while len(texts) < 100:
            event = next(told)
            assert isinstance(event, Printed)
            texts += event.text
        assert service.client.delete(f"/runs/{run}").status_code == 204
        (last,) = told
    assert isinstance(last, RunEnded)
    assert (last.outcome.status, last.outcome.printed) == (RunStatus.CANCELLED, texts)
    assert len(texts) == 100


def test_a_run_is_cancelled_by_its_id(service: Service) -> None:
    run = uuid4().hex
    with ThreadPoolExecutor(1) as thread:
        response = thread.submit(service.post, FOR_EVER, LONG, run=run)
        while service.client.delete(f"/runs/{run}").status_code != 204:
            assert not response.done()
        outcome = RunOutcome.model_validate_json(response.result().content)
    assert (outcome.status, outcome.message) == (RunStatus.CANCELLED, "the run was cancelled")
    assert service.client.delete(f"/runs/{run}").status_code == 404


def test_a_run_that_waits_for_segcad_is_cancelled(service: Service) -> None:
    run = uuid4().hex
    with streaming(service, "solution = find_parts('hole, which takes for ever')", run=run) as told:
        assert isinstance(next(told), RunStarted)
        assert isinstance(next(told), GuestCall)
        assert service.client.delete(f"/runs/{run}").status_code == 204
        *_, last = told
    assert isinstance(last, RunEnded)
    assert last.outcome.status is RunStatus.CANCELLED


def test_who_hangs_up_cancels(service: Service) -> None:
    run = uuid4().hex
    with streaming(service, FOR_EVER, LONG, run=run) as told:
        next(told)
    while service.client.delete(f"/runs/{run}").status_code == 204:
        pass  # a run that goes on is found, and cancelled; this one ends by itself or here, and then is gone
    run = uuid4().hex
    body = {"code": FOR_EVER, "model": MODEL, "limits": LONG.model_dump(), "run": run}
    with pytest.raises(httpx.ReadTimeout):
        service.client.post("/runs", content=json.dumps(body), timeout=httpx.Timeout(10, read=0.3))
    both = [service.run("solution = 1").value for _ in range(2)]
    assert both == [1, 1]


def test_an_id_that_is_under_way_is_taken(service: Service) -> None:
    run = uuid4().hex
    with streaming(service, FOR_EVER, LONG, run=run) as told:
        next(told)
        assert service.post("solution = 1", run=run).status_code == 409
        assert service.client.delete(f"/runs/{run}").status_code == 204
        list(told)
    assert service.post("solution = 1", run=run).headers["run-id"] == run


def test_an_interpreter_that_dies_costs_only_its_own_run(service: Service) -> None:
    stop = threading.Event()
    others: list[RunStatus] = []

    def keep_running() -> None:
        while not stop.is_set():
            others.append(service.run("solution = len(find_parts('hole'))").status)

    with streaming(service, FOR_EVER, LONG) as told:
        assert isinstance(next(told), RunStarted)
        assert isinstance(next(told), Printed)
        busy = the_busy_one(service)
        runner = threading.Thread(target=keep_running)
        runner.start()
        os.kill(busy, signal.SIGKILL)
        assert isinstance(next(told), Printed)  # it is run once more
        os.kill(the_busy_one(service), signal.SIGKILL)
        (last,) = told
        stop.set()
        runner.join()
    assert isinstance(last, RunEnded)
    assert (last.outcome.status, last.outcome.message) == (RunStatus.CRASHED, "the interpreter crashed")
    assert set(others) <= {RunStatus.OK}
    assert service.process.poll() is None
    assert service.run("solution = 1").value == 1


def the_busy_one(service: Service) -> int:
    """The interpreter that computes now."""
    before = {pid: ticks(pid) for pid in service.interpreters()}
    while True:
        for pid in service.interpreters():
            if ticks(pid) >= before.get(pid, 0) + 10:
                return pid


def ticks(pid: int) -> int:
    """Hundredths of seconds that a process has computed for; none when it has gone."""
    try:
        fields = Path(f"/proc/{pid}/stat").read_text().rpartition(")")[2].split()
    except (FileNotFoundError, ProcessLookupError):
        return -1
    return int(fields[11]) + int(fields[12])


def test_a_run_that_wants_more_memory_than_there_is_is_told_so(service: Service) -> None:
    limits = RunLimits(memory_bytes=512 * 2**20, duration_s=20)
    outcome = service.run("x = []\nwhile True:\n    x.append('a' * 10**7)", limits)
    assert (outcome.status, outcome.message) == (RunStatus.OUT_OF_MEMORY, "the program ran out of memory")


def test_each_run_asks_about_its_own_model_only(service: Service) -> None:
    service.segworker.models.clear()
    body = {"code": f"find_parts('hole')\nsolution = find_parts('{MODEL}hole')[0].id", "model": OTHER_MODEL}
    assert service.client.post("/runs", json=body).json()["value"] == "hole-1"
    assert service.segworker.models == {OTHER_MODEL}
    service.segworker.models.clear()


@pytest.mark.skipif(not Path("/sys/kernel/security").exists(), reason="Linux only")
def test_the_processes_are_shut_in_as_health_says(service: Service) -> None:
    layers = service.client.get("/readyz").json()["layers"]
    assert service.interpreters()
    for pid in service.interpreters():
        status = dict(line.split(":\t", 1) for line in Path(f"/proc/{pid}/status").read_text().splitlines())
        assert (status["Seccomp"] == "2") == layers["seccomp"]
        assert (status["NoNewPrivs"] == "1") == layers["no_new_privileges"]
        assert (status["Uid"].split()[0] != "0") == layers["unprivileged_user"]
        if layers["unprivileged_user"]:
            assert int(status["CapEff"], 16) == 0
        assert Path(f"/proc/{pid}/environ").read_bytes() == b"" or not os.access(f"/proc/{pid}/environ", os.R_OK)
    own = Path(f"/proc/{service.process.pid}/environ").read_bytes()
    assert b"hunter2" not in own
    assert b"QUERYCAD_REDIS_URL=" in own


def test_typed_calls_reach_the_segworker_and_come_back(service: Service) -> None:
    code = (
        'holes = parts(kind="hole", near=(1.0, 0.0, 0.0))\n'
        "boss = parts(kind='boss')[0]\n"
        "solution = [holes[0].id, len(faces(kind='cylinder')), boss.size_in(boss.frame), adjacent(boss, faces()[0])]"
    )
    outcome = service.run(code)
    assert (outcome.message, outcome.value) == ("", ["hole-3", 1, [0.02, 0.03, 0.01], True])
