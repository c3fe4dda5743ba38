"""One program, from its first statement to its result: answers its calls, keeps what it prints, watches its budgets.

While the segworker works long on a call, the program is kept as a snapshot and its interpreter runs another program.
"""

from __future__ import annotations

import json
from collections.abc import Callable, Iterator, Sequence
from contextlib import contextmanager
from dataclasses import dataclass, field
from datetime import datetime
from functools import partial
from itertools import islice
from time import perf_counter
from typing import Any, Final

from pydantic_monty import (
    FunctionSnapshot,
    FutureSnapshot,
    MontyComplete,
    MontyCrashedError,
    MontyError,
    NameLookupSnapshot,
    OSPolicy,
    SyncSnapshot,
)

from querycad_contracts import (
    RESULT,
    AnswerType,
    Face,
    GuestAnswer,
    GuestCall,
    Part,
    Printed,
    RunLimits,
    RunOutcome,
    RunStatus,
)

from .check import SCRIPT
from .control import RunControl, RunEndedError
from .guest import FUNCTIONS, ON_DEMAND, Guest, PartView, View
from .interpreters import GRACE_S, Interpreters, Lease
from .outcomes import Ending
from .rewriting import WORDS_LEFT, rewritten
from .sources import MOST, sources
from .values import MAX_DEPTH, MAX_ITEMS, UnfitError, plain

MESSAGE_CHARS: Final = 2000
"""Of what there is to say, part of which is the program's to choose."""
SNAPSHOT_BYTES: Final = 4 * 2**20
"""A program that holds more keeps its interpreter while it waits, so that waiting programs cannot fill the memory."""
TOLD_PARTS, TOLD_CHARS = 50, 100
"""Of a call, in the events: ids of parts, and characters of an argument."""

_SAME_FOR_ALL: Final[OSPolicy] = {
    "datetime": datetime(2000, 1, 1),  # noqa: DTZ001 - the interpreter's clock stands still; it has no zone
    "sleep": "zero",
    "random_start": {"seed": 0},
}
"""A program gives the same answer whenever it is run, and cannot wait."""
OK: Final = Ending(RunStatus.OK, "")

HostCall = Callable[[], Any]
Asking = FunctionSnapshot | NameLookupSnapshot


