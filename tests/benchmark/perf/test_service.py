"""What the service's benchmark says holds, does."""

from __future__ import annotations

import io

import pytest
from benchmark.perf.service import Chaos, Figure, ServiceReport, print_report
from rich.console import Console

ALL_WELL = Chaos(asked=5, accepted=4, answered=3, failed=1, lost=0, changed=0, blows=("api killed",), seconds=1.0)


def test_questions_that_all_ended_once_hold() -> None:
    assert ALL_WELL.holds


@pytest.mark.parametrize(
    "trouble", [{"lost": 1, "answered": 2}, {"changed": 1}, {"answered": 2}, {"accepted": 5}], ids=str
)
def test_a_question_that_is_lost_or_answered_twice_does_not_hold(trouble: dict[str, int]) -> None:
    assert not ALL_WELL.model_copy(update=trouble).holds


def test_the_table_tells_every_figure_and_whether_it_holds() -> None:
    figures = (
        Figure(name="question to answer, p50", value=12.3, unit="ms", target="< 100", holds=True),
        Figure(name="answers", value=1.5, unit="1/s", target=">= 30", holds=False),
    )
    told = io.StringIO()
    print_report(ServiceReport(figures=figures, chaos=ALL_WELL), Console(file=told, width=200))
    lines = told.getvalue().splitlines()
    assert [line for line in lines if "12.3 ms" in line and "yes" in line]
    assert [line for line in lines if "1.5 1/s" in line and "no" in line]
    assert "5 asked, 4 accepted, 3 answered, 1 failed clearly, 0 lost" in told.getvalue()
