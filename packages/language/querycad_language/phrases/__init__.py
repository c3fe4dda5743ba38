"""Noun phrases as typed queries: one reader for questions, free text for grounding, and phrases of language models."""

from .mention import Mention, bare_of, placed_in, places_of, replace_fields, without
from .reader import Phrases, noun_phrase
from .sizes import stated_size
from .words import noun_follows

__all__ = [
    "Mention", "Phrases", "bare_of", "noun_follows", "noun_phrase", "placed_in",
    "places_of", "replace_fields", "stated_size", "without",
]  # fmt: skip
