"""What can be wrong with a request: each problem is an exception, and says in the interface's description what it is.

ApiProblem
├── Malformed            400
├── NotAsDocumented      422
├── NotThere             404
├── NotAuthenticated     401
├── NotAllowed           403
├── ModelNotFound        404
├── FaceNotFound         404
├── JobNotFound          404
├── PictureNotFound      404
├── JobIsDone            409
├── TooSlow              408
├── KeyReused            422
├── TooManyRequests      429
├── TooLarge             413
├── FileTooLarge         413
├── NotStepFile          415
├── WrongMediaType       415
├── RangeNotSatisfiable  416
├── ModelNotReady        409
├── ModelUnreadable      422
├── QuotaReached         507
├── DiskFull             507
└── ServiceUnavailable   503
"""

from __future__ import annotations

import logging
import re
from collections.abc import Mapping, Sequence
from errno import EDQUOT, ENOSPC
from http import HTTPStatus
from typing import Any, ClassVar

from fastapi import FastAPI, Request, Response
from fastapi.exceptions import RequestValidationError
from redis.exceptions import RedisError
from starlette.exceptions import HTTPException

from querycad_contracts import Problem, ProblemError

STREAM = "/events"
"""Where the paths of streams end."""
UPLOAD_PATH = "/v1/models"
PROBLEM_JSON = "application/problem+json"
PROBLEM_SCHEMA: dict[str, Any] = {PROBLEM_JSON: {"schema": {"$ref": "#/components/schemas/Problem"}}}
RETRY_AFTER_S = 2

log = logging.getLogger(__name__)


class ApiProblem(Exception):
    """A request that was not done; `str()` is the sentence for the user."""

    status: ClassVar[HTTPStatus]
    title: ClassVar[str]
    retryable: ClassVar[bool] = False
    headers: ClassVar[dict[str, str]] = {}

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


class Malformed(ApiProblem):
    """The body is no JSON, or no multipart form."""

    status = HTTPStatus.BAD_REQUEST
    title = "Bad Request"


class WrongMediaType(ApiProblem):
    """The body is of another media type than the one that is documented."""

    status = HTTPStatus.UNSUPPORTED_MEDIA_TYPE
    title = "Unsupported media type"


class RangeNotSatisfiable(ApiProblem):
    """The range begins behind the file's end."""

    status = HTTPStatus.REQUESTED_RANGE_NOT_SATISFIABLE
    title = "Range not satisfiable"

    def __init__(self, size: int) -> None:
        super().__init__(f"the file has {size} bytes")
        self.headers = {"Content-Range": f"bytes */{size}"}  # type: ignore[misc]


class NotAsDocumented(ApiProblem):
    """The body is not as documented; `errors` says where."""

    status = HTTPStatus.UNPROCESSABLE_ENTITY
    title = "Not as documented"


class NotThere(ApiProblem):
    """The path leads nowhere: an id, or a name in it, is none."""

    status = HTTPStatus.NOT_FOUND
    title = "Nothing there"


class TooLarge(ApiProblem):
    """The body is larger than any such request."""

    status = HTTPStatus.REQUEST_ENTITY_TOO_LARGE
    title = "Request too large"


class TooSlow(ApiProblem):
    """The body of the request comes too slowly."""

    status = HTTPStatus.REQUEST_TIMEOUT
    title = "Request too slow"
    retryable = True


class NotAuthenticated(ApiProblem):
    """There is no valid API key with the request."""

    status = HTTPStatus.UNAUTHORIZED
    title = "No valid API key"
    headers: ClassVar[dict[str, str]] = {"WWW-Authenticate": "Bearer"}


class NotAllowed(ApiProblem):
    """The API key, or the page that the request comes from, is not allowed to do this."""

    status = HTTPStatus.FORBIDDEN
    title = "Not allowed"


class ModelNotFound(ApiProblem):
    """There is no such model."""

    status = HTTPStatus.NOT_FOUND
    title = "No such model"


class FaceNotFound(ApiProblem):
    """The model has no such face."""

    status = HTTPStatus.NOT_FOUND
    title = "No such face"


class JobNotFound(ApiProblem):
    """There is no such job, or it is no longer kept."""

    status = HTTPStatus.NOT_FOUND
    title = "No such job"


class PictureNotFound(ApiProblem):
    """The answer has no picture."""

    status = HTTPStatus.NOT_FOUND
    title = "No such picture"


class JobIsDone(ApiProblem):
    """The question has its answer already."""

    status = HTTPStatus.CONFLICT
    title = "Job is done"


class KeyReused(ApiProblem):
    """The idempotency key was used for another request."""

    status = HTTPStatus.UNPROCESSABLE_ENTITY
    title = "Idempotency key reused"


