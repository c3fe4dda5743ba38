"""Every family is found alike however the model is turned, scaled, mirrored, stored, or its faces are split."""

from __future__ import annotations

from collections.abc import Callable
from functools import cache
from pathlib import Path

import pytest
from OCP.TopAbs import TopAbs_ShapeEnum
from OCP.TopoDS import TopoDS_Shape
from tests.segworker.shapes import (
    DOWN,
    Found,
    ball,
    bend,
    box,
    chamfered,
    compound,
    cone,
    cut,
    cylinder,
    extruded,
    filleted,
    find,
    fuse,
    gear,
    halved,
    mirrored,
    nurbs,
    plate,
    prism,
    rims,
    scaled,
    shifted,
    shuffled,
    split,
    torus,
    turned,
    upright,
    write_step,
)

from querycad_segworker.brep.step import read_step, subshapes


def reordered(shape: TopoDS_Shape) -> TopoDS_Shape:
    """Each solid with its faces stored in the opposite order."""
    solids = [shuffled(solid) for solid in subshapes(shape, TopAbs_ShapeEnum.TopAbs_SOLID)]
    return solids[0] if len(solids) == 1 else compound(*solids)


X, Y = (1.0, 0.0, 0.0), (0.0, 1.0, 0.0)


def cuts() -> TopoDS_Shape:
    """Pockets, cutouts, slots of all sections, steps, a groove around an island, a notch, a dimple."""
    block = plate(200, 120, 30)
    island = cut(box((40, 24, 4), (-20, 26, -4)), box((32, 16, 4), (-16, 30, -4)))
    hexagon = [(-70, 40), (-66, 33), (-58, 33), (-54, 40), (-58, 47), (-66, 47)]
    return cut(
        block,
        box((30, 20, 10), (-90, -20, -10)),
        extruded(hexagon, -30, 30),
        fuse(box((20, 8, 30), (-40, -34, -30)), cylinder(4, 30, (-40, -30, -30)), cylinder(4, 30, (-20, -30, -30))),
        box((8, 200, 6), (-9, -100, -6)),
        prism([(20, 60, 0), (32, 60, 0), (26, 60, -9)], (0, -120, 0)),
        box((12, 120, 8), (88, -60, -8)),
        shifted(island, (60, 0, 0)),
        cylinder(6, 30, (-30, 60, -30)),
        ball(6, (50, 0, 3)),
        box((40, 8, 30), (-84, 52, -30)),
    )


def turned_part() -> TopoDS_Shape:
    """A shaft with steps, a collar, grooves, a keyway, flats, a centre hole, chamfered and rounded ends."""
    steps = fuse(cylinder(12, 40), cylinder(18, 60, (0, 0, 40)), cylinder(10, 30, (0, 0, 100)))
    steps = fuse(steps, cylinder(26, 6, (0, 0, 60)))
    steps = chamfered(steps, 1.0, *rims(steps, 12, 0))
    steps = filleted(steps, 1.5, *rims(steps, 10, 130))
    ring = cut(cylinder(10, 2, (0, 0, 115)), cylinder(9, 2, (0, 0, 115)))
    key = fuse(box((20, 6, 10), (14, -3, 70)), box((20, 6, 18), (14, -3, 72)))
    return cut(steps, ring, key, torus(18, 2, (0, 0, 50)), cylinder(3, 12), cone(3, 0, 2, (0, 0, 12)))


def standing() -> TopoDS_Shape:
    """Ribs, fins, a boss, a standoff, a square pad, a hexagon, a dome, a cone."""
    base = plate(160, 100, 10)
    things = [box((2, 60, 15), (x, -45, 0)) for x in (-70, -62, -54)]
    things += [box((50, 3, 20), (-40, -40, 0)), box((20, 16, 6), (-30, 10, 0)), cylinder(6, 9, (10, -30, 0))]
    hexagon = [(50, 0), (46, 7), (38, 7), (34, 0), (38, -7), (46, -7)]
    things += [extruded(hexagon, 0, 8), cylinder(7, 14, (60, 30, 0)), cone(8, 3, 12, (60, -30, 0))]
    things += [fuse(cylinder(5, 6, (10, 30, 0)), ball(5, (10, 30, 6)))]
    return cut(fuse(base, *things), cylinder(3, 12, (60, 30, 2)))


def holes() -> TopoDS_Shape:
    """A bolt circle around a bore, a row, a grid of rectangles, counterbored, countersunk, oblique and cross holes."""
    block = plate(160, 100, 30)
    around = [turned(cylinder(2.5, 30, (18, 0, -30)), (0, 0, 1), 60 * i) for i in range(6)]
    row = [cylinder(1.5, 30, (x, 40, -30)) for x in (-60, -50, -40, -30)]
    grid = [box((6, 4, 30), (40 + 12 * i, -40 + 10 * j, -30)) for i in range(3) for j in range(2)]
    return cut(
        block,
        *around,
        *row,
        *grid,
        cylinder(8, 30, (0, 0, -30)),
        cylinder(3, 30, (-60, 0, -30)),
        cylinder(6, 7, (-60, 0, 0), DOWN),
        cylinder(3, 30, (-40, -30, -30)),
        cone(7, 0, 7, (-40, -30, 0), DOWN),
        cylinder(3, 40, (60, 30, -8), (0.4, 0, 1)),
        cylinder(2, 60, (-60, -60, -15), Y),
        cylinder(4, 20, (-80, -40, -15), X),
    )


