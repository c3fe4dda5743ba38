"""Noun phrases: 'the two 5 mm holes in the flange that are visible from the top' as a typed query for parts.

One reader for all: questions, the grounding's free text, and the phrases that language models write.
"""

from .mention import Mention, bare_of, placed_in, places_of, replace_fields
from .reader import Phrases, noun_phrase
from .sizes import stated_size
from .words import noun_follows

__all__ = [
    "Mention",
    "Phrases",
    "bare_of",
    "noun_follows",
    "noun_phrase",
    "placed_in",
    "places_of",
    "replace_fields",
    "stated_size",
]
