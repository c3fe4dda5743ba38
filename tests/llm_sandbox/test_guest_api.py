"""The guest API: what is served is what guest_api.pyi says, no more and no less, with the fallbacks that it states."""

from __future__ import annotations

import ast
import inspect
from importlib.resources import files
from typing import TYPE_CHECKING, Any

import pytest
from tests.llm_sandbox.conftest import make_body, make_face, make_part, make_shape

from querycad_contracts import (
    DRAWING_M,
    AnswerType,
    Face,
    MissingAttribute,
    Outline,
    Part,
    RunLimits,
    RunStatus,
    Side,
    SurfaceKind,
)
from querycad_sandbox import Sandbox
from querycad_sandbox.control import RunControl
from querycad_sandbox.guest import FUNCTIONS, ON_DEMAND, PART_METHODS, Guest
from querycad_sandbox.measures import (
    LocalFrame,
    Opening,
    body_measures,
    face_measures,
    frame_measures,
    opening_measures,
    part_measures,
    shape_measures,
)

if TYPE_CHECKING:
    from tests.llm_sandbox.conftest import FakePartFinder

STUB = ast.parse(files("querycad_contracts").joinpath("guest_api.pyi").read_text(encoding="utf-8"))
PRELUDE = ast.parse(
    "\n".join(
        files("querycad_sandbox.inside").joinpath(name).read_text(encoding="utf-8")
        for name in ("prelude.py", "relations.py")
    )
)
UP = (0.0, 0.0, 1.0)


def stub_class(name: str) -> ast.ClassDef:
    return next(node for node in STUB.body if isinstance(node, ast.ClassDef) and node.name == name)


def attributes(name: str) -> set[str]:
    body = stub_class(name).body
    return {node.target.id for node in body if isinstance(node, ast.AnnAssign) and isinstance(node.target, ast.Name)}


def functions(tree: ast.Module | ast.ClassDef) -> dict[str, ast.FunctionDef]:
    return {node.name: node for node in tree.body if isinstance(node, ast.FunctionDef)}


def full_part() -> Part:
    return make_part(
        "hole-1",
        tags=("through",),
        sides=(Side.TOP,),
        name="x",
        color="#c0c0c0",
        opening=UP,
        tip=UP,
        axis=UP,
        normal=UP,
        radius=1.0,
        diameter=2.0,
        radii=(1.0,),
        depth=1.0,
        height=1.0,
        width=1.0,
        length=1.0,
        nominal_length=1.0,
        thickness=1.0,
        local_size=UP,
        bottom="through",
        pitch=1.0,
        count=1,
        angle=1.0,
        outer_diameter=1.0,
        inner_diameter=1.0,
        tube_diameter=1.0,
        across_flats=1.0,
        across_corners=1.0,
        center_length=1.0,
        chamfer_size=1.0,
        draft=1.0,
        bend_radius=1.0,
        bend_angle=1.0,
        mouth_length=1.0,
        mouth_width=1.0,
        bottom_length=1.0,
        bottom_width=1.0,
        opening_area=1.0,
        bottom_thickness=1.0,
        minimum_thickness=1.0,
        wall_distance=1.0,
        inclination=1.0,
        developed_length=1.0,
        volume=1.0,
        area=1.0,
        center_of_mass=UP,
        inertia=(UP, UP, UP),
        mirror_planes=(UP,),
        rotation_axes=((UP, 0),),
        approach=(UP,),
    )


def test_every_attribute_of_the_stub_is_served_and_no_other() -> None:
    assert part_measures(full_part()).keys() | set(ON_DEMAND[Part]) == attributes("Part")
    whole = make_face(1, normal=UP, axis_point=UP, length=1.0, outline=Outline.CIRCLE, local_size=UP)
    assert face_measures(whole).keys() | set(ON_DEMAND[Face]) == attributes("Face")
    assert frame_measures(LocalFrame(UP, UP, UP, UP)).keys() == attributes("Frame")
    assert opening_measures(Opening(UP, UP, Outline.CIRCLE)).keys() == attributes("Opening")
    assert body_measures(make_body(color="#c0c0c0")).keys() == attributes("Body")
    assert shape_measures(make_shape(thickness=0.01, minimum_thickness=0.01, up=Side.TOP, center_of_mass=UP)).keys() | {
        "bodies"
    } == attributes("Shape")