def blended() -> TopoDS_Shape:
    """Fillets, rounds and chamfers along straight and round edges."""
    base = plate(80, 50, 10)
    base = filleted(base, 6.0, *upright(base))
    body = fuse(base, cylinder(10, 15))
    body = filleted(body, 2.0, *rims(body, 10, 0))
    body = chamfered(body, 1.0, *rims(body, 10, 15))
    pocket = box((20, 16, 6), (15, -8, -6))
    return cut(body, filleted(pocket, 3.0, *upright(pocket)))


def assembly() -> TopoDS_Shape:
    """A bearing, a screw, a nut, a washer, a gear, a pin in a block."""
    rings = [cut(cylinder(b, 14), cylinder(a, 14)) for a, b in ((10, 14.2), (19.3, 23.5))]
    balls = [turned(ball(2.5, (16.75, 0, 7)), (0, 0, 1), 45 * i) for i in range(8)]
    hexagon = [(9.24, 0), (4.62, 8), (-4.62, 8), (-9.24, 0), (-4.62, -8), (4.62, -8)]
    screw = shifted(fuse(extruded(hexagon, 0, 6.4), cylinder(5, 40, along=DOWN)), (60, 0, 0))
    nut = shifted(cut(extruded(hexagon, 0, 8), cylinder(5, 8)), (60, 0, -30))
    washer = cut(cylinder(10, 2, (60, 40, 0)), cylinder(5.25, 2, (60, 40, 0)))
    wheel = shifted(cut(gear(18, 20, 16, 8), cylinder(5, 8)), (0, 60, 0))
    block = cut(shifted(plate(30, 30, 30), (-60, 0, 0)), cylinder(4, 20, (-60, 0, -20)))
    return compound(*rings, *balls, screw, nut, washer, wheel, block, cylinder(4, 50, (-60, 0, -20)))


def tubes() -> TopoDS_Shape:
    """An elbow between flanges, a bent handle on a plate, a square tube on a plate, a nut, a cup, a stepped disc."""

    def elbow(radius: float) -> TopoDS_Shape:
        curve = bend(60, radius, 90, (60, 0, 40), (0, 1, 0), (-1, 0, 0))
        return fuse(cylinder(radius, 40), curve, cylinder(radius, 40, (60, 0, 100), X))

    flanges = (cylinder(40, 8), cylinder(40, 8, (92, 0, 100), X))
    pipe = cut(
        fuse(elbow(20), *flanges), elbow(16), *(turned(cylinder(3, 8, (30, 0, 0)), (0, 0, 1), 90 * i) for i in range(4))
    )
    legs = [cylinder(4, 30, (x, -120, 0)) for x in (-30, 30)]
    corners = [bend(10, 4, 90, (20, -120, 30), (0, -1, 0), X), bend(10, 4, 90, (-20, -120, 30), (0, -1, 0), (0, 0, 1))]
    handle = fuse(
        shifted(plate(100, 40, 6), (0, -120, 0)), *legs, corners[0], cylinder(4, 40, (-20, -120, 40), X), corners[1]
    )
    square = fuse(box((60, 60, 5), (-200, -30, 0)), box((40, 40, 150), (-190, -20, 0)))
    square = cut(square, box((34, 34, 150), (-187, -17, 0)))
    hexagon = [(9.24, 0), (4.62, 8), (-4.62, 8), (-9.24, 0), (-4.62, -8), (4.62, -8)]
    nut = shifted(cut(extruded(hexagon, 0, 8), cylinder(5, 8)), (200, 0, 0))
    cup = cut(cone(30, 40, 60, (200, 120, 0)), cone(28, 38, 60, (200, 120, 4)))
    disc = cut(
        fuse(cylinder(50, 12, (-200, 150, 0)), cylinder(20, 20, (-200, 150, 0))), cylinder(8, 20, (-200, 150, 0))
    )
    return compound(pipe, handle, square, nut, cup, disc)


