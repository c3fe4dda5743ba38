"""The MCP server: `querycad.open` and its models as tools and resources for agents.

Outputs are small: ids of parts in short, tables a page at a time, pictures only where one looks. An error says what to
do next. One model is read, and one program run, at a time.
"""

from __future__ import annotations

from collections.abc import Callable, Iterable, Sequence
from importlib.metadata import version
from math import degrees
from pathlib import Path
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
from pydantic import BeforeValidator, Field, ValidationError

from querycad_answering.answering import SURE
from querycad_answering.drawing.callouts import callouts, ids_text
from querycad_answering.drawing.writing import written
from querycad_answering.llm.hints import hint
from querycad_answering.llm.program import program_in
from querycad_answering.llm.reference import reference
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

from .mcp_outputs import Answered, FoundParts, Group, Measured, Opened, Ran, TablePage
from .mcp_session import Session
from .measuring import UNITS, NoValue
from .model import Model, Reply
from .runtime import EmbeddedRuntime

T = TypeVar("T")
P = ParamSpec("P")

GROUPS_SHOWN = 30
"""Groups of like parts in one output; the rest is counted."""
ROWS_SHOWN = 50
"""Of a table in one output; `offset` gets the next."""
PRINTED_CHARS = 4000
LOOK_S = 0.01
"""Between two looks whether all has been answered."""
READS = ToolAnnotations(read_only_hint=True, open_world_hint=False, idempotent_hint=True)
INSTRUCTIONS = """\
QueryCAD reads CAD models and answers questions about them from exact geometry. Begin with open_model; the id that it
returns names the model in all other tools. Ask one thing at a time: 'What is the diameter of the largest hole?' Look at
confidence, the probability that the value is right, whatever the status: rely on 0.8 or more; below that compare
understood_as and parts with what was asked, or measure the parts by their ids. Status 'answered' only says that it is
0.45 or more; 'unsure' that it is less: the value may well be wrong, alternatives has other readings, and a person may
have to choose. Without a value, next says what to do. Values are SI (metres, m2, m3, radians) in the frame of the file,
z up; texts have the unit that you name. For what no question says, measure parts by their ids, or write a short Python
program: guest_api lists what it sees, run_program runs it."""

ModelArg = Annotated[str, Field(description="The model's id, from open_model.")]
UnitArg = Annotated[LengthUnit, Field(description="Unit of lengths in texts; values stay SI.")]
PartArg = Annotated[str, Field(description="Id of a part, such as 'hole-4'.")]
IDS = "'hole-4', 'hole-1..3', or 'answer-2' for all that an answer rests on"


def _listed(given: Any) -> Any:
    """One text is a list of one."""
    return [given] if isinstance(given, str) else given


Listed = BeforeValidator(_listed)


class _Server(MCPServer):
    """Says of arguments that are none which they are, what is allowed, and what to do."""

    async def call_tool(self, name: str, arguments: dict[str, Any], context: Any = None) -> Any:
        """What the tool gives. Raises ToolError."""
        known = next((each.input_schema["properties"] for each in await self.list_tools() if each.name == name), None)
        if known is not None and (odd := [each for each in arguments if each not in known]):
            raise ToolError(f"{name} has no argument {', '.join(map(repr, odd))}; it takes {', '.join(known)}")
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
            list[str],
            Listed,
            Field(description="Questions asked before, the oldest first: what 'they' and 'it' lean on."),
        ] = [],  # noqa: B006 - never changed
        select: Annotated[list[str], Listed, Field(description=f"Parts that 'it', 'this' or 'they' are: {IDS}.")] = [],  # noqa: B006
    ) -> Answered:
        """Answer a question about the model with a typed value and the parts that it rests on.

        Rely on a confidence of 0.8 or more; below it, and where `next` says something, find_parts and measure.
        """
        asked = session.model(model)
        reply = asked.ask(question, unit=unit, context=context, select=session.parts(asked, select))
        return _answered(session.keep(asked, reply), reply, asked, unit)


def _add_listing(tool: Callable[[Callable[..., Any]], Any], session: Session) -> None:
    @tool
    def find_parts(
        model: ModelArg,
        description: Annotated[str, Field(description="A noun phrase: 'blind holes', 'M5 screw', 'red body'.")],
        sides: Annotated[
            list[Literal["top", "bottom", "left", "right", "front", "back"]] | None,
            Listed,
            Field(description="Only parts that are visible from one of these."),
        ] = None,
        unit: UnitArg = LengthUnit.MM,
    ) -> FoundParts:
        """Find the parts that words mean, like ones in groups; their ids are for part, measure, distance and ask."""
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
        if not page.rows:
            following = f"the table has {len(whole.rows)} rows: begin with offset=0"
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
        """Look at the model, or at what an answer rests on: a PNG picture. For other parts ask with `select` first."""
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
        parts: Annotated[list[str], Listed, Field(description=f"Parts: {IDS}; none: the whole model.")] = [],  # noqa: B006
        unit: UnitArg = LengthUnit.MM,
        density: Annotated[float | None, Field(gt=0, description="kg/m3, of a mass or moments of inertia.")] = None,
    ) -> Measured:
        """Measure the whole model, one part, or each of several."""
        asked = session.model(model)
        chosen = session.parts(asked, parts)
        of = None if not chosen else chosen[0] if len(chosen) == 1 else chosen
        try:
            found = asked.measure(measure, of, unit=unit, density=density)
        except NoValue as problem:
            lacking = chosen[0] if chosen else None
            has = f"; {lacking.id} has {', '.join(_measures(lacking))}" if lacking is not None else ""
            raise ToolError(f"{problem}{has}") from problem
        return Measured(value=found.value, unit=found.unit or UNITS.get(measure, ""), text=found.text)


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
    def compare(
        model: ModelArg,
        other: Annotated[str, Field(description="The id of another open model, such as a later revision.")],
        unit: UnitArg = LengthUnit.MM,
    ) -> str:
        """Tell what is different in another open model, part by part."""
        return session.model(model).compare(session.model(other), unit).text[:PRINTED_CHARS]

    @tool
    def guest_api() -> str:
        """List all that a program for run_program sees: functions, and what a part, a face and the model have."""
        return reference()

    @tool
    def run_program(
        model: ModelArg,
        code: Annotated[
            str,
            Field(
                description="Python that assigns `solution`, such as "
                "solution = max(hole.diameter for hole in parts(kind='hole')). guest_api lists what there is."
            ),
        ],
    ) -> Ran:
        """Run a short program over the model's parts and faces in a sandbox: no files, no network, SI units."""
        came = session.model(model).run(program_in(code) or program_in(f"```\n{code}\n```") or code)
        more = hint(came.message, came.missing_attribute)
        wrong = f"fix the program; guest_api lists what there is. {more}".strip()
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
