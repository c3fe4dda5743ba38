"""`parts`, `faces` and what is asked between them: typed, never guessed, and each an answer's evidence."""

from __future__ import annotations

import math
import random
from typing import Any

import pytest
from tests.llm_sandbox.conftest import FakePartFinder, make_face, make_part

from querycad_contracts import Face, Outline, Part, RunStatus, Vector
from querycad_sandbox import Sandbox
from querycad_sandbox.measures import face_frame, openings_of, part_frame
from querycad_sandbox.rewriting import rewritten

UP, RIGHT = (0.0, 0.0, 1.0), (1.0, 0.0, 0.0)


class Bodies(FakePartFinder):
    """Three bodies along x, the first and second 2 mm into each other, the second and third side by side."""

    def __init__(self) -> None:
        super().__init__()
        self.asked: list[tuple[str, str]] = []

    def parts(self) -> tuple[Part, ...]:
        size = {"kind": "body", "extents": (0.01, 0.01, 0.01), "volume": 1e-6}
        return tuple(
            make_part(f"body-{n}", center=(x, 0.0, 0.0), **size) for n, x in ((1, 0.0), (2, 0.008), (3, 0.018))
        )

    def overlap(self, part_a: str, part_b: str) -> float:
        self.asked.append((part_a, part_b))
        return 2e-7 if {part_a, part_b} == {"body-1", "body-2"} else 1e-13


class Boxes(FakePartFinder):
    """Parts that are boxes of many sizes, some within others, and how far these are apart."""

    def __init__(self) -> None:
        super().__init__()
        of = random.Random(4)
        self.known = [
            make_part(
                f"{'hole' if number % 3 else 'slot'}-{number}",
                kind="hole" if number % 3 else "slot",
                center=tuple(of.uniform(0.0, 0.3) for _ in range(3)),
                extents=tuple(of.uniform(0.001, 0.02) for _ in range(3)),
            )
            for number in range(45)
        ]
        self.asked: list[tuple[str, str]] = []

    def distance(self, part_a: str, part_b: str) -> float:
        self.asked.append((part_a, part_b))
        a, b = ({part.id: part for part in self.known}[one] for one in (part_a, part_b))
        return math.hypot(
            *(max(0.0, abs(a.center[i] - b.center[i]) - (a.extents[i] + b.extents[i]) / 2) for i in range(3))
        )


def value(sandbox: Sandbox, finder: FakePartFinder, code: str) -> Any:
    outcome = sandbox.run(f"solution = {code}" if "solution" not in code else code, finder)
    assert (outcome.status, outcome.message) == (RunStatus.OK, "")
    return outcome.value


@pytest.mark.parametrize(
    ("call", "ids"),
    [
        ("parts(kind='hole')", ["hole-1", "hole-2", "hole-3"]),
        ("parts(kind='gear')", []),
        ("parts(kind='hole', diameter=0.01)", ["hole-3"]),
        ("parts(diameter=0.00504)", ["hole-1", "hole-2"]),
        ("parts(kind='hole', diameter=0.0052)", []),
        ("parts(tags='through', side='bottom', near=(0.08, 0.02, 0.0))", ["hole-3", "hole-2", "hole-1"]),
        ("parts(side=['left', 'bottom'])", ["hole-1", "hole-2", "hole-3", "boss-1"]),
        ("parts('slot', near=parts(kind='hole')[0])", ["slot-1"]),
        ("outermost(parts(kind='hole'), 'right')", ["hole-3"]),
        ("outermost(parts(kind='hole'))", ["hole-1", "hole-3"]),
        ("between(parts(), parts(kind='hole')[0], parts(kind='hole')[2])", ["hole-2"]),
        ("around(parts(kind='hole'), parts(kind='hole')[1])", []),
        ("on(parts(kind='hole'), parts(kind='slot')[0])", ["hole-1", "hole-2", "hole-3"]),
    ],
)
def test_parts_are_those_that_are_so(sandbox: Sandbox, finder: FakePartFinder, call: str, ids: list[str]) -> None:
    assert value(sandbox, finder, f"[p.id for p in {call}]") == ids


def test_bodies_overlap_where_they_share_more_than_a_cube_of_a_tenth_of_a_millimetre(sandbox: Sandbox) -> None:
    """Three bodies in a row, each 10 mm long: 1 reaches into 2, and 3 only touches 2."""
    finder = Bodies()
    pairs = "[[a.id, b.id] for a, b in overlaps({})]"
    assert value(sandbox, finder, pairs.format("parts(kind='body')")) == [["body-1", "body-2"]]
    assert value(sandbox, finder, pairs.format("parts(kind='body')[:1], parts(kind='body')[1:]")) == [
        ["body-1", "body-2"]
    ]
    assert value(sandbox, finder, pairs.format("parts(kind='body')[1:]")) == []
    assert value(sandbox, finder, "parts(kind='body')[0].overlap_with(parts(kind='body')[1])") == 2e-7
    assert ("body-1", "body-3") not in finder.asked, "their boxes are apart"


