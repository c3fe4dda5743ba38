"""What callers may choose of a language model, and what they never may."""

from __future__ import annotations

from typing import Any

import pytest
from pydantic import ValidationError

from querycad_answering.llm.settings import Constrained, LlmApi, LlmOptionRefused, LlmSettings
from querycad_contracts import Codegen, LlmOptions

SET = LlmSettings(llm_base_url="http://127.0.0.1:1/v1", llm_model="small", llm_models="large, larger ")


@pytest.mark.parametrize("name", ["small", "large", "larger"])
def test_a_caller_chooses_among_the_models_that_are_allowed(name: str) -> None:
    assert SET.chosen(LlmOptions(model=name)).llm_model == name


@pytest.mark.parametrize("name", ["other", "", "large, larger"])
def test_another_model_is_refused_with_those_that_are_allowed(name: str) -> None:
    with pytest.raises(LlmOptionRefused, match="large, larger, small"):
        SET.chosen(LlmOptions(model=name))


def test_a_caller_cannot_name_an_address_or_a_key() -> None:
    for field in ("base_url", "llm_base_url", "api_key", "llm_api_key"):
        with pytest.raises(ValidationError):
            LlmOptions.model_validate({field: "http://stranger.example"})
    chosen = SET.chosen(LlmOptions(model="large", samples=3, repairs=0))
    assert chosen.llm_base_url == SET.llm_base_url
    assert (chosen.llm_samples, chosen.llm_repairs) == (3, 0)


def test_the_key_is_in_no_text_of_the_settings() -> None:
    settings = LlmSettings.read({"QUERYCAD_LLM_BASE_URL": "http://h/v1", "QUERYCAD_LLM_API_KEY": "sk-secret"})
    assert settings.llm_api_key.get_secret_value() == "sk-secret"
    assert "sk-secret" not in f"{settings!r} {settings} {settings.model_dump_json()}"


@pytest.mark.parametrize("url", ["ftp://h/v1", "h/v1", "http://", "https://user:password@h/v1", "file:///etc/passwd"])
def test_an_address_is_http_and_holds_no_password(url: str) -> None:
    with pytest.raises(ValidationError):
        LlmSettings(llm_base_url=url)


@pytest.mark.parametrize(
    ("url", "api"),
    [
        ("https://api.anthropic.com", LlmApi.ANTHROPIC),
        ("https://anthropic.com.stranger.example/v1", LlmApi.OPENAI),
        ("http://127.0.0.1:8080/v1", LlmApi.OPENAI),
    ],
)
def test_the_address_tells_how_a_server_is_spoken_to(url: str, api: LlmApi) -> None:
    assert LlmSettings(llm_base_url=url).api is api


def test_without_an_address_no_language_model_is_set_up() -> None:
    assert not LlmSettings.read({}).is_configured


@pytest.mark.parametrize(
    ("given", "writes", "held"),
    [
        ({}, Codegen.PARSER, Constrained.NONE),
        ({"llm_capable": True}, Codegen.PARSER, Constrained.NONE),
        ({"llm_base_url": "http://127.0.0.1:8089/v1"}, Codegen.BOTH, Constrained.NONE),
        ({"llm_base_url": "http://127.0.0.1:8089/v1", "llm_capable": True}, Codegen.AGENT, Constrained.TOOLS),
        ({"llm_base_url": "https://api.openai.com/v1"}, Codegen.AGENT, Constrained.TOOLS),
        ({"llm_base_url": "https://name.openai.azure.com/openai/v1"}, Codegen.AGENT, Constrained.TOOLS),
        ({"llm_base_url": "https://api.anthropic.com"}, Codegen.AGENT, Constrained.TOOLS),
        ({"llm_base_url": "https://api.anthropic.com", "llm_capable": False}, Codegen.BOTH, Constrained.NONE),
        ({"llm_base_url": "https://openai.com.stranger.example/v1"}, Codegen.BOTH, Constrained.NONE),
        ({"llm_base_url": "https://api.openai.com/v1", "codegen": "llm"}, Codegen.LLM, Constrained.TOOLS),
        ({"llm_base_url": "https://api.openai.com/v1", "llm_constrained": "none"}, Codegen.AGENT, Constrained.NONE),
        ({"llm_command": "cat"}, Codegen.BOTH, Constrained.NONE),
        ({"llm_command": "cat", "llm_capable": True}, Codegen.AGENT, Constrained.NONE),
    ],
)
def test_an_agent_writes_by_default_where_the_models_are_capable(
    given: dict[str, Any], writes: Codegen, held: Constrained
) -> None:
    settings = LlmSettings.model_validate(given)
    assert (settings.default_codegen, settings.constrained) == (writes, held)


def test_eyes_of_another_address_are_judged_by_their_own() -> None:
    eyes = LlmSettings(llm_base_url="http://127.0.0.1:1/v1", llm_capable=True, eyes_base_url="http://e/v1").eyes()
    assert eyes is not None
    assert not eyes.is_capable
