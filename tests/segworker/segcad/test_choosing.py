"""From words to parts: what size, place and number tell apart, what sides may not change, what is said to be unsure."""

from __future__ import annotations

from typing import Any

import pytest

from querycad_contracts import Evidence, Grounding, Part, Side
from querycad_segworker.segcad.ground import ground
from querycad_segworker.segcad.places import is_inside


def part(letter: str, kind: str, tags: str = "", **measures: Any) -> Part:
    """A part whose id is a letter; sizes in metres."""
    fields = {"label": letter, "faces": (ord(letter),), "center": (0.0, 0.0, 0.0), "extents": (0.01, 0.01, 0.01)}
    evidence = Evidence(source="geometry", confidence=1.0, reason="built by hand")
    return Part(id=letter, kind=kind, tags=tuple(tags.split()), evidence=evidence, **{**fields, **measures})


def hole(letter: str, x: float, y: float, diameter: float, tags: str = "through repeated", **more: Any) -> Part:
    return part(letter, "hole", tags, center=(x, y, 0.005), axis=(0.0, 0.0, 1.0), diameter=diameter,
                radius=diameter / 2, sides=(Side.TOP,), **more)  # fmt: skip


PLATE = [
    part("m", "model", name="cover_plate", center=(0.0, 0.0, 0.005), extents=(0.1, 0.08, 0.01)),
    part("b", "body", "solid plate", name="cover_plate", extents=(0.1, 0.08, 0.01), faces=tuple(range(200))),
    hole("p", -0.04, -0.03, 0.0055),
    hole("q", 0.04, -0.03, 0.0055),
    hole("r", -0.04, 0.03, 0.0055),
    hole("s", 0.04, 0.03, 0.0055),
    hole("t", 0.0, 0.0, 0.04, "through central"),
    hole("u", 0.02, 0.0, 0.003, "blind", depth=0.004),
    hole("v", -0.02, 0.0, 0.003, "blind", depth=0.008),
    part("w", "fillet", "rounded inner", radius=0.002),
    part("x", "pocket", "rectangular closed blind", center=(0.0, 0.02, 0.008), sides=(Side.BOTTOM,),
         extents=(0.02, 0.01, 0.004)),
    part("y", "cutout", "elongated rectangular through closed", sides=(Side.TOP,)),
]  # fmt: skip

ASSEMBLY = [
    part("m", "model", name="motor_unit"),
    part("a", "body", "solid", name="ISO 4762 M5x20", color="#c0c0c0"),
    part("b", "body", "solid", name="ISO 4762 M6x20", color="#c0c0c0"),
    part("c", "body", "solid", name="Motor housing", color="#ff8000", extents=(0.1, 0.1, 0.1)),
    part("d", "body", "solid", name="Upper plate", center=(0.0, 0.0, 0.2)),
    part("e", "body", "solid", name="Lower plate", center=(0.0, 0.0, -0.2)),
    hole("p", 0.0, 0.0, 0.0055),
]


def found(parts: list[Part], description: str, *sides: Side) -> str:
    grounding = ground(parts, description, sides or None)
    assert grounding.understood, grounding.message
    return "".join(p.id for p in grounding.parts)


def unsure(grounding: Grounding) -> bool:
    return bool(grounding.warnings) and all(p.evidence.confidence < 1.0 for p in grounding.parts)


@pytest.mark.parametrize(
    ("description", "expected"),
    [
        ("large hole", "t"),
        ("big opening", "t"),
        ("small holes", "uv"),
        ("deep blind hole", "v"),
        ("shallow blind hole", "u"),
        ("corner hole", "pqrs"),
        ("central hole", "t"),
        ("four holes", "pqrs"),
        ("4 mounting holes", "pqrs"),
        ("2 small holes", "uv"),
        ("lightening hole", "pqrs"),
        ("mounting hole", "pqrs"),
    ],
)
def test_parts_of_one_kind_are_told_apart_by_size_place_and_number(description: str, expected: str) -> None:
    assert found(PLATE, description) == expected


def test_a_number_that_does_not_fit_is_said() -> None:
    grounding = ground(PLATE, "nine holes", None)
    assert len(grounding.parts) == 7
    assert unsure(grounding)


@pytest.mark.parametrize(
    ("description", "expected"), [("inside radius", "w"), ("inside", "x"), ("rectangular inside", "x")]
)
def test_a_preposition_may_be_part_of_a_noun(description: str, expected: str) -> None:
    assert found(PLATE, description) == expected


def test_a_side_chooses_among_the_parts_a_word_means_and_does_not_change_its_meaning() -> None:
    assert found(PLATE, "pocket") == "x"
    assert found(PLATE, "pocket", Side.TOP) == ""
    assert "none visible from top" in (ground(PLATE, "pocket", [Side.TOP]).message or "")