def test_every_method_of_the_stub_is_served_and_no_other() -> None:
    assert functions(stub_class("Part")).keys() == PART_METHODS
    assert not any(functions(stub_class(name)) for name in ("Face", "Body", "Shape"))


def test_every_function_of_the_stub_takes_the_same_arguments() -> None:
    stubs, prelude = functions(STUB), functions(PRELUDE)
    for name in stubs.keys() - set(FUNCTIONS):
        assert [a.arg for a in prelude[name].args.args] == [a.arg for a in stubs[name].args.args]
        assert ast.dump(ast.List(prelude[name].args.defaults)) == ast.dump(ast.List(stubs[name].args.defaults))
    for name in FUNCTIONS:
        parameters = list(inspect.signature(getattr(Guest, name)).parameters.values())[1:]
        assert [each.name for each in parameters] == [a.arg for a in stubs[name].args.args]
        with_default = [each for each in parameters if each.default is None]
        assert len(with_default) == len(stubs[name].args.defaults)


def test_two_lengths_are_close_to_drawing_accuracy_here_as_elsewhere() -> None:
    (told,) = (
        node.value for node in PRELUDE.body if isinstance(node, ast.Assign) and "_DRAWING_M" in ast.unparse(node)
    )
    assert ast.literal_eval(told) == ast.literal_eval(functions(STUB)["close"].args.defaults[-1]) == DRAWING_M


def test_every_name_of_the_stub_is_there_at_run_time(sandbox: Sandbox, finder: FakePartFinder) -> None:
    classes = {node.name for node in STUB.body if isinstance(node, ast.ClassDef) and not node.bases}
    names = sorted(classes | functions(STUB).keys() | {"shape"})
    assert sandbox.run(f"solution = len([{', '.join(names)}])", finder).value == len(names)


def test_every_attribute_and_method_of_the_stub_passes_the_type_check_and_runs(
    sandbox: Sandbox, finder: FakePartFinder
) -> None:
    finder.known = [full_part()]
    reads = [f"part.{name}" for name in sorted(attributes("Part"))]
    calls = [
        "part.distance_to(part)",
        "part.center_distance(other=part)",
        "part.angle_to(part)",
        "part.edge_distance()",
        "part.size_in(part.frame)",
        "part.measures()",
    ]
    code = 'part = find_parts("hole")[0]\nsolution = len([' + ", ".join(reads + calls) + "])"
    outcome = sandbox.run(code, finder)
    assert (outcome.status, outcome.value, outcome.message) == (RunStatus.OK, len(reads) + len(calls), "")


def test_a_hole_has_no_depth_but_its_own() -> None:
    assert "depth" not in part_measures(make_part("hole-1", opening=UP))
    assert part_measures(make_part("hole-1", opening=UP, depth=0.004))["depth"] == 0.004
    assert part_measures(make_part("hole-1", opening=UP))["height"] == 0.03


def test_a_boss_has_no_height_but_its_own() -> None:
    assert "height" not in part_measures(make_part("boss-1", tip=UP))
    assert part_measures(make_part("boss-1", tip=UP, height=0.004))["height"] == 0.004
    assert part_measures(make_part("boss-1", tip=UP))["depth"] == 0.02


def test_anything_else_has_its_extents_for_depth_and_height() -> None:
    measures = part_measures(make_part("body-1"))
    assert (measures["width"], measures["depth"], measures["height"]) == (0.01, 0.02, 0.03)


def test_width_and_length_are_of_the_parts_own_frame() -> None:
    measures = part_measures(make_part("slot-1", local_size=(0.05, 0.006, 0.002)))
    assert (measures["length"], measures["width"]) == (0.05, 0.006)
    assert not {"length", "width"} & part_measures(make_part("slot-1")).keys()


