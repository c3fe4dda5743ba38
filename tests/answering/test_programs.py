"""Every form becomes a short program that the guest API understands, and says what type comes of it."""

from __future__ import annotations

import math
from collections.abc import Iterator
from typing import Any

import pytest
from tests.made import body, hole, part, whole

from querycad_answering.programs import Unwritable, write
from querycad_answering.programs.meanings import options
from querycad_contracts import AnswerType, Measure, Part, PartQuery, Relation, Side
from querycad_language.forms import (
    LONGEST,
    SHORTER,
    Angle,
    AtBothEnds,
    Boundary,
    Check,
    Combine,
    Count,
    Distance,
    Every,
    Exists,
    Facing,
    Form,
    Get,
    MassCentre,
    Origin,
    Parallel,
    Parts,
    Plane,
    Reduce,
    Several,
    Towards,
    Uniform,
    queries,
)
from querycad_sandbox.check import TypeChecker

HOLES = PartQuery(noun="hole", plural=True)
OTHERS = PartQuery(noun="hole", adjectives=("blind",), sides=(Side.TOP,))
PINS, LEVERS = PartQuery(noun="pin", plural=True), PartQuery(noun="lever")
TWO = (hole(1, -20), hole(2, 20))
BODIES = (body(1, "pin"), body(2, "lever"))
DEPTH = Get((Measure.DEPTH,), HOLES)
CASES: list[tuple[Form, AnswerType]] = [
    (DEPTH, AnswerType.LENGTH),
    (Get((Measure.DIAMETER,), HOLES, Reduce.EACH), AnswerType.LENGTHS),
    (Get((Measure.DEPTH,), HOLES, Reduce.TOTAL), AnswerType.LENGTH),
    (Get((Measure.DEPTH,), HOLES, Reduce.MEAN), AnswerType.LENGTH),
    (Get((Measure.POSITION,), HOLES), AnswerType.POINT),
    (Get((Measure.FLOOR_CENTER,), HOLES), AnswerType.POINT),
    (Get((Measure.MIN_CORNER,), None), AnswerType.POINT),
    (Get((Measure.MAX_CORNER,), None), AnswerType.POINT),
    (Get((Measure.VOLUME,), None), AnswerType.VOLUME),
    (Get((Measure.MASS,), None, density=7850.0), AnswerType.NUMBER),
    (Get((Measure.CENTER_OF_MASS,), None), AnswerType.POINT),
    (Get((Measure.INERTIA,), None, density=7850.0), AnswerType.NUMBERS),
    (Get((Measure.APPROACH,), HOLES), AnswerType.DIRECTION),
    (Count(HOLES, Measure.MIRROR_PLANES), AnswerType.COUNT),
    (Distance(PINS, LEVERS, "overlap"), AnswerType.VOLUME),
    (Distance(HOLES, "each other", "outsides"), AnswerType.LENGTH),
    (Distance(HOLES, Plane(None, LEVERS)), AnswerType.LENGTH),
    (Distance(Plane(Side.TOP, PINS), Plane(None, LEVERS)), AnswerType.LENGTH),
    (
        Several((Distance(HOLES, "each other", axis=LONGEST), Distance(HOLES, "each other", axis=SHORTER))),
        AnswerType.LENGTHS,
    ),
    (Check(Distance(PINS, "each other", "overlap"), Relation.MORE, 0.0), AnswerType.BOOLEAN),
    (Count(HOLES), AnswerType.COUNT),
    (Count(HOLES, Measure.DIAMETER), AnswerType.COUNT),
    (Exists(HOLES), AnswerType.BOOLEAN),
    (AtBothEnds(HOLES), AnswerType.BOOLEAN),
    (Towards(HOLES, tuple(Side), "none"), AnswerType.TEXTS),
    (Combine("share", Count(HOLES), Count(OTHERS)), AnswerType.NUMBER),
    *((Distance(MassCentre(), other), AnswerType.LENGTH) for other in (None, Origin(), HOLES, Boundary(Side.TOP))),
    (Distance(Plane(Side.TOP, PINS), MassCentre()), AnswerType.LENGTH),
    (Parts(HOLES), AnswerType.PARTS),
    (Distance(HOLES, "each other"), AnswerType.LENGTH),
    (Distance(HOLES, Boundary(Side.LEFT)), AnswerType.LENGTH),
    (Distance(HOLES, Boundary(None)), AnswerType.LENGTH),
    (Distance(HOLES, OTHERS, "surfaces"), AnswerType.LENGTH),
    (Angle(HOLES, OTHERS), AnswerType.ANGLE),
    (Check(Angle(HOLES, OTHERS), Relation.EQUAL, 1.5), AnswerType.BOOLEAN),
    (Get((Measure.CROSS_SECTION_AREA,), HOLES), AnswerType.AREA),
    (Combine("ratio", DEPTH, Get((Measure.DIAMETER,), HOLES)), AnswerType.NUMBER),
    (Combine("apart", DEPTH, Get((Measure.DEPTH,), OTHERS)), AnswerType.LENGTH),
    (Check(Combine("ratio", DEPTH, Get((Measure.DEPTH,), OTHERS)), Relation.EQUAL, 2.0), AnswerType.BOOLEAN),
    (Facing(HOLES, None, "across"), AnswerType.BOOLEAN),
    (Facing(HOLES, OTHERS, "opposite"), AnswerType.BOOLEAN),
    (Parallel(HOLES, OTHERS, in_line="axis"), AnswerType.BOOLEAN),
    (Parallel(HOLES, OTHERS, in_line="row"), AnswerType.BOOLEAN),
    (Check(Distance(Plane(None, PINS), Plane(None, LEVERS), "beyond both"), Relation.MORE, 0.0), AnswerType.BOOLEAN),
    (Check(Distance(HOLES, OTHERS), Relation.EQUAL, Distance(HOLES, LEVERS)), AnswerType.BOOLEAN),
    (Get((Measure.OPENING,), OTHERS), AnswerType.POINT),
    (Get((Measure.SIZE,), None, Reduce.LARGEST), AnswerType.LENGTH),
    (Check(DEPTH, Relation.AT_LEAST, 0.004), AnswerType.BOOLEAN),
    (Check(DEPTH, Relation.BETWEEN, 0.004, 0.005), AnswerType.BOOLEAN),
    (Every(HOLES, OTHERS), AnswerType.BOOLEAN),
    (Uniform(DEPTH), AnswerType.BOOLEAN),
    (Parallel(HOLES, None), AnswerType.BOOLEAN),
]


