"""The programs themselves: they check against the guest API, run in the sandbox, and are short."""

from __future__ import annotations

import ast
import json
from collections.abc import Callable, Iterator, Sequence
from pathlib import Path
from typing import Any

import pytest
from hypothesis import given
from hypothesis import strategies as st

from querycad_contracts import Body, Evidence, Face, Grounding, Part, Program, RunStatus, Shape, Side
from querycad_language.old import ParseError, parse
from querycad_sandbox import Sandbox
from querycad_sandbox.check import TypeChecker

HERE = Path(__file__).parent
GUEST_NAMES = {"shape", "find_parts", "distance", "different", "close", "Part"}
BUILTINS = {"len", "min", "max", "sum", "abs", "sorted", "any", "all", "range", "enumerate", "hasattr", "set", "bool"}
MEASURES = ("radius", "diameter", "depth", "height", "width", "length", "thickness", "volume", "area", "bottom")


def programs() -> list[Program]:
    questions = (HERE / "rewordings.txt").read_text(encoding="utf-8").splitlines()
    for name in ("seen.jsonl", "unseen.jsonl"):
        questions += [json.loads(line)["question"] for line in (HERE / name).read_text(encoding="utf-8").splitlines()]
    found: dict[str, Program] = {}
    for question in questions:
        try:
            program = parse(question)
        except ParseError:
            continue
        found.setdefault(program.code, program)
    return list(found.values())


PROGRAMS = programs()


class BracketSegCad:
    """The bracket behind the real port."""

    def __init__(self, guest: Any) -> None:
        self.guest = guest
        self.parts = {part.id: part for part in guest.parts}

    def shape(self) -> Shape:
        shape = self.guest.shape
        bodies = tuple(
            Body(
                id=b.id, name=b.name, color=b.color, is_solid=True, center=b.center, extents=b.extents,
                volume=b.volume, area=b.area, face_count=6,
            )
            for b in shape.bodies
        )  # fmt: skip
        return Shape(
            name=shape.name, center=shape.center, extents=shape.extents, volume=shape.volume, area=shape.area,
            thickness=shape.thickness, bodies=bodies, face_count=shape.face_count,
        )  # fmt: skip

    def find_parts(self, description: str, sides: Sequence[Side] | None = None) -> Grounding:
        found = self.guest.find_parts(description, None if sides is None else [side.value for side in sides])
        return Grounding(
            description=description,
            sides=None if sides is None else tuple(sides),
            parts=tuple(_contract(part) for part in found),
            understood=True,
        )

    def faces(self, ids: Sequence[int]) -> tuple[Face, ...]:
        raise NotImplementedError

    def distance(self, part_a: str, part_b: str) -> float:
        return float(self.parts[part_a].distance_to(self.parts[part_b]))

    def edge_distance(self, part: str) -> float:
        return float(self.parts[part].edge)


KIND_OF_NOUN = {
    "shaft": "boss", "tube": "boss", "flange": "prism", "plate": "prism", "leg": "protrusion", "face": "region",
    "bolt circle": "pattern",
}  # fmt: skip
"""The bracket's parts are of the kind that a question calls them; recognition says so in tags."""


def _contract(part: Any) -> Part:
    measures = {name: getattr(part, name) for name in MEASURES if hasattr(part, name)}
    vectors = {name: getattr(part, name) for name in ("axis", "normal", "opening", "tip") if hasattr(part, name)}
    return Part(
        id=part.id, kind=KIND_OF_NOUN.get(part.kind, part.kind), tags=tuple(part.tags), label=part.label,
        name=part.name, faces=(1,),
        sides=tuple(Side(side) for side in part.sides), center=part.center, extents=part.extents,
        radii=tuple(getattr(part, "radii", ())), evidence=Evidence(source="geometry", confidence=1.0, reason="by hand"),
        **measures, **vectors,
    )  # fmt: skip


@pytest.fixture(scope="module")
def checker() -> Iterator[TypeChecker]:
    found = TypeChecker(1)
    found.start()
    yield found
    found.close()


