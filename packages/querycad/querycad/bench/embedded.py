"""The embedded runtime as a system to be measured."""

from __future__ import annotations

from io import BytesIO
from pathlib import Path
from time import perf_counter

from querycad.runtime import EmbeddedRuntime
from querycad_contracts import AnswerRecord, Status
from querycad_segworker.errors import FileProblem

from .systems import Reply, SystemOptions, UnknownSystem, reply_of

PICTURE_SIZE = (1200, 750)
"""Pixels; small enough that a report of hundreds of questions can still be mailed."""


class EmbeddedSystem:
    """Asks the embedded runtime. Raises UnknownSystem for options that it does not have."""

    def __init__(self, options: SystemOptions) -> None:
        if options.codegen != "parser":
            raise UnknownSystem(f"the embedded runtime has no code generator {options.codegen!r}; it has 'parser'")
        self._options = options
        self._runtime = EmbeddedRuntime(options.store)

    def ask(self, file: Path, question: str) -> Reply:
        """What is the answer? The time does not count reading the model, which happens once for all its questions."""
        try:
            self._runtime.model(file)
            start = perf_counter()
            record = self._runtime.ask(file, question)
            seconds = perf_counter() - start
        except FileProblem as problem:
            return Reply(failure="bad_input", message=str(problem))
        return reply_of(record, seconds, self._picture(file, record) if self._options.pictures else None)

    def close(self) -> None:
        """Ends the sandbox."""
        self._runtime.close()

    def _picture(self, file: Path, record: AnswerRecord) -> bytes | None:
        """The parts that the answer rests on, as PNG; None without an answer or parts."""
        if record.status is not Status.ANSWERED or not record.parts or record.answer is None:
            return None
        from querycad_segworker.mesh import Mesh
        from querycad_segworker.render.pictures import Mark, annotate

        marks = [Mark(part.label, part.faces, part.opening or part.tip) for part in record.parts]
        mesh = Mesh.load(self._runtime.artefacts(file).mesh)
        written = BytesIO()
        picture = annotate(mesh, marks, record.question, record.answer.text, PICTURE_SIZE)
        picture.quantize(128).save(written, format="PNG", optimize=True)
        return written.getvalue()
