"""QueryCAD on one machine: ask a CAD model a question in plain language and get a precise, grounded answer."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

if TYPE_CHECKING:
    from .client import AsyncClient, Client
    from .runtime import EmbeddedRuntime

__all__ = ["AsyncClient", "Client", "EmbeddedRuntime"]


def __getattr__(name: str) -> Any:
    """Each public name is loaded when it is asked for: the client needs no runtime, the runtime no HTTP."""
    if name in ("AsyncClient", "Client"):
        from . import client

        return getattr(client, name)
    if name == "EmbeddedRuntime":
        from .runtime import EmbeddedRuntime

        return EmbeddedRuntime
    raise AttributeError(f"module {__name__!r} has no attribute {name!r}")
