"""Turned parts: steps, flanges and collars of a contour, and what the whole body is called."""

from __future__ import annotations

import math

import pytest
from OCP.TopoDS import TopoDS_Shape
from tests.segworker.shapes import (
    DOWN,
    ball,
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
    plate,
    rims,
    torus,
    turned,
)

from querycad_contracts import Part

MM = 1e-3


def near(*values: float) -> object:
    """Millimetres."""
    return pytest.approx([value * MM for value in values], abs=1e-8)


def body(shape: TopoDS_Shape) -> Part:
    (part,) = find(shape).of("body")
    return part


def shaft() -> TopoDS_Shape:
    """Along z: 20 long at 12, 30 long at 20 with a collar of 30, 25 long at 15 with a groove."""
    steps = fuse(
        cylinder(6, 20), cylinder(10, 30, (0, 0, 20)), cylinder(15, 4, (0, 0, 30)), cylinder(7.5, 25, (0, 0, 50))
    )
    return cut(steps, cut(cylinder(10, 1.5, (0, 0, 70)), cylinder(6.5, 1.5, (0, 0, 70))))


def test_each_step_of_a_shaft_has_its_diameter_and_its_length_along_the_axis() -> None:
    steps = [boss for boss in find(shaft()).of("boss") if "collar" not in boss.tags]
    rows = sorted((round((s.diameter or 0) / MM, 6), round((s.length or 0) / MM, 6)) for s in steps)
    assert rows == [(12, 20), (15, 25), (20, 10), (20, 16)]


def test_a_ring_around_a_shaft_is_a_collar_and_the_grooved_step_one_step() -> None:
    found = find(shaft())
    (collar,) = [boss for boss in found.of("boss") if "collar" in boss.tags]
    assert [collar.diameter, collar.height] == near(30, 4)
    (groove,) = found.of("groove")
    assert [groove.width, groove.diameter] == near(1.5, 13)


@pytest.mark.parametrize("axis", [(1, 0, 0), (1, 2, 3)])
def test_a_whole_stepped_shaft_is_a_shaft_with_its_total_length(axis: tuple[float, float, float]) -> None:
    whole = body(turned(shaft(), axis, 50))
    assert {"shaft", "slender", "cylindrical"} <= set(whole.tags)
    assert not {"tube", "rod", "disc"} & set(whole.tags)
    assert [whole.length, whole.diameter] == pytest.approx([75 * MM, 20 * MM])  # a collar is not the shaft
    assert sorted(whole.radii) == pytest.approx([6 * MM, 7.5 * MM, 10 * MM, 15 * MM])


@pytest.mark.parametrize(
    ("shape", "tag", "thickness"),
    [
        (cylinder(4, 60), "rod", None),
        (cut(cylinder(10, 60), cylinder(8, 60)), "tube", 2),
        (cut(cylinder(10, 2), cylinder(5.25, 2)), "washer", 2),
        (cut(cylinder(20, 15), cylinder(14, 15)), "ring", 15),
        (cylinder(30, 5), "disc", 5),
        (ball(7), "ball", None),
    ],
    ids=["rod", "tube", "washer", "ring", "disc", "ball"],
)
def test_a_single_body_is_called_by_its_shape(shape: TopoDS_Shape, tag: str, thickness: float | None) -> None:
    whole = body(shape)
    others = {"rod", "tube", "washer", "disc", "ball", "nut", "screw"} - {tag}
    assert tag in whole.tags
    assert not others & set(whole.tags)
    assert whole.thickness == (None if thickness is None else pytest.approx(thickness * MM))


