"""The MCP server: `querycad.open` and its models as tools and resources for agents.

Outputs are small: ids of parts in short, tables a page at a time, pictures only where one looks. An error says what to
do next. One model is read, and one program run, at a time.
"""

from __future__ import annotations

from collections import OrderedDict
from collections.abc import Callable, Iterable, Sequence
from functools import wraps
from importlib.metadata import version
from math import degrees
from pathlib import Path
from threading import Lock
from typing import Annotated, Any, Literal, ParamSpec, TypeVar

import anyio
from mcp.server.mcpserver import Image, MCPServer
from mcp.server.mcpserver.exceptions import ResourceNotFoundError, ToolError
from mcp.server.stdio import stdio_server
from mcp.shared.message import SessionMessage
from mcp_types import (
    JSONRPCError,
    JSONRPCNotification,
    JSONRPCRequest,
    JSONRPCResponse,
    RequestId,
    ToolAnnotations,
)
from pydantic import Field, ValidationError

from querycad_answering.answering import SURE
from querycad_answering.drawing.callouts import callouts, ids_text
from querycad_answering.drawing.writing import written
from querycad_answering.llm.hints import hint
from querycad_contracts import (
    LengthUnit,
    Measure,
    Part,
    RunStatus,
    Status,
    TableFormat,
    TableKind,
    ViewName,
)
from querycad_contracts.guest_reference import guest_api_prompt
from querycad_segworker.errors import FileProblem

from .mcp_outputs import Answered, FoundParts, Group, Measured, Opened, Ran, TablePage
from .measuring import NoValue
from .model import Model, Reply
from .runtime import EmbeddedRuntime

T = TypeVar("T")
P = ParamSpec("P")

MODELS_OPEN = 16
ANSWERS_KEPT = 100
GROUPS_SHOWN = 30
"""Groups of like parts in one output; the rest is counted."""
ROWS_SHOWN = 50
"""Of a table in one output; `offset` gets the next."""
PRINTED_CHARS = 4000
LOOK_S = 0.01
"""Between two looks whether all has been answered."""
SUFFIXES = (".step", ".stp", ".stpz", ".igs", ".iges", ".brep", ".zip", ".stl", ".obj", ".3mf")
READS = ToolAnnotations(read_only_hint=True, open_world_hint=False, idempotent_hint=True)
INSTRUCTIONS = """\
QueryCAD reads CAD models and answers questions about them from exact geometry. Begin with open_model; the id that it
returns names the model in all other tools. Ask one thing at a time: 'What is the diameter of the largest hole?' Look at
confidence, the probability that the value is right, whatever the status: rely on 0.8 or more; below that compare
understood_as and parts with what was asked, or measure the parts by their ids. Status 'answered' only says that it is
0.45 or more; 'unsure' that it is less: the value may well be wrong, alternatives has other readings, and a person may
have to choose. Without a value, next says what to do. Values are SI (metres, m2, m3, radians) in the frame of the file,
z up; texts have the unit that you name. For what no question says, measure parts by their ids, or run_program a short
Python program (resource querycad://guest-api)."""

ModelArg = Annotated[str, Field(description="The model's id, from open_model.")]
UnitArg = Annotated[LengthUnit, Field(description="Unit of lengths in texts; values stay SI.")]
PartArg = Annotated[str, Field(description="Id of a part, such as 'hole-4'.")]


