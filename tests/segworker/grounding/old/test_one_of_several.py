"""'The hole' in the singular: of several that differ the one that stands out, and the answer says so."""

from __future__ import annotations

from typing import Any

import pytest

from querycad_contracts import Evidence, Part, Side
from querycad_segworker.grounding.old.ground import ground


def part(letter: str, kind: str, tags: str = "", **measures: Any) -> Part:
    """A part whose id is a letter; sizes in metres."""
    fields = {"label": letter, "faces": (ord(letter),), "center": (0.0, 0.0, 0.0), "extents": (0.01, 0.01, 0.01)}
    evidence = Evidence(source="geometry", confidence=1.0, reason="built by hand")
    return Part(id=letter, kind=kind, tags=tuple(tags.split()), evidence=evidence, **{**fields, **measures})


def hole(letter: str, x: float, diameter: float, depth: float = 0.01) -> Part:
    return part(letter, "hole", "through", center=(x, 0.0, 0.0), axis=(0.0, 0.0, 1.0), normal=(0.0, 0.0, 1.0),
                diameter=diameter, radius=diameter / 2, depth=depth, sides=(Side.TOP,))  # fmt: skip


BLOCK = [
    part("m", "model", name="rocker", extents=(0.1, 0.05, 0.02)),
    part("b", "body", "solid", name="rocker", extents=(0.1, 0.05, 0.02)),
    hole("p", -0.04, 0.02),
    hole("q", 0.03, 0.0085, depth=0.03),
    hole("r", 0.04, 0.0085),
    part("s", "fillet", "rounded", radius=0.002, diameter=0.004),
    part("t", "fillet", "rounded", radius=0.005, diameter=0.01),
]


def found(description: str, *sides: Side) -> str:
    return "".join(p.id for p in ground(BLOCK, description, sides or None).parts)


@pytest.mark.parametrize(
    ("description", "expected"),
    [
        ("the bore", "p"),
        ("the hole", "p"),
        ("hole", "pqr"),
        ("holes", "pqr"),
        ("the holes", "pqr"),
        ("the 3 holes", "pqr"),
        ("the small hole", "qr"),
        ("the short hole", "pr"),
        ("the deep hole", "q"),
        ("the right hole", "r"),
    ],
)
def test_the_one_that_stands_out_is_meant(description: str, expected: str) -> None:
    assert found(description) == expected


def test_that_a_choice_was_made_is_said() -> None:
    grounding = ground(BLOCK, "the bore", None)
    assert any("of 3 the largest" in warning for warning in grounding.warnings)
    assert grounding.parts[0].evidence.confidence < 1.0
    assert ground(BLOCK, "bore", None).warnings == ()


def test_of_holes_that_are_equally_wide_the_deepest_stands_out() -> None:
    narrow = [part for part in BLOCK if part.id != "p"]
    assert [p.id for p in ground(narrow, "the hole", None).parts] == ["q"]


def test_no_fillet_stands_out() -> None:
    assert found("the fillet") == "st"


def test_on_a_side_is_the_one_that_lies_farthest_there() -> None:
    assert found("the hole on the right", Side.TOP) == "r"
    assert found("the hole on the left", Side.TOP) == "p"


def test_a_pick_takes_as_many_as_are_counted() -> None:
    bores = [*BLOCK[:3], hole("q", 0.03, 0.015), hole("r", 0.04, 0.005)]
    assert "".join(p.id for p in ground(bores, "the 2 bearing bores", None).parts) == "pq"
    assert "".join(p.id for p in ground(bores, "bearing bore", None).parts) == "p"


def test_of_what_stands_out_the_one_nearest_to_the_side_is_meant() -> None:
    """Both flanges are seen from the top; a hole that is seen from there need not be the topmost one."""
    seen = {"axis": (0.0, 0.0, 1.0), "normal": (0.0, 0.0, 1.0), "sides": (Side.TOP, Side.BOTTOM)}
    column = [
        part("m", "model", name="column", extents=(0.4, 0.4, 0.5)),
        part("b", "body", "solid", name="column", extents=(0.4, 0.4, 0.5)),
        part("u", "boss", "flange disc", center=(0.0, 0.0, 0.24), diameter=0.2, radius=0.1, **seen),
        part("v", "boss", "flange disc", center=(0.0, 0.0, -0.24), diameter=0.4, radius=0.2, **seen),
    ]
    for side, expected in ((Side.TOP, "u"), (Side.BOTTOM, "v")):
        assert [p.id for p in ground(column, "the flange", (side,)).parts] == [expected]