@pytest.mark.parametrize("places", [((20, 0), (0, 20), (-20, 0)), ((20, 0), (-20, 0))])
@pytest.mark.parametrize(("measure", "size"), [(Measure.DIAMETER, 0.04), (Measure.RADIUS, 0.02)])
def test_the_circle_of_holes_that_are_no_pattern_runs_through_their_centres(
    places: tuple[tuple[float, float], ...], measure: Measure, size: float
) -> None:
    circle, holes = PartQuery(noun="pitch circle"), tuple(hole(i, x, y) for i, (x, y) in enumerate(places))
    written = write(Get((measure,), circle), {circle: (holes, 0)}, whole())
    values: dict[str, Any] = {"find_parts": lambda _: holes}
    exec(written.code, values)  # noqa: S102 - our own program
    assert values["solution"] == pytest.approx(size)


def test_four_holes_that_are_no_pattern_have_no_circle() -> None:
    circle = PartQuery(noun="pitch circle")
    with pytest.raises(Unwritable):
        write(Get((Measure.DIAMETER,), circle), {circle: (tuple(hole(i, 10 * i**2) for i in range(4)), 0)}, whole())


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
    grounds = {query: (BODIES if query in (PINS, LEVERS) else TWO, 0) for query in queries(form)}
    written = write(form, grounds, whole())
    assert written.expects is kind
    assert "solution = " in written.code
    assert checker.problems(written.code) == ()


def test_a_rectangle_has_four_corners() -> None:
    sides = Distance(HOLES, "each other", "centers", reduce=Reduce.SIDES)
    written = write(sides, {HOLES: (tuple(hole(i, 20 * i) for i in range(1, 5)), 0)}, whole())
    assert written.expects is AnswerType.LENGTHS
    with pytest.raises(Unwritable):
        write(sides, {HOLES: (TWO, 0)}, whole())


