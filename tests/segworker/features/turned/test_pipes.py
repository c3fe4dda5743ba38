"""Bent pipes and bars, tubes with flat sides, and how thick walls and bodies are."""

from __future__ import annotations

import math

import pytest
from OCP.TopoDS import TopoDS_Shape
from tests.segworker.shapes import (
    bend,
    box,
    compound,
    cone,
    cut,
    cylinder,
    extruded,
    filleted,
    find,
    fuse,
    plate,
    rims,
    shifted,
    upright,
)

MM = 1e-3
X, Y, Z = (1.0, 0.0, 0.0), (0.0, 1.0, 0.0), (0.0, 0.0, 1.0)


def elbow(radius: float, angle: float = 90.0) -> TopoDS_Shape:
    """40 mm up from the origin, a bend of 60 mm to the right; of 90 degrees, 40 mm on along x."""
    curve = bend(60, radius, angle, (60, 0, 40), Y, (-1, 0, 0))
    parts = [cylinder(radius, 40), curve]
    return fuse(*parts, cylinder(radius, 40, (60, 0, 100), X)) if angle == 90.0 else fuse(*parts)


def handle() -> TopoDS_Shape:
    """A bar of 8 mm bent to a U, 40 mm high over all its middle line, on a plate."""
    legs = [cylinder(4, 36, (x, 0, -6)) for x in (-30, 30)]
    first = bend(10, 4, 90, (20, 0, 30), (0, -1, 0), X)
    second = bend(10, 4, 90, (-20, 0, 30), (0, -1, 0), Z)
    return fuse(plate(100, 40, 6), *legs, first, cylinder(4, 40, (-20, 0, 40), X), second)


def test_a_bent_pipe_is_one_pipe_with_its_wall_its_bend_and_its_middle_line() -> None:
    found = find(cut(fuse(elbow(20), cylinder(40, 8), cylinder(40, 8, (92, 0, 100), X)), elbow(16)))
    (pipe,) = found.of("pipe")
    assert pipe.radii == pytest.approx((20 * MM, 16 * MM))
    assert pipe.thickness == pytest.approx(4 * MM)
    assert pipe.length == pytest.approx((80 + 60 * math.pi / 2) * MM)
    (curve,) = found.of("bend")
    assert (curve.radius, curve.angle) == pytest.approx((60 * MM, math.pi / 2))
    assert pipe.children == (curve.id,)
    assert not found.of("round")
    assert not found.of("fillet")
    assert [boss.radius for boss in found.of("boss")] == pytest.approx([40 * MM, 40 * MM])


def test_the_bore_of_a_pipe_ends_in_its_bend_and_is_not_blind() -> None:
    found = find(cut(elbow(20), elbow(16)))
    assert [hole.bottom for hole in found.of("hole")] == ["bore", "bore"]


def test_a_body_that_is_a_pipe_has_its_radii_and_wall() -> None:
    found = find(cut(elbow(20), elbow(16)))
    (body,) = found.of("body")
    assert body.radii == pytest.approx((20 * MM, 16 * MM))
    assert body.thickness == pytest.approx(4 * MM)
    assert next(part for part in found.parts if part.kind == "model").radii == body.radii


def test_a_bent_bar_is_a_rod_with_all_of_its_bends() -> None:
    found = find(handle())
    (bar,) = found.of("pipe")
    assert "rod" in bar.tags
    assert bar.thickness is None
    assert bar.diameter == pytest.approx(8 * MM)
    assert bar.length == pytest.approx((2 * 30 + 40 + 2 * 10 * math.pi / 2) * MM)
    assert [curve.radius for curve in found.of("bend")] == pytest.approx([10 * MM, 10 * MM])
    assert not found.of("boss")


def test_a_bent_bore_in_a_block_is_no_pipe_of_its_own_wall() -> None:
    block = box((140, 60, 140), (-30, -30, 0))
    found = find(cut(block, elbow(16), cylinder(16, 60, (60, 0, 100), X)))
    (bore,) = found.of("pipe")
    assert bore.thickness is None
    assert "inner" in bore.tags
    assert next(body for body in found.of("body")).radii == ()


