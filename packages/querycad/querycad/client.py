"""The clients of a running service: `Client`, and `AsyncClient` with the same methods for asynchronous programs."""

from __future__ import annotations

import asyncio
import ssl
import time
from collections.abc import AsyncIterator, Awaitable, Callable, Iterator, Sequence
from functools import cache
from pathlib import Path
from typing import TYPE_CHECKING, Any, Concatenate, ParamSpec, Self, TypeVar, cast

import httpx
from httpx_sse import EventSource

from querycad_contracts import (
    AnswerOptions,
    AnswerRecord,
    AnswerType,
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
    ParameterSet,
    ParametersRequest,
    PartsPage,
    ProgramRequest,
    RunOutcome,
    Side,
    Table,
    TableKind,
    ViewName,
)

from . import flows
from .flows import ClientError, Flow, Following, Pause, Progress, ServerProblem, ServerUnreachable
from .inputs import Parameters, request_fields

if TYPE_CHECKING:
    from .model import Model, UnitName
    from .served import AsyncModel

__all__ = ["AsyncClient", "Client", "ClientError", "ServerProblem", "ServerUnreachable"]

T = TypeVar("T")
P = ParamSpec("P")


class Client:
    """Uploads models to a service and asks about them. Use it as a context manager, or call `close`.

    All methods raise ServerProblem and ServerUnreachable, and ValueError for what no service would take, such as an
    empty question; a request that may be repeated is, while the service has trouble. `url` is
    the service's address, such as http://127.0.0.1:8000; `key` is an API key, `transport` replaces the network.
    """

    def __init__(self, url: str, key: str | None = None, transport: httpx.BaseTransport | None = None) -> None:
        self._http = httpx.Client(
            base_url=_address(url),
            headers=_identified(key),
            timeout=httpx.Timeout(flows.WAIT_S + flows.MARGIN_S, connect=flows.CONNECT_S),
            transport=transport or httpx.HTTPTransport(verify=_tls()),
        )
        self._met = False
        """Has anything ever answered?"""

    def __enter__(self) -> Self:
        return self

    def __exit__(self, *_: object) -> None:
        self.close()

    def close(self) -> None:
        """Closes the connections."""
        self._http.close()

    def health(self) -> Health:
        """Can questions be answered now, and if not, what is missing?"""
        return self._run(flows.health())

    def open(self, file: Path | str, *, unit: UnitName = LengthUnit.MM, timeout_s: float = 300.0) -> Model:
        """The model in a file of this machine, or the one with this id, as the service holds it.

        `unit`: of lengths in texts. Raises FileProblem for a file that cannot be read, as `querycad.open` does, and
        TimeoutError.
        """
        from .model import Model  # here: who only sends questions needs no grammar
        from .served import Served

        return Model(Served(self._run(flows.opened(str(file), timeout_s)), self._run), unit)

    def upload(self, path: Path | str, wait_s: float = 0.0, progress: Progress | None = None) -> ModelResource:
        """Uploads a STEP file; with `wait_s`, returns when it has been read, or after so many seconds. Raises OSError.

        The same file twice is one model. `progress` is told how many bytes were sent, of how many.
        """
        return self._run(flows.upload(Path(path), wait_s, progress))

    def model(self, model: str, wait_s: float = 0.0) -> ModelResource:
        """What is known of the model? With `wait_s`, when its file has been read, or after so many seconds."""
        return self._run(flows.model(model, wait_s))

    def models(self, offset: int = 0, limit: int = 100) -> ModelsPage:
        """Which models are there? The newest first."""
        return self._run(flows.models(offset, limit))

    def delete(self, model: str) -> None:
        """Deletes a model with its file, questions and answers."""
        return self._run(flows.delete(model))

    def parts(self, model: str, kind: str | None = None, offset: int = 0, limit: int = 100) -> PartsPage:
        """Which parts were recognised in the model?"""
        return self._run(flows.parts(model, kind, offset, limit))

    def table(
        self, model: str, kind: TableKind, grouped: bool | None = None, unit: LengthUnit = LengthUnit.MM
    ) -> Table:
        """The holes, bends, fasteners, bodies … of the model, a row each; `grouped`: a row for all that are alike.

        Numbers are SI; `unit` is that of lengths in texts.
        """
        return self._run(flows.table(model, kind, grouped, unit))

    def describe(self, model: str, unit: LengthUnit = LengthUnit.MM) -> Description:
        """What is the model, and what can be asked about it?"""
        return self._run(flows.describe(model, unit))

    def find_parts(
        self,
        model: str,
        description: str,
        sides: Sequence[Side] | None = None,
        grounding: GroundedBy = GroundedBy.GEOMETRY,
    ) -> Grounding:
        """Which parts of the model does a phrase mean, of those visible from any of `sides`?"""
        return self._run(flows.find_parts(model, description, sides, grounding))

    def run(self, model: str, code: str, expects: AnswerType | None = None) -> RunOutcome:
        """What comes of a program of the guest API, run against the model? However it ended, that is the outcome."""
        return self._run(flows.run(model, ProgramRequest(code=code, expects=expects)))

    def parameters(self, /, model: str, asked: Parameters, **options: Any) -> ParameterSet:
        """What are these named, typed parameters of the model? What is not sure has a reason in a value's place.

        `asked`: a request, its fields, or its parameters alone; `options`: further fields (docs/parameters.md).
        """
        request = ParametersRequest.model_validate({**request_fields(asked), **options})
        return self._run(flows.parameters(model, request))

    def view(self, model: str, view: ViewName = ViewName.ISOMETRIC, width: int = 800, height: int = 600) -> bytes:
        """The PNG file that shows the model from there."""
        return self._run(flows.view(model, view, width, height))

    def glb(self, model: str) -> bytes:
        """The model's triangles as binary glTF, with the id of its face at every vertex."""
        return self._run(flows.glb(model))

    def submit(
        self, model: str, question: str, unit: LengthUnit = LengthUnit.MM, options: AnswerOptions | None = None
    ) -> Job:
        """Asks a question about an uploaded model, and does not wait for the answer."""
        return self._run(flows.submit(model, question, unit, options))

    def submit_many(
        self,
        model: str,
        questions: Sequence[str],
        unit: LengthUnit = LengthUnit.MM,
        options: AnswerOptions | None = None,
    ) -> tuple[Job, ...]:
        """Asks several questions at once, up to 100: all are accepted, or none. Their jobs, in the same order."""
        return self._run(flows.submit_many(model, questions, unit, options))

    def ask(
        self,
        model: str,
        question: str,
        unit: LengthUnit = LengthUnit.MM,
        timeout_s: float = 300.0,
        options: AnswerOptions | None = None,
    ) -> AnswerRecord:
        """What is the answer to the question about an uploaded model? Raises TimeoutError."""
        return self._run(flows.ask(model, question, unit, timeout_s, options))

    def job(self, job: str) -> Job:
        """How far is the question?"""
        return self._run(flows.job(job))

    def wait(self, job: str, timeout_s: float = 300.0) -> AnswerRecord:
        """What came of the question? Raises TimeoutError when it is not done in time."""
        return self._run(flows.wait(job, timeout_s))

    def cancel(self, job: str) -> Job:
        """Calls a question off, unless it has its answer already."""
        return self._run(flows.cancel(job))

    def answers(self, model: str, offset: int = 0, limit: int = 100) -> JobsPage:
        """What was asked about the model, and what came of it? The newest first."""
        return self._run(flows.answers(model, offset, limit))

    def picture(self, model: str, job: str) -> bytes:
        """The PNG file that shows what the answer rests on."""
        return self._run(flows.picture(model, job))

    def events(self, job: str) -> Iterator[JobEvent]:
        """What happens to the question, step by step, from its start; the last event holds the record."""
        following = Following(job)
        while not following.done:
            try:
                with self._http.stream("GET", following.path, headers=following.headers) as response:
                    self._met = True
                    if response.is_success:
                        for event in EventSource(response).iter_sse():
                            yield following.told(event)
                    else:
                        response.read()
                        following.refused(response)
            except httpx.HTTPError as error:
                _must_be_met(self, error)
                time.sleep(following.broken(error))
            else:
                if not following.done:
                    time.sleep(following.broken())

    def _run(self, flow: Flow[T]) -> T:
        """Does what the flow says, step by step."""
        try:
            step = next(flow)
            while True:
                came: httpx.Response | httpx.HTTPError | None = None
                if isinstance(step, Pause):
                    time.sleep(step.seconds)
                else:
                    try:
                        came = self._http.request(step.method, step.path, headers=dict(step.headers), **step.options)
                        self._met = True
                    except httpx.HTTPError as error:
                        _must_be_met(self, error)
                        came = error
                step = flow.send(came)
        except StopIteration as end:
            result: T = end.value
            return result


