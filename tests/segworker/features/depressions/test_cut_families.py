"""Every family of cut that an engineer names is found in a model it was cut into, with the measures it was cut with."""

from __future__ import annotations

import math

import pytest
from OCP.BRepAdaptor import BRepAdaptor_Curve
from OCP.TopoDS import TopoDS_Shape
from tests.segworker.shapes import (
    ball,
    box,
    chamfered,
    cone,
    cut,
    cylinder,
    edges,
    filleted,
    find,
    fuse,
    nurbs,
    plate,
    prism,
    shifted,
    torus,
    turned,
    upright,
)

from querycad_contracts import Part

MM = 1e-3


def near(*values: float) -> object:
    """Millimetres."""
    return pytest.approx([value * MM for value in values], abs=1e-7)


def only(found: list[Part]) -> Part:
    (part,) = found
    return part


def sizes(part: Part) -> list[float | None]:
    return [part.length, part.width, part.depth]


def obround(length: float, radius: float, height: float) -> TopoDS_Shape:
    """Between the centres of its ends `length` along x, from z = 0 upwards."""
    ends = (cylinder(radius, height, (x, 0, 0)) for x in (-length / 2, length / 2))
    return fuse(box((length, 2 * radius, height), (-length / 2, -radius, 0)), *ends)


def shaft() -> TopoDS_Shape:
    return cylinder(10, 60)


def test_an_obround_pocket_is_one_pocket_without_fillets() -> None:
    found = find(cut(plate(), shifted(obround(20, 3, 5), (0, 0, -5))))
    pocket = only(found.of("pocket"))
    assert "obround" in pocket.tags
    assert sizes(pocket) == near(26, 6, 5)
    assert pocket.volume == pytest.approx((120 + 9 * math.pi) * 5 * MM**3)
    assert not found.of("fillet")


def test_a_t_slot_has_its_neck_as_width_and_reaches_down_to_its_foot() -> None:
    slot = only(find(cut(plate(), box((100, 8, 6), (-50, -4, -6)), box((100, 14, 5), (-50, -7, -11)))).of("slot"))
    assert "t_slot" in slot.tags
    assert sizes(slot) == near(60, 8, 11)
    assert len(slot.faces) == 7


def test_a_t_slot_that_ends_inside_is_one_slot() -> None:
    found = find(cut(plate(), box((60, 8, 6), (-10, -4, -6)), box((60, 14, 5), (-10, -7, -11))))
    assert "t_slot" in only(found.of("slot")).tags
    assert not found.of("pocket")


def test_a_dovetail_slot_has_the_width_of_its_mouth_and_the_angle_of_its_flanks() -> None:
    lean = 6 / math.tan(math.radians(60))
    section = [(-50, -6, 0), (-50, 6, 0), (-50, 6 + lean, -6), (-50, -6 - lean, -6)]
    slot = only(find(cut(plate(), prism(section, (100, 0, 0)))).of("slot"))
    assert "dovetail" in slot.tags
    assert sizes(slot) == near(60, 12, 6)
    assert slot.angle == pytest.approx(math.radians(60))


@pytest.mark.parametrize("start", [-50, -10], ids=["through", "ending inside"])
def test_a_v_groove_is_a_slot_and_no_step(start: float) -> None:
    found = find(cut(plate(), prism([(start, -5, 0), (start, 5, 0), (start, 0, -5)], (100, 0, 0))))
    slot = only(found.of("slot"))
    assert "v_shaped" in slot.tags
    assert sizes(slot) == near(30 - max(start, -30), 10, 5)
    assert slot.angle == pytest.approx(math.radians(90))
    assert not found.of("step")


@pytest.mark.parametrize("degrees", [60.0, 90.0, 120.0])
def test_a_v_groove_with_a_relief_slot_is_both(degrees: float) -> None:
    """As in V blocks: the flanks do not meet, but end at the walls of a slot."""
    half = 12 * math.tan(math.radians(degrees / 2))
    vee = prism([(-50, -half, 0), (-50, half, 0), (-50, 0, -12)], (100, 0, 0))
    found = find(cut(plate(80, 90, 40), vee, box((100, 3, 16), (-50, -1.5, -16))))
    vees = [slot for slot in found.of("slot") if "v_shaped" in slot.tags]
    assert [slot.angle for slot in vees] == [pytest.approx(math.radians(degrees))]
    assert vees[0].width == pytest.approx(2 * half * MM)
    assert [slot.width for slot in found.of("slot") if slot not in vees] == near(3)


