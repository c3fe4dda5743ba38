"""Questions about meshes are answered as about CAD models, and said to be approximate."""

from __future__ import annotations

import io
from collections.abc import Iterator

import pytest
from PIL import Image
from tests.segworker.mesh_files import triangles, write_stl
from tests.segworker.shapes import cut, cylinder, plate

from querycad import EmbeddedRuntime, Model


@pytest.fixture(scope="module")
def model(tmp_path_factory: pytest.TempPathFactory) -> Iterator[Model]:
    folder = tmp_path_factory.mktemp("mesh")
    drills = [cylinder(3.25, 30, (x, y, -25)) for x in (-20, 20) for y in (-12, 12)]
    file = write_stl(folder / "plate.stl", triangles(cut(plate(), *drills), 0.1))
    with EmbeddedRuntime(folder / "models") as runtime:
        yield runtime.open(file)


def test_holes_of_a_mesh_are_counted_and_measured(model: Model) -> None:
    count = model.ask("How many holes are there?")
    assert count.value == 4
    diameter = model.ask("What is the diameter of the holes?")
    values = diameter.value if isinstance(diameter.value, tuple | list) else [diameter.value]
    assert list(values) == pytest.approx([0.0065] * len(values), abs=1e-6)
    for answer in (count, diameter):
        assert any("approximate" in each for each in answer.warnings)
        assert any("no unit" in each for each in answer.warnings)


def test_a_mesh_is_described_and_drawn(model: Model) -> None:
    assert "approximate" in model.describe().text
    assert "60 x 40 x 20 mm" in model.describe().text
    picture = model.picture("top", width=300, height=200)
    assert Image.open(io.BytesIO(bytes(picture))).size == (300, 200)
