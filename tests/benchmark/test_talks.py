"""The questions of `benchmark.talks`: their truths are computed, their topics covered, and what is right is told."""

from __future__ import annotations

from collections import Counter
from pathlib import Path

import pytest
from benchmark.talks.__main__ import ask, is_stale, talks

import querycad

EXAMPLES = Path(__file__).parents[2] / "examples"


@pytest.fixture(autouse=True)
def _examples(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.syspath_prepend(str(EXAMPLES))


def test_three_hands_ask_80_questions_and_more_about_every_topic() -> None:
    found = list(talks())
    assert len(found) >= 80
    assert len({one.hand for one in found}) >= 3
    topics = Counter(one.topic for one in found)
    assert set(topics) == {
        "callout", "ids", "totals", "tables", "units", "follow-ups", "assembly", "declined", "mass",
    }  # fmt: skip


def test_no_question_is_asked_twice_of_a_model() -> None:
    asked = Counter((one.model, one.question, one.before, one.select) for one in talks())
    assert max(asked.values()) == 1


def test_truths_are_in_si_units_and_come_from_the_scripts() -> None:
    found = {(one.model, one.question): one.truth for one in talks()}
    assert found["own:drill_jig", "Diameter of hole 4 in inches"] == pytest.approx(0.005)
    assert found["own:machine_stand", "How many holes altogether?"] == 16


def test_ids_questions_of_the_flange_are_right_and_none_is_renumbered() -> None:
    flange = querycad.open(EXAMPLES / "flange.step")
    asked = [one for one in talks() if one.model == "own:flange" and one.topic in ("ids", "tables", "declined")]
    assert len(asked) >= 6
    assert not [one.question for one in talks() if one.model == "own:flange" and is_stale(one, flange)]
    assert [one.question for one in asked if not ask(one, flange).right] == []