def test_a_tube_with_flanges_has_two_flanges_and_one_tube_between_them() -> None:
    spool = cut(fuse(cylinder(40, 10), cylinder(20, 120), cylinder(40, 10, (0, 0, 110))), cylinder(17, 120))
    spool = cut(spool, *(cylinder(3, 160, (x, 0, -10)) for x in (-30, 30)))
    found = find(spool)
    flanges = [boss for boss in found.of("boss") if "flange" in boss.tags]
    (tube,) = [boss for boss in found.of("boss") if "tube" in boss.tags]
    assert [flange.thickness for flange in flanges] == near(10, 10)
    assert [tube.height, tube.thickness, *tube.radii] == near(100, 3, 20, 17)
    assert "tube" in found.of("body")[0].tags


def test_a_shaft_with_two_flats_is_still_a_shaft_of_its_diameter() -> None:
    flats = [box((30, 10, 15), (-15, y, 30)) for y in (7, -17)]
    (shaft_part,) = find(cut(cylinder(8, 60), *flats)).of("boss")
    assert [shaft_part.diameter, shaft_part.height] == near(16, 60)


def test_a_disc_that_slots_cut_into_sectors_is_one_boss() -> None:
    slots = [turned(box((30, 4, 6), (0, -2, 6)), (0, 0, 1), degrees) for degrees in (0, 90, 180, 270)]
    found = find(cut(fuse(cylinder(30, 6), cylinder(20, 8, (0, 0, 6))), *slots))
    assert sorted(round((boss.diameter or 0) / MM, 6) for boss in found.of("boss")) == [40, 60]


def test_the_rounded_corners_of_a_square_plate_are_no_cylinder() -> None:
    square = box((30, 30, 5), (-15, -15, 0))
    from OCP.BRepAlgoAPI import BRepAlgoAPI_Common

    rounded = BRepAlgoAPI_Common(square, cylinder(19, 5)).Shape()
    assert find(rounded).of("boss") == []


def test_what_stands_on_a_plate_is_raised_and_the_plate_is_not() -> None:
    discs = sorted(find(fuse(cylinder(30, 6), cylinder(12, 5, (0, 0, 6)))).of("boss"), key=lambda b: b.radius or 0)
    assert ["raised" in disc.tags for disc in discs] == [True, False]


def test_the_chamfer_at_the_end_of_a_shaft_is_a_part_with_its_length_along_the_axis() -> None:
    rod = cylinder(8, 60)
    found = find(chamfered(rod, 1.5, *rims(rod, 8, 60)))
    (boss,) = found.of("boss")
    (chamfer,) = found.of("chamfer")
    assert chamfer.id in boss.children
    assert [chamfer.depth, chamfer.diameter] == near(1.5, 16)
    assert boss.height == pytest.approx(60 * MM)


def test_a_domed_pin_reaches_to_the_top_of_its_dome() -> None:
    found = find(fuse(plate(), cylinder(3, 12), ball(3, (0, 0, 12))))
    (pin,) = found.of("boss")
    assert [pin.height, *(pin.tip or ())] == near(15, 0, 0, 15)
    (dome,) = found.of("sphere")
    assert {"outer", "dome"} <= set(dome.tags)
    assert dome.radius == pytest.approx(3 * MM)


def test_a_shallow_spherical_seat_or_crown_is_a_sphere_and_a_rounded_corner_is_none() -> None:
    seat = cut(cylinder(12, 20), ball(15, (0, 0, 30)))
    washer = cut(common_ball(20.0), cylinder(5, 60, (0, 0, -30)))
    for shape, radius, side, height in ((seat, 15.0, "inner", 30), (washer, 20.0, "outer", 0)):
        (found,) = find(shape).of("sphere")
        assert side in found.tags
        assert found.center == near(0, 0, height)  # of the ball, not of what is there of it
        assert found.radius == pytest.approx(radius * MM)
    block = box((30, 30, 30))
    assert find(filleted(block, 4, *edges(block))).of("sphere") == []


def common_ball(radius: float) -> TopoDS_Shape:
    """A disc, 20 wide and 3 high at its rim, whose upper side is a part of a ball."""
    whole = cut(cylinder(10, 60, (0, 0, -30)), cut(cylinder(30, 80, (0, 0, -40)), ball(radius)))
    return cut(whole, box((60, 60, 60), (-30, -30, -46)))


