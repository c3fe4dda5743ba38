"""What is wrong with a program that would run: a result that is not computed, or not in metres. Before it runs."""

from __future__ import annotations

import ast
import math
import re
from collections.abc import Iterator

from querycad_contracts.guest_reference import syntax_of

_TO_SMALLER_UNITS = (1e3, 1e6, 1e9, 25.4, 39.37, 39.3701, 39.37007874)
"""Factors from metres (m2, m3) to millimetres and inches, and from inches to millimetres, taken for such a one."""
_UNITS_IN_METRES = (0.001, 1e-6, 1e-9, 0.0254)
_BETWEEN_TWO = ("center_distance", "distance_to", "angle_to")
_MEASURED = frozenset(
    {
        *("radius", "diameter", "depth", "height", "width", "length", "thickness", "pitch", "angle", "volume", "area"),
        *("center", "opening", "tip", "extents", "half_extents", "local_size", "min_corner", "max_corner"),
        *("edge_distance", *_BETWEEN_TWO),
    }
)
_LENGTHS = _MEASURED - {"angle", "volume", "area", "center", "opening", "tip", "angle_to"}
_ROUGH_DIGITS = 5
"""Digits after the point below which rounding metres loses what a drawing tells: 0.01 mm."""


_AMOUNT = re.compile(
    r"(?<![\w.,/])(\d+(?:[.,]\d+)?)(?=(?:\s*(?:to|and|or|-|–)\s*\d+(?:[.,]\d+)?){0,4}\s*(mm|cm|inch(?:es)?|in\b(?!\s+\w)|\"))"
)
"""A number of the question with its unit, which may stand behind the last number of a range."""
_METRES = {"mm": 1e-3, "cm": 1e-2}
_INCH_M = 0.0254


def problems(code: str, question: str = "") -> tuple[str, ...]:
    """What has the writer to repair, a sentence each? What Python cannot read is left to the run, which says why."""
    if (tree := syntax_of(code)) is None:
        return ()
    found = [problem for node in ast.walk(tree) if (problem := _problem(node))]
    names = {node.id for node in ast.walk(tree) if isinstance(node, ast.Name)}
    if not names & {"find_parts", "parts", "faces", "shape", "look"}:
        found.append("The program uses neither find_parts, parts, faces nor shape: compute the answer from the model.")
    found += _slips(tree, question)
    return tuple(dict.fromkeys(found))


def _slips(tree: ast.Module, question: str) -> list[str]:
    """Lengths of the question that the program has by a power of ten too large or too small."""
    found = []
    for amount, metres in lengths_left_out(tree, question):
        powers = [literal for literal in literals(tree) if any(_is(literal, metres * 10.0**k) for k in range(-4, 7))]
        found += [f"{amount} is {metres:.6g} in metres, and not {literal:g}." for literal in powers[:1]]
    return found


def lengths_left_out(tree: ast.Module, question: str) -> list[tuple[str, float]]:
    """Which lengths of the question, as it says them and in metres, has the program neither in metres nor converted?"""
    found = literals(tree)
    left_out = []
    for amount, unit, given, metres in _amounts(question):
        converts = any(_is(literal, factor) for literal in found for factor in (1e3, 1e-3, 1e2, 1e-2, _INCH_M))
        if given and not any(_is(literal, metres) or (converts and _is(literal, given)) for literal in found):
            left_out.append((f"{amount} {unit}", metres))
    return left_out


def in_metres(question: str) -> tuple[str, ...]:
    """The lengths that a question says, each with what it is in metres: a small model converts them wrong."""
    return tuple(dict.fromkeys(f"{amount} {unit} is {metres:.6g}" for amount, unit, _, metres in _amounts(question)))


def _amounts(question: str) -> Iterator[tuple[str, str, float, float]]:
    """Number and unit of each length of a question, as it says them, and the number as it is and in metres."""
    for amount, unit in _AMOUNT.findall(question):
        given = float(amount.replace(",", "."))
        yield amount, unit, given, given * _METRES.get(unit, _INCH_M)


