"""Programs as a semantic parser or a language model writes them, each with the answer that it gives on the plate."""

from __future__ import annotations

import math
from typing import TYPE_CHECKING, Any

import pytest

from querycad_contracts import RunStatus
from querycad_sandbox import Sandbox

if TYPE_CHECKING:
    from tests.llm_sandbox.conftest import FakePartFinder

PROGRAMS: list[tuple[str, Any]] = [
    ('solution = [p.radius for p in find_parts("hole")]', [0.0025, 0.0025, 0.005]),
    ('solution = len(find_parts("hole", sides=["top"]))', 3),
    ('solution = len(find_parts("hole", sides=["left", "right"]))', 0),
    ('solution = len(find_parts("hole", sides="top"))', 3),
    ('sides = ["top", "bottom"]\nsolution = len(find_parts("hole", sides))', 3),
    ('solution = len(find_parts("gear"))', 0),
    ('parts = find_parts("hole")\nsolution = max(parts, key=lambda p: p.radius).depth', 0.01),
    ('parts = find_parts("hole")\nsolution = sorted({round(p.diameter, 7) for p in parts})', [0.005, 0.01]),
    ('solution = {p.radius for p in find_parts("hole")}', [0.0025, 0.005]),
    ("solution = shape.extents[2]", 0.01),
    ("solution = shape.extents", [0.1, 0.04, 0.01]),
    ("w, d, h = shape.extents\nsolution = w * d * h", 0.1 * 0.04 * 0.01),
    ("solution = [b.name for b in shape.bodies]", ["plate"]),
    ('solution = find_parts("gear")[0].radius if find_parts("gear") else None', None),
    (
        'parts = find_parts("hole")\n'
        "solution = min(distance(a.center, b.center) for i, a in enumerate(parts) for b in parts[i + 1:])",
        0.03,
    ),
    (
        "import itertools\n"
        'pairs = itertools.combinations(find_parts("hole"), 2)\n'
        "solution = max(distance(a.center, b.center) for a, b in pairs)",
        0.06,
    ),
    ('solution = next((p.id for p in find_parts("hole") if p.edge_distance() < 0.003), None)', "hole-2"),
    ('solution = [isinstance(x, Part) for x in [find_parts("hole")[0], shape, 3]]', [True, False, False]),
    ('p = find_parts("hole")[0]\nsolution = f"{p.radius * 1000:.1f} mm"', "2.5 mm"),
    ("import math\nsolution = math.pi * 2", 2 * math.pi),
    ("from math import sqrt\nsolution = sqrt(4)", 2.0),
    ('def area(p):\n    return 3.0 * p.radius\nsolution = sum(area(p) for p in find_parts("boss"))', 0.009),
    ('def largest(ps: list[Part]) -> Part:\n    return max(ps, key=lambda p: p.radius)\n'
     'solution = largest(find_parts("hole"))', {"part": "hole-3"}),
    (
        "groups = {}\n"
        'for p in find_parts("hole"):\n'
        "    groups.setdefault(round(p.radius, 6), []).append(p)\n"
        "solution = sorted(len(g) for g in groups.values())",
        [1, 2],
    ),
    (
        "from collections import Counter\n"
        'solution = Counter(p.radius for p in find_parts("hole")).most_common(1)[0][0]',
        0.0025,
    ),
    ('solution = different([p.radius for p in find_parts("hole")])', [0.0025, 0.005]),
    ('solution = different({p.radius for p in find_parts("hole")})', [0.0025, 0.005]),
    ("solution = different([3.0, 1.0, 1.0000005, 2.0])", [1.0, 2.0, 3.0]),
    ("solution = different(['M6', 'M5', 'M6'])", ["M5", "M6"]),
    ("solution = [close(0.01, 0.01005), close(0.01, 0.0101), close(1, 2, tolerance=3)]", [True, False, True]),
    ('solution = [p for p in find_parts("hole") if close(p.radius, 0.005)]', [{"part": "hole-3"}]),
    ('solution = find_parts("hole")[0].faces[0]', {"face": 1}),
    ('solution = [f.radius for f in find_parts("hole")[0].faces if f.kind == "cylinder"]', [0.0025, 0.0025]),
    ('solution = min(find_parts("hole"), key=lambda p: p.edge_distance()).id', "hole-2"),
    ('solution = [p.id for p in sorted(find_parts("hole"), key=lambda p: p.faces[0].area, reverse=True)]',
     ["hole-1", "hole-2", "hole-3"]),
    ('solution = list(map(lambda p: p.edge_distance(), find_parts("hole")))', [0.003, 0.002, 0.004]),
    ('solution = len(list(filter(lambda p: p.edge_distance() > 0.0025, find_parts("hole"))))', 2),
    ('a = find_parts("hole")[0]\nb = find_parts("boss")[0]\nsolution = a.distance_to(b)', 0.007),
    ('a, b, *rest = find_parts("hole")\nsolution = a.center_distance(b)', 0.03),
    ('solution = find_parts("hole")[0].angle_to(find_parts("boss")[0])', math.pi / 2),
    ('solution = getattr(find_parts("slot")[0], "radius", -1)', -1),
    ('solution = [hasattr(p, "tip") for p in find_parts("hole") + find_parts("boss")]', [False, False, False, True]),
    ('try:\n    solution = find_parts("slot")[0].radius\nexcept AttributeError:\n    solution = "none"', "none"),
    (
        "best = None\n"
        'for p in find_parts("hole"):\n'
        "    if best is None or p.radius > best.radius:\n"
        "        best = p\n"
        "solution = best.radius * 1000",
        5.0,
    ),
    ('solution = max(find_parts("gear"), key=lambda p: p.radius, default=None)', None),
    ('solution = any("through" in p.tags for p in find_parts("hole"))', True),
    ('solution = "left" in find_parts("boss")[0].sides', True),
    ('solution = find_parts("hole")[0].bottom == "through"', True),
    ('parts = find_parts("hole")\nparts.sort(key=lambda p: -p.center[0])\nsolution = parts[0].id', "hole-3"),
    ("v = shape.extents\nsolution = max(range(3), key=lambda i: v[i])", 0),
    ('solution = tuple(-x for x in find_parts("hole")[0].normal)', [0.0, 0.0, -1.0]),
    ('c = [sum(v) / 3 for v in zip(*[p.center for p in find_parts("hole")])]\n'
     "solution = distance(c, shape.center)", 0.0),
    ('match len(find_parts("hole")):\n    case 3:\n        solution = "three"\n'
     '    case _:\n        solution = "other"', "three"),
    ("solution: list[float] = [b.volume for b in shape.bodies]", [4e-5]),
    ('largest: Part = None\nfor p in find_parts("boss"):\n    largest = p\nsolution = largest.height', 0.005),
    ('# the holes\n\nholes = find_parts("hole")  # all of them\nprint(len(holes))\nsolution = len(holes)', 3),
]  # fmt: skip