def test_cones_inner_and_outer_are_parts_with_both_radii() -> None:
    found = find(cut(fuse(plate(), cone(10, 5, 12)), cone(4, 2, 20, (0, 0, -20))))
    rows = {part.tags[0]: tuple(round(r / MM, 6) for r in part.radii) for part in found.of("cone")}
    assert rows == {"outer": (10, 5), "inner": (4, 2)}


def test_a_torus_is_a_part_with_its_two_radii() -> None:
    from OCP.BRepPrimAPI import BRepPrimAPI_MakeTorus

    (ring,) = find(BRepPrimAPI_MakeTorus(20, 4).Shape()).of("torus")
    assert list(ring.radii) == near(20, 4)
    assert ring.diameter == pytest.approx(48 * MM)


def hexagon(flats: float) -> list[tuple[float, float]]:
    import math

    corner = flats / 2 / math.cos(math.pi / 6)
    return [(corner * math.cos(i * math.pi / 3), corner * math.sin(i * math.pi / 3)) for i in range(6)]


def hexagon_screw() -> TopoDS_Shape:
    """M10 x 40: width across flats 16, head 6.4."""
    return fuse(extruded(hexagon(16), 0, 6.4), cylinder(5, 40, (0, 0, 0), DOWN))


def socket_screw() -> TopoDS_Shape:
    """M6 x 20 with a hexagon socket."""
    return cut(fuse(cylinder(5, 6), cylinder(3, 20, (0, 0, 0), DOWN)), extruded(hexagon(5), 3, 10))


@pytest.mark.parametrize(
    ("shape", "form"), [(hexagon_screw(), "hexagonal"), (socket_screw(), "cylindrical")], ids=["hexagon", "socket"]
)
@pytest.mark.parametrize("degrees", [0, 40])
def test_a_head_on_a_shank_is_a_screw(shape: TopoDS_Shape, form: str, degrees: float) -> None:
    found = find(turned(shape, (1, 2, 3), degrees))
    (screw,) = found.of("body")
    assert {"screw", form} <= set(screw.tags)
    assert sum("head" in part.tags for part in found.parts) == 1
    (shank,) = [part for part in found.parts if "shank" in part.tags]
    assert shank.kind == "boss"


def test_a_screw_is_as_long_as_its_standard_says_and_goes_in_from_its_head() -> None:
    """Under the head (ISO 4014, ISO 4762); a countersunk one with its head (ISO 7046)."""
    countersunk = fuse(cone(3, 6, 3), cylinder(3, 17, (0, 0, 0), DOWN))
    lengths = {
        "hexagon": (hexagon_screw(), 40, 46.4),
        "socket": (socket_screw(), 20, 26),
        "sunk": (countersunk, 20, 20),
    }
    for shape, nominal, overall in lengths.values():
        screw = body(shape)
        assert [screw.nominal_length, screw.length] == near(nominal, overall)
        assert screw.approach[0] == pytest.approx((0, 0, -1))
    assert body(cylinder(3, 20)).nominal_length is None


def test_a_pin_goes_in_as_its_hole_is_reached() -> None:
    block = box((40, 40, 30))
    blind, through = cylinder(4, 20, (20, 20, 10)), cylinder(4, 30, (20, 20, 0))
    pin = cylinder(4, 40, (20, 20, 10))

    def ways(shape: TopoDS_Shape) -> list[tuple[float, ...]]:
        (found,) = [part for part in find(shape).of("body") if part.tips]
        return [tuple(round(c) for c in way) for way in found.approach]

    assert ways(compound(cut(block, blind), pin)) == [(0, 0, -1)]
    assert sorted(ways(compound(cut(block, through), pin))) == [(0, 0, -1), (0, 0, 1)]
    assert ways(compound(block, cylinder(4, 40, (100, 20, 10)))) == []  # in no hole
    assert ways(compound(cut(block, cylinder(8, 20, (20, 20, 10))), pin)) == []  # in one that is twice as wide


