"""Measures beyond size: across flats, centre to centre, draft, chamfers, tori, bends, tapered openings."""

from __future__ import annotations

import math

import pytest
from OCP.TopoDS import TopoDS_Shape
from tests.segworker.shapes import (
    DOWN,
    bend,
    box,
    chamfered,
    cone,
    cut,
    cylinder,
    extruded,
    find,
    fuse,
    halved,
    plate,
    prism,
    scaled,
    shifted,
    torus,
    turned,
    upright,
)

MM = 1e-3
X, Y, Z = (1.0, 0.0, 0.0), (0.0, 1.0, 0.0), (0.0, 0.0, 1.0)


def polygon(count: int, across_flats: float) -> list[tuple[float, float]]:
    corner = across_flats / 2 / math.cos(math.pi / count)
    return [
        (corner * math.cos(2 * math.pi * i / count), corner * math.sin(2 * math.pi * i / count)) for i in range(count)
    ]


def obround(length: float, width: float, depth: float) -> TopoDS_Shape:
    reach = (length - width) / 2
    ends = [cylinder(width / 2, depth + 2, (x, 0, -depth)) for x in (-reach, reach)]
    return fuse(box((2 * reach, width, depth + 2), (-reach, -width / 2, -depth)), *ends)


@pytest.mark.parametrize(
    ("count", "factor"), [(4, math.sqrt(2)), (6, 2 / math.sqrt(3)), (8, 1 / math.cos(math.pi / 8))]
)
def test_a_regular_prism_has_its_widths_across_flats_and_corners(count: int, factor: float) -> None:
    block = extruded(polygon(count, 10.0), 0.0, 5.0)
    for shape, size in ((block, 1.0), (turned(block, (0.3, 0.5, 0.8), 40.0), 1.0), (scaled(block, 100.0), 100.0)):
        (found,) = find(shape).of("prism")
        assert found.across_flats == pytest.approx(10 * size * MM, rel=1e-4)
        assert found.across_corners == pytest.approx(10 * factor * size * MM, rel=1e-4)


def test_a_nut_and_a_bolt_have_the_width_across_flats_of_their_hexagon() -> None:
    bolt = fuse(extruded(polygon(6, 16.0), 0.0, 6.4), cylinder(5, 40, along=DOWN))
    for shape in (cut(extruded(polygon(6, 16.0), 0.0, 8.0), cylinder(5, 8)), bolt):
        (body,) = find(shape).of("body")
        assert body.across_flats == pytest.approx(16 * MM)
    (block,) = find(box((16, 16, 40))).of("body")
    assert block.across_flats is None


def test_a_shaft_has_the_width_of_its_flats_or_its_square_before_that_of_the_socket_in_its_end() -> None:
    socket = extruded(polygon(6, 6.0), 50.0, 20.0)
    flats = cut(cylinder(9, 60), box((40, 20, 8), (-20, 8, 20)), box((40, 20, 8), (-20, -28, 20)), socket)
    square = cut(fuse(cylinder(9, 60), box((10, 10, 25), (-5, -5, -25))), socket)
    for shape, size in ((flats, 16.0), (square, 10.0), (cut(cylinder(9, 60), socket), 6.0)):
        (body,) = find(shape).of("body")
        assert body.across_flats == pytest.approx(size * MM)
    (block,) = find(fuse(box((60, 40, 10)), box((10, 10, 20), (25, 15, 10)))).of("body")
    assert block.across_flats is None


def test_a_hexagon_socket_has_them_and_an_oblong_does_not() -> None:
    (socket,) = find(cut(plate(), extruded(polygon(6, 8.0), -6.0, 7.0))).of("pocket")
    assert socket.across_flats == pytest.approx(8 * MM)
    (oblong,) = find(cut(plate(), box((12, 8, 6), (-6, -4, -6)))).of("pocket")
    assert oblong.across_flats is None


