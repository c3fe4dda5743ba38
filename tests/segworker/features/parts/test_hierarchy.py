"""A part is in another when it opens on or stands on that one's faces, wherever their boxes lie."""

from __future__ import annotations

from OCP.TopoDS import TopoDS_Shape
from tests.segworker.shapes import DOWN, Found, box, compound, cut, cylinder, find, fuse, plate, turned

from querycad_contracts import Part
from querycad_segworker.grounding.find import find as named
from querycad_segworker.grounding.inventory import Inventory

MM = 1e-3


def carried(found: Found, carrier: Part, kind: str) -> set[float]:
    """The x positions, in millimetres, of the parts of a kind that `carrier` carries."""
    return {round(p.center[0] / MM, 3) for p in found.parts if p.kind == kind and p.id in carrier.children}


def angle() -> TopoDS_Shape:
    """An L of two plates; the box of the foot takes in the lower part of the wall's holes, and the other way round."""
    foot, wall = box((60, 40, 10), (0, 0, 0)), box((10, 40, 60), (0, 0, 0))
    return cut(fuse(foot, wall), cylinder(3, 30, (40, 20, -10)), cylinder(3, 30, (-10, 20, 40), (1, 0, 0)))


def test_a_hole_in_a_boss_is_in_the_boss_and_a_blind_one_not_in_the_plate_below() -> None:
    found = find(cut(fuse(plate(), cylinder(8, 15)), cylinder(3, 10, (0, 0, 15), DOWN), cylinder(3, 40, (20, 0, -30))))
    (boss,), (block,) = found.of("boss"), found.of("prism")
    assert carried(found, boss, "hole") == {0}
    assert carried(found, block, "hole") == {20}


def test_a_boss_is_on_the_plate_that_it_stands_on_and_not_the_plate_on_the_boss() -> None:
    found = find(fuse(plate(), cylinder(8, 15, (5, 0, 0))))
    (boss,), (block,) = found.of("boss"), found.of("prism")
    assert carried(found, block, "boss") == {5}
    assert block.id not in boss.children


def test_holes_in_a_flange_are_not_in_the_tube() -> None:
    tube = cut(fuse(cylinder(30, 8), cylinder(15, 60)), cylinder(12, 60), cylinder(2, 20, (23, 0, -5)))
    found = find(turned(tube, (0, 0, 1), 0))
    flange = next(boss for boss in found.of("boss") if "flange" in boss.tags)
    pipe = next(boss for boss in found.of("boss") if "tube" in boss.tags)
    assert carried(found, flange, "hole") == {0, 23}
    assert carried(found, pipe, "hole") == {0}


def test_a_hole_in_the_floor_of_a_pocket_is_in_the_pocket() -> None:
    shape = cut(plate(), box((20, 20, 6), (-10, -10, -6)), cylinder(2, 40, (0, 0, -30)), cylinder(2, 40, (20, 0, -30)))
    found = find(shape)
    (pocket,) = found.of("pocket")
    assert carried(found, pocket, "hole") == {0}


def test_pockets_in_a_plate_are_carried_by_it() -> None:
    found = find(cut(plate(), box((10, 10, 6), (-25, -5, -6)), box((10, 10, 6), (15, -5, -6))))
    (block,) = found.of("prism")
    assert carried(found, block, "pocket") == {-20, 20}


def test_overlapping_boxes_alone_put_nothing_inside() -> None:
    """A ring lies around a post: the post's hole is within the ring's box, but not in the ring."""
    post = cut(cylinder(5, 30), cylinder(2, 10, (0, 0, 30), DOWN))
    found = find(compound(post, cut(cylinder(20, 40), cylinder(15, 40))))
    ring = max(found.of("boss"), key=lambda boss: boss.radius or 0)
    assert {round((p.radius or 0) / MM) for p in found.of("hole") if p.id in ring.children} == {15}


def test_a_hole_through_each_leg_of_an_angle_is_found_once() -> None:
    assert len(find(angle()).of("hole")) == 2


def test_words_for_a_place_are_answered_by_faces() -> None:
    tube = cut(
        fuse(cylinder(30, 8), cylinder(15, 60)),
        *(cylinder(12, 60), cylinder(2, 20, (23, 0, -5)), cylinder(1, 20, (0, 0, 40), (1, 0, 0))),
    )
    inventory = Inventory(find(tube).seen_parts)
    in_flange = named(inventory, "holes in the flange").parts
    in_tube = named(inventory, "holes in the tube").parts
    assert sorted(round((part.radius or 0) / MM) for part in in_flange) == [2, 12]
    assert sorted(round((part.radius or 0) / MM) for part in in_tube) == [1, 12]
