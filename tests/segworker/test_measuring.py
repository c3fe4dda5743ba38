"""New measurements: exact, by a kernel process that is started once and whose death is only an error."""

from __future__ import annotations

from pathlib import Path

import pytest
from tests.segworker.shapes import box, compound, cylinder, write_step

from querycad_segworker.errors import KernelDied
from querycad_segworker.ingest import ingest
from querycad_segworker.local import LocalSegCad
from querycad_segworker.model import ModelStore


@pytest.fixture(scope="module")
def two_bodies(tmp_path_factory: pytest.TempPathFactory) -> LocalSegCad:
    """A block of 10 mm, and a lying cylinder whose surface is 7 mm to its right."""
    folder = tmp_path_factory.mktemp("bodies")
    shape = compound(box((10, 10, 10)), cylinder(3, 20, (20, 0, 5), (0, 1, 0)))
    return LocalSegCad(ingest(write_step(folder / "two.step", shape), ModelStore(folder / "store")))


def test_the_distance_between_two_bodies_is_that_of_their_surfaces(two_bodies: LocalSegCad) -> None:
    assert two_bodies.distance("body-1", "body-2") == pytest.approx(7e-3, abs=1e-9)
    assert two_bodies.distance("body-2", "body-1") == pytest.approx(7e-3, abs=1e-9)


def test_a_part_is_at_no_distance_from_itself(two_bodies: LocalSegCad) -> None:
    assert two_bodies.distance("body-1", "body-1") == 0.0


def test_an_unknown_part_is_a_key_error(two_bodies: LocalSegCad) -> None:
    with pytest.raises(KeyError):
        two_bodies.distance("body-1", "body-99")


def test_a_kernel_that_cannot_start_is_an_error_and_not_a_hang(two_bodies: LocalSegCad, tmp_path: Path) -> None:
    from querycad_segworker.measuring import Kernel

    kernel = Kernel(tmp_path / "missing.bin")
    for _ in range(2):
        with pytest.raises(KernelDied):
            kernel.measure("distance", [0], [1])
    assert two_bodies.distance("body-1", "body-2") == pytest.approx(7e-3, abs=1e-9)


def test_an_extent_is_exact_along_any_direction(two_bodies: LocalSegCad) -> None:
    half = 0.5**0.5
    assert two_bodies.extent("body-1", (1.0, 0.0, 0.0)) == pytest.approx(0.01, abs=1e-12)
    assert two_bodies.extent("body-1", (half, half, 0.0)) == pytest.approx(0.02 * half, abs=1e-8)
    assert two_bodies.extent("body-2", (half, 0.0, half)) == pytest.approx(0.006, abs=1e-8)
    assert two_bodies.extent("body-2", (0.0, half, half)) == pytest.approx(0.026 * half, abs=1e-8)
    with pytest.raises(KeyError):
        two_bodies.extent("body-99", (1.0, 0.0, 0.0))
