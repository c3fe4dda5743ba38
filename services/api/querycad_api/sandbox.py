"""Runs programs in the sandbox's service.

SandboxUnavailable    it does not answer, or has no segworker: try again
RunRefused            it answered that the program cannot be run: `failure` says why
"""

from __future__ import annotations

import httpx
from pydantic import ValidationError

from querycad_contracts import Failure, GroundedBy, Problem, Program, RunOutcome, RunRequest

CONNECT_S = 3.0


class SandboxUnavailable(Exception):
    """The sandbox cannot be reached, or cannot reach a segworker."""


class RunRefused(Exception):
    """The program was not run, and would not be the next time."""

    def __init__(self, failure: Failure) -> None:
        super().__init__(failure.message)
        self.failure = failure


class SandboxClient:
    """Runs programs; for one process."""

    def __init__(self, url: str, timeout_s: float) -> None:
        self._http = httpx.Client(base_url=url, timeout=httpx.Timeout(timeout_s, connect=CONNECT_S))

    def run(self, program: Program, model: str, grounding: GroundedBy = GroundedBy.GEOMETRY) -> RunOutcome:
        """What comes of the program, run against the model? Raises SandboxUnavailable and RunRefused."""
        request = RunRequest(code=program.code, model=model, expects=program.expects, grounding=grounding)
        try:
            response = self._http.post(
                "/runs", content=request.model_dump_json(), headers={"Content-Type": "application/json"}
            )
            if response.is_success:
                return RunOutcome.model_validate_json(response.content)
            problem = Problem.model_validate_json(response.content)
        except (httpx.HTTPError, ValidationError) as error:
            raise SandboxUnavailable(str(error)) from error
        if problem.retryable:
            raise SandboxUnavailable(problem.detail)
        category = "bad_input" if response.status_code == httpx.codes.UNPROCESSABLE_ENTITY else "internal"
        raise RunRefused(Failure(category=category, message=problem.detail or problem.title))
