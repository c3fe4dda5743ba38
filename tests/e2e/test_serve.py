"""`querycad serve` as its users know it: started, asked, hurt, stopped, started again. Real processes on loopback."""

from __future__ import annotations

import json
import os
import re
import shlex
import shutil
import signal
import subprocess
import sys
import time
from collections.abc import Callable, Iterable, Iterator
from concurrent.futures import ThreadPoolExecutor
from pathlib import Path
from typing import Any

import httpx
import numpy as np
import pytest

import querycad
from querycad.client import Client, ServerProblem
from querycad.runtime import EmbeddedRuntime
from querycad_contracts import AnswerRecord, ModelStatus, ParametersRequest, Status, TableKind

ROOT = Path(__file__).parents[2]
sys.path.append(str(ROOT / "examples"))

from metawizard.kinematics import check  # noqa: E402
from metawizard.synthesise import Step  # noqa: E402

QUESTION = "What is the diameter of the holes visible from the top?"
START_S = 120.0
STEP_S = 60.0

pytestmark = pytest.mark.skipif(sys.platform != "linux", reason="processes are looked up in /proc")


class Service:
    """One `querycad serve` and the folder that it keeps its data in."""

    def __init__(self, home: Path) -> None:
        self.home = home
        self.process: subprocess.Popen[str] | None = None
        self.url = ""
        self.said: list[str] = []

    def start(self) -> None:
        command = [sys.executable, "-m", "querycad.cli", "serve", "--port", "0"]
        log = self.home.parent / "serve.log"
        with log.open("w") as stderr:
            self.process = subprocess.Popen(command, env=self.environment, stderr=stderr, text=True)
        marker = "ready at "

        def ready() -> str | None:
            assert self.process is not None
            assert self.process.poll() is None, log.read_text()
            text = log.read_text()
            return text.partition(marker)[2].split()[0] if marker in text else None

        self.url = until(ready, START_S)

    def stop(self) -> int:
        assert self.process is not None
        self.process.send_signal(signal.SIGTERM)
        return self.process.wait(STEP_S)

    @property
    def environment(self) -> dict[str, str]:
        inherited = {name: value for name, value in os.environ.items() if not name.startswith("QUERYCAD_")}
        return {**inherited, "QUERYCAD_HOME": str(self.home)}

    def pids(self, *, queue: str | None = None, module: str = "") -> dict[int, int]:
        """The service's processes, whoever started them, and the parent of each."""
        found = {}
        for folder in Path("/proc").glob("[0-9]*"):
            try:
                environment = (folder / "environ").read_bytes().split(b"\0")
                arguments = (folder / "cmdline").read_bytes().replace(b"\0", b" ").decode()
                folder_of = (folder / "cwd").readlink()
                state, parent = (folder / "stat").read_text().rpartition(")")[2].split()[:2]
            except OSError:
                continue  # it has ended
            # the store writes its title over its environment, but it lives in the folder
            ours = f"QUERYCAD_HOME={self.home}".encode() in environment or folder_of.is_relative_to(self.home)
            wanted = queue is None or f"QUERYCAD_SEGWORKER_QUEUES={queue}".encode() in environment
            if ours and wanted and state != "Z" and module in arguments:
                found[int(folder.name)] = int(parent)
        return found

    def kernels(self, parents: Iterable[int]) -> dict[int, int]:
        """The kernel's processes that these have started, and the parent of each; nothing in them tells the service."""
        found = {}
        for folder in Path("/proc").glob("[0-9]*"):
            try:
                arguments = (folder / "cmdline").read_bytes().replace(b"\0", b" ").decode()
                state, parent = (folder / "stat").read_text().rpartition(")")[2].split()[:2]
            except OSError:
                continue
            if "querycad_segworker.kernel_host" in arguments and state != "Z" and int(parent) in parents:
                found[int(folder.name)] = int(parent)
        return found

    def has_written(self, name: str) -> bool:
        """Does the store's file of changes hold this?"""
        return any(name.encode() in file.read_bytes() for file in self.home.rglob("*.aof"))

    def segcad(self) -> tuple[int, list[int]]:
        """The segworker that answers calls, and its children that do the work."""
        found = self.pids(queue="segcad", module="querycad_segworker.worker")
        (worker,) = [pid for pid, parent in found.items() if parent not in found]
        return worker, [pid for pid, parent in found.items() if parent == worker]


