"""Which parts of the model were meant? One annotated picture an answer."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from io import BytesIO
from pathlib import Path

import numpy as np
from numpy.typing import NDArray
from PIL import Image

from querycad_contracts import Vector
from querycad_segworker.mesh import Mesh
from querycad_segworker.visibility.raycast import Scene

from .palette import part_colors, readable_on, rgb
from .panels import STRIP, Marked, Panel, draw_panel, needs_detail
from .sheet import MUTED, Box, Sheet
from .views import MAX_VIEWS, View, choose_views, marked_faces

LEGEND_ROWS = 12
"""More parts than this are coloured and numbered but not listed: the list would outgrow the picture."""
SMALLEST = (800, 500)
"""Pixels below which caption, legend and model do not fit beside each other."""
_PAD = 20.0


@dataclass(frozen=True, slots=True)
class Mark:
    """One part to point out."""

    label: str
    """What the legend says, such as 'through hole, diameter 5.5 mm'."""
    faces: tuple[int, ...]
    anchor_m: Vector | None = None
    """Where the leader points, such as the centre of an opening; on the visible faces when None or hidden."""


def annotate(
    scene: Scene | Mesh,
    marks: Sequence[Mark],
    question: str = "",
    answer: str = "",
    size: tuple[int, int] = (1600, 1000),
) -> Image.Image:
    """Which parts of the model were meant? An RGB image of `size` pixels (width, height).

    The model is neutral grey, every part has a colour of its own and a numbered balloon, a legend explains the
    numbers, the caption holds question and answer. Parts are seen from where they own the most pixels, in up to four
    panels when one view cannot show all; what is hidden shines through. Without marks: the isometric view. Face ids
    without triangles are passed over. Raises ValueError for a size below 800 x 500.
    """
    if size[0] < SMALLEST[0] or size[1] < SMALLEST[1]:
        raise ValueError(f"{size[0]} x {size[1]} pixels are too few; {SMALLEST[0]} x {SMALLEST[1]} at least")
    ready = scene if isinstance(scene, Scene) else Scene(scene)
    marked = _marked(ready, marks)
    sheet = Sheet(*size)
    top = _caption(sheet, question, answer)
    legend_left = size[0] - (min(360.0, size[0] * 0.3) if marks else _PAD)
    area = (_PAD, top, legend_left - _PAD, size[1] - _PAD / 2)
    panels = _panels(marked, choose_views(ready, marked.part_of, len(marks)), area)
    numbered: set[int] = set()
    for panel, box in zip(panels, _boxes(len(panels), area), strict=True):
        numbered |= {balloon.part for balloon in draw_panel(sheet, marked, panel, box)}
    if marks:
        _legend(sheet, marks, marked.colors, numbered, (legend_left, top + 10))
    return sheet.finish()


def save_png(image: Image.Image, path: Path | BytesIO) -> None:
    """Writes the picture as a PNG file, or into memory; the folder must exist."""
    image.save(path, format="PNG")


def _marked(scene: Scene, marks: Sequence[Mark]) -> Marked:
    mesh = scene.mesh
    ids = [int(mesh.triangle_face.max(initial=-1)), *(face for mark in marks for face in mark.faces)]
    part_of = marked_faces(max(ids) + 1, [mark.faces for mark in marks])
    ghosts = Scene(mesh.of_faces(np.flatnonzero(part_of >= 0)))
    return Marked(scene, ghosts, part_of, part_colors(len(marks)), tuple(mark.anchor_m for mark in marks))


def _panels(marked: Marked, views: Sequence[View], area: Box) -> list[Panel]:
    """A panel for each view; where its parts are too small in it, a second one that enlarges them, if there is room."""
    panels: list[Panel] = []
    for order, (view, box) in enumerate(zip(views, _boxes(len(views), area), strict=True)):
        room = len(panels) + len(views) - order < MAX_VIEWS
        if room and needs_detail(marked, view, int(box[2] - box[0]), int(box[3] - box[1] - STRIP)):
            panels.append(Panel(View(view.viewpoint, ()), framed=view.parts))
            panels.append(Panel(view, focus=view.parts))
        else:
            panels.append(Panel(view))
    return panels


def _boxes(count: int, area: Box) -> list[Box]:
    """Where does each of 1 to 4 panels go? The first, which shows most, is large; the others share the rest.

    The first is on the left, or at the top where the area is higher than wide.
    """
    if count == 1:
        return [area]
    left, top, right, bottom = area
    share = 0.55 if count == 2 else 0.62
    if bottom - top > right - left:
        return [(x0, y0, x1, y1) for y0, x0, y1, x1 in _boxes(count, (top, left, bottom, right))]
    split = left + (right - left) * share
    height = (bottom - top) / (count - 1)
    return [
        (left, top, split - _PAD / 2, bottom),
        *((split + _PAD / 2, top + height * row, right, top + height * (row + 1)) for row in range(count - 1)),
    ]


def _caption(sheet: Sheet, question: str, answer: str) -> float:
    """Writes question and answer at the top; where does the space below begin?"""
    y = _PAD
    for text, size, color, bold in ((question, 19.0, MUTED, False), (answer, 24.0, (20, 24, 30), True)):
        for row in sheet.wrap(text, size, sheet.width - 2 * _PAD, 2):
            sheet.text((_PAD, y), row, size, color, bold=bold)
            y += size * 1.35
        y += 4 if text else 0
    return y


def _legend(
    sheet: Sheet, marks: Sequence[Mark], colors: NDArray[np.uint8], numbered: set[int], at: tuple[float, float]
) -> None:
    """Writes number and label of the first parts, and how many more there are."""
    left, y = at
    text_left, size = left + 46, 16.0
    bottom = sheet.height - _PAD - 2 * size
    listed = 0
    for index, mark in enumerate(marks[:LEGEND_ROWS]):
        rows = sheet.wrap(mark.label, size, sheet.width - text_left - _PAD, 2)
        height = max(38.0, len(rows) * size * 1.3 + 10)
        if y + height > bottom:
            break
        middle = y + height / 2
        sheet.numbered(index + 1, (left + 18, middle), 15.0, rgb(colors[index]), readable_on(colors[index]))
        for line, row in enumerate(rows):
            sheet.text((text_left, middle + (line - (len(rows) - 1) / 2) * size * 1.3), row, size, anchor="lm")
        y += height
        listed += 1
    notes = [f"… and {len(marks) - listed} more"] if listed < len(marks) else []
    unplaced = len(marks) - len(numbered)
    if unplaced:
        notes.append(f"{unplaced} without a number in the picture")
    for note in notes:
        sheet.text((left + 4, y + 14), note, size, MUTED, "lm")
        y += size * 1.5