def test_a_slot_with_bevelled_edges_is_no_v_groove() -> None:
    bevel = prism([(-50, -6, 0), (-50, 6, 0), (-50, 0, -6)], (100, 0, 0))
    found = find(cut(plate(80, 60, 30), bevel, box((100, 8, 10), (-50, -4, -10))))
    assert not [slot for slot in found.of("slot") if "v_shaped" in slot.tags]


def test_a_rectangular_step_along_a_v_groove_stays_a_step() -> None:
    found = find(
        cut(plate(), prism([(-50, -5, 0), (-50, 5, 0), (-50, 0, -5)], (100, 0, 0)), box((99, 9, 9), (-50, 12, -5)))
    )
    assert len(found.of("slot")) == 1
    assert len(found.of("step")) == 1


def test_a_closed_keyway_is_a_pocket_in_its_shaft() -> None:
    tool = turned(shifted(obround(14, 3, 20), (0, 0, 6)), (0, 1, 0), 90)
    key = only(find(cut(shaft(), shifted(tool, (0, 0, 30)))).of("pocket"))
    assert {"keyway", "axial", "obround"} <= set(key.tags)
    assert [key.length, key.width] == near(20, 6)


@pytest.mark.parametrize("round_end", [False, True])
def test_a_keyway_that_runs_out_of_its_shaft_is_a_slot_and_no_channel(round_end: bool) -> None:
    end = [cylinder(3, 10, (6, 0, 40), (1, 0, 0))] if round_end else []
    key = only(find(cut(shaft(), box((10, 6, 25), (6, -3, 40)), *end)).of("slot"))
    assert {"keyway", "open"} <= set(key.tags)
    assert [key.length, key.width] == near(23 if round_end else 20, 6)


def test_the_keyway_of_a_hub_lies_in_its_bore() -> None:
    key = only(find(cut(cylinder(20, 20), cylinder(10, 20), box((5, 6, 20), (8, -3, 0)))).of("slot"))
    assert "keyway" in key.tags
    assert [key.length, key.width] == near(20, 6)


def test_a_woodruff_keyway_has_the_radius_of_its_cutter() -> None:
    key = only(find(cut(shaft(), cylinder(8, 5, (13, -2.5, 30), (0, 1, 0)))).of("slot"))
    assert {"woodruff", "keyway"} <= set(key.tags)
    assert [key.width, key.radius] == near(5, 8)


@pytest.mark.parametrize("count", [3, 4])
def test_slots_towards_the_axis_of_a_disc_are_radial(count: int) -> None:
    tools = [turned(box((20, 4, 10), (18, -2, -2)), (0, 0, 1), 360 / count * i) for i in range(count)]
    found = find(cut(cylinder(30, 5), *tools))
    slots = found.of("slot")
    assert len(slots) == count
    assert all({"radial", "through"} <= set(slot.tags) for slot in slots)
    assert slots[0].width == pytest.approx(4 * MM)


@pytest.mark.parametrize("degrees", [0, 35])
def test_slots_in_the_wall_of_a_tube_are_radial_and_not_one_across_its_bore(degrees: float) -> None:
    """The tube stands on a foot: it is not the whole body that is round."""
    tube = fuse(cylinder(25, 28), box((60, 40, 8), (-30, 20, 0)))
    slots = [turned(box((10, 4, 3), (17, -2, 25)), (0, 0, 1), 45 + 90 * i) for i in range(4)]
    found = find(turned(cut(tube, cylinder(20, 28), *slots), (1, 2, 3), degrees))
    assert len(found.of("slot")) == 4
    for slot in found.of("slot"):
        assert "radial" in slot.tags
        assert [slot.width, slot.depth] == near(4, 3)


def test_a_slot_that_a_small_bore_interrupts_is_one() -> None:
    shape = cut(cylinder(25, 28), cylinder(6, 28), box((60, 4, 3), (-30, -2, 25)))
    slot = only(find(shape).of("slot"))
    assert "radial" not in slot.tags
    assert slot.length == pytest.approx(50 * MM, rel=0.01)


