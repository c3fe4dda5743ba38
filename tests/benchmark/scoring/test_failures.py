from __future__ import annotations

import json
from pathlib import Path

import pytest
from benchmark.scoring.failures import FailureClass, failure_class, read_overrides
from benchmark.scoring.items import BadBenchmark, Item
from benchmark.scoring.systems import Reply

from querycad_answering.judging import judge
from querycad_contracts import AnswerType, Evidence, Grounding, MissingAttribute, Part, Program, RunOutcome, RunStatus

SEARCHES = 'parts = find_parts("hole")\nsolution = parts[0].radius'


def item(label: str) -> Item:
    return Item("abc", "001", 0, Path("cad.step"), "?", label)


def hole(**measures: object) -> Part:
    return Part.model_validate(
        {
            "id": "hole-1",
            "kind": "hole",
            "label": "through hole",
            "faces": (3,),
            "center": (0.0, 0.02, 0.0),
            "extents": (0.01, 0.01, 0.004),
            "evidence": Evidence(source="geometry", confidence=1.0, reason="a round wall"),
        }
        | measures
    )


@pytest.mark.parametrize(
    ("category", "expected"),
    [
        ("bad_input", FailureClass.INTERFACE),
        ("internal", FailureClass.INTERFACE),
        ("limit", FailureClass.SYNTAX),
        ("program", FailureClass.SYNTAX),
        ("not_understood", FailureClass.REASONING),
        ("not_grounded", FailureClass.MASKS),
    ],
)
def test_a_failure_is_classed_by_its_category(category: str, expected: FailureClass) -> None:
    assert failure_class(item("4"), Reply(failure=category, message="why")) is expected


def test_a_measure_that_parts_do_not_have_is_a_missing_capability() -> None:
    reply = Reply(failure="program", missing_attribute=MissingAttribute(part="", attribute="pitch"))
    assert failure_class(item("0.001"), reply) is FailureClass.INTERFACE


def test_a_measure_that_a_found_part_lacks_is_a_missing_capability_as_the_product_says_it() -> None:
    outcome = RunOutcome(
        status=RunStatus.RAISED,
        missing_attribute=MissingAttribute(part="hole-1", attribute="edge_distance"),
        groundings=(Grounding(description="hole", sides=None, parts=(hole(),), understood=True),),
    )
    program = Program(code=SEARCHES, codegen="parser", expects=AnswerType.LENGTH)
    failure = judge(program, outcome).failure
    assert failure is not None
    assert failure.category == "not_grounded"
    reply = Reply(failure=failure.category, missing_attribute=failure.missing_attribute, code=SEARCHES)
    assert failure_class(item("0.001"), reply) is FailureClass.INTERFACE


def test_a_wrong_count_means_missing_or_additional_parts() -> None:
    assert failure_class(item("4"), Reply(5, AnswerType.COUNT)) is FailureClass.MASKS
    assert failure_class(item("re(4|6)"), Reply(5, AnswerType.COUNT)) is FailureClass.MASKS


@pytest.mark.parametrize(
    ("label", "value"),
    [
        ("[0.1, 0.2]", [0.1, 0.2, 0.3]),
        ("0.1", [0.1, 0.2]),
        ("[0.1, 0.2]", 0.1),
        ("{0.1, 0.2}", [0.1, 0.2, 0.3]),
        ("[[0.0, 0.0, 0.1]]", [[0.0, 0.0, 0.1], [0.0, 0.0, 0.2]]),
    ],
)
def test_another_number_of_values_means_missing_or_additional_parts(label: str, value: object) -> None:
    assert failure_class(item(label), Reply(value, code=SEARCHES)) is FailureClass.MASKS


def test_an_answer_of_another_form_is_a_fault_of_reasoning() -> None:
    assert failure_class(item("0.1"), Reply([0.1, 0.2, 0.3], AnswerType.POINT, code=SEARCHES)) is FailureClass.REASONING
    assert failure_class(item("'steel'"), Reply(0.1, code=SEARCHES)) is FailureClass.REASONING


@pytest.mark.parametrize("label", ["0.008", "[0.0, 0.02, 0.0]", "0.011"])
def test_the_right_part_with_the_wrong_measure_is_a_fault_of_reasoning(label: str) -> None:
    value = 0.004 if not label.startswith("[") else [0.0, 0.0, 0.0]
    part = hole(radius=0.004, diameter=0.008, radii=(0.004, 0.011))
    assert failure_class(item(label), Reply(value, code=SEARCHES, parts=(part,))) is FailureClass.REASONING


def test_another_value_of_parts_that_were_looked_for_blames_the_parts() -> None:
    part = hole(radius=0.004, diameter=0.008)
    assert failure_class(item("0.05"), Reply(0.004, code=SEARCHES, parts=(part,))) is FailureClass.MASKS


def test_another_value_without_looking_for_parts_blames_the_program() -> None:
    assert failure_class(item("0.05"), Reply(0.07, code="solution = shape.width")) is FailureClass.REASONING


def test_overrides_are_read_and_checked(tmp_path: Path) -> None:
    path = tmp_path / "overrides.json"
    assert read_overrides(path) == {}
    path.write_text(json.dumps({"abc/001/0": {"failure": "label", "note": "measured 12 mm"}}), encoding="utf-8")
    assert read_overrides(path)["abc/001/0"].failure is FailureClass.LABEL
    path.write_text(json.dumps({"abc/001/0": {"failure": "bad luck", "note": ""}}), encoding="utf-8")
    with pytest.raises(BadBenchmark, match=r"overrides\.json"):
        read_overrides(path)
