"""Python expressions of the guest API for measures, filters and orders."""

from __future__ import annotations

import re

from querycad_contracts import AnswerType

from .meaning import ENDS, Measure, NounClass, Relation

FOUND = 1e-6
"""Slack of a comparison, metres: above kernel noise (1e-10 m), below drawing accuracy (5e-5 m)."""


def _end(outward: tuple[float, float, float]) -> str:
    """The expression of the middle of a part's box on one side."""
    axes = [f"{{0}}.center[{i}]" + (f" {'+' if o > 0 else '-'} {{0}}.half_extents[{i}]" if o else "")
            for i, o in enumerate(outward)]  # fmt: skip
    return f"({', '.join(axes)})"


_PART = {
    **{measure: _end(side.outward) for measure, side in ENDS.items()},
    Measure.INNER_RADIUS: "min({0}.radii)",
    Measure.OUTER_RADIUS: "max({0}.radii)",
    Measure.INNER_DIAMETER: "2 * min({0}.radii)",
    Measure.OUTER_DIAMETER: "2 * max({0}.radii)",
    Measure.CIRCUMFERENCE: "3.141592653589793 * {0}.diameter",
    Measure.WALL_THICKNESS: (
        '(max({0}.radii) - min({0}.radii) if hasattr({0}, "radii") and len({0}.radii) > 1 else {0}.thickness)'
    ),
    Measure.MAGNITUDE: '({0}.diameter if hasattr({0}, "diameter") else max({0}.extents))',
    Measure.AXIAL_LENGTH: '({0}.length if {0}.kind in ("body", "model") else {0}.height)',
    Measure.LEAST_EXTENT: "min({0}.extents)",
    Measure.SIZE: "{0}.extents",
    Measure.SHORT_SIDE: '(min({0}.local_size[:2]) if hasattr({0}, "local_size") else min({0}.length, {0}.width))',
    Measure.LONG_SIDE: '(max({0}.local_size[:2]) if hasattr({0}, "local_size") else max({0}.length, {0}.width))',
    Measure.HALF_SIZE: "{0}.half_extents",
    Measure.X_EXTENT: "{0}.extents[0]",
    Measure.Y_EXTENT: "{0}.extents[1]",
    Measure.Z_EXTENT: "{0}.extents[2]",
    Measure.DIAGONAL: "distance((0.0, 0.0, 0.0), {0}.extents)",
    Measure.BOX_VOLUME: "{0}.extents[0] * {0}.extents[1] * {0}.extents[2]",
    Measure.POSITION: "{0}.center",
    Measure.X: "{0}.center[0]",
    Measure.Y: "{0}.center[1]",
    Measure.Z: "{0}.center[2]",
    Measure.DIRECTION: "{0}.normal",
    Measure.EDGE_DISTANCE: "{0}.edge_distance()",
    Measure.KIND: "{0}.label",
}
_SHAPE = {
    Measure.LENGTH: "max(shape.extents)",
    Measure.X_EXTENT: "shape.width",
    Measure.Y_EXTENT: "shape.depth",
    Measure.Z_EXTENT: "shape.height",
    Measure.DIAMETER: "{round}[0]",
    Measure.OUTER_DIAMETER: "{round}[0]",
    Measure.RADIUS: "{round}[0] / 2",
    Measure.OUTER_RADIUS: "{round}[0] / 2",
    Measure.COLOR: "[body.color for body in shape.bodies]",
}
_SHAPE_HAS_NOT = frozenset(
    {
        Measure.INNER_RADIUS, Measure.INNER_DIAMETER, Measure.CIRCUMFERENCE, Measure.OPENING, Measure.TIP, Measure.AXIS,
        Measure.NORMAL, Measure.DIRECTION, Measure.EDGE_DISTANCE, Measure.KIND, Measure.SIDES, Measure.BOTTOM,
    }
)  # fmt: skip
_ONE_TYPE = {
    Measure.SIZE: AnswerType.SIZE,
    Measure.HALF_SIZE: AnswerType.SIZE,
    Measure.ANGLE: AnswerType.ANGLE,
    Measure.AREA: AnswerType.AREA,
    Measure.VOLUME: AnswerType.VOLUME,
    Measure.BOX_VOLUME: AnswerType.VOLUME,
    Measure.POSITION: AnswerType.POINT,
    Measure.OPENING: AnswerType.POINT,
    Measure.TIP: AnswerType.POINT,
    **dict.fromkeys(ENDS, AnswerType.POINT),
    Measure.AXIS: AnswerType.DIRECTION,
    Measure.NORMAL: AnswerType.DIRECTION,
    Measure.DIRECTION: AnswerType.DIRECTION,
    Measure.NAME: AnswerType.TEXT,
    Measure.KIND: AnswerType.TEXT,
    Measure.COLOR: AnswerType.TEXT,
    Measure.BOTTOM: AnswerType.TEXT,
    Measure.SIDES: AnswerType.TEXTS,
}
_MANY_TYPES = {
    AnswerType.SIZE: AnswerType.SIZES,
    AnswerType.AREA: AnswerType.AREAS,
    AnswerType.VOLUME: AnswerType.VOLUMES,
    AnswerType.POINT: AnswerType.POINTS,
    AnswerType.DIRECTION: AnswerType.DIRECTIONS,
    AnswerType.TEXT: AnswerType.TEXTS,
    AnswerType.LENGTH: AnswerType.LENGTHS,
    AnswerType.ANGLE: AnswerType.ANGLES,
    AnswerType.COUNT: AnswerType.NUMBERS,
    AnswerType.NUMBER: AnswerType.NUMBERS,
}
_SYMBOLS = {
    Relation.LESS: ("<", -1),
    Relation.AT_MOST: ("<=", 1),
    Relation.MORE: (">", 1),
    Relation.AT_LEAST: (">=", -1),
}