def test_a_measure_of_no_part_is_not_written() -> None:
    with pytest.raises(Unwritable):
        write(DEPTH, {HOLES: ((), 0)}, whole())


@pytest.mark.parametrize(
    "form",
    [
        Check(Get((Measure.ANGLE,), PINS), Relation.EQUAL, 1.5),
        Uniform(Get((Measure.DEPTH,), PINS)),
        Parallel(PINS, None),
        Check(Distance(PINS, HOLES), Relation.MORE, 0.01),
    ],
)
def test_of_parts_that_are_not_there_nothing_is_true_or_false(form: Form) -> None:
    grounds = {query: ((), 0) if query == PINS else (TWO, 0) for query in queries(form)}
    with pytest.raises(Unwritable):
        write(form, grounds, whole())


def test_the_end_of_a_part_is_where_its_tip_is() -> None:
    boss = part("boss-1", tip=(0.0, 0.0, 0.1), tips=((0.0, 0.0, 0.1),))
    end, shaft = PartQuery(noun="end"), PartQuery(noun="shaft")
    for target, expression in ((end, "p.tip"), (shaft, "p.center")):
        written = write(Get((Measure.POSITION,), target), {target: ((boss,), 0)}, whole())
        assert f"[{expression} for p in parts]" in written.code


def test_all_of_several_distances_are_compared() -> None:
    levels = Check(Distance(Plane(Side.TOP, OTHERS), HOLES), Relation.AT_LEAST, 0.01)
    written = write(
        levels, {HOLES: ((hole(1, 0), hole(2, 20, diameter=0.02)), 0), OTHERS: ((hole(3, 40),), 0)}, whole()
    )
    assert "\nvalues = found\n" in written.code


def test_between_two_axes_is_square_to_them() -> None:
    pin, journal = (
        part(f"cylinder-{i}", (0.0, 0.01 * i, 0.05 * i), axis=(0.0, 0.0, 1.0), diameter=0.02) for i in range(2)
    )
    grounds = {HOLES: ((pin,), 0), OTHERS: ((journal,), 0)}
    codes = [write(Distance(HOLES, OTHERS, "centers"), grounds, whole(), option).code for option in range(2)]
    assert "a.center_distance(b)" in codes[0]
    assert "(a.center[0] - b.center[0]) ** 2 + (a.center[1] - b.center[1]) ** 2" in codes[1]


def test_none_is_a_number_that_is_compared() -> None:
    written = write(Check(Count(PINS), Relation.MORE, 8.0), {PINS: ((), 0)}, whole())
    assert [(one.expression, one.expects) for one in written.compared] == [("values[0]", AnswerType.COUNT)]


def test_only_bodies_overlap() -> None:
    with pytest.raises(Unwritable):
        write(Distance(PINS, LEVERS, "overlap"), {PINS: (BODIES, 0), LEVERS: (TWO, 0)}, whole())


def test_length_and_width_asked_together_are_the_longer_side_and_the_other_one() -> None:
    """Alone, a width runs along x, whichever side is longer."""
    pocket = part("pocket-1", length=0.034, width=0.034, depth=0.006, local_size=(0.034, 0.024, 0.006))
    both = write(Get((Measure.LENGTH, Measure.WIDTH, Measure.DEPTH), DEPTH.target), {HOLES: ((pocket,), 0)}, whole())
    assert "max(p.local_size[:2])" in both.code
    assert "min(p.local_size[:2])" in both.code
    assert "p.width" in write(Get((Measure.WIDTH,), HOLES), {HOLES: ((pocket,), 0)}, whole()).code


def test_the_size_of_a_window_may_be_its_two_sides() -> None:
    window = part("cutout-1", extents=(0.2, 0.0015, 0.14), local_size=(0.2, 0.14, 0.0015))
    written = [write(Get((Measure.SIZE,), HOLES), {HOLES: ((window,), 0)}, whole(), option) for option in (0, 1)]
    assert [one.expects for one in written] == [AnswerType.SIZE, AnswerType.LENGTHS]
    with pytest.raises(Unwritable):
        write(Get((Measure.SIZE,), HOLES), {HOLES: ((window, window), 0)}, whole(), 1)


