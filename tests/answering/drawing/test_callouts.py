"""Callouts: what a drawing says of a part, and like parts said once."""

from __future__ import annotations

import math
from typing import Any

import pytest
from tests.made import MM, hole, part

from querycad_answering.drawing.callouts import callout, callouts, carried_sections, ids_in, ids_text
from querycad_answering.drawing.numbers import length
from querycad_answering.drawing.threads import suits, thread_name
from querycad_contracts import LengthUnit, Part, PartKind


def counterbored(number: int, section: str = "counterbore") -> tuple[Part, Part]:
    """A hole of 16 mm with a counterbore of 26 x 8 mm, and that counterbore."""
    bore = part(f"{section}-h{number}.1", kind=section, diameter=0.026, radius=0.013, radii=(0.013,), depth=0.008)
    tags = ("through", "circular", "stepped", "counterbored")
    made = hole(number, diameter=0.016, tags=tags, radii=(0.013, 0.008), children=(bore.id,))
    return made, bore


def countersunk() -> tuple[Part, Part]:
    sink = part("countersink-h1.1", kind="countersink", diameter=0.0112, radii=(0.0056, 0.00275), angle=math.pi / 2)
    return hole(1, diameter=0.0055, tags=("through", "countersunk"), children=(sink.id,), width=0.0112), sink


BLIND: dict[str, Any] = {"bottom": "flat", "tags": ("blind", "circular"), "depth": 0.025}
CALLED = [
    (hole(1, diameter=0.0085), "Ø8.5 THRU"),
    (hole(1, diameter=0.0085, **BLIND), "Ø8.5 depth 25"),
    (hole(1, diameter=0.006, bottom="bore", depth=0.055), "Ø6 depth 55 into a bore"),
    (hole(1, diameter=0.0049175, pitch=0.001, tags=("blind", "threaded"), bottom="flat"), "M6 depth 10"),
    (hole(1, diameter=0.0069175, pitch=0.001, tags=("blind", "threaded"), bottom="flat"), "M8x1 depth 10"),
    (hole(1, diameter=0.02, pitch=0.007, tags=("threaded",)), "Ø20 threaded THRU"),
    (part("chamfer-1", chamfer_size=0.001, angle=math.pi / 4), "C1"),
    (part("chamfer-1", chamfer_size=0.002, angle=math.radians(30)), "chamfer 2 x 30°"),
    (part("chamfer-1", width=0.003), "chamfer 3 wide"),
    (part("fillet-1", radius=0.005), "R5"),
    (part("slot-1", tags=("obround",), local_size=(0.04, 0.012, 0.005), bottom="through"), "slot 12 x 40 THRU"),
    (part("pocket-1", label="rectangular pocket, x", local_size=(0.18, 0.082, 0.0), depth=0.042, bottom="flat"),
     "rectangular pocket 82 x 180 depth 42"),
    (part("pocket-1", tags=("hexagonal",), label="hexagonal pocket", across_flats=0.004, depth=0.0025),
     "hexagonal pocket 4 across flats, depth 2.5"),
    (part("boss-1", label="ring, x", diameter=0.052, outer_diameter=0.052, inner_diameter=0.03, height=0.008),
     "ring Ø52/Ø30, height 8"),
    (part("rib-1", label="fin, x", thickness=0.004, length=0.176, height=0.012), "fin 4 thick, length 176, height 12"),
    (part("slot-1", label="dovetail slot, x", mouth_width=0.018, bottom_width=0.027, length=0.115, depth=0.008,
          local_size=(0.115, 0.027, 0.008), bottom="open"), "dovetail slot 18/27 x 115 depth 8"),
    (part("bend-1", bend_radius=0.0025, bend_angle=math.pi / 2), "bend R2.5, 90°"),
    (part("bend-1", bend_radius=0.0, bend_angle=math.pi / 2), "bend R0, 90°"),
    (part("pipe-1", label="bent pipe, x", radii=(0.01, 0.008), length=0.3), "bent pipe Ø20/Ø16, length 300"),
    (part("pipe-1", label="bent bar, x", radii=(0.01,), length=0.3), "bent bar Ø20, length 300"),
    (part("groove-1", label="groove, x", diameter=0.019, width=0.0013, depth=0.0005),
     "groove Ø19, 1.3 wide, depth 0.5"),
    (part("gear-1", count=24, diameter=0.078, width=0.026), "gear 24 teeth, tip Ø78, width 26"),
]  # fmt: skip


@pytest.mark.parametrize(("made", "text"), CALLED, ids=[text for _, text in CALLED])
def test_a_part_is_told_as_on_a_drawing(made: Part, text: str) -> None:
    assert callout(made) == text


def test_a_counterbored_hole_shows_both_diameters_and_the_depth() -> None:
    made, bore = counterbored(1)
    assert callout(made, known={bore.id: bore}) == "Ø16 THRU, counterbore Ø26 depth 8"
    assert callout(made) == "Ø16 THRU, counterbore Ø26", "also where the counterbore itself is not known"
    assert callout(made, known={bore.id: bore}, symbols=True) == "Ø16 THRU, ⌴Ø26 ↧8"
    seat = bore.model_copy(update={"tags": (*bore.tags, "seat")})
    assert callout(made, known={seat.id: seat}) == "Ø16 THRU, seat Ø26 depth 8"


