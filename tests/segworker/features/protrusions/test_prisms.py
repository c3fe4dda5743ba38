"""Prisms: a hexagon stays one, whatever stands on its ends and however its corners were turned."""

import math

import pytest
from OCP.TopoDS import TopoDS_Shape
from tests.segworker.shapes import (
    box,
    chamfered,
    compound,
    cone,
    cut,
    cylinder,
    edges,
    extruded,
    filleted,
    find,
    fuse,
    turned,
    upright,
)

FLATS = 10.0
HEXAGON = [
    (FLATS / math.sqrt(3) * math.cos(math.radians(60 * i)), FLATS / math.sqrt(3) * math.sin(math.radians(60 * i)))
    for i in range(6)
]


def hexagons(shape: TopoDS_Shape) -> list[tuple[float, float]]:
    """(height, width across flats) of the hexagonal prisms, millimetres."""
    prisms = find(shape).of("prism")
    return [
        (round(1e3 * (one.height or 0.0), 3), round(1e3 * (one.across_flats or 0.0), 3))
        for one in prisms
        if "hexagonal" in one.tags
    ]


@pytest.mark.parametrize("height", [3.0, 30.0])
def test_a_hexagon_is_one_whether_it_is_low_or_high(height: float) -> None:
    assert hexagons(extruded(HEXAGON, 0, height)) == [(height, FLATS)]


def test_a_standoff_with_a_stud_and_a_bore_is_hexagonal_and_no_block() -> None:
    standoff = cut(fuse(extruded(HEXAGON, 0, 30), cylinder(2.5, 8, (0, 0, 30))), cylinder(2.1, 12))
    for shape in (standoff, turned(standoff, (0, 1, 0), 90)):
        assert hexagons(shape) == [(30.0, FLATS)]
        assert len(find(shape).of("prism")) == 1


def test_a_block_with_one_broken_edge_stays_a_block() -> None:
    block = extruded([(0, 0), (50, 0), (50, 15), (45, 20), (0, 20)], 0, 100)
    assert hexagons(block) == []
    assert all("hexagonal" not in one.tags for one in find(block).of("prism"))


def test_a_hexagon_with_turned_corners_is_one_and_no_gear() -> None:
    nut = cut(extruded(HEXAGON, 0, 8), cylinder(2.5, 8))
    corners = cut(nut, cut(cylinder(20, 8), cylinder(5.6, 8)))
    found = find(corners)
    assert hexagons(corners) == [(8.0, FLATS)]
    assert not found.of("gear")


def test_a_shaft_with_two_flats_is_no_prism() -> None:
    shaft = cut(cylinder(10, 40), extruded([(8, -20), (20, -20), (20, 20), (8, 20)], 20, 20))
    shaft = cut(shaft, extruded([(-20, -20), (-8, -20), (-8, 20), (-20, 20)], 20, 20))
    assert not find(shaft).of("prism")


def test_broken_corners_of_a_block_make_no_octagon_across_flats() -> None:
    block = extruded([(0, 0), (50, 0), (50, 20), (0, 20)], 0, 10)
    assert not any(one.across_flats for one in find(chamfered(block, 0.5, *upright(block))).of("prism"))


def test_corners_turned_off_by_a_cone_leave_a_hexagon_as_high_as_it_is() -> None:
    """As of a nut (ISO 4032); a long point, as of a pencil, is none of its height."""
    nut = extruded(HEXAGON, 0, 10)
    turned_off = cut(nut, fuse(cylinder(8, 8.1), cone(8, 4.7, 1.9, (0, 0, 8.1))))
    assert hexagons(cut(nut, turned_off)) == [(10.0, FLATS)]
    pencil = extruded(HEXAGON, 0, 30)
    sharpened = cut(pencil, fuse(cylinder(8, 5), cone(8, 0.5, 25, (0, 0, 5))))
    assert all(height < 20 for height, _ in hexagons(cut(pencil, sharpened)))