def test_radius_and_diameter_stand_in_for_each_other() -> None:
    assert part_measures(make_part("hole-1", radius=0.002))["diameter"] == 0.004
    assert part_measures(make_part("hole-1", diameter=0.004))["radius"] == 0.002
    assert part_measures(make_part("hole-1", radius=0.002))["radii"] == [0.002]
    assert part_measures(make_part("hole-1", radius=0.002, radii=(0.004, 0.002)))["radii"] == [0.004, 0.002]
    assert not {"radius", "diameter", "radii"} & part_measures(make_part("slot-1")).keys()


def test_a_radius_of_zero_is_a_radius() -> None:
    assert part_measures(make_part("hole-1", radius=0.0))["diameter"] == 0.0


def test_a_part_without_normal_faces_along_its_axis() -> None:
    assert part_measures(make_part("boss-1", axis=UP))["normal"] == UP
    assert part_measures(make_part("boss-1", axis=UP, normal=(1.0, 0.0, 0.0)))["normal"] == (1.0, 0.0, 0.0)


def test_corners_and_half_extents_follow_from_center_and_extents() -> None:
    measures = shape_measures(make_shape())
    assert measures["min_corner"] == pytest.approx((0.0, 0.0, 0.0))
    assert measures["max_corner"] == pytest.approx((0.1, 0.04, 0.01))
    assert (measures["width"], measures["depth"], measures["height"]) == (0.1, 0.04, 0.01)
    assert part_measures(make_part("boss-1"))["half_extents"] == (0.005, 0.01, 0.015)


@pytest.mark.parametrize(
    ("code", "value"),
    [
        ('solution = find_parts("slot")[0].radius', None),
        ('solution = [p.tip for p in find_parts("hole")]', [None] * 3),
        ("solution = shape.thickness is None", True),
        ("solution = [body.color for body in shape.bodies]", [None]),
        ('solution = find_parts("hole")[0].faces[0].normal', None),
        ('solution = hasattr(find_parts("slot")[0], "radius")', False),
        ('solution = getattr(find_parts("slot")[0], "radius", 0.001)', 0.001),
        ('solution = "radius" in find_parts("slot")[0].measures()', False),
    ],
)
def test_a_measure_that_is_absent_is_none(sandbox: Sandbox, finder: FakePartFinder, code: str, value: Any) -> None:
    outcome = sandbox.run(code, finder)
    assert (outcome.status, outcome.value) == (RunStatus.OK, value)


@pytest.mark.parametrize(
    ("code", "message"),
    [
        (
            'solution = find_parts("slot")[0].radius * 2',
            "TypeError: part 'slot-1' has no radius; it has bottom, center",
        ),
        ('solution = max(find_parts("slot") * 2, key=lambda p: p.radius)', "part 'slot-1' has no radius; it has"),
        ('ps = find_parts("slot")\nps.sort(key=lambda p: p.radius)\nsolution = ps', "part 'slot-1' has no radius;"),
        ('p = find_parts("slot")[0]\nsolution = distance(p.tip, p.center)', "part 'slot-1' has no tip; it has"),
        ('def f(p):\n    return p.colour\nsolution = f(find_parts("hole")[0])', "part 'hole-1' has no colour; it has"),
        ('solution = find_parts("hole")[0].center.x', "tuple[float, float, float]"),
    ],
)
def test_who_reckons_with_an_absent_measure_is_told_which_and_what_there_is(
    sandbox: Sandbox, finder: FakePartFinder, code: str, message: str
) -> None:
    outcome = sandbox.run(code, finder)
    assert message in outcome.message
    assert outcome.status in (RunStatus.RAISED, RunStatus.REFUSED)


@pytest.mark.parametrize("code", ['find_parts("slot")[0].radius', '[p.radius for p in find_parts("slot")]'])
def test_an_answer_of_a_type_is_no_absent_measure(sandbox: Sandbox, finder: FakePartFinder, code: str) -> None:
    outcome = sandbox.run(f"solution = {code}", finder, expects=AnswerType.LENGTH)
    assert (outcome.status, outcome.value) == (RunStatus.RAISED, None)
    assert outcome.missing_attribute == MissingAttribute(part="slot-1", attribute="radius")