@pytest.mark.parametrize(("code", "answer"), PROGRAMS, ids=[code[:60] for code, _ in PROGRAMS])
def test_an_ordinary_program_gives_its_answer(sandbox: Sandbox, finder: FakePartFinder, code: str, answer: Any) -> None:
    outcome = sandbox.run(code, finder)
    assert (outcome.status, outcome.message) == (RunStatus.OK, "")
    expected = pytest.approx(answer) if isinstance(answer, float | list) and not _has_dicts(answer) else answer
    assert outcome.value == expected
    assert type(outcome.value) is type(answer)


def _has_dicts(answer: Any) -> bool:
    return isinstance(answer, list) and any(isinstance(item, dict | str) for item in answer)


@pytest.mark.parametrize(
    "expression",
    [
        "sorted([3, 1, 2], reverse=True)",
        "sorted(['bb', 'a', 'cc'], key=len, reverse=True)",
        "sorted([('b', 1), ('a', 1), ('c', 0)], key=lambda v: v[1])",
        "sorted({3: 'x', 1: 'y'})",
        "min([4, 2, 3])",
        "min(4, 2, 3)",
        "min([], default=7)",
        "min(['bb', 'a', 'c'], key=len)",
        "max('abc', key=lambda v: v)",
        "max(1, -5, key=abs)",
        "max([], key=abs, default='none')",
        "max([(1, 'a'), (1, 'b')], key=lambda v: v[0])",
        "list(map(lambda a, b: a + b, [1, 2, 3], (10, 20)))",
        "list(map(str, range(3)))",
        "list(filter(None, [0, 1, 2]))",
        "list(filter(lambda v: v > 1, (1, 2, 3)))",
        "next(v for v in [3, 4, 5] if v > 3)",
        "next((v for v in []), 'none')",
        "[next(g) + next(g) for g in [(v for v in [1, 2, 3])]]",
        "[next(i) + next(i) for i in [iter([1, 2, 3])]]",
    ],
)
def test_builtins_with_a_key_behave_as_in_python(sandbox: Sandbox, finder: FakePartFinder, expression: str) -> None:
    outcome = sandbox.run(f"solution = {expression}", finder)
    expected = eval(expression)  # noqa: S307 - one of the expressions above
    assert outcome.message == ""
    assert outcome.value == (
        [list(v) if isinstance(v, tuple) else v for v in expected] if isinstance(expected, list | tuple) else expected
    )
