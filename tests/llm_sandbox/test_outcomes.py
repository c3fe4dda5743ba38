"""How a run ends: limits, what is printed, which parts a result rests on, and a sandbox that is well afterwards."""

from __future__ import annotations

import contextlib
import os
import signal
from collections.abc import Iterator, Sequence
from concurrent.futures import ThreadPoolExecutor
from dataclasses import dataclass
from time import sleep

import psutil
import pytest
from tests.llm_sandbox.conftest import FakePartFinder

from querycad_contracts import (
    AnswerType,
    Grounding,
    MissingAttribute,
    NoSuchMeasure,
    PartQuery,
    RunLimits,
    RunStatus,
    Side,
)
from querycad_sandbox import Sandbox
from querycad_sandbox.guest import DESCRIPTIONS

SHORT = RunLimits(duration_s=0.2)
OK, RAISED, REFUSED = RunStatus.OK, RunStatus.RAISED, RunStatus.REFUSED
TIMED_OUT, OUT_OF_MEMORY = RunStatus.TIMED_OUT, RunStatus.OUT_OF_MEMORY
HOLES = ["hole-1", "hole-2", "hole-3"]


@pytest.fixture
def own_sandbox() -> Iterator[Sandbox]:
    with Sandbox(workers=1) as made:
        yield made


@dataclass
class OwnWorkers:
    """A sandbox whose worker processes, and no others, can be killed."""

    sandbox: Sandbox
    others: set[int]

    def kill(self) -> None:
        for pid in workers() - self.others:
            os.kill(pid, signal.SIGKILL)


@pytest.fixture
def own_workers() -> Iterator[OwnWorkers]:
    others = workers()
    with Sandbox(workers=1) as made:
        made.warm()
        yield OwnWorkers(made, others)


@pytest.mark.parametrize("code", ["x = 1", "pass", "", "# nothing", "def f():\n    solution = 1\nf()", "solution_ = 1"])
def test_a_program_that_assigns_no_solution_raised(sandbox: Sandbox, finder: FakePartFinder, code: str) -> None:
    outcome = sandbox.run(code, finder)
    assert (outcome.status, outcome.value) == (RAISED, None)
    assert outcome.message == "the program assigned nothing to `solution`"


def test_the_expected_type_is_told_when_there_is_no_result(sandbox: Sandbox, finder: FakePartFinder) -> None:
    assert sandbox.run("x = 1", finder, expects=AnswerType.LENGTHS).message.endswith(
        "(a value of type 'lengths' is expected)"
    )
    assert sandbox.run("solution = {}", finder, expects=AnswerType.COUNT).message.endswith(
        "(a value of type 'count' is expected)"
    )


@pytest.mark.parametrize(
    ("limits", "code", "status"),
    [
        (RunLimits(duration_s=0.1), "while True:\n    pass", TIMED_OUT),
        (RunLimits(memory_bytes=2**22), 'x = "a" * 2**23\nsolution = 1', OUT_OF_MEMORY),
        (RunLimits(recursion=50), "def f(n):\n    return n and f(n - 1)\nsolution = f(60)", RAISED),
        (RunLimits(host_calls=5), 'p = find_parts("hole")[0]\nsolution = [len(p.faces) for i in range(9)]', REFUSED),
        (RunLimits(code_bytes=20), "solution = 1 # a long remark", REFUSED),
    ],
)  # fmt: skip
def test_a_limit_ends_the_program_and_not_the_sandbox(
    sandbox: Sandbox, finder: FakePartFinder, limits: RunLimits, code: str, status: RunStatus
) -> None:
    assert sandbox.run(code, finder, limits).status is status
    assert sandbox.run(code, finder, RunLimits(duration_s=0.1)).status is (TIMED_OUT if status is TIMED_OUT else OK)


def test_the_number_of_calls_is_exact(sandbox: Sandbox, finder: FakePartFinder) -> None:
    code = 'p = find_parts("hole")[0]\nsolution = [p.edge_distance() for i in range(3)]'
    assert sandbox.run(code, finder, RunLimits(host_calls=4)).status is OK
    assert sandbox.run(code, finder, RunLimits(host_calls=3)).status is REFUSED