@dataclass(slots=True)
class Run:
    """One program in one session of its own."""

    guest: Guest
    limits: RunLimits
    control: RunControl
    begun: bool = False
    """Whether the program itself has been started."""
    ending: Ending = OK
    value: Any = None
    used_parts: tuple[str, ...] = ()
    _printed: list[str] = field(default_factory=list)
    _printed_bytes: int = 0
    _calls: int = 0
    _waited_s: float = 0.0
    """For the segworker, and for an interpreter after that: not the program's time."""

    def execute(self, interpreters: Interpreters, prelude: str, code: str, expects: AnswerType | None) -> None:
        """Runs `code`, takes the result out, and makes it plain data. Raises RunEndedError or MontyError."""
        lease = interpreters.lease(
            SCRIPT,
            {
                "max_feed_duration_secs": self.limits.duration_s,
                "max_memory": self.limits.memory_bytes,
                "max_recursion_depth": self.limits.recursion,
                "max_suspensions": self.limits.host_calls + MOST + 2,
            },
            _SAME_FOR_ALL,
            self.control,
        )
        with lease, self.control.stopped_by(lease.kill):
            lease.session.feed_run(prelude, print_callback=self._print)
            self.begun = True
            self._drive(lease, rewritten(code))
            found = self._result(lease)
            if found:
                self.used_parts = self._rests_on(lease, found[0], sources(code))
        wanted = f" (a value of type {expects.value!r} is expected)" if expects else ""
        if not found:
            raise RunEndedError(RunStatus.RAISED, f"the program assigned nothing to `{RESULT}`{wanted}")
        try:
            self.value = plain(found[0], self.guest.original)
        except UnfitError as unfit:
            raise RunEndedError(RunStatus.REFUSED, f"the result in `{RESULT}` {unfit}{wanted}") from None
        absence = self.guest.absence
        if absence is not None and any(each is None for each in _walk(self.value, MAX_DEPTH)):
            status = RunStatus.RAISED if expects is not None else RunStatus.OK
            self.ending = Ending(status, f"the result lacks a measure: {absence.text}", absence.missing)

    def outcome(self, duration_ms: float) -> RunOutcome:
        """The run as the contract has it."""
        ok = self.ending.status is RunStatus.OK
        return RunOutcome(
            status=self.ending.status,
            value=self.value if ok else None,
            message=self.ending.message[:MESSAGE_CHARS],
            missing_attribute=self.ending.missing_attribute,
            empty_selection=self.ending.empty_selection,
            printed="".join(self._printed),
            groundings=tuple(self.guest.groundings),
            pictures=tuple(self.guest.pictures),
            used_parts=self.used_parts if ok else (),
            duration_ms=duration_ms,
        )

    def _drive(self, lease: Lease, code: str) -> None:
        """Runs `code` to its end, answering its calls one by one."""
        started = perf_counter()
        snapshot: SyncSnapshot = lease.session.feed_start(
            code, external_lookup=self.guest.names(), print_callback=self._print
        )
        while not isinstance(snapshot, MontyComplete):
            self._calls += 1
            if self._calls > self.limits.host_calls:
                raise RunEndedError(RunStatus.REFUSED, f"the program made more than {self.limits.host_calls:,} calls")
            if perf_counter() - started - self._waited_s > self.limits.duration_s + GRACE_S:
                raise RunEndedError(RunStatus.TIMED_OUT, "the program ran out of time")
            self.control.check()
            snapshot = self._answer(lease, snapshot)

    def _answer(self, lease: Lease, snapshot: Asking | FutureSnapshot) -> SyncSnapshot:
        """Lets the program go on to its next call, unless this one ended the run."""
        if isinstance(snapshot, FutureSnapshot):
            raise RunEndedError(RunStatus.REFUSED, "the program uses await, but the guest API is not async")
        host_call = self._host_call(snapshot)
        if host_call is None:
            return snapshot.resume_auto()
        value, error = None, None
        with self._interpreter_for_others(lease, snapshot) as waiting:
            try:
                value = host_call()
            except Exception as raised:
                error = raised
        if self.guest.ended is not None:
            raise self.guest.ended
        snapshot = waiting[0]
        if isinstance(snapshot, NameLookupSnapshot):
            return snapshot.resume() if error else snapshot.resume(value=value)
        return snapshot.resume({"exception": error} if error else {"return_value": value})

    def _host_call(self, snapshot: Asking) -> HostCall | None:
        """What is the host to do for the program here? None: what the interpreter knows how to settle."""
        guest = self.guest
        view = guest.views.get(snapshot.object_id) if snapshot.object_id else None
        if isinstance(snapshot, NameLookupSnapshot):
            name = snapshot.variable_name
            if view is not None:
                look_up = partial(view.lookup_lazy_attrs, name)
                asks = name in ON_DEMAND.get(type(view.value), ())
                return self._told(name, view, (), look_up) if asks else look_up
            return self._told(name, None, (), guest.shape) if (snapshot.object_id, name) == (None, "shape") else None
        name, args, kwargs = snapshot.function_name, guest.originals(snapshot.args), snapshot.kwargs
        if view is not None:
            kwargs = dict(zip(kwargs, guest.originals(tuple(kwargs.values())), strict=True))
            call = partial(view.call_method, name, args, kwargs)
            return self._told(name, view, (*args, *kwargs.values()), call)
        if snapshot.object_id is None and not snapshot.is_os_function:
            if name == WORDS_LEFT:
                return guest.words_left
            if name in FUNCTIONS:
                kwargs = dict(zip(kwargs, guest.originals(tuple(kwargs.values())), strict=True))
                return self._told(name, None, (*args, *kwargs.values()), partial(getattr(guest, name), *args, **kwargs))
        return None

    def _told(self, name: str, view: View | None, arguments: tuple[Any, ...], call: HostCall) -> HostCall:
        """The call, told to whoever listens when it begins and when it ends."""
        if not self.control.is_heard:
            return call
        number = self._calls

        def told() -> Any:
            on = str(view.value.id) if isinstance(view, PartView) else ""
            texts = tuple(_text(each) for each in arguments)
            self.control.tell(GuestCall(call=number, name=name[:TOLD_CHARS], on=on, arguments=texts))
            started, value, error = perf_counter(), None, ""
            try:
                value = call()
            except BaseException as raised:
                error = str(self.guest.ended or raised)
                raise
            finally:
                self.control.tell(_answered(number, (perf_counter() - started) * 1e3, value, error))
            return value

        return told

    @contextmanager
    def _interpreter_for_others(self, lease: Lease, snapshot: Asking) -> Iterator[list[Asking]]:
        """While the context lasts, `control.release` keeps the program as a snapshot and gives its interpreter back.

        Yields a list of the snapshot to go on from.
        """
        started, kept, current = perf_counter(), b"", [snapshot]

        def release() -> None:
            nonlocal kept
            dump = snapshot.dump()
            if len(dump) <= SNAPSHOT_BYTES:
                lease.give_back()
                kept = dump

        outer, self.control.release = self.control.release, release
        try:
            yield current
        finally:
            self.control.release = outer
            if kept and self.guest.ended is None:
                current[0] = self._restored(lease, kept)
            self._waited_s += perf_counter() - started

    def _restored(self, lease: Lease, kept: bytes) -> Asking:
        """The program where it waited, in an interpreter of its own again."""
        lease.take()
        try:
            restored = lease.session.load_snapshot(kept, external_lookup=self.guest.names(), print_callback=self._print)
        except MontyCrashedError:  # the process had died while it was idle
            lease.give_back()
            lease.take()
            restored = lease.session.load_snapshot(kept, external_lookup=self.guest.names(), print_callback=self._print)
        assert isinstance(restored, FunctionSnapshot | NameLookupSnapshot)
        return restored

    def _result(self, lease: Lease) -> list[object]:
        """What the program left in `solution`, as the only item of a list; an empty list where it left nothing."""
        snapshot: SyncSnapshot = lease.session.feed_start(RESULT, print_callback=self._print)
        is_there = True
        while isinstance(snapshot, NameLookupSnapshot):
            is_there = False
            snapshot = snapshot.resume(value=None)
        assert isinstance(snapshot, MontyComplete)
        return [snapshot.output] if is_there else []

    def _rests_on(self, lease: Lease, result: object, layers: Sequence[Sequence[str]]) -> tuple[str, ...]:
        """Ids of the parts that the result rests on: those in it, else in what it is made of, the nearest first.

        Reading a measure leaves no trace, so the selection that a measure was read of is found through the program's
        own assignments. Where that finds none, it is all parts that the program found.
        """
        found = [part.id for grounding in self.guest.groundings for part in grounding.parts]
        if not found:
            return ()
        return self._part_ids(result) or self._part_ids(self._selected(lease, layers)) or tuple(dict.fromkeys(found))

    def _selected(self, lease: Lease, layers: Sequence[Sequence[str]]) -> object:
        """Parts in the first of these layers of variables that has any; they are picked out by the interpreter.

        None where the program has made that impossible: it has its answer all the same.
        """
        if not layers:
            return None
        told = ", ".join(f"[{', '.join(layer)}]" for layer in layers)
        try:
            snapshot: SyncSnapshot = lease.session.feed_start(
                f"_parts_in([{told}], Part)", external_lookup=self.guest.names(), print_callback=self._print
            )
            while isinstance(snapshot, NameLookupSnapshot):
                is_kind = snapshot.variable_name == "Part"
                snapshot = snapshot.resume_auto() if is_kind else snapshot.resume(value=None)
        except MontyError:
            return None
        return snapshot.output if isinstance(snapshot, MontyComplete) else None

    def _part_ids(self, value: object) -> tuple[str, ...]:
        """Ids of the parts among the first values of `value`, in order, each once."""
        items = map(self.guest.original, islice(_walk(value, 3), MAX_ITEMS))
        return tuple(dict.fromkeys(item.id for item in items if isinstance(item, Part)))

    def _print(self, _stream: str, text: str) -> None:
        room = self.limits.output_bytes - self._printed_bytes
        if room > 0:
            kept = text.encode()[:room]
            shown = kept.decode(errors="ignore")
            self._printed.append(shown)
            self._printed_bytes += len(kept)
            self.control.tell(Printed(text=shown))


