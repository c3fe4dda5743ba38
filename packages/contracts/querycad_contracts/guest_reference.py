"""The guest API as text, for every reader of it: the type check, the prompt of a language model, the documentation.

`guest_api.pyi` is the one place where it is written down.
"""

from __future__ import annotations

import ast
import sys
from dataclasses import dataclass
from functools import cache
from importlib.resources import files


@dataclass(frozen=True, slots=True)
class GuestName:
    """One attribute, method, function or variable: how it is written, and its docstring."""

    name: str
    signature: str
    description: str

    @property
    def example(self) -> str:
        """The expression of the docstring's last line, of a function; empty where there is none."""
        _, found, example = self.description.rpartition("Example: ")
        return example if found else ""


@dataclass(frozen=True, slots=True)
class GuestClass:
    """One class of the guest API."""

    name: str
    description: str
    attributes: tuple[GuestName, ...]
    methods: tuple[GuestName, ...]


@dataclass(frozen=True, slots=True)
class GuestApi:
    """The whole guest API, in the order in which it is written."""

    description: str
    classes: tuple[GuestClass, ...]
    functions: tuple[GuestName, ...]
    variables: tuple[GuestName, ...]
    types: tuple[GuestName, ...]
    """Names that only stand for types, such as `Vector`."""


def guest_api_text() -> str:
    """What does `guest_api.pyi` say, word for word? What a type checker reads."""
    return files(__package__).joinpath("guest_api.pyi").read_text(encoding="utf-8")


@cache
def guest_api() -> GuestApi:
    """What is in the guest API?"""
    tree = ast.parse(guest_api_text())
    annotated = _attributes(tree.body)
    return GuestApi(
        description=ast.get_docstring(tree) or "",
        classes=tuple(_class(node) for node in tree.body if isinstance(node, ast.ClassDef)),
        functions=tuple(_function(node) for node in tree.body if isinstance(node, ast.FunctionDef)),
        variables=tuple(each for each in annotated if "TypeAlias" not in each.signature),
        types=tuple(each for each in annotated if "TypeAlias" in each.signature),
    )


def syntax_of(code: str) -> ast.Module | None:
    """The syntax tree of a program, whoever wrote it; None for what Python cannot read."""
    try:
        return ast.parse(code)
    except (SyntaxError, ValueError, RecursionError, MemoryError):
        return None


def guest_api_prompt() -> str:
    """The guest API as a language model is told of it: the stubs without what only a type checker needs."""
    lines = [line for line in guest_api_text().splitlines() if not line.startswith(("from typing import", "import "))]
    kept = [line for line in lines if line.strip() != "..."]
    return "\n".join(_without_double_blanks(kept)).replace(": TypeAlias =", " =").strip() + "\n"


def guest_api_markdown() -> str:
    """The guest API as a page of the documentation."""
    api = guest_api()
    lines = ["# The guest API", "", *_GENERATED, "", api.description, ""]
    lines += ["## Names", "", "| name | what it is |", "|---|---|"]
    lines += [_row(each) for each in (*api.variables, *api.functions, *api.types)]
    for kind in api.classes:
        lines += ["", f"## {kind.name}", "", kind.description, "", "| attribute | meaning |", "|---|---|"]
        lines += [_row(each) for each in kind.attributes]
        if kind.methods:
            lines += ["", "| method | meaning |", "|---|---|", *map(_row, kind.methods)]
    return "\n".join(lines) + "\n"


_GENERATED = (
    "All that a program which answers a question sees. Written by `python -m querycad_contracts.guest_reference` from",
    "[guest_api.pyi](../packages/contracts/querycad_contracts/guest_api.pyi), what programs are checked against.",
)


def _class(node: ast.ClassDef) -> GuestClass:
    methods = tuple(_function(each) for each in node.body if isinstance(each, ast.FunctionDef))
    return GuestClass(node.name, ast.get_docstring(node) or "", _attributes(node.body), methods)


def _attributes(body: list[ast.stmt]) -> tuple[GuestName, ...]:
    """The annotated names in `body`; a text right after one is its docstring."""
    found = []
    for number, node in enumerate(body):
        if not isinstance(node, ast.AnnAssign):
            continue
        after = body[number + 1] if number + 1 < len(body) else None
        told = after.value.value if isinstance(after, ast.Expr) and isinstance(after.value, ast.Constant) else ""
        found.append(GuestName(ast.unparse(node.target), ast.unparse(node), str(told)))
    return tuple(found)


def _function(node: ast.FunctionDef) -> GuestName:
    arguments = ast.unparse(node.args).removeprefix("self, ").removeprefix("self")
    returned = f" -> {ast.unparse(node.returns)}" if node.returns else ""
    return GuestName(node.name, f"{node.name}({arguments}){returned}", ast.get_docstring(node) or "")


def _row(each: GuestName) -> str:
    signature, told = (text.replace("|", r"\|") for text in (each.signature, " ".join(each.description.split())))
    return f"| `{signature}` | {told} |"


def _without_double_blanks(lines: list[str]) -> list[str]:
    return [line for number, line in enumerate(lines) if line.strip() or (number and lines[number - 1].strip())]


if __name__ == "__main__":
    sys.stdout.write(guest_api_markdown())