def test_a_rounded_rim_is_no_pipe() -> None:
    body, block = cylinder(20, 30), plate(60, 40, 20)
    for shape in (filleted(body, 5, *rims(body, 20, 30)), filleted(block, 5, *upright(block))):
        assert not find(shape).of("pipe")


@pytest.mark.parametrize("through", [True, False])
def test_a_square_tube_has_its_wall_and_outer_measures(through: bool) -> None:
    tube = cut(box((40, 50, 150), (0, 0, 0)), box((34, 44, 150), (3, 3, 0 if through else 5)))
    (section,) = [part for part in find(tube).of("prism") if "tube" in part.tags]
    assert section.thickness == pytest.approx(3 * MM)
    assert section.width == pytest.approx(40 * MM)
    assert section.length == pytest.approx((150 if through else 145) * MM)
    assert section.local_size == pytest.approx((section.length, 50 * MM, 40 * MM))


def test_a_square_tube_runs_into_a_plate_that_is_flush_with_it() -> None:
    tube = fuse(box((40, 40, 150), (0, 0, 0)), box((80, 90, 10), (-20, 0, -10)))
    (section,) = [p for p in find(cut(tube, box((34, 34, 150), (3, 3, 0)))).of("prism") if "tube" in p.tags]
    assert section.thickness == pytest.approx(3 * MM)
    assert section.extents == pytest.approx((40 * MM, 40 * MM, 150 * MM))


def test_a_square_hole_off_the_middle_makes_no_tube() -> None:
    block = cut(box((40, 40, 150), (0, 0, 0)), box((20, 20, 150), (5, 3, 0)))
    assert not [part for part in find(block).of("prism") if "tube" in part.tags]


def test_cells_side_by_side_are_no_tubes() -> None:
    cells = [box((10, 10, 40), (2 + 12 * i, 2 + 12 * j, 0)) for i in range(4) for j in range(3)]
    found = find(cut(box((50, 38, 40), (0, 0, 0)), *cells))
    assert not [part for part in found.of("prism") if "tube" in part.tags]


def hexagon(across: float) -> list[tuple[float, float]]:
    half = across / math.sqrt(3)
    return [(half * math.cos(math.pi * i / 3), half * math.sin(math.pi * i / 3)) for i in range(6)]


def test_a_nut_is_as_thick_as_it_is_high() -> None:
    (body,) = find(cut(extruded(hexagon(18), 0, 10.8), cylinder(6, 10.8))).of("body")
    assert body.thickness == pytest.approx(10.8 * MM)


def test_a_cone_of_sheet_is_as_thick_as_its_wall() -> None:
    shade = cut(cone(10, 40, 60), cone(8, 38, 60))
    (body,) = find(shade).of("body")
    assert body.thickness == pytest.approx(2 * math.cos(math.atan(0.5)) * MM, rel=0.02)


def test_what_stands_on_a_plate_does_not_make_it_thicker() -> None:
    base = fuse(plate(100, 60, 8), box((20, 20, 12), (-10, -10, 0)))
    (body,) = find(base).of("body")
    assert body.thickness == pytest.approx(8 * MM)


def test_a_hub_does_not_make_a_disc_a_tube_or_thicker() -> None:
    disc = cut(fuse(cylinder(50, 12), cylinder(20, 20)), cylinder(12, 20))
    (body,) = find(disc).of("body")
    assert "tube" not in body.tags
    assert body.thickness == pytest.approx(12 * MM)


def test_the_bodies_of_an_assembly_have_walls_of_their_own() -> None:
    cup = cut(cylinder(30, 50), cylinder(28, 48, (0, 0, 2)))
    case = cut(box((80, 60, 40), (100, 0, 0)), box((74, 54, 37), (103, 3, 3)))
    bodies = find(compound(cup, case, shifted(plate(30, 30, 30), (0, 100, 0)))).of("body")
    assert [body.thickness for body in bodies] == [pytest.approx(2 * MM), pytest.approx(3 * MM), None]
