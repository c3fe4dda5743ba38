"""Arguments that say who writes programs, and what is expected of answers: of `ask`, `prompt` and `bench`."""

from __future__ import annotations

import argparse
from collections.abc import Sequence
from typing import TYPE_CHECKING

from querycad_contracts import (
    AnswerOptions,
    AnswerType,
    Codegen,
    Expectation,
    Frame,
    GroundedBy,
    LlmOptions,
    Selection,
    Unit,
)

if TYPE_CHECKING:
    from querycad_answering.llm import LlmSettings

_UNITS = {unit.value or "none": unit for unit in Unit}


def add_llm(parser: argparse.ArgumentParser) -> None:
    """Adds the arguments of a language model. Its key comes from QUERYCAD_LLM_API_KEY: the command line is public."""
    group = parser.add_argument_group("language model", "What is not given here is read from QUERYCAD_LLM_… variables.")
    group.add_argument("--llm-base-url", metavar="URL", help="its address, such as http://127.0.0.1:11434/v1")
    group.add_argument(
        "--llm-command",
        metavar="CMD",
        help="a command in its place: it reads the messages as JSON on its input and writes the reply",
    )
    group.add_argument("--llm-model", metavar="NAME", help="its name")
    group.add_argument("--llm-samples", type=int, metavar="N", help="programs asked for, whose answers are voted on")
    group.add_argument("--llm-repairs", type=int, metavar="N", help="times that a failing program is sent back")
    group.add_argument(
        "--llm-timeout", type=float, metavar="S", help="seconds for one question; then the parser answers"
    )
    group.add_argument("--llm-replies", metavar="DIR", help="keeps replies there, and takes them from there")


def add_codegen(parser: argparse.ArgumentParser) -> None:
    """Adds `--codegen`."""
    parser.add_argument(
        "--codegen",
        choices=[codegen.value for codegen in Codegen],
        help="who writes the program (default: agent with a capable language model, both with any other, else parser)",
    )


def add_expect(parser: argparse.ArgumentParser) -> None:
    """Adds what is expected of the answer."""
    parser.add_argument(
        "--expect",
        choices=[kind.value for kind in AnswerType],
        metavar="TYPE",
        help="type that the answer must have, such as length or points",
    )
    parser.add_argument("--expect-unit", choices=list(_UNITS), help="SI unit that its value must have")
    parser.add_argument(
        "--expect-frame", choices=[frame.value for frame in Frame], help="whose axes its numbers are along"
    )


def add_grounding(parser: argparse.ArgumentParser) -> None:
    """Adds `--grounding`."""
    parser.add_argument(
        "--grounding",
        choices=[grounding.value for grounding in GroundedBy],
        default=GroundedBy.GEOMETRY.value,
        help="by which evidence words are turned into parts (default: %(default)s)",
    )


def answer_options(options: argparse.Namespace) -> AnswerOptions:
    """What was chosen for the answer. Raises pydantic.ValidationError for numbers out of range."""
    asked = options.expect or options.expect_unit or options.expect_frame
    expect = Expectation(
        type=options.expect,
        unit=_UNITS[options.expect_unit] if options.expect_unit else None,
        frame=options.expect_frame,
    )
    model = options.llm_model if options.server else None  # in this process it is among the settings
    llm = LlmOptions(model=model, samples=options.llm_samples, repairs=options.llm_repairs)
    return AnswerOptions(
        codegen=options.codegen,
        expect=expect if asked else None,
        llm=llm,
        grounding=options.grounding,
        least_confidence=getattr(options, "least_confidence", None),
        selection=_selection(getattr(options, "select", [])),
        context=tuple(getattr(options, "context", [])),
    )


def _selection(said: Sequence[str]) -> Selection | None:
    """Numbers are faces; everything else is the id of a part."""
    if not said:
        return None
    faces = tuple(int(one) for one in said if one.isdecimal())
    return Selection(parts=tuple(one for one in said if not one.isdecimal()), faces=faces)


def not_of_a_service(options: argparse.Namespace) -> str | None:
    """Which argument was given that a service does not take from its callers?"""
    own = {
        "--llm-base-url": options.llm_base_url,
        "--llm-command": options.llm_command,
        "--llm-timeout": options.llm_timeout,
        "--llm-replies": options.llm_replies,
    }
    return next((name for name, value in own.items() if value is not None), None)


def llm_settings(options: argparse.Namespace) -> LlmSettings:
    """The language model's settings: those given, else the environment's. Raises pydantic.ValidationError."""
    from querycad_answering.llm import LlmSettings

    here = options.llm_base_url or options.llm_command  # what is given here is asked, and not what is set
    given = {
        "llm_base_url": options.llm_base_url or ("" if here else None),
        "llm_command": options.llm_command or ("" if here else None),
        "llm_model": options.llm_model,
        "llm_samples": options.llm_samples,
        "llm_repairs": options.llm_repairs,
        "llm_timeout_s": options.llm_timeout,
        "llm_replies": options.llm_replies,
    }
    settings = LlmSettings.read()
    return LlmSettings.model_validate(
        {**settings.model_dump(), **{name: value for name, value in given.items() if value is not None}}
    )
