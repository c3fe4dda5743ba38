"""'The bleed screw hole on the left' is there: its side is surer than what else the words say of it."""

from __future__ import annotations

from typing import Any

import pytest

from querycad_contracts import Evidence, Part, Side
from querycad_segworker.grounding.old.ground import ground
from querycad_segworker.grounding.old.places import is_inside


def part(letter: str, kind: str, tags: str = "", **measures: Any) -> Part:
    """A part whose id is a letter; sizes in metres."""
    fields = {"label": letter, "faces": (ord(letter[0]),), "center": (0.0, 0.0, 0.0), "extents": (0.01, 0.01, 0.01)}
    evidence = Evidence(source="geometry", confidence=1.0, reason="built by hand")
    return Part(id=letter, kind=kind, tags=tuple(tags.split()), evidence=evidence, **{**fields, **measures})


def hole(letter: str, tags: str, side: Side, diameter: float, x: float = 0.0) -> Part:
    return part(letter, "hole", tags, sides=(side,), diameter=diameter, radius=diameter / 2, center=(x, 0.0, 0.0),
                axis=side.outward, normal=side.outward)  # fmt: skip


BLOCK = [
    part("m", "model", name="cap", extents=(0.1, 0.05, 0.02)),
    part("b", "body", "solid", name="cap", extents=(0.1, 0.05, 0.02)),
    hole("p", "through repeated", Side.FRONT, 0.011, -0.03),
    hole("q", "through repeated", Side.FRONT, 0.011, 0.03),
    hole("r", "blind", Side.LEFT, 0.005, -0.04),
    hole("s", "blind", Side.LEFT, 0.009, -0.04),
    hole("t", "blind", Side.TOP, 0.0118),
    part("g", "groove", "outer turned annular", center=(0.0, 0.02, 0.0), sides=(Side.TOP, Side.LEFT)),
]


@pytest.mark.parametrize(
    ("description", "side", "expected"),
    [
        ("the small bleed screw hole", Side.LEFT, "r"),
        ("the mounting hole", Side.TOP, "t"),
        ("the countersunk hole", Side.TOP, ""),
        ("the groove", Side.BACK, "g"),
        ("the groove", Side.FRONT, ""),
        ("the through hole", Side.FRONT, "pq"),
    ],
)
def test_one_that_is_meant_is_looked_for_among_those_visible_from_its_side(
    description: str, side: Side, expected: str
) -> None:
    found = ground(BLOCK, description, (side,))
    assert "".join(one.id for one in found.parts) == expected
    assert all(one.evidence.confidence <= 1.0 for one in found.parts)


@pytest.mark.parametrize("description", ["screw hole", "screw holes", "the screw holes", "through hole"])
def test_none_is_an_answer_where_parts_are_counted(description: str) -> None:
    assert ground(BLOCK, description, (Side.LEFT,)).parts == ()


def test_that_the_side_decided_is_said() -> None:
    found = ground(BLOCK, "the screw hole", (Side.TOP,))
    assert any("visible from there" in warning for warning in found.warnings)
    assert found.parts[0].evidence.confidence < 1.0


def test_teeth_are_in_the_gear_that_they_belong_to_wherever_another_one_meshes() -> None:
    wheel = part("w", "gear", extents=(0.1, 0.1, 0.02), children=("tooth-1.1",))
    own, other = part("tooth-1.1", "tooth"), part("tooth-2.1", "tooth")
    assert is_inside(own, wheel)
    assert not is_inside(other, wheel)


def test_of_gears_that_mesh_the_pinion_is_the_smaller_and_the_ring_gear_the_larger_one() -> None:
    pair = [part("x", "gear", diameter=0.126), part("y", "gear", diameter=0.051)]
    assert [one.id for one in ground(pair, "the pinion", None).parts] == ["y"]
    assert [one.id for one in ground(pair, "the ring gear", None).parts] == ["x"]
