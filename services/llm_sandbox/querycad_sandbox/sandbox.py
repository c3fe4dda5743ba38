"""Runs a program against the guest API of one model: length, type check, a fresh session, limits, plain data out."""

from __future__ import annotations

import re
from collections.abc import Iterator
from dataclasses import dataclass, field
from datetime import datetime
from importlib.resources import files
from itertools import islice
from threading import Lock
from time import perf_counter
from types import TracebackType
from typing import Any, Final, Self

from pydantic_monty import (
    FunctionSnapshot,
    FutureSnapshot,
    Monty,
    MontyComplete,
    MontyCrashedError,
    MontyError,
    MontySession,
    NameLookupSnapshot,
    OSPolicy,
    SyncSnapshot,
)

from querycad_contracts import AnswerType, Part, RunLimits, RunOutcome, RunStatus, SegCad

from .check import SCRIPT, TypeChecker
from .guest import Guest, RunEndedError
from .outcomes import outcome_of
from .values import MAX_ITEMS, UnfitError, plain

GRACE_S: Final = 1.0
"""How much longer than its time limit a program may take before its process is killed: the interpreter looks at the
clock only between operations, and not at all while it compiles."""
RUNS_PER_WORKER: Final = 500
"""A fresh process bounds what could pile up in one; starting it takes about 10 ms."""
MESSAGE_CHARS: Final = 2000
"""Of what there is to say, part of which is the program's to choose."""
RESULT_VARIABLES: Final = ("solution", "part", "parts")

DEFAULT_LIMITS: Final = RunLimits()

_SAME_FOR_ALL: Final[OSPolicy] = {
    "datetime": datetime(2000, 1, 1),  # noqa: DTZ001 - the interpreter's clock stands still; it has no zone
    "sleep": "zero",
    "random_start": {"seed": 0},
}
"""A program gives the same answer whenever it is run, and cannot wait."""
_SHAPE: Final = (None, "shape")
"""The look-up of the variable `shape`: of no object, by that name. Nothing is asked of SegCAD until it is read."""
_LOOPS_OVER_PART: Final = re.compile(r"\bfor\s+\(?(?:\w+\s*,\s*)*part\b")
"""`for part in` and `for i, part in`; in time linear in the program's length, which is hostile."""


class Sandbox:
    """Runs programs in worker processes of the interpreter, up to `workers` at a time; thread safe.

    Processes start with the first run (or `warm`) and end with `close`, or at the end of a `with` block. Start it
    after forking, not before.
    """

    def __init__(self, workers: int = 2) -> None:
        self._runners = Monty(
            min_processes=1,
            max_processes=workers,
            max_checkouts_per_worker=RUNS_PER_WORKER,
            feed_duration_limit_grace=GRACE_S,
        )
        self._checker = TypeChecker(workers)
        self._prelude = files(__package__).joinpath("prelude.py").read_text(encoding="utf-8")
        self._lock = Lock()
        self._started = False
        self._closed = False

    def __enter__(self) -> Self:
        return self

    def __exit__(
        self, kind: type[BaseException] | None, error: BaseException | None, trace: TracebackType | None
    ) -> None:
        self.close()

    def warm(self) -> None:
        """Starts the workers and loads the type checker, which the first run would do otherwise: about 0.1 s."""
        self._start()
        self._checker.problems("solution = len(find_parts('hole'))")

    def close(self) -> None:
        """Ends the worker processes; a closed sandbox runs nothing more."""
        with self._lock:
            if self._started and not self._closed:
                self._checker.close()
                self._runners.__exit__(None, None, None)
            self._closed = True

    def run(
        self, code: str, segcad: SegCad, limits: RunLimits = DEFAULT_LIMITS, expects: AnswerType | None = None
    ) -> RunOutcome:
        """What comes of `code`, run against the model behind `segcad`?

        The program's own failures are outcomes. A failure of `segcad` is raised as it is: it is not the program's.
        `expects` is only named in the message when there is no fit result; whether the value is of that type is for
        the caller to say.
        """
        started = perf_counter()
        self._start()
        run = _Run(Guest(segcad), limits)
        try:
            self._check(code, limits)
            try:
                run.execute(self._runners, self._prelude, code, expects)
            except MontyCrashedError:
                if run.begun:
                    raise
                run.execute(self._runners, self._prelude, code, expects)  # the worker had died while it was idle
        except RunEndedError as end:
            run.status, run.message = end.status, end.message
        except MontyError as error:
            run.status, run.message = outcome_of(error, run.guest)
        return run.outcome((perf_counter() - started) * 1e3)

    def _start(self) -> None:
        with self._lock:
            if self._closed:
                raise RuntimeError("the sandbox is closed")
            if not self._started:
                self._runners.__enter__()
                self._checker.start()
                self._started = True

    def _check(self, code: str, limits: RunLimits) -> None:
        try:
            size = len(code.encode())
        except UnicodeEncodeError:
            raise RunEndedError(RunStatus.REFUSED, "the program is no valid Unicode text") from None
        if size > limits.code_bytes:
            raise RunEndedError(RunStatus.REFUSED, f"the program is longer than {limits.code_bytes:,} bytes")
        if "\0" in code:
            raise RunEndedError(RunStatus.REFUSED, "the program holds a null character")
        if problems := self._checker.problems(code):
            raise RunEndedError(RunStatus.REFUSED, "\n".join(problems))