@pytest.mark.parametrize("noun", ["cover plate", "cover", "bracket", "complete plate", "gripper"])
def test_a_product_noun_means_the_only_body(noun: str) -> None:
    assert found(PLATE, noun) in ("m", "b")


def test_a_place_that_holds_parts_selects_them() -> None:
    pocket_hole = hole("z", 0.0, 0.02, 0.003, "blind", opening=(0.0, 0.02, 0.007))
    assert found([*PLATE, pocket_hole], "hole in the rectangular pocket") == "z"


def test_a_place_that_cannot_be_checked_is_left_out_aloud() -> None:
    grounding = ground(PLATE, "blind hole in the flange", None)
    assert "".join(p.id for p in grounding.parts) == "uv"
    assert unsure(grounding)
    assert any("flange" in warning for warning in grounding.warnings)


def test_a_body_of_an_assembly_that_holds_nothing_holds_nothing() -> None:
    far = part("f", "body", "solid", name="Cover", center=(1.0, 1.0, 1.0))
    assert found([*ASSEMBLY, far], "hole in the cover") == ""


@pytest.mark.parametrize(
    ("description", "expected"),
    [
        ("ISO 4762", "ab"),
        ("M5 screw", "a"),
        ("M6 screws", "b"),
        ("ISO 4762 screw", "ab"),
        ("motor housing", "c"),
        ("orange part", "c"),
        ("grey parts", "ab"),
        ("upper plate", "d"),
        ("bottom plate", "e"),
        ("motor unit", "m"),
        ("motor", "m"),
    ],
)
def test_names_colours_and_threads_choose_bodies(description: str, expected: str) -> None:
    assert found(ASSEMBLY, description) == expected


def test_a_word_before_a_known_noun_is_left_out_at_half_the_confidence() -> None:
    grounding = ground(PLATE, "zorblax blind hole", None)
    assert "".join(p.id for p in grounding.parts) == "uv"
    assert max(p.evidence.confidence for p in grounding.parts) <= 0.5


@pytest.mark.parametrize(("word", "expected"), [("blindhole", "uv"), ("mountinghole", "pqrs")])
def test_closed_compounds_are_taken_apart(word: str, expected: str) -> None:
    assert found(PLATE, word) == expected


def test_a_unified_thread_chooses_its_tap_drill_and_clearance_holes() -> None:
    holes = [hole("p", 0.0, 0.0, 0.0051), hole("q", 0.0, 0.0, 0.00675), hole("r", 0.0, 0.0, 0.008)]
    assert found(holes, "1/4-20 hole") == "pq"


def test_a_purpose_hardly_lowers_the_confidence() -> None:
    grounding = ground(PLATE, "blind hole for the dowel pins", None)
    assert "".join(p.id for p in grounding.parts) == "uv"
    assert all(0.8 < p.evidence.confidence < 1.0 for p in grounding.parts)


def test_what_lies_between_around_and_next_to_parts() -> None:
    def round_part(letter: str, tags: str, x: float, y: float, length: float, diameter: float) -> Part:
        size = {"extents": (length, diameter, diameter), "radius": diameter / 2, "diameter": diameter}
        return part(letter, "boss", f"cylindrical circular {tags}", center=(x, y, 0.0), axis=(1.0, 0.0, 0.0), **size)

    flanges = [round_part("f", "flat", 0.0, 0.0, 0.01, 0.1), round_part("g", "flat", 0.2, 0.0, 0.01, 0.1)]
    tubes = [round_part("t", "hollow", 0.1, 0.0, 0.19, 0.04), round_part("u", "hollow", 0.1, 0.3, 0.19, 0.04)]
    parts = [*flanges, *tubes]
    assert found(parts, "tube") == "tu"
    assert found(parts, "tube between the flanges") == "t"
    assert found(parts, "tube near the flanges") == "t"
    assert found(parts, "flange around the tube") == "fg"


def test_where_no_hole_has_a_bevel_the_widened_ones_are_meant_and_the_answer_is_unsure() -> None:
    holes = [hole("p", 0.0, 0.0, 0.005), hole("q", 0.02, 0.0, 0.005, "through counterbored stepped")]
    assert found([*PLATE[:2], *holes], "hole with a bevel") == "q"
    assert unsure(ground([*PLATE[:2], *holes], "hole with a bevel", None))
    assert found([*PLATE[:2], *holes], "hole without a bevel") == "pq"
    assert ground([*PLATE[:2], *holes], "chamfered hole", None).parts == ()


