"""From what language models say to programs: the right block, and what they forget put right; checks and hints."""

from __future__ import annotations

import pytest

from querycad_answering.llm.checks import problems
from querycad_answering.llm.hints import hint
from querycad_answering.llm.program import program_in
from querycad_contracts import MissingAttribute

FENCED = "```python\n{}\n```"


@pytest.mark.parametrize(
    ("reply", "code"),
    [
        ("I count.\n```python\nsolution = 1\n```\nThat is it.", "solution = 1"),
        ("```\nsolution = 1\n```", "solution = 1"),
        ("```py\nsolution = 1", "solution = 1"),
        ("```python\nparts = 1\n```\nor\n```python\nsolution = 2\n```\n```python\nprint(3)\n```", "solution = 2"),
        ("<think>```python\nsolution = 0\n```</think>```python\nsolution = 1\n```", "solution = 1"),
        ("solution = len(find_parts('hole'))", "solution = len(find_parts('hole'))"),
        ("  ```python\n  solution = 1\n  ```", "  solution = 1"),
    ],
)
def test_the_program_is_the_block_that_gives_the_solution(reply: str, code: str) -> None:
    assert program_in(reply) == code


@pytest.mark.parametrize(
    "reply", ["", "I do not know.", "```python\n```", "<think>```python\nsolution = 1\n```", "x = 1"]
)
def test_prose_is_no_program(reply: str) -> None:
    assert program_in(reply) is None


@pytest.mark.parametrize(
    ("said", "meant"),
    [
        ("parts = find_parts('hole')\nlen(parts)", "parts = find_parts('hole')\nsolution = len(parts)"),
        ("parts = find_parts('hole')\nprint(len(parts))", "parts = find_parts('hole')\nsolution = len(parts)"),
        ("print('radius', shape.width)", "solution = shape.width"),
        ("answer = shape.width", "solution = shape.width"),
        ("from cad import shape, find_parts\nsolution = shape.width", "solution = shape.width"),
        ("from guest_api import *\nsolution = shape.width", "solution = shape.width"),
        ("return shape.width", "solution = shape.width"),
        ("import math\nsolution = math.pi", "import math\nsolution = math.pi"),
        ("from math import pi\nsolution = pi", "from math import pi\nsolution = pi"),
        ("if 1 < 2:\n    solution = 1", "if 1 < 2:\n    solution = 1"),
        ("solution = (", "solution = ("),
    ],
)  # fmt: skip
def test_what_was_forgotten_is_put_right_and_nothing_else_changed(said: str, meant: str) -> None:
    assert program_in(FENCED.format(said)) == meant


@pytest.mark.parametrize(
    "code",
    [
        "solution = [p.radius * 1000 for p in find_parts('hole')]",
        "solution = 1e3 * shape.width",
        "solution = shape.width / 0.0254",
        "solution = [p.length * 0.0254 for p in find_parts('neck')]",
        "solution = 0.001 * shape.width",
        "solution = 25.4 * find_parts('bend')[0].bend_radius",
        "solution = shape.volume * 1e9",
        "solution = round(shape.width, 2)",
        "import math\nsolution = math.degrees(shape.bodies[0].area)",
        "solution = 4",
        "solution = [0.0053, 0.0053]",
        "solution = [p.depth for p in find_parts('hole') if p.diameter == 0.0055]",
        "solution = [p.depth for p in find_parts('hole') if p.center[0] == 0 and p.center[1] == 0]",
        "solution = min(p.center_distance(p) for p in find_parts('hole'))",
    ],
)
def test_a_result_that_is_written_in_or_not_in_metres_is_sent_back(code: str) -> None:
    assert problems(code)


