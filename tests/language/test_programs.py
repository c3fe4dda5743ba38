"""Every form becomes a short program that the guest API understands, and says what type comes of it."""

from __future__ import annotations

from collections.abc import Iterator

import pytest
from tests.made import hole, whole

from querycad_contracts import AnswerType, Measure, Part, PartQuery, Relation, Side
from querycad_language.forms import (
    Angle,
    Boundary,
    Check,
    Combine,
    Count,
    Distance,
    Every,
    Exists,
    Form,
    Get,
    Parallel,
    Parts,
    Reduce,
    Uniform,
    queries,
)
from querycad_language.programs import Unwritable, write
from querycad_sandbox.check import TypeChecker

HOLES = PartQuery(noun="hole", plural=True)
OTHERS = PartQuery(noun="hole", adjectives=("blind",), sides=(Side.TOP,))
TWO = (hole(1, -20), hole(2, 20))
DEPTH = Get((Measure.DEPTH,), HOLES)
CASES: list[tuple[Form, AnswerType]] = [
    (DEPTH, AnswerType.LENGTH),
    (Get((Measure.DIAMETER,), HOLES, Reduce.EACH), AnswerType.LENGTHS),
    (Get((Measure.DEPTH,), HOLES, Reduce.TOTAL), AnswerType.LENGTH),
    (Get((Measure.DEPTH,), HOLES, Reduce.MEAN), AnswerType.LENGTH),
    (Get((Measure.POSITION,), HOLES), AnswerType.POINT),
    (Get((Measure.VOLUME,), None), AnswerType.VOLUME),
    (Get((Measure.MASS,), None, density=7850.0), AnswerType.NUMBER),
    (Get((Measure.CENTER_OF_MASS,), None), AnswerType.POINT),
    (Get((Measure.INERTIA,), None, density=7850.0), AnswerType.NUMBERS),
    (Get((Measure.APPROACH,), HOLES), AnswerType.DIRECTION),
    (Count(HOLES, Measure.MIRROR_PLANES), AnswerType.COUNT),
    (Distance(HOLES, OTHERS, "overlap"), AnswerType.VOLUME),
    (Check(Distance(HOLES, "each other", "overlap"), Relation.MORE, 0.0), AnswerType.BOOLEAN),
    (Count(HOLES), AnswerType.COUNT),
    (Count(HOLES, Measure.DIAMETER), AnswerType.COUNT),
    (Exists(HOLES), AnswerType.BOOLEAN),
    (Parts(HOLES), AnswerType.PARTS),
    (Distance(HOLES, "each other"), AnswerType.LENGTH),
    (Distance(HOLES, Boundary(Side.LEFT)), AnswerType.LENGTH),
    (Distance(HOLES, Boundary(None)), AnswerType.LENGTH),
    (Distance(HOLES, OTHERS, "surfaces"), AnswerType.LENGTH),
    (Angle(HOLES, OTHERS), AnswerType.ANGLE),
    (Combine("ratio", DEPTH, Get((Measure.DIAMETER,), HOLES)), AnswerType.NUMBER),
    (Combine("apart", DEPTH, Get((Measure.DEPTH,), OTHERS)), AnswerType.LENGTH),
    (Check(DEPTH, Relation.AT_LEAST, 0.004), AnswerType.BOOLEAN),
    (Check(DEPTH, Relation.BETWEEN, 0.004, 0.005), AnswerType.BOOLEAN),
    (Every(HOLES, OTHERS), AnswerType.BOOLEAN),
    (Uniform(DEPTH), AnswerType.BOOLEAN),
    (Parallel(HOLES, None), AnswerType.BOOLEAN),
]


@pytest.fixture(scope="module")
def checker() -> Iterator[TypeChecker]:
    made = TypeChecker(1)
    made.start()
    yield made
    made.close()


@pytest.mark.parametrize(("form", "kind"), CASES, ids=lambda case: type(case).__name__)
def test_a_form_becomes_a_program_that_passes_the_type_check(
    form: Form, kind: AnswerType, checker: TypeChecker
) -> None:
    grounds: dict[PartQuery, tuple[tuple[Part, ...], int]] = dict.fromkeys(queries(form), (TWO, 0))
    written = write(form, grounds, whole())
    assert written.expects is kind
    assert "solution = " in written.code
    assert checker.problems(written.code) == ()


def test_a_measure_of_no_part_is_not_written() -> None:
    with pytest.raises(Unwritable):
        write(DEPTH, {HOLES: ((), 0)}, whole())


def test_the_grounding_that_is_meant_is_named_by_its_sense() -> None:
    assert '"sense": 2' in write(DEPTH, {HOLES: (TWO, 2)}, whole()).code
    assert "sense" not in write(DEPTH, {HOLES: (TWO, 0)}, whole()).code


def test_all_steps_have_a_diameter_where_values_are_counted_or_listed() -> None:
    """A hole of 9 mm with a counterbore of 16 mm has both."""
    stepped = hole(1, 0, diameter=0.009, radius=0.0045, radii=(0.008, 0.0045))
    for form in (Count(HOLES, Measure.DIAMETER), Get((Measure.DIAMETER,), HOLES, Reduce.DIFFERENT)):
        assert "p.radii" in write(form, {HOLES: ((stepped,), 0)}, whole()).code
    assert "p.radii" not in write(Get((Measure.DIAMETER,), HOLES), {HOLES: ((stepped,), 0)}, whole()).code


def test_planes_through_the_axis_of_what_is_round_are_not_counted() -> None:
    turned = whole(tags=("symmetric", "rotational", "axisymmetric"))
    with pytest.raises(Unwritable):
        write(Count(HOLES, Measure.MIRROR_PLANES), {HOLES: ((turned,), 0)}, turned)
