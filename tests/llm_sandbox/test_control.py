"""A run from outside: what is heard of it, and how it is cancelled wherever it is."""

from __future__ import annotations

import threading
from collections.abc import Sequence

import pytest
from tests.llm_sandbox.conftest import FakePartFinder

from querycad_contracts import Grounding, GuestAnswer, GuestCall, PartQuery, Printed, RunLimits, RunStatus, Side
from querycad_sandbox import Sandbox
from querycad_sandbox.control import Heard, RunControl


class Hearing:
    """Keeps what it hears; `when` something is heard, does something."""

    def __init__(self) -> None:
        self.heard: list[Heard] = []
        self.printed = threading.Event()

    def __call__(self, event: Heard) -> None:
        self.heard.append(event)
        if isinstance(event, Printed):
            self.printed.set()


def test_each_call_is_heard_when_it_begins_and_when_it_ends(sandbox: Sandbox, finder: FakePartFinder) -> None:
    hearing = Hearing()
    code = (
        "a = find_parts('hole', sides=['top', 'left'])\nprint('seen', len(a))\n"
        "x = shape.width\nf = a[0].faces\nsolution = a[0].distance_to(a[1])"
    )
    sandbox.run(code, finder, control=RunControl(hearing))
    calls = [event for event in hearing.heard if isinstance(event, GuestCall)]
    answers = [event for event in hearing.heard if isinstance(event, GuestAnswer)]
    assert [(call.name, call.on, call.arguments) for call in calls] == [
        ("find_parts", "", ("hole", "top, left")),
        ("shape", "", ()),
        ("faces", "hole-1", ()),
        ("distance_to", "hole-1", ("hole-2",)),
    ]
    assert [answer.call for answer in answers] == [call.call for call in calls]
    assert answers[0].parts == ("hole-1", "hole-2", "hole-3")
    assert (answers[2].found, answers[3].value) == (2, 0.007)
    assert [event.text for event in hearing.heard if isinstance(event, Printed)] == ["seen 3\n"]


def test_an_error_of_a_call_is_heard(sandbox: Sandbox, finder: FakePartFinder) -> None:
    hearing = Hearing()
    sandbox.run("solution = find_parts('sprocket')", finder, control=RunControl(hearing))
    answer = hearing.heard[-1]
    assert isinstance(answer, GuestAnswer)
    assert answer.error.startswith("not grounded: 'sprocket'")


def test_printed_text_is_cut_while_it_is_heard(sandbox: Sandbox, finder: FakePartFinder) -> None:
    hearing = Hearing()
    limits = RunLimits(output_bytes=1000, duration_s=0.3)
    outcome = sandbox.run("while True:\n    print('a' * 300)", finder, limits, control=RunControl(hearing))
    texts = [event.text for event in hearing.heard if isinstance(event, Printed)]
    assert "".join(texts) == outcome.printed
    assert len(outcome.printed) == 1000


def cancelled_when_it_prints(sandbox: Sandbox, code: str) -> RunStatus:
    hearing = Hearing()
    control = RunControl(hearing)

    def cancel() -> None:
        hearing.printed.wait(20)
        control.cancel()

    canceller = threading.Thread(target=cancel)
    canceller.start()
    outcome = sandbox.run(code, FakePartFinder(), RunLimits(duration_s=30), control=control)
    canceller.join()
    return outcome.status


@pytest.mark.parametrize(
    "code",
    [
        "print('x')\nwhile True:\n    pass",
        "print('x')\nwhile True:\n    try:\n        while True: pass\n    except BaseException: pass",
        "print('x')\nwhile True:\n    print('x')",
    ],
)
def test_a_program_that_computes_is_cancelled(sandbox: Sandbox, code: str) -> None:
    assert cancelled_when_it_prints(sandbox, code) is RunStatus.CANCELLED
    assert sandbox.run("solution = 1", FakePartFinder()).value == 1


def test_a_run_that_was_cancelled_before_it_began_does_nothing(sandbox: Sandbox, finder: FakePartFinder) -> None:
    control = RunControl()
    control.cancel()
    outcome = sandbox.run("solution = len(find_parts('hole'))", finder, control=control)
    assert (outcome.status, outcome.message, finder.calls) == (RunStatus.CANCELLED, "the run was cancelled", [])


def test_a_run_in_segcad_is_cancelled_when_the_call_can_be(sandbox: Sandbox) -> None:
    control = RunControl()

    class Stoppable(FakePartFinder):
        def find_parts(self, description: str | PartQuery, sides: Sequence[Side] | None = None) -> Grounding:
            woken = threading.Event()
            with control.stopped_by(woken.set):
                threading.Thread(target=control.cancel).start()
                assert woken.wait(20)
            return super().find_parts(description, sides)

    outcome = sandbox.run("solution = len(find_parts('hole'))", Stoppable(), control=control)
    assert outcome.status is RunStatus.CANCELLED
    assert outcome.value is None


def test_cancelling_a_run_that_ended_changes_nothing(sandbox: Sandbox, finder: FakePartFinder) -> None:
    control = RunControl()
    assert sandbox.run("solution = 1", finder, control=control).value == 1
    control.cancel()
    assert sandbox.run("solution = 2", finder).value == 2


def test_a_cancellation_kills_no_other_run(sandbox: Sandbox) -> None:
    stop = threading.Event()
    statuses: list[RunStatus] = []

    def others() -> None:
        while not stop.is_set():
            statuses.append(sandbox.run("solution = sum(range(2000))", FakePartFinder()).status)

    runner = threading.Thread(target=others)
    runner.start()
    for _ in range(5):
        assert cancelled_when_it_prints(sandbox, "print('x')\nwhile True:\n    pass") is RunStatus.CANCELLED
    stop.set()
    runner.join()
    assert set(statuses) == {RunStatus.OK}
