"""Parameters of real models: values in unit and frame, and reasons in the place of what is not sure."""

from __future__ import annotations

from collections.abc import Iterator
from pathlib import Path
from typing import Any

import pytest
from tests.segworker.shapes import compound, cut, cylinder, write_step

from querycad.runtime import EmbeddedRuntime
from querycad_contracts import ParametersRequest, ParameterValue

EXAMPLES = Path(__file__).parents[2] / "examples"
BEARING = EXAMPLES / "bearing_assembly.step"


@pytest.fixture(scope="module")
def runtime() -> Iterator[EmbeddedRuntime]:
    with EmbeddedRuntime() as runtime:
        yield runtime


def fill(runtime: EmbeddedRuntime, file: Path, parameter: dict[str, Any], **more: Any) -> ParameterValue:
    asked = ParametersRequest.model_validate({"parameters": [{"name": "x", **parameter}], **more})
    found = runtime.parameters(file, asked)
    (value,) = found.parameters
    assert found.open == (() if value.status == "answered" else ("x",))
    assert (value.value is not None) == (value.status == "answered")
    assert bool(value.reason) == (value.status != "answered")
    return value


def test_a_count_needs_no_more_than_a_name(runtime: EmbeddedRuntime) -> None:
    found = fill(runtime, BEARING, {"name": "screw_count", "type": "count"})
    assert (found.value, found.asked, found.unit) == (4, "How many screw are there?", "")
    assert found.code is not None


@pytest.mark.parametrize(("unit", "value"), [("mm", 26.0), ("m", 0.026), ("in", 26 / 25.4)])
def test_a_length_is_in_the_unit_that_is_asked_for(runtime: EmbeddedRuntime, unit: str, value: float) -> None:
    wanted = {"type": "length", "question": "What is the width of the gear?", "unit": unit}
    found = fill(runtime, EXAMPLES / "gear_shaft.step", wanted)
    assert found.value == pytest.approx(value)
    assert found.unit == unit
    assert [part.id for part in found.parts] == ["gear-1"]
    assert len(found.faces) > 24


def test_several_values_are_no_one_value(runtime: EmbeddedRuntime) -> None:
    found = fill(runtime, BEARING, {"type": "length", "question": "What are the diameters of the holes?"})
    assert found.status == "unsure"
    assert "there are several: 9 mm (each of 4)" in found.reason


@pytest.mark.parametrize("kind", ["approach", "insertion", "pose"])
def test_two_ends_that_are_as_likely_are_no_answer_however_low_the_bar(runtime: EmbeddedRuntime, kind: str) -> None:
    wanted = {"type": kind, "question": "hole 4"}
    found = fill(runtime, EXAMPLES / "flange.step", wanted, least_confidence=0.3)
    assert found.status == "unsure"
    assert "2 ends that are alike" in found.reason
    assert fill(runtime, EXAMPLES / "flange.step", {**wanted, "side": "top"}, least_confidence=0.3).status == "answered"


def test_what_is_not_there_has_a_reason(runtime: EmbeddedRuntime) -> None:
    found = fill(runtime, BEARING, {"type": "length", "question": "How deep is the keyway?"})
    assert found.status == "unanswered"
    assert "keyway" in found.reason


@pytest.mark.parametrize(
    ("question", "reason"),
    [
        ("What is the shaft length?", "; not checked: 'shaft', taken for the whole model"),
        ("What is the diameter of the shiny hole?", "; not checked: 'shiny'"),
    ],
)
def test_what_is_passed_over_or_taken_on_trust_is_not_sure_enough_for_a_robot(
    runtime: EmbeddedRuntime, question: str, reason: str
) -> None:
    asked = {"type": "length", "question": question}
    found = fill(runtime, EXAMPLES / "housing.step", asked, least_confidence=0.1)
    assert found.status == "unsure"
    assert found.reason.endswith(reason)
    assert found.alternatives


def test_rings_that_have_only_an_axis_in_common_do_not_mate(runtime: EmbeddedRuntime, tmp_path: Path) -> None:
    def rings(name: str, inner_diameter: float) -> ParameterValue:
        outer = cut(cylinder(30, 10), cylinder(20, 10))
        inner = cut(cylinder(inner_diameter / 2, 10), cylinder(5, 10))
        return fill(runtime, write_step(tmp_path / name, compound(outer, inner)), {"type": "mates"})

    assert "no hole takes a shaft" in rings("bearing.step", 28).reason
    (mate,) = rings("screw.step", 34).value
    assert (mate["hole_diameter"], mate["clearance"], mate["assembled"]) == (40, 6, True)


def test_a_pose_stands_in_the_hole_and_looks_into_it(runtime: EmbeddedRuntime) -> None:
    bore = {"type": "pose", "question": "Where is the hole in the bearing block?"}
    unsure = fill(runtime, BEARING, bore)
    assert unsure.status == "unsure"
    assert "`side`" in unsure.reason
    assert len(unsure.alternatives) >= 2
    found = fill(runtime, BEARING, {**bore, "side": "front"}, least_confidence=0.4)
    assert [row[2] for row in found.value["matrix"][:3]] == pytest.approx([0, 1, 0])
    assert found.value["position"] == pytest.approx([0, 0, 53])


