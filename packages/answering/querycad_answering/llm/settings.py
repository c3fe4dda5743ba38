"""Which language model writes programs? From the environment; without an address none does."""

from __future__ import annotations

import shlex
from enum import StrEnum
from pathlib import Path
from urllib.parse import urlsplit

from pydantic import Field, SecretStr, field_validator

from querycad_contracts import Codegen, LlmOptions
from querycad_contracts.infrastructure import Settings


class LlmApi(StrEnum):
    """How is the language model spoken to?"""

    OPENAI = "openai"
    ANTHROPIC = "anthropic"


class Constrained(StrEnum):
    """How is a language model held to the form of its replies?"""

    NONE = "none"
    LLAMA_CPP = "llama.cpp"
    """`grammar`, as llama.cpp's servers read it."""
    VLLM = "vllm"
    """`structured_outputs`."""
    JSON_SCHEMA = "json_schema"
    """`response_format`, as OpenAI, Ollama and others read it."""
    TOOLS = "tools"
    """Programs come as calls of a tool, by the endpoint's own protocol; Anthropic's, too."""


HOSTED = ("anthropic.com", "openai.com", "azure.com")
"""Whose endpoints take native tool calls and read at least 32,000 tokens with every model that they offer (ADR 28)."""


class PromptExamples(StrEnum):
    """Which worked examples are shown with a question?"""

    NONE = "0"
    SAME = "3"
    """The same three with every question, from all over the collection."""
    NEAREST = "nearest"
    """The three most like the question."""


class LlmOptionRefused(ValueError):
    """A caller chose what the service does not allow; `str()` is the sentence for the user."""


