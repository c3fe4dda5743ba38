"""What of the question does a program leave out, change or add? By the question's own words, after the program has run.

These are doubts and no errors: when all repairs are used up, the program stands as it is.
"""

from __future__ import annotations

import ast
import math
import re
from collections.abc import Iterator

from querycad_answering.quantities import measures, measures_anything, scalar_type, triple_type
from querycad_answering.typed import unit_of
from querycad_contracts import Answer, AnswerType, ModelSummary, Unit
from querycad_contracts.guest_reference import syntax_of

from .checks import lengths_left_out, literals
from .example_retrieval import singular
from .files import prompt_data
from .prompt import in_words

_WORD = re.compile(r"[a-z]+")
_WORD_OR_STOP = re.compile(r"[a-z]+|[,;:.?()]")
_ARTICLES = ("a", "an", "the")
_RADII = {"radius", "radii"}
_DIAMETERS = {"diameter", "diameters"}
_DISTANCES = {"center_distance", "distance_to", "distance"}
_CHOOSERS = {"max", "min", "sorted", "sort"}
_SAME_LETTERS = 5
"""Words that begin with as many letters alike are forms of one: hexagon and hexagonal, counterbore and counterbored."""
_AXES = {"width": 0, "depth": 1, "height": 2, "x": 0, "y": 1, "z": 2}
_UNITS = (AnswerType.LENGTH, AnswerType.AREA, AnswerType.VOLUME, AnswerType.ANGLE)
_MEASURES = (*_UNITS, AnswerType.LENGTHS, AnswerType.AREAS, AnswerType.VOLUMES, AnswerType.ANGLES)
_ALONG = re.compile(r"\balong (?:the |its )?(width|depth|height|[xyz])\b|\bin ([xyz])[- ]direction\b")


def doubts(
    code: str,
    question: str,
    wanted: AnswerType | None,
    summary: ModelSummary | None = None,
    by_words: bool = True,
) -> tuple[str, ...]:
    """What should the writer look at again, a sentence each? `summary` is what it was told of the model.

    `by_words`: also where the program's sides, descriptions, choices and lengths are not the question's own.
    """
    if (tree := syntax_of(code)) is None:
        return ()
    asked = _WORD.findall(question.lower())
    found: list[str] = []
    if by_words:
        found += [*_sides(tree, asked), *_descriptions(tree, question, summary), *_extreme(tree, asked)]
        found += _lengths(tree, question)
    if wanted in (AnswerType.LENGTH, AnswerType.LENGTHS):
        found += [*_radius_or_diameter(code, asked), *_along(tree, question)]
    return tuple(dict.fromkeys(found))


def odd(answer: Answer, code: str) -> str:
    """What is said to measures of which there are none, or that are below zero and no coordinate?"""
    if answer.type not in _MEASURES:
        return ""
    values = answer.value if isinstance(answer.value, list | tuple) else [answer.value]
    if not values:
        return "The list is empty: no part that was found passes the condition."
    is_below = any(isinstance(value, float) and value < 0 for value in values)
    is_coordinate = triple_type(code) is AnswerType.POINT
    return "The answer is negative, which no size or distance is." if is_below and not is_coordinate else ""


def other_measure(code: str, wanted: AnswerType | None) -> str:
    """What is said to a program whose number is of the right type, but measures something else?"""
    if wanted is None or unit_of(wanted) is Unit.NONE:
        return ""
    if not measures_anything(code):
        return f"The question asks for {in_words(wanted)}, but the program reads no measure of a part or of shape."
    computed = scalar_type(code)
    if wanted in _UNITS and computed in _UNITS[1:] and computed is not wanted:
        return f"The question asks for {in_words(wanted)}, but the program computes {in_words(computed)}."
    return ""


def _sides(tree: ast.Module, asked: list[str]) -> Iterator[str]:
    """Sides that the program looks from, and that the question does not name."""
    words = _sides_by_word()
    if set(asked) & _listed("any_side"):
        return
    named = {side for side, others in words.items() if set(asked) & {side, *others}}
    for call in _searches(tree):
        given = [word.value for word in call.keywords] + call.args[1:]
        sides = [text for value in given for node in ast.walk(value) if (text := _text(node)) in words]
        for side in (side for side in sides if side not in named):
            right = [ast.unparse(word) for word in call.args[:1]]
            right += [f"sides={kept}"] if (kept := [side for side in sides if side in named]) else []
            yield f'The question does not say "{side}": write find_parts({", ".join(right)}).'


