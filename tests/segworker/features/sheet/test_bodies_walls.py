"""How thick are the walls of the bodies of an assembly?"""

from __future__ import annotations

import pytest
from tests.segworker.shapes import box, compound, cut, filleted, find, fuse, turned, upright


def test_each_body_of_an_assembly_has_the_thickness_of_its_own_walls() -> None:
    case = cut(box((80, 60, 30)), box((74, 54, 27.1), (3, 3, 3)))
    foot = box((10, 10, 10), (5, 5, -10))
    bodies = [part for part in find(compound(case, foot)).parts if part.kind == "body"]
    assert bodies[0].thickness == pytest.approx(0.003)
    assert bodies[1].thickness is None


def test_what_a_body_stands_on_is_a_plate_also_where_it_is_a_thick_one() -> None:
    support = fuse(box((42, 14, 6)), box((18, 14, 30), (12, 0, 6)))
    (base,) = [part for part in find(support).of("prism") if part.center[2] < 0.0031]
    assert (base.thickness, base.length, base.width) == pytest.approx((0.006, 0.042, 0.014))
    assert {"plate", "grounded"} <= set(base.tags)


def test_a_bar_without_anything_on_it_and_a_high_foot_are_no_plates() -> None:
    assert not any("plate" in part.tags for part in find(box((42, 14, 6))).of("prism"))
    tall = fuse(box((42, 14, 12)), box((18, 14, 30), (12, 0, 12)))
    assert not any(part.height == pytest.approx(0.012) for part in find(tall).of("prism"))


def test_fins_are_no_walls_of_a_housing() -> None:
    tray = cut(box((100, 60, 40)), box((84, 44, 30.1), (8, 8, 10)))
    fins = [box((100, 2, 12), (0, 4 + 10 * k, -12)) for k in range(6)]
    found = find(fuse(tray, *fins))
    walls = found.of("wall")
    assert walls
    assert all(part.thickness == pytest.approx(0.008) for part in walls)
    assert len(found.of("rib")) == 6
    (body,) = found.of("body")
    assert body.thickness in (None, pytest.approx(0.008))


def test_rounded_edges_are_told_by_how_they_lie() -> None:
    block = box((60, 40, 20))
    rounds = find(filleted(block, 4.0, *upright(block))).of("round")
    assert len(rounds) == 4
    assert all("vertical" in part.tags for part in rounds)
    lying = find(turned(filleted(block, 4.0, *upright(block)), (1, 0, 0), 90)).of("round")
    assert len(lying) == 4
    assert all("horizontal" in part.tags for part in lying)
