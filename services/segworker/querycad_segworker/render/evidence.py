"""The picture that goes with an answer: its parts marked on the model, under question and answer."""

from __future__ import annotations

import re
from collections.abc import Sequence
from io import BytesIO
from pathlib import Path

from PIL import Image

from querycad_contracts import AnswerRecord, Part, PartKind
from querycad_segworker.mesh import Mesh
from querycad_segworker.model import Artefacts, sheets_of

from .pictures import Mark, annotate, save_png

_DIAMETER = re.compile(r"diameter [\d.]+ mm")


def draw_evidence(artefacts: Artefacts, record: AnswerRecord, path: Path | BytesIO) -> None:
    """Draws what an answer rests on into a PNG file, or memory. Raises OSError when it cannot be written.

    Where vision had a say, the sheets that show what it saw stand below.
    """
    marks = [Mark(told(part), part.faces, part.opening or part.tip) for part in record.parts]
    answer = record.answer.text if record.answer is not None else (record.failure.message if record.failure else "")
    if isinstance(path, Path):
        path.parent.mkdir(parents=True, exist_ok=True)
    picture = annotate(Mesh.load(artefacts.mesh), marks, record.question, answer)
    save_png(stacked([picture, *_sheets(artefacts, sheets_of(record))]), path)


def told(part: Part) -> str:
    """The part's label; of a stepped hole with all its diameters, as a drawing has them. As web/src/told.ts."""
    if part.kind is not PartKind.HOLE or part.diameter is None or "conical" in part.tags:
        return part.label
    found = sorted({part.diameter, *(2 * radius for radius in part.radii)})
    written = list(dict.fromkeys(f"{1e3 * each:.2f}".rstrip("0").rstrip(".") for each in found))
    if len(written) < 2:
        return part.label
    return _DIAMETER.sub(f"diameters {', '.join(written[:-1])} and {written[-1]} mm", part.label, count=1)


def _sheets(artefacts: Artefacts, names: Sequence[str]) -> list[Image.Image]:
    """The sheets that are there: one may have been drawn on another machine."""
    found = []
    for name in names:
        path = artefacts.sight(name)
        if path.is_file():
            with Image.open(path) as sheet:
                found.append(sheet.convert("RGB"))
    return found


def stacked(pictures: Sequence[Image.Image]) -> Image.Image:
    """One below the other, all as wide as the first."""
    width = pictures[0].width
    fitted = [
        each if each.width == width else each.resize((width, each.height * width // each.width)) for each in pictures
    ]
    whole = Image.new("RGB", (width, sum(each.height for each in fitted)), "white")
    top = 0
    for each in fitted:
        whole.paste(each, (0, top))
        top += each.height
    return whole
