"""`benchmark.writers`: the sample is the same for all who draw it, and what was asked in every way is compared."""

from __future__ import annotations

from collections import Counter
from dataclasses import replace
from pathlib import Path

import pytest
from benchmark import writers
from benchmark.understanding.data import Question
from benchmark.writers import AGENT, HELD, PARSER, SINGLE, Outcome, asked, differences, kept, sample, table, ways

from querycad_answering.llm import LlmSettings


def question(model: str, text: str, writer: str = "facts:nist") -> Question:
    return Question(model, Path("examples/flange.step"), writer, text, 11, "count")


@pytest.fixture
def source(monkeypatch: pytest.MonkeyPatch) -> list[Question]:
    found = [question(f"n{i % 7}", f"How many? {i}") for i in range(40)]
    found += [question(f"t{i % 3}", f"How many? {i}", "facts:ttt") for i in range(10)]
    found += [question(f"c{i % 4}", f"How many? {i}", "cad-qa") for i in range(20)]
    monkeypatch.setattr(writers, "questions", lambda: found)
    return found


@pytest.mark.usefixtures("source")
def test_a_sample_is_drawn_by_seed_in_proportion_and_model_by_model() -> None:
    wanted = {"facts-dev": 10, "CAD-Q&A": 5}
    drawn = sample(wanted, 18)
    assert drawn == sample(wanted, 18)
    assert drawn != sample(wanted, 19)
    assert Counter(name for name, _ in drawn) == wanted
    assert Counter(one.writer for _, one in drawn) == {"facts:nist": 8, "facts:ttt": 2, "cad-qa": 5}
    models = [one.model for _, one in drawn]
    assert models == sorted(models, key=list(dict.fromkeys(models)).index)


def test_without_a_language_model_the_parser_alone_is_asked_and_without_a_form_nobody_is_held_to_one() -> None:
    assert list(ways(LlmSettings())) == [PARSER]
    assert list(ways(LlmSettings(llm_command="true"))) == [PARSER, SINGLE, AGENT]
    held = ways(LlmSettings.model_validate({"llm_base_url": "http://127.0.0.1:1", "llm_constrained": "llama.cpp"}))
    assert list(held) == [PARSER, SINGLE, HELD, AGENT]
    assert [settings.constrained.value for _, settings in held.values()][1:] == ["none", "llama.cpp", "llama.cpp"]


def test_what_was_asked_is_kept_and_not_asked_again(tmp_path: Path) -> None:
    drawn = [("facts-dev", question("flange", "How many holes are there?"))]
    file = tmp_path / "outcomes.jsonl"
    (outcome,) = asked(drawn, ways(LlmSettings()), file, ())
    assert (outcome.right, outcome.value, outcome.stepped_in) == (True, 11, False)
    assert [replace(one, warnings=()) for one in kept(file)] == [replace(outcome, warnings=())]
    assert list(asked(drawn, ways(LlmSettings()), file, kept(file))) == []


def made(way: str, text: str, right: bool, codegen: str = "llm") -> Outcome:
    return Outcome(way, "facts-dev", "flange", text, 11, 11 if right else 2, right, "answered", codegen, 1, 9, 9, 1.0)


def test_only_what_was_asked_in_every_way_is_compared() -> None:
    both = [made(SINGLE, "one", True, "parser"), made(AGENT, "one", False), made(SINGLE, "two", True)]
    lines = list(table(both))
    assert lines[2].startswith("| facts-dev | 1 | llm | 1 | 0 | 0 | 1 |")
    assert lines[3].startswith("| facts-dev | 1 | agent | 0 | 1 | 0 | 0 |")
    told = "\n".join(differences(both, SINGLE, AGENT))
    assert told.startswith("llm: flange: one\n  11\n")
    assert "two" not in told