class Session:
    """The models that are open, and the answers that were given."""

    def __init__(self, runtime: EmbeddedRuntime, folder: Path | None) -> None:
        self._runtime = runtime
        self._folder = folder
        self._models: OrderedDict[str, Model] = OrderedDict()
        self._answers: OrderedDict[str, Reply] = OrderedDict()
        self._asked = 0
        self._lock = Lock()

    def guarded(self, tool: Callable[P, T]) -> Callable[P, T]:
        """The tool, one call at a time; what went wrong is said with what to do next."""

        @wraps(tool)
        def guard(*arguments: P.args, **named: P.kwargs) -> T:
            with self._lock:
                try:
                    return tool(*arguments, **named)
                except (FileProblem, ValueError) as problem:
                    raise ToolError(str(problem)) from problem

        return guard

    def open(self, file: str) -> str:
        """The id of the model in the file."""
        path = Path(file).expanduser()
        if self._folder is not None:
            path = self._folder / path
            if not path.resolve().is_relative_to(self._folder):
                raise ToolError(f"only files in {self._folder} are opened; {_there(self._folder)}")
        if not path.is_file():
            near = next((each for each in (path, path.parent) if each.is_dir()), self._folder or Path.cwd())
            raise ToolError(f"{'no file' if path.is_dir() else 'no such file'}: {path}; {_there(near.resolve())}")
        model = self._runtime.open(path)
        name = f"{path.stem}-{model.id[:8]}"
        self._models[name] = model
        self._models.move_to_end(name)
        while len(self._models) > MODELS_OPEN:
            self._models.popitem(last=False)
        return name

    def model(self, name: str) -> Model:
        """The open model."""
        if name not in self._models:
            known = f"open are {', '.join(self._models)}" if self._models else "none is open"
            raise ToolError(f"no open model is called {name!r}: call open_model with its file first; {known}")
        self._models.move_to_end(name)
        return self._models[name]

    def part(self, model: Model, part: str) -> Part:
        """The part with this id."""
        try:
            return model.part(part)
        except KeyError:
            kind = part.rpartition("-")[0]
            same = [each.id for each in model.parts if each.kind == kind]
            has = f"it has {ids_text(same)}" if same else "find_parts and the tables tell which there are"
            raise ToolError(f"the model has no part {part!r}; {has}") from None

    def keep(self, reply: Reply) -> str:
        """The id that the answer is known by from now on."""
        self._asked += 1
        name = f"answer-{self._asked}"
        self._answers[name] = reply
        while len(self._answers) > ANSWERS_KEPT:
            self._answers.popitem(last=False)
        return name

    def answer(self, name: str) -> Reply:
        """The answer that was given."""
        if name not in self._answers:
            raise ToolError(f"no answer is called {name!r} (any more): ask again, and take the id of that answer")
        return self._answers[name]

    @property
    def models(self) -> dict[str, Model]:
        """Those that are open, the last used last."""
        return dict(self._models)


class _Server(MCPServer):
    """Says of arguments that are none which they are, what is allowed, and what to do."""

    async def call_tool(self, name: str, arguments: dict[str, Any], context: Any = None) -> Any:
        """What the tool gives. Raises ToolError."""
        try:
            return await super().call_tool(name, arguments, context)
        except ToolError as error:
            if not isinstance(error.__cause__, ValidationError):
                raise
            wrong = [f"{'.'.join(map(str, each['loc']))}: {each['msg']}" for each in error.__cause__.errors()]
            raise ToolError(f"{name} was not called: {'; '.join(wrong)}. Call it again with these put right") from None


def server(runtime: EmbeddedRuntime, folder: Path | None = None) -> MCPServer:
    """The server. `folder`: only files below it are opened; None: all that this process may read."""
    session = Session(runtime, folder.resolve() if folder is not None else None)
    made = _Server(
        "querycad", title="QueryCAD", version=version("querycad"), instructions=INSTRUCTIONS, log_level="WARNING"
    )

    def tool(function: Callable[P, T]) -> Callable[P, T]:
        guarded = session.guarded(function)
        made.add_tool(guarded, annotations=READS)
        return guarded

    for add in (_add_asking, _add_listing, _add_measuring, _add_comparing):
        add(tool, session)
    _add_resources(made, session)
    return made


