"""How does an example look? Its picture, drawn by the project's own renderer."""

from __future__ import annotations

from pathlib import Path
from tempfile import TemporaryDirectory

from querycad_segworker.ingest import ingest
from querycad_segworker.mesh import Mesh
from querycad_segworker.model import ModelStore
from querycad_segworker.render.pictures import annotate, save_png

PIXELS = (900, 640)


def render_example(step: Path, png: Path) -> None:
    """What does the model look like from above its right front corner? Raises FileProblem when it cannot be read."""
    with TemporaryDirectory() as folder:
        mesh = Mesh.load(ingest(step, ModelStore(Path(folder))).mesh)
    save_png(annotate(mesh, (), size=PIXELS), png)
