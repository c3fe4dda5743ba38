"""What the clients do, without saying how: each flow yields what is to be sent or waited for, and is given what came.

`Client` and `AsyncClient` drive the same flows, one blocking, the other not.

ClientError
├── ServerProblem      the service refused; `problem` says why (RFC 9457)
└── ServerUnreachable  no answer
    └── NobodyThere    and there never was one
"""

from __future__ import annotations

import re
import time
from collections.abc import Callable, Generator, Mapping, Sequence
from dataclasses import dataclass, field
from pathlib import Path
from typing import Any, BinaryIO, TypeVar
from uuid import uuid4

import httpx
from httpx_sse import ServerSentEvent
from pydantic import BaseModel, ValidationError

from querycad_contracts import (
    AnswerOptions,
    AnswerRecord,
    Description,
    GroundedBy,
    Grounding,
    Health,
    Job,
    JobEvent,
    JobsPage,
    LengthUnit,
    ModelResource,
    ModelsPage,
    ModelStatus,
    ParameterSet,
    ParametersRequest,
    PartsPage,
    Problem,
    ProgramRequest,
    QuestionRequest,
    QuestionsRequest,
    RunOutcome,
    SegmentRequest,
    Side,
    Table,
    TableKind,
    ViewName,
)
from querycad_segworker.errors import FileProblem, NotStep
from querycad_segworker.files.sniff import must_be_file

from .inputs import listed, named

WAIT_S = 30
"""How long the service is asked to wait in one request; longer waits are several requests."""
MARGIN_S = 10.0
CONNECT_S = 0.9
"""A handshake is done by the system, however busy the service is."""
TRIES = 5
"""Of a request that may be repeated, while the service has trouble; with the pauses, a restart is survived."""
PAUSE_S = 1.0
LONGEST_PAUSE_S = 10.0
PROGRAM_S = 150.0
"""Longer than a service lets a program run, or looks for parameters."""
GATEWAY = (502, 503, 504)
"""What a proxy answers whose service is away."""

REFUSED_FILES = ("urn:querycad:problem:not-step-file", "urn:querycad:problem:file-too-large")
"""Types of the problems that are the file's, not the request's."""

_ID = re.compile(r"[0-9a-f]{64}")

M = TypeVar("M", bound=BaseModel)
T = TypeVar("T")

Progress = Callable[[int, int], None]
"""Told how many bytes of a file have been sent, and how many there are."""


class ClientError(Exception):
    """Something went wrong between client and service."""


class ServerProblem(ClientError):
    """The service refused a request."""

    def __init__(self, problem: Problem) -> None:
        super().__init__(problem.detail or problem.title)
        self.problem = problem


class ServerUnreachable(ClientError):
    """The service did not answer, or not as a QueryCAD service does."""


class NobodyThere(ServerUnreachable):
    """Nothing has ever answered at the service's address. Waiting would not help: it is said at once."""

    def __init__(self, url: httpx.URL, error: httpx.HTTPError) -> None:
        super().__init__(f"no service answers at {url} ({error}); `querycad serve` starts one on this machine")


NO_CONNECTION = (httpx.ConnectError, httpx.ConnectTimeout)


@dataclass(frozen=True, slots=True)
class Send:
    """A request to be sent; the flow goes on with its httpx.Response, or with the httpx.HTTPError that it ended in."""

    method: str
    path: str
    headers: Mapping[str, str] = field(default_factory=dict)
    options: Mapping[str, Any] = field(default_factory=dict)


@dataclass(frozen=True, slots=True)
class Pause:
    """Seconds to be waited."""

    seconds: float


Step = Send | Pause
Flow = Generator[Step, httpx.Response | httpx.HTTPError | None, T]


def health() -> Flow[Health]:
    """Can questions be answered now, and if not, what is missing?"""
    response = yield from _sent(Send("GET", "/readyz"), accepted=(httpx.codes.SERVICE_UNAVAILABLE,))
    return _parsed(Health, response)


