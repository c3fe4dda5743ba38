"""Runs that wait for the segworker: many at once on one interpreter, each going on as if never put aside."""

from __future__ import annotations

import threading
from collections.abc import Callable, Iterator, Sequence
from concurrent.futures import ThreadPoolExecutor
from typing import Any

import pytest
from tests.llm_sandbox.conftest import FakePartFinder

from querycad_contracts import Grounding, PartQuery, RunLimits, RunOutcome, RunStatus, Side
from querycad_sandbox import Sandbox
from querycad_sandbox.control import RunControl

WAIT_S = 20.0
"""So long a test waits for what must come; never reached where the claim holds."""


class Waiting(FakePartFinder):
    """A finder whose every call takes long: it gives the interpreter back, then does `meanwhile`."""

    def __init__(self, control: RunControl, meanwhile: Callable[[], object] = lambda: None, prefix: str = "") -> None:
        super().__init__(prefix)
        self._control, self._meanwhile = control, meanwhile

    def _wait(self) -> None:
        self._control.release()
        self._meanwhile()

    def find_parts(self, description: str | PartQuery, sides: Sequence[Side] | None = None) -> Grounding:
        self._wait()
        return super().find_parts(description, sides)

    def faces(self, ids: Sequence[int]) -> Any:
        self._wait()
        return super().faces(ids)

    def shape(self) -> Any:
        self._wait()
        return super().shape()

    def distance(self, part_a: str, part_b: str) -> float:
        self._wait()
        return super().distance(part_a, part_b)

    def edge_distance(self, part: str) -> float:
        self._wait()
        return super().edge_distance(part)


@pytest.fixture(scope="module")
def narrow() -> Iterator[Sandbox]:
    """One interpreter."""
    with Sandbox(workers=1) as made:
        yield made


def run(sandbox: Sandbox, code: str, meanwhile: Callable[[], object] = lambda: None, **more: Any) -> RunOutcome:
    control = RunControl()
    return sandbox.run(code, Waiting(control, meanwhile), control=control, **more)


def test_many_runs_wait_at_once_on_one_interpreter(narrow: Sandbox) -> None:
    together = threading.Barrier(12)  # passed only when all twelve wait for the segworker at the same time

    def one(number: int) -> RunOutcome:
        control = RunControl()
        finder = Waiting(control, lambda: together.wait(WAIT_S), f"m{number}-")
        return narrow.run("solution = [p.id for p in find_parts('boss')]", finder, control=control)

    with ThreadPoolExecutor(12) as threads:
        outcomes = list(threads.map(one, range(12)))
    assert [outcome.value for outcome in outcomes] == [[f"m{number}-boss-1"] for number in range(12)]


def test_a_run_goes_on_while_another_waits(narrow: Sandbox) -> None:
    def meanwhile() -> None:
        assert narrow.run("solution = 40 + 2", FakePartFinder()).value == 42

    assert run(narrow, "solution = len(find_parts('hole'))", meanwhile).value == 3


@pytest.mark.parametrize(
    ("code", "value"),
    [
        ("a = find_parts('hole')\nb = find_parts('slot')\nsolution = [a[0], b, a[0].distance_to(b[0])]",
         [{"part": "hole-1"}, [{"part": "slot-1"}], 0.007]),
        ("a = find_parts('hole')\nx = a[0].faces\nsolution = [a[2].edge_distance(), x[0], a[2].radius, a[2].id]",
         [0.004, {"face": 1}, 0.005, "hole-3"]),
        ("a, w = find_parts('hole'), shape.width\nsolution = [w, a[0].center_distance(a[1]), type(a[0]) == Part]",
         [0.1, pytest.approx(0.03), True]),
        ("a = find_parts('hole')\nsolution = min(a, key=lambda p: p.edge_distance())", {"part": "hole-2"}),
        ("def f(p):\n    return p.edge_distance() + close(1.0, 1.0)\nsolution = [f(p) for p in find_parts('hole')]",
         [1.003, 1.002, 1.004]),
        ("f = find_parts\na = f('hole')\nb = f('slot')\nsolution = [len(a), len(b), len(f('hole'))]", [3, 1, 3]),
        ("a = find_parts('hole')[0]\nb = shape.bodies[0]\nfind_parts('slot')\nsolution = [b.name, a.tags]",
         ["plate", ["through", "circular"]]),
        ("print(1)\na = find_parts('hole')\nprint(2)\nb = find_parts('slot')\nprint(3)\nsolution = 0", 0),
    ],
)  # fmt: skip
def test_a_run_put_aside_goes_on_as_if_it_never_was(narrow: Sandbox, code: str, value: Any) -> None:
    put_aside, straight = run(narrow, code), narrow.run(code, FakePartFinder())
    assert (put_aside.message, put_aside.value) == ("", value)
    keep = {"duration_ms": 0.0}
    assert put_aside.model_copy(update=keep) == straight.model_copy(update=keep)


