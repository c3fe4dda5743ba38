"""Do probes tell the parts that are there from those that are not?"""

from __future__ import annotations

from pathlib import Path

import pytest
from benchmark.part_probes import Body, contradictions, main
from tests.segworker.shapes import DOWN, box, cut, cylinder, fuse, plate, write_step

from querycad_contracts import Part
from querycad_segworker.ingest import ingest
from querycad_segworker.mesh import Mesh
from querycad_segworker.model import ModelStore


@pytest.fixture(scope="module")
def probed(tmp_path_factory: pytest.TempPathFactory) -> tuple[tuple[Part, ...], Body, Path]:
    """A plate with a blind and a through hole, a stud and an upright wall."""
    folder = tmp_path_factory.mktemp("probes")
    shape = cut(plate(80, 60, 20), cylinder(5, 12, (-25, 0, 0), DOWN), cylinder(3, 20, (25, 15, 0), DOWN))
    shape = fuse(shape, cylinder(6, 15, (0, 0, 0)), box((4, 60, 40), (36, -30, 0)))
    step = write_step(folder / "probed.step", shape)
    artefacts = ingest(step, ModelStore(folder / "store"))
    return artefacts.load_model().parts, Body(Mesh.load(artefacts.mesh)), step


def test_nothing_speaks_against_parts_that_are_there(probed: tuple[tuple[Part, ...], Body, Path]) -> None:
    parts, body, _ = probed
    assert {"hole", "boss", "wall"} <= {str(part.kind) for part in parts}
    assert [text for part in parts for text in contradictions(part, body)] == []


@pytest.mark.parametrize(
    ("tag", "wrong", "told"),
    [
        ("blind", {"depth": 0.015}, "material on its axis"),
        ("blind", {"depth": 0.009}, "nothing behind its bottom"),
        ("blind", {"radius": 0.007}, "material inside its wall"),
        ("blind", {"radius": 0.004}, "no wall around it"),
        ("blind", {"bottom_thickness": 0.012}, "8 mm of material behind its middle, not 12"),
        ("cylindrical", {"radius": 0.009}, "nothing inside its wall"),
        ("cylindrical", {"radius": 0.003}, "material around it"),
        ("upright", {"thickness": 0.006}, "4 mm across where it lies, not 6 mm"),
    ],
)
def test_what_is_measured_wrong_is_told(
    probed: tuple[tuple[Part, ...], Body, Path], tag: str, wrong: dict[str, float], told: str
) -> None:
    parts, body, _ = probed
    part = next(part for part in parts if tag in part.tags and part.kind in ("hole", "boss", "wall"))
    assert told in contradictions(part.model_copy(update=wrong), body)


def test_the_command_prints_what_it_probed(
    probed: tuple[tuple[Part, ...], Body, Path], tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    assert main([str(probed[2]), "--store", str(tmp_path)]) == 0
    assert "contradicted: 0, models: 1" in capsys.readouterr().out
