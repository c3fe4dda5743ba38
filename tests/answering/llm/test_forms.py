"""Replies held to a form: what each kind of server is sent, and what comes of its JSON."""

from __future__ import annotations

import json
import re
from collections.abc import Callable
from typing import Any

import pytest
from tests.answering.llm.conftest import Script, said, status, stream

from querycad_answering.llm.client import HttpChatModel
from querycad_answering.llm.forms import Form, as_reply, constraint, program_form
from querycad_answering.llm.messages import Message, Role, TimeLimit
from querycad_answering.llm.prompt import examples
from querycad_answering.llm.reference import attributes, functions
from querycad_answering.llm.settings import Constrained, LlmSettings

MARKS = Form("marks", '{"type": "object"}')
ASKED = (Message(Role.USER, "How many?"),)


@pytest.mark.parametrize(
    ("by", "programs", "marks"),
    [
        (Constrained.NONE, set(), set()),
        (Constrained.LLAMA_CPP, {"grammar"}, {"response_format"}),
        (Constrained.VLLM, {"structured_outputs"}, {"structured_outputs"}),
        (Constrained.JSON_SCHEMA, {"response_format"}, {"response_format"}),
        (Constrained.TOOLS, {"tools"}, {"tools"}),
    ],
)
def test_each_kind_of_server_is_sent_what_it_reads(by: Constrained, programs: set[str], marks: set[str]) -> None:
    assert constraint(program_form(), by).keys() == programs
    assert constraint(MARKS, by).keys() == marks
    assert constraint(None, by) == {}


def names_after_a_dot(code: str) -> set[str]:
    bare = re.sub(r"\"[^\"\n]*\"|'[^'\n]*'", "", code)
    return set(re.findall(r"\.([a-z_][a-z_0-9]*)", bare))


def test_the_grammar_names_all_that_the_guest_api_and_the_worked_examples_have_after_a_dot() -> None:
    listed = set(re.findall(r'"(\w+)"', program_form().grammar.partition("name ::=")[2]))
    assert {name for names in attributes().values() for name in names} | set(functions()) <= listed
    used = {name for example in examples() for name in names_after_a_dot(example.code)}
    assert used
    assert used <= listed
    assert "hole_count" not in listed


def test_the_grammar_has_no_comments() -> None:
    """A small model wrote one in a program's place."""
    mark = next(line for line in program_form().grammar.splitlines() if line.startswith("mark ::="))
    assert "#" not in mark


def test_a_reply_in_json_becomes_a_sentence_and_a_code_block_and_any_other_stays() -> None:
    held = json.dumps({"plan": "All holes.", "program": "solution = 1"})
    assert as_reply(held) == "All holes.\n```python\nsolution = 1\n```"
    assert as_reply(json.dumps({"plan": "unsure", "program": ""})) == "unsure"
    for other in ("unsure", '{"marks": []}', "[1]", "```python\nsolution = {}\n```"):
        assert as_reply(other) == other


def test_a_server_that_refuses_the_form_is_asked_without_it(scripted: Callable[[Script], str]) -> None:
    refused: dict[str, Any] = {"error": {"message": "not supported", "param": "grammar"}}
    script = Script([status(400, refused), said("three")])
    settings = LlmSettings(llm_base_url=scripted(script), llm_constrained=Constrained.LLAMA_CPP)
    assert HttpChatModel(settings, form=program_form()).reply(ASKED, 0.0, 1, TimeLimit(10)).text == "three"
    assert ["grammar" in body for body in script.bodies] == [True, False]


@pytest.mark.parametrize(
    ("code", "error"),
    [
        (400, {"message": "registry/model:latest does not support tools"}),
        (400, {"message": '"auto" tool choice requires --enable-auto-tool-choice to be set', "param": None}),
        (500, {"message": "tools param requires --jinja flag"}),
        (422, {"message": "Extra inputs are not permitted: tools"}),
    ],
)
def test_a_server_without_tool_calls_is_asked_for_fenced_code(
    scripted: Callable[[Script], str], code: int, error: dict[str, Any]
) -> None:
    script = Script([status(code, {"error": error}), said("```python\nsolution = 1\n```")])
    settings = LlmSettings(llm_base_url=scripted(script), llm_capable=True, llm_retries=0)
    reply = HttpChatModel(settings, form=program_form()).reply(ASKED, 0.0, 1, TimeLimit(10))
    assert "solution = 1" in reply.text
    assert ["tools" in body for body in script.bodies] == [True, False]


def test_of_several_calls_at_once_the_first_is_the_program() -> None:
    first, second = (json.dumps({"plan": "Look.", "program": code}) for code in ("print(1)", "solution = 2"))
    assert as_reply(first + second) == "Look.\n```python\nprint(1)\n```"
    assert as_reply(f"{first} and more") == f"{first} and more"


PROGRAM = json.dumps({"plan": "All holes.", "program": "solution = 1"})
CALLED = "I count.\nAll holes.\n```python\nsolution = 1\n```"


def called(kind: str) -> list[dict[str, Any]]:
    """A reply that calls the tool, its arguments in two pieces, as each kind of server streams it."""
    halves = (PROGRAM[:20], PROGRAM[20:])
    if kind == "anthropic":
        said_first = {"type": "content_block_delta", "delta": {"type": "text_delta", "text": "I count."}}
        pieces = [
            {"type": "content_block_delta", "delta": {"type": "input_json_delta", "partial_json": h}} for h in halves
        ]
        return [said_first, *pieces, {"type": "message_delta", "delta": {"stop_reason": "tool_use"}}]
    calls = [
        {"choices": [{"delta": {"tool_calls": [{"index": 0, "function": {"arguments": half}}]}}]} for half in halves
    ]
    return [{"choices": [{"delta": {"content": "I count."}}]}, *calls, {"choices": [{"finish_reason": "tool_calls"}]}]


@pytest.mark.parametrize("kind", ["openai", "anthropic"])
def test_a_native_tool_call_is_the_program_of_the_reply(scripted: Callable[[Script], str], kind: str) -> None:
    script = Script([stream(*(f"data: {json.dumps(event)}\n\n" for event in called(kind)), "data: [DONE]\n\n")])
    settings = LlmSettings.model_validate(
        {"llm_base_url": scripted(script), "llm_api": kind, "llm_constrained": "tools"}
    )
    assert HttpChatModel(settings, form=program_form()).reply(ASKED, 0.0, 1, TimeLimit(10)).text == CALLED
    (tool,) = script.bodies[0]["tools"]
    schema = tool["input_schema"] if kind == "anthropic" else tool["function"]["parameters"]
    assert set(schema["required"]) == {"plan", "program"}
