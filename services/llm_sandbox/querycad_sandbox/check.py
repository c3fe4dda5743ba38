"""Does a program use only what exists? The interpreter's type checker, kept warm, asked without running anything."""

from __future__ import annotations

import ast
import re
import secrets
from dataclasses import dataclass
from importlib.resources import files
from queue import Empty, LifoQueue
from threading import BoundedSemaphore
from typing import Final

from pydantic_monty import Monty, MontyCrashedError, MontyError, MontySession, MontySyntaxError, MontyTypingError

from querycad_contracts.guest_names import meant_attribute, meant_function, meant_kind
from querycad_contracts.guest_reference import guest_api, guest_api_text, syntax_of

SCRIPT: Final = "program.py"
CHECK_TIMEOUT_S: Final = 3.0
"""A check takes about 1 ms, the first of a process 50 ms; what takes this long was written to."""
CHECK_MEMORY_BYTES: Final = 256 * 2**20
CHECKS_PER_SESSION: Final = 500
"""The checker keeps what it learnt of each program; a new session forgets it."""
MESSAGE_CHARS: Final = 300
SHOWN: Final = 10
"""Diagnostics told of one program: more help neither a reader nor a repair."""

REFUSED_RULES: Final = frozenset(
    {
        "call-non-callable",
        "invalid-syntax",
        "missing-argument",
        "not-iterable",
        "not-subscriptable",
        "parameter-already-assigned",
        "too-many-positional-arguments",
        "unknown-argument",
        "unresolved-attribute",
        "unresolved-import",
        "unresolved-reference",
        "unsupported-operator",
    }
)
"""The checker's rules that say: this fails whatever the values are. The rest is left to the run: a wrong annotation
harms nothing, and the guest API checks its own arguments and says more clearly what it wanted."""

MODULES: Final = ("math", "re", "itertools", "functools", "collections")
"""Those that programs are told of: all that they need to compute with, of what the interpreter has."""
_FUNCTIONS: Final = frozenset(function.name for function in guest_api().functions)
_NO_ATTRIBUTE: Final = re.compile(r"Object of type `(\w+)` has no attribute `(\w+)`")
_NO_NAME: Final = re.compile(r"Name `(\w+)` used when not defined")
_NO_MODULE: Final = re.compile(r"Cannot resolve imported module")
_DIAGNOSTIC: Final = re.compile(rf"^{re.escape(SCRIPT)}:(\d+):\d+: (\w+)\[([\w-]+)\] (.*)$")
_UNCERTAIN: Final = re.compile(r"`None`| \| | in union |Literal\[[^]]*,")
"""A value that may be None, or one of several types, may well be the right one when the program gets there."""


def checker_stubs() -> str:
    """What a program may refer to: the guest API, and the builtins that the checker does not know of."""
    return guest_api_text() + "\n" + files(__package__).joinpath("extra_builtins.pyi").read_text(encoding="utf-8")


@dataclass(slots=True)
class _Session:
    monty: MontySession
    checks: int = 0


