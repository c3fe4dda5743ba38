"""A graph runs on what the machine has, and says what it does not know."""

from __future__ import annotations

import shutil
from pathlib import Path

import numpy as np
import onnxruntime
import pytest

from querycad_segworker.segcad.engines.sessions import PREFERRED_PROVIDERS, Graph, UnknownLayout


@pytest.fixture(scope="module")
def encoder(tmp_path_factory: pytest.TempPathFactory) -> Graph:
    folder = tmp_path_factory.mktemp("graph")
    shutil.unpack_archive(Path(__file__).with_name("recorded.tar.xz"), folder, filter="data")
    return Graph(folder / "sam-points/encoder.onnx", threads=1)


def test_cuda_goes_before_the_processor_where_there_is_one(encoder: Graph) -> None:
    available = onnxruntime.get_available_providers()
    assert encoder.providers == tuple(name for name in PREFERRED_PROVIDERS if name in available)
    assert encoder.providers[-1] == "CPUExecutionProvider"


def test_a_graph_says_what_it_takes(encoder: Graph) -> None:
    assert encoder.inputs["pixel_values"].shape == (None, 3, 128, 128)
    assert set(encoder.outputs) == {"image_embeddings", "image_positional_embeddings"}


def test_inputs_are_cast_to_what_the_graph_declares(encoder: Graph) -> None:
    (found,) = encoder.run({"pixel_values": np.zeros((1, 3, 128, 128), dtype=np.float64)}, ["image_embeddings"])
    assert found.dtype == np.float32


def test_an_input_or_output_that_is_not_known_is_named(encoder: Graph) -> None:
    with pytest.raises(UnknownLayout, match=r"encoder\.onnx .*: pixel_values, masks"):
        encoder.run({"image": np.zeros(1)}, ["masks"])


def test_an_input_that_does_not_fit_is_told_in_one_line(encoder: Graph) -> None:
    with pytest.raises(UnknownLayout, match=r"encoder\.onnx cannot be run: .+") as raised:
        encoder.run({"pixel_values": np.zeros((1, 3, 64, 64))}, ["image_embeddings"])
    assert "\n" not in str(raised.value)
