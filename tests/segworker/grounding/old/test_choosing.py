"""From words to parts: what size, place and number tell apart, what sides may not change, what is said to be unsure."""

from __future__ import annotations

from typing import Any

import pytest

from querycad_contracts import Evidence, Grounding, Part, Side
from querycad_segworker.grounding.old.ground import ground
from querycad_segworker.grounding.old.places import is_inside


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


def test_the_pitch_tells_which_drill_a_thread_was_tapped_after() -> None:
    holes = [hole(letter, 0.0, 0.0, d) for letter, d in zip("pqr", (0.0068, 0.007, 0.0088), strict=True)]
    assert found(holes, "M8 hole") == "p"
    assert found(holes, "M8x1 threaded hole") == "q"
    assert found(holes, "M10x1.25 tapped hole") == "r"
    assert found(ASSEMBLY, "M5x0.8 screw") == "a"
    assert found([hole("p", 0.0, 0.0, 0.0051)], "1/4 20 UNC hole") == "p"


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


CASTOR = [
    part("m", "model", name="castor", extents=(0.1, 0.1, 0.2)),
    part("f", "body", "solid", name="Fork", faces=(1, 2, 3, 4, 5, 6)),
    part("t", "body", "solid plate", name="Top plate", faces=(7, 8)),
    part("g", "body", "solid", name="Gear body", faces=(20, 21)),
    part("p", "prism", "plate rectangular", faces=(1, 2)),
    part("q", "prism", "plate rectangular", faces=(3, 4)),
    part("r", "prism", "plate rectangular", faces=(7,)),
]


@pytest.mark.parametrize("words", ["fork leg", "the 2 legs of the fork", "2 leg in fork"])
def test_legs_of_a_fork_are_the_plates_of_the_body_that_is_called_so(words: str) -> None:
    assert found(CASTOR, words) == "pq"


def test_a_model_without_legs_has_none_though_it_has_plates() -> None:
    assert found(CASTOR, "leg") == ""


def test_a_body_may_be_called_body() -> None:
    assert found(CASTOR, "gear body") == "g"
    assert found(CASTOR, "fork body") == "f"


def test_a_noun_before_the_parts_gives_way_to_their_number() -> None:
    def bolt(letter: str, at: int, diameter: float) -> Part:
        return hole(letter, 0.05 * at - 0.1, 0.0, diameter, faces=(at,))

    wheel = part("d", "boss", "cylindrical flat", diameter=0.2, children=("p", "q"), extents=(0.2, 0.2, 0.01))
    holes = [bolt("p", 1, 0.008), bolt("q", 2, 0.008), *(bolt(letter, 3, 0.013) for letter in "uvw")]
    parts = [part("m", "model", name="disc"), wheel, *holes]
    assert found(parts, "wheel bolt hole") == "pq"
    assert found(parts, "3 wheel bolt holes") == "uvw"
    assert unsure(ground(parts, "3 wheel bolt holes", None))


def test_a_groove_around_a_rim_is_on_its_outside() -> None:
    parts = [
        part("m", "model", name="pulley"),
        part("a", "groove", "annular ring"),
        part("b", "groove", "annular outer turned"),
    ]
    assert found(parts, "groove around the rim of the pulley") == "b"
    assert found(parts, "groove") == "ab"


def test_the_pipe_of_an_elbow_is_part_of_it() -> None:
    tubes = [part(letter, "boss", "hollow cylindrical", diameter=0.06, radius=0.03) for letter in "ab"]
    parts = [part("m", "model", name="pipe_elbow"), part("s", "body", "solid", name="pipe_elbow"), *tubes]
    assert found(parts, "pipe") == "ab"
    assert found(parts, "elbow") == "m"


