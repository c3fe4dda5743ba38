"""Grounding: from a description in words to the parts of one model."""
