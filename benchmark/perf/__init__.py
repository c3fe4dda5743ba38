"""Measures how fast answers come, each figure against a baseline in the same run."""