def test_a_bevel_at_a_corner_is_the_corner() -> None:
    bevels = [part("a", "chamfer", center=(-0.03, 0.0, 0.06)), part("b", "chamfer", center=(0.03, 0.0, 0.06)),
              part("c", "chamfer", center=(0.0, 0.0, 0.0)), part("d", "fillet", center=(0.0, 0.0, 0.01))]  # fmt: skip
    parts = [part("m", "model", name="bracket", extents=(0.07, 0.03, 0.06)), *bevels]
    assert found(parts, "bevels at the upper corners") == "ab"
    assert found(parts, "bevel at the corner") == "abc"


def test_what_is_seen_from_a_side_stands_in_for_a_place_there_that_is_not_known() -> None:
    holes = [hole("p", -0.04, 0.0, 0.005), hole("q", 0.04, 0.0, 0.005)]
    left, right = (h.model_copy(update={"sides": (s,)}) for h, s in zip(holes, (Side.LEFT, Side.RIGHT), strict=True))
    grounding = ground(
        [part("m", "model", name="case", extents=(0.1, 0.1, 0.1)), left, right], "hole in left ear", None
    )
    assert "".join(p.id for p in grounding.parts) == "p"
    assert unsure(grounding)


@pytest.mark.parametrize(
    ("words", "kind", "tags"),
    [
        ("skirt", "boss", "hollow cylindrical"),
        ("conical seat", "cone", "inner chamfer"),
        ("runner", "channel", ""),
        ("half round bearing seat", "slot", "semicircular"),
        ("leaf", "prism", "plate"),
        ("web", "rib", ""),
        ("shade", "cone", "outer"),
        ("lip", "boss", "collar"),
        ("throat", "hole", ""),
        ("circle of tapped holes", "pattern", "bolt_circle hole"),
        ("divider", "wall", ""),
        ("spline", "gear", ""),
        ("sprue", "hole", "conical"),
        ("square socket", "pocket", "rectangular"),
        ("square pin", "protrusion", "rectangular"),
        ("rounded plate edge", "round", ""),
        ("trapezoidal pocket", "pocket", "polygonal"),
        ("pole", "boss", "cylindrical"),
    ],
)
def test_nouns_of_the_trade_have_a_meaning(words: str, kind: str, tags: str) -> None:
    others = [part("m", "model", name="thing"), part("o", "bearing"), part("u", "step")]
    assert found([*others, part("x", kind, tags, radius=0.01, diameter=0.02)], words) == "x"


def test_a_plate_is_no_square_pin() -> None:
    assert found([*PLATE[:2], part("x", "prism", "rectangular plate grounded")], "square pin") == ""


def test_a_standoff_without_a_hole_stands_on_a_face() -> None:
    posts = [part(letter, "boss", f"cylindrical {tags}") for letter, tags in (("a", "raised"), ("b", "free"))]
    assert found([*PLATE[:2], *posts, part("c", "boss", "cylindrical raised hollow")], "standoff without a hole") == "a"


@pytest.mark.parametrize("word", ["stump", "root", "land", "crest"])
def test_words_of_the_trade_are_no_slips_of_the_pen(word: str) -> None:
    grounding = ground(PLATE, word, None)
    assert not grounding.understood
    assert grounding.warnings == ()


def round_hole(letter: str, tags: str, diameter: float, **more: Any) -> Part:
    return part(letter, "hole", tags, diameter=diameter, radius=diameter / 2, sides=(Side.TOP,), **more)


COVER = [
    part("m", "model", name="gearbox_cover"),
    round_hole("p", "through repeated spotfaced", 0.009),
    round_hole("q", "through repeated spotfaced", 0.009),
    round_hole("r", "through repeated", 0.006),
    round_hole("s", "through repeated", 0.006),
    round_hole("t", "through conical", 0.05),
    round_hole("u", "through", 0.035),
]


@pytest.mark.parametrize(
    ("words", "expected"),
    [
        ("dowel hole", "rs"),
        ("guide bush bore", "pq"),
        ("bore", "pqrsu"),
        ("hole", "pqrstu"),
        ("the bore", "u"),
        ("pin hole", "rstu"),
    ],
)
def test_holes_are_told_by_what_they_are_for(words: str, expected: str) -> None:
    assert found(COVER, words) == expected