def until(found: Callable[[], Any], timeout_s: float) -> Any:
    """What `found` gives once it gives something."""
    deadline = time.monotonic() + timeout_s
    while not (value := found()):
        assert time.monotonic() < deadline, f"nothing within {timeout_s} s"
        time.sleep(0.1)
    return value


@pytest.fixture(scope="module")
def service(tmp_path_factory: pytest.TempPathFactory) -> Iterator[Service]:
    service = Service(tmp_path_factory.mktemp("serve") / "home")
    service.home.mkdir()
    service.start()
    yield service
    if service.process is not None and service.process.poll() is None:
        service.stop()


@pytest.fixture
def client(service: Service) -> Iterator[Client]:
    with Client(service.url) as client:
        yield client


@pytest.fixture(scope="module")
def model(service: Service, flange: Path) -> str:
    with Client(service.url) as client:
        uploaded = client.upload(flange, STEP_S)
    assert uploaded.status is ModelStatus.READY
    return uploaded.id


def without_timings(record: AnswerRecord) -> dict[str, Any]:
    return record.model_dump(mode="json", exclude={"timings_ms"})


def test_the_service_answers_just_what_the_command_answers(
    service: Service, client: Client, model: str, flange: Path
) -> None:
    command = [sys.executable, "-m", "querycad.cli", "ask", str(flange), QUESTION, "--json"]
    printed = subprocess.run(command, env=service.environment, capture_output=True, text=True, check=True).stdout
    answered = client.ask(model, QUESTION)
    assert answered.status is Status.ANSWERED
    assert without_timings(answered) == without_timings(AnswerRecord.model_validate_json(printed))
    assert list(answered.timings_ms) == list(json.loads(printed)["timings_ms"])


def test_the_service_describes_and_tabulates_as_the_command_does(
    service: Service, client: Client, model: str, flange: Path
) -> None:
    def printed(*arguments: str) -> str:
        command = [sys.executable, "-m", "querycad.cli", *arguments]
        return subprocess.run(command, env=service.environment, capture_output=True, text=True, check=True).stdout

    described = client.describe(model)
    assert described.text + "\n" == printed("describe", str(flange))
    assert len(described.questions) >= 5
    asked = client.ask(model, "What is this part?")
    assert (asked.status, asked.answer.text if asked.answer else "") == (Status.ANSWERED, described.text)
    assert client.table(model, TableKind.HOLES).model_dump_json() + "\n" == printed(
        "table", str(flange), "holes", "--format", "json"
    )
    for command in (("describe", str(flange)), ("table", str(flange), "holes", "--grouped")):
        in_inches = (*command, "--unit", "in")
        assert printed(*in_inches, "--server", service.url) == printed(*in_inches)
    path = f"{service.url}/v1/models/{model}/tables/holes"
    response = httpx.get(path, params={"format": "csv", "unit": "in", "grouped": "true"})
    assert response.headers["content-type"].startswith("text/csv")
    assert response.text == printed("table", str(flange), "holes", "--format", "csv", "--unit", "in", "--grouped")
    assert httpx.get(f"{service.url}/v1/models/{model}/tables/bananas").status_code == 404


def test_parameters_come_over_http_as_they_do_without_a_server(client: Client, model: str, flange: Path) -> None:
    asked = ParametersRequest.model_validate(
        {
            "parameters": [
                {"name": "hole_count", "question": "How many holes are there?", "type": "count"},
                {"name": "bore", "type": "approach", "question": "Where is the bore?", "side": "top"},
                {"name": "price", "type": "number", "description": "price of the part"},
            ]
        }
    )
    found = client.parameters(model, asked)
    assert (found.model, found.parameters[0].value) == (model, 11)
    assert "price" in found.open
    with EmbeddedRuntime() as runtime:
        assert runtime.parameters(flange, asked) == found.model_copy(update={"model": None})
    unknown = asked.model_copy(update={"other": "0" * 64})
    with pytest.raises(ServerProblem) as refused:
        client.parameters(model, unknown)
    assert refused.value.problem.status == 404


def test_the_synthesiser_writes_a_program_from_what_it_asks_over_http(service: Service) -> None:
    environment = service.environment | {"PYTHONPATH": str(ROOT / "examples")}
    command = [sys.executable, "-m", "metawizard.synthesise", service.url]
    done = subprocess.run(command, env=environment, capture_output=True, text=True, timeout=STEP_S, check=False)
    assert done.returncode == 0, done.stderr
    steps = [json.loads(line) for line in done.stdout.splitlines()]
    assert len(steps) == 9
    check(
        tuple(Step(step["do"], np.array(step["pose"]) if "pose" in step else None, step.get("width")) for step in steps)
    )


