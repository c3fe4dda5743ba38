"""Modules and folders stay small enough to read, and no question of the benchmark is written into what answers it."""

from __future__ import annotations

import json
import re
from collections import Counter
from collections.abc import Iterator
from pathlib import Path
from typing import Any

ROOT = Path(__file__).parents[2]
MAX_LINES = 500
MAX_MODULES = 20
MIN_WORDS = 3
"""Shorter ones, 'bbox' say, are words of the language."""
ENTRIES = ("__init__.py", "__main__.py")
ONE_A_MODEL = ("benchmark/models", "benchmark/last_look/models")
READERS = (
    "packages/language",
    "services/segworker/querycad_segworker/grounding",
    "tests/language",
    "tests/segworker/grounding",
)


def sources(*folders: str) -> Iterator[Path]:
    for folder in folders:
        yield from (path for path in (ROOT / folder).rglob("*.py") if "build" not in path.relative_to(ROOT).parts)


def test_no_module_is_longer_than_500_lines() -> None:
    lengths = {
        str(path.relative_to(ROOT)): len(path.read_text(encoding="utf-8").splitlines())
        for path in sources("packages", "services", "benchmark", "tests", "examples")
    }
    assert {name: length for name, length in lengths.items() if length > MAX_LINES} == {}


def test_no_folder_holds_more_than_20_modules() -> None:
    modules = (path for path in sources("packages", "services", "benchmark") if path.name not in ENTRIES)
    counts = Counter(str(path.parent.relative_to(ROOT)) for path in modules)
    assert {name: count for name, count in counts.items() if count > MAX_MODULES and name not in ONE_A_MODEL} == {}


def questions(data: Any) -> Iterator[str]:
    """Every question in a file of questions, however deep."""
    if isinstance(data, dict):
        yield from (data[key] for key in ("question",) if isinstance(data.get(key), str))
        data = list(data.values())
    if isinstance(data, list):
        for item in data:
            yield from questions(item)


def plain(text: str) -> str:
    return re.sub(r"\s+", " ", text).casefold()


def test_no_question_of_the_benchmark_stands_in_what_reads_it_or_in_its_tests() -> None:
    files = [
        *ROOT.glob("benchmark/questions/*.json"),
        *ROOT.glob("benchmark/asked/*.json"),
        *ROOT.glob("benchmark/last_look/*.json"),
        *ROOT.glob("benchmark/missing/*.json"),
        *ROOT.glob("benchmark/plain/*.json"),
        *ROOT.glob("benchmark/reworded/*.json"),
        *ROOT.glob("benchmark/specified/*.json"),
        *ROOT.glob("benchmark/talks/*.json"),
        *ROOT.glob("examples/*.questions.json"),
    ]
    asked = {plain(one) for path in files for one in questions(json.loads(path.read_text(encoding="utf-8")))}
    asked = {one for one in asked if len(one.split()) >= MIN_WORDS}
    assert len(asked) > 1000
    found = {}
    for folder in READERS:
        for path in (ROOT / folder).rglob("*"):
            if path.suffix in (".py", ".toml", ".json", ".md"):
                text = plain(path.read_text(encoding="utf-8"))
                if copied := sorted(one for one in asked if one in text):
                    found[str(path.relative_to(ROOT))] = copied
    assert found == {}
