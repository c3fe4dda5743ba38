"""The MCP server, as an agent meets it: over standard input and output and over HTTP, with the SDK's own client."""

from __future__ import annotations

import base64
import json
import os
import re
import socket
import subprocess
import sys
import time
from collections.abc import AsyncIterator, Callable
from contextlib import asynccontextmanager
from pathlib import Path
from typing import Any

import anyio
import pytest
from mcp import Client, MCPError, StdioServerParameters, stdio_client

from querycad import EmbeddedRuntime
from querycad.mcp_server import _answered
from querycad_contracts import LengthUnit

ROOT = Path(__file__).parents[2]
COMMAND = ["-m", "querycad.cli", "mcp"]
START_S = 30.0
LARGEST_OUTPUT = 6000
"""Characters: what an agent can read without losing sight of its task."""


@pytest.fixture(scope="module")
def home(tmp_path_factory: pytest.TempPathFactory) -> Path:
    return tmp_path_factory.mktemp("home")


def environment(home: Path) -> dict[str, str]:
    return os.environ | {"QUERYCAD_HOME": str(home)}


class Agent:
    """Calls tools, and looks at what they say."""

    def __init__(self, client: Client) -> None:
        self.client = client

    async def call(self, tool: str, **arguments: Any) -> Any:
        """The structured result of a call that succeeds."""
        result = await self.client.call_tool(tool, arguments)
        said = "".join(each.text for each in result.content if each.type == "text")
        assert not result.is_error, said
        assert len(said) < LARGEST_OUTPUT
        assert result.structured_content is not None
        found = result.structured_content
        return found["result"] if list(found) == ["result"] else found

    async def refused(self, tool: str, **arguments: Any) -> str:
        """What a call that fails says."""
        result = await self.client.call_tool(tool, arguments)
        assert result.is_error
        return "".join(each.text for each in result.content if each.type == "text")

    async def look(self, **arguments: Any) -> bytes:
        result = await self.client.call_tool("look", arguments)
        (image,) = result.content
        assert image.type == "image"
        assert image.mime_type == "image/png"
        return base64.b64decode(image.data)

    async def read(self, uri: str) -> Any:
        (content,) = (await self.client.read_resource(uri)).contents
        return content.text if hasattr(content, "text") else base64.b64decode(content.blob)


@asynccontextmanager
async def over_stdio(home: Path, *arguments: str) -> AsyncIterator[Agent]:
    parameters = StdioServerParameters(
        command=sys.executable, args=[*COMMAND, *arguments], env=environment(home), cwd=str(ROOT)
    )
    async with Client(stdio_client(parameters)) as client:
        yield Agent(client)


@asynccontextmanager
async def over_http(home: Path, *arguments: str) -> AsyncIterator[Agent]:
    with socket.socket() as free:
        free.bind(("127.0.0.1", 0))
        port = free.getsockname()[1]
    command = [sys.executable, *COMMAND, "--http", str(port), *arguments]
    process = subprocess.Popen(command, cwd=ROOT, env=environment(home), stderr=subprocess.DEVNULL)
    try:
        deadline = time.monotonic() + START_S
        while True:
            with socket.socket() as knock:
                if knock.connect_ex(("127.0.0.1", port)) == 0:
                    break
            assert process.poll() is None
            assert time.monotonic() < deadline
            await anyio.sleep(0.05)
        async with Client(f"http://127.0.0.1:{port}/mcp") as client:
            yield Agent(client)
    finally:
        process.terminate()
        process.wait(START_S)


Transport = Callable[..., Any]
TRANSPORTS = pytest.mark.parametrize("transport", [over_stdio, over_http], ids=["stdio", "http"])


