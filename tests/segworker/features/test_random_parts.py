"""Random parts: what was put in is found, no more and no less, wherever the part lies."""

from __future__ import annotations

from collections import Counter
from dataclasses import dataclass

from hypothesis import HealthCheck, example, given, settings
from hypothesis import strategies as st
from OCP.TopoDS import TopoDS_Shape
from tests.segworker.shapes import DOWN, box, cone, cut, cylinder, find, fuse, plate, turned

from querycad_contracts import Part

CELL = 20.0  # millimetres; each cell of the plate has one feature, which keeps clear of its border
COLUMNS, ROWS = 4, 3
THICKNESS = 16.0
Expected = tuple[object, ...]


@dataclass(frozen=True)
class Feature:
    """One feature on the plate's top: what it is, its half width or radius, and its depth or height; millimetres."""

    kind: str
    half: float
    deep: float

    def apply(self, body: TopoDS_Shape, x: float, y: float) -> TopoDS_Shape:
        """The plate with this feature; its top is z = 0."""
        r, d = self.half, self.deep
        bore = cylinder(r, THICKNESS + 2, (x, y, 1), DOWN)
        drilled = cylinder(r, d, (x, y, 0), DOWN)
        added = {
            "boss": [cylinder(r, d, (x, y, 0))],
            "standoff": [cylinder(r, d, (x, y, 0))],
            "protrusion": [box((2 * r, 2 * r, d), (x - r, y - r, 0))],
        }
        removed = {
            "through": [bore],
            "blind": [drilled],
            "drilled": [drilled, cone(r, 0, r * 0.6, (x, y, -d), DOWN)],
            "counterbored": [bore, cylinder(1.7 * r, d / 3, (x, y, 0), DOWN)],
            "pocket": [box((2 * r, 2 * r, d), (x - r, y - r, -d))],
            "cutout": [box((2 * r, 2 * r, THICKNESS + 2), (x - r, y - r, -THICKNESS - 1))],
            "standoff": [cylinder(r / 2, d / 2, (x, y, d), DOWN)],
        }
        body = fuse(body, *added[self.kind]) if self.kind in added else body
        return cut(body, *removed[self.kind]) if self.kind in removed else body

    def expected(self) -> list[Expected]:
        """What recognition is to say of it: kind, radius or width, depth or height, form."""
        r, d = self.half, self.deep
        round_ones: dict[str, list[Expected]] = {
            "through": [("hole", r, THICKNESS, "through")],
            "counterbored": [("hole", r, THICKNESS, "through")],
            "blind": [("hole", r, d, "flat")],
            "drilled": [("hole", r, d, "conical")],
            "boss": [("boss", r, d, "")],
            "standoff": [("hole", r / 2, d / 2, "flat"), ("boss", r, d, "")],
        }
        return round_ones.get(self.kind) or [(self.kind, 2 * r, THICKNESS if self.kind == "cutout" else d, "")]


KINDS = ("through", "blind", "drilled", "counterbored", "pocket", "cutout", "boss", "standoff", "protrusion")
FEATURES = st.builds(
    Feature,
    st.sampled_from(KINDS),
    st.floats(1.5, 4.5).map(lambda value: round(value, 2)),
    st.floats(3.0, 9.0).map(lambda value: round(value, 2)),
)
CELLS = st.lists(st.none() | FEATURES, min_size=COLUMNS * ROWS, max_size=COLUMNS * ROWS).filter(any)
TURNS = st.tuples(
    st.sampled_from(((1.0, 0.0, 0.0), (0.0, 1.0, 0.0), (1.0, 2.0, 3.0), (0.0, 0.0, 1.0))),
    st.sampled_from((0.0, 33.0, 90.0, 180.0)),
)


def built(cells: list[Feature | None], turn: tuple[tuple[float, float, float], float]) -> TopoDS_Shape:
    body = plate(COLUMNS * CELL, ROWS * CELL, THICKNESS)
    for index, feature in enumerate(cells):
        if feature is not None:
            x = (index % COLUMNS - (COLUMNS - 1) / 2) * CELL
            y = (index // COLUMNS - (ROWS - 1) / 2) * CELL
            body = feature.apply(body, x, y)
    return turned(body, *turn)


def told(part: Part) -> Expected:
    """Kind, radius or width, depth or height, form; millimetres to a micrometre."""
    is_round = part.kind in ("hole", "boss")
    across, form = part.radius if is_round else part.width, part.bottom if is_round else None
    along = part.height if part.kind in ("boss", "protrusion") else part.depth
    return (part.kind, round((across or 0) * 1e3, 3), round((along or 0) * 1e3, 3), form or "")


@settings(max_examples=30, deadline=None, derandomize=True, suppress_health_check=list(HealthCheck))
@given(cells=CELLS, turn=TURNS)
@example(cells=[Feature("protrusion", 2.0, 3.0), *[None] * 11], turn=((0.0, 0.0, 1.0), 33.0))
def test_a_random_plate_has_what_was_put_in(
    cells: list[Feature | None], turn: tuple[tuple[float, float, float], float]
) -> None:
    wanted = Counter(
        (row[0], round(float(row[1]), 3), round(float(row[2]), 3), row[3])  # type: ignore[arg-type]
        for cell in cells
        if cell is not None
        for row in cell.expected()
    )
    parts = find(built(cells, turn)).parts
    kinds = {row[0] for row in wanted} | {"hole", "boss", "pocket", "cutout", "protrusion"}
    assert Counter(told(part) for part in parts if part.kind in kinds) == wanted
