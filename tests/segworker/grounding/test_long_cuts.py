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


def test_a_slot_that_runs_through_or_is_open_at_both_ends_has_no_closed_one() -> None:
    groove, notch = ("blind", "open", "open_ended"), ("through", "open", "open_end")
    cuts = inventory(part("slot-1", tags=groove), part("slot-2", (0.1, 0.0, 0.0), tags=notch))
    assert [p.id for p in find(cuts, "slots that are open at both ends").parts] == ["slot-1"]
    assert [p.id for p in find(inventory(part("slot-1", tags=groove)), "the continuous slots").parts] == ["slot-1"]
    assert not find(inventory(part("slot-1", tags=("blind", "open", "open_end"))), "the continuous slots").parts


def test_side_flats_are_all_around_and_side_walls_stand_upright() -> None:
    flats = [part(f"face-{i}", tags=("planar", "milled", way)) for i, way in enumerate(("lying", "inclined"))]
    walls = [part(f"wall-{i}", tags=("planar", way)) for i, way in enumerate(("lying", "upright"))]
    model = inventory(*flats, *walls)
    assert {p.id for p in find(model, "the side flats").parts} == {"face-0", "face-1"}
    assert [p.id for p in find(model, "lateral walls").parts] == ["wall-1"]