@TRANSPORTS
def test_an_agent_solves_ten_tasks(transport: Transport, home: Path) -> None:  # noqa: PLR0915 - ten tasks
    """As an agent does: each step's arguments come of what an earlier step said."""

    async def solve() -> None:
        async with transport(home) as agent:
            tools = {tool.name: tool for tool in (await agent.client.list_tools()).tools}
            assert len(tools) == 13
            assert all(tool.description for tool in tools.values())

            # 1. What is this file?
            flange = await agent.call("open_model", file="examples/flange.step")
            assert "170 x 170 x 53 mm" in flange["text"]
            model = flange["model"]

            # 2. A question that it is surely answered: taken from what the description suggests.
            suggested = flange["text"].partition("you may ask\n")[2].splitlines()
            first = await agent.call("ask", model=model, question=suggested[1].strip())
            assert (first["status"], first["value"], first["type"]) == ("answered", 11, "count")

            # 3. A follow-up.
            holes = await agent.call("ask", model=model, question="How many counterbored holes are there?")
            deep = await agent.call("ask", model=model, question="And how deep are they?", context=[holes_of(holes)])
            assert deep["text"] == "22 mm (each of 8)"

            # 4. See what an answer rests on.
            marked = await agent.look(model=model, answer=holes["answer"])
            plain = await agent.look(model=model, view="top")
            assert marked.startswith(b"\x89PNG")
            assert marked != plain

            # 5. The wall between the two odd holes: found by words, measured by ids.
            small = await agent.call("find_parts", model=model, description="holes of 8.5 mm")
            a, b = small["groups"][0]["ids"].split(", ")
            assert (await agent.call("distance", model=model, a=a, b=b))["text"] == "125.5 mm"
            centers = await agent.call("distance", model=model, a=a, b=b, between="centers")
            assert centers["value"] == pytest.approx(0.134)

            # 6. The bill of material of an assembly.
            bearing = await agent.call("open_model", file="examples/bearing_assembly.step")
            bodies = await agent.call("table", model=bearing["model"], kind="bodies")
            assert bodies["parts"] >= bodies["rows"] > 1
            assert "| ---" in bodies["text"]

            # 7. Where a robot is to grip: the pose of a hole.
            pose = await agent.call("part", model=model, part=a)
            assert set(pose) >= {"opening", "axis", "normal", "diameter", "depth", "sides"}
            assert pose["normal"] == pytest.approx([0, 0, 1])

            # 8. What no question says: a program, mended after its first failure.
            api = await agent.read("querycad://guest-api")
            assert "def find_parts(" in api
            code = "solution = max(h.diameter for h in holes)"
            failed = await agent.call("run_program", model=model, code=code)
            assert failed["status"] != "ok"
            assert "guest_api lists what there is. Only these names exist: shape, find_parts," in failed["next"]
            mended = await agent.call("run_program", model=model, code=f"holes = parts(kind='hole')\n{code}")
            assert mended["value"] == pytest.approx(0.054)

            # 9. What is not there is not made up; what to ask instead is said.
            none = await agent.call("ask", model=model, question="How deep is the keyway?")
            assert none["status"] != "answered"
            assert none["value"] is None
            assert none["next"]
            gear = await agent.call("open_model", file="examples/gear_shaft.step")
            there = await agent.call("ask", model=gear["model"], question="How deep is the keyway?")
            assert (there["status"], there["text"]) == ("answered", "3.5 mm")

            # 10. Two models beside each other, and what was said before, read again.
            known = json.loads(await agent.read("querycad://models"))
            assert set(known) == {model, bearing["model"], gear["model"]}
            again = json.loads(await agent.read(f"querycad://answers/{first['answer']}"))
            assert again["answer"]["value"] == 11
            assert (await agent.read(f"querycad://answers/{first['answer']}/picture")).startswith(b"\x89PNG")
            assert "gear 24 teeth" in await agent.read(f"querycad://models/{gear['model']}")

    def holes_of(answer: dict[str, Any]) -> str:
        assert answer["value"] == 8
        return "How many counterbored holes are there?"

    anyio.run(solve)


