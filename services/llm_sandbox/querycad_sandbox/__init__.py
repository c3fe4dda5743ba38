"""Runs generated programs against the guest API, with nothing else within reach."""

from .sandbox import Sandbox

__all__ = ["Sandbox"]