def test_a_slot_across_a_screw_head_is_not_radial() -> None:
    slot = only(find(cut(cylinder(10, 10), box((30, 2, 3), (-15, -1, 7)))).of("slot"))
    assert not {"radial", "keyway"} & set(slot.tags)


def test_a_curved_slot_is_measured_along_its_arc() -> None:
    angle = 2 * math.atan2(20, 60)
    sector = prism([(0, 0, 0), (60, -20, 0), (60, 20, 0)], (0, 0, 5))
    ring = cut(cylinder(20, 5), cylinder(14, 5))
    bow = cut(ring, cut(box((90, 90, 5), (-45, -45, 0)), sector))
    ends = [cylinder(3, 5, (17 * math.cos(a), 17 * math.sin(a), 0)) for a in (-angle / 2, angle / 2)]
    found = find(cut(cylinder(30, 4), fuse(bow, *ends)))
    slot = only(found.of("cutout"))
    assert "curved" in slot.tags
    assert [slot.length, slot.width] == near(17 * angle + 6, 6)
    assert slot.center == near(17, 0, 2)  # half-way along its centre line, not of its box
    assert slot.opening is not None
    assert slot.opening[:2] == near(17, 0)
    assert not found.of("fillet")
    assert not found.of("round")


def test_a_groove_around_an_island_is_a_groove_and_no_pocket() -> None:
    tool = cut(box((50, 30, 3), (-25, -15, -3)), box((44, 24, 3), (-22, -12, -3)))
    found = find(cut(plate(80, 60), tool))
    groove = only(found.of("groove"))
    assert "annular" in groove.tags
    assert groove.depth == pytest.approx(3 * MM)
    assert groove.local_size == near(50, 3, 3)
    assert groove.width == pytest.approx(3 * MM)
    assert groove.volume == pytest.approx((50 * 30 - 44 * 24) * 3 * MM**3)
    assert not found.of("pocket")


@pytest.mark.parametrize(
    ("tool", "tag", "width", "bottom"),
    [
        (cut(cylinder(12, 2, (0, 0, 20)), cylinder(9, 2, (0, 0, 20))), "rectangular", 2, 9),
        (
            cut(cylinder(12, 4, (0, 0, 20)), fuse(cone(10, 8, 2, (0, 0, 20)), cone(8, 10, 2, (0, 0, 22)))),
            "v_shaped",
            4,
            8,
        ),
        (torus(10, 2, (0, 0, 20)), "semicircular", 4, 8),
    ],
    ids=["for a retaining ring", "for a belt", "for balls"],
)
def test_a_groove_turned_into_a_shaft(tool: TopoDS_Shape, tag: str, width: float, bottom: float) -> None:
    groove = only(find(cut(shaft(), tool)).of("groove"))
    assert {"outer", "annular", tag} <= set(groove.tags)
    assert [groove.width, groove.radius, groove.depth] == near(width, bottom, 10 - bottom)


def test_a_groove_turned_into_a_bore() -> None:
    groove = only(find(cut(cylinder(20, 30), cylinder(10, 30), cylinder(11, 2, (0, 0, 20)))).of("groove"))
    assert {"inner", "annular"} <= set(groove.tags)
    assert [groove.width, groove.radius, groove.depth] == near(2, 11, 1)


def test_a_semicircular_notch_in_the_edge_of_a_plate() -> None:
    notch = only(find(cut(plate(60, 40, 5), cylinder(6, 20, (30, 0, -10)))).of("notch"))
    assert "semicircular" in notch.tags
    assert [notch.width, notch.depth, notch.radius] == near(12, 6, 6)


def test_a_groove_with_a_round_bottom_runs_along_its_plate() -> None:
    slot = only(find(cut(plate(), cylinder(4, 100, (-50, 0, 0), (1, 0, 0)))).of("slot"))
    assert sizes(slot) == near(60, 8, 4)


@pytest.mark.parametrize("round_end", [False, True])
def test_a_long_slot_from_the_edge_of_a_plate_goes_through_it(round_end: bool) -> None:
    end = [cylinder(4, 20, (5, 0, -10))] if round_end else []
    slot = only(find(cut(plate(60, 40, 5), box((30, 8, 20), (5, -4, -10)), *end)).of("slot"))
    assert {"through", "open"} <= set(slot.tags)
    reach = 29 if round_end else 25
    assert sizes(slot) == near(reach, 8, reach)


