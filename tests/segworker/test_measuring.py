"""New measurements: exact, by a kernel process that is started once and whose death is only an error."""

from __future__ import annotations

import math
from pathlib import Path
from typing import Any

import pytest
from OCP.TopoDS import TopoDS_Shape
from tests.segworker.shapes import ball, box, compound, cut, cylinder, plate, write_step

from querycad_segworker.errors import KernelDied
from querycad_segworker.ingest import ingest
from querycad_segworker.local import LocalPartFinder
from querycad_segworker.model import Artefacts, ModelStore


@pytest.fixture(scope="module")
def two_bodies(tmp_path_factory: pytest.TempPathFactory) -> LocalPartFinder:
    """A block of 10 mm, and a lying cylinder whose surface is 7 mm to its right."""
    folder = tmp_path_factory.mktemp("bodies")
    shape = compound(box((10, 10, 10)), cylinder(3, 20, (20, 0, 5), (0, 1, 0)))
    return LocalPartFinder(ingest(write_step(folder / "two.step", shape), ModelStore(folder / "store")))


def test_the_distance_between_two_bodies_is_that_of_their_surfaces(two_bodies: LocalPartFinder) -> None:
    assert two_bodies.distance("body-1", "body-2") == pytest.approx(7e-3, abs=1e-9)
    assert two_bodies.distance("body-2", "body-1") == pytest.approx(7e-3, abs=1e-9)


def test_a_part_is_at_no_distance_from_itself(two_bodies: LocalPartFinder) -> None:
    assert two_bodies.distance("body-1", "body-1") == 0.0


def test_an_unknown_part_is_a_key_error(two_bodies: LocalPartFinder) -> None:
    with pytest.raises(KeyError):
        two_bodies.distance("body-1", "body-99")


def test_a_kernel_that_cannot_start_is_an_error_and_not_a_hang(two_bodies: LocalPartFinder, tmp_path: Path) -> None:
    from querycad_segworker.measuring import Kernel

    kernel = Kernel(Artefacts(tmp_path))
    for _ in range(2):
        with pytest.raises(KernelDied):
            kernel.measure("distance", [0], [1])
    assert two_bodies.distance("body-1", "body-2") == pytest.approx(7e-3, abs=1e-9)


def test_an_extent_is_exact_along_any_direction(two_bodies: LocalPartFinder) -> None:
    half = 0.5**0.5
    assert two_bodies.extent("body-1", (1.0, 0.0, 0.0)) == pytest.approx(0.01, abs=1e-12)
    assert two_bodies.extent("body-1", (half, half, 0.0)) == pytest.approx(0.02 * half, abs=1e-8)
    assert two_bodies.extent("body-2", (half, 0.0, half)) == pytest.approx(0.006, abs=1e-8)
    assert two_bodies.extent("body-2", (0.0, half, half)) == pytest.approx(0.026 * half, abs=1e-8)
    with pytest.raises(KeyError):
        two_bodies.extent("body-99", (1.0, 0.0, 0.0))


HOLLOW = cut(box((10, 10, 10)), ball(4, (5, 5, 5)))
BORED = cut(plate(), cylinder(5, 60, (0, 0, -30)))


@pytest.mark.parametrize(
    ("first", "second", "shared_mm3"),
    [
        (box((10, 10, 10)), box((10, 10, 10), (8, 0, 0)), 200.0),
        (box((10, 10, 10)), box((10, 10, 10), (10, 0, 0)), 0.0),
        (box((10, 10, 10)), box((2, 2, 2), (4, 4, 4)), 8.0),
        (cylinder(5, 10), box((2, 2, 2), (4, 4, 0)), 0.0),
        (HOLLOW, ball(3, (5, 5, 5)), 0.0),
        (HOLLOW, ball(4, (5, 5, 5)), 0.0),
        (HOLLOW, ball(4.5, (5, 5, 5)), 4 / 3 * math.pi * (4.5**3 - 4**3)),
        (BORED, cylinder(5, 40, (0, 0, -30)), 0.0),
        (BORED, cylinder(4.9, 40, (0, 0, -30)), 0.0),
        (BORED, cylinder(5.05, 40, (0, 0, -30)), math.pi * (5.05**2 - 5**2) * 20),
    ],
    ids=["in", "beside", "inside", "boxes only", "in a void", "fills a void", "beyond a void", "fit", "loose", "tight"],
)
def test_bodies_share_the_volume_that_both_take(
    first: TopoDS_Shape, second: TopoDS_Shape, shared_mm3: float, tmp_path: Path
) -> None:
    model = ingest(write_step(tmp_path / "two.step", compound(first, second)), ModelStore(tmp_path / "store"))
    assert LocalPartFinder(model).overlap("body-1", "body-2") * 1e9 == pytest.approx(shared_mm3, rel=1e-6, abs=1e-6)


def test_bodies_far_apart_share_nothing_without_the_kernel(two_bodies: LocalPartFinder, monkeypatch: Any) -> None:
    monkeypatch.setattr(two_bodies, "_kernel", None)
    assert two_bodies.overlap("body-1", "body-2") == 0.0
