"""`querycad ask`: one or many questions about one file, answered in this process."""

from __future__ import annotations

import argparse
import json
import sys
from collections.abc import Iterator, Sequence
from pathlib import Path
from typing import TYPE_CHECKING, TextIO

from pydantic import ValidationError

from querycad.runtime import EmbeddedRuntime
from querycad_answering.drawing.asked_units import asked_unit
from querycad_answering.drawing.callouts import callout, callouts, with_symbols
from querycad_answering.drawing.describing import listing
from querycad_answering.drawing.numbers import unit_name
from querycad_contracts import AnswerRecord, Codegen, Expectation, Failure, FailureCategory, LengthUnit, Part, Status
from querycad_segworker.errors import FileProblem

from .features import listed
from .llm_arguments import answer_options, llm_settings, not_of_a_service
from .outcomes import EXIT_BAD_INPUT, EXIT_DONE, EXIT_FAILED, complain, complain_of, first_of
from .reading import OpenModel

if TYPE_CHECKING:
    from querycad.model import Reply

_BAD_INPUT = frozenset(FailureCategory) - {
    FailureCategory.PROGRAM, FailureCategory.LIMIT, FailureCategory.CANCELLED, FailureCategory.INTERNAL,
}  # fmt: skip
_STAGES = {
    "read": "reading the STEP file",
    "measure": "measuring faces and edges",
    "tessellate": "making triangles",
    "look": "looking from six sides",
    "recognise": "recognising features",
}


def ask(options: argparse.Namespace) -> int:
    """Answers and prints; returns the exit code: 0 all answered, 2 where input was at fault, else 1."""
    try:
        questions = _questions(options)
    except ValueError as error:
        return complain(str(error))
    if options.server and (refused := not_of_a_service(options)):
        return complain(f"{refused} is for this machine: with --server the service asks its own language model")
    if options.server:
        from .server import on_server  # here: no HTTP client is loaded where nothing is sent

        return on_server(options, lambda open_model: _ask_each(open_model, options, questions))
    try:
        llm = llm_settings(options)
    except ValidationError as error:
        return complain(first_of(error))
    with EmbeddedRuntime(llm=llm) as runtime:
        return _ask_each(lambda progress: runtime.open(options.file, progress=progress), options, questions)


def prompt(options: argparse.Namespace) -> int:
    """Prints what a language model would be sent for a question, at first; returns the exit code."""
    from querycad_answering.llm import LlmSettings, LlmWriter
    from querycad_answering.llm.forms import held_by
    from querycad_answering.llm.prompt import agent_conversation, as_text, conversation, repair, shown
    from querycad_answering.llm.reference import BY_SIGHT
    from querycad_answering.understanding import Understanding

    with EmbeddedRuntime() as runtime:
        try:
            summary, view = runtime.summary(options.file), runtime.view(options.file)
        except FileProblem as problem:
            return complain_of(options.file, problem)
    settings = LlmSettings.read()
    if (options.codegen or settings.default_codegen) == Codegen.AGENT:
        readings = Understanding(options.question, view, Expectation()).readings
        tools = () if settings.eyes() is None else BY_SIGHT if settings.llm_images else BY_SIGHT[:1]
        told = agent_conversation(
            options.question, summary, readings=readings, tools=tools, limits=LlmWriter(settings).limits
        )
        later = shown("WHAT THE PROGRAM SHOWED", settings.llm_steps - 1)
    else:
        told = conversation(options.question, summary, which=settings.llm_examples)
        later = repair("WHAT IS WRONG")
    print(as_text(told), end="")
    print(f"\nAfter a reply that does not settle it:\n\n{as_text((later,))}", end="")
    if held := held_by(settings):
        print(f"\nReplies are held to their form by:\n\n{json.dumps(held, indent=1)}")
    if settings.eyes() is not None:
        from querycad_answering.eyes.mark_voting import asked
        from querycad_contracts import MarkedPicture, PlacedMark

        marks = tuple(PlacedMark(number=number, part="", x=0, y=0) for number in (1, 2, 3))
        picture = MarkedPicture(name="", view="top", marks=marks)
        print(f"\nTo the eyes, for each phrase and each picture:\n\n{as_text(asked('PHRASE', picture, b''))}", end="")
    return EXIT_DONE


def _ask_each(open_model: OpenModel, options: argparse.Namespace, questions: list[str]) -> int:
    try:
        how = answer_options(options)
    except ValidationError as error:
        return complain(first_of(error))
    with _ProgressLine(sys.stderr) as progress:
        try:
            model = open_model(progress.stage)
        except FileProblem as problem:
            progress.clear()
            if options.json:
                print(_unreadable(questions[0], problem).model_dump_json())
            return complain_of(options.file, problem)
    worst = EXIT_DONE
    for number, question in enumerate(questions):
        reply = model.ask(question, unit=LengthUnit(options.unit), options=how)
        worst = max(worst, _exit_code(reply))
        if options.json:
            print(reply.model_dump_json(), flush=True)
        else:
            _print_record(reply, options, model.parts if reply.parts else ())
        if options.picture and reply.answer is not None:
            worst = max(worst, _draw(reply, options, _picture_path(options.picture, number, len(questions))))
    return worst