def test_only_closed_bodies_can_overlap(sandbox: Sandbox, finder: FakePartFinder) -> None:
    outcome = sandbox.run("solution = overlaps(parts(kind='hole')[:2] + parts(kind='hole')[:2])", finder)
    assert outcome.status is RunStatus.OK  # none of their boxes meet, but a hole and itself, which is one part
    outcome = sandbox.run("solution = parts(kind='hole')[0].overlap_with(parts(kind='hole')[1])", finder)
    assert outcome.status is RunStatus.RAISED
    assert "takes bodies" in outcome.message


def test_the_nearest_pair_comes_first_and_one_part_has_no_neighbour(sandbox: Sandbox, finder: FakePartFinder) -> None:
    pairs = value(sandbox, finder, "[[a.id, b.id] for a, b in nearest(parts(kind='hole'))]")
    gaps = value(sandbox, finder, "[distance(a.center, b.center) for a, b in nearest(parts(kind='hole'))]")
    least = (
        "min([distance(a.center, b.center) for a in parts(kind='hole') for b in parts(kind='hole') if a.id != b.id])"
    )
    assert len(pairs) == 3
    assert gaps == sorted(gaps)
    assert gaps[0] == value(sandbox, finder, least)
    assert value(sandbox, finder, "nearest(parts(kind='hole')[:1])") == []


@pytest.mark.parametrize("others", ["", ", parts(kind='slot')", ", parts()"])
def test_the_closest_pair_is_that_of_all_pairs_and_few_are_measured(sandbox: Sandbox, others: str) -> None:
    boxes, all_pairs = Boxes(), Boxes()
    gap = value(sandbox, boxes, f"a, b = closest(parts(kind='hole'){others})\nsolution = a.distance_to(b)")
    second = others.removeprefix(", ") or "parts(kind='hole')"
    every = (
        f"[a.distance_to(b) for a in parts(kind='hole') for b in {second} if a.id < b.id or {bool(others)} and a != b]"
    )
    assert gap == min(value(sandbox, all_pairs, every))
    assert len(boxes.asked) * 20 < len(all_pairs.asked)


def test_fewer_than_two_have_no_closest_pair(sandbox: Sandbox, finder: FakePartFinder) -> None:
    assert value(sandbox, finder, "closest(parts(kind='hole')[:1])") == []
    assert value(sandbox, finder, "closest([])") == []
    assert value(sandbox, finder, "closest(parts(kind='hole'), [])") == []


def test_holes_on_a_circle_are_around_its_middle_in_order(sandbox: Sandbox, finder: FakePartFinder) -> None:
    places = {
        "hole-1": (1.0, 0.0),
        "hole-2": (-1.0, 0.0),
        "hole-3": (0.0, 1.0),
        "hole-4": (0.0, -1.0),
        "hole-5": (3, 0),
    }
    finder.known = [make_part(name, axis=UP, center=(*xy, 0.5)) for name, xy in places.items()]
    finder.known.append(make_part("boss-1", axis=UP, center=(0.0, 0.0, 2.0)))
    found = value(sandbox, finder, "[p.id for p in around(parts(), parts(kind='boss')[0])]")
    turns = [found[i:] + found[:i] for i in range(4)]
    assert ["hole-1", "hole-3", "hole-2", "hole-4"] in turns or ["hole-1", "hole-4", "hole-2", "hole-3"] in turns


@pytest.mark.parametrize(
    ("center", "axis", "apart"),
    [
        ((0.5, 0.03, 0.7), (1.0, 0.0, 0.0), 0.01),
        ((0.5, 0.03, 0.7), (0.8, 0.0, 0.6), 0.01),
        ((0.5, 0.02, 0.7), (1.0, 0.0, 0.0), 0.0),
        ((0.02, 0.05, 0.7), (0.0, 0.6, 0.8), 0.0),
        ((0.05, 0.06, 0.7), (0.0, 0.0, -1.0), 0.05),
    ],
)
def test_axes_that_are_not_parallel_are_apart_by_what_is_square_to_both(
    sandbox: Sandbox, finder: FakePartFinder, center: Vector, axis: Vector, apart: float
) -> None:
    finder.known = [make_part("hole-1", axis=UP, center=(0.02, 0.02, 0.0))]
    finder.known.append(make_part("boss-1", axis=axis, center=center))
    for pair in ("a, b", "b, a"):
        code = f"a, b = parts(kind='hole')[0], parts(kind='boss')[0]\nsolution = offset({pair})"
        assert value(sandbox, finder, code) == pytest.approx(apart, abs=1e-12)