def upload(path: Path, wait_s: float, progress: Progress | None) -> Flow[ModelResource]:
    """Uploads a STEP file. The same file twice is one model, so that the request may be repeated."""
    deadline = time.monotonic() + wait_s
    with path.open("rb") as file:
        size = path.stat().st_size

        def send() -> Send:
            file.seek(0)
            body = Counted(file, size, progress) if progress is not None else file
            return Send("POST", "/v1/models", _prefer(deadline), {"files": {"file": (path.name, body)}})

        found = _parsed(ModelResource, (yield from _sent(send)))
    while found.status is ModelStatus.READING and time.monotonic() < deadline:
        found = yield from model(found.id, deadline - time.monotonic())
    return found


def opened(file: str, timeout_s: float) -> Flow[ModelResource]:
    """The model in the file, or with the id, once it has been read.

    What is wrong with the file is told as where it is read here, whether it is seen before it is sent, by the service
    as it comes, or in reading it. Raises FileProblem and TimeoutError.
    """
    found = yield from model(file, timeout_s) if _ID.fullmatch(file) else _taken(Path(file), timeout_s)
    if found.status is ModelStatus.READING:
        raise TimeoutError(f"the service did not read the file within {timeout_s:g} s")
    if found.failure is not None:
        problem = FileProblem(found.failure.message)
        problem.retryable = found.failure.retryable
        raise problem
    return found


def _taken(path: Path, timeout_s: float) -> Flow[ModelResource]:
    """As `upload`. Raises FileProblem for what is no file, cannot be opened or is refused as a file."""
    try:
        must_be_file(path.resolve())
        return (yield from upload(path, timeout_s, None))
    except OSError as error:
        raise NotStep(f"{path} cannot be read: {error.strerror}") from error
    except ServerProblem as refusal:
        if refusal.problem.type not in REFUSED_FILES:
            raise
        raise FileProblem(str(refusal)) from refusal


def model(model_id: str, wait_s: float) -> Flow[ModelResource]:
    """What is known of the model?"""
    return (yield from _got(ModelResource, f"/v1/models/{model_id}", headers=_prefer(time.monotonic() + wait_s)))


def models(offset: int, limit: int) -> Flow[ModelsPage]:
    """Which models are there?"""
    return (yield from _got(ModelsPage, "/v1/models", {"offset": offset, "limit": limit}))


def delete(model_id: str) -> Flow[None]:
    """Deletes the model; one that is not there any more is deleted, too."""
    yield from _sent(Send("DELETE", f"/v1/models/{model_id}"), accepted=(httpx.codes.NOT_FOUND,))


def parts(model_id: str, kind: str | None, offset: int, limit: int) -> Flow[PartsPage]:
    """Which parts were recognised?"""
    query: dict[str, Any] = {"offset": offset, "limit": limit} | ({"kind": kind} if kind else {})
    return (yield from _got(PartsPage, f"/v1/models/{model_id}/parts", query))


def table(model_id: str, kind: TableKind, grouped: bool | None, unit: LengthUnit) -> Flow[Table]:
    """The holes, bends, bodies …"""
    query = {"unit": named(LengthUnit, unit, "unit").value} | (
        {} if grouped is None else {"grouped": str(grouped).lower()}
    )
    return (yield from _got(Table, f"/v1/models/{model_id}/tables/{named(TableKind, kind, 'table').value}", query))


def describe(model_id: str, unit: LengthUnit) -> Flow[Description]:
    """What is the model?"""
    return (
        yield from _got(
            Description, f"/v1/models/{model_id}/description", {"unit": named(LengthUnit, unit, "unit").value}
        )
    )


def find_parts(
    model_id: str, description: str, sides: Sequence[Side] | None, grounding: GroundedBy = GroundedBy.GEOMETRY
) -> Flow[Grounding]:
    """Which parts does the phrase mean?"""
    seen_from = None if sides is None else listed(sides)
    asked = SegmentRequest(description=description, sides=seen_from, grounding=grounding)
    send = Send("POST", f"/v1/models/{model_id}/segment", options={"json": asked.model_dump(mode="json")})
    return _parsed(Grounding, (yield from _sent(send)))


def run(model_id: str, program: ProgramRequest) -> Flow[RunOutcome]:
    """What comes of the program?"""
    options = {"json": program.model_dump(mode="json"), "timeout": PROGRAM_S}
    send = Send("POST", f"/v1/models/{model_id}/programs", options=options)
    return _parsed(RunOutcome, (yield from _sent(send)))