def _descriptions(tree: ast.Module, question: str, summary: ModelSummary | None) -> Iterator[str]:
    """Descriptions that are less than what the question calls the part, or something else.

    What the file calls the model and its bodies may be said of them.
    """
    heads = {singular(term.split()[-1]) for term in (summary.terms if summary else ()) if term.split()}
    names = (summary.shape.name, *(body.name for body in summary.shape.bodies)) if summary else ()
    said = [singular(word) for word in _WORD_OR_STOP.findall(question.lower())]
    allowed = {*prompt_data("words.toml")["questions"]["say_nothing"], *_WORD.findall(" ".join(names).lower())}
    for text in (text for call in _searches(tree) if call.args and (text := _text(call.args[0]))):
        words = [singular(word) for word in _WORD.findall(text.lower())]
        if words and set(words) <= _sides_by_word().keys():
            yield f'"{text}" is a side and no part: describe the part, and give the side in `sides`.'
        elif foreign := [word for word in words if not any(_is_form(word, other) for other in (*said, *allowed))]:
            yield f'The question does not say "{foreign[-1]}": describe the part in its own words.'
        elif words and (meant := _whole(words, said, heads)):
            yield f'"{text}" is only a part of the description: write find_parts("{meant}").'


def _whole(words: list[str], said: list[str], heads: set[str]) -> str:
    """The part's name as the question has it, where a description stops short of it; empty where it does not.

    A "screw hole" is no "screw", and a "hole with a ring" no "ring".
    """
    at = next((i for i, word in enumerate(said) if _is_form(words[-1], word)), None)
    if at is None:
        return ""
    if at + 1 < len(said) and said[at + 1] in heads:
        return " ".join([*words[:-1], *said[at : at + 2]])
    before = [word for word in said[: max(0, at + 1 - len(words))] if word not in _ARTICLES]
    is_with = before[-1:] == ["with"] and bool(heads & set(before[-2:-1]))
    return f"{before[-2]} with {' '.join(words)}" if is_with else ""


def _is_form(word: str, other: str) -> bool:
    return word == other or (len(word) >= _SAME_LETTERS and word[:_SAME_LETTERS] == other[:_SAME_LETTERS])


def _extreme(tree: ast.Module, asked: list[str]) -> Iterator[str]:
    """The largest of all, which the program does not choose."""
    described = " ".join(text for node in ast.walk(tree) if (text := _text(node))).lower()
    wanted = [word for word in asked if word in _listed("superlatives") and word not in described]
    if wanted and not _called(tree) & _CHOOSERS:
        yield f'The question says "{wanted[0]}": choose with max or min.'


def _lengths(tree: ast.Module, question: str) -> Iterator[str]:
    """Lengths of the question, be they a radius or a diameter, that the program leaves out."""
    numbers = literals(tree)
    described = " ".join(text for node in ast.walk(tree) if (text := _text(node)))
    for amount, metres in lengths_left_out(tree, question):
        is_halved = any(math.isclose(number, metres * factor) for number in numbers for factor in (0.5, 2.0))
        if not is_halved and amount.split()[0] not in described:
            yield f"The question says {amount}: the program lacks {metres:.6g}."


def _radius_or_diameter(code: str, asked: list[str]) -> Iterator[str]:
    """One of the two where the question asks for the other."""
    radius, diameter, read = bool(_RADII & set(asked)), bool(_DIAMETERS & set(asked)), set(measures(code))
    if read - _RADII - _DIAMETERS:  # a depth, say, of holes of that diameter
        return
    is_doubled, is_halved = re.search(r"\b2(?:\.0)? \*|\* 2\b", code), re.search(r"/ 2\b|\b0?\.5 \*|\* 0?\.5\b", code)
    if radius and not diameter and (("diameter" in read and not is_halved) or (read & _RADII and is_doubled)):
        yield "The question asks for a radius, and not for a diameter: do not double it."
    if diameter and not radius and read & _RADII and "diameter" not in read and not is_doubled:
        yield "The question asks for a diameter, and not for a radius: double it."


def _along(tree: ast.Module, question: str) -> Iterator[str]:
    """A distance in space where one along an axis is asked for."""
    found = _ALONG.search(question.lower())
    if found and _called(tree) & _DISTANCES:
        name = found[1] or found[2]
        at = _AXES[name]
        yield f"Along {name} only one coordinate of the centers counts: abs(a.center[{at}] - b.center[{at}])."


def _searches(tree: ast.Module) -> list[ast.Call]:
    """The calls of find_parts."""
    calls = [node for node in ast.walk(tree) if isinstance(node, ast.Call)]
    return [call for call in calls if isinstance(call.func, ast.Name) and call.func.id == "find_parts"]


def _called(tree: ast.Module) -> set[str]:
    """Names of all functions and methods that the program calls."""
    functions = [node.func for node in ast.walk(tree) if isinstance(node, ast.Call)]
    named = {function.id for function in functions if isinstance(function, ast.Name)}
    return named | {function.attr for function in functions if isinstance(function, ast.Attribute)}


def _text(node: ast.AST) -> str | None:
    return node.value if isinstance(node, ast.Constant) and isinstance(node.value, str) else None


def _listed(name: str) -> set[str]:
    return set(prompt_data("words.toml")["doubts"][name])


def _sides_by_word() -> dict[str, list[str]]:
    """The words of a question that name each side."""
    sides: dict[str, list[str]] = prompt_data("words.toml")["doubts"]["sides"]
    return sides
