"""How quick is the service, and does it keep its word while its processes die? `querycad bench service`

Everything goes over HTTP to a `querycad serve` of its own. Throughput of segworkers is measured with one and with two
segworkers in the same run.
"""

from __future__ import annotations

import contextlib
import tempfile
import threading
import time
from collections.abc import Callable, Iterator, Sequence
from concurrent.futures import ThreadPoolExecutor
from dataclasses import dataclass
from functools import partial
from pathlib import Path

import httpx
from pydantic import BaseModel, ConfigDict
from rich.console import Console
from rich.table import Table

from benchmark.scoring.items import BadBenchmark
from querycad.client import Client, ClientError
from querycad_contracts import AnswerRecord, ModelStatus
from querycad_segworker.ingest import ingest
from querycad_segworker.model import ModelStore

from .figures import QUESTIONS
from .plain_drawing import plain_drawing
from .service_processes import Service, running

CLIENTS = 8
UPLOAD_BYTES = 5 * 10**6
READ_S = 120.0
HURT_PAUSE_S = 2.0
"""Between two blows: what died is up again, or is being missed, when the next one falls."""
ANSWER_S = 300.0
ROUNDS = 3


class Figure(BaseModel):
    """One measured figure, and what it is to be."""

    model_config = ConfigDict(frozen=True)

    name: str
    value: float
    unit: str
    target: str
    holds: bool


class Chaos(BaseModel):
    """What came of the questions while processes were killed."""

    model_config = ConfigDict(frozen=True)

    asked: int
    accepted: int
    answered: int
    failed: int
    lost: int
    changed: int
    blows: tuple[str, ...]
    seconds: float

    @property
    def holds(self) -> bool:
        """Was every accepted question answered, or did it clearly fail, once? Most can be answered, and must be."""
        once = self.lost == 0 and self.changed == 0 and self.accepted == self.answered + self.failed
        return once and self.failed < self.answered


class ServiceReport(BaseModel):
    """All figures of one run."""

    model_config = ConfigDict(frozen=True)

    figures: tuple[Figure, ...]
    chaos: Chaos | None


@dataclass(frozen=True, slots=True)
class ServiceOptions:
    """What is measured, and how often."""

    model: Path
    questions: int = 200
    chaos: int = 500


def measure(options: ServiceOptions, progress: Callable[[str], None] = lambda _: None) -> ServiceReport:
    """All figures. `progress` is told what is being measured. Raises BadBenchmark and ServiceTrouble."""
    with tempfile.TemporaryDirectory(prefix="querycad-service-") as folder:
        scratch = Path(folder)
        with running(scratch / "one") as service, Client(service.url) as client:
            model = known(client, options.model)
            progress("one at a time")
            figures = _one_at_a_time(client, model, options.questions)
            progress(f"{CLIENTS} clients")
            figures += _many_clients(service, model, options.questions)
            progress("upload")
            figures += _upload(client, options.model, scratch)
            with running(scratch / "two", workers=2) as other, Client(other.url) as second:
                known(second, options.model)
                progress("one and two segworkers")
                figures += _gain(service, other, model, mesh_of(options.model, scratch / "plain"))
        chaos = None
        if options.chaos:
            progress("chaos")
            with running(scratch / "hurt", workers=2) as service, Client(service.url) as client:
                chaos = chaos_under_load(service, known(client, options.model), options.chaos)
    return ServiceReport(figures=figures, chaos=chaos)


def known(client: Client, file: Path) -> str:
    """The model, read and asked about once in every way, so that no figure holds what only the first question takes."""
    model = client.upload(file, READ_S)
    if model.status is not ModelStatus.READY:
        raise BadBenchmark(f"{file}: {model.failure.message if model.failure else 'not read in time'}")
    for question in QUESTIONS * 2:
        client.ask(model.id, question)
    return model.id


def _one_at_a_time(client: Client, model: str, count: int) -> tuple[Figure, ...]:
    taken_ms = []
    for number in range(count):
        start = time.perf_counter()
        client.ask(model, QUESTIONS[number % len(QUESTIONS)])
        taken_ms.append((time.perf_counter() - start) * 1e3)
    p50, p99 = _percentile(taken_ms, 50), _percentile(taken_ms, 99)
    return (
        Figure(name="question to answer, p50", value=p50, unit="ms", target="< 100", holds=p50 < 100),
        Figure(name="question to answer, p99", value=p99, unit="ms", target="< 500", holds=p99 < 500),
    )