def test_a_value_that_is_none_for_want_of_a_measure_says_so_and_another_none_does_not(
    sandbox: Sandbox, finder: FakePartFinder
) -> None:
    lacking = sandbox.run('solution = find_parts("slot")[0].radius', finder)
    assert (lacking.status, lacking.value) == (RunStatus.OK, None)
    assert lacking.message.startswith("the result lacks a measure: part 'slot-1' has no radius; it has bottom, ")
    own = sandbox.run("solution = None", finder)
    assert (own.status, own.value, own.message) == (RunStatus.OK, None, "")


def test_a_failing_line_is_told_with_its_number(sandbox: Sandbox, finder: FakePartFinder) -> None:
    code = '\nparts = find_parts("slot")\nsolution = [2 * p.radius for p in parts]'
    assert sandbox.run(code, finder).message.endswith("(line 3: solution = [2 * p.radius for p in parts])")


@pytest.mark.parametrize(
    ("call", "message"),
    [
        ("find_parts(3)", "TypeError: find_parts() takes a description as text"),
        ('find_parts({"noun": "hole", "size": 3})', "ValueError: find_parts() takes no such query: size: Extra inputs"),
        ('find_parts("")', "ValueError: a description has 1 to 300 characters"),
        ('find_parts("x" * 301)', "ValueError: a description has 1 to 300 characters"),
        ('find_parts("hole", sides=["upper"])', "ValueError: no side is called 'upper': use top, bottom, left"),
        ('find_parts("hole", sides="upper")', "ValueError: no side is called 'upper'"),
        ('find_parts("hole", sides=[])', "ValueError: no side given"),
        ('find_parts("hole", sides=3)', "TypeError: find_parts() takes its sides as a list"),
        ('find_parts("hole", sides=[1])', "TypeError: find_parts() takes its sides as a list"),
        ('find_parts("hole", sides={"top": 1})', "TypeError: find_parts() takes its sides as a list"),
        (
            'find_parts("hole")[0].distance_to("hole-2")',
            "TypeError: distance_to() takes a part; offset(a, b) takes faces too",
        ),
        ('find_parts("hole")[0].angle_to(find_parts("face")[0].id)', "TypeError: angle_to() takes a part"),
        ('find_parts("hole")[0].distance_to(faces()[0])', "TypeError: distance_to() takes a part; offset(a, b)"),
        ('find_parts("hole")[0].edge_distance', "AttributeError: edge_distance is called: edge_distance(…)"),
        (
            'set(find_parts("hole"))',
            "TypeError: cannot use 'Part' as a set element (unhashable type: 'Part'); use its .id, or a list",
        ),
        (
            'sorted(find_parts("hole"))',
            "TypeError: '<' not supported between instances of 'Part' and 'Part'; compare a measure: key=lambda one:",
        ),
        ('find_parts("hole")[0].edge_distance(*[1])', "TypeError: edge_distance() takes no arguments"),
        ('find_parts("hole")[0].distance_to(*[])', "TypeError: distance_to() takes one other part"),
        ('find_parts("hole")[0].distance_to(**{"part": 1})', "TypeError: distance_to() takes no argument 'part'"),
        ('distance(find_parts("hole")[0], shape.center)', "TypeError: distance() takes two points"),
        ("distance((0.0, 0.0), (1.0, 1.0))", "TypeError: distance() takes two points"),
    ],
)
def test_a_wrong_argument_is_told_to_the_program(
    sandbox: Sandbox, finder: FakePartFinder, call: str, message: str
) -> None:
    outcome = sandbox.run(f"solution = {call}", finder)
    assert outcome.status is RunStatus.RAISED
    assert outcome.message.startswith(message)
    assert sandbox.run(f"try:\n    {call}\nexcept Exception:\n    solution = 1", finder).value == 1


