"""Measures how often answers are right, why they are wrong, and how fast they come."""