def test_an_axis_and_a_plane_enclose_what_is_left_to_a_right_angle_of_axis_and_normal() -> None:
    neck, face = hole(1), part("face-1", normal=(0.0, 0.0, 1.0))
    written = write(Angle(HOLES, OTHERS), {HOLES: ((neck,), 0), OTHERS: ((face,), 0)}, whole())
    assert "1.5707963267948966 - a.angle_to(b)" in written.code


@pytest.mark.parametrize("degrees", [40.0, 70.0, 110.0, 135.0])
def test_walls_enclose_the_angle_on_their_side_of_where_they_meet(degrees: float) -> None:
    turn = math.radians(degrees)
    legs = [(1.0, 0.0), (math.cos(turn), math.sin(turn))]  # from the bend at the origin
    walls = tuple(part(f"wall-{i}", (0.02 * x, 0.02 * y, 0.0), normal=(-y, x, 0.0)) for i, (x, y) in enumerate(legs))
    written = write(Angle(PINS, None), {PINS: (walls, 0)}, whole())
    assert ("3.141592653589793 - a.angle_to(b)" in written.code) == (degrees > 90.0)


def test_parts_of_a_round_model_lie_at_an_angle_about_its_axis() -> None:
    """Two parallel holes enclose no angle of their own."""
    grounds = {HOLES: ((hole(1, 20),), 0), OTHERS: ((hole(2, 0, 20),), 0)}
    flange = whole(extents=(0.1, 0.1, 0.01))
    about = write(Angle(HOLES, OTHERS), grounds, flange)
    assert "arms0 = [[(p.opening or p.center)[i] - middle[i] for i in [0, 1]]" in about.code
    assert "a.angle_to(b)" in write(Angle(HOLES, OTHERS), grounds, flange, 1).code
    assert "a.angle_to(b)" in write(Angle(HOLES, OTHERS), grounds, whole()).code


def test_along_an_axis_the_spacing_is_that_of_a_row() -> None:
    zigzag = (hole(1, 0, 0), hole(2, 8, 10), hole(3, 20, 0), hole(4, 28, 10))
    along = write(Distance(HOLES, "each other", axis=0), {HOLES: (zigzag, 0)}, whole())
    assert "for i in [1, 2])] or [" in along.code  # 20 mm within a row, not 8 mm to the next one
    apart = write(Distance(HOLES, OTHERS, axis=0), {HOLES: (TWO, 0), OTHERS: (TWO, 0)}, whole())
    assert " or [abs" not in apart.code


def test_over_all_a_flange_is_as_thick_as_it_reaches_along_its_axis() -> None:
    flange = whole(axis=(0.0, 0.0, 1.0), thickness=0.008, extents=(0.1, 0.1, 0.012))
    assert options(Measure.THICKNESS, flange, overall=True)[0] == ("{0}.extents[2]", "own")
    assert options(Measure.THICKNESS, flange)[0] == ("{0}.thickness", "own")


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


def test_of_many_parts_only_the_closest_two_are_measured_by_their_surfaces() -> None:
    def code(count: int, reduce: Reduce) -> str:
        holes = tuple(hole(number, 10.0 * number) for number in range(count))
        return write(Distance(HOLES, "each other", "surfaces", reduce=reduce), {HOLES: (holes, 0)}, whole(), 0).code

    assert "closest(" not in code(10, Reduce.SMALLEST)
    assert "a, b = closest(parts)\nsolution = a.distance_to(b)" in code(30, Reduce.SMALLEST)
    assert "closest(" not in code(30, Reduce.LARGEST)
    with pytest.raises(Unwritable):  # sure to be refused, after half a minute of the kernel's
        code(100, Reduce.LARGEST)


@pytest.mark.parametrize(
    ("extents", "grade"), [((0.04, 0.04, 0.12), "own"), ((0.04, 0.04, 0.03), "own"), ((0.17, 0.17, 0.05), "derived")]
)
def test_a_round_part_is_as_long_as_its_axis_and_a_disc_hardly_so(
    extents: tuple[float, float, float], grade: str
) -> None:
    found = dict(options(Measure.LENGTH, whole(extents=extents, axis=(0.0, 0.0, 1.0))))
    assert found["{0}.extents[2]"] == grade