def keyed() -> TopoDS_Shape:
    """Hubs with keyways and with splines, a double D hole, a trapezoidal pocket, pads at the border, an undercut."""
    hub = cut(cylinder(25, 20), cylinder(10, 20), box((28, 5, 20), (-14, -2.5, 0)))
    keys = [turned(box((12.5, 4, 20), (0, -2, 0)), (0, 0, 1), 60 * i) for i in range(6)]
    splined = shifted(cut(cylinder(25, 20), cylinder(10, 20), *keys), (80, 0, 0))
    flattened = shifted(
        cut(cylinder(8, 20), box((20, 20, 20), (5, -10, 0)), box((20, 20, 20), (-25, -10, 0))), (-60, -80, -20)
    )
    block = shifted(plate(120, 60, 20), (-40, -80, 0))
    trapezium = extruded([(-30, -95), (0, -95), (-8, -70), (-22, -70)], -6, 6)
    pads = [box((12, 60, 8), (8, -110, 0)), box((10, 20, 4), (-100, -110, 0))]
    stub = fuse(
        cylinder(6, 3, (-60, 110, 0)), cylinder(7, 15, (-60, 110, 3)), shifted(plate(30, 30, 10), (-60, 110, 0))
    )
    return compound(hub, splined, fuse(cut(block, flattened, trapezium), *pads), stub)


MODELS: dict[str, Callable[[], TopoDS_Shape]] = {
    made.__name__: made for made in (cuts, turned_part, standing, holes, blended, assembly, tubes, keyed)
}
MOVES: dict[str, Callable[[TopoDS_Shape], TopoDS_Shape]] = {
    "an oblique turn": lambda shape: turned(shape, (1, 2, 3), 37),
    "a hundredth": lambda shape: scaled(shape, 0.01),
    "a hundredfold": lambda shape: scaled(shape, 100.0),
    "mirrored": mirrored,
    "faces in another order": reordered,
    "round faces in halves": halved,
    "all faces split": split,
    "all B-splines": nurbs,
}
TAGS = {
    *(
        "through",
        "blind",
        "cross",
        "counterbored",
        "countersunk",
        "conical",
        "cylindrical",
        "slender",
        "flat",
        "hollow",
    ),
    *("trapezoidal", "double_d", "bent"),
    *("rectangular", "hexagonal", "obround", "triangular", "circular", "v_shaped", "keyway", "annular", "semicircular"),
    *("bolt_circle", "row", "grid", "rectangle", "fin", "collar", "flange", "tube", "shaft", "rod", "disc", "washer"),
    *(
        "ring",
        "screw",
        "nut",
        "head",
        "shank",
        "radial",
        "ball",
        "inner_ring",
        "outer_ring",
        "oblique",
        "outer",
        "inner",
    ),
}
FACTORS = {"a hundredth": 0.01, "a hundredfold": 100.0}
LEFT_OUT = {"model", "arc", "cylinder", "face"}
"""What is no feature."""

Row = tuple[object, ...]


def rows(found: Found, factor: float = 1.0) -> list[Row]:
    """Every part by kind, tags and measures, in millimetres of the model before it was scaled."""
    unit = 1e-3 * factor

    def rounded(value: float | None) -> float | None:
        return None if value is None else round(value / unit, 3)

    return sorted(
        (
            (
                part.kind,
                tuple(sorted(set(part.tags) & TAGS)),
                rounded(part.diameter),
                rounded(part.depth) if part.opening is not None else None,
                rounded(part.height) if part.kind in ("boss", "rib", "gear", "bearing") else None,
                rounded(part.thickness) if part.kind in ("body", "pipe", "prism") else None,
                rounded(part.radius) if part.kind == "bend" else None,
                part.count,
                rounded(part.pitch),
                len(part.tips),
            )
            for part in found.parts
            if part.kind not in LEFT_OUT
        ),
        key=repr,
    )


@cache
def truth(model: str) -> tuple[TopoDS_Shape, list[Row]]:
    shape = MODELS[model]()
    return shape, rows(find(shape))


EXPECTED = {
    "cuts": {"pocket", "cutout", "slot", "step", "groove", "notch", "dimple"},
    "turned_part": {"boss", "groove", "hole", "chamfer", "body"},
    "standing": {"rib", "boss", "protrusion", "prism", "cone", "sphere", "hole"},
    "holes": {"hole", "counterbore", "countersink", "pattern", "cutout"},
    "blended": {"fillet", "round", "chamfer", "pocket", "boss"},
    "keyed": {"hole", "slot", "gear", "pocket", "protrusion", "groove"},
    "tubes": {"pipe", "bend", "boss", "hole", "prism", "body"},
    "assembly": {"bearing", "gear", "tooth", "prism", "boss", "hole", "body", "sphere"},
}


@pytest.mark.parametrize("model", MODELS)
def test_each_model_has_the_families_that_were_put_in(model: str) -> None:
    assert EXPECTED[model] <= {row[0] for row in truth(model)[1]}


@pytest.mark.parametrize("move", MOVES)
@pytest.mark.parametrize("model", MODELS)
def test_the_same_families_are_found_after(model: str, move: str) -> None:
    shape, expected = truth(model)
    assert rows(find(MOVES[move](shape)), FACTORS.get(move, 1.0)) == expected


@pytest.mark.parametrize("model", MODELS)
def test_the_same_families_are_found_after_export_and_import(model: str, tmp_path: Path) -> None:
    shape, expected = truth(model)
    assert rows(Found(read_step(write_step(tmp_path / "model.step", shape)))) == expected