def test_a_short_cut_from_the_edge_of_a_plate_is_a_notch() -> None:
    notch = only(find(cut(plate(60, 40, 5), box((6, 10, 20), (25, -5, -10)))).of("notch"))
    assert [notch.width, notch.depth] == near(10, 5)


def test_the_inside_of_a_housing_has_its_volume() -> None:
    inside = only(find(cut(box((80, 60, 40)), box((74, 54, 37), (3, 3, 3)))).of("pocket"))
    assert inside.volume == pytest.approx(74 * 54 * 37 * MM**3)
    assert inside.local_size == near(74, 54, 37)


def test_the_inside_of_a_housing_with_rounded_corners_has_its_volume() -> None:
    core = box((74, 54, 37), (3, 3, 3))
    inside = only(find(cut(box((80, 60, 40)), filleted(core, 8, *upright(core)))).of("pocket"))
    assert "rectangular" in inside.tags
    assert inside.radius == pytest.approx(8 * MM)
    assert inside.volume == pytest.approx((74 * 54 - (4 - math.pi) * 64) * 37 * MM**3)


def test_a_closed_void_is_a_cavity_with_its_volume() -> None:
    found = find(cut(box((80, 60, 40)), box((30, 40, 20), (10, 10, 10)), ball(10, (60, 30, 20))))
    rectangular, spherical = sorted(found.of("cavity"), key=lambda cavity: len(cavity.faces), reverse=True)
    assert rectangular.volume == pytest.approx(30 * 40 * 20 * MM**3)
    assert spherical.volume == pytest.approx(4 / 3 * math.pi * 1000 * MM**3)
    assert rectangular.opening is None
    assert not found.of("pocket")


def mouth(shape: TopoDS_Shape) -> list[object]:
    """The straight edges at z = 0 inside the plate."""
    found = []
    for edge in edges(shape):
        curve = BRepAdaptor_Curve(edge)
        ends = [curve.Value(t) for t in (curve.FirstParameter(), curve.LastParameter())]
        if all(abs(p.Z()) < 1e-6 and abs(p.X()) < 11 and abs(p.Y()) < 7 for p in ends):
            found.append(edge)
    return found


@pytest.mark.parametrize("treat", [chamfered, filleted])
def test_a_pocket_with_a_broken_mouth_keeps_its_measures(treat: object) -> None:
    pocketed = cut(plate(), box((20, 12, 5), (-10, -6, -5)))
    found = find(treat(pocketed, 1.0, *mouth(pocketed)))  # type: ignore[operator]
    pocket = only(found.of("pocket"))
    assert pocket.local_size == near(20, 12, 5)
    assert not found.of("step")
    assert len(found.of("chamfer" if treat is chamfered else "round")) == 1


def test_pockets_that_run_into_each_other_are_two() -> None:
    hexagon = [(8 + 6 * math.cos(i * math.pi / 3), 6 * math.sin(i * math.pi / 3), -5) for i in range(6)]
    found = find(cut(plate(), prism(hexagon, (0, 0, 5)), box((20, 6, 8), (-14, -3, -8))))
    assert sorted(pocket.depth or 0 for pocket in found.of("pocket")) == near(5, 8)


def test_a_pocket_that_a_hole_breaks_into_keeps_its_outline() -> None:
    hexagon = [(8 * math.cos(i * math.pi / 3), 8 * math.sin(i * math.pi / 3), -5) for i in range(6)]
    pocket = only(find(cut(plate(), prism(hexagon, (0, 0, 5)), cylinder(4, 60, (8, 0, -40)))).of("pocket"))
    assert "hexagonal" in pocket.tags


def test_a_passage_from_a_slanted_face_is_a_cutout_along_its_own_direction() -> None:
    wedge = prism([(-30, -20, -20), (30, -20, -20), (30, -20, 10), (-30, -20, 0)], (0, 40, 0))
    cutout = only(find(cut(wedge, box((10, 8, 60), (-5, -4, -30)))).of("cutout"))
    assert "rectangular" in cutout.tags
    assert abs((cutout.normal or (0, 0, 0))[2]) == pytest.approx(1.0)


def test_chamfers_say_their_width_and_angle() -> None:
    block = plate()
    chamfers = find(chamfered(block, 3, *upright(block))).of("chamfer")
    assert len(chamfers) == 4
    assert {round((part.width or 0) / MM, 6) for part in chamfers} == {round(3 * math.sqrt(2), 6)}
    assert all(part.angle == pytest.approx(math.pi / 4) for part in chamfers)


