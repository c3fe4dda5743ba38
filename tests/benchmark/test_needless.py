"""A statement that is left out changes what is read, and is there again afterwards."""

from __future__ import annotations

from pathlib import Path

from benchmark.needless.__main__ import Asked, lost, reached, statements, without

import querycad_language
from querycad_language.forms import Get
from querycad_language.readings import read

MODULE = Path(querycad_language.__file__).parent / "readings/frames/values.py"
QUESTION = "How deep is the dovetail?"


def asked() -> list[Asked]:
    form = next(reading.form for reading in read(QUESTION) if isinstance(reading.form, Get))
    return [Asked(QUESTION, (), form)]


def test_what_gives_the_reading_is_needed_and_what_no_question_reaches_is_not() -> None:
    every = asked()
    lines = reached(every)
    found = list(statements(MODULE))
    needed = [one for one in found if lost(one, every, sorted(lines.get((one.module, one.reached), ())), 0) is None]
    assert any("values" in one.function for one in needed)
    assert any("density_of" in one.function for one in found)
    assert not any("density_of" in one.function and one.reached > one.first for one in needed)


def test_the_function_is_whole_again() -> None:
    before = [reading.form for reading in read(QUESTION)]
    for one in list(statements(MODULE))[:20]:
        with without(one):
            pass
    assert [reading.form for reading in read(QUESTION)] == before