@TRANSPORTS
def test_what_cannot_be_done_says_what_to_do(transport: Transport, home: Path) -> None:
    async def err() -> None:
        async with transport(home) as agent:
            assert re.search("call open_model .* none is open", await agent.refused("describe", model="flange"))
            missing = await agent.refused("open_model", file="examples/flansh.step")
            assert "no such file" in missing
            assert "flange.step" in missing
            assert re.search("no file: .*examples; .*flange.step", await agent.refused("open_model", file="examples"))
            assert "not a STEP file" in await agent.refused("open_model", file="examples/README.md")
            model = (await agent.call("open_model", file="examples/flange.step"))["model"]
            assert model in await agent.refused("ask", model="flange", question="How many holes are there?")
            assert "it has hole-1..11" in await agent.refused("part", model=model, part="hole-99")
            assert "it has hole-1..11" in await agent.refused("distance", model=model, a="hole-1", b="hole-12")
            lacking = await agent.refused("measure", model=model, measure="across_flats", parts=["hole-1"])
            assert "hole-1 has radius, diameter" in lacking
            wrong = await agent.refused("measure", model=model, measure="beauty")
            assert wrong.startswith("measure was not called: measure: Input should be ")
            assert "pydantic" not in wrong
            assert (await agent.refused("open_model")).startswith("open_model was not called: file: ")
            unknown = await agent.refused("look", model=model, part="hole-1")
            assert unknown == "look has no argument 'part'; it takes model, view, answer"
            assert "is 3 parts: hole-1..3; name one" in await agent.refused("part", model=model, part="hole-1..3")
            assert "examples/flange.step" in await agent.refused("open_model", file="flange.step")
            late = await agent.call("table", model=model, kind="holes", offset=50)
            assert (late["text"], late["next"]) == ("", "the table has 3 rows: begin with offset=0")
            assert "answer-99" in await agent.refused("look", model=model, answer="answer-99")
            none = await agent.call("find_parts", model=model, description="banana")
            assert (none["count"], "hole" in none["next"]) == (0, True)
            assert "1 to 500" in await agent.refused("find_parts", model=model, description=" ")
            assert "it has" in (await agent.call("table", model=model, kind="bends"))["next"]
            with pytest.raises(MCPError, match="open_model"):
                await agent.read("querycad://models/flange")

    anyio.run(err)


def test_an_answer_that_is_not_sure_says_what_to_check(runtime: EmbeddedRuntime) -> None:
    model = runtime.open(ROOT / "examples/flange.step")
    reply = model.ask("How many holes are there?")

    def following(confidence: float) -> str:
        return _answered("answer-1", reply.model_copy(update={"confidence": confidence}), model, LengthUnit.MM).next

    assert "understood_as" in following(0.6)
    assert following(0.9) == ""


@TRANSPORTS
def test_files_outside_the_folder_are_not_opened(transport: Transport, home: Path, tmp_path: Path) -> None:
    (tmp_path / "link.step").symlink_to(ROOT / "examples/flange.step")
    (tmp_path / "own.step").write_bytes((ROOT / "examples/flange.step").read_bytes())

    async def attempt() -> None:
        async with transport(home, "--folder", str(tmp_path)) as agent:
            for file in (str(ROOT / "examples/flange.step"), "../flange.step", "link.step", "/etc/passwd"):
                assert "only files in" in await agent.refused("open_model", file=file)
            assert (await agent.call("open_model", file="own.step"))["model"].startswith("own-")

    anyio.run(attempt)


def test_measures_are_typed(home: Path) -> None:
    async def measure() -> None:
        async with over_stdio(home) as agent:
            model = (await agent.call("open_model", file="examples/flange.step", unit="in"))["model"]
            size = await agent.call("measure", model=model, measure="size")
            assert (size["unit"], size["text"]) == ("m", "170 x 170 x 53 mm")
            one = await agent.call("measure", model=model, measure="depth", parts=["hole-1"], unit="m")
            assert (one["value"], one["text"]) == (pytest.approx(0.022), "0.022 m")
            two = await agent.call("measure", model=model, measure="depth", parts=["hole-1", "hole-11"])
            assert two["value"] == pytest.approx([0.022, 0.053])
            assert (await agent.call("angle", model=model, a="hole-1", b="hole-2"))["text"] == "0°"
            picked = await agent.call("ask", model=model, question="What is its diameter?", select=["hole-4"])
            assert picked["text"] == "8.5 mm"

    anyio.run(measure)


