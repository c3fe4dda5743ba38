"""Measures how often answers are right, and why they are wrong."""