def test_the_bore_of_a_cylinder_is_its_largest_hole_unless_a_body_is_called_so() -> None:
    bores = [
        round_hole(letter, "through", d, faces=(ord(letter),))
        for letter, d in zip("pqr", (0.06, 0.01, 0.06), strict=True)
    ]
    model = part("m", "model", name="engine_block")
    assert found([model, part("c", "cylinder", "outer"), *bores], "bore in 2 cylinders") == "pr"
    bodies = [
        part("a", "body", "solid", name="Cylinder", faces=(ord("q"), 3)),
        part("b", "body", "solid", name="Block"),
    ]
    assert found([model, *bodies, *bores], "bore of the cylinder") == "q"


def test_a_body_that_is_called_a_gear_is_as_wide_as_its_teeth_reach() -> None:
    gear = part("g", "gear", faces=(1, 2), diameter=0.04, radius=0.02, radii=(0.02, 0.014), axis=(0.0, 0.0, 1.0))
    bodies = [part("a", "body", "solid", name="Drive gear", faces=(1, 2, 3), diameter=0.014),
              part("b", "body", "solid", name="Housing", faces=(4,))]  # fmt: skip
    (drive,) = ground([part("m", "model", name="pump"), *bodies, gear], "drive gear", None).parts
    assert drive.id == "a"
    assert drive.diameter == pytest.approx(0.04)
    assert max(drive.radii) == pytest.approx(0.02)


def test_a_named_body_that_has_what_is_denied_is_not_meant() -> None:
    hollow = [part(letter, "body", "solid hollow", name="Standoff M3") for letter in "ab"]
    posts = [part(letter, "body", "solid", name="Support post") for letter in "cd"]
    parts = [part("m", "model", name="board"), *hollow, *posts]
    assert found(parts, "standoff") == "ab"
    assert found(parts, "standoff without a hole") == "cd"


def test_the_underside_of_a_body_stays_so_where_another_body_covers_it() -> None:
    parts = [
        part("m", "model", name="guide"),
        part("a", "body", "solid", name="Carriage", faces=(1, 2, 3)),
        part("b", "body", "solid", name="Rail", faces=(4,)),
        part("c", "channel", "open", faces=(1, 2), normal=(0.0, 0.0, -1.0), sides=(Side.FRONT,)),
        part("d", "channel", "open", faces=(3,), normal=(0.0, 0.0, 1.0), sides=(Side.FRONT,)),
    ]
    assert found(parts, "channel in carriage", Side.BOTTOM) == "c"
    assert unsure(ground(parts, "channel in carriage", [Side.BOTTOM]))
    assert found(parts, "channel", Side.BOTTOM) == ""


def test_a_rod_is_solid_where_there_is_a_solid_one() -> None:
    tube, rod = (
        part(letter, "boss", f"cylindrical slender {tags}") for letter, tags in (("a", "hollow tube"), ("b", ""))
    )
    assert found([*PLATE[:2], tube, rod], "rod") == "b"
    assert found([*PLATE[:2], tube], "rod") == "a"


def test_round_ends_are_not_round_corners() -> None:
    slots = [part("a", "cutout", "obround through elongated"),
             part("b", "cutout", "rectangular through elongated rounded_corners")]  # fmt: skip
    assert found([*PLATE[:2], *slots], "slot with rounded ends") == "a"
    assert found([*PLATE[:2], *slots], "slot with rounded corners") == "ab"


def test_a_washer_face_answers_for_a_washer_that_is_not_there() -> None:
    assert found([*PLATE[:2], part("a", "boss", "cylindrical circular washer_face")], "round washer") == "a"


def test_what_is_missing_is_named_without_its_article() -> None:
    assert ground(PLATE, "the keyway", None).message == "the model has no 'keyway'"
