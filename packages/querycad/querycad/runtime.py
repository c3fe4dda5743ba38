"""The embedded runtime: every service in this process or its children; no server, no network, no account."""

from __future__ import annotations

import atexit
import time
from collections import OrderedDict
from collections.abc import Callable, Sequence
from functools import cache
from io import BytesIO
from pathlib import Path
from typing import TYPE_CHECKING, Self

from querycad_answering.answering import NO_OPTIONS, answer_question, described
from querycad_answering.drawing.tables import table
from querycad_answering.llm import LlmSettings, LlmWriter
from querycad_answering.parameters import fill_parameters
from querycad_answering.understanding import ModelView, Run
from querycad_contracts import (
    AnswerOptions,
    AnswerRecord,
    AnswerType,
    Description,
    GroundedBy,
    Grounding,
    LengthUnit,
    ModelSummary,
    ParameterSet,
    ParametersRequest,
    Part,
    Program,
    RunOutcome,
    RunStatus,
    Side,
    Table,
    TableKind,
    ViewName,
)
from querycad_sandbox import Sandbox
from querycad_segworker.errors import FileProblem
from querycad_segworker.fusing.vision import networks_in
from querycad_segworker.ingest import ingest
from querycad_segworker.local import LocalPartFinder
from querycad_segworker.model import Artefacts, ModelStore
from querycad_segworker.summary import summary

from .model import Model, UnitName
from .settings import model_store, weights_folder

if TYPE_CHECKING:
    from querycad_segworker.segcad.ports import VisionOptions

MODELS_KEPT = 16
"""Models held in memory: a few hundred kilobytes each."""


class EmbeddedRuntime:
    """Answers questions about files on this machine. Use it as a context manager, or call `close`.

    A language model is asked only where `llm` has an address; the default is what the environment says. `vision` is how
    pictures are looked at where a question asks for that; the default is the published way.
    """

    def __init__(
        self,
        store: Path | None = None,
        sandbox: Sandbox | None = None,
        llm: LlmSettings | None = None,
        vision: VisionOptions | None = None,
    ) -> None:
        self.store = ModelStore(store or model_store())
        self._llm = LlmWriter(llm or LlmSettings.read())
        self._sandbox = sandbox or Sandbox(workers=1)
        self._vision = vision
        self._models: OrderedDict[Path, LocalPartFinder] = OrderedDict()

    def __enter__(self) -> Self:
        return self

    def __exit__(self, *_: object) -> None:
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
        options: AnswerOptions = NO_OPTIONS,
    ) -> AnswerRecord:
        """What is the answer to the question about this STEP file? Raises FileProblem when the file cannot be read."""
        start = time.perf_counter()
        finder = self.model(file, progress)
        return self._asked(finder, question, unit, options, time.perf_counter() - start)

    def open(
        self,
        file: Path | str,
        unit: UnitName = LengthUnit.MM,
        progress: Callable[[str], None] | None = None,
    ) -> Model:
        """The model in this file, read now if its content is not known yet. Raises FileProblem."""
        start = time.perf_counter()
        finder = self.model(file, progress)
        return Model(_Opened(self, finder, Path(file).name, time.perf_counter() - start), unit)

    def _asked(
        self, finder: LocalPartFinder, question: str, unit: LengthUnit, options: AnswerOptions, opening_s: float
    ) -> AnswerRecord:
        model_ms = round(opening_s * 1e3, 3)
        view, run = _view(finder, options.grounding), self._runner(finder, options.grounding)
        told = summary(finder.model) if self._llm.settings.is_configured else None
        place = finder.grounded_by(GroundedBy.EYES)
        record = answer_question(question, run, view, unit, options, summary=told, llm=self._llm, place=place)
        warnings = tuple(dict.fromkeys((*finder.model.warnings, *record.warnings)))
        return record.model_copy(update={"timings_ms": {"model": model_ms, **record.timings_ms}, "warnings": warnings})

    def view(self, file: Path | str) -> ModelView:
        """What the readings of a question are ranked on. Raises FileProblem."""
        return _view(self.model(file))

    def runner(self, file: Path | str) -> Run:
        """What runs programs against this file. Raises FileProblem."""
        return self._runner(self.model(file))

    def _runner(self, finder: LocalPartFinder, grounding: GroundedBy = GroundedBy.GEOMETRY) -> Run:
        found_by = finder.grounded_by(grounding)

        def run(program: Program) -> RunOutcome:
            try:
                return self._sandbox.run(program.code, found_by, expects=program.expects, check=not program.is_checked)
            except FileProblem as problem:  # a measurement that the kernel could not make
                return RunOutcome(status=RunStatus.CRASHED, message=str(problem))

        return run

    def model(self, file: Path | str, progress: Callable[[str], None] | None = None) -> LocalPartFinder:
        """The recognised model of this file, read now if its content is not known yet. Raises FileProblem."""
        artefacts = self.artefacts(file, progress)
        known = self._models.get(artefacts.folder)
        if known is None:
            networks = networks_in(weights_folder(), self._vision)
            known = self._models[artefacts.folder] = LocalPartFinder(artefacts, networks=networks, vision=self._vision)
        self._models.move_to_end(artefacts.folder)
        while len(self._models) > MODELS_KEPT:
            self._models.popitem(last=False)
        return known

    def parameters(self, file: Path | str, asked: ParametersRequest, other: Path | str | None = None) -> ParameterSet:
        """What are these named, typed parameters of the model? Raises FileProblem.

        `other` is the file whose holes and shafts are mated with this one's; `asked.other` is a service's.
        """
        return self._filled(self.model(file), asked, None if other is None else lambda: self.model(other).model.parts)

    def _filled(
        self, finder: LocalPartFinder, asked: ParametersRequest, other: Callable[[], Sequence[Part]] | None
    ) -> ParameterSet:
        view, run = _view(finder, asked.grounding), self._runner(finder, asked.grounding)
        told = summary(finder.model) if self._llm.settings.is_configured else None
        return fill_parameters(asked, view, run, other=other, summary=told, llm=self._llm)

    def summary(self, file: Path | str, progress: Callable[[str], None] | None = None) -> ModelSummary:
        """What does the file hold, in short? Raises FileProblem."""
        return summary(self.model(file, progress).model)

    def artefacts(self, file: Path | str, progress: Callable[[str], None] | None = None) -> Artefacts:
        """What is kept of this file: its mesh, faces and parts. Raises FileProblem."""
        return ingest(Path(file), self.store, progress=progress)