def test_the_benchmark_measures_a_running_service(service: Service, flange: Path, tmp_path: Path) -> None:
    folder = tmp_path / "tiny/set/flange"
    folder.mkdir(parents=True)
    (folder / "cad.step").write_bytes(flange.read_bytes())
    (folder / "input.txt").write_text("How many holes are there?\nHow many slots are there?")
    (folder / "solution.txt").write_text("11\n7")
    command = [sys.executable, "-m", "querycad.cli", "bench", "run", str(tmp_path / "tiny"), "--server", service.url]
    command += ["--out", str(tmp_path / "out"), "--jobs", "1", "--markdown", str(tmp_path / "summary.md")]
    done = subprocess.run(command, env=service.environment, capture_output=True, text=True, timeout=STEP_S, check=False)
    assert done.returncode == 0, done.stderr
    found = json.loads((tmp_path / "out/results.json").read_text())["results"]
    assert (found[0]["strict"], found[0]["answer"]) == (True, "11")
    assert "| 2 | 1 | 1 |" in (tmp_path / "summary.md").read_text()
    nobody = ["http://127.0.0.1:9" if each == service.url else each for each in command]
    away = subprocess.run(nobody, env=service.environment, capture_output=True, text=True, timeout=STEP_S, check=False)
    assert away.returncode == 2
    assert "http://127.0.0.1:9" in away.stderr


def test_a_question_may_follow_its_upload_at_once(client: Client) -> None:
    uploaded = client.upload(ROOT / "examples/gear_shaft.step")
    assert client.ask(uploaded.id, "What is the volume of the part?").status is Status.ANSWERED


def test_the_command_asks_a_running_service(service: Service, flange: Path, tmp_path: Path) -> None:
    picture = tmp_path / "answer.png"
    command = [sys.executable, "-m", "querycad.cli", "ask", str(flange), QUESTION, "--server", service.url]
    done = subprocess.run(
        [*command, "--json", "--picture", str(picture)],
        env=service.environment,
        capture_output=True,
        text=True,
        check=True,
    )
    assert AnswerRecord.model_validate_json(done.stdout).status is Status.ANSWERED
    assert picture.read_bytes().startswith(b"\x89PNG")


EXAMPLES = re.findall(r"^```python\n(.*?)^```", (ROOT / "docs/service.md").read_text(), re.MULTILINE | re.DOTALL)


@pytest.mark.parametrize("example", EXAMPLES, ids=["client", "asynchronous"])
def test_an_example_of_the_documentation_works(service: Service, model: str, example: str) -> None:
    code = example.replace("http://127.0.0.1:8000", service.url)
    command = [sys.executable, "-W", "error", "-c", code]
    done = subprocess.run(command, cwd=ROOT, capture_output=True, text=True, timeout=STEP_S, check=False)
    assert done.returncode == 0, done.stderr
    assert "11" in done.stdout


def test_what_is_no_step_file_is_a_problem(service: Service, client: Client, tmp_path: Path) -> None:
    bad = tmp_path / "bad.step"
    bad.write_bytes(b"<html>")
    with pytest.raises(ServerProblem) as refused:
        client.upload(bad)
    assert refused.value.problem.status == 415
    response = httpx.post(f"{service.url}/v1/models", files={"file": ("bad.step", b"<html>")})
    assert response.headers["content-type"] == "application/problem+json"


def test_a_file_that_is_cut_short_fails_and_says_why(client: Client, flange: Path, tmp_path: Path) -> None:
    cut = tmp_path / "cut.step"
    cut.write_bytes(flange.read_bytes()[:20_000])
    uploaded = client.upload(cut, STEP_S)
    assert uploaded.status is ModelStatus.FAILED
    assert uploaded.failure is not None
    assert "cut short" in uploaded.failure.message
    record = client.ask(uploaded.id, QUESTION)
    assert record.failure is not None
    assert (record.failure.category, record.failure.message) == ("bad_input", uploaded.failure.message)


