"""V grooves of pulleys, D-shaped bores and the washer faces of screws: what belongs to what."""

from __future__ import annotations

import pytest
from OCP.TopoDS import TopoDS_Shape
from tests.segworker.shapes import DOWN, box, cone, cut, cylinder, extruded, find, fuse, plate, shifted, turned

MM = 1e-3
HEXAGON = [(9.24, 0), (4.62, 8), (-4.62, 8), (-9.24, 0), (-4.62, -8), (4.62, -8)]


def pulley(bottom: float) -> TopoDS_Shape:
    """A groove of 34 degrees with a bottom so wide."""
    low, high = 15 - bottom / 2, 15 + bottom / 2
    v = fuse(cone(32, 20, 6, (0, 0, low - 6)), cone(20, 32, 6, (0, 0, high)))
    v = fuse(v, cylinder(20, bottom, (0, 0, low))) if bottom else v
    return cut(cylinder(30, 30), cut(cylinder(40, 12 + bottom, (0, 0, low - 6)), v), cylinder(8, 30))


@pytest.mark.parametrize("bottom", [0.0, 4.0])
def test_the_flanks_of_a_pulley_are_no_chamfers_and_its_rims_one_step(bottom: float) -> None:
    found = find(turned(pulley(bottom), (1, 2, 3), 40))
    assert found.of("chamfer") == []
    (groove,) = found.of("groove")
    assert ("v_shaped" if bottom == 0 else "trapezoidal") in groove.tags
    (rim,) = found.of("boss")
    assert [rim.diameter, rim.height] == pytest.approx([60 * MM, 30 * MM])


@pytest.mark.parametrize("depth", [30.0, 12.0])
def test_a_bore_with_a_flat_is_one_hole_that_owns_it(depth: float) -> None:
    tool = cut(cylinder(8, 40, (0, 0, -depth)), box((20, 40, 60), (6, -20, -40)))
    found = find(cut(plate(), tool))
    assert "d_shaped" in found.hole.tags
    assert found.hole.diameter == pytest.approx(16 * MM)
    walls = [found.brep.faces[i] for i in found.hole.faces]
    assert sum(abs(face.axis[0]) > 0.99 and face.outward == 0 for face in walls) == 1
    assert found.of("pocket") == found.of("step") == found.of("slot") == []


def test_a_keyway_does_not_make_a_bore_d_shaped() -> None:
    found = find(cut(plate(), cylinder(8, 20, (0, 0, -20)), box((6, 5, 20), (5, -2.5, -20))))
    assert "d_shaped" not in found.hole.tags
    assert found.hole.extents == pytest.approx((16 * MM, 16 * MM, 20 * MM)), "also where the keyway took the wall"


@pytest.mark.parametrize("degrees", [0, 40])
def test_a_bore_with_two_keyways_is_one_bore_with_two_keyways(degrees: float) -> None:
    found = find(
        turned(cut(plate(), cylinder(8, 20, (0, 0, -20)), box((22, 5, 20), (-11, -2.5, -20))), (1, 2, 3), degrees)
    )
    assert [found.hole.diameter, found.hole.depth] == pytest.approx([16 * MM, 20 * MM])
    assert "d_shaped" not in found.hole.tags
    assert ["keyway" in slot.tags for slot in found.of("slot")] == [True, True]
    assert found.of("cutout") == []


def test_a_bore_with_splines_is_one_bore_and_has_its_teeth_counted() -> None:
    keys = [turned(box((10, 4, 20), (0, -2, -20)), (0, 0, 1), 60 * i) for i in range(6)]
    found = find(cut(plate(), cylinder(8, 20, (0, 0, -20)), *keys))
    assert found.hole.diameter == pytest.approx(16 * MM)
    assert [gear.count for gear in found.of("gear")] == [6]


@pytest.mark.parametrize("depth", [30.0, 12.0])
def test_a_bore_with_two_flats_is_a_double_d_and_owns_them(depth: float) -> None:
    sides = [box((20, 40, 60), (x, -20, -40)) for x in (6, -26)]
    found = find(cut(plate(), cut(cylinder(8, 40, (0, 0, -depth)), *sides)))
    assert {"d_shaped", "double_d"} <= set(found.hole.tags)
    assert found.hole.diameter == pytest.approx(16 * MM)
    assert found.of("cutout") == found.of("pocket") == []


def test_curved_slots_around_one_centre_are_no_bore() -> None:
    ring = cut(cylinder(15, 20, (0, 0, -20)), cylinder(11, 20, (0, 0, -20)))
    spokes = fuse(box((60, 6, 20), (-30, -3, -20)), box((6, 60, 20), (-3, -30, -20)))
    found = find(cut(plate(), cut(ring, spokes)))
    assert found.of("hole") == []
    assert len(found.of("cutout")) == 4


def test_a_slot_with_bowed_ends_is_no_bore() -> None:
    slot = cut(cylinder(15, 20, (0, 0, -20)), box((40, 20, 20), (-20, 5, -20)), box((40, 20, 20), (-20, -25, -20)))
    assert find(cut(plate(), slot)).of("hole") == []


def test_the_washer_face_under_a_hexagon_belongs_to_the_head() -> None:
    screw = fuse(extruded(HEXAGON, 0.6, 6.4), cylinder(7.2, 0.6), cylinder(5, 40, along=DOWN))
    found = find(turned(shifted(screw, (3, 4, 5)), (1, 2, 3), 40))
    (head,) = [part for part in found.parts if "head" in part.tags]
    assert head.height == pytest.approx(7 * MM)
    (face,) = [part for part in found.parts if "washer_face" in part.tags]
    assert face.diameter == pytest.approx(14.4 * MM)
    assert set(face.faces) <= set(head.faces)
    assert "screw" in found.of("body")[0].tags


def test_a_round_step_between_a_round_head_and_its_shank_is_no_washer_face() -> None:
    screw = fuse(cylinder(8, 6.4, (0, 0, 0.6)), cylinder(6.2, 0.6), cylinder(5, 40, along=DOWN))
    tags = {tag for part in find(screw).parts for tag in part.tags}
    assert "washer_face" not in tags
    assert {"head", "shank"} <= tags


def test_a_flat_on_a_shaft_meets_it_along_both_sides_and_the_step_of_a_snail_along_one() -> None:
    shaft = cylinder(5, 30)
    (flattened,) = find(cut(shaft, box((10, 20, 10), (4, -10, 0)))).of("boss")
    assert flattened.across_flats == pytest.approx(9 * MM)
    snail = cut(box((20, 20, 10), (-10, 0.5, 0)), cylinder(5, 10, (-0.5, 0, 0)))
    assert all(boss.across_flats is None for boss in find(cut(shaft, snail)).of("boss"))
