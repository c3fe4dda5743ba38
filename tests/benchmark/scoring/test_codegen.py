"""Who writes programs in a measured run: the parser, a language model, or both."""

from __future__ import annotations

from collections.abc import Callable
from pathlib import Path

import pytest
from benchmark.scoring.embedded import EmbeddedSystem
from benchmark.scoring.systems import SystemOptions, UnknownSystem
from tests.answering.llm.conftest import Script, program, said, scripted

__all__ = ["scripted"]  # the fixture

FLANGE = Path(__file__).parents[3] / "examples/flange.step"


@pytest.fixture(autouse=True)
def _no_language_model(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.delenv("QUERYCAD_LLM_BASE_URL", raising=False)


@pytest.mark.parametrize(
    ("codegen", "reason"), [("llm", "no language model is set up"), ("oracle", "there are: parser, llm, both")]
)
def test_a_run_without_what_it_needs_does_not_begin(codegen: str, reason: str) -> None:
    with pytest.raises(UnknownSystem, match=reason):
        EmbeddedSystem(SystemOptions(codegen=codegen))


def test_a_run_tells_whose_program_answered_and_how_many_were_written(
    monkeypatch: pytest.MonkeyPatch, tmp_path: Path, scripted: Callable[[Script], str]
) -> None:
    replies = [said(program('solution = len(find_parts("hole"))')), *[said("prose")] * 3]
    monkeypatch.setenv("QUERYCAD_LLM_BASE_URL", scripted(Script(replies)))
    monkeypatch.setenv("QUERYCAD_LLM_MODEL", "m")
    system = EmbeddedSystem(SystemOptions(codegen="llm", llm_repairs=2, store=tmp_path))
    try:
        written = system.ask(FLANGE, "How many holes are there?")
        lost = system.ask(FLANGE, "How many holes are there?")
    finally:
        system.close()
    assert (written.value, written.codegen, written.attempts) == (11, "llm:m", 1)
    assert (lost.value, lost.codegen, lost.attempts) == (11, "parser", 3)