def test_sides_reach_the_finder_in_one_order_each_once(sandbox: Sandbox, finder: FakePartFinder) -> None:
    code = (
        'for s in (["left", "top", "left"], ("top", "left"), {"left", "top"}):\n    find_parts("boss", s)\nsolution = 1'
    )
    outcome = sandbox.run(code, finder)
    assert finder.calls == [("find_parts", ("boss", (Side.TOP, Side.LEFT)))]
    assert outcome.groundings[0].sides == (Side.TOP, Side.LEFT)


def test_a_repeated_call_is_answered_from_the_first(sandbox: Sandbox, finder: FakePartFinder) -> None:
    outcome = sandbox.run('solution = sum(len(find_parts("hole")) for i in range(50))', finder)
    assert (outcome.value, len(finder.calls), len(outcome.groundings)) == (150, 1, 1)


def test_the_finder_is_asked_only_for_what_is_read(sandbox: Sandbox, finder: FakePartFinder) -> None:
    sandbox.run("solution = 1", finder)
    assert finder.calls == []
    sandbox.run("solution = shape.width + shape.depth", finder)
    assert finder.calls == [("shape", None)]
    finder.calls.clear()
    sandbox.run('p = find_parts("hole")[0]\nsolution = [len(p.faces), len(p.faces)]', finder)
    assert finder.calls == [("find_parts", ("hole", None)), ("faces", (1, 2))]


def test_distances_between_points_ask_nobody(sandbox: Sandbox, finder: FakePartFinder) -> None:
    code = 'p = find_parts("hole")[0]\nsolution = sum(distance(p.center, shape.center) for i in range(3000))'
    outcome = sandbox.run(code, finder, RunLimits(host_calls=10))
    assert outcome.status is RunStatus.OK


def test_groundings_are_kept_in_the_order_of_the_calls(sandbox: Sandbox, finder: FakePartFinder) -> None:
    outcome = sandbox.run('solution = len(find_parts("slot")) + len(find_parts("hole"))', finder)
    assert [g.description for g in outcome.groundings] == ["slot", "hole"]


@pytest.mark.parametrize(
    "code",
    [
        'solution = find_parts("sprocket")',
        'solution = find_parts("hole") + find_parts("sprocket")',
        'try:\n    find_parts("sprocket")\nexcept BaseException:\n    pass\nsolution = 3',
        'try:\n    find_parts("sprocket")\nfinally:\n    solution = 3\n    while True:\n        pass',
        'solution = [1]\nsolution = sorted([1, 2], key=lambda v: len(find_parts("sprocket")))',
    ],
)
def test_a_description_that_is_not_understood_ends_the_program(
    sandbox: Sandbox, finder: FakePartFinder, code: str
) -> None:
    outcome = sandbox.run(code, finder, RunLimits(duration_s=0.3))
    assert (outcome.status, outcome.value) == (RunStatus.RAISED, None)
    assert outcome.message == (
        "not grounded: 'sprocket': no such word: sprocket; the nearest known terms are: hole, boss"
    )
    assert not outcome.groundings[-1].understood


def test_a_part_not_there_is_an_empty_list_and_no_end(sandbox: Sandbox, finder: FakePartFinder) -> None:
    outcome = sandbox.run('solution = len(find_parts("gear"))', finder)
    assert (outcome.status, outcome.value, outcome.groundings[0].understood) == (RunStatus.OK, 0, True)


@pytest.mark.parametrize(
    ("port_method", "code"),
    [
        ("find_parts", 'solution = find_parts("hole")'),
        ("shape", "solution = shape.width"),
        ("faces", 'solution = find_parts("hole")[0].faces'),
        ("distance", 'a = find_parts("hole")[0]\nsolution = a.distance_to(a)'),
        ("edge_distance", 'solution = find_parts("hole")[0].edge_distance()'),
        ("edge_distance", 'try:\n    find_parts("hole")[0].edge_distance()\nexcept BaseException:\n    solution = 1'),
    ],
)
def test_a_failure_of_segcad_is_raised_and_not_the_programs(
    sandbox: Sandbox, finder: FakePartFinder, monkeypatch: pytest.MonkeyPatch, port_method: str, code: str
) -> None:
    def fail(*args: Any) -> Any:
        raise ConnectionError("the worker is gone")

    monkeypatch.setattr(finder, port_method, fail)
    with pytest.raises(ConnectionError, match="the worker is gone"):
        sandbox.run(code, finder)
    assert sandbox.run("solution = 1", finder).value == 1


