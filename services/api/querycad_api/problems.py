"""What can be wrong with a request: an `ApiProblem` each, which the interface's description names with its status."""

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

_IN_JSON = {
    **dict.fromkeys(("model_attributes_type", "model_type", "dict_type"), "Input should be an object"),
    **dict.fromkeys(("tuple_type", "list_type"), "Input should be an array"),
    "extra_forbidden": "There is no such field",
}
"""By the type of an error, what pydantic says in terms of Python."""

log = logging.getLogger(__name__)


class ApiProblem(Exception):
    """A request that was not done; `str()` is the sentence for the user."""

    status: ClassVar[HTTPStatus]
    title: ClassVar[str]
    retryable: ClassVar[bool]
    headers: ClassVar[dict[str, str]] = {}

    def __init_subclass__(cls, status: HTTPStatus, title: str, retryable: bool = False) -> None:
        cls.status, cls.title, cls.retryable = status, title, retryable

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


class Malformed(ApiProblem, status=HTTPStatus.BAD_REQUEST, title="Bad Request"):
    """The body is no JSON, or no multipart form."""


class WrongMediaType(ApiProblem, status=HTTPStatus.UNSUPPORTED_MEDIA_TYPE, title="Unsupported media type"):
    """The body is of another media type than the one that is documented."""


class RangeNotSatisfiable(ApiProblem, status=HTTPStatus.REQUESTED_RANGE_NOT_SATISFIABLE, title="Range not satisfiable"):
    """The range begins behind the file's end."""

    def __init__(self, size: int) -> None:
        super().__init__(f"the file has {size} bytes")
        self.headers = {"Content-Range": f"bytes */{size}"}  # type: ignore[misc]


class NotAsDocumented(ApiProblem, status=HTTPStatus.UNPROCESSABLE_ENTITY, title="Not as documented"):
    """The body is not as documented; `errors` says where."""


class NotThere(ApiProblem, status=HTTPStatus.NOT_FOUND, title="Nothing there"):
    """The path leads nowhere: an id, or a name in it, is none."""


class TooLarge(ApiProblem, status=HTTPStatus.REQUEST_ENTITY_TOO_LARGE, title="Request too large"):
    """The body is larger than any such request."""


class TooSlow(ApiProblem, status=HTTPStatus.REQUEST_TIMEOUT, title="Request too slow", retryable=True):
    """The body of the request comes too slowly."""


class NotAuthenticated(ApiProblem, status=HTTPStatus.UNAUTHORIZED, title="No valid API key"):
    """There is no valid API key with the request."""

    headers: ClassVar[dict[str, str]] = {"WWW-Authenticate": "Bearer"}


class NotAllowed(ApiProblem, status=HTTPStatus.FORBIDDEN, title="Not allowed"):
    """The API key, or the page that the request comes from, is not allowed to do this."""


class ModelNotFound(ApiProblem, status=HTTPStatus.NOT_FOUND, title="No such model"):
    """There is no such model."""


class FaceNotFound(ApiProblem, status=HTTPStatus.NOT_FOUND, title="No such face"):
    """The model has no such face."""


class JobNotFound(ApiProblem, status=HTTPStatus.NOT_FOUND, title="No such job"):
    """There is no such job, or it is no longer kept."""


class PictureNotFound(ApiProblem, status=HTTPStatus.NOT_FOUND, title="No such picture"):
    """The answer has no picture."""


class JobIsDone(ApiProblem, status=HTTPStatus.CONFLICT, title="Job is done"):
    """The question has its answer already."""


class KeyReused(ApiProblem, status=HTTPStatus.UNPROCESSABLE_ENTITY, title="Idempotency key reused"):
    """The idempotency key was used for another request."""


class TooManyRequests(ApiProblem, status=HTTPStatus.TOO_MANY_REQUESTS, title="Too many requests", retryable=True):
    """The API key makes too many requests, or has too many open questions."""


class TooManyQuestions(ApiProblem, status=HTTPStatus.UNPROCESSABLE_ENTITY, title="Too many questions"):
    """The batch holds more questions than the API key may have open."""


class FileTooLarge(ApiProblem, status=HTTPStatus.REQUEST_ENTITY_TOO_LARGE, title="File too large"):
    """The file is larger than what is accepted."""


class NotStepFile(ApiProblem, status=HTTPStatus.UNSUPPORTED_MEDIA_TYPE, title="Not a STEP file"):
    """The file is not STEP."""


class ModelNotReady(ApiProblem, status=HTTPStatus.CONFLICT, title="Model not ready", retryable=True):
    """The file is still being read."""


class ModelUnreadable(ApiProblem, status=HTTPStatus.UNPROCESSABLE_ENTITY, title="Model unreadable"):
    """The file was accepted but cannot be read."""