@pytest.fixture(scope="module")
def sandbox() -> Iterator[Sandbox]:
    with Sandbox(workers=1) as found:
        yield found


def test_there_are_many_different_programs() -> None:
    assert len(PROGRAMS) > 250


def test_every_program_checks_against_the_guest_api(checker: TypeChecker) -> None:
    problems = {program.code: found for program in PROGRAMS if (found := checker.problems(program.code))}
    assert problems == {}


def test_every_program_runs_in_the_sandbox_as_in_plain_python(
    guest: Any, sandbox: Sandbox, same: Callable[[Any, Any], bool]
) -> None:
    segcad = BracketSegCad(guest)
    differing = {}
    for program in PROGRAMS:
        try:
            plain = guest.run(program.code)
        except Exception:  # noqa: S112 - some questions ask for what the bracket does not have
            continue
        outcome = sandbox.run(program.code, segcad, expects=program.expects)
        if outcome.status is not RunStatus.OK or not same(_plain(plain), _plain(outcome.value)):
            differing[program.code] = (plain, outcome.value, outcome.message)
    assert differing == {}


def _plain(value: Any) -> Any:
    """Parts by id, tuples as lists."""
    if isinstance(value, dict):
        return value.get("part")
    if isinstance(value, list | tuple):
        return [_plain(item) for item in value]
    return getattr(value, "id", value)


def test_programs_use_only_the_guest_api() -> None:
    for program in PROGRAMS:
        tree = ast.parse(program.code)
        names = {node.id for node in ast.walk(tree) if isinstance(node, ast.Name)}
        stored = {node.id for node in ast.walk(tree) if isinstance(node, ast.Name) and isinstance(node.ctx, ast.Store)}
        arguments = {node.arg for node in ast.walk(tree) if isinstance(node, ast.arg)}
        functions = {node.name for node in ast.walk(tree) if isinstance(node, ast.FunctionDef)}
        assert names <= GUEST_NAMES | BUILTINS | stored | arguments | functions, program.code
        assert not any(isinstance(node, ast.Import | ast.ImportFrom) for node in ast.walk(tree))


def test_programs_keep_their_selection_and_assign_the_solution() -> None:
    for program in PROGRAMS:
        assert program.code.count("solution = ") == 1
        assert program.code.splitlines()[-1].startswith("solution = ")
        if "find_parts" in program.code:
            assert "\nparts = " in "\n" + program.code, program.code


def test_programs_are_short() -> None:
    assert max(program.code.count("\n") for program in PROGRAMS) <= 12
    assert sum(program.code.count("\n") for program in PROGRAMS) / len(PROGRAMS) < 4
    assert max(len(line) for program in PROGRAMS for line in program.code.splitlines()) <= 130


@pytest.mark.parametrize(
    ("question", "code"),
    [
        ("How many holes are on the top?", 'parts = find_parts("hole", sides=["top"])\nsolution = len(parts)\n'),
        ("What is the radius of the holes?", 'parts = find_parts("hole")\nsolution = [p.radius for p in parts]\n'),
        (
            "What is the diameter of the shaft?",
            'parts = find_parts("the shaft")\n'
            "values = [p.diameter for p in parts]\n"
            "solution = values[0] if len(different(values)) == 1 else values\n",
        ),
        ("How wide is it?", "solution = shape.width\n"),
        (
            "What are the different radii of the holes?",
            'parts = find_parts("hole")\nsolution = different([r for p in parts for r in p.radii])\n',
        ),
    ],
)
def test_programs_read_as_an_engineer_writes_them(question: str, code: str) -> None:
    assert parse(question).code == code


@given(st.text(max_size=40))
def test_a_description_cannot_break_out_of_its_quotes(text: str) -> None:
    try:
        program = parse(f"How many {text} holes are there?")
    except ParseError:
        return
    calls = [node for node in ast.walk(ast.parse(program.code)) if isinstance(node, ast.Call)]
    assert {call.func.id for call in calls if isinstance(call.func, ast.Name)} <= GUEST_NAMES | BUILTINS | {"inside"}
    assert all(isinstance(call.func, ast.Name) for call in calls if not isinstance(call.func, ast.Attribute))
