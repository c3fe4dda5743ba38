"""Kinds of parts are members of `PartKind`, not strings, wherever several stand together."""

from __future__ import annotations

import ast
from collections.abc import Iterator
from pathlib import Path

from querycad_contracts import PartKind

ROOT = Path(__file__).parents[2]
KINDS = frozenset(kind.value for kind in PartKind)
SEVERAL = 2
ALLOWED: frozenset[str] = frozenset()
"""'path: literal' of what looks like kinds of parts, and is none."""


def sets_of_kinds(source: str) -> Iterator[str]:
    """Tuples, sets and lists of two strings or more, all of them kinds; two of what `.kind` is compared with."""
    tree = ast.parse(source)
    compared = {
        id(literal)
        for node in ast.walk(tree)
        if isinstance(node, ast.Compare) and isinstance(node.left, ast.Attribute) and node.left.attr == "kind"
        for comparator in node.comparators
        for literal in ast.walk(comparator)
    }
    for node in ast.walk(tree):
        if isinstance(node, ast.Tuple | ast.Set | ast.List):
            held = [one.value for one in node.elts if isinstance(one, ast.Constant) and one.value in KINDS]
            if len(held) >= SEVERAL and (len(held) == len(node.elts) or id(node) in compared):
                yield ast.unparse(node)


def test_no_kinds_of_parts_stand_together_as_strings() -> None:
    paths = [path for folder in ("packages", "services") for path in sorted((ROOT / folder).rglob("*.py"))]
    found = {
        f"{path.relative_to(ROOT)}: {literal}"
        for path in paths
        if "build" not in path.relative_to(ROOT).parts
        for literal in sets_of_kinds(path.read_text(encoding="utf-8"))
    }
    assert found == ALLOWED


def test_kinds_as_strings_are_seen_and_members_and_other_words_are_not() -> None:
    assert list(sets_of_kinds('a = part.kind in ("hole", "boss")\nB = frozenset(["hole", "slot"])')) == [
        "('hole', 'boss')",
        "['hole', 'slot']",
    ]
    assert list(sets_of_kinds('a = part.kind not in {"screw", "hole", "boss"}')) != []
    assert list(sets_of_kinds('a = part.kind in (PartKind.HOLE, PartKind.BOSS)\nb = ("hole", "holes")')) == []
