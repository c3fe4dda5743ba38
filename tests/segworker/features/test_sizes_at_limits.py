"""Sizes that meet a limit exactly, as drawn ones do, and sides that are alike: rounding and order decide nothing."""

from __future__ import annotations

import math

import pytest
from OCP.BRepAdaptor import BRepAdaptor_Curve
from OCP.TopoDS import TopoDS, TopoDS_Shape
from tests.segworker.shapes import (
    DOWN,
    Vec,
    ball,
    box,
    cut,
    cylinder,
    extruded,
    filleted,
    find,
    fuse,
    halved,
    mirrored,
    nurbs,
    plate,
    scaled,
    shifted,
    shuffled,
    torus,
    turned,
    upright,
)

from querycad_contracts import Part

PLACES: list[Vec] = [(0.0, 0.0, 0.0), (137.3, -41.7, 88.9), (1e3 / 3, 2e3 / 7, -1e3 / 9)]
FACTORS = [25.4, 0.3]
X: Vec = (1.0, 0.0, 0.0)
Y: Vec = (0.0, 1.0, 0.0)


def of_kind(shape: TopoDS_Shape, kind: str) -> list[Part]:
    return [part for part in find(shape).parts if part.kind == kind]


def stored(shape: TopoDS_Shape) -> list[TopoDS_Shape]:
    """The same body in other places, other sizes, and with its faces in the opposite order."""
    return [*(shifted(shape, by) for by in PLACES), *(scaled(shape, by) for by in FACTORS), shuffled(shape)]


def bored(depth: float) -> TopoDS_Shape:
    """A bore of 7 mm with a step of 16 mm across and this depth."""
    return cut(plate(60, 60, 20), cylinder(3.5, 20, (0, 0, 0), DOWN), cylinder(8, depth, (0, 0, 0), DOWN))


@pytest.mark.parametrize(("depth", "kind"), [(4.0, "counterbored"), (3.9, "spotfaced")])
def test_a_step_a_quarter_as_deep_as_wide_is_a_counterbore(depth: float, kind: str) -> None:
    assert [kind in of_kind(shape, "hole")[0].tags for shape in stored(bored(depth))] == [True] * 6


@pytest.mark.parametrize(("depth", "deep"), [(50.0, False), (51.0, True)])
def test_a_hole_five_times_as_deep_as_wide_is_not_deep(depth: float, deep: bool) -> None:
    shape = cut(plate(60, 60, 80), cylinder(5, depth, (0, 0, 0), DOWN))
    assert ["deep" in of_kind(other, "hole")[0].tags for other in stored(shape)] == [deep] * 6


@pytest.mark.parametrize(("length", "elongated"), [(30.0, True), (29.0, False)])
def test_a_pocket_half_as_long_again_as_wide_is_elongated(length: float, elongated: bool) -> None:
    shape = cut(plate(80, 60, 20), box((length, 20, 5), (-length / 2, -10, -5)))
    assert ["elongated" in of_kind(other, "pocket")[0].tags for other in stored(shape)] == [elongated] * 6


def test_a_square_bar_is_one_prism_about_the_same_axis_wherever_it_lies() -> None:
    """Its three directions are equally short: no rounding may choose."""
    normals = {of_kind(shifted(box((20, 20, 20)), by), "prism")[0].normal for by in PLACES}
    assert len(normals) == 1


def tube(outer: float, inner: float) -> TopoDS_Shape:
    shift = (outer - inner) / 2
    return cut(box((outer, outer, 45)), box((inner, inner, 45), (shift, shift, 0)))


def test_a_square_tube_is_as_wide_across_flats_as_outside() -> None:
    for shape in (tube(50, 40), shuffled(tube(50, 40)), mirrored(tube(50, 40))):
        assert of_kind(shape, "prism")[0].across_flats == pytest.approx(0.050)


