"""Random plates with random holes: what was put in is what is found."""

from __future__ import annotations

from dataclasses import dataclass

import pytest
from hypothesis import HealthCheck, given, settings
from hypothesis import strategies as st
from OCP.TopoDS import TopoDS_Shape
from tests.segworker.shapes import DOWN, UP, box, cut, cylinder, find, fuse, shifted, turned

from querycad_contracts import Part, Side

PITCH = 20.0
"""Holes stand on a grid of this pitch in mm, so that none touches another."""


SUNK = 0.6
"""Depth of a counterbore as a share of its radius: clearly deeper than what only faces the surface."""


@dataclass(frozen=True)
class Drilled:
    """One hole as it was put in, in millimetres: `depth` is None for a through hole, `wide` a counterbore's radius."""

    column: int
    row: int
    radius: float
    depth: float | None
    wide: float | None
    from_below: bool


@dataclass(frozen=True)
class Plate:
    thickness: float
    holes: tuple[Drilled, ...]

    def build(self) -> TopoDS_Shape:
        """Columns along x, rows along y; the top is z = 0."""
        body = box((5 * PITCH, 4 * PITCH, self.thickness), (-PITCH / 2, -PITCH / 2, -self.thickness))
        return cut(body, *(self.tool(hole) for hole in self.holes))

    def tool(self, hole: Drilled) -> TopoDS_Shape:
        along = UP if hole.from_below else DOWN
        at = (hole.column * PITCH, hole.row * PITCH, -self.thickness if hole.from_below else 0.0)
        bore = cylinder(hole.radius, hole.depth or self.thickness, at, along)
        return bore if hole.wide is None else fuse(bore, cylinder(hole.wide, SUNK * hole.wide, at, along))


tenths = st.integers(10, 35).map(lambda n: n / 10)


@st.composite
def plates(draw: st.DrawFn) -> Plate:
    thickness = draw(st.integers(6, 20)) * 1.0
    spots = draw(st.lists(st.tuples(st.integers(0, 4), st.integers(0, 3)), unique=True, max_size=8))
    holes = []
    for column, row in spots:
        radius = draw(tenths)
        depth = draw(st.none() | st.floats(0.5, 0.9).map(lambda share: round(share * thickness, 2)))
        widening = draw(st.none() | st.integers(16, 22))
        wide = None if widening is None else round(widening / 10 * radius, 2)
        if wide is not None and SUNK * wide > 0.8 * (depth or thickness):
            wide = None
        holes.append(Drilled(column, row, radius, depth, wide, draw(st.booleans())))
    return Plate(thickness, tuple(holes))


def nearest(holes: list[Part], hole: Drilled) -> Part:
    return min(
        holes,
        key=lambda part: (
            (part.center[0] * 1e3 - hole.column * PITCH) ** 2 + (part.center[1] * 1e3 - hole.row * PITCH) ** 2
        ),
    )


@settings(max_examples=20, deadline=None, suppress_health_check=[HealthCheck.too_slow, HealthCheck.data_too_large])
@given(plates())
def test_every_hole_is_found_once_with_its_measures_and_sides(plate: Plate) -> None:
    found = find(plate.build())
    holes = [part for part in found.seen_parts if part.kind == "hole"]
    assert len(holes) == len(plate.holes)
    for hole in plate.holes:
        part = nearest(holes, hole)
        top = not hole.from_below
        assert part.radius == pytest.approx(hole.radius * 1e-3)
        assert part.depth == pytest.approx((hole.depth or plate.thickness) * 1e-3)
        assert ("through" in part.tags) == (hole.depth is None)
        assert part.radii == pytest.approx([r * 1e-3 for r in (hole.wide, hole.radius) if r is not None])
        own_side = Side.TOP if top else Side.BOTTOM
        assert set(part.sides) == ({Side.TOP, Side.BOTTOM} if hole.depth is None else {own_side})
        if hole.depth is not None or hole.wide is not None:
            assert part.normal == pytest.approx(UP if top else DOWN)
            assert part.opening == pytest.approx(
                (hole.column * PITCH * 1e-3, hole.row * PITCH * 1e-3, (0.0 if top else -plate.thickness) * 1e-3)
            )


directions = st.tuples(*[st.integers(-3, 3)] * 3).filter(any)


@settings(max_examples=15, deadline=None, suppress_health_check=[HealthCheck.too_slow, HealthCheck.data_too_large])
@given(plates(), directions, st.integers(1, 359), st.tuples(*[st.integers(-500, 500)] * 3))
def test_the_same_holes_are_found_wherever_the_plate_lies(
    plate: Plate, axis: tuple[int, int, int], degrees: int, by: tuple[int, int, int]
) -> None:
    moved = shifted(turned(plate.build(), tuple(map(float, axis)), degrees), tuple(map(float, by)))  # type: ignore[arg-type]
    holes = find(moved).of("hole")
    expected = sorted((hole.radius, hole.depth or plate.thickness) for hole in plate.holes)
    rows = sorted((round((hole.radius or 0) * 1e3, 5), round((hole.depth or 0) * 1e3, 5)) for hole in holes)
    assert rows == expected
