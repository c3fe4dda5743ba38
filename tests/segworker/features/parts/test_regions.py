"""What no family has is a region: a depression that convex edges close off, an elevation that concave ones do."""

from __future__ import annotations

import math
from collections.abc import Callable

import pytest
from OCP.TopoDS import TopoDS_Shape
from tests.segworker.shapes import (
    ball,
    box,
    chamfered,
    cut,
    cylinder,
    edges,
    extruded,
    filleted,
    find,
    fuse,
    halved,
    plate,
    prism,
    rims,
    scaled,
    sewn,
    shifted,
    torus,
    turned,
    upright,
)

from querycad_contracts import Part, Side
from querycad_segworker.grounding.find import find as find_parts
from querycad_segworker.grounding.inventory import Inventory

MM = 1e-3
NAMELESS = ("depression", "elevation")
BLOCK = plate()


def regions(shape: TopoDS_Shape) -> list[Part]:
    return [part for part in find(shape).parts if part.kind in NAMELESS]


def only(shape: TopoDS_Shape) -> Part:
    (part,) = regions(shape)
    return part


def pyramid(tip: float, at: float = 0.0) -> TopoDS_Shape:
    """Over a square of 16 around (`at`, 0, 0), up or down to `tip`."""
    a, b, c, d = ((at + x, y, 0.0) for x, y in ((-8, -8), (8, -8), (8, 8), (-8, 8)))
    top = (at, 0.0, tip)
    return sewn([[a, b, c, d], [a, b, top], [b, c, top], [c, d, top], [d, a, top]])


def star(low: float, by: float) -> TopoDS_Shape:
    """A star of five points across x, from x = `low` on, around z = 40."""
    outline = [(8 if i % 2 == 0 else 3.5, i * math.pi / 5) for i in range(10)]
    return prism([(low, r * math.cos(a), 40 + r * math.sin(a)) for r, a in outline], (by, 0, 0))


def ball_dent() -> TopoDS_Shape:
    """Of a ball, with a rounded rim: no edge of it is sharp."""
    dented = cut(plate(), ball(12, (0, 0, 8)))
    rim = math.sqrt(12**2 - 8**2)
    return filleted(dented, 2, *rims(dented, rim, 0))


def test_a_pit_without_walls_or_floor_is_a_depression_and_no_step() -> None:
    pit = only(cut(plate(), pyramid(-8)))
    assert pit.kind == "depression"
    assert [pit.length, pit.width, pit.depth] == pytest.approx([16 * MM, 16 * MM, 8 * MM])
    assert pit.volume == pytest.approx(16 * 16 * 8 / 3 * MM**3)
    assert {"rectangular", "closed", "blind"} <= set(pit.tags)
    assert pit.bottom is None
    assert not find(cut(plate(), pyramid(-8))).of("step")


def test_a_pyramid_that_stands_on_the_plate_is_no_region() -> None:
    assert not regions(fuse(plate(), pyramid(8)))  # a protrusion of its own family


def test_a_dent_with_a_rounded_rim_is_closed_off_by_the_round() -> None:
    dent = only(ball_dent())
    assert dent.kind == "depression"
    assert {"circular", "closed"} <= set(dent.tags)
    assert dent.bottom == "spherical"
    assert dent.normal == pytest.approx((0, 0, 1))


def test_a_plate_with_rounded_edges_has_no_region() -> None:
    assert not regions(filleted(BLOCK, 2, *edges(BLOCK)))


def test_a_groove_of_a_torus_around_an_island_is_a_depression() -> None:
    ring = only(cut(plate(), torus(10, 3)))
    assert ring.kind == "depression"
    assert ring.depth == pytest.approx(3 * MM)
    assert ring.volume == pytest.approx(math.pi**2 * 10 * 3**2 * MM**3, rel=0.01)


def test_a_scoop_that_runs_out_at_both_sides_is_open() -> None:
    scoop = only(cut(plate(), torus(40, 8, (0, 0, 30), (0, 1, 0))))
    assert "open" in scoop.tags
    assert scoop.bottom == "open"
    assert scoop.normal == pytest.approx((0, 0, 1))


def test_a_corner_that_a_ball_took_away_is_a_depression_and_one_that_it_sits_on_an_elevation() -> None:
    assert only(cut(plate(), ball(10, (30, 20, 0)))).kind == "depression"
    assert only(fuse(plate(), ball(10, (30, 20, 0)))).kind == "elevation"


