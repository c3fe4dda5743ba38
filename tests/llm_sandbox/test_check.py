"""The type check: it refuses what cannot work, lets the rest run, runs nothing itself and remembers nothing."""

from __future__ import annotations

from collections.abc import Iterator

import pytest
from tests.llm_sandbox.conftest import FakePartFinder

from querycad_contracts import RunStatus
from querycad_sandbox import Sandbox
from querycad_sandbox.check import CHECKS_PER_SESSION, MODULES, TypeChecker


@pytest.fixture(scope="module")
def checker() -> Iterator[TypeChecker]:
    made = TypeChecker(1)
    made.start()
    yield made
    made.close()


def test_the_nearest_attribute_is_told(checker: TypeChecker) -> None:
    (problem,) = checker.problems('solution = find_parts("hole")[0].diametre')
    assert problem == "line 1: Object of type `Part` has no attribute `diametre`, perhaps `diameter` is meant"
    (problem,) = checker.problems('solution = find_parts("hole")[0].xyzzy')
    assert problem.endswith("has no attribute `xyzzy`")
    (problem,) = checker.problems('solution = find_parts("hole")[0].position')
    assert problem.endswith("has no attribute `position`, perhaps `center` is meant")
    (problem,) = checker.problems("solution = find_holes()")
    assert problem.endswith("used when not defined, perhaps `find_parts` is meant")


def test_parts_that_are_sought_on_an_object_are_told_with_their_call(checker: TypeChecker) -> None:
    (problem,) = checker.problems("solution = len(shape.holes)")
    assert problem.endswith("has no attribute `holes`: parts(kind='hole') gives those of the model")
    (problem,) = checker.problems("solution = len(shape.wombats)")
    assert problem.endswith("has no attribute `wombats`")


def test_a_module_that_is_not_there_is_told_with_those_that_are(checker: TypeChecker, sandbox: Sandbox) -> None:
    (problem,) = checker.problems("import numpy as np")
    assert problem.endswith("module `numpy`; there are math, re, itertools, functools, collections")
    outcome = sandbox.run(f"import {', '.join(MODULES)}\nsolution = 1", FakePartFinder())
    assert outcome.value == 1


@pytest.mark.parametrize(
    ("code", "problem"),
    [
        ("solution = undefined", "line 1: Name `undefined` used when not defined"),
        ("\n\nsolution = math.pi", "line 3: Name `math` used when not defined"),
        ("import statistics", "line 1: Cannot resolve imported module `statistics`"),
        ("import os, subprocess", "line 1: Cannot resolve imported module `subprocess`"),
        ('solution = find_parts("hole")[0].colour', "line 1: Object of type `Part` has no attribute `colour`"),
        ('solution = find_parts("hole").radius', "line 1: Object of type `Parts` has no attribute `radius`"),
        ("solution = shape.solids", "line 1: Object of type `Shape` has no attribute `solids`"),
        ("solution = shape.width()", "line 1: Object of type `float` is not callable"),
        ('solution = find_parts("hole", side=["top"])', "line 1: Argument `side` does not match any known parameter"),
        ("solution = find_parts()", "line 1: No argument provided for required parameter `description`"),
        ("solution = distance(shape.center)", "line 1: No argument provided for required parameter `b`"),
        ("solution = close(1, 2, 3, 4)", "line 1: Too many positional arguments"),
        ('solution = find_parts("hole")[0]["radius"]', "line 1: Cannot subscript object of type `Part`"),
        ("for x in shape:\n    solution = x", "line 1: Object of type `Shape` is not iterable"),
        ('solution = shape.name + 1', "line 1: Operator `+` is not supported"),
        ("solution = = 1", "line 1: Expected an expression"),
        ("if True:\nsolution = 1", "line 2: Expected an indented block"),
        ('solution = "', "line 1: "),
        ("solution = (", "line 1: "),
        ("x = 1\n y = 2", "line 2: Unexpected indentation"),
        ("solution = open('/etc/passwd')", "line 1: Name `open` used when not defined"),
        ("solution = __import__('os')", "line 1: Name `__import__` used when not defined"),
        ("from __future__ import annotations\nsolution = 1", "line 1: "),
    ],
)  # fmt: skip
def test_what_cannot_work_is_refused_with_its_line(checker: TypeChecker, code: str, problem: str) -> None:
    problems = checker.problems(code)
    assert problems[0].startswith(problem)


@pytest.mark.parametrize(
    "code",
    [
        "best = None\nfor p in find_parts('hole'):\n    best = p\nsolution = best.radius * 2",
        "best = None\nfor p in find_parts('hole'):\n    best = p.radius\nsolution = round(best * 1000, 2)",
        "solution = max(find_parts('hole'), key=lambda p: p.radius, default=None).center[2]",
        "a = None\nif shape.width > 2:\n    a = find_parts('hole')\nsolution = [len(a), a[0].id] + [p.id for p in a]",
        "import re\nsolution = re.match('a', shape.name).group(0)",
        "x = 1 if shape.width > 2 else 'one'\nsolution = x + 1",
        "largest: Part = None\nsolution = 1",
        "def f(parts: list[Part] = None) -> int:\n    return 'a'\nsolution = f()",
        "solution: int = 'a'",
        "c = [sum(v) for v in zip(*[p.center for p in find_parts('hole')])]\nsolution = distance(c, shape.center)",
        "sides = ['top']\nsolution = find_parts('hole', sides=sides)",
        "def f(x):\n    return x.anything\nsolution = f(3)",
        "solution = getattr(find_parts('hole')[0], 'radius', None)",
        "solution = undefined  # type: ignore",
    ],
)
def test_what_may_work_is_left_to_the_run(checker: TypeChecker, code: str) -> None:
    assert checker.problems(code) == ()