class QuotaReached(ApiProblem, status=HTTPStatus.INSUFFICIENT_STORAGE, title="Storage quota reached"):
    """The tenant has as many bytes of files as it may have."""


class DiskFull(ApiProblem, status=HTTPStatus.INSUFFICIENT_STORAGE, title="Disk full", retryable=True):
    """The disk of the service is full; the request may succeed once there is space."""


class ServiceUnavailable(
    ApiProblem, status=HTTPStatus.SERVICE_UNAVAILABLE, title="Service unavailable", retryable=True
):
    """Something that the request needs does not answer."""


class NothingMore(Exception):
    """No problem: a stream was told to its end. 204, upon which a browser does not come again (WHATWG HTML)."""


def responses(*kinds: type[ApiProblem]) -> dict[int | str, dict[str, Any]]:
    """How is an endpoint documented that may answer with these problems?"""
    found: dict[int | str, dict[str, Any]] = {}
    for kind in kinds:
        entry = found.setdefault(int(kind.status), {"description": "", "content": PROBLEM_SCHEMA})
        entry["description"] = " ".join(filter(None, [entry["description"], (kind.__doc__ or "").splitlines()[0]]))
    return found


MODEL_PROBLEMS = responses(ModelNotFound, ModelNotReady, ModelUnreadable, ServiceUnavailable)
"""Of what asks something of a model that has been read."""
BODY_PROBLEMS = {**MODEL_PROBLEMS, **responses(Malformed, TooLarge, WrongMediaType)}
"""The same, with a body of JSON."""


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
        return _of_framework(app, request, error)

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


def _of_framework(app: FastAPI, request: Request, error: HTTPException) -> Response:
    """What the framework refuses, in our words where it has none or those of Python."""
    if error.status_code == HTTPStatus.BAD_REQUEST and (problem := _of_form(request, error.detail)) is not None:
        return problem_response(problem)
    title = HTTPStatus(error.status_code).phrase
    if error.status_code == HTTPStatus.NOT_FOUND:
        return problem_response(NotThere("this path leads nowhere; /openapi.json lists all paths").problem())
    detail = error.detail if error.detail != title else ""
    problem = Problem(title=title, status=error.status_code, detail=detail)
    headers = dict(error.headers or {})
    if error.status_code == HTTPStatus.METHOD_NOT_ALLOWED:
        # RFC 9110, 15.5.6: all of them
        headers["Allow"] = ", ".join(_allowed(app, request.scope["path"])) or headers.get("Allow", "")
    return problem_response(problem, headers)


def _of_input(request: Request, errors: Sequence[Mapping[str, Any]]) -> Problem:
    """What is wrong with a request that is not as documented.

    A path that cannot lead anywhere is 404, what is wrong in query or headers 400, in the body 415, 400 or 422.
    """
    errors = [each for each in errors if not _follows(each, errors)]
    places = {str(each["loc"][0]) for each in errors}
    errors = [{**each, "msg": _IN_JSON.get(each["type"], each["msg"])} for each in errors]
    told = tuple(_told(each) for each in errors)
    lines = "; ".join(f"{'.'.join(map(str, each['loc']))}: {each['msg']}" for each in errors)
    if "path" in places:
        return NotThere(lines).problem().model_copy(update={"errors": told})
    if places != {"body"}:
        return Malformed(lines).problem().model_copy(update={"errors": told})
    if (wrong := _wrong_media_type(request)) is not None:
        return wrong
    if any(each["type"] == "json_invalid" for each in errors):
        return Malformed(lines).problem()
    return NotAsDocumented(lines).problem().model_copy(update={"errors": told})


def _wrong_media_type(request: Request) -> Problem | None:
    """What is wrong with the kind of body that the request says it has? None where nothing is."""
    takes = "multipart/form-data" if request.url.path == UPLOAD_PATH else "application/json"
    sent = request.headers.get("content-type", "").partition(";")[0].strip().lower()
    return WrongMediaType(f"the body must be {takes}, not {sent}").problem() if sent and sent != takes else None


def _of_form(request: Request, detail: str) -> Problem | None:
    """What is wrong with an upload whose form could not be read; None of any other request."""
    if request.url.path != UPLOAD_PATH:
        return None
    if (wrong := _wrong_media_type(request)) is not None:
        return wrong
    if "exceeded maximum size" in detail:  # as Starlette says it of what has no file name
        detail = "send the file with a file name, as `curl -F file=@part.step` does: without one it is a text field"
    return Malformed(detail).problem()


def _follows(error: Mapping[str, Any], errors: Sequence[Mapping[str, Any]]) -> bool:
    """Is a list too short only because those of its items that are wrong were not counted?"""
    place = tuple(error["loc"])
    return error["type"] == "too_short" and any(
        len(other["loc"]) > len(place) and tuple(other["loc"][: len(place)]) == place for other in errors
    )


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
