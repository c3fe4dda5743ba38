"""What a merge request shows of a run."""

from __future__ import annotations

from pathlib import Path
from xml.etree import ElementTree

from benchmark.scoring.compare import compare
from benchmark.scoring.floor import Count, Fall
from benchmark.scoring.results import Result, Results
from benchmark.scoring.summaries import junit, markdown, markdown_comparison


def result(index: int, right: bool, answer: str | None = "5") -> Result:
    return Result(
        set="abc",
        id="1",
        index=index,
        question=f"How many | {index}?",
        answer=answer,
        label="4",
        strict=right,
        tolerant=right,
        status="answered",
        seconds=0.25,
        message="" if answer else "not understood",
    )


BEFORE = Results(benchmark="tiny", results=(result(0, True), result(1, False), result(2, False, None)))
AFTER = Results(benchmark="tiny", results=(result(0, False), result(1, True), result(2, False, None)))
FALL = Fall(
    benchmark="tiny",
    set="abc",
    floor=Count(questions=3, strict=2, tolerant=2),
    now=Count(questions=3, strict=1, tolerant=1),
)


def test_the_summary_counts_and_says_what_is_below_the_floor() -> None:
    assert "| tiny, abc | 3 | 1 | 1 |" in markdown([AFTER], [])
    assert "Nothing is below the floor" in markdown([AFTER], [])
    assert "**Below the floor**: tiny, abc: 1 strict" in markdown([AFTER], [FALL])


def test_a_comparison_names_what_was_fixed_and_broken() -> None:
    text = markdown_comparison(compare(BEFORE, AFTER))
    assert "Fixed 1, broken 1." in text
    assert "| How many \\| 0? | 5 | 5 | 4 |" in text.partition("### Fixed")[0]


def test_questions_are_tests_and_the_floor_is_one(tmp_path: Path) -> None:
    junit([AFTER], [FALL], tmp_path / "deep/junit.xml")
    (suite,) = ElementTree.parse(tmp_path / "deep/junit.xml").getroot()  # noqa: S314 - written just now
    assert (suite.attrib["tests"], suite.attrib["failures"], suite.attrib["skipped"]) == ("4", "1", "2")
    assert len(suite) == 4
    assert [case.find("failure") is not None for case in suite] == [True, False, False, False]
    assert [skipped.attrib["message"] for skipped in suite.iter("skipped")] == [
        "5 (label 4)",
        "not understood (label 4)",
    ]