def test_a_raised_star_across_the_seam_of_a_shaft_is_an_elevation() -> None:
    shaft = cylinder(20, 80)
    raised = only(fuse(shaft, star(14, 10)))
    assert raised.kind == "elevation"
    assert raised.normal == pytest.approx((1, 0, 0))
    assert raised.tip is not None
    assert raised.tip[0] == pytest.approx(24 * MM)
    assert not [part for part in regions(cut(shaft, star(14, 10))) if part.kind == "elevation"]


@pytest.mark.parametrize(
    "shape",
    [
        fuse(plate(), box((10, 40, 30), (-30, -20, 0))),
        fuse(cylinder(20, 40), cylinder(12, 80)),
        cut(plate(), cylinder(5, 30, (0, 0, -25))),
        fuse(plate(), cylinder(5, 10)),
        chamfered(BLOCK, 2, *edges(BLOCK)[:1]),
        cut(plate(), box((20, 10, 5), (-10, -5, -5))),
        fuse(plate(), extruded([(-20, -2), (20, -2), (20, 2), (-20, 2)], 0, 12)),
    ],
    ids=["L", "stepped shaft", "hole", "boss", "chamfer", "pocket", "rib"],
)
def test_what_a_family_has_is_no_region_besides(shape: TopoDS_Shape) -> None:
    assert not regions(shape)


@pytest.mark.parametrize("move", [lambda s: turned(s, (1, 2, 3), 37), lambda s: scaled(s, 100.0), halved])
def test_a_region_does_not_hang_on_how_the_model_lies_or_is_stored(
    move: Callable[[TopoDS_Shape], TopoDS_Shape],
) -> None:
    plain, moved = only(cut(plate(), pyramid(-8))), only(move(cut(plate(), pyramid(-8))))
    assert (moved.kind, moved.bottom) == (plain.kind, plain.bottom)
    assert {"rectangular", "closed"} <= set(moved.tags)


def test_a_depression_is_seen_from_where_it_opens() -> None:
    (pit,) = [part for part in find(cut(plate(), pyramid(-8))).seen_parts if part.kind == "depression"]
    assert pit.sides == (Side.TOP,)


@pytest.mark.parametrize("words", ["the recess", "the dimple", "the cutout", "the indentation", "the recessed area"])
def test_wide_words_reach_a_depression_where_nothing_narrower_is_there(words: str) -> None:
    inventory = Inventory(find(cut(plate(), pyramid(-8))).parts)
    assert [part.kind for part in find_parts(inventory, words).parts] == ["depression"]


@pytest.mark.parametrize("words", ["the recess", "the indentation"])
def test_a_pocket_comes_before_a_depression(words: str) -> None:
    both = cut(plate(), pyramid(-8), box((8, 8, 5), (15, -4, -5)))
    assert {part.kind for part in find(both).parts} >= {"pocket", "depression"}
    assert {part.kind for part in find_parts(Inventory(find(both).parts), words).parts} == {"pocket"}


@pytest.mark.parametrize("words", ["the bump", "the raised area", "the lug", "the logo"])
def test_wide_words_reach_an_elevation(words: str) -> None:
    shape = fuse(cylinder(20, 80), star(14, 10))
    raised = [part for part in find(shape).parts if part.kind == "elevation" or part.kind in ("model", "body")]
    assert [part.kind for part in find_parts(Inventory(raised), words).parts] == ["elevation"]


def test_a_keyway_is_not_any_depression() -> None:
    found = find_parts(Inventory(find(cut(plate(), pyramid(-8))).parts), "the keyway")
    assert not found.parts


def test_a_ball_on_a_stud_is_no_elevation_and_one_on_the_corner_of_a_block_is_one() -> None:
    assert not regions(fuse(BLOCK, cylinder(6, 30), ball(10, (0, 0, 38))))
    assert only(fuse(BLOCK, ball(10, (-30, 20, 0)))).kind == "elevation"


def test_beside_a_tab_is_no_depression() -> None:
    """Nothing bounds it but the tab and the one wall that it stands at."""
    tab = box((22, 24, 4), (20, -12, 0))
    right = filleted(tab, 5, *upright(tab))
    assert not regions(fuse(box((60, 60, 30), (-30, -30, 0)), right, shifted(right, (-62, 0, 0))))