def test_approach_and_insertion_are_opposite_ways(runtime: EmbeddedRuntime) -> None:
    end = {"question": "the shaft", "side": "front"}
    approach = fill(runtime, BEARING, {**end, "type": "approach"}).value
    insertion = fill(runtime, BEARING, {**end, "type": "insertion"}).value
    assert approach["point"] == insertion["point"] == pytest.approx([0, -60, 53])
    assert (approach["direction"], insertion["direction"]) == ([0, 1, 0], [0, -1, 0])


def test_a_side_chooses_the_end_that_a_point_is_at(runtime: EmbeddedRuntime) -> None:
    tip = {"type": "point", "question": "Where is the tip of the shaft?"}
    for side, y in (("front", -60), ("back", 60)):
        found = fill(runtime, BEARING, {**tip, "side": side}, least_confidence=0.3)
        assert found.value == pytest.approx([0, y, 53])
        assert [part.id for part in found.parts] == ["body-4"]
    gear = EXAMPLES / "gear_shaft.step"
    assert fill(runtime, gear, {**tip, "side": "right"}, least_confidence=0.3).value == pytest.approx([134, 0, 0])
    assert "on the top" in fill(runtime, gear, {**tip, "side": "top"}).reason
    pose = fill(runtime, gear, {"type": "pose", "question": "Which is the left end of the shaft?", "side": "right"})
    assert all("(0, 0, 0)" not in each.text for each in pose.alternatives), (
        "no tool comes from the right to the left end"
    )


def test_a_model_that_is_open_fills_parameters(runtime: EmbeddedRuntime) -> None:
    gear = runtime.open(EXAMPLES / "gear_shaft.step", unit="m")
    found = gear.parameters([{"name": "key", "type": "pose", "question": "Where is the keyway?"}], least_confidence=0.7)
    (key,) = found.parameters
    assert key.value["position"] == pytest.approx([0.021, 0, 0.00925])
    assert [row[2] for row in key.value["matrix"][:3]] == pytest.approx([0, 0, -1])
    (mates,) = gear.parameters([{"name": "mates", "type": "mates"}], runtime.open(EXAMPLES / "flange.step")).parameters
    assert "the other model" in mates.reason


def test_grasps_are_pairs_of_faces_at_their_distance(runtime: EmbeddedRuntime) -> None:
    wanted = {"type": "grasps", "question": "Where is the bearing block?"}
    found = fill(runtime, BEARING, wanted)
    best = found.value[0]
    assert (best["distance"], [abs(each) for each in best["closing"]]) == (pytest.approx(36), [0, 1, 0])
    assert [grasp["distance"] for grasp in fill(runtime, BEARING, {**wanted, "at_most": 10}).value] == [9, 9]
    assert "within 1 mm" in fill(runtime, BEARING, {**wanted, "at_most": 1}).reason


def test_mates_of_an_assembly_are_what_is_assembled(runtime: EmbeddedRuntime) -> None:
    found = fill(runtime, BEARING, {"type": "mates"})
    pairs = {(mate["shaft"], mate["hole"]) for mate in found.value}
    assert {("body-4", "hole-14"), ("body-3", "hole-9")} <= pairs
    assert all(mate["assembled"] for mate in found.value)
    screws = [mate for mate in found.value if mate["hole_diameter"] == pytest.approx(5.5)]
    assert [mate["clearance"] for mate in screws] == pytest.approx([0.5] * 4)


def test_mates_of_two_files_are_by_size(runtime: EmbeddedRuntime) -> None:
    asked = ParametersRequest.model_validate({"parameters": [{"name": "mates", "type": "mates"}], "unit": "m"})
    (found,) = runtime.parameters(EXAMPLES / "gear_shaft.step", asked, EXAMPLES / "flange.step").parameters
    assert found.status == "unanswered"
    assert "no hole takes a shaft of the other model" in found.reason


def test_places_are_seen_from_the_frame_that_is_asked_for(runtime: EmbeddedRuntime) -> None:
    center = {"type": "point", "question": "What is the center of the object?"}
    world = [[0, -1, 0, 100], [1, 0, 0, 0], [0, 0, 1, 0], [0, 0, 0, 1]]
    given = fill(runtime, BEARING, {**center, "frame": {"of": "given", "matrix": world}})
    assert given.value == pytest.approx([0, 100, 38])
    plain = fill(runtime, BEARING, center)
    assert plain.value == pytest.approx([0, 0, 38])
    assert plain.frame is not None
    of_part = fill(runtime, BEARING, {**center, "frame": {"of": "part", "part": "hole-9"}})
    distance = sum(each**2 for each in of_part.value) ** 0.5
    assert distance == pytest.approx(15)  # the bore's middle is 15 mm above, in whichever frame
    lost = fill(runtime, BEARING, {**center, "frame": {"of": "part", "part": "the gear"}})
    assert "frame is not known" in lost.reason
    size = {"type": "size", "question": "What is the size of the object?"}
    assert "axes" in fill(runtime, BEARING, {**size, "frame": {"of": "given", "matrix": world}}).reason
