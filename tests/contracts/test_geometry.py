"""Kinds of parts: what they are to the material, and how they look on the wire."""

from __future__ import annotations

import pytest
from pydantic import ValidationError

from querycad_contracts import Evidence, Part, PartKind, as_drawn

EVIDENCE = Evidence(source="geometry", confidence=1.0, reason="")


def part(kind: str) -> Part:
    origin = (0.0, 0.0, 0.0)
    return Part(id="a", kind=kind, label="", faces=(), center=origin, extents=origin, evidence=EVIDENCE)


@pytest.mark.parametrize("kind", PartKind)
def test_a_kind_is_a_plain_word_on_the_wire(kind: PartKind) -> None:
    sent = part(kind.value).model_dump_json()
    assert f'"kind":"{kind.name.lower()}"' in sent
    assert Part.model_validate_json(sent).kind is kind


def test_a_kind_that_nobody_knows_is_refused() -> None:
    with pytest.raises(ValidationError, match="kind"):
        part("gizmo")


@pytest.mark.parametrize("kind", PartKind)
def test_no_kind_is_two_things_to_the_material(kind: PartKind) -> None:
    assert kind.stands_out + kind.cuts_in + kind.breaks_edge <= 1


def test_what_drills_and_mills_leave_cuts_in_and_a_closed_void_does_not() -> None:
    assert PartKind.HOLE.cuts_in
    assert PartKind.POCKET.cuts_in
    assert not PartKind.CAVITY.cuts_in


def test_bosses_stand_out_and_bodies_do_not() -> None:
    assert PartKind.BOSS.stands_out
    assert not PartKind.BODY.stands_out
    assert [kind for kind in PartKind if kind.breaks_edge] == [PartKind.CHAMFER, PartKind.FILLET, PartKind.ROUND]


@pytest.mark.parametrize(
    ("value", "wanted", "alike"),
    [
        (0.01004, 0.01, True),
        (0.01006, 0.01, False),
        (0.001009, 0.001, True),
        (0.001011, 0.001, False),
    ],
)
def test_a_length_is_as_drawn_to_half_a_tenth_or_a_hundredth_of_it(value: float, wanted: float, alike: bool) -> None:
    assert as_drawn(value, wanted) is alike