@pytest.mark.parametrize(("pairs", "value"), [(1, "2 * min(found)"), (2, "sum(found)")])
def test_the_play_on_both_sides_is_that_of_both_pairs_or_twice_that_of_one(pairs: int, value: str) -> None:
    play = Distance(PINS, LEVERS, "surfaces", reduce=Reduce.TOTAL)
    code = write(play, {PINS: ((body(1, "pin"),) * pairs, 0), LEVERS: ((body(2, "lever"),), 0)}, whole()).code
    assert value in code


def test_what_reaches_beyond_is_less_than_nothing_within() -> None:
    pin, lever = body(1, "pin", extents=(0.01, 0.01, 0.05)), body(2, "lever")
    grounds = {PINS: ((pin,), 0), LEVERS: ((lever,), 0)}
    ends = Distance(Plane(Side.BOTTOM, PINS), Plane(Side.BOTTOM, LEVERS), "beyond")
    code = write(Check(ends, Relation.MORE, 0.0), grounds, whole()).code
    assert "-1 * (p.center[2] - p.half_extents[2] - " in code
    assert "abs(" not in code


def test_width_depth_and_height_together_run_along_x_y_and_z_save_of_what_is_cut_in() -> None:
    box = Get((Measure.WIDTH, Measure.DEPTH, Measure.HEIGHT), LEVERS)
    code = write(box, {LEVERS: ((part("prism-1", width=0.2, height=0.03, depth=0.01),), 0)}, whole()).code
    assert [f"p.extents[{i}]" in code for i in range(3)] == [True] * 3
    cut = part("pocket-1", width=0.2, height=0.03, depth=0.01)
    assert "p.extents[0]" not in write(box, {LEVERS: ((cut,), 0)}, whole()).code


def test_an_axis_leans_from_the_vertical_or_rises_from_the_horizontal() -> None:
    bore = hole(1, axis=(0.6, 0.0, 0.8))
    lean = write(Get((Measure.DRAFT,), HOLES), {HOLES: ((bore,), 0)}, whole()).code
    assert lean.startswith("import math")
    assert "math.acos(min(1.0, abs(p.axis[2])))" in lean
    assert (
        "math.asin(min(1.0, abs(p.axis[2])))"
        in write(Get((Measure.INCLINATION,), HOLES), {HOLES: ((bore,), 0)}, whole()).code
    )


def test_a_long_pocket_that_is_called_a_slot_is_as_wide_as_it_is_across() -> None:
    long = part("pocket-1", width=0.1, local_size=(0.1, 0.01, 0.005))
    slots, pockets = (PartQuery(noun=noun, plural=True) for noun in ("slot", "pocket"))
    width = {
        query.noun: write(Get((Measure.WIDTH,), query), {query: ((long,), 0)}, whole()).code
        for query in (slots, pockets)
    }
    assert "min(p.local_size[:2])" in width["slot"]
    assert "p.width" in width["pocket"]


@pytest.mark.parametrize(("bottom", "reaches"), [("flat", "max"), ("through", "min")])
def test_the_bottom_of_a_bore_is_its_floor_wherever_it_opens(bottom: str, reaches: str) -> None:
    bore = hole(1, normal=(0.0, 0.0, -1.0), bottom=bottom)
    left = Distance(Plane(Side.BOTTOM, HOLES), Plane(Side.TOP, LEVERS))
    code = write(left, {HOLES: ((bore,), 0), LEVERS: ((body(2, "lever"),), 0)}, whole()).code
    sign = "+" if reaches == "max" else "-"
    assert f"p.center[2] {sign} p.half_extents[2] - (max(" in code


def test_the_mouth_of_a_hole_is_that_on_the_side_it_is_seen_from() -> None:
    seen = HOLES.model_copy(update={"sides": (Side.LEFT,)})
    code = write(Get((Measure.OPENING,), seen), {seen: ((hole(1, opening=(0.0, 0.0, 0.0)),), 0)}, whole()).code
    assert "-o.normal[0] > 0.5" in code


