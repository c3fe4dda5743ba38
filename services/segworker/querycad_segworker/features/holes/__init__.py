"""Bores with all that lies on their axis."""
