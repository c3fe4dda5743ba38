"""The guest API as a prompt tells it, made from its one source, `querycad_contracts/guest_api.pyi`."""

from __future__ import annotations

import ast
import re
from functools import cache

from querycad_contracts.guest_reference import guest_api_text

BY_SIGHT = ("look", "picture")
"""Functions that need somebody who takes images."""


@cache
def guest_api() -> ast.Module:
    """The guest API's source, parsed, without the queries that the parser writes: words are shorter."""
    tree = ast.parse(guest_api_text().replace("str | PartQuery", "str"))
    tree.body = [node for node in tree.body if not (isinstance(node, ast.ClassDef) and _is_query(node))]
    return tree


def _is_query(node: ast.ClassDef) -> bool:
    return any(isinstance(base, ast.Name) and base.id == "TypedDict" for base in node.bases)


@cache
def attributes() -> dict[str, tuple[str, ...]]:
    """Which attributes and methods does each class of the guest API have?"""
    classes = (node for node in guest_api().body if isinstance(node, ast.ClassDef))
    return {node.name: tuple(name for statement in node.body if (name := _name(statement))) for node in classes}


@cache
def functions() -> tuple[str, ...]:
    """Which names does a program find defined?"""
    return tuple(name for node in guest_api().body if (name := _name(node)) and name[0].islower())


@cache
def reference(tools: tuple[str, ...] = ()) -> str:
    """All classes, attributes and functions with their docstrings, as short as they can be said.

    `tools`: which functions of `BY_SIGHT` there is somebody for.
    """
    lines: list[str] = []
    body = [node for node in guest_api().body if _name(node) not in BY_SIGHT or _name(node) in tools]
    for node, follower in zip(body, [*body[1:], None], strict=True):
        match node:
            case ast.ClassDef():
                lines += [f"class {node.name}{_bases(node)}:{_comment(ast.get_docstring(node))}", *_members(node.body)]
            case ast.FunctionDef():
                lines.append(_signature(node) + _comment(ast.get_docstring(node)))
            case ast.AnnAssign(value=ast.expr() as meant):
                lines.append(f"{_name(node)} = {ast.unparse(meant)}")
            case ast.AnnAssign():
                lines.append(f"{_name(node)}: {ast.unparse(node.annotation)}{_comment(_doc(follower))}")
    return "\n".join(lines)


def _bases(node: ast.ClassDef) -> str:
    return f"({', '.join(map(ast.unparse, node.bases))})" if node.bases else ""


def _members(body: list[ast.stmt]) -> list[str]:
    """A class's attributes and methods; attributes of one type that need no words share a line."""
    lines: list[str] = []
    shared: list[str] = []
    shared_type = ""

    def close() -> None:
        if shared:
            lines.append(f"  {', '.join(shared)}: {shared_type}")
            shared.clear()

    for node, follower in zip(body, [*body[1:], None], strict=True):
        if isinstance(node, ast.FunctionDef):
            close()
            lines.append(f"  {_signature(node)}{_comment(ast.get_docstring(node))}")
        elif isinstance(node, ast.AnnAssign):
            kind, doc = ast.unparse(node.annotation).replace("'Part'", "Part").replace("'Face'", "Face"), _doc(follower)
            if doc or kind != shared_type:
                close()
            shared_type = kind
            shared.append(str(_name(node)))
            if doc:
                lines.append(f"  {shared.pop()}: {kind}{_comment(doc)}")
    close()
    return lines


def _signature(node: ast.FunctionDef) -> str:
    arguments = [argument for argument in node.args.args if argument.arg != "self"]
    defaults = [None] * (len(arguments) - len(node.args.defaults)) + list(node.args.defaults)
    listed = [
        f"{argument.arg}: {ast.unparse(argument.annotation)}" + (f" = {ast.unparse(default)}" if default else "")
        for argument, default in zip(arguments, defaults, strict=True)
        if argument.annotation is not None
    ]
    returns = ast.unparse(node.returns) if node.returns is not None else "None"
    return f"{node.name}({', '.join(listed)}) -> {returns}".replace("'", "").replace(" | None = None", " = None")


def _name(node: ast.stmt) -> str | None:
    if isinstance(node, ast.FunctionDef):
        return node.name
    return node.target.id if isinstance(node, ast.AnnAssign) and isinstance(node.target, ast.Name) else None


def _doc(node: ast.stmt | None) -> str | None:
    """The string below an attribute."""
    text = node.value if isinstance(node, ast.Expr) else None
    return text.value if isinstance(text, ast.Constant) and isinstance(text.value, str) else None


def _comment(doc: str | None) -> str:
    """What comes first of a docstring: its first sentence. The rest is for people."""
    first = re.split(r"(?<=[.?!])\s", " ".join((doc or "").split()), maxsplit=1)[0].removesuffix(".")
    return f"  # {first}" if first else ""