def test_a_body_that_stands_out_of_a_larger_one_is_a_protrusion() -> None:
    plate = part("a", "body", "solid plate", name="Plate", extents=(0.1, 0.1, 0.01), faces=(1, 2, 3))
    disc: dict[str, Any] = {"diameter": 0.06, "radius": 0.03, "axis": (0.0, 0.0, 1.0), "center": (0.0, 0.0, -0.01)}
    size = (0.06, 0.06, 0.01)
    body = part("b", "body", "solid disc", name="Flange", faces=(4, 5, 6), extents=size, **disc)
    boss = part("c", "boss", "cylindrical", faces=(4, 5), extents=size, **disc)
    alone = part("m", "model", name="unit")
    assert (
        found([alone, plate, body, boss, part("d", "boss", "cylindrical", diameter=0.01)], "circular protrusion")
        == "cd"
    )
    assert found([alone, body, boss, part("d", "boss", "cylindrical", diameter=0.01)], "circular protrusion") == "d"


def test_gaps_between_letters_are_meant_only_where_nothing_else_is() -> None:
    cover = part("a", "body", "solid plate", name="Cover", faces=(1, 2, 3))
    logo = part("b", "body", "solid", name="Logo", faces=(4, 5, 6))
    slots = [part("c", "slot", "open elongated", faces=(1, 2)), part("d", "slot", "open elongated", faces=(5, 6))]
    model = part("m", "model", name="unit")
    assert found([model, cover, logo, *slots], "slot") == "c"
    assert found([model, cover, logo, slots[1]], "slot") == "d"


def test_on_a_bolt_circle_is_what_belongs_to_it() -> None:
    circle = part("z", "pattern", "bolt_circle", children=("hole-1",), extents=(0.1, 0.1, 0.01), diameter=0.08)
    member = hole("p", 0.04, 0.0, 0.005).model_copy(update={"id": "hole-1"})
    other = hole("q", 0.01, 0.0, 0.005).model_copy(update={"id": "hole-2"})
    assert is_inside(member, circle)
    assert not is_inside(other, circle)


STANDING = [
    part("m", "model", name="drill_jig", extents=(0.16, 0.08, 0.04)),
    part("b", "body", "solid rectangular", name="drill_jig", extents=(0.16, 0.08, 0.04)),
    part("p", "boss", "cylindrical slender", center=(-0.05, 0.02, 0.02), normal=(0.0, 0.0, 1.0), diameter=0.008,
         radius=0.004, height=0.014, sides=(Side.TOP, Side.RIGHT)),
    part("q", "boss", "cylindrical slender", center=(0.05, 0.02, 0.02), normal=(0.0, 0.0, 1.0), diameter=0.008,
         radius=0.004, height=0.014, sides=(Side.TOP, Side.RIGHT)),
    part("h", "boss", "cylindrical slender", center=(0.08, 0.0, 0.0), normal=(1.0, 0.0, 0.0), diameter=0.012,
         radius=0.006, height=0.04, sides=(Side.TOP, Side.RIGHT)),
]  # fmt: skip


@pytest.mark.parametrize(
    ("description", "sides", "letters"),
    [
        ("pin", (Side.TOP,), "pqh"),
        ("pin on top", (Side.TOP,), "pq"),
        ("pin on the right side", (), "h"),
        ("left pin", (), "p"),
        ("2 pin", (), "pq"),
        ("handle on right", (Side.RIGHT,), "h"),
        ("handle", (), "m"),
        ("threaded pin", (), "pqh"),
    ],
)
def test_what_stands_on_a_side_points_to_it(description: str, sides: tuple[Side, ...], letters: str) -> None:
    assert found(STANDING, description, *sides) == letters


def test_a_feature_of_the_only_body_is_never_the_body() -> None:
    assert found(STANDING[:2], "rectangular protrusion") == ""


def test_holes_at_the_top_that_look_elsewhere_are_the_topmost_ones() -> None:
    holes = [hole("p", 0.0, 0.0, 0.004), hole("q", 0.03, 0.0, 0.004)]
    low, high = (
        h.model_copy(update={"center": (0.0, 0.0, z), "sides": (Side.FRONT,)})
        for h, z in zip(holes, (0.0, 0.05), strict=True)
    )
    model = [part("m", "model", name="bracket", extents=(0.1, 0.02, 0.1)), low, high]
    grounding = ground(model, "hole on top", (Side.TOP,))
    assert [p.id for p in grounding.parts] == ["q"]
    assert unsure(grounding)


def test_a_screw_head_is_no_cylinder_head() -> None:
    parts = [
        part("m", "model", name="compressor"),
        part("a", "body", "solid", name="Cylinder head"),
        part("b", "body", "solid screw", name="Screw M6"),
        part("h", "prism", "head hexagonal", faces=(7,)),
    ]
    assert found(parts, "hexagonal screw head") == "h"
    assert found(parts, "cylinder head") == "a"