async def over_stdio(made: MCPServer) -> None:
    """Serves standard input and output. What was asked before the input's end is answered after it, too."""
    to_server, read = anyio.create_memory_object_stream[SessionMessage | Exception](0)
    write, from_server = anyio.create_memory_object_stream[SessionMessage](0)
    waiting: set[RequestId] = set()

    async def forward() -> None:
        async with to_server:
            async for message in from_client:
                if isinstance(message, SessionMessage):
                    match message.message:
                        case JSONRPCRequest(id=number):
                            waiting.add(number)
                        case JSONRPCNotification(method="notifications/cancelled", params={"requestId": number}):
                            waiting.discard(number)
                await to_server.send(message)
            while waiting:
                await anyio.sleep(LOOK_S)

    async def back() -> None:
        async with to_client, from_server:
            async for message in from_server:
                await to_client.send(message)
                if isinstance(message.message, JSONRPCResponse | JSONRPCError) and message.message.id is not None:
                    waiting.discard(message.message.id)

    async with stdio_server() as (from_client, to_client), anyio.create_task_group() as tasks:
        tasks.start_soon(forward)
        tasks.start_soon(back)
        low = made._lowlevel_server
        async with read, write:
            await low.run(read, write, low.create_initialization_options())


def _add_asking(tool: Callable[[Callable[..., Any]], Any], session: Session) -> None:
    @tool
    def open_model(
        file: Annotated[
            str, Field(description="Path of a file on this machine: STEP, IGES, BREP, STL, OBJ, 3MF, .zip.")
        ],
        unit: UnitArg = LengthUnit.MM,
    ) -> Opened:
        """Read a CAD file, and say what it holds. The first time takes seconds, after that milliseconds."""
        name = session.open(file)
        model = session.model(name)
        return Opened(model=name, text=model.describe(unit).text, warnings=model.warnings)

    @tool
    def describe(model: ModelArg, unit: UnitArg = LengthUnit.MM) -> str:
        """Say again what an open model holds: size, features, patterns, standard parts, questions to ask."""
        return session.model(model).describe(unit).text

    @tool
    def ask(
        model: ModelArg,
        question: Annotated[str, Field(description="In English; one thing at a time.")],
        unit: UnitArg = LengthUnit.MM,
        context: Annotated[
            list[str], Field(description="Questions asked before, the oldest first: what 'they' and 'it' lean on.")
        ] = [],  # noqa: B006 - never changed
        select: Annotated[list[str], Field(description="Ids of parts that 'it' or 'this' is.")] = [],  # noqa: B006
    ) -> Answered:
        """Answer a question about the model with a typed value and the parts that it rests on."""
        asked = session.model(model)
        parts = [session.part(asked, each) for each in select]
        reply = asked.ask(question, unit=unit, context=context, select=parts)
        return _answered(session.keep(reply), reply, asked, unit)


def _add_listing(tool: Callable[[Callable[..., Any]], Any], session: Session) -> None:
    @tool
    def find_parts(
        model: ModelArg,
        description: Annotated[str, Field(description="A noun phrase: 'blind holes', 'M5 screw', 'red body'.")],
        sides: Annotated[
            list[Literal["top", "bottom", "left", "right", "front", "back"]] | None,
            Field(description="Only parts that are visible from one of these."),
        ] = None,
        unit: UnitArg = LengthUnit.MM,
    ) -> FoundParts:
        """Find the parts that words mean, like ones in groups; their ids are for measure, distance and ask."""
        found = session.model(model).find_parts(description, sides)
        following = "" if found else f"{found.message}; this model has: {', '.join(found.nearest)}"
        groups = _groups(found, session.model(model), unit)
        return FoundParts(count=len(found), groups=groups, notes=found.warnings, next=following)

    @tool
    def table(
        model: ModelArg,
        kind: Annotated[TableKind, Field(description="Which parts are in the rows; bodies are the bill of material.")],
        grouped: Annotated[bool, Field(description="A row for all that are alike; else one each, with places.")] = True,
        offset: Annotated[int, Field(ge=0, description="Rows to pass over.")] = 0,
        unit: UnitArg = LengthUnit.MM,
    ) -> TablePage:
        """Tabulate holes, slots, bosses, edges, bends, patterns, fasteners or bodies."""
        whole = session.model(model).table(kind, grouped, unit)
        page = whole.model_copy(update={"rows": whole.rows[offset : offset + ROWS_SHOWN]})
        more = len(whole.rows) - offset - ROWS_SHOWN
        following = f"{more} more rows: offset={offset + ROWS_SHOWN}" if more > 0 else ""
        if not whole.rows:
            kinds = ", ".join(f"{count} {kind}" for kind, count in session.model(model).summary.part_counts.items())
            following = f"the model has no {kind.value}; it has {kinds}"
        text = written(page, TableFormat.MARKDOWN, unit) if page.rows else ""
        return TablePage(rows=len(whole.rows), parts=whole.parts, text=text, next=following)

    @tool
    def look(
        model: ModelArg,
        view: Annotated[ViewName, Field(description="Where to look from.")] = ViewName.ISOMETRIC,
        answer: Annotated[str, Field(description="Id of an answer: its parts are marked and numbered instead.")] = "",
    ) -> Image:
        """Look at the model, or at what an answer rests on: a PNG picture."""
        if answer:
            return Image(data=bytes(session.answer(answer).picture()), format="png")
        return Image(data=bytes(session.model(model).picture(view)), format="png")


