"""A rule needs two independent examples: every frame's docstring asks two questions, and the frame reads each."""

from __future__ import annotations

import inspect
import pkgutil
import re
from collections.abc import Callable, Iterator
from importlib import import_module
from typing import Any

import pytest

from querycad_language.readings import frames
from querycad_language.readings.frames.values import values
from querycad_language.readings.reader import FRAMES, Reader

EXAMPLE = re.compile(r"'([^']+\?)'")
WITHIN_VALUES = {"material": "material_", "less": "less_part", "of_related": "its_"}
"""Frames that are given a value which was read, by the features of their drafts."""
LEAST = 2


def functions() -> Iterator[Callable[..., Any]]:
    """All frames: what gives drafts and is not private to its module."""
    for info in pkgutil.iter_modules(frames.__path__):
        module = import_module(f"{frames.__name__}.{info.name}")
        for name, value in vars(module).items():
            own = inspect.isfunction(value) and value.__module__ == module.__name__ and not name.startswith("_")
            if own and "Iterator[Parse]" in str(inspect.signature(value).return_annotation):
                yield value


ALL = list(functions())


def test_the_readers_frames_are_among_them() -> None:
    assert set(FRAMES) <= set(ALL)


@pytest.mark.parametrize("frame", ALL, ids=lambda frame: frame.__name__)
def test_a_frame_reads_both_of_its_examples(frame: Callable[..., Any]) -> None:
    examples = EXAMPLE.findall(inspect.getdoc(frame) or "")
    assert len(set(examples)) >= LEAST
    for example in examples:
        if (feature := WITHIN_VALUES.get(frame.__name__)) is not None:
            drafts = [d for d in values(Reader(example)) if any(name.startswith(feature) for name in d.features)]
        else:
            drafts = list(frame(Reader(example)))
        assert drafts, example
