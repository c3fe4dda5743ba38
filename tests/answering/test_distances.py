"""Distances of one part between its own centres, and along the level that parts lie on."""

from __future__ import annotations

import pytest
from tests.made import hole, part, whole

from querycad_answering.programs import Grounds, Unwritable, write
from querycad_contracts import Part, PartQuery, Vector
from querycad_language.forms import HORIZONTAL, VERTICAL, Distance, Plane

ARM = PartQuery(noun="arm", definite=True)
HOLES = PartQuery(noun="hole", plural=True)
ROWS = PartQuery(noun="row", plural=True, definite=True)
PIN, BLOCK = PartQuery(noun="pin", definite=True), PartQuery(noun="block", definite=True)


def test_one_part_has_a_distance_between_its_own_centres_and_no_gap() -> None:
    grounds = {ARM: ((part("prism-1", center_length=0.08),), 0)}
    assert "p.center_length" in write(Distance(ARM, "each other", "centers"), grounds, whole()).code
    for mode in ("surfaces", "usual"):
        with pytest.raises(Unwritable):
            write(Distance(ARM, "each other", mode), grounds, whole())
    with pytest.raises(Unwritable):
        write(Distance(ARM, "each other", "centers"), {ARM: ((part("prism-1"),), 0)}, whole())


def test_vertical_is_along_y_on_one_level_and_along_z_otherwise() -> None:
    level = (hole(1), hole(2, 20.0), hole(3, 0.0, 30.0))
    wall = (part("hole-1"), part("hole-2", (0.02, 0.0, 0.0)), part("hole-3", (0.0, 0.0, 0.03)))
    for holes, across, up in ((level, 0, 1), (wall, 0, 2)):
        for axis, along in ((HORIZONTAL, across), (VERTICAL, up)):
            code = write(Distance(HOLES, "each other", "centers", axis), {HOLES: (holes, 0)}, whole()).code
            assert f"a.center[{along}] - b.center[{along}]" in code


@pytest.mark.parametrize(
    ("axis", "crossed"), [((1.0, 0.0, 0.0), True), ((0.6, 0.0, 0.8), True), ((0.0, 0.0, -1.0), False)]
)
def test_axes_that_are_not_parallel_may_be_apart_square_to_both(axis: Vector, crossed: bool) -> None:
    upright = part("hole-1", axis=(0.0, 0.0, 1.0), radius=0.004)
    other = part("hole-2", (0.01, 0.02, 0.0), axis=axis, radius=0.003)
    bore, cross = PartQuery(noun="bore", definite=True), PartQuery(noun="cross hole", definite=True)
    asked: dict[Distance, Grounds] = {
        Distance(HOLES, "each other", "centers"): {HOLES: ((upright, other), 0)},
        Distance(bore, cross, "centers"): {bore: ((upright,), 0), cross: ((other,), 0)},
    }
    for form, grounds in asked.items():
        codes = [write(form, grounds, whole()).code]
        if crossed:
            codes.append(write(form, grounds, whole(), 1).code)
        assert any("offset(a, b)" in code for code in codes) is crossed
        assert any("a.center_distance(b)" in code for code in codes)


def pin_in_block(axis: Vector, extents: Vector, block: Vector) -> Grounds:
    """A pin, standing out of a block."""
    pin = part("boss-1", (0.0, 0.0, 0.02), axis=axis, extents=extents, radius=0.005, height=0.04)
    return {PIN: ((pin,), 0), BLOCK: ((part("prism-1", extents=block),), 0)}


def test_what_lies_obliquely_does_not_stand_out_along_x_y_or_z() -> None:
    out, within = Distance(Plane(None, PIN), Plane(None, BLOCK)), Distance(PIN, BLOCK, "within")
    upright = pin_in_block((0.0, 0.0, 1.0), (0.01, 0.01, 0.04), (0.05, 0.05, 0.02))
    leaning = pin_in_block((0.6, 0.0, 0.8), (0.03, 0.01, 0.04), (0.05, 0.05, 0.03))
    for form in (out, within):
        assert "[2]" in write(form, upright, whole()).code
        with pytest.raises(Unwritable):
            write(form, leaning, whole())


def test_what_leans_on_a_level_plate_stands_out_along_its_thickness() -> None:
    on_plate = pin_in_block((0.6, 0.0, 0.8), (0.03, 0.01, 0.04), (0.08, 0.08, 0.004))
    assert "center[2]" in write(Distance(Plane(None, PIN), Plane(None, BLOCK)), on_plate, whole()).code


def run(code: str, found: tuple[Part, ...], others: tuple[Part, ...] = ()) -> object:
    """What a program gives of parts that stand for what it finds: the first query, then the second."""
    batches = iter((found, others))

    def different(values: list[float], tolerance: float) -> list[float]:
        kept: list[float] = []
        for value in sorted(values):
            kept += [] if kept and value - kept[-1] < tolerance else [value]
        return kept

    names: dict[str, object] = {"find_parts": lambda _: list(next(batches)), "different": different}
    exec(code, names)  # noqa: S102 - our own program
    return names["solution"]


