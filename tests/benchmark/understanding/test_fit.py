"""Weights are learned from answers alone, and judged on writers and models that they have not seen."""

from __future__ import annotations

import tomllib
from pathlib import Path

import pytest
from benchmark.understanding.affinity import Pairs
from benchmark.understanding.collect import Row, Tried
from benchmark.understanding.compare import compared
from benchmark.understanding.cross_validation import (
    AT_WORK_COUNT,
    Told,
    balanced,
    calibration_error,
    cross_validated,
    fitted,
    fold_of,
    risk_and_coverage,
)
from benchmark.understanding.data import MISSING, Question, is_right
from benchmark.understanding.fit import answered, fit
from benchmark.understanding.table import _inline
from tests.made import hole, whole

from querycad_answering import affinity
from querycad_answering.affinity import FEATURE, Affinity, packed, unpacked
from querycad_answering.part_traits import part_traits
from querycad_contracts import Grounded
from querycad_language.text import Text


def question(writer: str = "w", model: str = "own:a", truth: object = 1.0, kind: str = "length") -> Question:
    return Question(model, Path("a.step"), writer, "?", truth, kind)


def row(writer: str, model: str, *, misleading: bool = False) -> Row:
    """The candidate with the telling feature is right, unless the row misleads."""
    right = Tried({"telling": 1.0, "common": 1.0}, 1.0, not misleading, "a")
    wrong = Tried({"common": 1.0, "noise": 1.0}, 2.0, misleading, "b")
    return Row(question(writer, model), (right, wrong))


def test_what_tells_right_values_from_wrong_ones_gets_the_weight() -> None:
    rows = [row("w", f"own:{i}", misleading=i % 10 == 0) for i in range(50)]
    table = fit(rows, {})
    assert table["telling"] > 0.5
    assert table["noise"] < 0
    assert answered(rows[1], table).right


def test_where_no_candidate_is_right_none_gets_the_share() -> None:
    hopeless = Row(question("w", "own:x"), (Tried({"odd": 1.0}, 3.0, False, "c"),))
    rows = [row("w", f"own:{i}") for i in range(50)] + [hopeless] * 50
    table = fit(rows, {})
    assert answered(rows[0], table).probability > 0.5 > answered(hopeless, table).probability


def test_that_the_part_is_not_there_is_learned_as_an_answer_of_its_own() -> None:
    """A guess is right where the part is there, and a refusal where it is not."""
    guess = {"named": Tried({"named": 1.0}, 1.0, True, "a"), "guessed": Tried({"guessed": 1.0}, 1.0, False, "b")}
    absent = {"named": Tried({"absent": 1.0}, None, False, "", absent=True)}
    absent["guessed"] = Tried({"absent": 1.0}, None, True, "", absent=True)
    there = [Row(question("w", f"own:{i}"), (guess["named"], absent["named"])) for i in range(50)]
    missing = [
        Row(question("absent_w", f"own:{i}", None, MISSING), (guess["guessed"], absent["guessed"])) for i in range(50)
    ]
    table = fit([*there, *missing], {})
    assert (answered(there[0], table).right, answered(there[0], table).refused) == (True, False)
    assert (answered(missing[0], table).right, answered(missing[0], table).refused) == (True, True)


def test_questions_as_people_ask_at_work_count_more_often() -> None:
    rows = [row(writer, "specified:a") for writer in ("specifier", "peg_assembler", "reworded-jobshop_texter")]
    writers = [one.question.writer for one in balanced(rows)]
    assert [writers.count(one.question.writer) for one in rows] == [1, AT_WORK_COUNT, AT_WORK_COUNT]


def test_words_tell_programs_apart_that_have_the_same_features_otherwise() -> None:
    """'Bore' is said where the second of two measures is meant: no feature knows, the pairs of words do."""
    rows = []
    for i in range(60):
        bored = i % 2 == 0
        first = Tried({"height as {0}.height": 1.0}, 1.0, not bored, "a")
        second = Tried({"height as {0}.depth": 1.0}, 2.0, bored, "b")
        asked = Question(
            f"own:{i}", Path("a.step"), "w", "How high is the bore?" if bored else "How high is it?", 1.0, ""
        )
        rows.append(Row(asked, (first, second)))
    pairs, table = Pairs(rows), fit(rows, {})
    assert not all(answered(one, table).right for one in rows)
    scored = pairs.scored(rows, pairs.fitted(rows, table))
    assert all(answered(one, {**table, FEATURE: 1.0}).right for one in scored)
    product = Affinity(Text(rows[0].question.question).words, whole())
    assert product.of(rows[0].tried[0].features) == product.of(dict(rows[0].tried[0].features))


