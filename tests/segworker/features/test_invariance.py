"""What is found does not hang on place, direction, size, handedness, order or form of storage."""

from __future__ import annotations

from collections.abc import Callable
from pathlib import Path

import pytest
from OCP.TopoDS import TopoDS_Shape
from tests.segworker.shapes import (
    DOWN,
    Found,
    box,
    chamfered,
    cone,
    cut,
    cylinder,
    filleted,
    find,
    fuse,
    mirrored,
    nurbs,
    plate,
    rims,
    scaled,
    shifted,
    shuffled,
    turned,
    upright,
    write_step,
)

from querycad_segworker.brep.step import read_step


def bracket() -> TopoDS_Shape:
    """A plate with rounded corners, a standoff, a stepped shaft below and one hole of each kind."""
    body = plate(90, 60, 20)
    body = filleted(body, 5.0, *upright(body))
    body = fuse(
        body, cylinder(7, 10, (30, 15, 0)), cylinder(9, 12, (-10, 0, -20), DOWN), cylinder(5, 25, (-10, 0, -32), DOWN)
    )
    body = cut(
        body,
        cylinder(3, 22, (30, 15, 10), DOWN),
        cylinder(4, 40, (-30, 15, -30)),
        cylinder(2.5, 40, (30, -15, -30)),
        cylinder(5, 6, (30, -15, 0), DOWN),
        cylinder(3, 40, (-30, -15, -30)),
        cone(6, 0, 6, (-30, -15, 0), DOWN),
        cylinder(3.3, 9, (10, 18, 0), DOWN),
        cone(3.3, 0, 2, (10, 18, -9), DOWN),
        cylinder(2, 15, (0, -30, -10), (0, 1, 0)),
        box((30, 10, 8), (-15, -5, -8)),
    )
    return chamfered(body, 0.5, *rims(body, 4, 0))


Outline = list[tuple[object, ...]]


def outline(found: Found, factor: float = 1.0, digits: int = 5) -> Outline:
    """What was found, in millimetres of the model before it was scaled by `factor`; the order of faces left out."""
    unit = 1e-3 * factor

    def rounded(value: float | None) -> float | None:
        return None if value is None else round(value / unit, digits)

    return sorted(
        (
            part.kind,
            tuple(sorted(set(part.tags) & STABLE)),
            rounded(part.radius),
            rounded(part.depth),
            rounded(part.height),
            tuple(rounded(radius) for radius in part.radii),
            part.bottom or "",
        )
        for part in found.parts
        if part.kind in ("hole", "boss")
    )


STABLE = {
    *("through", "blind", "counterbored", "countersunk", "chamfered", "stepped", "conical", "rounded"),
    *("cylindrical", "slender", "flat", "hollow", "free"),
}


@pytest.fixture(scope="module")
def model() -> TopoDS_Shape:
    return bracket()


@pytest.fixture(scope="module")
def expected(model: TopoDS_Shape) -> Outline:
    return outline(find(model))


def test_the_model_has_what_was_built_into_it(expected: Outline) -> None:
    kinds = [row[0] for row in expected]
    assert kinds.count("hole") == 6
    assert kinds.count("boss") == 3


MOVES: dict[str, Callable[[TopoDS_Shape], TopoDS_Shape]] = {
    "a quarter turn": lambda shape: turned(shape, (1, 0, 0), 90),
    "upside down": lambda shape: turned(shape, (0, 1, 0), 180),
    "an oblique turn": lambda shape: turned(shape, (1, 2, 3), 37),
    "far away": lambda shape: shifted(shape, (3000, -2000, 1000)),
    "mirrored": mirrored,
    "faces in the opposite order": shuffled,
    "all B-splines": nurbs,
    "mirrored, turned, B-splines": lambda shape: nurbs(turned(mirrored(shape), (3, 1, 2), 71)),
}


@pytest.mark.parametrize("move", MOVES.values(), ids=MOVES.keys())
def test_the_same_is_found_after_a_move(
    model: TopoDS_Shape, expected: Outline, move: Callable[[TopoDS_Shape], TopoDS_Shape]
) -> None:
    assert outline(find(move(model))) == expected


@pytest.mark.parametrize("factor", [0.01, 0.1, 10.0, 100.0])
def test_the_same_is_found_at_any_size(model: TopoDS_Shape, expected: Outline, factor: float) -> None:
    assert outline(find(scaled(model, factor)), factor) == expected


def test_the_same_is_found_after_export_and_import(model: TopoDS_Shape, expected: Outline, tmp_path: Path) -> None:
    assert outline(Found(read_step(write_step(tmp_path / "model.step", model)))) == expected


def test_two_runs_give_the_same_parts_with_the_same_ids(model: TopoDS_Shape) -> None:
    assert find(model).parts == find(bracket()).parts
