"""What does a program's result measure? Read from the program, since a number does not say whether it is an area."""

from __future__ import annotations

import ast

from querycad_contracts import RESULT, AnswerType, Frame
from querycad_contracts.guest_reference import syntax_of

_SCALARS = {
    "volume": AnswerType.VOLUME,
    "area": AnswerType.AREA,
    "opening_area": AnswerType.AREA,
    "angle_to": AnswerType.ANGLE,
    "angle": AnswerType.ANGLE,
    "draft": AnswerType.ANGLE,
    "inclination": AnswerType.ANGLE,
    "bend_angle": AnswerType.ANGLE,
    "acos": AnswerType.ANGLE,
    "asin": AnswerType.ANGLE,
    "atan": AnswerType.ANGLE,
    "atan2": AnswerType.ANGLE,
    "radians": AnswerType.ANGLE,
}
_TRIPLES = {
    "center": AnswerType.POINT,
    "opening": AnswerType.POINT,
    "tip": AnswerType.POINT,
    "min_corner": AnswerType.POINT,
    "max_corner": AnswerType.POINT,
    "axis_point": AnswerType.POINT,
    "origin": AnswerType.POINT,
    "extents": AnswerType.SIZE,
    "half_extents": AnswerType.SIZE,
    "local_size": AnswerType.SIZE,
    "size_in": AnswerType.SIZE,
    "axis": AnswerType.DIRECTION,
    "x": AnswerType.DIRECTION,
    "y": AnswerType.DIRECTION,
    "z": AnswerType.DIRECTION,
    "normal": AnswerType.DIRECTION,
    "center_of_mass": AnswerType.POINT,
}
_OWN_FRAME = frozenset(("local_size", "size_in"))
"""The triples of the guest API that are told in a part's own frame."""


def scalar_type(code: str) -> AnswerType:
    """Of what type is a number that the program computes? A length, unless what it reads is all of another kind."""
    value = _result(code)
    if isinstance(value, ast.BinOp) and isinstance(value.op, ast.Div):
        if _read(value.left, {}) and _read(value.right, {}):
            return AnswerType.NUMBER
    kinds = {_SCALARS.get(name) for name in measures(code)}
    kind = kinds.pop() if len(kinds) == 1 else None
    return kind or AnswerType.LENGTH


def triple_type(code: str) -> AnswerType | None:
    """Of what type are three numbers that the program computes? None when they are no coordinates."""
    kinds = [kind for name in measures(code) if (kind := _TRIPLES.get(name))]
    return kinds[0] if kinds else None


def frame(code: str | None, kind: AnswerType) -> Frame | None:
    """Whose axes are the numbers of such an answer along? None for what has none."""
    if kind in (AnswerType.SIZE, AnswerType.SIZES) and code is not None and not _OWN_FRAME.isdisjoint(measures(code)):
        return Frame.PART
    triples = ("point", "points", "direction", "directions", "size", "sizes")
    return Frame.MODEL if kind.value in triples else None


def measures_anything(code: str) -> bool:
    """Does the program read any measure at all, or does it only count and name?"""
    if (tree := syntax_of(code)) is None:
        return False
    return any(_read(node, {}) for node in ast.walk(tree) if isinstance(node, ast.expr))


def measures(code: str) -> tuple[str, ...]:
    """Which attributes and functions give the result: those in its own expression, else in what that is made of?"""
    value = _result(code)
    if value is None:
        return ()
    return _read(value, {}) or _read(value, _assigned(code))


def _read(node: ast.expr, assigned: dict[str, ast.expr]) -> tuple[str, ...]:
    found: list[str] = []
    waiting, seen = [node], set[str]()
    while waiting:
        current = waiting.pop(0)
        for child in ast.walk(current):
            if isinstance(child, ast.Attribute):
                found.append(child.attr)
            elif isinstance(child, ast.Call) and isinstance(child.func, ast.Name):
                found.append(child.func.id)
            elif isinstance(child, ast.Name) and child.id in assigned and child.id not in seen:
                seen.add(child.id)
                waiting.append(assigned[child.id])
    return tuple(name for name in dict.fromkeys(found) if name in _KNOWN)


def _result(code: str) -> ast.expr | None:
    """The expression that `solution` gets last."""
    return _assigned(code).get(RESULT)


def _assigned(code: str) -> dict[str, ast.expr]:
    """The last expression that each variable gets."""
    if (tree := syntax_of(code)) is None:
        return {}
    found: dict[str, ast.expr] = {}
    for node in ast.walk(tree):
        if isinstance(node, ast.Assign):
            found |= {target.id: node.value for target in node.targets if isinstance(target, ast.Name)}
        elif isinstance(node, ast.AnnAssign) and isinstance(node.target, ast.Name) and node.value is not None:
            found[node.target.id] = node.value
    return found


_LENGTHS = (
    "radius", "diameter", "radii", "depth", "height", "width", "length", "nominal_length", "thickness", "pitch",
    "outer_diameter",
    "inner_diameter", "tube_diameter", "across_flats", "across_corners", "center_length", "chamfer_size", "bend_radius",
    "mouth_length", "mouth_width", "bottom_length", "bottom_width",
    "bottom_thickness", "minimum_thickness", "wall_distance", "developed_length",
)  # fmt: skip
_DISTANCES = ("distance_to", "center_distance", "edge_distance", "distance", "offset")
_KNOWN = frozenset({*_SCALARS, *_TRIPLES, *_LENGTHS, *_DISTANCES})
