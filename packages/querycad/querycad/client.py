"""The client of a running service.

ClientError
├── ServerProblem      the service refused; `problem` says why (RFC 9457)
└── ServerUnreachable  no answer
"""

from __future__ import annotations

import time
from pathlib import Path
from types import TracebackType
from typing import Self, TypeVar

import httpx
from pydantic import BaseModel, ValidationError

from querycad_contracts import (
    AnswerRecord,
    Health,
    Job,
    LengthUnit,
    ModelResource,
    ModelStatus,
    PartsPage,
    Problem,
    QuestionRequest,
)

WAIT_S = 30
"""How long the service is asked to wait in one request; longer waits are several requests."""
MARGIN_S = 10.0
CONNECT_RETRIES = 3
TRIES = 5
"""Of a request that changes nothing, while the service has trouble; with the pauses, a restart is survived."""
PAUSE_S = 1.0

M = TypeVar("M", bound=BaseModel)


class ClientError(Exception):
    """Something went wrong between client and service."""


class ServerProblem(ClientError):
    """The service refused a request."""

    def __init__(self, problem: Problem) -> None:
        super().__init__(problem.detail or problem.title)
        self.problem = problem


class ServerUnreachable(ClientError):
    """The service did not answer, or not as a QueryCAD service does."""


class Client:
    """Uploads models to a service and asks about them. Use it as a context manager, or call `close`.

    All methods raise ServerProblem and ServerUnreachable. `transport` replaces the network.
    """

    def __init__(self, url: str, transport: httpx.BaseTransport | None = None) -> None:
        self._http = httpx.Client(
            base_url=url,
            timeout=WAIT_S + MARGIN_S,
            transport=transport or httpx.HTTPTransport(retries=CONNECT_RETRIES),
        )

    def __enter__(self) -> Self:
        return self

    def __exit__(
        self, kind: type[BaseException] | None, error: BaseException | None, trace: TracebackType | None
    ) -> None:
        self.close()

    def close(self) -> None:
        """Closes the connections."""
        self._http.close()

    def health(self) -> Health:
        """Is the service ready?"""
        response = self._send("GET", "/readyz", accepted=(503,))
        return _parsed(Health, response)

    def upload(self, file: Path | str, wait_s: float = 0.0) -> ModelResource:
        """Uploads a file, the same one as often as wanted, and waits up to `wait_s` until it is read."""
        path = Path(file)
        deadline = time.monotonic() + wait_s
        with path.open("rb") as stream:
            response = self._send("POST", "/v1/models", files={"file": (path.name, stream)}, headers=_prefer(deadline))
        model = _parsed(ModelResource, response)
        while model.status is ModelStatus.READING and time.monotonic() < deadline:
            model = self.model(model.id, deadline - time.monotonic())
        return model

    def model(self, model: str, wait_s: float = 0.0) -> ModelResource:
        """What is known of the model?"""
        headers = _prefer(time.monotonic() + wait_s)
        return _parsed(ModelResource, self._send("GET", f"/v1/models/{model}", headers=headers))

    def parts(self, model: str, kind: str | None = None, offset: int = 0, limit: int = 100) -> PartsPage:
        """Which parts were recognised in the model?"""
        query: dict[str, str | int] = {"offset": offset, "limit": limit} | ({"kind": kind} if kind else {})
        return _parsed(PartsPage, self._send("GET", f"/v1/models/{model}/parts", params=query))

    def submit(self, model: str, question: str, unit: LengthUnit = LengthUnit.MM) -> Job:
        """Asks a question about an uploaded model, and does not wait for the answer."""
        return _parsed(Job, self._ask(model, question, unit, {}))

    def wait(self, job: str, timeout_s: float = 300.0) -> AnswerRecord:
        """What came of the question? Raises TimeoutError when it is not done in time."""
        deadline = time.monotonic() + timeout_s
        while True:
            found = _parsed(Job, self._send("GET", f"/v1/jobs/{job}", headers=_prefer(deadline)))
            if found.record is not None:
                return found.record
            if time.monotonic() >= deadline:
                raise TimeoutError(f"the question was not answered within {timeout_s:g} s")

    def ask(
        self, model: str, question: str, unit: LengthUnit = LengthUnit.MM, timeout_s: float = 300.0
    ) -> AnswerRecord:
        """What is the answer to the question about an uploaded model? Raises TimeoutError."""
        deadline = time.monotonic() + timeout_s
        response = self._ask(model, question, unit, _prefer(deadline))
        if response.status_code == httpx.codes.OK:
            return _parsed(AnswerRecord, response)
        return self.wait(_parsed(Job, response).id, deadline - time.monotonic())

    def picture(self, model: str, job: str) -> bytes:
        """The PNG file that shows what the answer rests on."""
        return self._send("GET", f"/v1/models/{model}/answers/{job}/picture").content

    def _ask(self, model: str, question: str, unit: LengthUnit, headers: dict[str, str]) -> httpx.Response:
        asked = QuestionRequest(question=question, unit=unit).model_dump(mode="json")
        return self._send("POST", f"/v1/models/{model}/questions", json=asked, headers=headers)

    def _send(self, method: str, path: str, accepted: tuple[int, ...] = (), **options: object) -> httpx.Response:
        tries = TRIES if method == "GET" else 1  # asking twice would be two questions
        for attempt in range(1, tries + 1):
            try:
                response = self._http.request(method, path, **options)  # type: ignore[arg-type]
            except httpx.HTTPError as error:
                failure: ClientError = ServerUnreachable(f"{self._http.base_url} does not answer: {error}")
                retryable = True
            else:
                if response.is_success or response.status_code in accepted:
                    return response
                problem = _parsed(Problem, response)
                failure, retryable = ServerProblem(problem), problem.retryable
            if not retryable or attempt == tries:
                raise failure
            time.sleep(PAUSE_S)
        raise AssertionError("the last try returns or raises")


def _prefer(deadline: float) -> dict[str, str]:
    left_s = int(min(WAIT_S, deadline - time.monotonic() + 0.5))
    return {"Prefer": f"wait={left_s}"} if left_s > 0 else {}


def _parsed(kind: type[M], response: httpx.Response) -> M:
    try:
        return kind.model_validate_json(response.content)
    except ValidationError as error:
        message = f"{response.request.url} answered {response.status_code}, not as a QueryCAD service does"
        raise ServerUnreachable(message) from error
