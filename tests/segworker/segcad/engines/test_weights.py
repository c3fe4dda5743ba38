"""Weights are found, checked, and loaded once a process; their absence is a state that says what to do."""

from __future__ import annotations

import shutil
import subprocess
import sys
from pathlib import Path

import numpy as np
import pytest

from querycad_segworker.segcad.engines.weights import (
    HUB,
    Check,
    Role,
    WeightFile,
    absence,
    check,
    default_models,
    known_models,
    load_models,
    present,
    record_sum,
    recorded_sums,
    sha256_of,
)
from querycad_segworker.segcad.ports import WeightsAbsent

RECORDED = Path(__file__).with_name("recorded.tar.xz")
FORKED = """
import os, sys
import numpy as np
from pathlib import Path
from querycad_segworker.segcad.engines.weights import load_models

image = np.full((48, 80, 3), 90, dtype=np.uint8)
boxes = np.array([[10, 10, 50, 40]], dtype=np.float32)

def look():
    return load_models(Path(sys.argv[1])).segmenter.segment(image, boxes).scores[0]

before = look()
child = os.fork()
if child == 0:
    os._exit(0 if look() == before else 3)
print(os.waitstatus_to_exitcode(os.waitpid(child, 0)[1]))
"""


@pytest.fixture(scope="module")
def weights(tmp_path_factory: pytest.TempPathFactory) -> Path:
    """A weights folder with tiny networks, one of each kind."""
    folder = tmp_path_factory.mktemp("weights")
    shutil.unpack_archive(RECORDED, folder / "all", filter="data")
    shutil.move(folder / "all/detector-transformers", folder / "weights/tiny-dino")
    shutil.copy(folder / "all/vocab.txt", folder / "weights/tiny-dino")
    shutil.move(folder / "all/sam-exporter-raw", folder / "weights/tiny-sam")
    return folder / "weights"


def test_the_list_has_a_detector_and_a_segmenter_of_every_layout() -> None:
    assert [model.role for model in default_models()] == list(Role)
    for model in known_models():
        assert {file.name for file in model.files} >= set(model.role.files)
        assert len(model.revision) == 40, "an address must not change what it leads to"
        assert all(model.url(file).startswith(f"{HUB}/{model.repository}/resolve/") for file in model.files)
    assert sum(model.role is Role.SEGMENTER for model in known_models()) == 3


def test_a_mirror_has_the_hub_s_paths() -> None:
    model = known_models()[0]
    address = model.url(model.files[0], "http://mirror.example/hub/")
    assert address == f"http://mirror.example/hub/{model.repository}/resolve/{model.revision}/onnx/model.onnx"


def test_absence_is_one_sentence_that_says_what_to_do(tmp_path: Path) -> None:
    with pytest.raises(WeightsAbsent) as raised:
        load_models(tmp_path)
    assert str(raised.value) == absence(tmp_path)
    assert "no weights of a detector and of a segmenter" in str(raised.value)
    assert "`querycad models pull`" in str(raised.value)


def test_half_of_the_weights_is_said_to_be_half(weights: Path, tmp_path: Path) -> None:
    shutil.copytree(weights / "tiny-sam", tmp_path / "tiny-sam")
    assert str(absence(tmp_path)).startswith("no weights of a detector in")


def test_a_model_of_the_list_counts_only_when_it_is_whole(tmp_path: Path) -> None:
    (sam,) = (model for model in known_models() if model.name == "sam2.1-hiera-tiny")
    (tmp_path / sam.name).mkdir()
    for file in sam.files[:-1]:
        (tmp_path / sam.name / file.name).touch()
    assert list(present(tmp_path, Role.SEGMENTER)) == []
    (tmp_path / sam.name / sam.files[-1].name).touch()
    assert list(present(tmp_path, Role.SEGMENTER)) == [tmp_path / sam.name]


def test_weights_of_one_s_own_go_first(weights: Path, tmp_path: Path) -> None:
    shutil.copytree(weights, tmp_path / "weights")
    for name in ("encoder.onnx", "decoder.onnx"):
        (tmp_path / "weights/mobile-sam").mkdir(exist_ok=True)
        (tmp_path / "weights/mobile-sam" / name).touch()
    assert [folder.name for folder in present(tmp_path / "weights", Role.SEGMENTER)] == ["tiny-sam", "mobile-sam"]


def test_the_models_are_loaded_once_and_look(weights: Path) -> None:
    image = np.full((48, 80, 3), 90, dtype=np.uint8)
    image[10:40, 10:50] = (200, 60, 40)
    models = load_models(weights, box_threshold=0.0)
    found = models.detector.detect(image, "hole")
    assert [one.score for one in found] == sorted((one.score for one in found), reverse=True)
    assert len(found) == 16  # all that the tiny network asks about
    boxes = np.array([one.box for one in found], dtype=np.float32)
    assert (boxes[:, 2:] > boxes[:, :2]).all()
    assert models.segmenter.segment(image, boxes).masks.shape == (16, 48, 80)
    strict = load_models(weights, box_threshold=0.9)
    assert len(strict.detector.detect(image, "hole")) < 16
    assert strict.segmenter is not models.segmenter  # light; the sessions inside are the same
    assert vars(strict.segmenter)["_layout"]._encoder is vars(models.segmenter)["_layout"]._encoder


def test_spoilt_weights_are_said_to_be_spoilt(weights: Path, tmp_path: Path) -> None:
    shutil.copytree(weights, tmp_path / "weights")
    (tmp_path / "weights/tiny-sam/decoder.onnx").write_bytes(b"no network")
    with pytest.raises(WeightsAbsent, match=r"decoder\.onnx cannot be loaded: .*`querycad models verify`"):
        load_models(tmp_path / "weights")


def test_a_fork_makes_sessions_of_its_own(weights: Path) -> None:
    command = [sys.executable, "-W", "ignore", "-c", FORKED, str(weights)]
    done = subprocess.run(command, capture_output=True, text=True, timeout=120, check=True)
    assert done.stdout.strip() == "0"


def test_a_sum_is_compared_with_the_list_or_with_the_first_pull(tmp_path: Path) -> None:
    (tmp_path / "a.onnx").write_bytes(b"abc")
    digest = sha256_of(tmp_path / "a.onnx")
    assert digest == "ba7816bf8f01cfea414140de5dae2223b00361a396177a9cb410ff61f20015ad"  # FIPS 180-4
    file = WeightFile(name="a.onnx", path="a.onnx", size_mb=0)
    assert check(tmp_path, file) is Check.UNKNOWN
    record_sum(tmp_path, "b.onnx", "0" * 64)
    record_sum(tmp_path, "a.onnx", digest)
    assert recorded_sums(tmp_path) == {"a.onnx": digest, "b.onnx": "0" * 64}
    assert check(tmp_path, file) is Check.AS_PULLED
    assert check(tmp_path, file.model_copy(update={"sha256": digest})) is Check.GOOD
    assert check(tmp_path, file.model_copy(update={"sha256": "1" * 64})) is Check.WRONG
    assert check(tmp_path, file.model_copy(update={"name": "c.onnx"})) is Check.ABSENT
