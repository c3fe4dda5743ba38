"""Known parts come back from pictures of them, where detector and segmenter are perfect."""

from __future__ import annotations

from pathlib import Path

import numpy as np
import pytest
from benchmark.perf.face_recovery import recovery
from tests.segworker.shapes import Found

from querycad_segworker.brep.step import read_step
from querycad_segworker.segcad.ports import VisionOptions
from querycad_segworker.segcad.prune import FaceGraph
from querycad_segworker.visibility.renderer import make_renderer

ROOT = Path(__file__).resolve().parents[3]
SHARED = ROOT.parent / "shared" / "cad-qa-dev"
SMALL = VisionOptions(width=960, height=540)


def mean_iou(file: Path, options: VisionOptions = SMALL) -> float:
    model = Found(read_step(file))
    graph = FaceGraph(np.array(model.brep.face_pairs, dtype=np.int32).reshape(-1, 2))
    found = recovery(make_renderer(model.mesh), graph, len(model.brep.faces), model.parts, options)
    meant = [one.face_iou for one in found.values() if one.is_meant]
    assert meant
    return float(np.mean(meant))


@pytest.mark.parametrize("name", ["bracket", "flange"])
def test_known_parts_of_example_models_come_back(name: str) -> None:
    assert mean_iou(ROOT / "examples" / f"{name}.step") >= 0.95


@pytest.mark.skipif(not SHARED.is_dir(), reason="../shared/cad-qa-dev is not there")
@pytest.mark.parametrize("name", ["00000057", "00000180"])
def test_known_parts_of_the_published_benchmark_come_back(name: str) -> None:
    """In pictures of the published size; `querycad bench perf` measures as many models as it is given."""
    assert mean_iou(SHARED / "abc" / name / "cad.step", VisionOptions()) >= 0.95
