"""Where discs end that have jaws level with their rim, or are cut off obliquely."""

from __future__ import annotations

import math

import pytest
from OCP.TopoDS import TopoDS_Shape
from tests.segworker.shapes import box, cut, cylinder, find, fuse, shifted, turned

MM = 1e-3
Y = (0.0, 1.0, 0.0)


def tongued(radius: float, height: float, width: float) -> TopoDS_Shape:
    """A cylinder whose last 10 mm are a tongue across it."""
    beside = (2 * radius, radius, 10.0)
    return cut(
        cylinder(radius, height), *(box(beside, (-radius, y, height - 10)) for y in (width / 2, -width / 2 - radius))
    )


def test_a_disc_is_as_thick_as_it_is_without_the_tongue_on_it_and_as_with_a_slot_in_it() -> None:
    for hub in (None, cylinder(20, 30, (0, 0, -30))):
        shape = tongued(40, 25, 16)
        bosses = find(shape if hub is None else fuse(shape, hub)).of("boss")
        (disc,) = [boss for boss in bosses if (boss.radius or 0.0) > 30 * MM]
        assert (disc.height, disc.thickness, disc.extents[2]) == pytest.approx(3 * (15 * MM,))
        assert disc.center == pytest.approx((0, 0, 7.5 * MM), abs=1e-9)
    for slotted in (cut(cylinder(40, 25), box((80, 16, 10), (-40, -8, 15))), tongued(40, 25, 60)):
        (disc,) = find(slotted).of("boss")
        assert (disc.height, disc.thickness) == pytest.approx(2 * (25 * MM,))


def test_a_shaft_goes_to_the_end_of_its_tang() -> None:
    (shaft,) = find(tongued(10, 80, 6)).of("boss")
    assert shaft.height == pytest.approx(80 * MM)


def oblique(height: float, high: float, low: float) -> TopoDS_Shape:
    """What two planes, `height` apart at the axis, leave of a cylinder of 30 mm; each is tilted by so many degrees."""
    over = shifted(turned(box((400, 400, 400), (-200, -200, 0)), Y, high), (0, 0, height / 2))
    under = shifted(turned(box((400, 400, 400), (-200, -200, -400)), Y, low), (0, 0, -height / 2))
    return cut(cylinder(30, 300, (0, 0, -150)), over, under)


def test_a_disc_cut_off_obliquely_is_as_thick_as_its_two_planes_are_apart() -> None:
    found = find(oblique(2.0, 10, 10))
    (disc,), (body,) = found.of("boss"), found.of("body")
    assert (disc.height, disc.thickness) == pytest.approx((2 * MM, 2 * math.cos(math.radians(10)) * MM))
    assert body.thickness == disc.thickness


@pytest.mark.parametrize(("first", "second"), [(10.0, -10.0), (0.0, 10.0)])
def test_what_is_mitred_is_as_long_as_it_reaches(first: float, second: float) -> None:
    (bar,) = find(oblique(100.0, first, second)).of("boss")
    longer = 30 * (math.tan(math.radians(abs(first))) + math.tan(math.radians(abs(second))))
    assert bar.height == pytest.approx((100 + longer) * MM)
