"""The page on what can be asked tells the truth: every question of its table is asked."""

from __future__ import annotations

import re
from collections.abc import Iterator
from pathlib import Path

import pytest

from querycad.runtime import EmbeddedRuntime
from querycad_contracts import Status

ROOT = Path(__file__).parents[2]
PAGE = (ROOT / "docs" / "questions.md").read_text(encoding="utf-8")
TABLE = PAGE.partition("| on | question | answer | picture |\n|---|---|---|---|\n")[2].partition("\n\n")[0]
CELLS = [[cell.strip() for cell in line.strip("|").split("|")] for line in TABLE.splitlines()]
ROWS = [tuple(cells[:3]) for cells in CELLS]
PICTURES = [match[1] for cells in CELLS if (match := re.fullmatch(r"!\[[^]]+\]\((.+)\)", cells[3]))]


@pytest.fixture(scope="module")
def runtime(tmp_path_factory: pytest.TempPathFactory) -> Iterator[EmbeddedRuntime]:
    with EmbeddedRuntime(tmp_path_factory.mktemp("models")) as runtime:
        yield runtime


def test_the_page_is_one_page_with_a_table() -> None:
    assert len(PAGE.splitlines()) < 90
    assert len(ROWS) > 15


def test_some_answers_have_their_picture() -> None:
    assert len(PICTURES) > 5
    assert all((ROOT / "docs" / picture).read_bytes().startswith(b"\x89PNG") for picture in PICTURES)


@pytest.mark.parametrize(("model", "question", "answer"), ROWS, ids=[row[1] for row in ROWS])
def test_a_question_of_the_page_has_its_answer(
    runtime: EmbeddedRuntime, model: str, question: str, answer: str
) -> None:
    record = runtime.ask(ROOT / "examples" / f"{model}.step", question)
    if refused := re.fullmatch(r"\*(.+)\*", answer):
        assert record.failure is not None
        assert record.failure.message == refused[1]
    else:
        assert record.status is Status.ANSWERED
        assert record.answer is not None
        assert record.answer.text == answer
