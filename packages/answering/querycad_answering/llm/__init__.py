"""Writes programs with a language model: see docs/llm.md."""

from .messages import LlmError
from .settings import LlmOptionRefused, LlmSettings, PromptExamples
from .writer import Candidate, LlmWriter, Task, Written

__all__ = ["Candidate", "LlmError", "LlmOptionRefused", "LlmSettings", "LlmWriter", "PromptExamples", "Task", "Written"]
