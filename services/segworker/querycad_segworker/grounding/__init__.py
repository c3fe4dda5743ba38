"""Grounding: from a description in words, and from what is seen of it, to the parts of one model."""
