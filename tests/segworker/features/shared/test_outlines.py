"""What is an outline called? By the sides of its hull: small notches and broken corners are no sides."""

from __future__ import annotations

import pytest
from OCP.TopoDS import TopoDS_Shape
from tests.segworker.shapes import box, cut, extruded, find, plate

from querycad_segworker.features.shared.frames import POLYGONS

RECTANGLE = [(0.0, 0.0), (100.0, 0.0), (100.0, 60.0), (0.0, 60.0)]
BROKEN = [(4.0, 0.0), (96.0, 0.0), (100.0, 4.0), (100.0, 56.0), (96.0, 60.0), (4.0, 60.0), (0.0, 56.0), (0.0, 4.0)]
NOTCHED = [(0.0, 0.0), (40.0, 0.0), (40.0, 8.0), (60.0, 8.0), (60.0, 0.0), (100.0, 0.0), (100.0, 60.0), (0.0, 60.0)]
NOTCHED_CORNER = [(0.0, 0.0), (90.0, 0.0), (90.0, 10.0), (100.0, 10.0), (100.0, 60.0), (0.0, 60.0)]
ANGLE = [(0.0, 0.0), (100.0, 0.0), (100.0, 20.0), (20.0, 20.0), (20.0, 60.0), (0.0, 60.0)]
HEXAGON = [(30.0, 0.0), (70.0, 0.0), (90.0, 34.64), (70.0, 69.28), (30.0, 69.28), (10.0, 34.64)]
OCTAGON = [(30.0, 0.0), (70.0, 0.0), (98.3, 28.3), (98.3, 68.3), (70.0, 96.6), (30.0, 96.6), (1.7, 68.3), (1.7, 28.3)]
TWO_CUT = [(0.0, 0.0), (80.0, 0.0), (100.0, 20.0), (100.0, 60.0), (20.0, 60.0), (0.0, 40.0)]


def names_of(shape: TopoDS_Shape) -> set[str]:
    (body,) = (part for part in find(shape).parts if part.kind == "body")
    return set(body.tags) & {*POLYGONS.values(), "polygonal", "obround", "free", "arched"}


@pytest.mark.parametrize(
    ("points", "name"),
    [
        (RECTANGLE, "rectangular"),
        (BROKEN, "rectangular"),
        (NOTCHED, "rectangular"),
        (NOTCHED_CORNER, "rectangular"),
        (ANGLE, "polygonal"),
        (HEXAGON, "hexagonal"),
        (OCTAGON, "octagonal"),
        (TWO_CUT, "hexagonal"),
    ],
)
@pytest.mark.parametrize("backwards", [False, True])
def test_outline_of_a_plate(points: list[tuple[float, float]], name: str, backwards: bool) -> None:
    shape = extruded(points[::-1] if backwards else points, 0.0, 8.0)
    assert names_of(shape) == {name}


def test_rounded_corners_and_round_notches_leave_the_name() -> None:
    hexagon = extruded(HEXAGON, 0.0, 8.0)
    assert names_of(cut(hexagon, box((4, 10, 20), (48, -5, -5)))) == {"hexagonal"}
    assert names_of(cut(plate(100, 60, 8), box((4, 10, 20), (48, -5, -5)), box((4, 10, 20), (20, 55, -5)))) == {
        "rectangular"
    }