def test_a_countersunk_hole_shows_diameter_and_angle() -> None:
    made, sink = countersunk()
    assert callout(made, known={sink.id: sink}) == "Ø5.5 THRU, countersink Ø11.2 x 90°"
    assert callout(made) == "Ø5.5 THRU, countersink Ø11.2"


def test_lengths_are_in_the_unit_asked_for() -> None:
    assert callout(hole(1, diameter=0.0254), LengthUnit.IN) == "Ø1 THRU"
    assert callout(hole(1, diameter=0.0254), LengthUnit.M) == "Ø0.0254 THRU"


def test_like_parts_are_one_callout_in_the_order_in_which_they_come() -> None:
    sections = [counterbored(number) for number in range(1, 9)]
    known = {bore.id: bore for _, bore in sections}
    parts = [hole(20, diameter=0.0085), *(made for made, _ in sections), hole(21, diameter=0.0085)]
    found = callouts(parts, known=known)
    assert [one.text for one in found] == ["2x Ø8.5 THRU", "8x Ø16 THRU, counterbore Ø26 depth 8"]
    assert found[0].ids == ("hole-20", "hole-21")
    assert carried_sections([*parts, *known.values()]) == set(known)


def test_many_holes_are_a_few_short_lines() -> None:
    holes = [hole(number, diameter=0.002 + 0.001 * (number % 3)) for number in range(1, 1361)]
    found = callouts(holes)
    assert sorted(one.text for one in found) == ["453x Ø2 THRU", "453x Ø4 THRU", "454x Ø3 THRU"]
    assert sum(len(one.ids) for one in found) == 1360
    assert all(len(ids_text(one.ids)) < 120 for one in found)


@pytest.mark.parametrize(
    ("ids", "text"),
    [
        (["hole-1"], "hole-1"),
        (["hole-1", "hole-2", "hole-3", "hole-5"], "hole-1..3, hole-5"),
        (["counterbore-h1.1", "counterbore-h2.1"], "counterbore-h1.1, counterbore-h2.1"),
        ([f"hole-{2 * i}" for i in range(1, 12)], "hole-2, hole-4, hole-6 and 8 more"),
    ],
)
def test_ids_are_short_and_none_is_lost(ids: list[str], text: str) -> None:
    assert ids_text(ids, 3) == text


@pytest.mark.parametrize(
    ("diameter", "pitch", "kind", "name"),
    [
        (0.006, 0.001, "boss", "M6"),
        (0.0049175, 0.001, "hole", "M6"),
        (0.012, 0.00175, "boss", "M12"),
        (0.0123, 0.00175, "boss", None),
        (0.006, 0.0013, "boss", None),
    ],
)
def test_a_modelled_thread_is_named_by_diameter_and_pitch(
    diameter: float, pitch: float, kind: str, name: str | None
) -> None:
    made = part(f"{kind}-1", diameter=diameter, pitch=pitch, tags=("threaded",))
    assert thread_name(made) == name


@pytest.mark.parametrize(
    ("diameter_mm", "found"),
    [
        (5.0, {"tap drill M6"}),
        (5.5, {"clears M5 (medium)"}),
        (8.5, {"tap drill M10"}),
        (5.1054, {"tap drill 1/4-20"}),
        (4.0386, {"tap drill #10-32"}),
        (7.1425, {"clears 1/4 (medium)"}),
        (11.8, {"tap drill G1/4"}),
        (11.1125, {"tap drill 1/4 NPT"}),
        (5.13, set()),
    ],
)
def test_a_plain_hole_suits_threads_by_its_diameter_alone(diameter_mm: float, found: set[str]) -> None:
    assert set(map(str, suits(hole(1, diameter=diameter_mm * MM)))) == found


def test_every_kind_of_part_has_a_callout_without_measures() -> None:
    texts = {kind: callout(part(f"{kind.value}-1")) for kind in PartKind}
    assert all(text and "None" not in text for text in texts.values()), texts


@pytest.mark.parametrize("unit", list(LengthUnit))
def test_every_unit_of_lengths_can_be_written(unit: LengthUnit) -> None:
    assert float(length(0.0127, unit)) == pytest.approx(0.0127 / unit.metres, abs=1e-3)


def test_holes_that_noise_parts_by_the_last_decimal_are_one_group() -> None:
    depths = (0.007937499999999958, 0.007937500000000042)
    holes = [hole(n, diameter=0.00635, **{**BLIND, "depth": depth}) for n, depth in enumerate(depths)]
    assert [one.text for one in callouts(holes)] == ["2x Ø6.35 depth 7.938"]
    assert length(0.0079374, LengthUnit.MM) == "7.937"


@pytest.mark.parametrize(
    ("text", "ids"),
    [
        ("hole-1..3, hole-5", ["hole-1", "hole-2", "hole-3", "hole-5"]),
        ("hole-7", ["hole-7"]),
        ("chamfer-b1.1, chamfer-b1.2", ["chamfer-b1.1", "chamfer-b1.2"]),
        ("", []),
        ("hole-3..1", ["hole-3..1"]),
        ("hole-1..999999999", ["hole-1..999999999"]),
    ],
)
def test_ids_in_short_are_read_again(text: str, ids: list[str]) -> None:
    assert ids_in(text) == ids


def test_what_is_told_in_short_is_what_is_read() -> None:
    ids = ["hole-1", "hole-2", "hole-9", "chamfer-b1.1", "boss-4", "boss-5"]
    assert ids_in(ids_text(ids)) == ids
