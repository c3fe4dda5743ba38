"""Blocks with random features: which cutter left a face is known, and the same seed makes the same block."""

from __future__ import annotations

import pytest
from benchmark.random_blocks import block, cutter_of
from benchmark.recognition import main


@pytest.mark.parametrize("seed", range(6))
def test_each_cutter_leaves_faces_and_the_block_keeps_some(seed: int) -> None:
    body, cuts = block(seed, 2)
    owners = [cutter_of(face, cuts) for face in body.faces()]
    assert {0, 1, None} == set(owners)
    again, same = block(seed, 2)
    assert [cut.label for cut in same] == [cut.label for cut in cuts]
    assert again.volume == pytest.approx(body.volume)


def test_recall_and_precision_are_printed(capsys: pytest.CaptureFixture[str]) -> None:
    assert main(["--random", "3"]) == 0
    printed = capsys.readouterr().out
    assert "random blocks: 3 models" in printed
    assert "recall" in printed
