"""Untrusted files, before the kernel sees them: what kind they are, and what archives hold."""