@pytest.mark.parametrize("degrees", [0, 49, 91, 105])
def test_two_ends_in_one_plane_close_no_ring_around_the_material(degrees: float) -> None:
    whole = cut(cylinder(65, 30), cylinder(35, 30))
    half = cut(whole, extruded([(-70, -70), (70, -70), (70, 0), (-70, 0)], 0, 30))
    assert not find(turned(half, (1, 2, 3), degrees)).of("prism")
    bar = extruded([(35, 0), (65, 0), (65, 90), (35, 90)], 0, 30)
    assert len(find(turned(bar, (1, 2, 3), degrees)).of("prism")) == 1


def test_a_rounded_plate_that_carries_something_is_one_plate_with_both_its_faces() -> None:
    corners = [(0.0, 0.0), (120.0, 0.0), (60.0, 90.0)]
    outline = extruded(corners, 0, 10)
    rounded = filleted(outline, 12, *upright(outline))
    rims = [edge for edge in edges(rounded) if not any(edge.IsSame(one) for one in upright(rounded))]
    carrier = fuse(filleted(rounded, 2, *rims), cylinder(20, 60, (60, 35, 5)))
    found = find(carrier)
    (plate,) = found.of("prism")
    largest = sorted(found.brep.faces, key=lambda face: -face.area)[:3]
    assert plate.height == pytest.approx(0.01)
    assert {face.id for face in largest if abs(face.axis[2]) > 0.9 and face.kind == "plane"} <= set(plate.faces)
    second = extruded([(x, y + 200) for x, y in corners], 0, 10)
    assert len(find(compound(carrier, second)).of("prism")) == 2


def test_a_block_with_broken_corners_is_a_rectangular_block_and_a_hexagon_stays_one() -> None:
    block = extruded([(0, 0), (60, 0), (60, 30), (0, 30)], 0.0, 40.0)
    (found,) = find(chamfered(block, 2, *upright(block))).of("prism")
    assert found.label == "rectangular block, 60 x 40 mm, height 30 mm"
    bar = extruded(HEXAGON, 0.0, 20.0)
    assert "hexagonal" in find(chamfered(bar, 0.6, *upright(bar))).of("prism")[0].tags
    octagon = [(math.cos(math.radians(22.5 + 45 * i)), math.sin(math.radians(22.5 + 45 * i))) for i in range(8)]
    assert "octagonal" in find(extruded([(20 * x, 20 * y) for x, y in octagon], 0.0, 15.0)).of("prism")[0].tags


def test_a_cam_whose_sides_run_together_is_no_obround_plate() -> None:
    for small, name in ((10.0, "polygonal"), (20.0, "obround")):
        lean = (20.0 - small) / 40.0
        side = [(20 * math.sqrt(1 - lean**2), 20 * lean), (small * math.sqrt(1 - lean**2), 40 + small * lean)]
        sides = extruded([(-x, y) for x, y in reversed(side)] + side, 0.0, 8.0)
        cam = fuse(sides, cylinder(20, 8), cylinder(small, 8, (0, 40, 0)))
        assert [part.tags[0] for part in find(cam).of("prism")] == [name]


def test_the_ends_and_the_flanks_of_a_profile_are_no_sides_of_a_block_and_a_lug_on_a_ring_is_one() -> None:
    arch = cut(cylinder(18, 20, (0, 0, 0), (0, 1, 0)), box((80, 20, 20), (-40, 0, -20)))
    saddle = cut(fuse(box((80, 20, 4), (-40, 0, 0)), arch), cylinder(15, 20, (0, 0, 0), (0, 1, 0)))
    assert [part.thickness for part in find(saddle).of("prism")] == pytest.approx([4e-3, 4e-3])
    lug = fuse(cut(cylinder(30, 40), cylinder(26, 40)), box((10, 7, 10), (-30, -3.5, 40)))
    assert [part.height for part in find(lug).of("prism")] == pytest.approx([10e-3])


def test_a_square_bar_with_broken_edges_lies_along_its_length() -> None:
    bar = extruded([(0, 0), (20, 0), (20, 20), (0, 20)], 0.0, 80.0)
    for shape in (bar, chamfered(bar, 1, *edges(bar))):
        (found,) = find(shape).of("prism")
        assert found.label == "rectangular block, 80 x 20 mm, height 20 mm"