def parameters(model_id: str, asked: ParametersRequest) -> Flow[ParameterSet]:
    """What are the parameters?"""
    options = {"json": asked.model_dump(mode="json", exclude_unset=True), "timeout": PROGRAM_S}
    send = Send("POST", f"/v1/models/{model_id}/parameters", options=options)
    return _parsed(ParameterSet, (yield from _sent(send, repeatable=True)))


def view(model_id: str, name: ViewName, width: int, height: int) -> Flow[bytes]:
    """How does the model look from there?"""
    query = {"width": width, "height": height}
    send = Send("GET", f"/v1/models/{model_id}/views/{named(ViewName, name, 'view').value}", options={"params": query})
    return (yield from _sent(send)).content


def glb(model_id: str) -> Flow[bytes]:
    """The model's triangles."""
    return (yield from _sent(Send("GET", f"/v1/models/{model_id}/glb"))).content


def picture(model_id: str, job: str) -> Flow[bytes]:
    """What an answer rests on."""
    return (yield from _sent(Send("GET", f"/v1/models/{model_id}/answers/{job}/picture"))).content


def answers(model_id: str, offset: int, limit: int) -> Flow[JobsPage]:
    """What was asked about the model?"""
    return (yield from _got(JobsPage, f"/v1/models/{model_id}/answers", {"offset": offset, "limit": limit}))


def submit(model_id: str, question: str, unit: LengthUnit, options: AnswerOptions | None) -> Flow[Job]:
    """Asks, and does not wait."""
    return _parsed(Job, (yield from _asked(model_id, _request(question, unit, options), {})))


def submit_many(
    model_id: str, questions: Sequence[str], unit: LengthUnit, options: AnswerOptions | None
) -> Flow[tuple[Job, ...]]:
    """Asks several questions at once, and does not wait."""
    asked = QuestionsRequest(questions=tuple(_request(each, unit, options) for each in questions))
    body = {"json": asked.model_dump(mode="json", exclude_unset=True)}
    send = Send("POST", f"/v1/models/{model_id}/questions/batch", _once(), body)
    return _parsed(JobsPage, (yield from _sent(send))).items


def ask(
    model_id: str, question: str, unit: LengthUnit, timeout_s: float, options: AnswerOptions | None
) -> Flow[AnswerRecord]:
    """Asks, and waits."""
    deadline = time.monotonic() + timeout_s
    asked = _parsed(Job, (yield from _asked(model_id, _request(question, unit, options), _prefer(deadline))))
    return asked.record or (yield from wait(asked.id, deadline - time.monotonic()))


def job(job_id: str) -> Flow[Job]:
    """How far is the question?"""
    return (yield from _got(Job, f"/v1/jobs/{job_id}"))


def wait(job_id: str, timeout_s: float) -> Flow[AnswerRecord]:
    """What came of the question?"""
    deadline = time.monotonic() + timeout_s
    while True:
        found = yield from _got(Job, f"/v1/jobs/{job_id}", headers=_prefer(deadline))
        if found.record is not None:
            return found.record
        if time.monotonic() >= deadline:
            raise TimeoutError("the question was not answered in time")


def cancel(job_id: str) -> Flow[Job]:
    """Calls a question off; one that has its answer keeps it."""
    yield from _sent(Send("POST", f"/v1/jobs/{job_id}/cancel"), accepted=(httpx.codes.CONFLICT,), repeatable=True)
    return (yield from job(job_id))


class Following:
    """What happens to a job, across connections: where to go on, and what was told."""

    def __init__(self, job_id: str) -> None:
        self.path = f"/v1/jobs/{job_id}/events"
        self.done = False
        self._last = ""
        self._failures = 0

    @property
    def headers(self) -> dict[str, str]:
        """Of the next connection."""
        return {"Accept": "text/event-stream"} | ({"Last-Event-ID": self._last} if self._last else {})

    def told(self, event: ServerSentEvent) -> JobEvent:
        """The event, which is not asked for again."""
        self._last, self._failures = event.id, 0
        try:
            parsed = JobEvent.model_validate_json(event.data)
        except ValidationError as error:
            raise ServerUnreachable(f"{self.path} does not answer as a QueryCAD service does") from error
        self.done = parsed.record is not None
        return parsed

    def refused(self, response: httpx.Response) -> None:
        """Raises ServerProblem or ServerUnreachable, unless the next try may succeed."""
        failure, passes = _refusal(response)
        if not passes or self._failures + 1 >= TRIES:
            raise failure

    def broken(self, error: Exception | None = None) -> float:
        """How many seconds are to be waited before the next connection? Raises ServerUnreachable after a few."""
        self._failures += 1
        if self._failures >= TRIES:
            raise ServerUnreachable(f"{self.path} does not answer: {error}") from error
        return PAUSE_S