CONFORMANCE = """
[parameters]
"path.model_id" = "{model}"
"header.Prefer" = "wait=1"

[[operations]]
include-name = "POST /v1/models"
[operations.checks.positive_data_acceptance]
expected-statuses = ["2xx", 413, 415] # of all texts, few are STEP files

[[operations]]
include-path-regex = "/questions"
[operations.checks.positive_data_acceptance]
expected-statuses = ["2xx", 422] # an idempotency key may have come with another question before

[[operations]]
include-path-regex = "/parameters"
[operations.checks.positive_data_acceptance]
expected-statuses = ["2xx", 404, 422] # names may not come twice, a matrix has to be rigid, another model to be there
"""


def test_the_service_does_what_its_description_says(service: Service, model: str, tmp_path: Path) -> None:
    (tmp_path / "schemathesis.toml").write_text(CONFORMANCE.format(model=model))
    command = [str(Path(sys.executable).with_name("schemathesis")), "--config-file", "schemathesis.toml"]
    command += [
        "run",
        f"{service.url}/openapi.json",
        "--exclude-method",
        "DELETE",
        "--phases",
        "examples,coverage,fuzzing",
    ]
    command += [
        "--max-examples",
        "3",
        "--max-time",
        "30",
        "--seed",
        "1",
        "--no-shrink",
        "--no-color",
        "--warnings",
        "off",
    ]
    done = subprocess.run(command, cwd=tmp_path, capture_output=True, text=True, timeout=STEP_S * 2, check=False)
    assert done.returncode == 0, done.stdout[-6000:]
    assert "generated" in done.stdout


def test_a_file_whose_workers_die_is_given_up_after_two_of_them(
    service: Service, client: Client, flange: Path, tmp_path: Path
) -> None:
    poison = tmp_path / "poison.step"
    slow = (ROOT / "examples/gear_shaft.step").read_bytes()  # long enough to be caught at it
    poison.write_bytes(slow + b"/* the one that kills */\n")
    uploaded = client.upload(poison)

    def reading() -> list[int]:
        """The ingest worker's children that have the file read: their kernel's host has forked a process for it."""
        hosts = service.kernels(service.pids(queue="ingest", module="querycad_segworker.worker"))
        return [hosts[host] for host in service.kernels(hosts).values()]

    killed: set[int] = set()
    for _ in range(2):
        (child,) = until(lambda: [pid for pid in reading() if pid not in killed], STEP_S)
        os.kill(child, signal.SIGKILL)
        killed.add(child)
    found = client.model(uploaded.id, STEP_S)
    assert found.status is ModelStatus.FAILED
    assert found.failure is not None
    assert "2 workers crashed on this file" in found.failure.message
    assert client.upload(flange, STEP_S).status is ModelStatus.READY


def test_what_runs_for_a_cancelled_question_is_stopped(service: Service, client: Client, model: str) -> None:
    jobs = client.submit_many(model, [QUESTION] * 30)
    ended = [client.cancel(job.id) for job in jobs[::-1]]
    assert {job.status for job in ended} == {"done"}
    categories = [job.record.failure.category if job.record and job.record.failure else "" for job in ended]
    assert "cancelled" in categories
    assert set(categories) <= {"cancelled", ""}
    assert client.ask(model, QUESTION).status is Status.ANSWERED
    assert [client.job(job.id).record for job in ended] == [job.record for job in ended]