def test_several_problems_are_told_in_order_up_to_ten(checker: TypeChecker) -> None:
    problems = checker.problems("\n".join(f"x{i} = undefined{i}" for i in range(30)))
    assert [p.partition(":")[0] for p in problems] == [f"line {i}" for i in range(1, 11)]


def test_no_program_is_remembered(checker: TypeChecker) -> None:
    for code in ("value = 1", "def value(): ...", "import math", "class value: ...", "solution = 1"):
        assert checker.problems(code) == ()
    for name in ("value", "math", "solution"):
        assert checker.problems(f"x = {name}") == (f"line 1: Name `{name}` used when not defined",)


def test_no_program_is_run(sandbox: Sandbox) -> None:
    """A run that the check refuses has asked nothing and printed nothing."""
    finder = FakePartFinder()
    outcome = sandbox.run('print("hello")\nsolution = len(find_parts("hole"))\nsolution = undefined', finder)
    assert (outcome.status, outcome.printed, finder.calls) == (RunStatus.REFUSED, "", [])


def test_a_program_cannot_name_the_line_that_guards_its_check(checker: TypeChecker) -> None:
    other = TypeChecker(1)
    assert checker._gate != other._gate
    other.start()
    other.close()
    assert checker.problems(f"{other._gate} = 1\nsolution = {other._gate}") == ()


@pytest.mark.parametrize(
    "code",
    [
        "# ty: ignore\nsolution = 1",
        "# type: ignore\nsolution = 1",
        "while True:\n    pass",
        "raise SystemExit",
        "from typing import *\nsolution = 1",
        "def f():\n    global solution\n    solution = 1\nf()",
    ],
)
def test_the_check_never_runs_a_program_that_means_to_escape_it(checker: TypeChecker, code: str) -> None:
    assert checker.problems(code) == ()
    assert checker.problems("x = solution") == ("line 1: Name `solution` used when not defined",)


@pytest.mark.parametrize(
    "code",
    [
        "solution = " + "(" * 10000 + "1" + ")" * 10000,
        "solution = " + "-" * 60000 + "1",
        "solution = " + "lambda: " * 6000 + "1",
        "solution = shape" + ".x" * 20000,
        "solution = " + "[" * 5000 + "]" * 5000,
    ],
    ids=["parentheses", "minus", "lambda", "attributes", "lists"],
)
def test_what_is_nested_too_deeply_is_refused(checker: TypeChecker, code: str) -> None:
    assert checker.problems(code) == ("invalid syntax: Source is too deeply nested",)
    assert checker.problems("solution = 1") == ()


def test_a_program_that_never_ends_being_checked_is_refused(checker: TypeChecker) -> None:
    grows = "".join(f"  x = (x, {i}) if shape.area else [x]\n" for i in range(30))
    assert checker.problems(f"x = 0\nwhile shape.volume > 0:\n{grows}solution = x") == (
        "the program could not be checked in 3 s",
    )
    assert checker.problems("solution = 1") == ()


def test_a_session_is_renewed_after_its_share_of_programs(checker: TypeChecker) -> None:
    for i in range(CHECKS_PER_SESSION + 2):
        assert checker.problems(f"solution = {i}") == ()


@pytest.mark.parametrize(
    ("code", "status", "said"),
    [
        ("x = 1\nsolution = undefined", RunStatus.RAISED, "NameError: name 'undefined' is not defined (line 2"),
        ("solution = shape.solids", RunStatus.RAISED, "has no solids; it has"),
        ("solution = find_parts('hole')[0].colour", RunStatus.RAISED, "has no colour; it has"),
        ("solution = open('/etc/passwd').read()", RunStatus.RAISED, "open"),
        ("solution = __import__('os').environ", RunStatus.RAISED, "__import__"),
        ("import subprocess\nsolution = subprocess.run('id')", RunStatus.RAISED, "subprocess"),
        ("solution = = 1", RunStatus.REFUSED, "invalid syntax"),
        ("solution = len(find_parts('hole'))", RunStatus.OK, ""),
    ],
)
def test_without_it_what_does_not_exist_fails_when_the_program_gets_there(
    sandbox: Sandbox, code: str, status: RunStatus, said: str
) -> None:
    outcome = sandbox.run(code, FakePartFinder(), check=False)
    assert (outcome.status, outcome.value is None) == (status, status is not RunStatus.OK)
    assert said in outcome.message


@pytest.mark.parametrize(
    "code",
    [
        'parts = find_parts("hole")\nparts.sort(key=lambda p: p.center)\nsolution = [parts[0].id, parts + parts]',
        'parts = parts(kind="hole")\nparts.sort(key=lambda p: p.center)\nsolution = parts',
        "distance = [1.0]\ndistance.append(2.0)\nsolution = sum(distance)",
        "def f(on):\n    return on[0]\non = [1]\nsolution = f(on)",
    ],
)
def test_a_variable_may_be_called_like_a_function_of_the_guest_api(checker: TypeChecker, code: str) -> None:
    assert checker.problems(code) == ()


def test_a_variable_called_like_a_function_is_still_checked(checker: TypeChecker) -> None:
    code = 'parts = parts(kind="hole")\nsolution = parts.bogus'
    assert checker.problems(code) == ("line 2: Object of type `list[Part]` has no attribute `bogus`",)