def literals(tree: ast.Module) -> list[float]:
    """Which numbers are written into the program?"""
    constants = [node for node in ast.walk(tree) if isinstance(node, ast.Constant)]
    return [number for node in constants if (number := _number(node)) is not None]


def _is(number: float, other: float) -> bool:
    return math.isclose(number, other, rel_tol=1e-6)


def _problem(node: ast.AST) -> str | None:
    match node:
        case ast.BinOp(left=left, op=ast.Mult(), right=right) if _converts(left, right) or _converts(right, left):
            return f"`{ast.unparse(node)}` converts the result: leave it in metres (m2, m3, kg)."
        case ast.BinOp(left=left, op=ast.Mult(), right=right) if _shrinks(left, right) or _shrinks(right, left):
            return f"`{ast.unparse(node)}` converts what is in metres already: leave it."
        case ast.BinOp(left=left, op=ast.Div(), right=right) if (
            _number(left) is None and _number(right) in _UNITS_IN_METRES
        ):
            return f"`{ast.unparse(node)}` converts the result: leave it in metres (m2, m3, kg)."
        case ast.Call(func=ast.Name(id="round"), args=[value, digits]) if _is_rough(digits) and _number(value) is None:
            return f"`{ast.unparse(node)}` loses digits, as values are in metres: do not round."
        case ast.Call(func=ast.Attribute(value=part, attr=name), args=[other]) if _are_one(name, part, other):
            return f"`{ast.unparse(node)}` is between a part and itself: 0."
        case ast.Compare(left=left, ops=[ast.Eq()], comparators=[right]) if _is_exact(left, right) or _is_exact(
            right, left
        ):
            return f"`{ast.unparse(node)}` is hardly ever true, as lengths are measured: compare with close(a, b)."
        case ast.Call(func=ast.Attribute(attr="degrees") | ast.Name(id="degrees")):
            return f"`{ast.unparse(node)}` converts the result: leave angles in radians."
    return None


def _are_one(measure: str, part: ast.expr, other: ast.expr) -> bool:
    """Is it a measure between two parts, both of which are the same?"""
    return measure in _BETWEEN_TWO and ast.dump(part) == ast.dump(other)


def _is_exact(measure: ast.expr, number: ast.expr) -> bool:
    """Is it something measured, and a number that it would have to be to the last digit?"""
    if isinstance(measure, ast.Subscript):
        measure = measure.value
    if isinstance(measure, ast.Call):
        measure = measure.func
    return isinstance(measure, ast.Attribute) and measure.attr in _MEASURED and _number(number) is not None


def _converts(value: ast.expr, factor: ast.expr) -> bool:
    return _number(value) is None and _number(factor) in _TO_SMALLER_UNITS and _is_measure(value)


def _shrinks(value: ast.expr, factor: ast.expr) -> bool:
    """Is it a length of a part, multiplied with a millimetre or an inch as if it were not in metres?"""
    return isinstance(value, ast.Attribute) and value.attr in _LENGTHS and _number(factor) in _UNITS_IN_METRES


def _is_measure(value: ast.expr) -> bool:
    """Is it something that may be a length: not a count?"""
    is_count = isinstance(value, ast.Call) and isinstance(value.func, ast.Name) and value.func.id == "len"
    return not is_count


def _is_rough(digits: ast.expr) -> bool:
    number = _number(digits)
    return number is not None and number < _ROUGH_DIGITS


def _number(node: ast.expr) -> float | None:
    """The number that an expression of constants stands for; None for anything else."""
    try:
        value = ast.literal_eval(node)
    except (ValueError, TypeError, SyntaxError, MemoryError, RecursionError):
        return None
    return float(value) if isinstance(value, int | float) and not isinstance(value, bool) else None