class _Opened:
    """A file that was opened: what it held then, whatever becomes of it."""

    def __init__(self, runtime: EmbeddedRuntime, finder: LocalPartFinder, name: str, opening_s: float) -> None:
        self.id = finder.model.sha256
        self.name = name
        self._runtime = runtime
        self._finder = finder
        self._opening_s = opening_s

    def ask(self, question: str, unit: LengthUnit, options: AnswerOptions) -> tuple[AnswerRecord, Callable[[], bytes]]:
        record = self._runtime._asked(self._finder, question, unit, options, self._opening_s)
        return record, lambda: self._drawn(record)

    def summary(self) -> ModelSummary:
        return summary(self._finder.model)

    def parts(self) -> tuple[Part, ...]:
        return self._finder.model.parts

    def find_parts(self, description: str, sides: Sequence[Side] | None, grounding: GroundedBy) -> Grounding:
        return self._finder.grounded_by(grounding).find_parts(description, sides)

    def describe(self, unit: LengthUnit) -> Description:
        found = described(self._runtime._runner(self._finder), _view(self._finder), unit)
        assert found is not None
        return found

    def table(self, kind: TableKind, grouped: bool | None, unit: LengthUnit) -> Table:
        return table(kind, self.parts(), grouped=grouped, unit=unit)

    def parameters(self, asked: ParametersRequest, other: Callable[[], Sequence[Part]] | None) -> ParameterSet:
        return self._runtime._filled(self._finder, asked, other)

    def run(self, code: str, expects: AnswerType | None) -> RunOutcome:
        return self._runtime._runner(self._finder)(Program(code=code, codegen="", expects=expects))

    def view(self, view: ViewName, width: int, height: int) -> bytes:
        from querycad_segworker.render.plain import draw_view  # here: trimesh and pictures take a moment to load

        return _png(lambda into: draw_view(self._finder.artefacts, view, (width, height), into))

    def _drawn(self, record: AnswerRecord) -> bytes:
        from querycad_segworker.render.evidence import draw_evidence

        return _png(lambda into: draw_evidence(self._finder.artefacts, record, into))


def _png(draw: Callable[[BytesIO], None]) -> bytes:
    into = BytesIO()
    draw(into)
    return into.getvalue()


@cache
def this_machine() -> EmbeddedRuntime:
    """The runtime of this process, which `querycad.open` uses; it ends with the process."""
    runtime = EmbeddedRuntime()
    atexit.register(runtime.close)
    return runtime


def _view(finder: LocalPartFinder, grounding: GroundedBy = GroundedBy.GEOMETRY) -> ModelView:
    return ModelView(
        finder.grounded_by(grounding).ground,
        finder.whole,
        finder.names,
        finder.kinds,
        contents=cache(lambda: (summary(finder.model), finder.model.parts)),
    )