def test_parts_in_line_lie_on_the_axis_of_the_first_or_in_a_row() -> None:
    bores = tuple(hole(number, axis=(0.0, 0.0, 1.0)) for number in (1, 2, 3))
    strict, row = (
        write(Parallel(HOLES, None, in_line=line), {HOLES: (bores, 0)}, whole()).code for line in ("axis", "row")
    )
    assert "[: 1]" in strict
    assert "[: 2]" in row
    with pytest.raises(Unwritable):
        write(Parallel(HOLES, None, in_line="axis"), {HOLES: (bores[:1], 0)}, whole())


def test_the_largest_dimension_is_one_value() -> None:
    assert "max(shape.extents)" in write(Get((Measure.SIZE,), None, Reduce.LARGEST), {}, whole()).code


def test_the_end_of_a_blind_bore_is_its_floor() -> None:
    """Of a through bore it is the end that lies further out."""
    lever = part("prism-1", (0.0, 0.0, 0.02), extents=(0.04, 0.04, 0.04))
    bore = PartQuery(noun="bore")
    left = Distance(Plane(None, bore), Plane(Side.TOP, LEVERS))
    for blind, sign in ((True, "+"), (False, "-")):
        drilled = part(
            "hole-1", (0.0, 0.0, 0.01), kind="hole", extents=(0.01, 0.01, 0.02), axis=(0.0, 0.0, -1.0),
            normal=(0.0, 0.0, -1.0), bottom="flat" if blind else "through",
        )  # fmt: skip
        written = write(left, {bore: ((drilled,), 0), LEVERS: ((lever,), 0)}, whole())
        assert f"q.center[2] {sign} q.half_extents[2] for q in" in written.code.splitlines()[-1].split(" - (")[0]


def test_how_far_apart_flanges_on_one_axis_are_is_the_gap_between_them() -> None:
    def flange(i: int, x: float) -> Part:
        axis, extents = (0.0, 0.0, 1.0), (0.04, 0.04, 0.005)
        return part(f"boss-{i}", (x, 0.0, 0.03 * i), kind="boss", axis=axis, diameter=0.04, extents=extents)

    for off, expression in ((0.0, "a.distance_to(b)"), (0.05, "a.center_distance(b)")):
        grounds = {HOLES: ((flange(1, 0.0), flange(2, off)), 0)}
        assert expression in write(Distance(HOLES, "each other"), grounds, whole()).code


def test_bores_of_one_size_among_others_lie_apart_by_their_own_pitch() -> None:
    main, ports = hole(1, 5, diameter=0.02), [hole(i, 30 * i) for i in (2, 3)]
    like = "abs(a.diameter - b.diameter) < 1e-05"
    for reduce, holes, is_like in (
        (Reduce.ONE, (main, *ports), True),
        (Reduce.SMALLEST, (main, *ports), False),
        (Reduce.ONE, (main, ports[0]), False),
    ):
        code = write(Distance(HOLES, "each other", reduce=reduce), {HOLES: (holes, 0)}, whole()).code
        assert (like in code) is is_like


def test_width_and_height_of_an_upright_plate_are_read_in_two_directions() -> None:
    form = Get((Measure.WIDTH, Measure.HEIGHT), LEVERS)
    flange = part("prism-1", extents=(0.003, 0.05, 0.024), normal=(1.0, 0.0, 0.0), width=0.024, height=0.024)
    assert "p.extents[1]" in write(form, {LEVERS: ((flange,), 0)}, whole()).code
    lying = part("prism-1", extents=(0.05, 0.024, 0.003), normal=(0.0, 0.0, 1.0), width=0.024, height=0.003)
    assert "p.width" in write(form, {LEVERS: ((lying,), 0)}, whole()).code


def test_the_teeth_of_a_gear_are_an_equal_share_of_its_turn_apart() -> None:
    teeth = tuple(part(f"tooth-1.{i}") for i in range(1, 13))
    assert "6.283185307179586 / len(" in write(Angle(PINS, None), {PINS: (teeth, 0)}, whole()).code
    others = (part("tooth-1.1"), part("tooth-2.1"))
    assert "6.283185307179586" not in write(Angle(PINS, None), {PINS: (others, 0)}, whole(axis=(0.0, 0.0, 1.0))).code


