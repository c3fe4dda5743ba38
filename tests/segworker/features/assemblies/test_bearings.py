"""Rolling bearings in assemblies by their shape: with balls, with rollers, or as rings alone."""

from __future__ import annotations

import pytest
from OCP.TopoDS import TopoDS_Shape
from tests.segworker.shapes import ball, box, compound, cone, cut, cylinder, find, shifted, torus, turned

MM = 1e-3
Z = (0.0, 0.0, 1.0)


def ring(inner: float, outer: float, width: float, z: float = 0.0) -> TopoDS_Shape:
    return cut(cylinder(outer, width, (0, 0, z)), cylinder(inner, width, (0, 0, z)))


def around(shape: TopoDS_Shape, count: int) -> list[TopoDS_Shape]:
    return [turned(shape, Z, 360 * i / count) for i in range(count)]


def ball_bearing(z: float = 0.0) -> list[TopoDS_Shape]:
    """20 x 47 x 14, as 6204: raceways, eight balls, a cage."""
    raceway = torus(16.75, 4, (0, 0, z + 7))
    cage = cut(ring(16, 17.5, 12, z + 1), *around(ball(4.2, (16.75, 0, z + 7)), 8))
    balls = around(ball(3.97, (16.75, 0, z + 7)), 8)
    return [cut(ring(10, 14.2, 14, z), raceway), cut(ring(19.3, 23.5, 14, z), raceway), *balls, cage]


def roller_bearing() -> list[TopoDS_Shape]:
    return [ring(10, 13.5, 14), ring(20.5, 23.5, 14), *around(cylinder(3.5, 12, (17, 0, 1)), 10)]


def thrust_bearing() -> list[TopoDS_Shape]:
    return [ring(10, 17.5, 3), *around(ball(3, (13.75, 0, 6)), 12), ring(10, 17.5, 3, 9)]


def tapered_bearing() -> list[TopoDS_Shape]:
    """The outer ring is narrower and stands out at one side."""
    inner = cut(cone(13, 16, 14), cylinder(10, 14))
    outer = cut(cylinder(23.5, 12, (0, 0, -1.5)), cone(19, 22, 12, (0, 0, -1.5)))
    roller = cone(2.4, 2.9, 10, (15.9, 0, 0.5), (0.21, 0, 1))
    return [inner, outer, *around(roller, 12)]


@pytest.mark.parametrize("degrees", [0, 37])
@pytest.mark.parametrize(
    ("bodies", "rolling", "sizes", "tags"),
    [
        (ball_bearing(), 8, (47, 14, 20), {"ball", "radial"}),
        (roller_bearing(), 10, (47, 14, 20), {"roller", "radial"}),
        (thrust_bearing(), 12, (35, 12, 20), {"ball", "axial"}),
        (tapered_bearing(), 12, (47, 15.5, 20), {"roller", "radial"}),
        ([ring(10, 14.2, 14), ring(19.3, 23.5, 14)], None, (47, 14, 20), {"radial"}),
        ([ring(10, 14.2, 14), ring(14.4, 19.1, 10, 2), ring(19.3, 23.5, 14)], None, (47, 14, 20), {"radial"}),
    ],
    ids=["balls", "rollers", "thrust", "tapered", "rings alone", "rings and a filler"],
)
def test_a_bearing_is_told_by_its_shape(
    bodies: list[TopoDS_Shape], rolling: int | None, sizes: tuple[float, ...], tags: set[str], degrees: float
) -> None:
    found = find(turned(compound(*bodies), (1, 2, 3), degrees))
    (bearing,) = found.of("bearing")
    assert bearing.count == rolling
    assert [bearing.diameter, bearing.width, 2 * min(bearing.radii)] == pytest.approx([size * MM for size in sizes])
    assert tags <= set(bearing.tags)
    assert set(bearing.children) == {body.id for body in found.of("body")}
    assert sorted(bearing.faces) == [face.id for face in found.brep.faces]


def test_the_bodies_of_a_bearing_say_what_they_are() -> None:
    bodies = find(compound(*ball_bearing())).of("body")
    roles = [next((t for t in ("inner_ring", "outer_ring", "rolling") if t in body.tags), "") for body in bodies]
    assert roles == ["inner_ring", "outer_ring", *["rolling"] * 8, ""]


def test_two_bearings_on_one_shaft_in_a_housing_are_two() -> None:
    shaft = cylinder(10, 100, (0, 0, -20))
    housing = cut(box((60, 60, 70), (-30, -30, -5)), cylinder(23.5, 80, (0, 0, -10)))
    found = find(compound(housing, shaft, *ball_bearing(0), *ball_bearing(40)))
    bearings = found.of("bearing")
    assert sorted(round(bearing.center[2] / MM, 6) for bearing in bearings) == [7, 47]
    ids = [body.id for body in found.of("body")]
    assert not {ids[0], ids[1]} & {child for bearing in bearings for child in bearing.children}


@pytest.mark.parametrize(
    "bodies",
    [
        [ring(10, 13, 14), ring(13, 23.5, 14)],
        [ring(10, 12, 80), ring(18, 20, 80)],
        [ring(10, 14, 4), ring(20, 24, 4, 30)],
        [ring(10, 14, 4), ring(20, 24, 12, -4)],
        [cylinder(14, 14), ring(20, 24, 14)],
        [cylinder(10, 30), ring(10.2, 24, 14)],
        [ring(10, 12, 14), ring(30, 33, 10, 2), *around(cylinder(2, 8, (25, 0, 3)), 6)],
        [cut(ring(10, 13.5, 14), box((30, 60, 14), (-3, -30, 0))), *roller_bearing()[1:]],
    ],
    ids=[
        "a fit",
        "nested tubes",
        "far apart",
        "unlike widths",
        "a disc in a ring",
        "a ring on a shaft",
        "pins between rings",
        "rollers around a C",
    ],
)
def test_what_merely_lies_on_one_axis_is_no_bearing(bodies: list[TopoDS_Shape]) -> None:
    assert find(compound(*bodies)).of("bearing") == []


@pytest.mark.parametrize("degrees", [0, 37])
def test_the_bore_of_the_inner_ring_takes_the_shaft(degrees: float) -> None:
    shape = turned(compound(*ball_bearing(), shifted(ring(10, 14.2, 14), (100, 0, 0))), (1, 0, 0), degrees)
    taken = [hole for hole in find(shape).of("hole") if "bearing_bore" in hole.tags]
    assert [round(1e3 * (hole.diameter or 0.0), 3) for hole in taken] == [20.0]