def test_two_flats_on_a_shaft_are_a_wrench_size_and_tangent_planes_are_not() -> None:
    rod = cylinder(10, 60)
    flat = cut(rod, box((40, 20, 15), (-20, 8, 45)), box((40, 20, 15), (-20, -28, 45)))
    assert 16 * MM in [pytest.approx(boss.across_flats) for boss in find(flat).of("boss") if boss.across_flats]
    web = fuse(cylinder(10, 20), box((40, 20, 20), (0, -10, 0)))
    assert all(boss.across_flats is None for boss in find(web).of("boss"))


def test_the_arms_of_a_star_have_no_width_across_flats_and_a_hexagon_with_broken_corners_has() -> None:
    arms = [turned(box((40, 10, 20), (0, -5, 0)), (0, 0, 1), 60.0 * i) for i in range(0, 6, 2)]
    star = fuse(*arms)
    assert all(part.across_flats is None for part in find(star).parts if part.kind != "face")
    bar = extruded(polygon(6, 16.0), 0.0, 30.0)
    (broken,) = find(chamfered(bar, 0.8, *upright(bar))).of("prism")
    assert broken.across_flats == pytest.approx(16 * MM)


def test_a_d_is_as_wide_as_from_its_flat_to_the_round_opposite() -> None:
    key = box((10, 10, 60), (-5, 2, -1))
    bored = cut(cylinder(10, 20), cut(cylinder(4, 40, (0, 0, 5)), key))
    shaft = cut(cylinder(4, 40), key)
    assert find(bored).hole.across_flats == pytest.approx(6 * MM)
    assert [boss.across_flats for boss in find(shaft).of("boss")] == pytest.approx([6 * MM])
    flats = cut(cylinder(4, 40, (0, 0, 5)), key, box((10, 10, 60), (-5, -12, -1)))
    assert find(cut(cylinder(10, 20), flats)).hole.across_flats == pytest.approx(4 * MM)
    keyed = cut(cylinder(10, 20), cylinder(4, 40, (0, 0, -5)), box((2, 6, 40), (-1, 0, -5)))
    assert find(keyed).hole.across_flats is None


def rail(foot: float, top: float, end: float = 0.0) -> TopoDS_Shape:
    """A block, 60 wide and 80 long, with a rail on it that is 10 high, `foot` wide below and `top` above.

    `end`: so far it stops short of both ends of the block.
    """
    half, over = foot / 2, top / 2
    section = [(-half, end, 30.0), (half, end, 30.0), (over, end, 40.0), (-over, end, 40.0)]
    return fuse(box((60, 80, 30), (-30, 0, 0)), prism(section, (0.0, 80.0 - 2 * end, 0.0)))


def test_a_dovetail_rail_has_its_widths_at_the_foot_and_at_the_top() -> None:
    for shape in (rail(24, 36), turned(rail(24, 36, 5), (0.3, 0.5, 0.8), 40.0)):
        (found,) = (
            one for kind in ("elevation", "protrusion") for one in find(shape).of(kind) if "dovetail" in one.tags
        )
        assert (found.bottom_width, found.mouth_width) == pytest.approx((24 * MM, 36 * MM))
        assert found.height == pytest.approx(10 * MM)
    for plain in (rail(24, 24), rail(36, 24)):
        assert all(one.bottom_width is None for kind in ("elevation", "protrusion") for one in find(plain).of(kind))


def test_a_square_bar_has_them_across_its_length_and_a_flat_one_does_not() -> None:
    for shape in (box((10, 10, 60)), turned(box((60, 10, 10)), (0.3, 0.5, 0.8), 40.0)):
        (bar,) = find(shape).of("prism")
        assert (bar.across_flats, bar.across_corners) == pytest.approx((10 * MM, 10 * math.sqrt(2) * MM))
    (flat,) = find(box((60, 10, 8))).of("prism")
    assert flat.across_flats is None