class LlmSettings(Settings):
    """Of whatever writes programs: the question workers, or the embedded runtime."""

    codegen: Codegen | None = Field(
        None, description="Who writes programs where a question does not say: `parser`, `llm`, `both` or `agent`."
    )
    llm_base_url: str = Field(
        "", description="Address of the language model, such as `http://127.0.0.1:11434/v1`; empty: none is asked."
    )
    llm_command: str = Field(
        "", description="A command in place of an address: it reads the messages on its input and writes the reply."
    )
    llm_api: LlmApi | None = Field(
        None, description="`openai` (chat completions) or `anthropic` (messages); told by the address where not set."
    )
    llm_api_key: SecretStr = Field(SecretStr(""), description="Its key; sent to that address and nowhere else.")
    llm_capable: bool | None = Field(
        None,
        description="Whether its models call tools and read long conversations: then `agent` writes where nothing else "
        "is said. Not set: at Anthropic's, OpenAI's and Azure's addresses, and nowhere else.",
    )
    llm_model: str = Field("", description="Its name; may stay empty for servers that have only one.")
    llm_models: str = Field("", description="Other names that a question may ask for, parted by commas.")
    llm_timeout_s: float = Field(
        120.0, gt=0, description="Seconds for all that a language model does for one question; then the parser answers."
    )
    llm_failures: int = Field(
        3,
        ge=1,
        le=100,
        description="Questions in a row without any reply after which the language model is left alone.",
    )
    llm_pause_s: float = Field(30.0, gt=0, description="For how long; the parser answers meanwhile.")
    llm_retries: int = Field(3, ge=0, le=10, description="Times that a request is repeated when the server is busy.")
    llm_repairs: int = Field(2, ge=0, le=5, description="Times that a program that fails is sent back for repair.")
    llm_samples: int = Field(1, ge=1, le=9, description="Programs asked for, whose answers are voted on.")
    llm_temperature: float = Field(0.7, ge=0, le=2, description="Of the samples after the first, which is at 0.")
    llm_tokens: int = Field(700, ge=50, le=16000, description="Longest reply, in tokens.")
    llm_steps: int = Field(6, ge=1, le=30, description="With `agent`: replies to one question, looks included.")
    llm_budget: int = Field(60_000, ge=1000, description="With `agent`: tokens for one question, read and written.")
    llm_examples: PromptExamples = Field(
        PromptExamples.NEAREST,
        description="Worked examples shown with a question: `nearest`, the three most like it; `3`, always the same "
        "three; `0`, none.",
    )
    llm_constrained: Constrained | None = Field(
        None,
        description="How the server holds replies to their form: `llama.cpp`, `vllm`, `json_schema`, `tools`, or "
        "`none`. Not set: `tools` where its models are capable.",
    )
    llm_parallel: int = Field(4, ge=1, le=256, description="Requests under way at once to one address, by one process.")
    llm_per_minute: int = Field(0, ge=0, description="Requests to one address in any minute, by one process; 0: any.")
    llm_images: bool = Field(
        False, description="Whether it takes images: then the agent is shown pictures, and it is the eyes."
    )
    eyes_base_url: str = Field("", description="Address of another model that takes images, which is the eyes.")
    eyes_command: str = Field("", description="A command in its place.")
    eyes_api: LlmApi | None = Field(None, description="As `llm_api`, of the eyes.")
    eyes_api_key: SecretStr = Field(SecretStr(""), description="Key of the eyes' address.")
    eyes_model: str = Field("", description="Name of the eyes' model.")
    eyes_phrases: int = Field(4, ge=1, le=50, description="Phrases that are looked for, for one question.")
    eyes_pictures: int = Field(12, ge=1, le=16, description="Pictures that are looked at for one phrase.")
    llm_replies: Path | None = Field(
        None, description="Folder that keeps replies; the same request is then answered from it, without being sent."
    )

    @field_validator("llm_command", "eyes_command")
    @classmethod
    def _is_command(cls, command: str) -> str:
        try:
            words = shlex.split(command)
        except ValueError as error:
            raise ValueError(f"is no command: {error}") from error
        if command and not words:
            raise ValueError("is no command: it is blank")
        return command

    @field_validator("llm_base_url", "eyes_base_url")
    @classmethod
    def _is_http(cls, url: str) -> str:
        parts = urlsplit(url)
        if url and (parts.scheme not in ("http", "https") or not parts.hostname):
            raise ValueError("must begin with http:// or https://")
        if parts.username or parts.password:
            raise ValueError("must hold no password: the key has a setting of its own")
        return url

    @property
    def is_configured(self) -> bool:
        """Is there a language model to ask?"""
        return bool(self.llm_base_url or self.llm_command)

    @property
    def only_programs(self) -> bool:
        """Is a program in every reply, whatever the language model would say?"""
        return not self.llm_command and self.constrained in (Constrained.LLAMA_CPP, Constrained.VLLM)

    @property
    def is_capable(self) -> bool:
        """May it look before it answers, where nobody says who writes: as set, else as the address tells?"""
        if self.llm_capable is not None:
            return self.llm_capable and self.is_configured
        return not self.llm_command and self._is_at(*HOSTED)

    @property
    def has_last_word(self) -> bool:
        """Does an agent's own answer stand against a parser that is sure? A command's unless it is said to be none."""
        return self.is_capable or (bool(self.llm_command) and self.llm_capable is None)

    @property
    def constrained(self) -> Constrained:
        """How are replies held to their form: as set, else by tool calls where an endpoint is capable of them?"""
        calls = self.is_capable and not self.llm_command
        return self.llm_constrained or (Constrained.TOOLS if calls else Constrained.NONE)

    @property
    def default_codegen(self) -> Codegen:
        """Who writes where a question does not say: as set, else by what there is?"""
        if self.codegen is not None or not self.is_configured:
            return self.codegen or Codegen.PARSER
        return Codegen.AGENT if self.is_capable else Codegen.BOTH

    def eyes(self) -> LlmSettings | None:
        """The settings of who is shown pictures: of another model where one is set up, else these. None without any.

        The key of one address never goes to another.
        """
        if self.eyes_base_url or self.eyes_command:
            other = {
                "llm_base_url": self.eyes_base_url,
                "llm_command": self.eyes_command,
                "llm_api": self.eyes_api,
                "llm_api_key": self.eyes_api_key,
                "llm_model": self.eyes_model,
                "llm_capable": None,
                "llm_images": True,
            }
            return self.model_copy(update=other)
        if not self.llm_images or not self.is_configured:
            return None
        return self.model_copy(update={"llm_model": self.eyes_model}) if self.eyes_model else self

    @property
    def api(self) -> LlmApi:
        """How is it spoken to: as set, else as its address tells?"""
        return self.llm_api or (LlmApi.ANTHROPIC if self._is_at("anthropic.com") else LlmApi.OPENAI)

    def _is_at(self, *domains: str) -> bool:
        host = urlsplit(self.llm_base_url).hostname or ""
        return any(host == domain or host.endswith(f".{domain}") for domain in domains)

    def chosen(self, options: LlmOptions | None) -> LlmSettings:
        """These settings with what a caller chose. Raises LlmOptionRefused for a model that is not allowed.

        A caller cannot choose the address: the key would go to whom he names.
        """
        if options is None:
            return self
        allowed = {self.llm_model, *(name.strip() for name in self.llm_models.split(","))} - {""}
        if options.model is not None and options.model not in allowed:
            listed = ", ".join(sorted(allowed)) or "only the one that is set up"
            raise LlmOptionRefused(f"the language model {options.model!r} is not allowed here; allowed: {listed}")
        given = {"llm_model": options.model, "llm_samples": options.samples, "llm_repairs": options.repairs}
        return self.model_copy(update={name: value for name, value in given.items() if value is not None})
