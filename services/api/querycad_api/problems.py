"""What can be wrong with a request: each problem is an exception, and says in the interface's description what it is.

ApiProblem
├── ModelNotFound        404
├── JobNotFound          404
├── PictureNotFound      404
├── FileTooLarge         413
├── NotStepFile          415
├── ModelNotReady        409
├── ModelUnreadable      422
└── ServiceUnavailable   503
"""

from __future__ import annotations

import logging
import re
from http import HTTPStatus
from typing import Any, ClassVar

from fastapi import FastAPI, Request, Response
from fastapi.exceptions import RequestValidationError
from redis.exceptions import RedisError
from starlette.exceptions import HTTPException

from querycad_contracts import Problem

PROBLEM_JSON = "application/problem+json"
PROBLEM_SCHEMA: dict[str, Any] = {PROBLEM_JSON: {"schema": {"$ref": "#/components/schemas/Problem"}}}
RETRY_AFTER_S = 2

log = logging.getLogger(__name__)


class ApiProblem(Exception):
    """A request that was not done; `str()` is the sentence for the user."""

    status: ClassVar[HTTPStatus]
    title: ClassVar[str]
    retryable: ClassVar[bool] = False

    def problem(self) -> Problem:
        """The body of the response."""
        slug = re.sub(r"(?<!^)(?=[A-Z])", "-", type(self).__name__).lower()
        return Problem(
            type=f"urn:querycad:problem:{slug}",
            title=self.title,
            status=self.status,
            detail=str(self),
            retryable=self.retryable,
        )


class ModelNotFound(ApiProblem):
    """There is no such model."""

    status = HTTPStatus.NOT_FOUND
    title = "No such model"


class JobNotFound(ApiProblem):
    """There is no such job, or it is no longer kept."""

    status = HTTPStatus.NOT_FOUND
    title = "No such job"


class PictureNotFound(ApiProblem):
    """The answer has no picture."""

    status = HTTPStatus.NOT_FOUND
    title = "No such picture"


class FileTooLarge(ApiProblem):
    """The file is larger than what is accepted."""

    status = HTTPStatus.REQUEST_ENTITY_TOO_LARGE
    title = "File too large"


class NotStepFile(ApiProblem):
    """The file is not STEP."""

    status = HTTPStatus.UNSUPPORTED_MEDIA_TYPE
    title = "Not a STEP file"


class ModelNotReady(ApiProblem):
    """The file is still being read."""

    status = HTTPStatus.CONFLICT
    title = "Model not ready"
    retryable = True


class ModelUnreadable(ApiProblem):
    """The file was accepted but cannot be read."""

    status = HTTPStatus.UNPROCESSABLE_ENTITY
    title = "Model unreadable"


class ServiceUnavailable(ApiProblem):
    """Something that the request needs does not answer."""

    status = HTTPStatus.SERVICE_UNAVAILABLE
    title = "Service unavailable"
    retryable = True


def responses(*kinds: type[ApiProblem]) -> dict[int | str, dict[str, Any]]:
    """How is an endpoint documented that may answer with these problems?"""
    found: dict[int | str, dict[str, Any]] = {}
    for kind in kinds:
        entry = found.setdefault(int(kind.status), {"description": "", "content": PROBLEM_SCHEMA})
        entry["description"] = " ".join(filter(None, [entry["description"], (kind.__doc__ or "").splitlines()[0]]))
    return found


def problem_response(problem: Problem, headers: dict[str, str] | None = None) -> Response:
    """The problem as a response."""
    retry = {"Retry-After": str(RETRY_AFTER_S)} if problem.retryable else {}
    return Response(
        problem.model_dump_json(), problem.status, headers={**retry, **(headers or {})}, media_type=PROBLEM_JSON
    )


def add_handlers(app: FastAPI) -> None:
    """Makes every error of the application a problem."""

    @app.exception_handler(ApiProblem)
    async def of_ours(_: Request, error: ApiProblem) -> Response:
        return problem_response(error.problem())

    @app.exception_handler(RequestValidationError)
    async def of_input(_: Request, error: RequestValidationError) -> Response:
        lines = tuple(f"{'.'.join(map(str, each['loc']))}: {each['msg']}" for each in error.errors())
        status = HTTPStatus.UNPROCESSABLE_ENTITY
        problem = Problem(title="Not as documented", status=status, detail="; ".join(lines), errors=lines)
        return problem_response(problem)

    @app.exception_handler(HTTPException)
    async def of_http(_: Request, error: HTTPException) -> Response:
        title = HTTPStatus(error.status_code).phrase
        detail = error.detail if error.detail != title else ""
        problem = Problem(title=title, status=error.status_code, detail=detail)
        return problem_response(problem, dict(error.headers or {}))

    @app.exception_handler(RedisError)
    async def of_redis(_: Request, error: RedisError) -> Response:
        log.warning("redis: %s", error)
        return problem_response(ServiceUnavailable("the store cannot be reached; try again in a moment").problem())

    @app.exception_handler(Exception)
    async def of_flaws(_: Request, __: Exception) -> Response:
        return problem_response(Problem(title="Internal error", status=500, detail="the request failed; see the log"))
