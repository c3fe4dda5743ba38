"""A benchmark folder of two tiny models in the published layout, and a system that answers from a table."""

from __future__ import annotations

from collections.abc import Callable
from pathlib import Path

import pytest
from benchmark.scoring.systems import Reply, SystemOptions

from querycad_contracts import AnswerType


class TableSystem:
    """Answers by question; keeps what it was asked."""

    def __init__(self, table: dict[str, Reply | Exception], asked: list[str]) -> None:
        self._table, self._asked = table, asked
        self.closed = False

    def ask(self, file: Path, question: str) -> Reply:
        assert file.name == "cad.step"
        self._asked.append(question)
        reply = self._table[question]
        if isinstance(reply, Exception):
            raise reply
        return reply

    def close(self) -> None:
        self.closed = True


class TableOpener:
    """Opens `TableSystem`s, in place of `systems.open_system`."""

    def __init__(self, table: dict[str, Reply | Exception]) -> None:
        self.table, self.asked = table, list[str]()
        self.opened: list[TableSystem] = []

    def __call__(self, options: SystemOptions) -> TableSystem:
        self.opened.append(TableSystem(self.table, self.asked))
        return self.opened[-1]


ANSWERS: dict[str, Reply | Exception] = {
    "How many holes?": Reply(5, AnswerType.COUNT, code='solution = len(find_parts("hole"))', codegen="table"),
    "Which radii?": Reply([0.005, 0.0025], AnswerType.LENGTHS, seconds=0.25),
    "How wide?": Reply(0.14651, AnswerType.LENGTH),
    "Where is the slot?": Reply(failure="not_grounded", message="there is no slot"),
}


def write_model(folder: Path, questions: list[tuple[str, str, str]]) -> None:
    """One model in the published layout: question, label, metadata by line. The last metadata lines may be missing."""
    folder.mkdir(parents=True)
    (folder / "cad.step").write_text("ISO-10303-21;", encoding="utf-8")
    for number, name in enumerate(("input.txt", "solution.txt", "metadata.txt")):
        text = "\n".join(question[number] for question in questions).rstrip("\n")
        if text or number < 2:
            (folder / name).write_text(text, encoding="utf-8")


@pytest.fixture
def folder(tmp_path: Path) -> Path:
    """A benchmark of 2 models and 4 questions."""
    write_model(
        tmp_path / "tiny" / "abc" / "001", [("Which radii?", "[0.0025, 0.005]", "sorted"), ("How many holes?", "4", "")]
    )
    write_model(
        tmp_path / "tiny" / "shop" / "bracket",
        [("How wide?", "0.14662", ""), ("Where is the slot?", "[0.0, 0.01, 0.0]", "")],
    )
    return tmp_path / "tiny"


@pytest.fixture
def opener() -> TableOpener:
    """Opens the system that answers from `ANSWERS`."""
    return TableOpener(dict(ANSWERS))


@pytest.fixture
def adapter(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> str:
    """The name of a system in a module of its own, as another project would bring it."""
    (tmp_path / "their_adapter.py").write_text(ADAPTER, encoding="utf-8")
    monkeypatch.syspath_prepend(str(tmp_path))
    return "their_adapter:Theirs"


ADAPTER = """
from benchmark.scoring.systems import Reply

class Theirs:
    def __init__(self, options):
        pass

    def ask(self, file, question):
        return Reply(value=4 if question.startswith("How many") else 0.1)

    def close(self):
        pass
"""

WriteModel = Callable[[Path, list[tuple[str, str, str]]], None]


@pytest.fixture(name="write_model")
def _write_model() -> WriteModel:
    return write_model