@pytest.mark.parametrize("leg", [0.5, 4.0, 9.0])
def test_a_chamfer_is_one_whatever_its_size(leg: float) -> None:
    corner = [(30, 20, 0), (30 - leg, 20, 0), (30, 20 - leg, 0)]
    assert len(find(cut(plate(), prism(corner, (0, 0, -20)))).of("chamfer")) == 1


def test_the_cut_corner_of_a_plate_is_a_chamfer() -> None:
    corner = [(30, 20, 0), (22, 20, 0), (30, 12, 0)]
    chamfer = only(find(cut(plate(60, 40, 3), prism(corner, (0, 0, -3)))).of("chamfer"))
    assert chamfer.width == pytest.approx(8 * math.sqrt(2) * MM)


def test_the_sides_of_an_octagon_are_no_chamfers() -> None:
    corners = [(20 * math.cos((i + 0.5) * math.pi / 4), 20 * math.sin((i + 0.5) * math.pi / 4), 0) for i in range(8)]
    assert not find(prism(corners, (0, 0, 5))).of("chamfer")


def test_a_bevel_that_ends_at_a_wall_of_its_own_is_a_step() -> None:
    found = find(cut(plate(), prism([(-10, 20, 0), (-10, 14, 0), (-10, 20, -6)], (60, 0, 0))))
    assert not found.of("chamfer")
    assert len(found.of("step")) == 1


@pytest.mark.parametrize("radius", [2.0, 5.0])
def test_rounded_edges_say_their_radius(radius: float) -> None:
    block = plate()
    rounds = find(filleted(block, radius, *upright(block))).of("round")
    assert [part.radius for part in rounds] == near(*([radius] * 4))


@pytest.mark.parametrize("degrees", [0.0, 37.0])
def test_cuts_do_not_change_with_the_frame_or_the_kind_of_surface(degrees: float) -> None:
    shape = cut(
        plate(),
        prism([(-50, -15, 0), (-50, -9, 0), (-50, -12, -3)], (100, 0, 0)),
        box((100, 4, 4), (-50, 6, -4)),
        box((100, 8, 3), (-50, 4, -7)),
    )
    found = find(nurbs(turned(shape, (1, 2, 3), degrees)))
    assert sorted(tag for slot in found.of("slot") for tag in slot.tags if tag in ("t_slot", "v_shaped")) == [
        "t_slot",
        "v_shaped",
    ]


@pytest.mark.parametrize("degrees", [0, 35])
def test_a_window_in_the_wall_of_a_blind_tube_is_cut_through_and_faces_outwards(degrees: float) -> None:
    """Its lower side is no floor of the bore; its ends are planes across the bore's axis."""
    tube = cut(fuse(cylinder(30, 200), box((160, 160, 12), (-80, -80, -12))), cylinder(27, 188, (0, 0, 12)))
    found = find(turned(cut(tube, box((20, 40, 45), (-10, -40, 30))), (1, 2, 3), degrees))
    window = only([part for kind in ("cutout", "slot") for part in found.of(kind)])
    assert {"through", "closed"} <= set(window.tags)
    assert [window.length, window.width] == near(45, 20)
    bore = found.hole
    assert set(bore.faces).isdisjoint(window.faces)
    assert bore.depth == pytest.approx(188 * MM)
    assert window.normal is not None
    away = [w - b for w, b in zip(window.center, bore.center, strict=True)]
    assert sum(a * n for a, n in zip(away, window.normal, strict=True)) > 20 * MM


def beveled_foot(sides: int) -> TopoDS_Shape:
    """A cut 12 mm wide and 10 deep across a plate, its foot bevelled by 3 mm on one side or on both."""
    profile = [(-6, 1), (-6, -7), (-3, -10), (6 - 3 * (sides - 1), -10), *([(6, -7)] if sides == 2 else []), (6, 1)]
    return prism([(x, -21, z) for x, z in profile], (0, 42, 0))


@pytest.mark.parametrize("sides", [1, 2])
def test_a_slot_with_a_bevelled_foot_is_a_slot_as_wide_as_between_its_walls(sides: int) -> None:
    found = find(cut(plate(60, 40, 20), beveled_foot(sides)))
    slot = only(found.of("slot"))
    assert (slot.width, slot.depth) == near(12, 10)
    assert not found.of("step")


