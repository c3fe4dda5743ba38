"""Readings of a question: what it can mean, each with the words that it used and those that it passed over.

Nothing is decided here. Every measure that is named may be asked of every part that is named, or of the whole model;
the features say how the words link them, and what was skipped. Which reading is meant is ranked on the model.
"""

from .parses import Features, Reading
from .reader import Reader, read

__all__ = ["Features", "Reader", "Reading", "read"]
