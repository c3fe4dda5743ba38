"""From English to programs."""