class TypeChecker:
    """Checks programs one after the other in sessions that have read the stubs already; thread safe.

    Nothing is run and nothing is kept from program to program: each is sent behind a line that names an undefined
    variable, so that the check always fails, and the interpreter neither runs nor remembers what fails its check.
    A program is good when that line is all that is wrong.
    """

    def __init__(self, workers: int, binary: str | None = None) -> None:
        self._pool = Monty(binary_path=binary, min_processes=1, max_processes=workers, request_timeout=CHECK_TIMEOUT_S)
        self._stubs = checker_stubs()
        self._gate = f"_{secrets.token_hex(8)}"
        self._idle: LifoQueue[_Session] = LifoQueue()
        self._free = BoundedSemaphore(workers)

    def start(self) -> None:
        """Starts the first worker process."""
        self._pool.__enter__()

    def close(self) -> None:
        """Ends the worker processes."""
        while True:
            try:
                self._idle.get_nowait().monty.__exit__(None, None, None)
            except Empty:
                break
        self._pool.__exit__(None, None, None)

    def problems(self, code: str) -> tuple[str, ...]:
        """What in `code` cannot work, a line each; empty when nothing is known to be wrong."""
        with self._free:
            try:
                return self._ask(code)
            except MontyCrashedError as error:
                if error.timed_out:
                    return (f"the program could not be checked in {CHECK_TIMEOUT_S:g} s",)
            return self._ask(code)  # a worker that died while it was idle is missed only now

    def _ask(self, code: str) -> tuple[str, ...]:
        session, healthy = self._take(), False
        try:
            session.monty.feed_run(f"{self._gate}\n{_apart(code)}", print_callback=_discard)
        except MontyTypingError as error:
            healthy = True
            return self._read(error.display())
        except MontySyntaxError as error:
            healthy = True
            return (f"invalid syntax: {error}",)
        except MontyCrashedError:
            raise
        except MontyError as error:
            return (f"the program could not be checked: {error}",)
        finally:
            self._put_back(session, healthy)
        return ("the program could not be checked",)

    def _take(self) -> _Session:
        try:
            return self._idle.get_nowait()
        except Empty:
            session = self._pool.checkout(
                script_name=SCRIPT,
                type_check=True,
                type_check_stubs=self._stubs,
                type_check_format="concise",
                limits={"max_memory": CHECK_MEMORY_BYTES},
            )
            session.__enter__()
            return _Session(session)

    def _put_back(self, session: _Session, healthy: bool) -> None:
        session.checks += 1
        if healthy and session.checks < CHECKS_PER_SESSION:
            self._idle.put(session)
        else:
            session.monty.__exit__(None, None, None)

    def _read(self, diagnostics: str) -> tuple[str, ...]:
        if self._gate not in diagnostics.partition("\n")[0]:
            return ("the program could not be checked",)
        problems = []
        for line in diagnostics.splitlines()[1:]:
            match = _DIAGNOSTIC.match(line)
            if match is None:
                continue
            row, severity, rule, message = match.groups()
            message = message[:MESSAGE_CHARS]
            if severity == "error" and rule in REFUSED_RULES and not _UNCERTAIN.search(message):
                problems.append(f"line {int(row) - 1}: {message}{_meant(message)}")
        return tuple(problems[:SHOWN])


def _meant(message: str) -> str:
    """What to write instead of a name that does not exist? As ', perhaps `color` is meant'; else empty."""
    if _NO_MODULE.match(message):
        return f"; there are {', '.join(MODULES)}"
    if unknown := _NO_NAME.match(message):
        near = meant_function(unknown[1])
    elif missing := _NO_ATTRIBUTE.match(message):
        near = meant_attribute(missing[1], missing[2])
        kind = meant_kind(missing[2])
        if not near and kind is not None and missing[1] in ("Shape", "Body", "Part"):
            return f": parts(kind={kind.value!r}) gives those of the model"
    else:
        return ""
    return f", perhaps `{near}` is meant" if near else ""


def _apart(code: str) -> str:
    """The program with its variables that are called like functions of the guest API renamed: `parts = find_parts(…)`.

    The checker takes such a name for the function ever after. What is called is still the function.
    """
    if (tree := syntax_of(code)) is None:
        return code
    names = [node for node in ast.walk(tree) if isinstance(node, ast.Name)]
    own = {node.id for node in names if isinstance(node.ctx, ast.Store)} & _FUNCTIONS
    if not own or "\r" in code:
        return code
    called = {id(node.func) for node in ast.walk(tree) if isinstance(node, ast.Call)}
    places = [(node.lineno, node.col_offset, node.id) for node in names if id(node) not in called]
    places += [(node.lineno, node.col_offset, node.arg) for node in ast.walk(tree) if isinstance(node, ast.arg)]
    lines = [line.encode() for line in code.split("\n")]
    for line, column, name in sorted(set(places), reverse=True):
        if name in own:
            text, end = lines[line - 1], column + len(name)
            lines[line - 1] = text[:end] + b"_" + text[end:]
    return b"\n".join(lines).decode()


def _discard(stream: str, text: str) -> None:
    """Nothing is printed by a program that is not run."""