def _questions(options: argparse.Namespace) -> list[str]:
    if (options.question is None) == (options.questions is None):
        raise ValueError("give either a QUESTION or --questions FILE.txt")
    if options.question is not None:
        return [options.question]
    try:
        lines = Path(options.questions).read_text(encoding="utf-8-sig").splitlines()
    except (OSError, UnicodeDecodeError) as error:
        raise ValueError(f"{options.questions}: {getattr(error, 'strerror', None) or 'not UTF-8 text'}") from error
    questions = [line.strip() for line in lines if line.strip()]
    if not questions:
        raise ValueError(f"{options.questions}: no question in it")
    return questions


def _exit_code(record: AnswerRecord) -> int:
    if record.answer is not None:
        return EXIT_DONE
    category = record.failure.category if record.failure else None
    return EXIT_BAD_INPUT if category in _BAD_INPUT else EXIT_FAILED


def _print_record(record: AnswerRecord, options: argparse.Namespace, known: Sequence[Part]) -> None:
    many = options.questions is not None
    if many:
        print(record.question)
    if record.answer is not None:
        text = with_symbols(record.answer.text) if options.symbols else record.answer.text
        print(f"{'  ' if many else ''}{text}")
        if record.understood_as and record.confidence is not None:
            print(f"  understood as: {record.understood_as} (confidence {record.confidence:.2f})")
        for line in _parts(record, options, known):
            print(line)
    elif record.failure is not None:
        nearest = f" (known here: {', '.join(record.failure.nearest)})" if record.failure.nearest else ""
        status = "not grounded" if record.status is Status.NOT_GROUNDED else record.failure.category.replace("_", " ")
        print(f"querycad: {status}: {record.failure.message}{nearest}", file=sys.stderr)
    for warning in record.warnings if record.answer is not None else ():
        print(f"  note: {warning}")
    if record.agreement is not None:
        print(f"  agreement: {record.agreement.agreeing} of {record.agreement.programs} programs")
    if options.show_code and record.code is not None:
        _print_program(record.codegen, record.code)
        for other in record.alternatives:
            meant = f"; understood as: {other.understood_as}" if other.understood_as else ""
            _print_program(other.codegen, other.code, f", which gives {other.answer.text}{meant}")
    if options.show_code:
        print("  timings: " + ", ".join(f"{step} {ms:.1f} ms" for step, ms in record.timings_ms.items()))


def _parts(record: AnswerRecord, options: argparse.Namespace, known: Sequence[Part]) -> Iterator[str]:
    """The parts that the answer rests on: like ones together, or each where all are asked for."""
    unit = asked_unit(record.question) or LengthUnit(options.unit)
    by_id = {part.id: part for part in (*known, *record.parts)}
    if record.parts:
        yield f"  parts, in {unit_name(unit)}:"
    if options.all:
        for part in record.parts:
            text = callout(part, unit, by_id, symbols=options.symbols)
            yield f"    {part.id}: {text} (faces {listed(part.faces)}; visible from: {_sides(part)})"
        return
    for line in listing(callouts(record.parts, unit, by_id, symbols=options.symbols)):
        yield f"  {line}"


def _sides(part: Part) -> str:
    return ", ".join(part.sides) or "hidden"


def _print_program(codegen: str | None, code: str, remark: str = "") -> None:
    writer = "the parser" if codegen == "parser" else f"a language model ({codegen})"
    print(f"  program, written by {writer}{remark}:")
    print("\n".join(f"    {line}" for line in code.splitlines()))


def _picture_path(given: str, number: int, count: int) -> Path:
    path = Path(given)
    return path if count == 1 else path.with_stem(f"{path.stem}-{number + 1}")


def _draw(reply: Reply, options: argparse.Namespace, path: Path) -> int:
    """Writes the picture; returns the exit code."""
    try:
        reply.picture().save(path)
    except OSError as error:
        return complain(f"{path}: the picture cannot be written: {error.strerror}")
    if not options.json:
        print(f"  picture: {path}")
    return EXIT_DONE


def _unreadable(question: str, problem: FileProblem) -> AnswerRecord:
    failure = Failure(category=FailureCategory.BAD_INPUT, message=str(problem), retryable=problem.retryable)
    return AnswerRecord.failed(question, failure)


class _ProgressLine:
    """One line on a terminal that says what is being done; nothing where standard error is no terminal."""

    def __init__(self, stream: TextIO) -> None:
        self._stream = stream
        self._shown = False

    def __enter__(self) -> _ProgressLine:
        return self

    def __exit__(self, *_: object) -> None:
        self.clear()

    def stage(self, name: str) -> None:
        if self._stream.isatty():
            self._stream.write(f"\r\x1b[K{_STAGES.get(name, name)} …")
            self._stream.flush()
            self._shown = True

    def clear(self) -> None:
        if self._shown:
            self._stream.write("\r\x1b[K")
            self._stream.flush()
        self._shown = False
