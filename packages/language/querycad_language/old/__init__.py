"""Writes the Python program that answers a question."""

from .errors import EmptyQuestion, NotUnderstood, ParseError
from .parser import parse, understand

__all__ = ["EmptyQuestion", "NotUnderstood", "ParseError", "parse", "understand"]
