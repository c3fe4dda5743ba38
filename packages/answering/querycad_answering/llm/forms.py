"""What a reply has to look like, for servers that hold a model to it: a grammar of programs, or a JSON schema.

A small model loses most programs to names that do not exist. The grammar lets nothing follow a dot but what the guest
API, lists, texts and `math` have, and every reply be one sentence and one code block. What offers no grammar gets a
JSON schema with the sentence and the program as texts, which become the same reply.
"""

from __future__ import annotations

import json
from dataclasses import dataclass
from functools import cache
from typing import Any

from .reference import attributes, functions
from .settings import Constrained, LlmApi, LlmSettings

PLAN_CHARS = 240
_METHODS = (
    *("append", "count", "extend", "get", "index", "insert", "items", "keys", "lower", "pop", "replace", "reverse"),
    *("sort", "split", "startswith", "endswith", "strip", "upper", "values"),
    *("acos", "asin", "atan", "atan2", "cos", "degrees", "dist", "hypot", "inf", "pi", "radians", "sin", "sqrt", "tan"),
)
"""Of lists, texts, dictionaries and `math`, what programs of a few lines use."""

_GRAMMAR = r"""root ::= plan "```python\n" line line{0,23} "```"
plan ::= [^`\n]{1,240} "\n"
line ::= indent (word | text)? rest* "\n"
indent ::= " "{0,12}
rest ::= mark (word | text)? | "." name
mark ::= [ ()\[\]{},:;=+*/<>%!&|^~-]
word ::= [a-zA-Z_] [a-zA-Z0-9_]{0,40} | [0-9]{1,9} ("." [0-9]{1,9})? ([eE] "-"? [0-9]{1,2})?
text ::= "f"? ( "\"" [^"\n]{0,120} "\"" | "'" [^'\n]{0,120} "'" )
name ::= NAMES
"""
"""A sentence of at most 240 characters and a program of at most 24 lines, without comments.

There is no way to say "unsure": a model of 1.5 billion parameters, given the choice, said it five times of six, and
before that wrote a comment for a program.
"""


@dataclass(frozen=True, slots=True)
class Form:
    """One form of replies."""

    name: str
    schema: str
    """JSON schema, as JSON."""
    about: str = ""
    """What a tool of this form is for, said to the model."""
    grammar: str = ""
    """In llama.cpp's notation (GBNF), which vLLM reads too; empty: the schema is all there is."""


def constraint(form: Form | None, by: Constrained) -> dict[str, Any]:
    """The fields of a request to chat completions that hold a reply to the form; none where that is not set up."""
    if form is None or by is Constrained.NONE:
        return {}
    schema = json.loads(form.schema)
    if by is Constrained.LLAMA_CPP:
        as_json = {"response_format": {"type": "json_object", "schema": schema}}
        return {"grammar": form.grammar} if form.grammar else as_json
    if by is Constrained.VLLM:
        return {"structured_outputs": {"grammar": form.grammar} if form.grammar else {"json": schema}}
    if by is Constrained.TOOLS:
        tool = {"name": form.name, "description": form.about, "parameters": schema}
        return {"tools": [{"type": "function", "function": tool}]}
    told = {"name": form.name, "schema": schema, "strict": True}
    return {"response_format": {"type": "json_schema", "json_schema": told}}


def anthropic_tools(form: Form | None, by: Constrained) -> dict[str, Any]:
    """The same for Anthropic's messages, which know tools alone."""
    if form is None or by is not Constrained.TOOLS:
        return {}
    return {"tools": [{"name": form.name, "description": form.about, "input_schema": json.loads(form.schema)}]}


def held_by(settings: LlmSettings) -> dict[str, Any]:
    """The fields of requests that hold a program's reply to its form, as these settings have them sent."""
    if settings.llm_command:
        return {}
    fields = anthropic_tools if settings.api is LlmApi.ANTHROPIC else constraint
    return fields(program_form(), settings.constrained)


def as_reply(text: str) -> str:
    """A reply held to the schema of programs, as other replies are: a sentence and a code block. Else as it is.

    Of several such objects, calls of the tool at once, the first counts: one program is run a step.
    """
    try:
        said, end = json.JSONDecoder().raw_decode(text.strip())
    except (ValueError, RecursionError):
        return text
    if text.strip()[end:].strip()[:1] not in ("", "{"):
        return text
    if not isinstance(said, dict) or not isinstance(said.get("program"), str):
        return text
    program = said["program"].strip()
    block = f"\n```python\n{program}\n```" if program else ""
    return f"{str(said.get('plan') or '').strip()}{block}".strip()


@cache
def program_form() -> Form:
    """Replies that hold one program."""
    names = sorted({name for known in attributes().values() for name in known} | set(_METHODS) | set(functions()))
    dotted = " | ".join(f'"{name}"' for name in sorted(names, key=lambda name: (-len(name), name)))
    grammar = _GRAMMAR.replace("NAMES", dotted)
    schema = {
        "type": "object",
        "properties": {
            "plan": {"type": "string", "maxLength": PLAN_CHARS},
            "program": {"type": "string", "description": "Python, lines parted by \\n"},
        },
        "required": ["plan", "program"],
        "additionalProperties": False,
    }
    about = "Runs a program of the guest API against the model: to look, or, where it assigns `solution`, to answer."
    return Form("program", json.dumps(schema), about, grammar)
