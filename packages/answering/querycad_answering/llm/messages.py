"""What goes to a language model and comes back, whichever it is.

LlmError
├── LlmBusy      it cannot answer now: overloaded, unreachable, cut off; trying again may help
├── LlmRefused   it will not: wrong key, unknown model, request not accepted
└── LlmTooSlow   the time for the question is up
"""

from __future__ import annotations

import time
from collections.abc import Callable
from dataclasses import dataclass
from enum import StrEnum
from typing import Protocol

from querycad_contracts import TokenUse


class LlmError(Exception):
    """No reply came; `str()` is a sentence for the user, without the key."""


class LlmBusy(LlmError):
    """The server cannot answer now. `retry_after_s` is how long it asks to be left alone, where it says so."""

    def __init__(self, message: str, retry_after_s: float | None = None) -> None:
        super().__init__(message)
        self.retry_after_s = retry_after_s


class LlmRefused(LlmError):
    """The server will not answer this request. `parameter` is the field that it does not accept, where it says so."""

    def __init__(self, message: str, parameter: str | None = None) -> None:
        super().__init__(message)
        self.parameter = parameter


class LlmTooSlow(LlmError):
    """The time is up."""


NO_TOKENS = TokenUse()


class Role(StrEnum):
    """Who speaks?"""

    SYSTEM = "system"
    USER = "user"
    ASSISTANT = "assistant"


@dataclass(frozen=True, slots=True)
class Message:
    """One turn of a conversation."""

    role: Role
    text: str
    images: tuple[bytes, ...] = ()
    """PNG files that go with it; for models that take images."""
    fixed: int = 0
    """Characters at its beginning that are the same for all models and questions: a server may keep them read."""


@dataclass(frozen=True, slots=True)
class Reply:
    """What a language model said. `cut` says that it was stopped at the longest length.

    Halves of characters, which JSON can carry and no record can, are question marks.
    """

    text: str
    cut: bool = False
    tokens: TokenUse = NO_TOKENS

    def __post_init__(self) -> None:
        """Replaces what is no character."""
        object.__setattr__(self, "text", self.text.encode("utf-8", "replace").decode("utf-8"))


class TimeLimit:
    """A moment after which the time is up."""

    def __init__(self, seconds: float, clock: Callable[[], float] = time.monotonic) -> None:
        self._clock = clock
        self._end = clock() + seconds

    def left_s(self) -> float:
        """How many seconds are left? Raises LlmTooSlow when none is."""
        left = self._end - self._clock()
        if left <= 0:
            raise LlmTooSlow("the language model did not answer in time")
        return left


class ChatModel(Protocol):
    """A language model that takes a conversation and says what comes next."""

    def reply(self, conversation: tuple[Message, ...], temperature: float, sample: int, deadline: TimeLimit) -> Reply:
        """What does it say? Samples with different numbers are drawn independently. Raises LlmError."""
        ...