def _many_clients(service: Service, model: str, count: int) -> tuple[Figure, ...]:
    def ask(share: int) -> None:
        with Client(service.url) as client:
            for number in range(share):
                client.ask(model, QUESTIONS[number % len(QUESTIONS)])

    share = max(1, count // CLIENTS)
    start, used_s = time.perf_counter(), service.processor_s()
    with ThreadPoolExecutor(CLIENTS) as pool:
        list(pool.map(ask, [share] * CLIENTS))
    rate = share * CLIENTS / (time.perf_counter() - start)
    # what does not depend on who else uses the machine: 30 answers a second on two processors
    used_ms = (service.processor_s() - used_s) / (share * CLIENTS) * 1e3
    return (
        Figure(name=f"answers with {CLIENTS} clients", value=rate, unit="1/s", target=">= 30", holds=rate >= 30),
        Figure(name="processor time an answer", value=used_ms, unit="ms", target="< 66", holds=used_ms < 66),
    )


def _upload(client: Client, file: Path, scratch: Path) -> tuple[Figure, ...]:
    """How long until 5 MB are accepted? The median of five files, each new: a comment makes each another one."""
    taken_ms = []
    for number in range(5):
        padded = scratch / f"{number}.step"
        text = file.read_bytes()
        padded.write_bytes(text + b"/* %d %s */\n" % (number, b"x" * max(0, UPLOAD_BYTES - len(text))))
        start = time.perf_counter()
        client.upload(padded)
        taken_ms.append((time.perf_counter() - start) * 1e3)
        client.upload(padded, READ_S)  # read before the next one, which would share the machine with it
    value = _percentile(taken_ms, 50)
    return (Figure(name="5 MB accepted", value=value, unit="ms", target="< 200", holds=value < 200),)


def _gain(one: Service, two: Service, model: str, mesh: Path) -> tuple[Figure, ...]:
    """How much more is drawn with two segworkers, and how much more by two plain processes, which is the ceiling?

    Rounds in turn, so that all see the same machine; the median.
    """
    sizes = iter(range(64, 2048))  # no two views are of the same width, so that none is kept from before
    for service in (one, two):
        drawn_per_s(service, model, sizes)  # imports are done
    ratios, ceilings = [], []
    with plain_drawing(mesh, 2) as draw:
        for _ in range(ROUNDS):
            ratios.append(drawn_per_s(two, model, sizes) / drawn_per_s(one, model, sizes))
            ceilings.append(draw(2) / draw(1))
    ratio, ceiling = _percentile(ratios, 50), _percentile(ceilings, 50)
    return (
        Figure(name="pictures/s, 2 segworkers / 1", value=ratio, unit="", target=">= 1.6", holds=ratio >= 1.6),
        Figure(name="  by 2 plain processes / 1", value=ceiling, unit="", target="its ceiling", holds=True),
    )


def mesh_of(file: Path, folder: Path) -> Path:
    """The file's triangles, read into a folder of one's own."""
    return ingest(file, ModelStore(folder)).mesh


def drawn_per_s(service: Service, model: str, sizes: Iterator[int], count: int = 8) -> float:
    """Views drawn a second for four clients: the segworker's work alone."""
    widths = [next(sizes) + 400 for _ in range(count)]
    with Client(service.url) as client, ThreadPoolExecutor(4) as pool:
        start = time.perf_counter()
        list(pool.map(lambda width: client.view(model, width=width, height=400), widths))
        return count / (time.perf_counter() - start)


Blow = tuple[str, Callable[[], None]]
"""What is done to the service, by name."""


def chaos_under_load(service: Service, model: str, count: int, blows: Sequence[Blow] = ()) -> Chaos:
    """Asks while each process is stopped for some seconds and goes on, then is killed, and the store is restarted.

    `count` questions at least, and as long as it takes. `blows` are struck instead where any are given.
    """
    blows = blows or blows_to_each(service)
    start = time.perf_counter()
    asked = 0
    struck = threading.Event()
    lock = threading.Lock()
    jobs: list[str] = []

    def ask() -> None:
        with Client(service.url) as client:
            nonlocal asked
            while asked < count or not struck.is_set():
                with lock:
                    number, asked = asked, asked + 1
                try:
                    job = client.submit(model, QUESTIONS[number % len(QUESTIONS)]).id
                except ClientError:
                    continue  # it was not accepted, and its client knows
                with lock:
                    jobs.append(job)
                time.sleep(0.05)

    with ThreadPoolExecutor(CLIENTS) as pool:
        asking = [pool.submit(ask) for _ in range(CLIENTS)]
        for _, strike in blows:
            time.sleep(HURT_PAUSE_S)
            strike()
        struck.set()
        for each in asking:
            each.result()
    _wait_until_up(service)
    with Client(service.url) as client:
        first = {job: _outcome(client, job) for job in jobs}
        second = {job: _outcome(client, job) for job in jobs}
    records = [record for record in first.values() if record is not None]
    return Chaos(
        asked=asked,
        accepted=len(jobs),
        answered=sum(record.answer is not None for record in records),
        failed=sum(record.answer is None for record in records),
        lost=len(jobs) - len(records),
        changed=sum(first[job] != second[job] for job in jobs) + _told_twice(service, jobs),
        blows=tuple(name for name, _ in blows),
        seconds=round(time.perf_counter() - start, 1),
    )


def blows_to_each(service: Service) -> tuple[Blow, ...]:
    """Each process that the service consists of is stopped and killed; the store is restarted."""
    processes = {
        "segworker": ("querycad_segworker.worker", "segcad"),
        "sandbox": ("querycad_sandbox.service", ""),
        "question worker": ("querycad_api.worker", ""),
        "api": ("querycad_api.app", ""),
        "store": ("valkey-server", ""),
    }
    return (
        *((f"{name} stopped for a while", partial(service.pause, *which)) for name, which in processes.items()),
        ("segworker killed", lambda: service.kill("querycad_segworker.worker", "segcad")),
        ("sandbox killed", lambda: service.kill("querycad_sandbox.service")),
        ("question worker killed", lambda: service.kill("querycad_api.worker")),
        ("api killed", lambda: service.kill("querycad_api.app")),
        ("store restarted", service.restart_store),
    )


def _wait_until_up(service: Service) -> None:
    """Waits for the last process that was killed: a client that was never answered does not try for long."""
    deadline = time.monotonic() + ANSWER_S
    with httpx.Client(base_url=service.url, timeout=5) as http:
        while time.monotonic() < deadline:
            with contextlib.suppress(httpx.HTTPError):
                if http.get("/readyz").is_success:
                    return
            time.sleep(0.2)


def _outcome(client: Client, job: str) -> AnswerRecord | None:
    """What came of the job; None when it is lost."""
    try:
        return client.wait(job, ANSWER_S)
    except (ClientError, TimeoutError):
        return None


def _told_twice(service: Service, jobs: Sequence[str]) -> int:
    """How many jobs told more than once that they are done? Their events are kept, all of them."""
    twice = 0
    with httpx.Client(base_url=service.url, timeout=30) as http:
        for job in jobs:
            twice += http.get(f"/v1/jobs/{job}/events").text.count("event: done") > 1
    return twice


def _percentile(values: Sequence[float], share: int) -> float:
    ranked = sorted(values)
    return ranked[min(len(ranked) - 1, len(ranked) * share // 100)]


def print_report(report: ServiceReport, console: Console) -> None:
    """The figures as a table."""
    table = Table("what", "value", "to be", "holds")
    for each in report.figures:
        table.add_row(each.name, f"{each.value:.3g} {each.unit}".strip(), each.target, "yes" if each.holds else "no")
    console.print(table)
    if report.chaos is not None:
        chaos = report.chaos
        console.print(
            f"chaos ({', '.join(chaos.blows)}): {chaos.asked} asked, {chaos.accepted} accepted, "
            f"{chaos.answered} answered, {chaos.failed} failed clearly, {chaos.lost} lost, {chaos.changed} told twice; "
            f"{chaos.seconds} s: " + ("holds" if chaos.holds else "does not hold")
        )
