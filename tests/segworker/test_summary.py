"""A model in short: parts that are alike are one group, with what all of them share."""

from __future__ import annotations

from pathlib import Path

from tests.segworker.shapes import box, compound, cut, cylinder, write_step

from querycad_contracts import ModelSummary, PartKind, Side
from querycad_segworker.ingest import ingest
from querycad_segworker.model import ModelStore
from querycad_segworker.summary import summary


def told(folder: Path) -> ModelSummary:
    """A plate with four blind holes in a rectangle on top and a through hole, and two pins beside it."""
    drills = [cylinder(2, 8, (x, y, 12)) for x in (10, 50) for y in (10, 30)]
    plate = cut(box((60, 40, 20)), *drills, cylinder(6, 30, (30, 20, -5)))
    shape = compound(plate, cylinder(3, 20, (80, 0, 0)), cylinder(3, 20, (80, 30, 0)))
    return summary(ingest(write_step(folder / "told.step", shape), ModelStore(folder / "store")).load_model())


def test_like_parts_are_one_group_with_what_all_of_them_share(tmp_path: Path) -> None:
    groups = told(tmp_path).groups
    holes = [group for group in groups if group.kind is PartKind.HOLE]
    assert [(group.count, group.label) for group in holes] == [
        (1, "through hole, diameter 12 mm, depth 20 mm"),
        (4, "blind hole, diameter 4 mm, depth 8 mm"),
    ]
    assert holes[0].sides == (Side.TOP, Side.BOTTOM)
    assert (holes[1].sides, holes[1].layout) == ((Side.TOP,), "rectangular pattern of 4, pitch 20 mm")
    assert "blind" in holes[1].tags
    assert not any(group.hidden for group in groups)


def test_every_feature_is_in_one_group_and_bodies_are_where_there_are_several(tmp_path: Path) -> None:
    found = told(tmp_path)
    counts = {kind: sum(group.count for group in found.groups if group.kind is kind) for kind in PartKind}
    assert {kind: n for kind, n in counts.items() if n} == {
        kind: n
        for kind, n in found.part_counts.items()
        if PartKind(kind).is_feature or kind in ("body", "prism", "wall", "floor")
    }
    assert sorted(group.count for group in found.groups if group.kind is PartKind.BODY) == [1, 2]
