"""How parts sit in each other, and where they lie between the ends of others: play, depth of insertion, edges."""

from __future__ import annotations

from pathlib import Path

import pytest
from build123d import Align, Box, BuildPart, Compound, Cylinder, Hole, Locations, Mode, Part, export_step

from querycad import EmbeddedRuntime, Model

MM = 1e-3
FROM_BELOW = (Align.CENTER, Align.CENTER, Align.MIN)


def plug_in_socket() -> Compound:
    """A plug of diameter 11.8 with a collar, 22 mm deep in a socket of 12."""
    with BuildPart() as socket:
        Cylinder(15, 30, align=FROM_BELOW)
        with Locations((0, 0, 5)):
            Cylinder(6, 25, align=FROM_BELOW, mode=Mode.SUBTRACT)
    with BuildPart() as plug:
        with Locations((0, 0, 8)):
            Cylinder(5.9, 40, align=FROM_BELOW)
        with Locations((0, 0, 48)):
            Cylinder(10, 4, align=FROM_BELOW)
    return named(socket=socket.part, plug=plug.part)


def named(**parts: Part | None) -> Compound:
    for label, part in parts.items():
        assert part is not None
        part.label = label
    return Compound(children=[part for part in parts.values() if part is not None])


def drilled_bar() -> Compound:
    """A bar of 100 x 40 with two bores, 12 and 20 mm from one end and 15 from one long side; a row of five on top."""
    with BuildPart() as bar:
        Box(100, 40, 20, align=FROM_BELOW)
        with Locations((-38, -5, 20)):
            Hole(5)
        with Locations(*[(x, 10, 20) for x in (-20, -5, 10, 25, 40)]):
            Hole(2)
    return named(bar=bar.part)


@pytest.fixture(scope="module")
def models(runtime: EmbeddedRuntime, tmp_path_factory: pytest.TempPathFactory) -> dict[str, Model]:
    folder = tmp_path_factory.mktemp("fits")
    made = {"plug": plug_in_socket(), "bar": drilled_bar()}
    for name, shape in made.items():
        export_step(shape, folder / f"{name}.step")
    return {name: runtime.open(folder / f"{name}.step") for name in made}


@pytest.mark.parametrize(
    ("model", "question", "value"),
    [
        ("plug", "What is the diametral clearance between the plug and the socket?", 0.2),
        ("plug", "How much play on diameter does the plug have in the socket?", 0.2),
        ("plug", "What radial play has the plug in the socket?", 0.1),
        ("plug", "What is the insertion depth of the plug in the socket?", 22),
        ("plug", "What is the shortest distance between the plug and the socket?", 0.1),
        ("bar", "How far is the centre of the 10 mm hole from the nearest end of the bar?", 12),
        ("bar", "What is the distance from the axis of the largest hole to the nearest long edge?", 15),
        ("bar", "How far is it from the first of the 4 mm holes to the last one?", 60),
        ("bar", "How many different hole diameters are there?", 2000),
    ],
)
def test_what_lies_in_or_between_others(models: dict[str, Model], model: str, question: str, value: float) -> None:
    assert models[model].ask(question).value == pytest.approx(value * MM, abs=1e-6)


@pytest.mark.parametrize(
    ("words", "values"), [("larger one first", [10, 4]), ("from the smallest to the largest", [4, 10])]
)
def test_values_come_in_the_order_that_is_asked_for(models: dict[str, Model], words: str, values: list[float]) -> None:
    reply = models["bar"].ask(f"Which different diameters do the holes have, {words}?")
    assert reply.value == pytest.approx([value * MM for value in values])


@pytest.mark.parametrize(
    ("question", "value"),
    [
        ("Do the plug and the socket touch one another?", False),
        ("Is the axis of the plug at right angles to the axis of the socket?", False),
        ("Is the plug touching the socket?", False),
    ],
)
def test_whether_they_touch(models: dict[str, Model], question: str, value: bool) -> None:
    assert models["plug"].ask(question).value is value


def test_what_the_larger_of_two_has_more(runtime: EmbeddedRuntime, tmp_path: Path) -> None:
    with BuildPart() as lugs:
        Box(60, 30, 10, align=FROM_BELOW)
        with Locations((-20, 0, 10)):
            Box(8, 30, 25, align=FROM_BELOW)
        with Locations((20, 0, 10)):
            Box(5, 30, 25, align=FROM_BELOW)
    assert lugs.part is not None
    export_step(lugs.part, tmp_path / "lugs.step")
    model = runtime.open(tmp_path / "lugs.step")
    assert model.ask("By how much do the two walls differ in thickness?").value == pytest.approx(3 * MM)
