"""The networks' time is measured apart, each beside the same work done one by one."""

from __future__ import annotations

import shutil
from pathlib import Path

import pytest
from benchmark.perf.networks import NetworkOptions, network_measurements
from benchmark.scoring.embedded import EmbeddedSystem
from benchmark.scoring.items import BadBenchmark
from benchmark.scoring.systems import SystemOptions
from PIL import Image

from querycad_contracts import GroundedBy

TINY = Path(__file__).parents[2] / "segworker/segcad/engines/recorded.tar.xz"
FLANGE = Path(__file__).parents[3] / "examples/flange.step"


@pytest.fixture
def weights(tmp_path: Path) -> Path:
    shutil.unpack_archive(TINY, tmp_path, filter="data")
    shutil.copy(tmp_path / "vocab.txt", tmp_path / "detector-transformers")
    for name in ("detector-transformers", "sam2"):
        shutil.move(tmp_path / name, tmp_path / "weights" / name)
    return tmp_path / "weights"


def test_detector_and_segmenter_are_told_apart(weights: Path) -> None:
    found = list(network_measurements(NetworkOptions(weights, views=2, boxes=3, repeat=1)))
    names = [one.name.strip().split(",")[0] for one in found]
    assert names == ["detector", "segmenter", "each further box of a view"]
    assert all(one.baseline > 0 and one.unit == "s" for one in found)


def test_without_weights_there_is_nothing_to_measure(tmp_path: Path) -> None:
    with pytest.raises(BadBenchmark, match="no weights of a detector and of a segmenter"):
        next(network_measurements(NetworkOptions(tmp_path)))


def test_views_and_threshold_of_a_run_reach_the_networks(
    weights: Path, tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setenv("QUERYCAD_HOME", str(weights.parent))
    options = SystemOptions(grounding=GroundedBy.VISION, views=8, box_threshold=0.99, store=tmp_path / "models")
    system = EmbeddedSystem(options)
    try:
        reply = system.ask(FLANGE, "How many holes are there?")
    finally:
        system.close()
    assert not reply.parts, "no box of these networks is that sure"
    assert "cannot look" not in reply.message
    (sheet,) = (tmp_path / "models").rglob("sight/*.png")
    with Image.open(sheet) as picture:
        assert picture.height > 8 * 252, "a row for each of eight views"
