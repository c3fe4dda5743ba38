"""Writes programs with a language model: see docs/llm.md."""

from .messages import LlmError
from .settings import LlmOptionRefused, LlmSettings, PromptExamples
from .task import Candidate, Parsed, Task, Written
from .writer import LlmWriter

__all__ = [
    "Candidate",
    "LlmError",
    "LlmOptionRefused",
    "LlmSettings",
    "LlmWriter",
    "Parsed",
    "PromptExamples",
    "Task",
    "Written",
]
