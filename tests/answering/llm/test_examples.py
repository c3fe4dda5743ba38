"""Every worked example of the prompt is run on its model, and gives what it says."""

from __future__ import annotations

from collections.abc import Iterator
from pathlib import Path
from typing import Any

import pytest

from querycad.runtime import EmbeddedRuntime
from querycad_answering.llm.prompt import Example, examples
from querycad_contracts import RunStatus
from querycad_sandbox import Sandbox

MODELS = Path(__file__).parents[3] / "examples"


@pytest.fixture(scope="module")
def runtime(tmp_path_factory: pytest.TempPathFactory) -> Iterator[EmbeddedRuntime]:
    with EmbeddedRuntime(tmp_path_factory.mktemp("models")) as runtime:
        yield runtime


@pytest.fixture(scope="module")
def sandbox() -> Iterator[Sandbox]:
    with Sandbox(workers=1) as sandbox:
        yield sandbox


@pytest.mark.parametrize("example", examples(), ids=lambda example: example.question)
def test_a_worked_example_gives_its_answer(example: Example, runtime: EmbeddedRuntime, sandbox: Sandbox) -> None:
    outcome = sandbox.run(example.code, runtime.model(MODELS / f"{example.model}.step"))
    assert outcome.status is RunStatus.OK, outcome.message
    assert alike(outcome.value, example.answer), outcome.value


def alike(value: Any, answer: Any) -> bool:
    """Equal to a micrometre; a part is told by its id, and lists in whatever order the parts have."""
    if isinstance(value, dict):
        return bool(value["part"] == answer)
    if isinstance(value, list):
        left = list(answer)
        for item in value:
            match = next((i for i, other in enumerate(left) if alike(item, other)), None)
            if match is None:
                return False
            left.pop(match)
        return not left
    if isinstance(value, float):
        return bool(value == pytest.approx(answer, rel=1e-4, abs=1e-6))
    return bool(type(value) is type(answer) and value == answer)