def test_faces_come_as_values_and_enums_as_their_words() -> None:
    measures = face_measures(make_face(3, kind=SurfaceKind.CONE))
    assert (measures["kind"], measures["convexity"]) == ("cone", "concave")
    assert isinstance(make_face(3), Face)
    assert not any(isinstance(value, Side) for value in part_measures(full_part())["sides"])


def test_a_body_has_its_colour_and_a_hole_none() -> None:
    assert part_measures(make_part("body-1", color="#ff0000"))["color"] == "#ff0000"
    assert "color" not in part_measures(make_part("hole-1"))


def test_a_curved_slot_has_the_radius_of_its_middle_line_and_a_straight_one_none() -> None:
    arc = {"kind": "slot", "center_length": 0.03, "angle": 0.5, "radius": 0.004}
    assert part_measures(make_part("slot-1", tags=("curved", "closed"), **arc))["bend_radius"] == pytest.approx(0.06)
    assert "bend_radius" not in part_measures(make_part("slot-2", tags=("obround", "closed"), **arc))
    assert "bend_radius" not in part_measures(make_part("boss-1", tags=("curved",), **{**arc, "kind": "boss"}))


def test_a_conical_boss_has_the_full_angle_and_a_pocket_with_draft_none() -> None:
    head = make_part("boss-1", tags=("conical",), draft=0.785)
    assert part_measures(head)["angle"] == pytest.approx(1.57)
    assert "angle" not in part_measures(make_part("pocket-1", kind="pocket", draft=0.05))
    assert part_measures(make_part("cone-1", tags=("conical",), draft=0.2, angle=0.4))["angle"] == 0.4


def test_in_a_pattern_is_what_belongs_to_it_and_not_what_lies_within(finder: FakePartFinder) -> None:
    circle = make_part("pattern-1", children=("hole-1",), extents=(0.1, 0.1, 0.01))
    guest = Guest(finder, RunControl(), 2**20)
    assert guest.is_in(make_part("hole-1"), circle)
    assert not guest.is_in(make_part("hole-2"), circle)
    assert guest.is_in(make_part("boss-1"), circle)


def test_a_hole_is_in_the_body_whose_faces_it_has_and_a_pin_in_the_hole_that_it_fills(finder: FakePartFinder) -> None:
    plate = make_part("body-1", faces=(1, 2, 3), extents=(0.1, 0.1, 0.01))
    washer = make_part("body-2", faces=(7, 8), center=(0.0, 0.0, 0.006), extents=(0.02, 0.02, 0.002))
    opening = {"opening": (0.0, 0.0, 0.005), "extents": (0.01, 0.01, 0.002)}
    in_washer = make_part("hole-1", faces=(8,), center=(0.0, 0.0, 0.006), **opening)
    in_plate = make_part("hole-2", faces=(3,), extents=(0.008, 0.008, 0.01))
    pin = make_part("boss-1", faces=(9,), extents=(0.008, 0.008, 0.02))
    guest = Guest(finder, RunControl(), 2**20)
    assert [guest.is_in(hole, plate) for hole in (in_washer, in_plate)] == [False, True]
    assert [guest.is_in(hole, washer) for hole in (in_washer, in_plate)] == [True, False]
    assert guest.is_in(pin, in_plate)


def test_teeth_that_mesh_are_each_in_their_own_gear(finder: FakePartFinder) -> None:
    wheel = make_part("gear-1", kind="gear", children=("tooth-1.1",), extents=(0.1, 0.1, 0.01))
    guest = Guest(finder, RunControl(), 2**20)
    assert guest.is_in(make_part("tooth-1.1", kind="tooth"), wheel)
    assert not guest.is_in(make_part("tooth-2.1", kind="tooth"), wheel)