def _address(url: str) -> str:
    """The address of a service. Raises ValueError for what is none, such as a host and port alone."""
    if not url.startswith(("http://", "https://")):
        raise ValueError(f"the address of a service begins with http:// or https://, not {url!r}")
    return url


def _runs_here(loop: asyncio.AbstractEventLoop) -> bool:
    """Is this the thread of the loop, which nothing may wait in for the loop?"""
    try:
        return asyncio.get_running_loop() is loop
    except RuntimeError:
        return False


def _awaited(method: Callable[Concatenate[Client, P], T]) -> Callable[Concatenate[AsyncClient, P], Awaitable[T]]:
    """The same method, which gives what `_run` does: of an AsyncClient, what is to be awaited."""
    return cast("Callable[Concatenate[AsyncClient, P], Awaitable[T]]", method)


class AsyncClient:
    """`Client` for asynchronous programs: the same methods, to be awaited; `events` with `async for`."""

    def __init__(self, url: str, key: str | None = None, transport: httpx.AsyncBaseTransport | None = None) -> None:
        self._http = httpx.AsyncClient(
            base_url=_address(url),
            headers=_identified(key),
            timeout=httpx.Timeout(flows.WAIT_S + flows.MARGIN_S, connect=flows.CONNECT_S),
            transport=transport or httpx.AsyncHTTPTransport(verify=_tls()),
        )
        self._met = False
        self._blocking = None if transport is not None else (url, key)
        """Where a client that waits finds the service."""

    async def __aenter__(self) -> Self:
        return self

    async def __aexit__(self, *_: object) -> None:
        await self.close()

    async def close(self) -> None:
        """Closes the connections."""
        await self._http.aclose()

    health = _awaited(Client.health)
    upload = _awaited(Client.upload)
    model = _awaited(Client.model)
    models = _awaited(Client.models)
    delete = _awaited(Client.delete)
    parts = _awaited(Client.parts)
    table = _awaited(Client.table)
    describe = _awaited(Client.describe)
    find_parts = _awaited(Client.find_parts)
    run = _awaited(Client.run)
    parameters = _awaited(Client.parameters)
    view = _awaited(Client.view)
    glb = _awaited(Client.glb)
    submit = _awaited(Client.submit)
    submit_many = _awaited(Client.submit_many)
    ask = _awaited(Client.ask)
    job = _awaited(Client.job)
    wait = _awaited(Client.wait)
    cancel = _awaited(Client.cancel)
    answers = _awaited(Client.answers)
    picture = _awaited(Client.picture)

    async def open(self, file: Path | str, *, unit: UnitName = LengthUnit.MM, timeout_s: float = 300.0) -> AsyncModel:
        """The model in a file of this machine, or the one with this id, as the service holds it.

        `unit`: of lengths in texts. Raises FileProblem for a file that cannot be read, as `querycad.open` does, and
        TimeoutError.
        """
        from .model import Model  # here: as above
        from .served import AsyncModel, Served

        found, loop = await self._run(flows.opened(str(file), timeout_s)), asyncio.get_running_loop()

        def do(flow: Flow[T]) -> T:
            """From another thread; on the loop's own, as a notebook draws an answer, by a client that waits."""
            if not _runs_here(loop):
                return asyncio.run_coroutine_threadsafe(self._run(flow), loop).result()
            if self._blocking is None:
                raise RuntimeError("this waits for the service: call it in a thread, by asyncio.to_thread")
            with Client(*self._blocking) as client:
                return client._run(flow)

        return AsyncModel(Model(Served(found, do), unit))

    async def events(self, job: str) -> AsyncIterator[JobEvent]:
        """What happens to the question, step by step, from its start; the last event holds the record."""
        following = Following(job)
        while not following.done:
            try:
                async with self._http.stream("GET", following.path, headers=following.headers) as response:
                    self._met = True
                    if response.is_success:
                        async for event in EventSource(response).aiter_sse():
                            yield following.told(event)
                    else:
                        await response.aread()
                        following.refused(response)
            except httpx.HTTPError as error:
                _must_be_met(self, error)
                await asyncio.sleep(following.broken(error))
            else:
                if not following.done:
                    await asyncio.sleep(following.broken())

    async def _run(self, flow: Flow[T]) -> T:
        """Does what the flow says, step by step."""
        try:
            step = next(flow)
            while True:
                came: httpx.Response | httpx.HTTPError | None = None
                if isinstance(step, Pause):
                    await asyncio.sleep(step.seconds)
                else:
                    try:
                        came = await self._http.request(
                            step.method, step.path, headers=dict(step.headers), **step.options
                        )
                        self._met = True
                    except httpx.HTTPError as error:
                        _must_be_met(self, error)
                        came = error
                step = flow.send(came)
        except StopIteration as end:
            result: T = end.value
            return result


def _must_be_met(client: Client | AsyncClient, error: httpx.HTTPError) -> None:
    """Raises NobodyThere where no connection was ever made: what never answered is not waited for."""
    if isinstance(error, flows.NO_CONNECTION) and not client._met:
        raise flows.NobodyThere(client._http.base_url, error) from error


@cache
def _tls() -> ssl.SSLContext:
    """What checks a server's certificate. Made once: it takes some 25 ms to read the known authorities."""
    return httpx.create_ssl_context()


def _identified(key: str | None) -> dict[str, str]:
    return {"Authorization": f"Bearer {key}"} if key else {}
