"""QueryCAD on one machine: ask a CAD model a question in plain language and get a precise, grounded answer."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

from .runtime import EmbeddedRuntime

if TYPE_CHECKING:
    from .client import Client

__all__ = ["Client", "EmbeddedRuntime"]


def __getattr__(name: str) -> Any:
    """The client is loaded when it is asked for: who answers in this process needs no HTTP."""
    if name == "Client":
        from .client import Client

        return Client
    raise AttributeError(f"module {__name__!r} has no attribute {name!r}")