def test_too_many_different_descriptions_are_refused(sandbox: Sandbox, finder: FakePartFinder) -> None:
    code = f'solution = [len(find_parts(f"hole {{i}}")) for i in range({DESCRIPTIONS + 1})]'
    outcome = sandbox.run(code, finder)
    assert outcome.status is REFUSED
    assert len(outcome.groundings) == len(finder.calls) == DESCRIPTIONS


def test_the_time_that_segcad_takes_is_not_the_programs(sandbox: Sandbox) -> None:
    class Slow(FakePartFinder):
        def find_parts(self, description: str | PartQuery, sides: Sequence[Side] | None = None) -> Grounding:
            sleep(1.5)
            return super().find_parts(description, sides)

    assert sandbox.run('solution = len(find_parts("hole"))', Slow(), RunLimits(duration_s=0.1)).value == 3


def test_a_measure_that_parts_have_not_is_the_programs_error_which_it_may_catch(sandbox: Sandbox) -> None:
    class Unmeasured(FakePartFinder):
        def edge_distance(self, part: str) -> float:
            raise NoSuchMeasure(f"{part} lies in no plane face")

    ask = 'find_parts("hole")[0].edge_distance()'
    outcome = sandbox.run(f"solution = {ask}", Unmeasured())
    assert (outcome.status, "hole-1 lies in no plane face" in outcome.message) == (RAISED, True)
    caught = f"try:\n    solution = {ask}\nexcept ValueError:\n    solution = 0.5"
    assert sandbox.run(caught, Unmeasured()).value == 0.5


def test_printed_text_is_kept_and_cut_at_the_limit(sandbox: Sandbox, finder: FakePartFinder) -> None:
    assert sandbox.run('print("é", 1)\nprint(2, end="")\nsolution = 0', finder).printed == "é 1\n2"
    outcome = sandbox.run('print("é" * 5000)\nprint("x")\nsolution = 0', finder, RunLimits(output_bytes=101))
    assert (outcome.status, outcome.printed) == (OK, "é" * 50)


def test_what_was_printed_before_a_failure_is_kept(sandbox: Sandbox, finder: FakePartFinder) -> None:
    assert sandbox.run('print("so far")\nsolution = 1 / 0', finder).printed == "so far\n"


def test_nothing_reaches_the_output_of_the_host(
    sandbox: Sandbox, finder: FakePartFinder, capfd: pytest.CaptureFixture[str]
) -> None:
    sandbox.run('import sys\nprint("a")\nprint("b", file=sys.stderr)\nsolution = 1', finder)
    assert capfd.readouterr() == ("", "")


@pytest.mark.parametrize(
    ("code", "part", "attribute"),
    [
        ('solution = find_parts("slot")[0].radius', "slot-1", "radius"),
        ('solution = max(find_parts("slot"), key=lambda p: p.radius)', "slot-1", "radius"),
        ('ps = find_parts("slot")\nps.sort(key=lambda p: p.radius)\nsolution = ps', "slot-1", "radius"),
        ('s = find_parts("plate")[0]\nsolution = s.angle_to(find_parts("hole")[0])', "body-1", "axis"),
        ("solution = shape.thickness", "", "thickness"),
        ('solution = find_parts("hole")[0].faces[0].normal', "", "normal"),
    ],
)
def test_a_measure_that_is_not_there_is_told_as_data(
    sandbox: Sandbox, finder: FakePartFinder, code: str, part: str, attribute: str
) -> None:
    outcome = sandbox.run(code, finder)
    assert outcome.missing_attribute == MissingAttribute(part=part, attribute=attribute)
    assert not outcome.empty_selection