@pytest.mark.parametrize(
    ("code", "message"),
    [
        ("a = find_parts('slot')\nfind_parts('hole')\nsolution = -a[0].radius", "part 'slot-1' has no radius; it has"),
        ("a = find_parts('slot')\nfind_parts('hole')\nsolution = a[0].distance_to(3)", "distance_to() takes a part"),
        ("a = find_parts('slot')\nfind_parts('hole')\nsolution = 1 / 0", "(line 3: solution = 1 / 0)"),
    ],
)  # fmt: skip
def test_an_error_after_a_wait_is_told_as_ever(narrow: Sandbox, code: str, message: str) -> None:
    outcome = run(narrow, code)
    assert outcome.status is RunStatus.RAISED
    assert message in outcome.message


def test_a_part_cannot_be_changed_for_the_host_across_a_wait(narrow: Sandbox) -> None:
    code = "p = find_parts('hole')[0]\np.id = 'boss-1'\nfind_parts('slot')\nsolution = [p, p.distance_to(p)]"
    assert run(narrow, code).value == [{"part": "hole-1"}, 0.0]


def test_an_object_of_the_program_s_own_is_no_part_after_a_wait(narrow: Sandbox) -> None:
    code = "class P:\n    def __init__(self):\n        self.id = 'hole-9'\np = P()\nfind_parts('slot')\nsolution = [p]"
    outcome = run(narrow, code)
    assert (outcome.status, outcome.value) == (RunStatus.REFUSED, None)
    code = code.replace("solution = [p]", "q = find_parts('hole')[0]\nsolution = eval('q.distance_to(p)')")
    assert run(narrow, code).message.startswith("TypeError: distance_to() takes a part")


def test_the_number_of_calls_is_counted_across_waits(narrow: Sandbox) -> None:
    code = "p = find_parts('hole')[0]\nsolution = [p.edge_distance() for i in range(3)]"
    assert run(narrow, code, limits=RunLimits(host_calls=4)).status is RunStatus.OK
    assert run(narrow, code, limits=RunLimits(host_calls=3)).status is RunStatus.REFUSED


def test_time_and_memory_are_limited_after_a_wait(narrow: Sandbox) -> None:
    limits = RunLimits(duration_s=0.2, memory_bytes=2**24)
    assert run(narrow, "find_parts('hole')\nwhile True:\n    pass", limits=limits).status is RunStatus.TIMED_OUT
    outcome = run(narrow, "find_parts('hole')\nx = 'a' * 2**25\nsolution = 1", limits=limits)
    assert outcome.status is RunStatus.OUT_OF_MEMORY
    assert run(narrow, "solution = len(find_parts('hole'))").value == 3


def test_a_program_that_holds_much_keeps_its_interpreter(narrow: Sandbox) -> None:
    code = "x = [i * 1.5 for i in range(10**6)]\nfind_parts('hole')\nsolution = len(x)"
    assert run(narrow, code).value == 10**6


def test_all_time_in_segcad_is_limited_together(narrow: Sandbox) -> None:
    pause = threading.Event()
    code = "for i in range(100):\n    find_parts(f'hole {i}')\nsolution = 1"
    outcome = run(narrow, code, lambda: pause.wait(0.02), limits=RunLimits(segcad_s=0.1))
    assert (outcome.status, outcome.message) == (
        RunStatus.TIMED_OUT,
        "the segworker took longer than it may for one run",
    )
    assert 1 < len(outcome.groundings) < 100


def test_all_time_is_limited_together(narrow: Sandbox) -> None:
    pause = threading.Event()
    code = "for i in range(100):\n    find_parts(f'hole {i}')\nsolution = 1"
    outcome = run(narrow, code, lambda: pause.wait(0.02), limits=RunLimits(wall_s=0.1))
    assert (outcome.status, outcome.message) == (RunStatus.TIMED_OUT, "the run took longer than it may in all")


def test_a_run_that_waits_for_an_interpreter_is_ended_in_time(narrow: Sandbox) -> None:
    def meanwhile() -> None:
        control = RunControl()
        limits = RunLimits(wall_s=0.1)
        late = narrow.run("solution = 1", FakePartFinder(), limits, control=control)
        assert late.status is RunStatus.TIMED_OUT

    class Holding(FakePartFinder):
        def find_parts(self, description: str | PartQuery, sides: Sequence[Side] | None = None) -> Grounding:
            meanwhile()
            return super().find_parts(description, sides)

    assert narrow.run("solution = len(find_parts('hole'))", Holding()).value == 3
