"""Parts made by hand, and what readings are ranked on: a model without a file."""

from __future__ import annotations

from collections.abc import Sequence
from typing import Any

from querycad_answering.understanding import ModelView
from querycad_contracts import Evidence, Grounded, Part, PartKind, PartQuery, Side
from querycad_segworker.grounding.find import present
from querycad_segworker.grounding.ground import ground
from querycad_segworker.grounding.inventory import Inventory

BY_HAND = Evidence(source="geometry", confidence=1.0, reason="made by hand")
UP = (0.0, 0.0, 1.0)
MM = 1e-3


def part(part_id: str, center: tuple[float, float, float] = (0.0, 0.0, 0.0), **more: Any) -> Part:
    """A part called 'hole-1' is a hole; lengths in metres."""
    kind = part_id.rpartition("-")[0]
    fields: dict[str, Any] = {"extents": (0.01, 0.01, 0.01), "label": kind, "faces": ()}
    return Part.model_validate(
        {"id": part_id, "kind": kind, "center": center, "evidence": BY_HAND} | fields | more, strict=False
    )


def hole(number: int, x: float = 0.0, y: float = 0.0, diameter: float = 0.005, **more: Any) -> Part:
    """A through hole from top to bottom, 10 mm deep, at a place in millimetres."""
    fields: dict[str, Any] = {
        "extents": (diameter, diameter, 0.01),
        "tags": ("through", "circular", "vertical"),
        "sides": (Side.TOP, Side.BOTTOM),
        "axis": UP,
        "normal": UP,
        "radius": diameter / 2,
        "diameter": diameter,
        "radii": (diameter / 2,),
        "depth": 0.01,
        "opening": (x * MM, y * MM, 0.005),
        "bottom": "through",
        "faces": (number,),
    }
    return part(f"hole-{number}", (x * MM, y * MM, 0.0), **(fields | more))


def whole(name: str = "plate", extents: tuple[float, float, float] = (0.1, 0.06, 0.01), **more: Any) -> Part:
    """The model as a part."""
    width, depth, height = extents
    sizes: dict[str, Any] = {
        "width": width,
        "depth": depth,
        "height": height,
        "length": max(extents),
        "volume": width * depth * height,
    }
    return part("model-1", extents=extents, name=name, sides=tuple(Side), **(sizes | more))


def body(number: int, name: str, center: tuple[float, float, float] = (0.0, 0.0, 0.0), **more: Any) -> Part:
    """A body with a product name."""
    return part(f"body-{number}", center, name=name, sides=tuple(Side), **more)


def inventory(*parts: Part) -> Inventory:
    """The parts with a model and a body about them, where none is given."""
    kinds = {one.kind for one in parts}
    around = [] if PartKind.MODEL in kinds else [whole()]
    if PartKind.BODY not in kinds:
        around.append(body(1, "plate", extents=(0.1, 0.06, 0.01), faces=tuple(range(100))))
    return Inventory((*around, *parts))


def view(*parts: Part) -> ModelView:
    """What the readings of a question about these parts are ranked on."""
    made = inventory(*parts)
    assert made.model is not None

    def by_rules(queries: Sequence[PartQuery]) -> list[list[Grounded]]:
        return [ground(made, query) for query in queries]

    return ModelView(by_rules, made.model, made.names, present(made))