def test_words_tell_parts_apart_and_the_product_says_of_them_what_was_fitted(monkeypatch: pytest.MonkeyPatch) -> None:
    """Nothing but the parts differs: the drain is the lower one."""
    high, low = (Grounded(parts=(hole(1, x=x),), features={}) for x in (-45, 45))
    model = whole()
    rows = []
    for i in range(60):
        drain = i % 2 == 0
        said = "Where is the drain?" if drain else "Where is the vent?"
        tried = tuple(
            Tried({"form_get": 1.0}, value, (way is low) == drain, name, parts=(part_traits(way, model),))
            for value, way, name in ((1.0, high, "a"), (2.0, low, "b"))
        )
        rows.append(Row(Question(f"own:{i}", Path("a.step"), "w", said, 1.0, ""), tried))
    pairs, table = Pairs(rows), fit(rows, {})
    weights = pairs.fitted(rows, table)
    scored = pairs.scored(rows, weights)
    assert all(answered(one, {**table, FEATURE: 1.0}).right for one in scored)
    monkeypatch.setattr(affinity, "_table", lambda: unpacked(packed(list(weights))))
    for one in scored[:2]:
        product = Affinity(Text(one.question.question).words, model)
        for each, way in zip(one.tried, (high, low), strict=True):
            said_of_it = product.of({"form_get": 1.0}, [way])
            assert said_of_it == pytest.approx(each.features[FEATURE], abs=0.05 * abs(weights).max())


def test_two_collections_are_compared_question_by_question() -> None:
    old, new = [row("w", "own:a")], [row("w", "own:a", misleading=True)]
    told = compared(old, new)
    assert "1 right, 1 reachable" in told or "of 1 right" in told


def test_several_programs_with_one_value_add_up() -> None:
    tried = [Tried({"a": 1.0}, 1.0, True, "a"), Tried({"b": 1.0}, 1.0, True, "b"), Tried({"c": 1.0}, 2.0, False, "c")]
    told = answered(Row(question(), tuple(tried)), {"a": 0.0, "b": 0.0, "c": 0.5})
    assert told.right
    assert told.probability == pytest.approx(2 / (2 + 1.6487), abs=1e-3)


def test_no_question_is_judged_by_weights_that_saw_its_writer_or_model() -> None:
    """One writer means the opposite of all others: seen, its questions would be right; left out, none is."""
    rows = [row(f"w{i % 4}", f"own:{i}") for i in range(40)]
    odd = [row("odd", f"own:odd{i}", misleading=True) for i in range(400)]
    everything = [*rows, *odd]
    assert answered(odd[0], fitted(everything, {}, Pairs(everything))[0]).right
    told, _ = cross_validated([*rows, *odd], {})
    assert not any(one.right for one in told if one.writer == "odd")


def test_writers_are_folds_and_the_first_questions_are_parted_by_model() -> None:
    assert fold_of(row("cad_chat", "own:a")) == fold_of(row("cad_chat", "specified:b")).replace("specified", "asked")
    assert fold_of(row("reworded-x", "specified:a")).startswith("reworded-")
    assert fold_of(row("facts:nist", "own:a")) == fold_of(row("facts:ttt", "own:b")) == "facts"
    assert fold_of(row("own", "own:a")).startswith("own-")


def test_confidence_that_is_honest_has_no_calibration_error() -> None:
    honest = [Told("f", "w", i < 7, True, False, 0.7) for i in range(10)]
    boasting = [Told("f", "w", i < 5, True, False, 0.95) for i in range(10)]
    assert calibration_error(honest) == pytest.approx(0.0, abs=1e-9)
    assert calibration_error(boasting) == pytest.approx(0.45)
    threshold, coverage, risk = risk_and_coverage(honest)[0]
    assert (threshold, coverage) == (0.0, 1.0)
    assert risk == pytest.approx(0.3)


@pytest.mark.parametrize(
    ("value", "truth", "kind", "right"),
    [
        (0.01005, 0.01, "length", True),
        (0.0102, 0.01, "length", False),
        ([0.01, 0.01], 0.01, "length", True),
        ([0.01, 0.02], 0.01, "length", False),
        ([0.02, 0.01], [0.01, 0.02], "lengths", True),
        (4, 4, "count", True),
        (5, 4, "count", False),
        (True, True, "boolean", True),
        (1, True, "boolean", False),
        ([0.03, 0.02, 0.01], [0.01, 0.02, 0.03], "size", True),
        ([0.03, 0.02, 0.01], [0.01, 0.02, 0.03], "point", False),
        ("Front", "front", "text", True),
        (["z", "z"], "z", "text", True),
        (["z", "x"], "z", "text", False),
        (None, 0.01, "length", False),
    ],
)
def test_a_value_is_right_within_what_drawings_mean(value: object, truth: object, kind: str, right: bool) -> None:
    assert is_right(value, question(truth=truth, kind=kind)) is right


def test_weights_are_written_as_toml_whatever_their_names_hold() -> None:
    table = {'sum(f.area for f in faces(facing="bottom"))': 0.5, "{0}.depth": -1.0, "next to nothing": 0.001}
    written = tomllib.loads(f"depth = {_inline(table)}")
    assert written == {"depth": {name: weight for name, weight in table.items() if abs(weight) > 0.01}}
