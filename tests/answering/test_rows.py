"""Rows and columns are counted, and so is what is in one of them."""

import pytest
from tests.made import hole, part, whole

from querycad_answering.programs import Unwritable, write
from querycad_contracts import Part, PartQuery, Place, Vector
from querycad_language.forms import Combine, Count

HOLES = PartQuery(noun="hole", plural=True)
ROWS = PartQuery(noun="row", plural=True)
COLUMNS = PartQuery(noun="column", plural=True)


def _count(query: PartQuery, parts: tuple[Part, ...]) -> object:
    names = {"find_parts": lambda _: parts, "different": _different}
    exec(write(Count(query), {query: (parts, 0)}, whole()).code, names)  # noqa: S102 - our own program
    return names["solution"]


def _different(values: list[float], tolerance: float) -> list[float]:
    return [v for i, v in enumerate(sorted(values)) if not i or v - sorted(values)[i - 1] > tolerance]


def _laid_out(*places: Vector, normal: Vector = (0, 0, 1)) -> tuple[Part, ...]:
    return tuple(hole(i, *at[:2], normal=normal).model_copy(update={"center": at}) for i, at in enumerate(places, 1))


GRID = _laid_out(*((0.02 * i, 0.01 * j, 0.0) for i in range(4) for j in range(3)))
ON_WALL = _laid_out(*((0.02 * i, 0.0, 0.01 * j) for i in range(4) for j in range(3)), normal=(0, 1, 0))
LINE = _laid_out((0, 0, 0), (0, 0.01, 0), (0, 0.02, 0))
STAGGERED = _laid_out((0, 0, 0), (0.02, 0, 0), (0.04, 0, 0), (0.01, 0.01, 0), (0.03, 0.01, 0))


@pytest.mark.parametrize("parts", [GRID, ON_WALL])
def test_rows_run_to_the_right_and_columns_up(parts: tuple[Part, ...]) -> None:
    assert (_count(ROWS, parts), _count(COLUMNS, parts)) == (3, 4)


def test_parts_on_one_line_are_one_row_and_staggered_rows_are_two() -> None:
    assert (_count(ROWS, LINE), _count(ROWS, STAGGERED)) == (1, 2)


def test_pillars_are_columns_and_the_row_of_holes_is_its_holes() -> None:
    pillars = tuple(part(f"boss-{i}", center=(0.02 * (i % 2), 0.03 * (i // 2), 0.0)) for i in range(4))
    assert _count(COLUMNS, pillars) == 4
    assert _count(PartQuery(noun="row", plural=True, definite=True), GRID) == 12


def test_in_one_row_are_as_many_as_in_each() -> None:
    def within(row: PartQuery) -> PartQuery:
        return HOLES.model_copy(update={"places": (Place(relation="in", what=row),)})

    one, all_rows = PartQuery(noun="row"), PartQuery(noun="row", plural=True)
    assert (_count(within(one), GRID), _count(within(all_rows), GRID)) == (4, 12)
    assert _count(within(one), LINE) == 3
    with pytest.raises(Unwritable):
        _count(within(one), STAGGERED)


def test_per_row_are_as_many_as_in_each() -> None:
    per_row = write(Combine("per", Count(HOLES), Count(ROWS)), {HOLES: (GRID, 0), ROWS: (GRID, 0)}, whole())
    assert "// len(different([p.center[1]" in per_row.code