@pytest.mark.parametrize(
    "code",
    [
        "solution = [p.radius for p in find_parts('hole') if p.depth > 5 / 1000]",
        "solution = [p for p in find_parts('hole') if p.depth > 5 * 0.001]",
        "solution = [p for p in find_parts('hole') if p.depth > p.count * 0.001]",
        "solution = shape.volume * 0.001",
        "solution = shape.width > 10 * shape.height",
        "solution = [p for p in find_parts('hole') if p.count == 4 and p.radius == max(q.radius for q in [p])]",
        "solution = shape.width / 2",
        "solution = 1000 * len(find_parts('hole'))",
        "solution = round(shape.width, 9)",
        "solution = (",
    ],
)
def test_what_may_be_meant_is_let_through(code: str) -> None:
    assert problems(code) == ()


HOLES = "solution = len([p for p in find_parts('hole') if {}])"


@pytest.mark.parametrize(
    ("question", "condition", "said"),
    [
        ("How many holes have a radius of 1.5 to 1.7 mm?", "0.015 <= p.radius <= 0.017", "1.5 mm is 0.0015 in metres"),
        ("How many holes have a diameter of 5,5 mm?", "close(p.diameter, 5.5)", "5,5 mm is 0.0055 in metres"),
        ("How many holes are deeper than 2 cm?", "p.depth > 0.2", "2 cm is 0.02 in metres"),
        ('How many holes are deeper than 3"?', "p.depth > 0.00762", "is 0.0762 in metres"),
    ],
)
def test_a_number_that_slipped_by_a_power_of_ten_is_sent_back(question: str, condition: str, said: str) -> None:
    assert said in " ".join(problems(HOLES.format(condition), question))


@pytest.mark.parametrize(
    ("question", "condition"),
    [
        ("How many holes have a radius of 1.5 to 1.7 mm?", "0.0015 <= p.radius <= 0.0017"),
        ("How many holes have a radius between 4 and 6 mm?", "4 / 1000 <= p.radius <= 6 / 1000"),
        ("How many 5.5 mm holes are there?", "close(2 * p.radius, 5.5e-3)"),
        ("How many M5 holes are there in 2 plates?", "p.depth > 0.002"),
        ("How many holes are deeper than 2 inches?", "p.depth > 0.0508"),
        ("How many holes are deeper than 10 mm?", "p.depth > shape.height"),
    ],
)
def test_a_number_that_is_right_is_let_through(question: str, condition: str) -> None:
    assert problems(HOLES.format(condition), question) == ()


@pytest.mark.parametrize(
    ("message", "said"),
    [
        ("line 1: Object of type `Part` has no attribute `position`", "Instead of .position use .center."),
        ("line 1: Object of type `Part` has no attribute `diametr`", "Instead of .diametr use .diameter."),
        ("line 1: Object of type `Shape` has no attribute `size`", "Instead of .size use .extents."),
        ("line 2: Object of type `list[Part]` has no attribute `radius`", "[p.radius for p in parts]"),
        ("line 1: Name `find_holes` used when not defined", "Instead of find_holes use find_parts."),
        ("line 1: Argument `side` does not match any known parameter of function `find_parts`", 'sides=["top"]'),
        ("IndexError: list index out of range (line 2: solution = parts[0].radius)", "A list was empty"),
        ("ValueError: max() iterable argument is empty", "A list was empty"),
    ],
)
def test_a_repair_names_what_was_meant(message: str, said: str) -> None:
    assert said in hint(message)


def test_of_a_measure_that_a_program_ended_for_want_of_the_name_that_was_meant_is_told() -> None:
    message = "AttributeError: part 'hole-1' has no diametr; it has area, diameter"
    said = hint(message, MissingAttribute(part="hole-1", attribute="diametr"))
    assert "Instead of .diametr use .diameter." in said
    assert hint(message, MissingAttribute(part="hole-1", attribute="diameter")) == hint(message) == ""


def test_nothing_is_added_where_nothing_more_is_known() -> None:
    assert hint("ZeroDivisionError: division by zero (line 1: solution = 1 / 0)") == ""
