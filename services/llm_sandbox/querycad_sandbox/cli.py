"""Runs a program from a file, by the same code as the service: `python -m querycad_sandbox run FILE --model ID`

The model is one that a segworker knows, reached over the broker. `querycad run` does the same with a file of a model on
this machine.
"""

from __future__ import annotations

import argparse
import sys
from collections.abc import Callable, Sequence
from concurrent.futures import ThreadPoolExecutor
from pathlib import Path
from typing import TextIO

from pydantic import TypeAdapter, ValidationError

from querycad_contracts import (
    AnswerType,
    ModelId,
    PartFinder,
    Printed,
    RunEnded,
    RunEvent,
    RunLimits,
    RunOutcome,
    RunStatus,
)

from .arguments import add_run_arguments
from .control import RunControl
from .sandbox import Sandbox

EXIT_OK, EXIT_PROGRAM, EXIT_BAD_INPUT = 0, 1, 2
LOOK_S = 0.1
"""Between two looks at the keyboard."""


def main(arguments: Sequence[str] | None = None) -> int:
    """Runs the command line. Exit code 0: `solution` has a value; 1: the program failed; 2: it could not be run."""
    from .remote import (  # a model at hand needs no queue
        QueueCaller,
        RemotePartFinder,
        SegworkerFailed,
        SegworkerUnavailable,
    )
    from .settings import SandboxSettings

    parser = argparse.ArgumentParser(prog="python -m querycad_sandbox", description=__doc__)
    commands = parser.add_subparsers(dest="command", required=True, metavar="COMMAND")
    run = commands.add_parser("run", help="run a program against a model that a segworker knows")
    add_run_arguments(run)
    run.add_argument("--model", required=True, metavar="ID", help="SHA-256 of the model's file")
    options = parser.parse_args(arguments)
    try:
        model = TypeAdapter(ModelId).validate_python(options.model)
        settings = SandboxSettings.read()
    except ValidationError as error:
        return complain(f"{error.errors()[0]['msg']}: {error.errors()[0]['input']!r}")
    call = QueueCaller(settings.redis_url)
    try:
        return run_program(options, lambda control: RemotePartFinder(model, call, settings, control))
    except (SegworkerUnavailable, SegworkerFailed) as error:
        return complain(str(error))
    finally:
        call.close()


def run_program(
    options: argparse.Namespace, finder: Callable[[RunControl], PartFinder], out: TextIO | None = None
) -> int:
    """Runs the program that the arguments name; Ctrl-C cancels it. Exit code as of `main`.

    Raises what `finder` raises.
    """
    out = out or sys.stdout
    try:
        code = _text(options.program)
        limits = _limits(options)
        expects = AnswerType(options.expects) if options.expects else None
    except ValidationError as error:
        return complain(f"{error.errors()[0]['loc'][0]}: {error.errors()[0]['msg']}")
    except ValueError as error:
        return complain(str(error))

    def hear(event: RunEvent) -> None:
        if options.events:
            out.write(event.model_dump_json() + "\n")
        elif isinstance(event, Printed) and not options.json:
            out.write(event.text)
        out.flush()

    control = RunControl(hear)
    with Sandbox(workers=1) as sandbox, ThreadPoolExecutor(1) as thread:
        run = thread.submit(lambda: sandbox.run(code, finder(control), limits, expects, control))
        while not run.done():
            try:
                run.exception(LOOK_S)
            except TimeoutError:
                continue
            except KeyboardInterrupt:
                control.cancel()
        outcome = run.result()
    if options.events:
        hear(RunEnded(outcome=outcome))
    else:
        _show(outcome, out, as_json=options.json)
    return EXIT_OK if outcome.status is RunStatus.OK else EXIT_PROGRAM


def complain(problem: str) -> int:
    """Says in one line why nothing was run."""
    sys.stderr.write(f"querycad: {problem}\n")
    return EXIT_BAD_INPUT


def _text(program: str) -> str:
    """The program's text. Raises ValueError when it cannot be read."""
    try:
        return sys.stdin.read() if program == "-" else Path(program).read_text(encoding="utf-8-sig")
    except (OSError, UnicodeError) as error:
        raise ValueError(f"{program}: {getattr(error, 'strerror', None) or 'not UTF-8 text'}") from error


def _limits(options: argparse.Namespace) -> RunLimits:
    given = {"duration_s": options.seconds, "memory_bytes": options.memory and options.memory << 20}
    return RunLimits.model_validate({name: value for name, value in given.items() if value is not None})


def _show(outcome: RunOutcome, out: TextIO, *, as_json: bool) -> None:
    if as_json:
        out.write(outcome.model_dump_json() + "\n")
    elif outcome.status is RunStatus.OK:
        out.write(f"{outcome.value}\n")
        if outcome.message:
            sys.stderr.write(f"querycad: {outcome.message}\n")
    else:
        sys.stderr.write(f"querycad: {outcome.status.value}: {outcome.message}\n")