class Counted:
    """A file that tells how much of it has been read."""

    def __init__(self, file: BinaryIO, size: int, progress: Progress) -> None:
        self._file = file
        self._size = size
        self._progress = progress

    def read(self, size: int = -1) -> bytes:
        """The next bytes."""
        data = self._file.read(size)
        self._progress(self._file.tell(), self._size)
        return data

    def seek(self, offset: int, whence: int = 0) -> int:
        """As of any file."""
        return self._file.seek(offset, whence)

    def tell(self) -> int:
        """As of any file."""
        return self._file.tell()

    def fileno(self) -> int:
        """As of any file; its size is found by it."""
        return self._file.fileno()


def _request(question: str, unit: LengthUnit, options: AnswerOptions | None) -> QuestionRequest:
    given = options.model_dump(exclude_unset=True) if options is not None else {}
    return QuestionRequest.model_validate({**given, "question": question, "unit": unit})


def _asked(model_id: str, asked: QuestionRequest, headers: Mapping[str, str]) -> Flow[httpx.Response]:
    body = {"json": asked.model_dump(mode="json", exclude_unset=True)}
    return (yield from _sent(Send("POST", f"/v1/models/{model_id}/questions", {**headers, **_once()}, body)))


def _once() -> dict[str, str]:
    """Makes a question one question, however often its request is sent."""
    return {"Idempotency-Key": uuid4().hex}


def _got(
    kind: type[M], path: str, query: Mapping[str, Any] | None = None, headers: Mapping[str, str] | None = None
) -> Flow[M]:
    send = Send("GET", path, headers or {}, {"params": query} if query else {})
    return _parsed(kind, (yield from _sent(send)))


def _sent(
    send: Send | Callable[[], Send], accepted: tuple[int, ...] = (), repeatable: bool = False
) -> Flow[httpx.Response]:
    """The response to a request, which is sent again while the service has trouble, if that does no harm."""
    for attempt in range(1, TRIES + 1):
        request = send() if callable(send) else send
        again = repeatable or callable(send) or request.method != "POST" or "Idempotency-Key" in request.headers
        came = yield request
        pause_s = PAUSE_S
        if isinstance(came, httpx.HTTPError):
            failure: ClientError = ServerUnreachable(f"the service does not answer: {came}")
        else:
            assert came is not None
            if came.is_success or came.status_code in accepted:
                return came
            failure, passes = _refusal(came)
            again, pause_s = again and passes, _pause_s(came)
        if not again or attempt == TRIES:
            raise failure
        yield Pause(pause_s if PAUSE_S else 0.0)
    raise AssertionError("the last try returns or raises")


def _refusal(response: httpx.Response) -> tuple[ClientError, bool]:
    """What to raise of a response that is none, and may the same request succeed in a moment?"""
    try:
        problem = _parsed(Problem, response)
    except ServerUnreachable as strange:  # it may be a proxy's, whose service is being started again
        return strange, response.status_code in GATEWAY
    return ServerProblem(problem), problem.retryable


def _pause_s(response: httpx.Response) -> float:
    wanted = response.headers.get("Retry-After", "")
    return min(float(wanted), LONGEST_PAUSE_S) if wanted.isdigit() else PAUSE_S  # a date is none of ours


def _prefer(deadline: float) -> dict[str, str]:
    left_s = int(min(WAIT_S, deadline - time.monotonic() + 0.5))
    return {"Prefer": f"wait={left_s}"} if left_s > 0 else {}


def _parsed(kind: type[M], response: httpx.Response) -> M:
    try:
        return kind.model_validate_json(response.content)
    except ValidationError as error:
        message = f"{response.request.url} answered {response.status_code}, not as a QueryCAD service does"
        raise ServerUnreachable(message) from error
