"""The embedded runtime: every service in this process or its children; no server, no network, no account."""

from __future__ import annotations

import time
from collections import OrderedDict
from collections.abc import Callable
from pathlib import Path
from types import TracebackType
from typing import Self

from querycad_api.answering import answer_question
from querycad_contracts import AnswerRecord, LengthUnit, Program, RunOutcome, RunStatus
from querycad_sandbox import Sandbox
from querycad_segworker.errors import FileProblem
from querycad_segworker.ingest import ingest
from querycad_segworker.model import Artefacts, ModelStore
from querycad_segworker.segcad.local import LocalSegCad

from .settings import model_store

MODELS_KEPT = 16
"""Models held in memory: a few hundred kilobytes each."""


class EmbeddedRuntime:
    """Answers questions about files on this machine. Use it as a context manager, or call `close`."""

    def __init__(self, store: Path | None = None, sandbox: Sandbox | None = None) -> None:
        self.store = ModelStore(store or model_store())
        self._sandbox = sandbox or Sandbox(workers=1)
        self._models: OrderedDict[Path, LocalSegCad] = OrderedDict()

    def __enter__(self) -> Self:
        return self

    def __exit__(
        self, kind: type[BaseException] | None, error: BaseException | None, trace: TracebackType | None
    ) -> None:
        self.close()

    def close(self) -> None:
        """Ends the sandbox's processes."""
        self._sandbox.close()

    def ask(
        self,
        file: Path | str,
        question: str,
        unit: LengthUnit = LengthUnit.MM,
        progress: Callable[[str], None] | None = None,
    ) -> AnswerRecord:
        """What is the answer to the question about this STEP file? Raises FileProblem when the file cannot be read."""
        start = time.perf_counter()
        segcad = self.model(file, progress)
        model_ms = round((time.perf_counter() - start) * 1e3, 3)

        def run(program: Program) -> RunOutcome:
            try:
                return self._sandbox.run(program.code, segcad, expects=program.expects)
            except FileProblem as problem:  # a measurement that the kernel could not make
                return RunOutcome(status=RunStatus.CRASHED, message=str(problem))

        record = answer_question(question, run, unit)
        warnings = tuple(dict.fromkeys((*segcad.model.warnings, *record.warnings)))
        return record.model_copy(update={"timings_ms": {"model": model_ms, **record.timings_ms}, "warnings": warnings})

    def model(self, file: Path | str, progress: Callable[[str], None] | None = None) -> LocalSegCad:
        """The recognised model of this file, read now if its content is not known yet. Raises FileProblem."""
        artefacts = self.artefacts(file, progress)
        known = self._models.get(artefacts.folder)
        if known is None:
            known = self._models[artefacts.folder] = LocalSegCad(artefacts)
        self._models.move_to_end(artefacts.folder)
        while len(self._models) > MODELS_KEPT:
            self._models.popitem(last=False)
        return known

    def artefacts(self, file: Path | str, progress: Callable[[str], None] | None = None) -> Artefacts:
        """What is kept of this file: its mesh, faces and parts. Raises FileProblem."""
        return ingest(Path(file), self.store, progress=progress)

    def draw(self, file: Path | str, record: AnswerRecord, path: Path) -> None:
        """Writes the picture of what an answer rests on. Raises OSError."""
        from querycad_segworker.render.evidence import draw_evidence

        draw_evidence(self.artefacts(file), record, path)
