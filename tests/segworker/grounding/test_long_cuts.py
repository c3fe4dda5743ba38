"""Cuts that are long: which way they run."""

from __future__ import annotations

from tests.made import inventory, part

from querycad_segworker.grounding.find import find


def test_a_long_cut_is_vertical_where_it_runs_up_and_not_where_it_opens_up() -> None:
    slots = {"x": (0.05, 0.005, 0.004), "z": (0.005, 0.004, 0.05)}
    tags = ("elongated", "vertical")  # by the axis that it opens along
    runs = inventory(
        *(
            part(f"slot-{name}", (i * 0.1, 0.0, 0.0), extents=extents, tags=tags)
            for i, (name, extents) in enumerate(slots.items())
        )
    )
    assert [p.id for p in find(runs, "the vertical slot").parts] == ["slot-z"]
    assert [p.id for p in find(runs, "the horizontal slot").parts] == ["slot-x"]