_OF_EVERY_HOLE = {Measure.RADIUS, Measure.DIAMETER, Measure.DEPTH, Measure.WIDTH}


def guard(measure: Measure, noun: NounClass) -> str:
    """Which condition says that the part 'p' has a measure? Empty where all parts of a noun have it.

    A description such as 'protrusion' finds parts of several kinds: a filter passes over those it does not fit.
    """
    expression = _PART.get(measure, "{0}." + measure.value)
    attribute = re.search(
        r"\{0\}\.(radius|diameter|radii|width|length|thickness|volume|depth|height|angle)", expression
    )
    if attribute is None or (noun is NounClass.HOLE and measure in _OF_EVERY_HOLE):
        return ""
    return f'hasattr(p, "{attribute[1]}")'


def of_part(measure: Measure, part: str) -> str:
    """Which expression gives a measure of the part in the variable `part`?"""
    return _PART.get(measure, "{0}." + measure.value).format(part)


def of_shape(measure: Measure) -> str | None:
    """Which expression gives a measure of the whole model? None when it has no such measure.

    '{round}' stands for a list of the extents that two directions share.
    """
    if measure in _SHAPE_HAS_NOT:
        return None
    if measure in _SHAPE:
        return _SHAPE[measure]
    return of_part(measure, "shape")


def answer_type(measure: Measure, many: bool) -> AnswerType:
    """Of which type is the value, or are the values, of a measure?"""
    one = _ONE_TYPE.get(measure, AnswerType.LENGTH)
    return _MANY_TYPES.get(one, one) if many else one


def many(one: AnswerType) -> AnswerType:
    """Of which type are several values of a type?"""
    return _MANY_TYPES.get(one, one)


def literal(value: float) -> str:
    """How is a number written? Twelve significant digits, more than any drawing has."""
    return repr(float(f"{value:.12g}"))


def compared(left: str, relation: Relation, low: str, high: str | None = None, slack: float = FOUND) -> str:
    """Which condition says that `left` compares so with `low` (and `high`), give or take `slack`?"""
    if relation is Relation.BETWEEN:
        return f"{low} - {slack:g} <= {left} <= {high} + {slack:g}"
    if relation is Relation.UNEQUAL:
        return f"not close({left}, {low})"
    if relation in (Relation.EQUAL, Relation.ABOUT):
        return f"close({left}, {low})"
    symbol, sign = _SYMBOLS[relation]
    return f"{left} {symbol} {low} {'+' if sign > 0 else '-'} {slack:g}"
