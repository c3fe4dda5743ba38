"""The committed question files: what they cover and whether they are well formed; no CAD kernel needed."""

from __future__ import annotations

import math
from collections import Counter
from typing import Any

import pytest
from benchmark.card import KINDS, PROPERTIES, README, read, tables

from querycad_contracts import AnswerType

FILES = read()
ITEMS = [item for file in FILES for item in file["items"]]


def test_there_are_at_least_24_models_and_300_questions() -> None:
    assert len(FILES) >= 24
    assert len(ITEMS) >= 300


def test_the_paper_has_43_kinds_of_part_and_11_properties() -> None:
    assert len(set(KINDS)) == 43
    assert len(set(PROPERTIES)) == 11


@pytest.mark.parametrize("kind", KINDS)
def test_every_kind_of_part_is_asked_about(kind: str) -> None:
    assert kind in {item["tags"]["part"] for item in ITEMS}


@pytest.mark.parametrize("measure", PROPERTIES)
def test_every_property_is_asked_for_in_both_halves(measure: str) -> None:
    halves = {file["split"] for file in FILES for item in file["items"] if item["tags"]["property"] == measure}
    assert halves == {"dev", "held_out"}


def test_a_part_of_the_questions_is_held_out() -> None:
    number = Counter(file["split"] for file in FILES for _ in file["items"])
    assert set(number) == {"dev", "held_out"}
    assert number["held_out"] >= 60  # what is held out becomes `dev` once its failures are looked at


def test_files_differ_in_form_unit_and_number_of_bodies() -> None:
    assert {file["form"] for file in FILES} == {"solid", "b-spline", "loose surfaces"}
    assert {file["unit"] for file in FILES} == {"mm", "in"}
    assert {file["bodies"] == 1 for file in FILES} == {True, False}


@pytest.mark.parametrize("file", FILES, ids=lambda file: str(file["model"]))
def test_no_question_is_asked_twice_of_a_model(file: dict[str, Any]) -> None:
    questions = [item["question"].lower() for item in file["items"]]
    assert len(set(questions)) == len(questions)


def test_wordings_vary() -> None:
    openings = Counter(" ".join(item["question"].lower().split()[:3]) for item in ITEMS)
    assert len(openings) >= len(ITEMS) / 3
    assert len({item["question"] for item in ITEMS}) >= 0.95 * len(ITEMS)


@pytest.mark.parametrize("file", FILES, ids=lambda file: str(file["model"]))
def test_values_are_of_their_type(file: dict[str, Any]) -> None:
    for item in file["items"]:
        value, kind = item["value"], AnswerType(item["type"])
        if kind is AnswerType.COUNT:
            assert isinstance(value, int)
            assert value >= 0
        elif kind in {AnswerType.LENGTH, AnswerType.AREA, AnswerType.VOLUME}:
            assert 0 < value < 1
        elif kind is AnswerType.LENGTHS:
            assert value == sorted(value)
            assert all(0 < entry < 1 for entry in value)
            assert len(value) > 1
        elif kind is AnswerType.SIZE:
            assert len(value) == 3
            assert all(0 < entry < 1 for entry in value)
        elif kind is AnswerType.POINT:
            assert len(value) == 3
        elif kind is AnswerType.ANGLE:
            assert 0 < value <= math.pi
        elif kind is AnswerType.BOOLEAN:
            assert isinstance(value, bool)
        elif kind is AnswerType.TEXT:
            assert isinstance(value, str)
            assert value
        elif kind is AnswerType.TEXTS:
            assert all(isinstance(entry, str) and entry for entry in value)
            assert value == sorted(value)
        else:
            assert kind is AnswerType.POINTS
            assert len(value) > 1
            assert all(len(entry) == 3 for entry in value)
            assert value == sorted(value)


def test_the_data_card_shows_the_counts_of_the_files() -> None:
    assert tables() in README.read_text()