def test_a_hexagon_with_a_bore_is_a_nut() -> None:
    nut = body(cut(extruded(hexagon(16), 0, 8.4), cylinder(5, 8.4)))
    assert "nut" in nut.tags


@pytest.mark.parametrize(
    "shape",
    [
        fuse(cylinder(40, 8), cylinder(8, 60, (0, 0, 8))),
        fuse(cylinder(12, 8), cylinder(8, 60, (0, 0, 8)), cylinder(12, 8, (0, 0, 68))),
        cut(extruded(hexagon(60), 0, 8), cylinder(5, 8)),
        fuse(plate(), cylinder(3, 20), cylinder(5, 4, (0, 0, 20))),
    ],
    ids=["shaft on a plate", "spool", "hexagonal plate with a hole", "knob on a plate"],
)
def test_what_only_looks_like_a_fastener_is_none(shape: TopoDS_Shape) -> None:
    assert not {"screw", "nut"} & set(body(shape).tags)


def test_legs_on_foot_plates_are_the_long_blocks() -> None:
    table = box((200, 120, 10), (-100, -60, 90))
    for x in (-80, 80):
        for y in (-40, 40):
            table = fuse(table, box((12, 12, 82), (x - 6, y - 6, 8)), box((30, 30, 8), (x - 15, y - 15, 0)))
    legs = [part for part in find(table).parts if "leg" in part.tags]
    assert len(legs) == 4
    assert [(leg.extents[0], leg.height) for leg in legs] == [pytest.approx((12 * MM, 82 * MM))] * 4


def test_what_is_as_high_as_the_part_itself_is_no_foot() -> None:
    link = fuse(box((40, 12, 6), (-20, -6, 0)), cylinder(10, 6, (-20, 0, 0)), cylinder(10, 6, (20, 0, 0)))
    assert not [part for part in find(link).parts if {"foot", "leg"} & set(part.tags)]


def test_screws_that_reach_the_ground_are_no_feet() -> None:
    block = box((60, 60, 10), (-30, -30, 0))
    screws = []
    for x in (-20, 20):
        screws.append(fuse(cylinder(5, 6, (x, 0, 10)), cylinder(3, 20, (x, 0, 10), DOWN)))
        block = cut(block, cylinder(3, 30, (x, 0, -10)))
    parts = find(compound(block, *screws)).parts
    assert sum("screw" in part.tags for part in parts) == 2
    assert not [part for part in parts if {"foot", "leg"} & set(part.tags)]


@pytest.mark.parametrize("degrees", [0, 35])
def test_a_collar_between_a_neck_and_a_hexagon_is_a_collar_and_the_undercut_below_is_none(degrees: float) -> None:
    hexagon = extruded([(15 * math.cos(a * math.pi / 3), 15 * math.sin(a * math.pi / 3)) for a in range(6)], 14, 11)
    fitting = fuse(cylinder(10.5, 11), cylinder(9, 3, (0, 0, 11)), hexagon)
    fitting = fuse(fitting, cylinder(17, 3, (0, 0, 25)), cylinder(8, 20, (0, 0, 28)))
    found = find(turned(cut(fitting, cylinder(5, 48)), (1, 2, 3), degrees))
    (collar,) = (boss for boss in found.of("boss") if "collar" in boss.tags)
    assert collar.diameter == pytest.approx(34e-3)
    (neck,) = (boss for boss in found.of("boss") if boss.radius == pytest.approx(9e-3))
    assert "undercut" in neck.tags
    assert "raised" not in neck.tags


