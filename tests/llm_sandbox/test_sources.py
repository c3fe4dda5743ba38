"""What a result is made of is read off the program's assignments, by no variable's name."""

from __future__ import annotations

import time

import pytest

from querycad_sandbox.sources import MOST, sources


@pytest.mark.parametrize(
    ("code", "layers"),
    [
        ("solution = 1", ()),
        ("a = find()\nsolution = len(a)", (("a",),)),
        ("a = find()\nb = max(a)\nsolution = b.depth", (("b",), ("a",))),
        ("a = find()\nsolution = [p.radius for p in a]", (("a",),)),
        ("a = find()\nt = 0\nfor p in a:\n    t += p.radius\nsolution = t", (("t",), ("a",))),
        ("a = find()\nfor i, p in enumerate(a):\n    best = p\nsolution = best.depth", (("best",), ("a",))),
        ("a = find()\nb = find()\nif a:\n    solution = 1\nelse:\n    solution = len(b)", (("a", "b"),)),
        ("a = find()\nb = []\nfor p in a:\n    b.append(p)\nsolution = len(b)", (("b",), ("a",))),
        ("a = find()\nd = {}\nd['x'] = a\nsolution = len(d)", (("d",), ("a",))),
        ("a: list = find()\nsolution = len(b := a)", (("a",),)),
        ("a = find()\ndef f():\n    return a\nsolution = len(f())", (("f",), ("a",))),
        ("a = b\nb = a\nsolution = a", (("a",), ("b",))),
        ("for p in p:\n    solution = p", ()),
        ("a = find()\nother = find()\nsolution = len(a)", (("a",),)),
        ("solution = (", ()),
    ],
)
def test_the_variables_come_the_nearest_first(code: str, layers: tuple[tuple[str, ...], ...]) -> None:
    assert sources(code) == layers


def test_a_program_of_very_many_variables_is_told_of_in_part() -> None:
    wide = "\n".join(f"a{i} = 1" for i in range(500)) + "\nsolution = [" + ", ".join(f"a{i}" for i in range(500)) + "]"
    long = "\n".join(f"a{i + 1} = a{i}" for i in range(500)) + "\nsolution = a500"
    for code in (wide, long):
        assert MOST <= sum(map(len, sources(code))) <= 2 * MOST


def test_a_hostile_program_is_read_in_a_moment() -> None:
    names = ", ".join(f"a{i}" for i in range(4000))
    body = "\n".join(f"    b{i} = b{i + 1}" for i in range(2000))
    loops = "\n".join(f"for a{i} in a{i + 1}: pass" for i in range(1500))
    began = time.process_time()
    codes = [
        f"if [{names}]:\n{body}\nsolution = b0",
        f"{loops}\nsolution = a0",
        f"[{names}] = [{names}]\nsolution = a0",
    ]
    for code in codes:
        sources(code)
    assert time.process_time() - began < 2


def test_a_program_that_is_too_deep_to_be_read_has_no_sources() -> None:
    assert sources("solution = " + "-" * 20000 + "1") == ()
    assert sources("solution = " + "(" * 5000 + "1" + ")" * 5000) == ()
