"""Ask a CAD model a question in plain language and get a precise, grounded answer.

    import querycad

    print(querycad.open("part.step").ask("How deep are the counterbores?"))

`open` reads a file on this machine, in this process; `Client("http://…").open` has a service read it. Both give a
`Model` with the same methods. Values are SI: metres, square and cubic metres, radians, in the frame of the file.
"""

from __future__ import annotations

import importlib
from typing import TYPE_CHECKING, Any, Final

if TYPE_CHECKING:
    from pathlib import Path

    from querycad_segworker.errors import FileProblem

    from .client import AsyncClient, Client, ClientError, ServerProblem, ServerUnreachable
    from .measuring import NoValue
    from .model import Model, Parts, Picture, Reply, UnitName
    from .runtime import EmbeddedRuntime
    from .served import AsyncModel

    __version__: str

__all__ = [
    "AsyncClient",
    "AsyncModel",
    "Client",
    "ClientError",
    "EmbeddedRuntime",
    "FileProblem",
    "Model",
    "NoValue",
    "Parts",
    "Picture",
    "Reply",
    "ServerProblem",
    "ServerUnreachable",
    "__version__",
    "open",
]

_MODULES: Final = {
    **dict.fromkeys(("AsyncClient", "Client"), ".client"),
    **dict.fromkeys(("ClientError", "ServerProblem", "ServerUnreachable"), ".client"),
    **dict.fromkeys(("Model", "Parts", "Picture", "Reply"), ".model"),
    "AsyncModel": ".served",
    "EmbeddedRuntime": ".runtime",
    "NoValue": ".measuring",
    "FileProblem": "querycad_segworker.errors",
}


def open(file: Path | str, *, unit: UnitName = "mm") -> Model:  # noqa: A001 - as in `PIL.Image.open`
    """The model in a CAD file on this machine. `unit`: of lengths in texts; values are SI.

    A file is read once, in one to ten seconds; what was read is kept, so that it opens in milliseconds the next time.
    Raises FileProblem, with one sentence that says what is wrong with the file.
    """
    from .runtime import this_machine

    return this_machine().open(file, unit)


def __getattr__(name: str) -> Any:
    """Each public name is loaded when it is asked for: the client needs no runtime, the runtime no HTTP."""
    if name == "__version__":
        from importlib.metadata import version

        return version("querycad")
    if name in _MODULES:
        return getattr(importlib.import_module(_MODULES[name], __package__), name)
    raise AttributeError(f"module {__name__!r} has no attribute {name!r}")


def __dir__() -> list[str]:
    return sorted({*globals(), *__all__})