def _add_measuring(tool: Callable[[Callable[..., Any]], Any], session: Session) -> None:
    @tool
    def part(model: ModelArg, part: PartArg) -> dict[str, Any]:
        """Give all that is known of one part: kind, tags, sides, place, axis and every measure that it has, SI."""
        found = session.part(session.model(model), part)
        told = found.model_dump(mode="json", exclude_none=True, exclude={"faces", "evidence"})
        return {name: value for name, value in told.items() if value not in ([], "")} | {
            "faces": len(found.faces),
            "why": found.evidence.reason,
        }

    @tool
    def measure(
        model: ModelArg,
        measure: Annotated[Measure, Field(description="What to measure; 'size' is along x, y, z.")],
        parts: Annotated[list[str], Field(description="Ids of parts; none: the whole model.")] = [],  # noqa: B006
        unit: UnitArg = LengthUnit.MM,
        density: Annotated[float | None, Field(gt=0, description="kg/m3, of a mass or moments of inertia.")] = None,
    ) -> Measured:
        """Measure the whole model, one part, or each of several."""
        asked = session.model(model)
        chosen = [session.part(asked, each) for each in parts]
        of = None if not chosen else chosen[0] if len(chosen) == 1 else chosen
        try:
            found = asked.measure(measure, of, unit=unit, density=density)
        except NoValue as problem:
            lacking = chosen[0] if chosen else None
            has = f"; {lacking.id} has {', '.join(_measures(lacking))}" if lacking is not None else ""
            raise ToolError(f"{problem}{has}") from problem
        return Measured(value=found.value, unit=found.unit, text=found.text)


def _add_comparing(tool: Callable[[Callable[..., Any]], Any], session: Session) -> None:
    @tool
    def distance(
        model: ModelArg,
        a: PartArg,
        b: PartArg,
        between: Annotated[
            Literal["surfaces", "centers"],
            Field(description="Surfaces: the gap; centers: of holes, their axes."),
        ] = "surfaces",
    ) -> Measured:
        """Measure how far apart two parts are, exactly."""
        asked = session.model(model)
        value = asked.distance(session.part(asked, a), session.part(asked, b), between)
        return Measured(value=value, unit="m", text=f"{value * 1e3:.6g} mm")

    @tool
    def angle(model: ModelArg, a: PartArg, b: PartArg) -> Measured:
        """Measure the angle between the axes or normals of two parts, 0 to 90 degrees."""
        asked = session.model(model)
        value = asked.angle(session.part(asked, a), session.part(asked, b))
        return Measured(value=value, unit="rad", text=f"{degrees(value):.6g}°")

    @tool
    def run_program(
        model: ModelArg,
        code: Annotated[str, Field(description="Python that assigns `solution`; see resource querycad://guest-api.")],
    ) -> Ran:
        """Run a short program over the model's parts and faces in a sandbox: no files, no network, SI units."""
        came = session.model(model).run(code)
        more = hint(came.message, came.missing_attribute)
        wrong = f"fix the program; querycad://guest-api lists what there is. {more}".strip()
        return Ran(
            status=came.status,
            value=came.value,
            message=came.message,
            printed=came.printed[:PRINTED_CHARS],
            next="" if came.status is RunStatus.OK else wrong,
        )


