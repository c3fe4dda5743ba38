"""Questions about what a verb says of parts, and about pieces, ends and middles: asked of whole models."""

from __future__ import annotations

from pathlib import Path

import pytest
from build123d import (
    Align,
    Axis,
    Box,
    BuildLine,
    BuildPart,
    BuildSketch,
    Cylinder,
    Hole,
    Locations,
    Mode,
    Plane,
    Polyline,
    Solid,
    export_step,
    extrude,
    fillet,
    make_face,
)

from querycad import EmbeddedRuntime, Model

MM = 1e-3
FROM_BELOW = (Align.CENTER, Align.CENTER, Align.MIN)


def block() -> Solid:
    """A block of 80 x 40 x 30 with a gallery of 10 (60 long), a drilling into it, a slot open at both ends."""
    with BuildPart() as made:
        Box(80, 40, 30, align=FROM_BELOW)
        with Locations(Plane(origin=(-40, 0, 10), z_dir=(1, 0, 0))):
            Cylinder(5, 60, align=FROM_BELOW, mode=Mode.SUBTRACT)
        with Locations((-10, 0, 10)):
            Cylinder(2, 20, align=FROM_BELOW, mode=Mode.SUBTRACT)
        with Locations((0, 14, 26)):
            Box(80, 6, 4, align=FROM_BELOW, mode=Mode.SUBTRACT)
        with Locations((30, -12, 30)):
            Hole(3)
    return made.part.solid()


def pulley() -> Solid:
    """A rim of 80 x 20 with a hub of 30 that stands out by 10 on one side only, with a bore of 12."""
    with BuildPart() as made:
        Cylinder(40, 20, align=FROM_BELOW)
        Cylinder(15, 30, align=FROM_BELOW)
        fillet(made.edges().filter_by(lambda e: abs(e.length - 2 * 3.14159265 * 15) < 1e-3).sort_by(Axis.Z)[0], 2)
        Hole(6)
    return made.part.solid()


def gib() -> Solid:
    """An angle of 20 x 26 whose lip of 14 hangs out by 8, 100 long."""
    with BuildPart() as made:
        with BuildSketch(Plane.YZ):
            with BuildLine():
                Polyline((0, 0), (20, 0), (20, 12), (28, 12), (28, 26), (0, 26), (0, 0))
            make_face()
        extrude(amount=100)
    return made.part.solid()


def bossed() -> Solid:
    """A plate of 80 x 60 x 10 with bosses of 16 x 8 and 12 x 12 on top, one of 10 x 10 below, and two rows of holes."""
    with BuildPart() as made:
        Box(80, 60, 10, align=FROM_BELOW)
        for x, radius, height in ((20, 8, 8), (-20, 6, 12)):
            with Locations((x, 0, 10)):
                Cylinder(radius, height, align=FROM_BELOW)
        with Locations((0, 15, -10)):
            Cylinder(5, 10, align=FROM_BELOW)
        with Locations((-30, -20, 10), (30, -20, 10), (30, 20, 10), (-30, 20, 10)):
            Hole(2)
    return made.part.solid()


def collar() -> Solid:
    """A shaft of 20 with a collar of 35, 8 wide."""
    with BuildPart() as made:
        Cylinder(10, 60, align=FROM_BELOW)
        with Locations((0, 0, 20)):
            Cylinder(17.5, 8, align=FROM_BELOW)
    return made.part.solid()


@pytest.fixture(scope="module")
def models(runtime: EmbeddedRuntime, tmp_path_factory: pytest.TempPathFactory) -> dict[str, Model]:
    folder = tmp_path_factory.mktemp("predicates")
    made = {"block": block, "pulley": pulley, "gib": gib, "bossed": bossed, "collar": collar}
    for name, shape in made.items():
        export_step(shape(), folder / f"{name}.step")
    return {path.stem: runtime.open(path) for path in Path(folder).glob("*.step")}


@pytest.mark.parametrize(
    ("model", "question", "holds"),
    [
        ("block", "Does the 10 mm bore come out at the other end?", False),
        ("block", "Does the 6 mm hole go right through to the bottom?", True),
        ("block", "Does the 4 mm hole break into the 10 mm bore?", True),
        ("block", "Does the 6 mm hole break into the 10 mm bore?", False),
        ("block", "Is this slot open on both ends?", True),
        ("block", "Do the 10 mm bore and the 4 mm hole meet?", True),
        ("block", "Do the 10 mm bore and the 6 mm hole meet?", False),
        ("pulley", "Does the hub reach beyond the rim?", True),
        ("pulley", "Does the hub reach beyond the rim at both ends?", False),
        ("bossed", "Are the 16 mm boss and the 12 mm boss on the same side?", True),
        ("bossed", "Are the 16 mm boss and the 10 mm boss on the same side?", False),
        ("bossed", "Do the bosses stand on opposite sides?", True),
        ("bossed", "Is the 12 mm boss 1.5 times as tall as the 16 mm boss?", True),
        ("bossed", "Is the 16 mm boss twice as tall as the 12 mm boss?", False),
    ],
)
def test_what_a_verb_says_is_checked(models: dict[str, Model], model: str, question: str, holds: bool) -> None:
    assert models[model].ask(question).value is holds


@pytest.mark.parametrize(
    ("model", "question", "millimetres"),
    [
        ("block", "How much material is left between the end of the 10 mm bore and the opposite face?", 20.0),
        ("block", "What is the longest dimension of the block?", 80.0),
        ("block", "How far is the 6 mm hole off the middle of the block in x?", 30.0),
        ("pulley", "What is the radius where the hub meets the rim?", 2.0),
        ("gib", "What thickness has the lip of this gib?", 14.0),
        ("bossed", "By how much do the bosses differ in height?", 4.0),
        ("collar", "How high is the shoulder, measured radially?", 7.5),
    ],
)
def test_pieces_ends_and_middles_have_their_measures(
    models: dict[str, Model], model: str, question: str, millimetres: float
) -> None:
    assert models[model].ask(question).value == pytest.approx(millimetres * MM)


def test_an_axis_and_a_side_are_called_as_the_question_does(models: dict[str, Model]) -> None:
    assert models["block"].ask("Which coordinate axis does the 10 mm bore run along?").value == "x"
    assert models["block"].ask("On which side is the 6 mm hole? Answer with the axis direction.").value == "+z"


def test_four_holes_have_the_sides_of_their_rectangle(models: dict[str, Model]) -> None:
    found = models["bossed"].ask("The four holes form a rectangle. What are its sides?").value
    assert sorted(found) == pytest.approx([40 * MM, 60 * MM])