@pytest.mark.parametrize(
    "code",
    [
        "solution = min([])",
        'solution = max(p.radius for p in find_parts("hole") if p.radius > 1)',
        'solution = max([p for p in find_parts("hole") if p.radius > 1], key=lambda p: p.radius)',
        'solution = find_parts("boss")[1]',
        'solution = sorted(find_parts("boss"), key=lambda p: p.radius)[-2]',
    ],
)
def test_a_choice_among_too_few_is_told_as_data(sandbox: Sandbox, finder: FakePartFinder, code: str) -> None:
    outcome = sandbox.run(code, finder)
    assert (outcome.status, outcome.empty_selection, outcome.missing_attribute) == (RunStatus.RAISED, True, None)


@pytest.mark.parametrize(
    "code", ["solution = 1 / 0", "solution = [].radius", 'raise ValueError("it is empty")', 'solution = {}["a"]']
)
def test_another_error_is_neither(sandbox: Sandbox, finder: FakePartFinder, code: str) -> None:
    outcome = sandbox.run(code, finder, check=False)
    assert (outcome.status, outcome.empty_selection, outcome.missing_attribute) == (RunStatus.RAISED, False, None)


@pytest.mark.parametrize(
    ("code", "used"),
    [
        ('solution = find_parts("hole")[1:]', ["hole-2", "hole-3"]),
        ('parts = find_parts("hole")\nsolution = parts[2]', ["hole-3"]),
        ('solution = [[p, p.radius] for p in find_parts("boss")]', ["boss-1"]),
        ('parts = [p for p in find_parts("hole") if p.radius > 0.003]\nsolution = len(parts)', ["hole-3"]),
        ('parts = find_parts("hole")\npart = max(parts, key=lambda p: p.radius)\nsolution = part.depth', ["hole-3"]),
        ('parts = find_parts("hole")\nt = 0.0\nfor part in parts:\n    t += part.radius\nsolution = t', HOLES),
        ('t = 0.0\nfor i, part in enumerate(find_parts("hole")):\n    t += part.radius\nsolution = t', HOLES),
        ('holes = find_parts("hole")\nwide = max(holes, key=lambda p: p.radius)\nsolution = wide.depth', ["hole-3"]),
        ('a = {"x": find_parts("hole")[:1], "y": find_parts("boss")}\nsolution = len(a)', ["hole-1", "boss-1"]),
        ('a = find_parts("hole")[1:]\nb = [p.radius for p in a]\nsolution = max(b)', ["hole-2", "hole-3"]),
        ('a = find_parts("hole")[1:]\nb = find_parts("boss")\nsolution = len(a) > len(b)', [*HOLES[1:], "boss-1"]),
        ('a = find_parts("hole")[1:]\nfind_parts("boss")\nif a:\n    solution = 1', ["hole-2", "hole-3"]),
        ('a = []\nfor p in find_parts("hole"):\n    if p.depth < 1:\n        a.append(p)\nsolution = len(a)', HOLES),
        ('a = []\nfor p in find_parts("hole")[1:]:\n    a.append(p)\nsolution = len(a)', ["hole-2", "hole-3"]),
        ('a = find_parts("hole")[1:]\nisinstance = 3\nsolution = len(a)', HOLES),
        ('a = find_parts("hole")[1:]\nx = [i * 1.5 for i in range(10**5)]\nsolution = len(x) + len(a)', HOLES[1:]),
        ('def f(ps):\n    return len(ps)\na = find_parts("hole")[2:]\nsolution = f(a)', ["hole-3"]),
        ('parts = find_parts("hole")[:1]\nb = find_parts("boss")\nsolution = b[0].height', ["boss-1"]),
        ('parts = find_parts("hole")[:1]\nsolution = 1', ["hole-1", "hole-2", "hole-3"]),
        ('solution = len(find_parts("boss")) + len(find_parts("slot"))', ["boss-1", "slot-1"]),
        ('parts = 3\nsolution = len(find_parts("boss"))', ["boss-1"]),
        ('parts = ["hole-1"]\nsolution = len(find_parts("boss"))', ["boss-1"]),
        ("solution = shape.width", []),
    ],
)  # fmt: skip
def test_the_parts_that_a_result_rests_on(sandbox: Sandbox, finder: FakePartFinder, code: str, used: list[str]) -> None:
    outcome = sandbox.run(code, finder)
    assert (outcome.message, list(outcome.used_parts)) == ("", used)