def channel() -> TopoDS_Shape:
    """A U of bent sheet 2 mm thick, 40 mm high and 60 mm wide outside, 100 mm long, bent over 3 mm inside."""
    outline = [(0, 0), (60, 0), (60, 40), (58, 40), (58, 2), (2, 2), (2, 40), (0, 40)]
    body = extruded([(float(x), float(y)) for x, y in outline], 0, 100)
    outside = [edge for edge in upright(body) if _at(edge, (0, 0)) or _at(edge, (60, 0))]
    body = filleted(body, 5.0, *outside)
    inside = [edge for edge in upright(body) if _at(edge, (2, 2)) or _at(edge, (58, 2))]
    return filleted(body, 3.0, *inside)


def _at(edge: TopoDS_Shape, place: tuple[float, float]) -> bool:
    point = BRepAdaptor_Curve(TopoDS.Edge(edge)).Value(0.0)
    return math.hypot(point.X() - place[0], point.Y() - place[1]) < 1e-6


def test_a_bent_sheet_is_measured_outside_in_whichever_order_its_faces_are_stored() -> None:
    """Inner and outer face of a leg are equally large; the outer one goes on over the bend."""
    for shape in (channel(), shifted(channel(), PLACES[1]), shuffled(channel()), mirrored(channel())):
        for kind in ("prism", "wall"):  # each leg is both, a plate and a wall
            sizes = [size for part in of_kind(shape, kind) for size in (part.length, part.width)]
            assert sizes == pytest.approx([0.1, 0.04, 0.1, 0.04])


def pinned(around: float = 0.0) -> TopoDS_Shape:
    """A pin of 20 mm with a cross hole of 6 mm, whose seam is turned about its axis by degrees."""
    return cut(cylinder(10, 80, (-40, 0, 0), X), turned(cylinder(3, 60, (0, 0, -30)), (0, 0, 1), around))


@pytest.mark.parametrize("around", [0.0, 45.0, 90.0])
def test_a_cross_hole_is_as_deep_as_its_axis_is_in_the_material(around: float) -> None:
    """Its rims are saddles, whose points that a file gives hang on where their seams lie."""
    for shape in (pinned(around), halved(pinned(around))):
        (hole,) = of_kind(shape, "hole")
        assert hole.depth == pytest.approx(0.020)


@pytest.mark.parametrize("around", [0.0, 45.0, 90.0])
def test_a_hole_in_the_wall_of_a_tube_is_as_deep_as_the_wall_is_thick(around: float) -> None:
    drill = turned(cylinder(2.5, 30), (0, 0, 1), around)
    shape = cut(cylinder(20, 60, (0, -30, 0), Y), cylinder(15, 60, (0, -30, 0), Y), drill)
    for other in (shape, halved(shape)):
        depths = [part.depth for part in of_kind(other, "hole") if part.radius == pytest.approx(0.0025)]
        assert depths == [pytest.approx(0.005)]


def test_a_hole_in_a_flat_on_a_shaft_is_as_deep_as_from_the_flat() -> None:
    """The twin: it opens in a plane, 8 mm from the axis, and ends in the cylinder on the other side."""
    shape = cut(cylinder(10, 80, (-40, 0, 0), X), box((30, 40, 10), (-15, -20, 8)), cylinder(2, 60, (0, 0, -30)))
    (hole,) = of_kind(shape, "hole")
    assert hole.depth == pytest.approx(0.018)


def keyed() -> TopoDS_Shape:
    key = fuse(box((18, 8, 10), (-9, -4, 6)), cylinder(4, 10, (-9, 0, 6)), cylinder(4, 10, (9, 0, 6)))
    return cut(cylinder(10, 80, (-40, 0, 0), X), key)


def test_a_keyway_keeps_the_radius_of_its_ends_where_the_shaft_is_stored_in_halves() -> None:
    for shape in (keyed(), halved(keyed())):
        assert [part.radius for part in of_kind(shape, "pocket")] == [pytest.approx(0.004)]


def test_a_whole_torus_is_one_however_it_is_stored() -> None:
    for shape in (torus(25, 5), nurbs(torus(25, 5))):
        (ring,) = of_kind(shape, "torus")
        assert ring.tube_diameter == pytest.approx(0.010)