def _answered(call: int, duration_ms: float, value: Any, error: str) -> GuestAnswer:
    views = value if isinstance(value, list) else []
    return GuestAnswer(
        call=call,
        duration_ms=round(duration_ms, 3),
        found=len(views) if isinstance(value, list) else None,
        parts=tuple(view.value.id for view in views[:TOLD_PARTS] if isinstance(view, PartView)),
        value=value if isinstance(value, float) else None,
        error=error[:MESSAGE_CHARS],
    )


def _text(argument: object) -> str:
    if isinstance(argument, Part | Face):
        return str(argument.id)
    if isinstance(argument, list | tuple) and all(isinstance(each, str) for each in argument[:TOLD_CHARS]):
        argument = ", ".join(argument[:TOLD_CHARS])
    if isinstance(argument, dict):
        argument = json.dumps(argument, default=str)
    return (argument if isinstance(argument, str) else type(argument).__name__)[:TOLD_CHARS]


def _walk(value: object, depth: int) -> Iterator[object]:
    """`value`, and what is in it when it is a list, a tuple or a dict (whose keys do not count), down to `depth`."""
    yield value
    inside = value.values() if isinstance(value, dict) else value if isinstance(value, (list, tuple)) else ()
    if depth:
        for item in inside:
            yield from _walk(item, depth - 1)