def test_what_is_flat_between_round_ends_is_no_wrench_size_of_theirs() -> None:
    bar = fuse(box((40, 12, 6), (-20, -6, 0)), cylinder(10, 6, (-20, 0, 0)), cylinder(10, 6, (20, 0, 0)))
    eye = fuse(cylinder(15, 8, (0, 0, -4)), cylinder(5, 40, (14, 0, 0), (1, 0, 0)))
    for shape in (bar, eye):
        assert [boss.across_flats for boss in find(shape).of("boss")] == [None, None]


def test_an_obround_slot_has_its_length_from_centre_to_centre() -> None:
    (slot,) = find(cut(plate(), obround(35, 10, 25))).of("cutout")
    assert (slot.length, slot.center_length) == pytest.approx((35 * MM, 25 * MM))
    (window,) = find(cut(plate(), box((35, 10, 30), (-17, -5, -25)))).of("cutout")
    assert window.center_length is None


def test_a_chamfer_says_what_it_takes_off_the_edge() -> None:
    block = box((40, 30, 20))
    (edge,) = find(chamfered(block, 2.0, upright(block)[0])).of("chamfer")
    assert edge.chamfer_size == pytest.approx(2 * MM)
    (rim,) = find(fuse(cylinder(10, 30), cone(10, 8, 2, (0, 0, 30)))).of("chamfer")
    assert rim.chamfer_size == pytest.approx(2 * MM)


def test_a_ring_has_three_diameters_and_a_rounded_rim_has_none_of_them() -> None:
    found = find(cut(torus(25, 5), torus(25, 3)))
    outer = next(part for part in found.of("torus") if "outer" in part.tags)
    measures = (outer.outer_diameter, outer.inner_diameter, outer.tube_diameter, outer.thickness)
    assert measures == pytest.approx((60 * MM, 40 * MM, 10 * MM, 2 * MM))
    (body,) = found.of("body")
    assert (body.outer_diameter, body.inner_diameter) == pytest.approx((60 * MM, 40 * MM))
    rounded = fuse(cylinder(20, 10), torus(20, 5, (0, 0, 5)))
    assert all(part.inner_diameter is None for part in find(rounded).of("torus"))


def test_a_pipe_has_both_diameters_and_its_bend() -> None:
    def elbow(radius: float) -> TopoDS_Shape:
        curve = bend(60, radius, 90, (60, 0, 40), Y, (-1, 0, 0))
        return fuse(cylinder(radius, 40), curve, cylinder(radius, 40, (60, 0, 100), X))

    (pipe,) = find(cut(elbow(20), elbow(16))).of("pipe")
    assert (pipe.outer_diameter, pipe.inner_diameter) == pytest.approx((40 * MM, 32 * MM))
    assert (pipe.bend_radius, pipe.bend_angle) == pytest.approx((60 * MM, math.pi / 2))


def frustum(mouth: float, bottom: float, depth: float) -> TopoDS_Shape:
    """A hollow pyramid below z = 0, made of four wedges around a block."""
    block = box((mouth, mouth, depth), (-mouth / 2, -mouth / 2, -depth))
    lean = (mouth - bottom) / 2
    half = mouth / 2
    for around in range(4):
        wedge = prism(
            [(half - lean, -mouth, -depth), (half + 1, -mouth, -depth), (half, -mouth, 0.0)], (0, 2 * mouth, 0)
        )
        far = prism([(half + 1, -mouth, -depth), (half + 1, -mouth, 1.0), (half, -mouth, 0.0)], (0, 2 * mouth, 0))
        block = cut(block, turned(wedge, Z, 90.0 * around), turned(far, Z, 90.0 * around))
    return block


def test_a_drafted_pocket_has_its_sizes_at_mouth_and_bottom() -> None:
    draft = math.radians(5.0)
    bottom = 20 - 2 * 10 * math.tan(draft)
    (pocket,) = find(cut(plate(), frustum(20, bottom, 10))).of("pocket")
    assert pocket.draft == pytest.approx(draft)
    assert (pocket.mouth_width, pocket.bottom_width) == pytest.approx((20 * MM, bottom * MM))
    (upright_one,) = find(cut(plate(), box((20, 20, 10), (-10, -10, -10)))).of("pocket")
    assert (upright_one.draft, upright_one.mouth_width) == (None, None)


