"""The embedded runtime as a system to be measured."""

from __future__ import annotations

from io import BytesIO
from pathlib import Path
from time import perf_counter
from typing import TYPE_CHECKING

from querycad.runtime import EmbeddedRuntime
from querycad.settings import weights_folder
from querycad_answering.llm import LlmSettings
from querycad_contracts import AnswerOptions, AnswerRecord, Codegen, GroundedBy, LlmOptions
from querycad_segworker.errors import FileProblem

from .systems import Reply, SystemOptions, UnknownSystem, reply_of

if TYPE_CHECKING:
    from querycad_segworker.segcad.ports import VisionOptions

PICTURE_SIZE = (1200, 750)
"""Pixels; small enough that a report of hundreds of questions can still be mailed."""


class EmbeddedSystem:
    """Asks the embedded runtime. Raises UnknownSystem for options that it does not have."""

    def __init__(self, options: SystemOptions) -> None:
        names = [codegen.value for codegen in Codegen]
        if options.codegen not in names:
            raise UnknownSystem(f"there is no code generator {options.codegen!r}; there are: {', '.join(names)}")
        llm = LlmSettings.read().model_copy(update={"llm_examples": options.prompt_examples})
        if options.codegen != Codegen.PARSER and not llm.is_configured:
            raise UnknownSystem("no language model is set up: QUERYCAD_LLM_BASE_URL says where one is")
        self._options = options
        chosen = LlmOptions(samples=options.llm_samples, repairs=options.llm_repairs)
        self._how = AnswerOptions(codegen=Codegen(options.codegen), llm=chosen, grounding=options.grounding)
        vision = None if options.grounding is GroundedBy.GEOMETRY else _vision(options)
        self._runtime = EmbeddedRuntime(options.store, llm=llm, vision=vision)

    def ask(self, file: Path, question: str) -> Reply:
        """What is the answer? The time does not count reading the model, which happens once for all its questions."""
        try:
            self._runtime.model(file)
            start = perf_counter()
            record = self._runtime.ask(file, question, options=self._how)
            seconds = perf_counter() - start
        except FileProblem as problem:
            return Reply(failure="bad_input", message=str(problem))
        return reply_of(record, seconds, self._picture(file, record) if self._options.pictures else None)

    def close(self) -> None:
        """Ends the sandbox."""
        self._runtime.close()

    def _picture(self, file: Path, record: AnswerRecord) -> bytes | None:
        """The parts that the answer rests on, as PNG; None without an answer or parts."""
        if record.answer is None or not record.parts:
            return None
        from querycad_segworker.mesh import Mesh
        from querycad_segworker.render.pictures import Mark, annotate

        marks = [Mark(part.label, part.faces, part.opening or part.tip) for part in record.parts]
        mesh = Mesh.load(self._runtime.artefacts(file).mesh)
        written = BytesIO()
        picture = annotate(mesh, marks, record.question, record.answer.text, PICTURE_SIZE)
        picture.quantize(128).save(written, format="PNG", optimize=True)
        return written.getvalue()


def _vision(options: SystemOptions) -> VisionOptions:
    """How pictures are looked at. Raises UnknownSystem where the networks cannot.

    An answer would then be geometry's alone, or none, and its score would say nothing of vision.
    """
    from querycad_segworker.segcad.engines.sessions import UnknownLayout
    from querycad_segworker.segcad.engines.weights import load_models
    from querycad_segworker.segcad.ports import VisionOptions, WeightsAbsent

    try:
        load_models(weights_folder(), options.box_threshold)
    except (WeightsAbsent, UnknownLayout) as unusable:
        raise UnknownSystem(str(unusable)) from unusable
    return VisionOptions(views=options.views, box_threshold=options.box_threshold)
