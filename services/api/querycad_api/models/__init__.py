"""Uploaded models: their files, what is known of them, their parts."""