def test_a_rounded_corner_has_the_axis_of_its_faces_where_they_share_one(
    sandbox: Sandbox, finder: FakePartFinder, monkeypatch: pytest.MonkeyPatch
) -> None:
    places = {1: (0.02, 0.02, 0.0), 2: (0.02, 0.02, 0.01), 3: (0.05, 0.02, 0.0)}
    monkeypatch.setattr(
        finder, "faces", lambda ids: tuple(make_face(i, axis_point=places[i], convexity="convex") for i in ids)
    )
    hole = make_part("hole-1", axis=UP, center=(0.02, 0.02, 0.005))
    rounds = [("round-1", (1,)), ("round-2", (1, 2)), ("round-3", (1, 3)), ("round-4", (3,))]
    finder.known = [hole, *(make_part(name, kind="round", faces=faces) for name, faces in rounds)]
    found = value(sandbox, finder, "[coaxial(r, parts(kind='hole')[0]) for r in parts(kind='round')]")
    assert found == [True, True, False, False]


@pytest.mark.parametrize(
    ("call", "expected"),
    [
        ("coaxial(parts(kind='hole')[0], parts(kind='hole')[0])", True),
        ("coaxial(parts(kind='hole')[0], parts(kind='hole')[1])", False),
        ("coaxial(parts(kind='hole')[0], parts(kind='slot')[0])", False),
        ("offset(parts(kind='hole')[0], parts(kind='hole')[2])", 0.06),
        ("offset(parts(kind='slot')[0], parts(kind='boss')[0])", 0.0045),
        ("[f.radius for f in faces(kind='cylinder')]", [0.0025]),
        ("len(faces())", 2),
        ("len(faces(kind='cone'))", 0),
        ("adjacent(parts(kind='hole')[0], faces(kind='cylinder')[0])", True),
        ("adjacent(parts(kind='slot')[0], faces(kind='plane')[0])", False),
        ("parts(kind='boss')[0].size_in(parts(kind='boss')[0].frame)", [0.02, 0.03, 0.01]),
    ],
)
def test_what_is_asked_of_parts_and_faces(sandbox: Sandbox, finder: FakePartFinder, call: str, expected: Any) -> None:
    assert value(sandbox, finder, call) == pytest.approx(expected)


@pytest.mark.parametrize(
    ("call", "message"),
    [
        ("parts(kind='holes')", "ValueError: no kind of part is called 'holes'; this model has hole, slot, boss"),
        ("parts(kind=3)", "TypeError: kind takes a word such as 'hole'"),
        ("parts(tags=['threded'])", "ValueError: no part of this model has the tag 'threded'; there are through, circ"),
        ("parts(tags=3)", "TypeError: tags takes a word or a list of words"),
        ("parts(side='upper')", "ValueError: no side is called 'upper': use top, bottom"),
        ("parts(diameter='5 mm')", "TypeError: diameter takes a length in metres"),
        ("parts(diameter=-1)", "ValueError: diameter takes a length above 0"),
        ("parts(near='hole')", "TypeError: near takes a part, a face or a point"),
        ("faces(kind='hole')", "ValueError: no kind is called 'hole': use plane, cylinder"),
        ("faces(facing='up')", "ValueError: no facing is called 'up': use top"),
        ("faces(coaxial_with=parts(kind='slot')[0])", "ValueError: part 'slot-1' has no axis"),
        ("faces(body='plate')", "TypeError: body takes one of shape.bodies, or its id"),
        (
            "offset(parts(kind='slot')[0], parts(kind='hole')[0])",
            "ValueError: offset() takes two axes, two parallel planes, or a plane and an axis along it; these are: "
            "axis along (0, 0, 1) and plane square to (0, 0, 1)",
        ),
        (
            "offset(parts(kind='body')[0], parts(kind='hole')[0])",
            "ValueError: offset() takes two axes, two parallel planes, or a plane and an axis along it; one of these",
        ),
        ("coaxial(1, 2)", "TypeError: this takes parts or faces, not int"),
        ("outermost(parts(), 'up')", "ValueError: no side is called 'up'"),
        ("parts(kind='hole')[0].size_in(3)", "TypeError: size_in() takes a frame, such as part.frame"),
    ],
)
def test_what_is_not_known_is_told_and_not_guessed(
    sandbox: Sandbox, finder: FakePartFinder, call: str, message: str
) -> None:
    outcome = sandbox.run(f"solution = {call}", finder)
    assert outcome.status is RunStatus.RAISED
    assert outcome.message.startswith(message)