def test_a_program_that_failed_rests_on_nothing(sandbox: Sandbox, finder: FakePartFinder) -> None:
    outcome = sandbox.run('parts = find_parts("hole")\nsolution = 1 / 0', finder)
    assert (outcome.used_parts, len(outcome.groundings)) == ((), 1)


def test_a_program_gives_the_same_answer_whenever_it_is_run(sandbox: Sandbox, finder: FakePartFinder) -> None:
    code = (
        "import random, time, datetime\n"
        "solution = [random.random(), time.time(), str(datetime.datetime.now()), hash('a'), random.Random().random()]"
    )
    first, second = sandbox.run(code, finder), sandbox.run(code, finder)
    assert first.status is OK
    assert first.value == second.value


def test_nothing_of_one_run_is_left_in_the_next(own_sandbox: Sandbox) -> None:
    greedy = (
        'leftover = find_parts("hole")\nmin = max = None\nimport math\ndef distance(a, b):\n    return 42\nsolution = 1'
    )
    for _ in range(3):
        assert own_sandbox.run(greedy, FakePartFinder("other-")).status is OK
        for name in ("leftover", "math"):
            hidden = own_sandbox.run(f'solution = eval("{name}")', FakePartFinder())
            assert (hidden.status, hidden.message.partition(" (")[0]) == (
                RAISED,
                f"NameError: name '{name}' is not defined",
            )
        assert own_sandbox.run("solution = [min(2, 1), distance((0, 0, 0), (3, 4, 0))]", FakePartFinder()).value == [
            1,
            5.0,
        ]


def test_runs_of_two_models_at_once_see_their_own_parts(sandbox: Sandbox) -> None:
    code = 'solution = [find_parts("hole")[0].id for i in range(20)] + [p.id for p in find_parts("boss")]'
    models = [FakePartFinder(f"m{i}-") for i in range(12)]
    with ThreadPoolExecutor(6) as threads:
        outcomes = list(threads.map(lambda model: sandbox.run(code, model), models))
    assert [o.value for o in outcomes] == [[f"m{i}-hole-1"] * 20 + [f"m{i}-boss-1"] for i in range(12)]


def test_a_worker_killed_in_a_run_is_a_crash_and_is_replaced(own_workers: OwnWorkers) -> None:
    class Killer(FakePartFinder):
        def find_parts(self, description: str | PartQuery, sides: Sequence[Side] | None = None) -> Grounding:
            own_workers.kill()
            return super().find_parts(description, sides)

    outcome = own_workers.sandbox.run('solution = len(find_parts("hole"))', Killer())
    assert (outcome.status, outcome.message) == (RunStatus.CRASHED, "the interpreter crashed")
    assert own_workers.sandbox.run('solution = len(find_parts("hole"))', FakePartFinder()).value == 3


def test_workers_killed_between_runs_are_replaced_unnoticed(own_workers: OwnWorkers) -> None:
    for _ in range(2):
        assert own_workers.sandbox.run('solution = len(find_parts("hole"))', FakePartFinder()).value == 3
        own_workers.kill()


def test_processes_start_with_the_first_run_and_end_with_close(finder: FakePartFinder) -> None:
    before = workers()
    made = Sandbox()
    assert workers() == before
    made.warm()
    assert made.run("solution = 1", finder).value == 1
    assert workers() > before
    made.close()
    made.close()
    assert workers() & before == before
    with pytest.raises(RuntimeError, match="closed"):
        made.run("solution = 1", finder)


def test_a_sandbox_never_used_closes(finder: FakePartFinder) -> None:
    with Sandbox():
        pass


def test_duration_is_told(sandbox: Sandbox, finder: FakePartFinder) -> None:
    assert sandbox.run("while True:\n    pass", finder, SHORT).duration_ms >= 200


def workers() -> set[int]:
    """Process ids of this process's children that run the interpreter."""
    pids = set()
    for child in psutil.Process().children():
        with contextlib.suppress(psutil.NoSuchProcess):
            if child.name() == "monty":
                pids.add(child.pid)
    return pids
