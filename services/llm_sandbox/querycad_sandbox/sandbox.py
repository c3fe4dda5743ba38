"""Runs a program against the guest API of one model: length, type check, a fresh session, limits, plain data out."""

from __future__ import annotations

import ast
import logging
import re
from importlib.resources import files
from threading import Lock
from time import perf_counter
from typing import Final, Self

from pydantic_monty import MontyCrashedError, MontyError

from querycad_contracts import AnswerType, PartFinder, RunLimits, RunOutcome, RunStatus
from querycad_contracts.infrastructure import Walls, WallSettings, WallsMissing

from .check import TypeChecker
from .control import CANCELLED, RunControl, RunEndedError
from .guest import Guest
from .interpreters import Interpreters
from .outcomes import Ending, ending_of
from .rewriting import ATTRIBUTES
from .run import Run
from .walls.confinement import Confinement

DEFAULT_LIMITS: Final = RunLimits()
HOST_SHARE: Final = 4
"""What a run's objects of the model may take here, for each byte of its heap: 40,000 parts as a rule."""

log = logging.getLogger(__name__)


class Sandbox:
    """Runs programs in the interpreter's processes, up to `workers` at a time; thread safe.

    A program whose call to the segworker takes long does not count: it holds no process while it waits. Processes start
    with the first run (or `warm`) and end with `close`, or at the end of a `with` block. Start it after forking.
    """

    def __init__(self, workers: int = 2, walls: Walls | None = None) -> None:
        """`walls`: what holds where some cannot be raised; None: as QUERYCAD_WALLS says."""
        self._workers = workers
        self._walls = walls or WallSettings.read().walls
        self._prelude, self._relations = (
            files(__package__).joinpath("inside", name).read_text(encoding="utf-8")
            for name in ("prelude.py", "relations.py")
        )
        self._names_relations = re.compile(rf"\b(?:{'|'.join((*ATTRIBUTES, *_functions(self._relations)))})\b")
        self._lock = Lock()
        self._confinement: Confinement | None = None
        self._interpreters: Interpreters | None = None
        self._checker: TypeChecker | None = None
        self._closed = False

    def __enter__(self) -> Self:
        return self

    def __exit__(self, *_: object) -> None:
        self.close()

    def warm(self) -> None:
        """Starts the workers and loads the type checker, which the first run would do otherwise: about 0.1 s."""
        _, checker = self._start()
        checker.problems("solution = len(find_parts('hole'))")

    @property
    def layers(self) -> dict[str, bool]:
        """Which walls stand around the interpreter's processes? Empty before the first is started."""
        return {} if self._confinement is None else self._confinement.layers

    @property
    def missing(self) -> tuple[str, ...]:
        """Which walls are not up? Programs run without them only where the setting says so."""
        return () if self._confinement is None else self._confinement.missing

    def close(self) -> None:
        """Ends the worker processes; a closed sandbox runs nothing more."""
        with self._lock:
            if self._checker is not None and not self._closed:
                self._checker.close()
            if self._interpreters is not None and not self._closed:
                self._interpreters.close()
            if self._confinement is not None and not self._closed:
                self._confinement.close()
            self._closed = True

    def run(
        self,
        code: str,
        finder: PartFinder,
        limits: RunLimits = DEFAULT_LIMITS,
        expects: AnswerType | None = None,
        control: RunControl | None = None,
        check: bool = True,
    ) -> RunOutcome:
        """What comes of `code`, run against the model behind `finder`?

        Raises WallsMissing, and runs nothing, where walls are required that are not up. The program's own failures are
        outcomes. A failure of `finder` is raised as it is: it is not the program's.
        A program whose interpreter crashed is run once more.
        `expects` is only named in the message when there is no fit result; whether the value is of that type is for
        the caller to say. `control` hears what the program does, and can end it. Without `check`, what does not
        exist is missed when the program gets there; no wall depends on it.
        """
        control = control or RunControl()
        control.begin(limits)
        outcome = self._once(code, finder, limits, expects, control, check)
        if outcome.status is RunStatus.CRASHED and not control.cancelled:  # it may be another program's doing
            outcome = self._once(code, finder, limits, expects, control, check)
        return outcome

    def _once(
        self,
        code: str,
        finder: PartFinder,
        limits: RunLimits,
        expects: AnswerType | None,
        control: RunControl,
        check: bool,
    ) -> RunOutcome:
        started = perf_counter()
        interpreters, checker = self._start()
        memory_bytes = HOST_SHARE * limits.memory_bytes
        run = Run(Guest(finder, control, memory_bytes, "AttributeError" in code), limits, control)
        try:
            _check_text(code, limits)
            if check and (problems := checker.problems(code)):
                raise RunEndedError(RunStatus.REFUSED, "\n".join(problems))
            try:
                run.execute(interpreters, self._before(code), code, expects)
            except MontyCrashedError:
                if run.begun:
                    raise
                run.execute(interpreters, self._before(code), code, expects)  # the worker had died while it was idle
        except RunEndedError as end:
            run.ending = Ending(end.status, end.message)
        except MontyError as error:
            run.ending = ending_of(error, run.guest)
            if control.cancelled:
                run.ending = Ending(RunStatus.CANCELLED, CANCELLED)
        outcome = run.outcome((perf_counter() - started) * 1e3)
        return outcome.model_copy(update={"walls_missing": self.missing}) if self.missing else outcome

    def _before(self, code: str) -> str:
        """What runs ahead of the program: reading what it does not name would take longer than most programs."""
        return f"{self._prelude}\n{self._relations}" if self._names_relations.search(code) else self._prelude

    def _start(self) -> tuple[Interpreters, TypeChecker]:
        with self._lock:
            if self._closed:
                raise RuntimeError("the sandbox is closed")
            if self._confinement is None:
                self._confinement = Confinement.strongest()
                for name in self._confinement.missing:
                    log.warning("wall %s is not up; walls: %s", name, self._walls)
            if self._confinement.missing and self._walls is Walls.REQUIRED:
                raise WallsMissing("no program is run", "the interpreter", self._confinement.missing)
            if self._interpreters is None or self._checker is None:
                self._interpreters = Interpreters(self._workers, self._confinement.binary)
                self._interpreters.start()
                self._checker = TypeChecker(self._workers, self._confinement.binary)
                self._checker.start()
            return self._interpreters, self._checker


def _functions(source: str) -> list[str]:
    return [node.name for node in ast.parse(source).body if isinstance(node, ast.FunctionDef) and node.name[0] != "_"]


def _check_text(code: str, limits: RunLimits) -> None:
    try:
        size = len(code.encode())
    except UnicodeEncodeError:
        raise RunEndedError(RunStatus.REFUSED, "the program is no valid Unicode text") from None
    if size > limits.code_bytes:
        raise RunEndedError(RunStatus.REFUSED, f"the program is longer than {limits.code_bytes:,} bytes")
    if "\0" in code:
        raise RunEndedError(RunStatus.REFUSED, "the program holds a null character")