def test_ids_are_taken_as_they_are_told_and_an_answer_stands_for_its_parts(home: Path) -> None:
    async def follow() -> None:
        async with over_stdio(home) as agent:
            model = (await agent.call("open_model", file="examples/flange.step"))["model"]
            asked = await agent.call("ask", model=model, question="How many counterbored holes are there?")
            (group,) = asked["parts"]
            for ids in (group["ids"], [group["ids"]], asked["answer"]):
                each = await agent.call("measure", model=model, measure="diameter", parts=ids)
                assert each["value"] == pytest.approx([0.016] * 8)
            them = await agent.call("ask", model=model, question="How deep are they?", select=[asked["answer"]])
            assert them["text"] == "22 mm (each of 8)"
            other = (await agent.call("open_model", file="examples/bracket.step"))["model"]
            strange = await agent.refused("measure", model=other, measure="depth", parts=[asked["answer"]])
            assert "about another model, flange" in strange
            assert "no part 'answer-9'" in await agent.refused("part", model=model, part="answer-9")

    anyio.run(follow)


def test_what_has_a_density_has_its_unit_and_two_models_are_compared(home: Path) -> None:
    async def measure() -> None:
        async with over_stdio(home) as agent:
            model = (await agent.call("open_model", file="examples/flange.step"))["model"]
            heavy = await agent.call("measure", model=model, measure="mass", density=7850)
            assert (heavy["unit"], heavy["value"]) == ("kg", pytest.approx(3.767045))
            other = (await agent.call("open_model", file="examples/gear_shaft.step"))["model"]
            assert "170 x 170 x 53 -> 134 x 78 x 78 mm" in await agent.call("compare", model=model, other=other)

    anyio.run(measure)


def test_a_program_is_taken_as_it_is_written(home: Path) -> None:
    holes = "len(parts(kind='hole'))"

    async def run() -> None:
        async with over_stdio(home) as agent:
            model = (await agent.call("open_model", file="examples/flange.step"))["model"]
            for code in (f"```python\nsolution = {holes}\n```", holes, f"print({holes})", f"count = {holes}"):
                ran = await agent.call("run_program", model=model, code=code)
                assert (ran["status"], ran["value"]) == ("ok", 11)

    anyio.run(run)


def test_what_was_asked_before_the_end_of_input_is_answered(home: Path) -> None:
    """So that a shell's pipe is a client, too."""
    asked: list[dict[str, Any]] = [
        {
            "id": 1,
            "method": "initialize",
            "params": {
                "protocolVersion": "2025-06-18",
                "capabilities": {},
                "clientInfo": {"name": "pipe", "version": "0"},
            },
        },
        {"method": "notifications/initialized"},
        {"id": 2, "method": "tools/list"},
        {
            "id": 3,
            "method": "tools/call",
            "params": {"name": "open_model", "arguments": {"file": "examples/bracket.step"}},
        },
    ]
    text = "".join(json.dumps({"jsonrpc": "2.0", **each}) + "\n" for each in asked)
    done = subprocess.run(
        [sys.executable, *COMMAND],
        cwd=ROOT,
        env=environment(home),
        input=text,
        capture_output=True,
        text=True,
        check=True,
    )
    answered = {each["id"]: each for each in map(json.loads, done.stdout.splitlines())}
    assert set(answered) == {1, 2, 3}
    assert answered[3]["result"]["structuredContent"]["model"].startswith("bracket-")
    assert done.stderr == ""


def test_a_folder_that_is_none_is_bad_input(home: Path, tmp_path: Path) -> None:
    command = [sys.executable, *COMMAND, "--folder", str(tmp_path / "none")]
    done = subprocess.run(command, env=environment(home), capture_output=True, text=True, check=False)
    assert (done.returncode, done.stdout) == (2, "")
    assert "no such folder" in done.stderr