def _add_resources(made: MCPServer, session: Session) -> None:
    def of(name: str) -> Model:
        if name not in session.models:
            raise ResourceNotFoundError(f"no open model is called {name!r}: call open_model first")
        return session.models[name]

    def given(name: str) -> Reply:
        try:
            return session.answer(name)
        except ToolError as error:
            raise ResourceNotFoundError(str(error)) from error

    @made.resource("querycad://guest-api", mime_type="text/x-python")
    def guest_api() -> str:
        """All that a program for run_program sees."""
        return guest_api_prompt()

    @made.resource("querycad://models", mime_type="application/json")
    def models() -> dict[str, str]:
        """The models that are open: ids and files."""
        return {name: model.name for name, model in session.models.items()}

    @made.resource("querycad://models/{model}", mime_type="text/plain")
    def model(model: str) -> str:
        """What an open model holds."""
        return session.guarded(lambda: of(model).describe().text)()

    @made.resource("querycad://answers/{answer}", mime_type="application/json")
    def answer(answer: str) -> str:
        """An answer with its program, its parts and all other readings."""
        return given(answer).model_dump_json()

    @made.resource("querycad://answers/{answer}/picture", mime_type="image/png")
    def picture(answer: str) -> bytes:
        """What an answer rests on, marked on the model."""
        return session.guarded(lambda: bytes(given(answer).picture()))()


def _answered(name: str, reply: Reply, model: Model, unit: LengthUnit) -> Answered:
    following = ""
    if reply.status is Status.ANSWERED and reply.confidence is not None and reply.confidence < SURE:
        following = "not sure: see whether understood_as and parts are what is meant; or measure the parts by their ids"
    elif reply.status is Status.UNSURE:
        following = "if another reading is meant, ask with its words; or measure the parts by their ids"
    elif reply.failure is not None:
        following = {
            "not_grounded": "ask about what the model has; describe and find_parts tell what there is",
            "not_understood": "say it in other words, one thing at a time; or find_parts and measure",
        }.get(reply.failure.category, "say it in other words; describe tells questions that are surely answered")
    return Answered(
        answer=name,
        status=reply.status,
        text=reply.text,
        value=reply.value,
        type=reply.type or "",
        unit=reply.unit or "",
        confidence=None if reply.confidence is None else round(reply.confidence, 3),
        understood_as=reply.understood_as,
        parts=_groups(reply.parts, model, unit),
        notes=(*reply.warnings, *(f"not taken into account: {each}" for each in reply.ignored)),
        alternatives=tuple(f"{each.understood_as}: {each.answer.text}" for each in reply.alternatives),
        next=following,
    )


def _groups(parts: Iterable[Part], model: Model, unit: LengthUnit) -> tuple[Group, ...]:
    known = {part.id: part for part in model.parts}
    found = callouts(parts, unit, known)
    shown = [Group(what=each.text, count=len(each.ids), ids=ids_text(each.ids)) for each in found[:GROUPS_SHOWN]]
    if len(found) > GROUPS_SHOWN:
        rest = sum(len(each.ids) for each in found[GROUPS_SHOWN:])
        shown.append(Group(what="others, not listed: say more exactly which", count=rest, ids=""))
    return tuple(shown)


def _measures(part: Part) -> Sequence[str]:
    """Names of the measures that the part has of its own."""
    return [each.value for each in Measure if getattr(part, each.value, None) is not None]


def _there(folder: Path) -> str:
    """Which files could be opened in a folder?"""
    try:
        names = sorted(each.name for each in folder.iterdir() if each.suffix.lower() in SUFFIXES)
    except OSError:
        names = []
    if not names:
        return f"{folder} holds no CAD file"
    more = f" and {len(names) - 20} more" if len(names) > 20 else ""
    return f"{folder} holds {', '.join(names[:20])}{more}"