def test_a_chamfered_slot_is_as_wide_at_its_mouth_as_at_its_bottom() -> None:
    ends = [fuse(cone(6, 4, 2, (x, 0, 0.5), DOWN), cylinder(5, 25, (x, 0, -22))) for x in (-12, 12)]
    lip = prism([(-12, -6, 0.5), (-12, 6, 0.5), (-12, 4, -1.5), (-12, -4, -1.5)], (24, 0, 0))
    found = find(cut(plate(), fuse(box((24, 10, 25), (-12, -5, -22)), *ends, lip)))
    (slot,) = found.of("cutout")
    assert (slot.mouth_width, slot.bottom_width) == (None, None)


def test_a_taper_pin_has_its_draft_and_a_plain_one_none() -> None:
    (pin,) = find(cone(3, 2.5, 25)).of("boss")
    assert pin.draft == pytest.approx(math.atan2(0.5, 25))
    (plain,) = find(halved(cylinder(3, 25, along=DOWN))).of("boss")
    assert plain.draft is None


def test_an_opening_has_the_area_within_its_rim() -> None:
    stepped = fuse(cylinder(3, 20, along=DOWN), cylinder(5, 4, along=DOWN))
    assert find(cut(plate(), stepped)).hole.opening_area == pytest.approx(math.pi * 25e-6)
    (pocket,) = find(cut(plate(), obround(30, 10, 8))).of("pocket")
    assert pocket.opening_area == pytest.approx((20 * 10 + math.pi * 25) * 1e-6)


def test_a_plane_face_is_inclined_to_the_horizontal_and_only_a_slanted_one_says_so() -> None:
    wedge = prism([(0, 0, 0), (60, 0, 0), (60, 0, 10), (40, 0, 30), (0, 0, 30)], (0, 40, 0))
    slanted = [face for face in find(wedge).of("face") if "inclined" in face.tags]
    assert [math.degrees(face.inclination or 0.0) for face in slanted] == pytest.approx([45.0])
    assert not [face for face in find(plate()).of("face") if "inclined" in face.tags]


def test_sheet_laid_flat_is_as_long_as_its_middle_and_a_block_is_none() -> None:
    legs = fuse(box((40, 30, 3), (5, 0, 0)), box((3, 30, 40), (0, 0, 5)))
    bent = cut(cylinder(5, 30, (5, 0, 5), Y), cylinder(2, 30, (5, 0, 5), Y))
    sheet = fuse(legs, cut(bent, box((20, 30, 20), (5, 0, 0)), box((20, 30, 20), (0, 0, 5))))
    flat = (80 + 3.5 * math.pi / 2) * MM
    corner = cut(box((6, 6, 10), (39, -1, -2)), cylinder(5, 10, (40, 5, -2)))
    for shape in (sheet, cut(sheet, cylinder(4, 10, (25, 15, -2))), cut(sheet, corner)):
        (body,) = find(turned(shape, (1, 2, 3), 30)).of("body")
        assert body.developed_length == pytest.approx(flat, rel=1e-4)
    assert find(plate()).of("body")[0].developed_length is None


def test_a_body_without_an_outer_hexagon_has_the_width_of_its_one_socket() -> None:
    head = cut(cylinder(12, 20), extruded(polygon(6, 8.0), 10.0, 10.0))
    (body,) = find(head).of("body")
    assert body.across_flats == pytest.approx(8 * MM, rel=1e-4)
    sockets = [shifted(extruded(polygon(6, 8.0), 10.0, 10.0), (x, 0, 0)) for x in (0, 20)]
    two = cut(box((60, 30, 20), (-20, -15, 0)), *sockets)
    assert find(two).of("body")[0].across_flats is None