@dataclass(slots=True)
class _Run:
    """One program in one session of its own."""

    guest: Guest
    limits: RunLimits
    begun: bool = False
    """Whether the program itself has been started."""
    status: RunStatus = RunStatus.OK
    message: str = ""
    value: Any = None
    used_parts: tuple[str, ...] = ()
    _printed: list[str] = field(default_factory=list)
    _printed_bytes: int = 0

    def execute(self, runners: Monty, prelude: str, code: str, expects: AnswerType | None) -> None:
        """Runs `code`, takes the result out, and makes it plain data. Raises RunEndedError or MontyError."""
        with runners.checkout(
            script_name=SCRIPT,
            limits={
                "max_feed_duration_secs": self.limits.duration_s,
                "max_memory": self.limits.memory_bytes,
                "max_recursion_depth": self.limits.recursion,
                "max_suspensions": self.limits.host_calls + len(RESULT_VARIABLES) + 1,
            },
            os_policy=_SAME_FOR_ALL,
        ) as session:
            session.feed_run(prelude, print_callback=self._print)
            self.begun = True
            self._drive(session, code)
            found = self._harvest(session)
        wanted = f" (a value of type {expects.value!r} is expected)" if expects else ""
        if "solution" not in found:
            raise RunEndedError(RunStatus.RAISED, f"the program assigned nothing to `solution`{wanted}")
        self.used_parts = self._rests_on(found, code)
        try:
            self.value = plain(found["solution"])
        except UnfitError as unfit:
            raise RunEndedError(RunStatus.REFUSED, f"the result in `solution` {unfit}{wanted}") from None

    def outcome(self, duration_ms: float) -> RunOutcome:
        """The run as the contract has it."""
        ok = self.status is RunStatus.OK
        return RunOutcome(
            status=self.status,
            value=self.value if ok else None,
            message=self.message[:MESSAGE_CHARS],
            printed="".join(self._printed),
            groundings=tuple(self.guest.groundings),
            used_parts=self.used_parts if ok else (),
            duration_ms=duration_ms,
        )

    def _drive(self, session: MontySession, code: str) -> None:
        """Runs `code` to its end, answering its calls one by one."""
        started = perf_counter()
        snapshot: SyncSnapshot = session.feed_start(
            code, external_lookup=self.guest.names(), print_callback=self._print
        )
        calls = 0
        while not isinstance(snapshot, MontyComplete):
            calls += 1
            if calls > self.limits.host_calls:
                raise RunEndedError(RunStatus.REFUSED, f"the program made more than {self.limits.host_calls:,} calls")
            if perf_counter() - started - self.guest.segcad_s > self.limits.duration_s + GRACE_S:
                raise RunEndedError(RunStatus.TIMED_OUT, "the program ran out of time")
            snapshot = self._answer(snapshot)

    def _answer(self, snapshot: FunctionSnapshot | NameLookupSnapshot | FutureSnapshot) -> SyncSnapshot:
        """Lets the program go on to its next call, unless this one ended the run."""
        if isinstance(snapshot, FutureSnapshot):
            raise RunEndedError(RunStatus.REFUSED, "the program awaits what never comes: the guest API is not async")
        try:
            if isinstance(snapshot, NameLookupSnapshot) and (snapshot.object_id, snapshot.variable_name) == _SHAPE:
                return snapshot.resume(value=self.guest.shape())
            return snapshot.resume_auto()
        finally:
            if self.guest.ended is not None:
                raise self.guest.ended

    def _harvest(self, session: MontySession) -> dict[str, object]:
        """Which of the variables that tell of the result did the program leave, with which values?"""
        read = f"[{', '.join(RESULT_VARIABLES)}]"
        snapshot: SyncSnapshot = session.feed_start(read, print_callback=self._print)
        missing = set()
        while isinstance(snapshot, NameLookupSnapshot):
            missing.add(snapshot.variable_name)
            snapshot = snapshot.resume(value=None)
        assert isinstance(snapshot, MontyComplete)
        values = zip(RESULT_VARIABLES, snapshot.output, strict=True)
        return {name: value for name, value in values if name not in missing}

    def _rests_on(self, found: dict[str, object], code: str) -> tuple[str, ...]:
        """Ids of the parts that the result rests on: those in it, else the program's selection, else all it found.

        Reading a measure leaves no trace, so the program's own selection is what it left in `part` (unless that is
        only a loop's variable) or in `parts`.
        """
        part = None if _LOOPS_OVER_PART.search(code) else found.get("part")
        for selection in (found["solution"], part, found.get("parts")):
            if ids := _part_ids(selection):
                return ids
        return tuple(dict.fromkeys(part.id for grounding in self.guest.groundings for part in grounding.parts))

    def _print(self, _stream: str, text: str) -> None:
        room = self.limits.output_bytes - self._printed_bytes
        if room > 0:
            kept = text.encode()[:room]
            self._printed.append(kept.decode(errors="ignore"))
            self._printed_bytes += len(kept)


def _part_ids(value: object) -> tuple[str, ...]:
    """Ids of the parts among the first values of `value`, in order, each once."""
    return tuple(dict.fromkeys(item.id for item in islice(_walk(value, 3), MAX_ITEMS) if isinstance(item, Part)))


def _walk(value: object, depth: int) -> Iterator[object]:
    """`value`, and what is in it when it is a list, a tuple or a dict (whose keys do not count), down to `depth`."""
    yield value
    inside = value.values() if isinstance(value, dict) else value if isinstance(value, (list, tuple)) else ()
    if depth:
        for item in inside:
            yield from _walk(item, depth - 1)
