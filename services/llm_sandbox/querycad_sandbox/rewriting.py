"""What a list in the sandbox cannot have, said otherwise: `.ignored_words` and `.not_checked` of what find_parts gives.

The interpreter has no classes that are lists. A program that reads these attributes is run with `_left(parts, "name")`
in their place, and with its find_parts calls noted; every other program is run as it is. Lines keep their numbers.
"""

from __future__ import annotations

import ast
from typing import Final

from querycad_contracts.guest_reference import syntax_of

ATTRIBUTES: Final = ("ignored_words", "not_checked")
WORDS_LEFT: Final = "_words_left"
"""The host function that `_noted` of inside/prelude.py asks right after a find_parts call."""


def rewritten(code: str) -> str:
    """The program as it is run; as it was, where it reads none of the attributes or cannot be parsed."""
    if not any(name in code for name in ATTRIBUTES):
        return code
    code = code.replace("\r\n", "\n").replace("\r", "\n")  # as Python reads lines
    if (tree := syntax_of(code)) is None:
        return code
    text = code.encode()
    starts = [0, *(at + 1 for at, byte in enumerate(text) if byte == ord("\n"))]
    edits: list[
        tuple[int, int, int, bytes]
    ] = []  # where, closing before opening, order at one place, what is put there
    dropped: dict[int, int] = {}  # from where to where text is left out
    for order, node in enumerate(ast.walk(tree)):  # what is outside comes first
        if isinstance(node, ast.Attribute) and node.attr in ATTRIBUTES and isinstance(node.ctx, ast.Load):
            first, last = _span(node, starts)
            whole = text[first:last].removesuffix(node.attr.encode()).rstrip().removesuffix(b".").rstrip()
            dropped[first + len(whole)] = last
            edits += [
                (first, 1, order, b"_left("),
                (first + len(whole), 0, -order, b', "' + node.attr.encode() + b'")'),
            ]
        elif isinstance(node, ast.Call) and isinstance(node.func, ast.Name) and node.func.id == "find_parts":
            first, last = _span(node, starts)
            edits += [(first, 1, order, b"_noted("), (last, 0, -order, b")")]
    made, at = b"", 0
    for where, _, _, put in sorted(edits):
        made += text[at:where] + put
        at = max(where, dropped.get(where, 0) if put.startswith(b",") else where)
    return (made + text[at:]).decode()


def _span(node: ast.expr, starts: list[int]) -> tuple[int, int]:
    """Where the node begins and ends in the text, in bytes."""
    end_line, end_column = node.end_lineno or node.lineno, node.end_col_offset or node.col_offset
    return starts[node.lineno - 1] + node.col_offset, starts[end_line - 1] + end_column