def test_the_short_end_of_a_tube_beyond_its_collar_is_no_ring() -> None:
    post = fuse(cylinder(30, 200), cylinder(40, 20, (0, 0, 150)), plate(160, 160, 12))
    found = find(cut(post, cylinder(27, 200)))
    flat = [boss for boss in found.of("boss") if "flat" in boss.tags]
    assert [boss.diameter for boss in flat] == pytest.approx([80e-3])
    assert "collar" in flat[0].tags


def test_two_flanges_of_a_spool_are_flat_though_one_is_thick() -> None:
    spool = fuse(cylinder(30, 10), cylinder(15, 60, (0, 0, 10)), cylinder(30, 32, (0, 0, 70)))
    low, *_ = (boss for boss in find(spool).of("boss") if boss.height == pytest.approx(10e-3))
    assert "flat" in low.tags


def test_a_void_is_a_cavity_and_no_groove() -> None:
    hollow = find(cut(torus(25, 5), torus(25, 3)))
    assert len(hollow.of("cavity")) == 1
    assert not hollow.of("groove")
    (groove,) = find(cut(cylinder(25, 40), torus(25, 3, (0, 0, 20)))).of("groove")
    assert groove.depth == pytest.approx(3e-3)


def test_collars_of_a_lying_shaft_are_no_feet_and_standoffs_below_a_plate_are() -> None:
    along = (1.0, 0.0, 0.0)
    collars = [cylinder(18, 8, (x, 0, 0), along) for x in (40, 120)]
    shaft = find(fuse(cylinder(10, 200, along=along), *collars))
    assert not [part for part in shaft.parts if "foot" in part.tags]
    stand = find(fuse(plate(100, 80, 8), *(cylinder(5, 20, (x, y, -28)) for x in (-40, 40) for y in (-30, 30))))
    assert [part.kind for part in stand.parts if "foot" in part.tags] == 4 * ["boss"]


def flange_nut(radius: float) -> TopoDS_Shape:
    """M10 of ISO 4161 in its proportions: a cone of 25 degrees runs from the rim of the flange into the hexagon."""
    drop = (radius - 7) * math.tan(math.radians(25))
    return cut(
        fuse(cylinder(radius, 2), cone(radius, 7, drop, (0, 0, 2)), extruded(hexagon(16), 0, 11)), cylinder(4.25, 11)
    )


@pytest.mark.parametrize("degrees", [0, 40])
def test_a_cone_that_a_hexagon_cuts_off_ends_at_it_and_the_body_is_a_nut(degrees: float) -> None:
    found = find(turned(flange_nut(11), (1, 2, 3), degrees))
    (flange,) = found.of("boss")
    assert flange.height == pytest.approx((2 + 3 * math.tan(math.radians(25))) * MM)
    assert {"nut", "hexagonal"} <= set(found.of("body")[0].tags)
    assert "nut" not in body(flange_nut(14)).tags


def test_a_nicked_drill_point_goes_on_to_its_apex() -> None:
    plain = cut(box((30, 30, 30), (-15, -15, -30)), cylinder(4, 10, (0, 0, -10)), cone(4, 0, 2.4, (0, 0, -10), DOWN))
    for shape in (plain, cut(plain, cylinder(0.6, 40, (2.5, 0, -35))), cut(plain, box((20, 1.5, 1), (0, -0.75, -11)))):
        assert [point.height for point in find(shape).of("cone")] == near(2.4)


def test_a_shaft_that_goes_on_beyond_a_collar_is_no_screw_and_a_head_with_a_button_is_one() -> None:
    below = fuse(cylinder(10, 60, (0, 0, 0), DOWN), cylinder(16, 10))
    assert "screw" in body(fuse(below, cylinder(14, 3, (0, 0, 10)))).tags
    arbor = fuse(cylinder(10, 60, (0, 0, 0), DOWN), cylinder(16, 6), cylinder(6, 14, (0, 0, 6)))
    assert "screw" not in body(arbor).tags