class TooManyRequests(ApiProblem):
    """The API key makes too many requests, or has too many open questions."""

    status = HTTPStatus.TOO_MANY_REQUESTS
    title = "Too many requests"
    retryable = True


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


class QuotaReached(ApiProblem):
    """The tenant has as many bytes of files as it may have."""

    status = HTTPStatus.INSUFFICIENT_STORAGE
    title = "Storage quota reached"


class DiskFull(ApiProblem):
    """The disk of the service is full; the request may succeed once there is space."""

    status = HTTPStatus.INSUFFICIENT_STORAGE
    title = "Disk full"
    retryable = True


class ServiceUnavailable(ApiProblem):
    """Something that the request needs does not answer."""

    status = HTTPStatus.SERVICE_UNAVAILABLE
    title = "Service unavailable"
    retryable = True


class NothingMore(Exception):
    """No problem: a stream was told to its end. 204, upon which a browser does not come again (WHATWG HTML)."""


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
        return problem_response(error.problem(), error.headers)

    @app.exception_handler(NothingMore)
    async def of_streams(_: Request, __: NothingMore) -> Response:
        return Response(status_code=HTTPStatus.NO_CONTENT)

    @app.exception_handler(RequestValidationError)
    async def of_input(request: Request, error: RequestValidationError) -> Response:
        return problem_response(_of_input(request, error.errors()))

    @app.exception_handler(HTTPException)
    async def of_http(request: Request, error: HTTPException) -> Response:
        # FastAPI lets no other exception out of its reading of a body.
        if isinstance(error.__cause__, ApiProblem):
            return await of_ours(request, error.__cause__)
        if isinstance(error.__cause__, OSError):
            return await of_files(request, error.__cause__)
        title = HTTPStatus(error.status_code).phrase
        detail = error.detail if error.detail != title else ""
        problem = Problem(title=title, status=error.status_code, detail=detail)
        headers = dict(error.headers or {})
        if error.status_code == HTTPStatus.METHOD_NOT_ALLOWED:
            # RFC 9110, 15.5.6: all of them
            headers["Allow"] = ", ".join(_allowed(app, request.scope["path"])) or headers.get("Allow", "")
        return problem_response(problem, headers)

    @app.exception_handler(RedisError)
    async def of_redis(_: Request, error: RedisError) -> Response:
        log.warning("redis: %s", error)
        return problem_response(ServiceUnavailable("the store cannot be reached; try again in a moment").problem())

    @app.exception_handler(OSError)
    async def of_files(_: Request, error: OSError) -> Response:
        log.error("files: %s", error, exc_info=error)
        if error.errno in (ENOSPC, EDQUOT):
            return problem_response(
                DiskFull("the disk of the service is full; try again when there is space").problem()
            )
        return problem_response(ServiceUnavailable("files cannot be kept or read; try again in a moment").problem())


def _of_input(request: Request, errors: Sequence[Mapping[str, Any]]) -> Problem:
    """What is wrong with a request that is not as documented.

    A path that cannot lead anywhere is 404, what is wrong in query or headers 400, in the body 415, 400 or 422.
    """
    places = {str(each["loc"][0]) for each in errors}
    told = tuple(_told(each) for each in errors)
    lines = "; ".join(f"{'.'.join(map(str, each['loc']))}: {each['msg']}" for each in errors)
    if "path" in places:
        return NotThere(lines).problem().model_copy(update={"errors": told})
    if places != {"body"}:
        return Malformed(lines).problem().model_copy(update={"errors": told})
    takes = "multipart/form-data" if request.url.path == UPLOAD_PATH else "application/json"
    sent = request.headers.get("content-type", "").partition(";")[0].strip().lower()
    if sent and sent != takes:
        return WrongMediaType(f"the body must be {takes}, not {sent}").problem()
    if any(each["type"] == "json_invalid" for each in errors):
        return Malformed(lines).problem()
    return NotAsDocumented(lines).problem().model_copy(update={"errors": told})


def _told(error: Mapping[str, Any]) -> ProblemError:
    """One error with the place that it is at: a JSON pointer (RFC 6901) into a body, a parameter's name."""
    place, *steps = map(str, error["loc"])
    if place != "body":
        return ProblemError(detail=error["msg"], parameter=".".join(steps))
    return ProblemError.in_body(steps, error["msg"])


def _allowed(app: FastAPI, path: str) -> list[str]:
    """Which methods does this path take? The router tells only those of the first route that fits."""
    fitting = (
        set(operations)
        for template, operations in app.openapi()["paths"].items()
        if re.fullmatch(re.sub(r"\\{\w+\\}", "[^/]+", re.escape(template)), path)
    )
    methods = {method.upper() for operations in fitting for method in operations}
    return sorted(methods | ({"HEAD"} if "GET" in methods and not path.endswith(STREAM) else set()))
