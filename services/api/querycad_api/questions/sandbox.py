"""Runs programs in the sandbox's service.

SandboxUnavailable    it does not answer, or has no segworker: try again
RunRefused            it answered that the program cannot be run: `failure` says why
"""

from __future__ import annotations

import select
from http import HTTPStatus
from http.client import HTTPConnection, HTTPException, HTTPSConnection
from urllib.parse import urlsplit

from pydantic import ValidationError

from querycad_api.store.keyspace import ModelStale
from querycad_contracts import Failure, FailureCategory, GroundedBy, Problem, Program, RunOutcome, RunRequest
from querycad_contracts.infrastructure import carried_trace

CONNECT_S = 3.0


class SandboxUnavailable(Exception):
    """The sandbox cannot be reached, or cannot reach a segworker."""


class RunRefused(Exception):
    """The program was not run, and would not be the next time."""

    def __init__(self, failure: Failure) -> None:
        super().__init__(failure.message)
        self.failure = failure


class SandboxClient:
    """Runs programs; for one process, one at a time. Its one connection is kept from run to run.

    The standard library's client: one request a question is all there is, and a general one costs that a millisecond.
    """

    def __init__(self, url: str, timeout_s: float, token: str = "") -> None:
        address = urlsplit(url)
        kind = HTTPSConnection if address.scheme == "https" else HTTPConnection
        self._http = kind(address.hostname or "", address.port, timeout=CONNECT_S)
        self._path = address.path.rstrip("/") + "/runs"
        self._timeout_s = timeout_s
        self._headers = {"Content-Type": "application/json"} | ({"Authorization": f"Bearer {token}"} if token else {})

    def run(self, program: Program, model: str, grounding: GroundedBy = GroundedBy.GEOMETRY) -> RunOutcome:
        """What comes of the program, run against the model? Raises SandboxUnavailable, RunRefused and ModelStale.

        Whatever else interrupts it, a signal among that, hangs up, which cancels the run.
        """
        request = RunRequest(
            code=program.code,
            model=model,
            expects=program.expects,
            check=not program.is_checked,
            grounding=grounding,
        )
        try:
            status, body = self._posted(request.model_dump_json().encode())
            if status == HTTPStatus.OK:
                return RunOutcome.model_validate_json(body)
            problem = Problem.model_validate_json(body)
        except (HTTPException, OSError, ValidationError) as error:
            raise SandboxUnavailable(str(error)) from error
        if status == HTTPStatus.CONFLICT:
            raise ModelStale(problem.detail)
        if problem.retryable:
            raise SandboxUnavailable(problem.detail)
        category = FailureCategory.BAD_INPUT if status == HTTPStatus.UNPROCESSABLE_ENTITY else FailureCategory.INTERNAL
        raise RunRefused(Failure(category=category, message=problem.detail or problem.title))

    def _posted(self, body: bytes) -> tuple[int, bytes]:
        """Status and body of the answer. Raises HTTPException and OSError."""
        try:
            if self._hung_up():
                self._http.close()
            if self._http.sock is None:
                self._connect()
            self._http.request("POST", self._path, body, self._headers | carried_trace())
            response = self._http.getresponse()
            return response.status, response.read()
        except BaseException:
            self._http.close()
            raise

    def close(self) -> None:
        """Closes the connection; the next run opens another."""
        self._http.close()

    def _hung_up(self) -> bool:
        """Did the sandbox close the connection? Between two answers there is nothing else to read."""
        return self._http.sock is not None and bool(select.select([self._http.sock], [], [], 0)[0])

    def _connect(self) -> None:
        self._http.connect()
        self._http.sock.settimeout(self._timeout_s)
