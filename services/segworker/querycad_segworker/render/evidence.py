"""The picture that goes with an answer: its parts marked on the model, under question and answer."""

from __future__ import annotations

from pathlib import Path

from querycad_contracts import AnswerRecord
from querycad_segworker.mesh import Mesh
from querycad_segworker.model import Artefacts

from .pictures import Mark, annotate, save_png


def draw_evidence(artefacts: Artefacts, record: AnswerRecord, path: Path) -> None:
    """Draws what an answer rests on into a PNG file. Raises OSError when it cannot be written."""
    marks = [Mark(part.label, part.faces, part.opening or part.tip) for part in record.parts]
    answer = record.answer.text if record.answer is not None else (record.failure.message if record.failure else "")
    path.parent.mkdir(parents=True, exist_ok=True)
    save_png(annotate(Mesh.load(artefacts.mesh), marks, record.question, answer), path)
