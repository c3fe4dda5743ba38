"""What is a program's result made of? The variables that it depends on, nearest first, whatever they are called."""

from __future__ import annotations

import ast
from collections import deque
from collections.abc import Iterable, Iterator
from typing import Final

from querycad_contracts import RESULT

MOST: Final = 30
"""Variables told of, and names kept of what one is made of; a program of a few lines has fewer, and a hostile one costs
no more."""


def sources(code: str) -> tuple[tuple[str, ...], ...]:
    """Which variables does `solution` depend on? Those that it is made of, then those that these are, and so on.

    A loop's variable holds only the last of what it went through: what it went through is told instead. Empty for a
    program that cannot be parsed.
    """
    try:
        found = _Assignments()
        found.visit(ast.parse(code))
    except (SyntaxError, ValueError, RecursionError, MemoryError):
        return ()
    layers: list[tuple[str, ...]] = []
    seen, current = {RESULT}, found.made_of(RESULT)
    while current and len(seen) <= MOST:
        new = tuple(name for name in current if name not in seen)[:MOST]
        seen |= set(new)
        if new:
            layers.append(new)
        current = tuple(dict.fromkeys(name for each in new for name in found.made_of(each)))
    return tuple(layers)


class _Assignments(ast.NodeVisitor):
    """What each variable is made of: the names in what it is given, and in the conditions under which it is."""

    def __init__(self) -> None:
        self._read: dict[str, dict[str, None]] = {}
        """The names of each, in order; a dict is a set that keeps it."""
        self._loops: set[str] = set()
        self._conditions: tuple[str, ...] = ()

    def made_of(self, name: str) -> tuple[str, ...]:
        """Variables of the program that this one is made of, each once; of a loop's variable, what it goes through."""
        found: dict[str, None] = {}
        waiting, passed = deque(self._read.get(name, ())), set[str]()
        while waiting:
            each = waiting.popleft()
            if each in self._loops and each not in passed:
                passed.add(each)
                waiting.extendleft(reversed(self._read[each]))
            elif each in self._read and each not in self._loops:
                found[each] = None
        return tuple(found)

    def visit_Assign(self, node: ast.Assign) -> None:
        """`a = b = value`"""
        for target in node.targets:
            self._given(target, node.value)
        self.generic_visit(node)

    def visit_AnnAssign(self, node: ast.AnnAssign) -> None:
        """`a: float = value`"""
        if node.value is not None:
            self._given(node.target, node.value)
        self.generic_visit(node)

    def visit_AugAssign(self, node: ast.AugAssign) -> None:
        """`a += value`"""
        self._given(node.target, node.value)
        self.generic_visit(node)

    def visit_NamedExpr(self, node: ast.NamedExpr) -> None:
        """`(a := value)`"""
        self._given(node.target, node.value)
        self.generic_visit(node)

    def visit_Expr(self, node: ast.Expr) -> None:
        """`a.append(value)`: what a method is called with may go into what it is called on."""
        call = node.value
        if isinstance(call, ast.Call) and isinstance(call.func, ast.Attribute):
            self._given(call.func.value, *call.args)
        self.generic_visit(node)

    def visit_For(self, node: ast.For) -> None:
        """A loop: its variables go through what it loops over, and so depends on it what it makes."""
        self._given(node.target, node.iter)
        self._loops |= {name.id for name in ast.walk(node.target) if isinstance(name, ast.Name)}
        self._under(node.iter, node)

    def visit_If(self, node: ast.If) -> None:
        """A branch."""
        self._under(node.test, node)

    def visit_While(self, node: ast.While) -> None:
        """A loop on a condition."""
        self._under(node.test, node)

    def visit_FunctionDef(self, node: ast.FunctionDef) -> None:
        """A function gives what its body is made of to whoever calls it."""
        self._keep(node.name, [name for each in node.body for name in _names(each)])

    def _under(self, condition: ast.expr, node: ast.AST) -> None:
        outer = self._conditions
        self._conditions = tuple(dict.fromkeys((*_names(condition), *outer)))[:MOST]
        self.generic_visit(node)
        self._conditions = outer

    def _given(self, target: ast.expr, *values: ast.expr) -> None:
        """Notes that the target's variables are made of the values; `a[i]` and `a.b` are a part of `a`."""
        names = [*(name for value in values for name in _names(value)), *self._conditions]
        names = list(dict.fromkeys(names))[:MOST]
        for each in ast.walk(target):
            if isinstance(each, ast.Name):
                self._keep(each.id, names)

    def _keep(self, name: str, names: Iterable[str]) -> None:
        kept = self._read.setdefault(name, {})
        for each in names:
            if len(kept) < MOST:
                kept[each] = None


def _names(node: ast.AST) -> Iterator[str]:
    return (each.id for each in ast.walk(node) if isinstance(each, ast.Name) and isinstance(each.ctx, ast.Load))
