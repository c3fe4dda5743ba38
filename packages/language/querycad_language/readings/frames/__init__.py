"""Frames: the shapes that questions have, each a function from the question to parses of readings."""
