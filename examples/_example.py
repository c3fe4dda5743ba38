"""How does an example's script publish its model: a valid, reproducible STEP file and the questions it answers."""

from __future__ import annotations

import json
import sys
from dataclasses import asdict, dataclass
from pathlib import Path

from build123d import Shape, Unit, export_step
from OCP.Interface import Interface_Static
from OCP.STEPControl import STEPControl_Controller

from _stable import sort_styles

FOLDER = Path(__file__).parent
TIMESTAMP = "2000-01-01T00:00:00"  # any fixed moment: the same parameters give the same bytes

Value = int | float | str | list[float] | list[list[float]]


@dataclass(frozen=True, slots=True)
class Item:
    """A question and its true answer, computed from the model's parameters; SI units."""

    question: str
    value: Value
    type: str


def count(question: str, value: int) -> Item:
    """How many are there?"""
    return Item(question, value, "count")


def length(question: str, value_mm: float) -> Item:
    """How long is it? The drawing's millimetres become metres."""
    return Item(question, _metres(value_mm), "length")


def lengths(question: str, values_mm: list[float]) -> Item:
    """How long is each? One value per part, smallest first."""
    return Item(question, sorted(_metres(value) for value in values_mm), "lengths")


def point(question: str, value_mm: tuple[float, float, float]) -> Item:
    """Where is it?"""
    return Item(question, [_metres(value) for value in value_mm], "point")


def points(question: str, values_mm: list[tuple[float, float, float]]) -> Item:
    """Where is each? One point per part, in ascending order."""
    return Item(question, sorted([_metres(value) for value in point_mm] for point_mm in values_mm), "points")


def size(question: str, value_mm: tuple[float, float, float]) -> Item:
    """How large is it along x, y and z?"""
    return Item(question, [_metres(value) for value in value_mm], "size")


def text(question: str, value: str) -> Item:
    """What is it called?"""
    return Item(question, value, "text")


def _metres(value_mm: float) -> float:
    return round(value_mm / 1000, 9) + 0.0  # never -0.0


def publish(name: str, shape: Shape, items: list[Item], bodies: int = 1) -> Path:
    """Where does the model go? Writes NAME.step and NAME.questions.json beside the scripts, or where argv[1] says.

    Raises ValueError when the shape is not a valid set of `bodies` solids: an example must not be broken itself.
    """
    folder = Path(sys.argv[1]) if len(sys.argv) > 1 else FOLDER
    step = folder / f"{name}.step"
    export(shape, step, bodies)
    questions = {"model": step.name, "items": [asdict(item) for item in items]}
    (folder / f"{name}.questions.json").write_text(json.dumps(questions, indent=2, ensure_ascii=False) + "\n")
    return step


def export(shape: Shape, step: Path, bodies: int = 1, unit: str = "MM") -> None:
    """How does a shape in millimetres become a STEP file, the same bytes each time?

    The product is called as the file; `unit` is what the file's lengths are written in, "MM" or "INCH".
    Raises ValueError when the shape is not a valid set of `bodies` solids (0: loose surfaces).
    """
    if not shape.is_valid:
        raise ValueError(f"{step.stem}: the shape is not valid")
    if len(shape.solids()) != bodies:
        raise ValueError(f"{step.stem}: {len(shape.solids())} solids instead of {bodies}")
    shape.label = step.stem
    STEPControl_Controller.Init_s()  # without it the setting below is not known yet
    Interface_Static.SetCVal_s("write.step.unit", unit)
    export_step(shape, step, unit=Unit.MM, write_pcurves=False, timestamp=TIMESTAMP)
    step.write_text(sort_styles(step.read_text()))
