"""Errors of the semantic parser.

ParseError
├── EmptyQuestion   nothing was asked
└── NotUnderstood   the question is outside the grammar, or not English
"""

from __future__ import annotations


class ParseError(ValueError):
    """A question that no program was written for."""


class EmptyQuestion(ParseError):
    """The question is empty."""

    def __init__(self) -> None:
        super().__init__("The question is empty.")


class NotUnderstood(ParseError):
    """The question is not understood well enough to be answered.

    `message` is one sentence for the user, `unused_words` the words that no reading could be found for, `nearest` the
    nearest terms that would be understood.
    """

    def __init__(self, message: str, unused_words: tuple[str, ...] = (), nearest: tuple[str, ...] = ()) -> None:
        super().__init__(message)
        self.message = message
        self.unused_words = unused_words
        self.nearest = nearest