def test_one_thing_is_on_a_side_where_all_that_is_taken_for_it_is() -> None:
    form, apart = Towards(LEVERS, (Side.LEFT, Side.RIGHT)), (part("rib-1", (-0.04, 0, 0)), part("rib-2", (0.04, 0, 0)))
    with pytest.raises(Unwritable):
        write(form, {LEVERS: (apart, 0)}, whole())
    assert write(form, {LEVERS: (apart[:1] * 2, 0)}, whole()).code
    assert write(Towards(PINS, form.sides), {PINS: (apart, 0)}, whole()).code


def test_of_many_bores_too_only_those_of_one_size_are_compared(checker: TypeChecker) -> None:
    holes = (*(hole(i, 10 * i) for i in range(1, 80)), hole(80, 5, diameter=0.02))
    code = write(Distance(HOLES, "each other"), {HOLES: (holes, 0)}, whole()).code
    assert "for size in different(" in code
    assert checker.problems(code) == ()


def test_holes_are_on_the_side_that_they_open_to_and_others_where_they_are() -> None:
    form = Towards(HOLES, tuple(Side))
    drilled = write(form, {HOLES: ((hole(1, -20),), 0)}, whole(), 0)
    assert "p.normal" in drilled.code
    standing = write(form, {HOLES: ((part("boss-1", normal=(0.0, 0.0, 1.0)),), 0)}, whole(), 0)
    assert "p.normal" not in standing.code


def test_an_axis_passes_the_origin_at_less_than_its_middle_does() -> None:
    form = Distance(HOLES, Origin())
    apart = [write(form, {HOLES: ((hole(1, 20),), 0)}, whole(), option).code for option in (0, 1)]
    assert "distance(p.center, (0.0, 0.0, 0.0))" in apart[0]
    assert "center[2]" not in apart[1]
    assert "p.center[0]" in apart[1]


def test_a_face_is_on_the_side_that_it_looks_to() -> None:
    face = PartQuery(noun="face")
    written = write(Towards(face, tuple(Side)), {face: ((part("face-1", normal=(0.0, 0.0, 1.0)),), 0)}, whole(), 0)
    assert "p.normal[2]" in written.code


def test_from_a_face_is_along_its_normal() -> None:
    face = PartQuery(noun="face")
    grounds = {face: ((part("face-1", (0.05, 0.0, 0.0), normal=(1.0, 0.0, 0.0)),), 0), HOLES: ((hole(1, 10, 8),), 0)}
    for form, flat in ((Distance(HOLES, face, "centers"), "b"), (Distance(face, HOLES, "centers"), "a")):
        assert f"zip(a.center, b.center, {flat}.normal)" in write(form, grounds, whole()).code


def test_the_back_of_what_is_round_is_one_of_its_ends_or_where_it_reaches_to() -> None:
    flange, bore = PartQuery(noun="flange"), PartQuery(noun="bore")
    disc = part("boss-1", (0.0, 0.0, 0.005), kind="boss", axis=(0.0, 0.0, 1.0), extents=(0.08, 0.08, 0.01))
    grounds = {flange: ((disc,), 0), bore: ((hole(1, 10, 8),), 0)}
    model = whole(extents=(0.08, 0.08, 0.05))
    codes = [write(Distance(Plane(Side.BACK, flange), bore), grounds, model, option).code for option in range(3)]
    assert ["center[2]" in code for code in codes] == [True, True, False]
    above = write(Distance(Plane(Side.TOP, flange), bore), grounds, model, 0).code
    assert "center[2]" in above


def test_what_lies_on_one_side_may_point_to_another() -> None:
    pin = PartQuery(noun="pin", definite=True)
    grounds = {pin: ((part("boss-1", (0.04, 0.0, 0.0), normal=(0.0, 0.0, 1.0)),), 0)}
    lies, points = (write(Towards(pin, tuple(Side)), grounds, whole(), option) for option in (0, 1))
    assert ("p.center[2]" in lies.code, "p.normal" in lies.code) == (True, False)
    assert ("p.center[2]" in points.code, "p.normal[2]" in points.code) == (False, True)
    assert [read.expression for read in (*lies.reads, *points.reads)] == ["lies", "points"]
    with pytest.raises(Unwritable):
        write(Towards(pin, tuple(Side)), {pin: ((part("boss-1", (0.04, 0.0, 0.0)),), 0)}, whole(), 1)