def test_parts_and_faces_are_what_an_answer_rests_on(sandbox: Sandbox, finder: FakePartFinder) -> None:
    outcome = sandbox.run("solution = max(p.diameter for p in parts(kind='hole'))", finder)
    assert outcome.groundings[0].description == "parts(kind='hole')"
    assert outcome.used_parts == ("hole-1", "hole-2", "hole-3")
    outcome = sandbox.run("solution = sum(f.area for f in faces(kind='cylinder'))", finder)
    assert outcome.used_parts == ("faces-1",)


def test_the_model_is_asked_once_for_all_its_parts(sandbox: Sandbox, finder: FakePartFinder) -> None:
    sandbox.run("solution = sum(len(parts(diameter=d / 1000)) for d in range(1, 60))", finder)
    assert finder.calls == [("parts", None)]


def test_a_part_is_the_same_however_it_is_found(sandbox: Sandbox, finder: FakePartFinder) -> None:
    assert value(sandbox, finder, "parts(kind='hole')[0] == find_parts('hole')[0]") is True


def test_a_face_knows_its_part_and_its_neighbours(sandbox: Sandbox, finder: FakePartFinder) -> None:
    finder.known = [make_part("hole-1", faces=(4,))]

    def faces(ids: Any) -> tuple[Face, ...]:
        made = {4: make_face(4, part="hole-1", neighbours=(5,)), 5: make_face(5, neighbours=(4,), part="body-9")}
        return tuple(made[i] for i in ids)

    finder.faces = faces  # type: ignore[method-assign]
    assert value(sandbox, finder, "parts()[0].faces[0].part.id") == "hole-1"
    assert value(sandbox, finder, "[f.id for f in parts()[0].faces[0].neighbours]") == [5]
    assert value(sandbox, finder, "parts()[0].faces[0].neighbours[0].part is None") is True


def test_words_that_were_left_out_are_told_with_the_parts(sandbox: Sandbox, finder: FakePartFinder) -> None:
    found = finder.find_parts

    def find_parts(description: Any, sides: Any = None) -> Any:
        left = {"ignored": ("shiny",), "unchecked": ("'painted'",)} if "shiny" in description else {}
        return found(description, sides).model_copy(update=left)

    finder.find_parts = find_parts  # type: ignore[method-assign]
    code = (
        'shiny = find_parts("shiny painted hole")\nplain = find_parts("hole")\n'
        "solution = [shiny.ignored_words, shiny.not_checked, plain.ignored_words, len(shiny)]"
    )
    assert value(sandbox, finder, code) == [["shiny"], ["'painted'"], [], 3]


@pytest.mark.parametrize(
    ("code", "run"),
    [
        ("solution = 1  # no ignored word", "solution = 1  # no ignored word"),
        ("x = find_parts('a').not_checked", "x = _left(_noted(find_parts('a')), \"not_checked\")"),
        ("x = (a) .ignored_words[0] + 'é'", "x = _left((a), \"ignored_words\")[0] + 'é'"),
        ("x = a.ignored_words +", "x = a.ignored_words +"),
    ],
)
def test_only_what_a_list_cannot_have_is_said_otherwise(code: str, run: str) -> None:
    assert rewritten(code) == run


def hole(**measures: Any) -> Part:
    return make_part("hole-1", kind="hole", opening=(0.0, 0.0, 0.01), normal=UP, **measures)


def test_what_goes_through_has_two_openings_and_what_does_not_has_one() -> None:
    first, second = openings_of(hole(bottom="through", depth=0.01))
    assert (first.center, second.center) == ((0.0, 0.0, 0.01), (0.0, 0.0, 0.0))
    assert (first.normal, second.normal, first.outline) == (UP, (-0.0, -0.0, -1.0), Outline.CIRCLE)
    assert len(openings_of(hole(bottom="flat", depth=0.004))) == 1
    assert openings_of(make_part("boss-1")) == []


def test_a_frame_is_along_the_axis_and_the_longest_face_across_it() -> None:
    side = (0.0, 1.0, 0.0)
    faces = [make_face(1, along=RIGHT, length=1.0, normal=UP), make_face(2, along=side, length=2.0, normal=UP)]
    frame = part_frame(make_part("slot-1", normal=UP), faces)
    assert frame is not None
    assert (frame.z, frame.x, frame.y) == (UP, side, (-1.0, 0.0, 0.0))
    assert part_frame(make_part("body-1"), faces) is None
    assert face_frame(make_face(1)) is None