def test_a_ball_stored_as_a_spline_is_no_torus() -> None:
    assert of_kind(nurbs(ball(25, (0, 0, 0))), "torus") == []


def guard() -> TopoDS_Shape:
    """A hub, two rings about it, and six spokes that the inner ring cuts in two."""
    hub = cylinder(8, 3)
    inner, outer = (cut(cylinder(r + 4, 3), cylinder(r, 3)) for r in (24, 44))
    bars = [turned(box((40, 4, 3), (6, -2, 0)), (0, 0, 1), 60.0 * n) for n in range(6)]
    return fuse(fuse(hub, inner), outer, *bars)


def test_a_guard_has_its_spokes_in_whichever_order_its_faces_are_stored() -> None:
    """The sides of a spoke's two pieces lie in the same planes, as far from the other side's."""
    for shape in (guard(), shuffled(guard())):
        assert len([part for part in of_kind(shape, "prism") if "spoke" in part.tags]) == 6


def wheel() -> TopoDS_Shape:
    """A rim of 100 mm inside, a hub with a bore of 10 mm as long, and four spokes."""
    rim, hub = cut(cylinder(60, 12), cylinder(50, 12)), cut(cylinder(15, 12), cylinder(5, 12))
    bars = [turned(box((38, 8, 6), (13, -4, 3)), (0, 0, 1), 90.0 * n) for n in range(4)]
    return fuse(rim, hub, *bars)


def test_a_rim_goes_around_its_spokes_and_not_around_the_bore_of_the_hub() -> None:
    for shape in (wheel(), shuffled(wheel()), shuffled(halved(wheel()))):
        inside = [part.inner_diameter for part in of_kind(shape, "boss") if part.radius == pytest.approx(0.060)]
        assert inside == [pytest.approx(0.100)]


def flattened() -> TopoDS_Shape:
    """A shaft of 40 mm with a flat 20 mm long, 2 mm deep."""
    return cut(cylinder(20, 100, (-50, 0, 0), X), box((20, 60, 10), (-10, -30, 18)))


@pytest.mark.parametrize("around", [0.0, 90.0, 180.0])
def test_a_flat_on_a_shaft_is_open_wherever_the_seam_lies(around: float) -> None:
    """It runs out in the shaft on both sides. Where no seam goes through it, its rim is a closed loop all the same."""
    for shape in (turned(flattened(), X, around), halved(turned(flattened(), X, around))):
        cuts = ("slot", "channel", "step", "notch", "pocket")
        found = {str(part.kind) for part in find(shape).parts if part.kind in cuts}
        assert found == {"notch"}  # shorter across than along the shaft


@pytest.mark.parametrize(("length", "kind"), [(6.0, "slot"), (5.5, "notch")])
def test_an_open_cut_as_long_as_wide_is_a_slot(length: float, kind: str) -> None:
    shape = cut(plate(80, 60, 40), box((6, length, 5), (-3, 30 - length, -5)))
    assert [len(of_kind(other, kind)) for other in stored(shape)] == [1] * 6


@pytest.mark.parametrize("around", [0.0, 90.0])
def test_a_pad_that_lies_is_as_wide_as_its_smaller_side_whichever_way_it_runs(around: float) -> None:
    pad = fuse(plate(120, 120, 10), turned(box((80, 30, 6), (-40, -15, 0)), (0, 0, 1), around))
    (found,) = of_kind(pad, "protrusion")
    assert (found.length, found.width) == pytest.approx((0.080, 0.030))


def test_a_pad_on_an_upright_wall_is_as_wide_as_it_is_level() -> None:
    """The twin: it is 80 mm wide and 30 mm high."""
    pad = fuse(box((120, 20, 120)), box((80, 6, 30), (20, -6, 40)))
    (found,) = of_kind(pad, "protrusion")
    assert found.width == pytest.approx(0.080)
