"""From a language model's reply to a program: the code block, with what small models forget put right."""

from __future__ import annotations

import ast
import re

from querycad_contracts import RESULT
from querycad_contracts.guest_reference import syntax_of

from .reference import attributes, functions

_THOUGHT = re.compile(r"<think>.*?(?:</think>|\Z)", re.DOTALL)
"""What reasoning models say to themselves."""
_BLOCK = re.compile(r"^[ \t]*```[ \t]*(?:python|py|Python)?[ \t]*\n(.*?)(?:^[ \t]*```|\Z)", re.DOTALL | re.MULTILINE)


def program_in(reply: str, cut: bool = False) -> str | None:
    """Which program does a reply hold? The last code block that assigns `solution`, else the last; None without any.

    A reply without a block is a program where all of it is one. Of a reply that was cut, half a block does not count.
    """
    said, blocks = _whole(reply, cut), blocks_in(reply, cut)
    if not blocks:
        return _tidied(said) if _is_program(said) else None
    assigning = [block for block in blocks if re.search(rf"^\s*{RESULT}\b", block, re.MULTILINE)]
    return _tidied((assigning or blocks)[-1])


def blocks_in(reply: str, cut: bool = False) -> list[str]:
    """The code blocks of a reply as they are, in order. Of a reply that was cut, half a block does not count."""
    return [block.strip("\n") for block in _BLOCK.findall(_whole(reply, cut)) if block.strip()]


def _whole(reply: str, cut: bool) -> str:
    """What a reply says, without thoughts and what was cut off."""
    said = _THOUGHT.sub("", reply).strip()
    return said.rpartition("```")[0] if cut and said.count("```") % 2 else said


def _is_program(text: str) -> bool:
    if (tree := syntax_of(text)) is None:
        return False
    return any(_assigns(node, RESULT) for node in tree.body)


def _tidied(code: str) -> str:
    """The program without imports of what is there anyway, and with its last value assigned where nothing is."""
    if (tree := syntax_of(code)) is None:
        return code
    body = [node for node in tree.body if not _is_needless(node)]
    if body and not any(_assigns(node, RESULT) for node in ast.walk(tree)):
        body[-1] = _assigned(body[-1])
    if body == tree.body:
        return code
    return ast.unparse(ast.fix_missing_locations(ast.Module(body, [])))


def _is_needless(node: ast.stmt) -> bool:
    """Is it an import of nothing but the guest API's own names?"""
    provided = {"*", *functions(), *attributes()}
    return isinstance(node, ast.ImportFrom) and all(alias.name in provided for alias in node.names)


def _assigned(last: ast.stmt) -> ast.stmt:
    """The last statement with its value assigned to `solution`: of a print, of an expression, of another variable."""
    value: ast.expr | None = None
    if isinstance(last, ast.Expr):
        call = last.value
        is_print = isinstance(call, ast.Call) and isinstance(call.func, ast.Name) and call.func.id == "print"
        value = call.args[-1] if is_print and isinstance(call, ast.Call) and call.args else call
    elif (isinstance(last, ast.Assign) and isinstance(last.targets[0], ast.Name)) or isinstance(last, ast.Return):
        value = last.value
    return last if value is None else ast.Assign([ast.Name(RESULT, ast.Store())], value)


def _assigns(node: ast.AST, name: str) -> bool:
    targets: list[ast.expr] = []
    if isinstance(node, ast.Assign):
        targets = node.targets
    elif isinstance(node, ast.AnnAssign | ast.AugAssign | ast.NamedExpr):
        targets = [node.target]
    return any(isinstance(target, ast.Name) and target.id == name for target in targets)
