"""Finds and measures the parts of a CAD model."""
