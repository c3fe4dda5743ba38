"""The guest API exists once: the type check, the prompt's reference and the documentation come from guest_api.pyi."""

from __future__ import annotations

import ast
from pathlib import Path

from querycad_contracts.guest_reference import guest_api, guest_api_markdown, guest_api_prompt, guest_api_text

DOCUMENT = Path(__file__).parents[2] / "docs/guest-api.md"


def names(tree: ast.AST) -> set[str]:
    """All that a text of stubs defines: `Part`, `Part.radius`, `find_parts` …"""
    found = set()
    for node in ast.iter_child_nodes(tree):
        if isinstance(node, ast.ClassDef):
            found |= {node.name} | {f"{node.name}.{inner}" for inner in names(node)}
        elif isinstance(node, ast.FunctionDef):
            found.add(node.name)
        elif isinstance(node, ast.AnnAssign):
            found.add(ast.unparse(node.target))
    return found


def test_the_page_is_what_the_stubs_say() -> None:
    assert DOCUMENT.read_text(encoding="utf-8") == guest_api_markdown(), (
        "run: .venv/bin/python -m querycad_contracts.guest_reference > docs/guest-api.md"
    )


def test_every_name_of_the_stubs_is_in_the_reference() -> None:
    api = guest_api()
    told = {each.name for each in (*api.functions, *api.variables, *api.types)} | {kind.name for kind in api.classes}
    told |= {f"{kind.name}.{each.name}" for kind in api.classes for each in (*kind.attributes, *kind.methods)}
    assert told == names(ast.parse(guest_api_text()))
    assert {"Part.radius", "Part.distance_to", "find_parts", "shape"} <= told


def test_the_prompt_s_text_says_all_that_the_stubs_say() -> None:
    stubs, prompt = ast.parse(guest_api_text()), ast.parse(guest_api_prompt())
    types = {each.name for each in guest_api().types}
    assigned = {ast.unparse(node.targets[0]) for node in prompt.body if isinstance(node, ast.Assign)}
    assert names(prompt) | assigned == names(stubs)
    assert assigned == types
    assert told(stubs) == told(prompt)


def told(tree: ast.AST) -> set[str]:
    """Every docstring, those of attributes included."""
    texts = (node.value for node in ast.walk(tree) if isinstance(node, ast.Expr))
    return {ast.unparse(text) for text in texts if isinstance(text, ast.Constant) and isinstance(text.value, str)}


def test_a_method_is_written_as_it_is_called() -> None:
    (part,) = (kind for kind in guest_api().classes if kind.name == "Part")
    signatures = {method.name: method.signature for method in part.methods}
    assert signatures["distance_to"] == "distance_to(other: 'Part') -> float"
    assert signatures["edge_distance"] == "edge_distance() -> float"
