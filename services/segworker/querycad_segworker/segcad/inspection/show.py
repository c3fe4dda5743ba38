"""Looks at a model and draws how: what the `segment` command writes, and what goes with an answer."""

from __future__ import annotations

from collections.abc import Callable
from pathlib import Path

import numpy as np
from PIL import Image

from querycad_segworker.mesh import Mesh
from querycad_segworker.model import Artefacts
from querycad_segworker.segcad.pipeline import Looked, Seen, find
from querycad_segworker.segcad.ports import VisionModels, VisionOptions
from querycad_segworker.segcad.prune import FaceGraph
from querycad_segworker.visibility.renderer import make_renderer

from .stage_pictures import STAGES, ViewPictures, contact_sheet, draw_view, reduced

SHEET = "sheet.png"


def look_and_draw(
    artefacts: Artefacts,
    face_count: int,
    phrase: str,
    models: VisionModels,
    sheet: Path,
    options: VisionOptions | None = None,
    on_view: Callable[[ViewPictures], None] | None = None,
) -> Seen:
    """What does `phrase` mean by sight? The sheet of all stages goes to the file `sheet`.

    `on_view` is given the pictures of every view, as large as the view; without it they are not drawn so large.
    """
    renderer = make_renderer(Mesh.load(artefacts.mesh))
    graph = FaceGraph(np.load(artefacts.face_pairs))
    rows: list[ViewPictures] = []

    def watch(looked: Looked) -> None:
        if on_view is not None:
            on_view(draw_view(looked, renderer))
        rows.append(draw_view(reduced(looked), renderer))

    seen = find(renderer, graph, face_count, phrase, models, options, watch)
    sheet.parent.mkdir(parents=True, exist_ok=True)
    title = f"'{phrase}': {len(seen.finds)} part{'' if len(seen.finds) == 1 else 's'} seen"
    contact_sheet(title, rows).save(sheet, format="PNG")
    return seen


def save_views(folder: Path) -> Callable[[ViewPictures], None]:
    """Writes every picture of every view into the folder, as `<view>-<number>-<stage>.png`."""
    folder.mkdir(parents=True, exist_ok=True)

    def save(pictures: ViewPictures) -> None:
        name = pictures.view.replace(" ", "-")
        for number, (stage, picture) in enumerate(zip(STAGES, pictures.of_stages(), strict=True), start=1):
            Image.fromarray(picture).save(folder / f"{name}-{number}-{stage}.png", format="PNG")

    return save
