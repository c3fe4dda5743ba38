"""The guest API as text, for every reader of it: the type check, the prompt of a language model, the documentation.

`guest_api.pyi` is the one place where it is written down.
"""

from __future__ import annotations

import ast
import sys
from collections.abc import Iterator
from dataclasses import dataclass
from functools import cache
from importlib.resources import files

from .geometry import PartKind


@dataclass(frozen=True, slots=True)
class GuestName:
    """One attribute, method, function, variable or name of a type: how it is written, and its docstring."""

    name: str
    type: str
    """What it holds, gives, or stands for."""
    description: str
    arguments: str | None = None
    """Of a function or method, as they are written between brackets; None of anything else."""
    is_alias: bool = False
    """Whether it only stands for a type, as `Vector` does."""

    @property
    def signature(self) -> str:
        """The name as the stubs have it, with its type."""
        if self.arguments is not None:
            return f"{self.name}({self.arguments}) -> {self.type}"
        return f"{self.name}: TypeAlias = {self.type}" if self.is_alias else f"{self.name}: {self.type}"

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
    members: tuple[GuestName, ...]
    base: str
    """What it is made of, such as `list[Part]`; empty where that is nothing."""

    @property
    def attributes(self) -> tuple[GuestName, ...]:
        """What is read of it."""
        return tuple(each for each in self.members if each.arguments is None)

    @property
    def methods(self) -> tuple[GuestName, ...]:
        """What is called of it."""
        return tuple(each for each in self.members if each.arguments is not None)

    @property
    def is_query(self) -> bool:
        """Is it the shape of a dictionary that programs of the parser pass to find_parts?"""
        return self.base == "TypedDict"


@dataclass(frozen=True, slots=True)
class GuestApi:
    """The whole guest API, in the order in which it is written."""

    description: str
    names: tuple[GuestName | GuestClass, ...]

    @property
    def classes(self) -> tuple[GuestClass, ...]:
        """Which classes has it?"""
        return tuple(each for each in self.names if isinstance(each, GuestClass))

    @property
    def _single(self) -> tuple[GuestName, ...]:
        return tuple(each for each in self.names if isinstance(each, GuestName))

    @property
    def functions(self) -> tuple[GuestName, ...]:
        """Which functions has it?"""
        return tuple(each for each in self._single if each.arguments is not None)

    @property
    def variables(self) -> tuple[GuestName, ...]:
        """Which values does a program find?"""
        return tuple(each for each in self._single if each.arguments is None and not each.is_alias)

    @property
    def types(self) -> tuple[GuestName, ...]:
        """Which names only stand for types, such as `Vector`?"""
        return tuple(each for each in self._single if each.is_alias)


def guest_api_text() -> str:
    """What does `guest_api.pyi` say, word for word? What a type checker reads."""
    return files(__package__).joinpath("guest_api.pyi").read_text(encoding="utf-8")


@cache
def guest_api() -> GuestApi:
    """What is in the guest API?"""
    tree = ast.parse(guest_api_text())
    return GuestApi(ast.get_docstring(tree) or "", tuple(_names(tree.body)))


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
    stubs = "\n".join(_without_double_blanks(kept)).replace(": TypeAlias =", " =").strip()
    return f"{stubs}\n\n# {_KINDS} {', '.join(PartKind)}.\n"


def guest_api_markdown() -> str:
    """The guest API as a page of the documentation."""
    api = guest_api()
    lines = ["# The guest API", "", *_GENERATED, "", api.description, ""]
    lines += ["## Names", "", "| name | what it is |", "|---|---|"]
    lines += [_row(each) for each in (*api.variables, *api.functions, *api.types)]
    lines += ["", f"{_KINDS} {', '.join(f'`{kind}`' for kind in PartKind)}."]
    for kind in api.classes:
        lines += ["", f"## {kind.name}", "", kind.description, "", "| attribute | meaning |", "|---|---|"]
        lines += [_row(each) for each in kind.attributes]
        if kind.methods:
            lines += ["", "| method | meaning |", "|---|---|", *map(_row, kind.methods)]
    return "\n".join(lines) + "\n"


_KINDS = "Kinds of parts, which measures.md defines; a model has some of them:"
_GENERATED = (
    "All that a program which answers a question sees. Written by `python -m querycad_contracts.guest_reference` from",
    "[guest_api.pyi](../packages/contracts/querycad_contracts/guest_api.pyi), what programs are checked against.",
)


def _names(body: list[ast.stmt]) -> Iterator[GuestName | GuestClass]:
    """What is written in `body`; a text right after an annotated name is its docstring."""
    for node, after in zip(body, [*body[1:], None], strict=True):
        match node:
            case ast.ClassDef():
                members = tuple(each for each in _names(node.body) if isinstance(each, GuestName))
                base = ", ".join(ast.unparse(each) for each in node.bases)
                yield GuestClass(node.name, ast.get_docstring(node) or "", members, base)
            case ast.FunctionDef(returns=ast.expr() as returned):
                yield GuestName(node.name, ast.unparse(returned), ast.get_docstring(node) or "", _arguments(node.args))
            case ast.AnnAssign(annotation=kind, value=value):
                told = after.value if isinstance(after, ast.Expr) else None
                text = str(told.value) if isinstance(told, ast.Constant) else ""
                name, of = ast.unparse(node.target), ast.unparse(value or kind)
                yield GuestName(name, of, text, is_alias=value is not None)


def _arguments(all_of: ast.arguments) -> str:
    """The arguments but `self`."""
    given = [each for each in all_of.args if each.arg != "self"]
    defaults = [*[None] * (len(given) - len(all_of.defaults)), *all_of.defaults]
    written = [
        ast.unparse(each) + (f" = {ast.unparse(value)}" if value else "")
        for each, value in zip(given, defaults, strict=True)
    ]
    return ", ".join(written)


def _row(each: GuestName) -> str:
    signature, told = (text.replace("|", r"\|") for text in (each.signature, " ".join(each.description.split())))
    return f"| `{signature}` | {told} |"


def _without_double_blanks(lines: list[str]) -> list[str]:
    return [line for number, line in enumerate(lines) if line.strip() or (number and lines[number - 1].strip())]


if __name__ == "__main__":
    sys.stdout.write(guest_api_markdown())