STAGGERED = tuple(hole(i, 10.0 * i, 17.0 * (i % 2)) for i in range(6))
"""Two rows of three, 17 mm apart, 20 mm from hole to hole in a row, one set off by half of that."""
GRID = tuple(hole(4 * i + j, 9.0 * i, 7.0 * j) for i in range(3) for j in range(4))
"""Four rows of three, 7 mm apart; three columns, 9 mm apart."""


@pytest.mark.parametrize(
    ("query", "holes", "apart"),
    [
        ({"count": 2}, STAGGERED, 0.017),
        ({}, STAGGERED, 0.017),
        ({"count": 4}, GRID, 0.007),
        ({"count": 3}, GRID, 0.009),
        ({}, GRID, 0.007),
        ({"adjectives": ("vertical",)}, GRID, 0.009),
    ],
)
def test_rows_are_as_far_apart_as_square_to_them(
    query: dict[str, object], holes: tuple[Part, ...], apart: float
) -> None:
    rows = ROWS.model_copy(update=query)
    code = write(Distance(rows, "each other", "centers"), {rows: (holes, 0)}, whole()).code
    assert run(code, holes) == pytest.approx(apart)


def test_rows_of_what_leans_are_apart_along_it() -> None:
    leaning = tuple(
        part(f"hole-{i}", (0.01 * (i % 3), 0.6 * up, 0.8 * up), axis=(0.0, 0.8, -0.6), radius=0.002)
        for i, up in enumerate((0.0, 0.0, 0.0, 0.02, 0.02, 0.02))
    )
    code = write(Distance(ROWS, "each other"), {ROWS: (leaning, 0)}, whole()).code
    assert run(code, leaning) == pytest.approx(0.02)


def test_one_row_and_another_are_apart_where_each_is_one() -> None:
    left, right = (PartQuery(noun="row", words=(side, "row"), definite=True) for side in ("left", "right"))
    one, other = STAGGERED[::2], STAGGERED[1::2]
    code = write(Distance(left, right, "centers"), {left: (one, 0), right: (other, 0)}, whole()).code
    assert run(code, one, other) == pytest.approx(0.017)


def test_holes_of_rows_and_what_lies_in_no_rows_are_apart_from_one_to_the_next() -> None:
    for query, holes in ((HOLES, STAGGERED), (ROWS, (hole(1), hole(2, 3.0, 5.0), hole(3, 11.0, 16.0)))):
        code = write(Distance(query, "each other", "centers"), {query: (holes, 0)}, whole()).code
        assert "a.center_distance(b)" in code


def turned(number: int, x: float, length: float, radius: float, y: float = 0.0) -> Part:
    """A section of a shaft along x, from `x` on, in metres."""
    extents = (length, 2 * radius, 2 * radius)
    return part(f"boss-{number}", (x + length / 2, y, 0.0), axis=(1.0, 0.0, 0.0), extents=extents, radius=radius)


@pytest.mark.parametrize(
    ("other", "axial"),
    [
        (turned(2, 0.08, 0.01, 0.006), True),
        (turned(2, 0.01, 0.01, 0.006), False),  # beside the collar, radially
        (turned(2, 0.08, 0.01, 0.006, y=0.02), False),  # on another axis
        (part("prism-2", (0.08, 0.0, 0.0)), False),
    ],
)
def test_what_follows_on_one_axis_is_apart_along_it(other: Part, axial: bool) -> None:
    grounds: Grounds = {PIN: ((turned(1, 0.0, 0.03, 0.012),), 0), BLOCK: ((other,), 0)}
    code = write(Distance(PIN, BLOCK, "surfaces"), grounds, whole()).code
    assert ("a.distance_to(b)" in code) is not axial
    if axial:
        assert "a.half_extents[0]" in code


def test_the_two_at_the_ends_are_those_furthest_apart() -> None:
    end = {"relation": "", "what": {"noun": "end"}}
    pins = PartQuery.model_validate({"noun": "pin", "count": 2, "plural": True, "places": [end]}, strict=False)
    two = PartQuery(noun="pin", count=2, plural=True)
    lever = (hole(1), hole(2, 40.0), hole(3, 40.0, 60.0))
    for query, reduced in ((pins, "max(found)"), (two, "min(found)")):
        code = write(Distance(query, "each other", "centers"), {query: (lever, 0)}, whole()).code
        assert code.endswith(reduced)
    square = (hole(1), hole(2, 40.0), hole(3, 40.0, 40.0), hole(4, 0.0, 40.0))  # no two of these alone
    assert "max(" not in write(Distance(pins, "each other", "centers"), {pins: (square, 0)}, whole()).code