def test_a_model_that_the_service_holds_is_used_like_one_here(
    client: Client, flange: Path, tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setenv("QUERYCAD_HOME", str(tmp_path))
    here, there = querycad.open(flange), client.open(flange)
    assert (there.id, there.name, there.shape, there.parts) == (here.id, here.name, here.shape, here.parts)
    reply = there.ask(QUESTION, unit="in")
    assert (reply.value, reply.text) == (here.ask(QUESTION, unit="in").value, here.ask(QUESTION, unit="in").text)
    assert reply.picture() == here.ask(QUESTION, unit="in").picture()
    assert there.find_parts("counterbored holes") == here.find_parts("counterbored holes")
    assert there.measure("depth", ["hole-1", "hole-11"]) == here.measure("depth", ["hole-1", "hole-11"])
    assert there.distance("hole-4", "hole-6") == here.distance("hole-4", "hole-6")
    assert there.describe("in") == here.describe("in")
    assert there.table("holes") == here.table("holes")
    assert there.picture("top", 320, 200) == here.picture("top", 320, 200)


def test_the_requests_of_the_readme_are_answered(service: Service, model: str) -> None:
    curl = shutil.which("curl")
    if curl is None:
        pytest.skip("there is no curl here")
    lines = re.findall(r"^curl (.*)$", (ROOT / "README.md").read_text(encoding="utf-8"), re.MULTILINE)
    said = []
    for line in lines:
        words = shlex.split(line.replace("http://127.0.0.1:8000", service.url).replace("MODEL", model))
        done = subprocess.run([curl, "--silent", "--fail", *words], cwd=ROOT, capture_output=True, check=True)
        said.append(json.loads(done.stdout))
    uploaded, answered = said
    assert uploaded["id"] == model
    assert answered["answer"]["value"] == 11


def test_an_answer_does_not_wait_for_a_picture(service: Service, client: Client, model: str) -> None:
    drawing = list(service.pids(queue="pictures"))
    for pid in drawing:
        os.kill(pid, signal.SIGSTOP)
    try:
        with ThreadPoolExecutor(4) as pool:
            views = [pool.submit(client.view, model, width=1000 + number) for number in range(4)]
            assert client.ask(model, "How many holes are there?").status is Status.ANSWERED
            assert client.find_parts(model, "hole").parts
            assert not any(view.done() for view in views)
            for pid in drawing:
                os.kill(pid, signal.SIGCONT)
            assert all(view.result().startswith(b"\x89PNG") for view in views)
    finally:
        for pid in drawing:
            os.kill(pid, signal.SIGCONT)


def test_the_events_of_a_question_are_told_as_they_happen(client: Client, model: str) -> None:
    job = client.submit(model, QUESTION)
    kinds = [event.kind for event in client.events(job.id)]
    assert [kinds[0], kinds[1], kinds[-1]] == ["queued", "started", "done"]
    assert kinds[2:-1] == ["program", "ran"] * (len(kinds[2:-1]) // 2)
    assert len(kinds) > 3


def test_questions_are_answered_after_a_segworker_s_child_was_killed(
    service: Service, client: Client, model: str
) -> None:
    _, (child,) = service.segcad()
    os.kill(child, signal.SIGKILL)
    assert client.ask(model, QUESTION).status is Status.ANSWERED
    assert until(lambda: [pid for pid in service.segcad()[1] if pid != child], STEP_S)


@pytest.mark.parametrize("module", ["querycad_segworker.worker", "querycad_api.worker", "querycad_sandbox.service"])
def test_a_service_that_was_killed_is_started_again_and_no_question_is_lost(
    service: Service, client: Client, model: str, module: str
) -> None:
    found = service.pids(module=module)
    leaders = {pid for pid, parent in found.items() if parent not in found}
    jobs = [client.submit(model, QUESTION) for _ in range(5)]
    for pid in leaders:
        os.kill(pid, signal.SIGKILL)
    jobs += [client.submit(model, QUESTION) for _ in range(5)]
    assert {client.wait(job.id, STEP_S).status for job in jobs} == {Status.ANSWERED}
    assert not leaders & service.pids().keys()


def test_what_was_accepted_outlives_the_store_s_death(service: Service, client: Client, model: str) -> None:
    jobs = [client.submit(model, QUESTION) for _ in range(10)]
    (store,) = service.pids(module="valkey-server")
    until(lambda: service.has_written(jobs[-1].id), STEP_S)  # within a second or two, where the disk is busy
    os.kill(store, signal.SIGKILL)
    assert {client.wait(job.id, STEP_S).status for job in jobs} == {Status.ANSWERED}
    until(lambda: client.health().ready, STEP_S)
    assert client.ask(model, QUESTION).status is Status.ANSWERED


def test_a_second_service_on_the_same_folder_is_refused(service: Service) -> None:
    command = [sys.executable, "-m", "querycad.cli", "serve", "--port", "0"]
    done = subprocess.run(command, env=service.environment, capture_output=True, text=True, timeout=STEP_S, check=False)
    assert done.returncode == 2
    assert "already running" in done.stderr


def test_it_stops_without_leaving_a_process_and_finds_its_data_again(
    service: Service, client: Client, model: str
) -> None:
    job = client.submit(model, QUESTION)
    before = client.wait(job.id)
    assert len(service.pids()) > 6
    assert service.stop() == 0
    assert service.pids() == {}
    service.start()
    with Client(service.url) as again:
        assert again.model(model).status is ModelStatus.READY
        assert again.wait(job.id) == before
        assert again.ask(model, QUESTION).answer == before.answer