def test_a_rebate_with_a_bevelled_foot_is_a_step_and_no_slot() -> None:
    rebate = prism([(x, -21, z) for x, z in [(0, 1), (0, -7), (3, -10), (31, -10), (31, 1)]], (0, 42, 0))
    found = find(cut(plate(60, 40, 20), rebate))
    assert found.of("step")
    assert not found.of("slot")


def test_a_slot_with_flanks_of_45_degrees_is_no_step() -> None:
    trapezoid = prism([(x, -21, z) for x, z in [(-15, 1), (-4, -10), (4, -10), (15, 1)]], (0, 42, 0))
    found = find(cut(plate(60, 40, 20), trapezoid))
    assert only(found.of("slot")).depth == pytest.approx(10 * MM)
    assert not found.of("step")


def test_an_obround_slot_from_the_side_with_a_bevelled_foot_is_blind_and_has_a_round_end() -> None:
    outline = fuse(box((8, 10, 12), (-30, -5, -12)), cylinder(5, 8, (-30, 0, -12), (1, 0, 0)))
    inner = fuse(box((2, 6, 12), (-22, -3, -12)), cylinder(3, 2, (-22, 0, -12), (1, 0, 0)))
    bevel = fuse(
        prism(((-22, -5, -12), (-20, -3, -12), (-20, 3, -12), (-22, 5, -12)), (0, 0, 12)),
        cone(5, 3, 2, (-22, 0, -12), (1, 0, 0)),
    )
    found = find(cut(plate(60, 40, 20), outline, fuse(inner, bevel)))
    slot = only(found.of("slot"))
    assert sizes(slot) == near(17, 10, 10)
    assert {"obround", "blind"} <= set(slot.tags)


def ring_in_a_face() -> TopoDS_Shape:
    return cut(cylinder(14, 6, (0, 0, -6)), cylinder(9, 6, (0, 0, -6)))


def wedge() -> TopoDS_Shape:
    """A triangle that crosses a ring of radii 9 and 14 and leaves some of its outer wall beyond its own long side."""
    return prism(((-13, 11, -15), (13, 11, -15), (0, -1, -15)), (0, 0, 15))


def test_a_ring_groove_that_a_pocket_interrupts_keeps_the_arc_beyond_the_pocket() -> None:
    found = find(cut(plate(60, 60, 20), ring_in_a_face(), wedge()))
    groove = only(found.of("groove"))
    walls = [found.brep.faces[f] for f in groove.faces if found.brep.faces[f].radius]
    assert {round(face.radius / MM) for face in walls} == {9, 14}
    assert min(face.box[0][1] for face in walls if face.outward < 0 and face.box[0][1] > 0) == pytest.approx(11 * MM)
    assert not found.of("step")


def test_an_arc_in_another_plane_than_the_grooves_is_none_of_it() -> None:
    lower = cut(cylinder(14, 3, (0, 0, -18)), box((60, 41, 3), (-30, -30, -18)))
    found = find(cut(plate(60, 60, 20), ring_in_a_face(), wedge(), lower))
    groove = only(found.of("groove"))
    assert max(-found.brep.faces[f].box[0][2] for f in groove.faces) == pytest.approx(6 * MM)


def test_what_is_cut_into_a_round_wall_is_as_deep_as_it_lies_below_its_crown() -> None:
    # DIN 6885: a key of 8 x 7 in a bore of 25 mm takes 3.3 mm of the hub
    hub = cut(cylinder(25, 30), cylinder(12.5, 30), box((15.8, 8, 30), (0, -4, 0)))
    disc = cut(cylinder(45, 6), cylinder(31, 6), box((10, 10, 6), (40, -5, 0)))
    flat = cut(cylinder(10, 40), box((10, 40, 10), (8, -20, 0)))
    for shape, kind, depth in ((hub, "slot", 3.3), (disc, "notch", 5.0)):
        assert [round(1e3 * (one.depth or 0.0), 3) for one in find(shape).of(kind)] == [depth]
        tilted = turned(shape, (1, 0, 0), 30)
        assert [round(1e3 * (one.depth or 0.0), 3) for one in find(tilted).of(kind)] == [depth]
    assert not [one for kind in ("slot", "notch") for one in find(flat).of(kind)]
