"""What looks like a part and is none is refused with a reason."""

from __future__ import annotations

import pytest
from OCP.TopoDS import TopoDS_Shape
from tests.segworker.shapes import (
    DOWN,
    ball,
    box,
    compound,
    cone,
    cut,
    cylinder,
    extruded,
    find,
    fuse,
    plate,
    torus,
    turned,
)

from querycad_segworker.features.shared.refusals import gathering, refuse


def rings(width: float) -> TopoDS_Shape:
    """One in the other, side by side."""
    sizes = ((10, 14, 14), (19, 23, width))
    return compound(*(cut(cylinder(b, w, (0, 0, -w / 2)), cylinder(a, w, (0, 0, -w / 2))) for a, b, w in sizes))


def circle(radius: float, angles: list[float]) -> TopoDS_Shape:
    holes = [turned(cylinder(2, 20, (radius, 0, -20)), (0, 0, 1), angle) for angle in angles]
    return cut(plate(80, 80), *holes)


def three_quarters() -> TopoDS_Shape:
    """A hole at the edge of a plate: less than half of its wall is left."""
    return cut(plate(), cylinder(6, 20, (30, 0, -20)))


@pytest.mark.parametrize(
    ("shape", "kind", "reason"),
    [
        (three_quarters(), "hole", "covers 180 of 360 degrees"),
        (cut(plate(), torus(6, 2)), "hole", "torus"),
        (
            extruded([(5, -12), (12, -5), (12, 5), (5, 12), (-5, 12), (-12, 5), (-12, -5), (-5, -12)], 0, 20),
            "chamfer",
            "shapes the body",
        ),
        (extruded([(0, 0), (30, 0), (39.06, 4.23), (58.3, 27.2), (0, 27.2)], 0, 50), "chamfer", "right angle"),
        (fuse(plate(), box((20, 5, 3), (-10, -2.5, 0))), "rib", "too thick"),
        (circle(25, [0, 70, 130, 200, 290]), "pattern", "5 alike"),
        (rings(8), "bearing", "unlike widths"),
        (cut(cylinder(12, 60), cut(cylinder(12, 30, (0, 0, 15)), cylinder(8, 30, (0, 0, 15)))), "groove", "wider"),
        (
            fuse(cylinder(6, 30), cylinder(10, 8, (0, 0, 30)), cylinder(7, 60, (0, 0, 38))),
            "screw",
            "goes on",
        ),
        (cut(plate(), ball(5, (30, 0, 0))), "dimple", "rim"),
        (fuse(plate(60, 40, 2), box((50, 30, 100), (-25, -15, 0))), "protrusion", "half"),
    ],
    ids=lambda value: value if isinstance(value, str) else "",
)
def test_what_is_refused_says_why(shape: TopoDS_Shape, kind: str, reason: str) -> None:
    found = [refusal for refusal in find(shape).refused if refusal.kind == kind]
    assert any(reason in refusal.reason for refusal in found), found


def test_the_faces_of_a_refusal_are_no_part_of_that_kind() -> None:
    tools = [cylinder(4, 20, (-10, 0, -20)), box((10, 40, 5), (5, -20, -5)), cone(5, 0, 5, (-20, 9, 0), DOWN)]
    found = find(cut(three_quarters(), *tools))
    assert found.refused
    for refusal in found.refused:
        assert refusal.faces
        assert refusal.reason
        assert not any(set(refusal.faces) <= set(part.faces) for part in found.of(refusal.kind))


def test_reasons_are_gathered_inside_the_block_alone_and_once() -> None:
    refuse("hole", [1], "outside")
    with gathering() as outer:
        refuse("hole", [2, 1], "first")
        with gathering() as inner:
            refuse("slot", [3], "second")
        refuse("hole", [1, 2], "first")
    assert [(r.kind, r.faces, r.reason) for r in outer] == [("hole", (1, 2), "first")]
    assert [(r.kind, r.faces, r.reason) for r in inner] == [("slot", (3,), "second")]
