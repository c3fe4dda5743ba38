"""What comes of a program that ended without a value: what it lacked is said by data, whatever its message says."""

from __future__ import annotations

from typing import Any

import pytest

from querycad_answering.judging import Verdict, judge
from querycad_contracts import Evidence, Grounding, MissingAttribute, Part, Program, RunOutcome, RunStatus, Status

LACKS_DEPTH = MissingAttribute(part="slot-1", attribute="edge_distance")


def slot(number: int) -> Part:
    return Part(
        id=f"slot-{number}",
        kind="slot",
        label="open slot",
        faces=(number,),
        center=(0.0, 0.0, 0.0),
        extents=(0.01, 0.01, 0.01),
        evidence=Evidence(source="geometry", confidence=1.0, reason="built by hand"),
    )


def verdict(codegen: str = "parser", parts: int = 1, **outcome: Any) -> Verdict:
    found = Grounding(description="slot", sides=None, parts=tuple(map(slot, range(1, parts + 1))), understood=True)
    ended = {"status": RunStatus.RAISED, "message": "why", "groundings": (found,)} | outcome
    return judge(Program(code="solution = 1", codegen=codegen), RunOutcome.model_validate(ended))


def test_a_measure_that_a_found_part_lacks_is_said_of_the_part() -> None:
    found = verdict(missing_attribute=LACKS_DEPTH)
    assert found.status is Status.NOT_GROUNDED
    assert found.failure is not None
    assert found.failure.message == "no edge distance is known of open slot (slot-1)"
    assert found.failure.missing_attribute == LACKS_DEPTH


@pytest.mark.parametrize(("parts", "said"), [(1, "has 1 such part: too few"), (2, "has 2 such parts: too few")])
def test_a_choice_among_too_few_is_said_to_be_one(parts: int, said: str) -> None:
    found = verdict(parts=parts, empty_selection=True)
    assert found.status is Status.NOT_GROUNDED
    assert found.failure is not None
    assert said in found.failure.message
    assert found.failure.missing_attribute is None


@pytest.mark.parametrize("outcome", [{"missing_attribute": LACKS_DEPTH}, {"empty_selection": True}])
def test_a_language_models_program_is_told_its_own_error(outcome: dict[str, Any]) -> None:
    found = verdict("some-model", **outcome)
    assert found.status is Status.FAILED
    assert found.failure is not None
    assert (found.failure.category, found.failure.message) == ("program", "why")


def test_a_message_that_reads_like_one_says_nothing() -> None:
    found = verdict(message="AttributeError: part 'slot-1' has no radius; it has width")
    assert found.failure is not None
    assert found.failure.category == "program"
