"""`querycad mcp`: models as tools of an agent, over standard input and output or over HTTP."""

from __future__ import annotations

import argparse
import sys
from pathlib import Path

from .outcomes import EXIT_DONE, complain

LOOPBACK = "127.0.0.1"
"""There are no keys: nobody but this machine may ask."""


def mcp(options: argparse.Namespace) -> int:
    """Serves until standard input ends, or Ctrl-C; returns the exit code."""
    folder = Path(options.folder) if options.folder else Path.cwd() if options.http is not None else None
    if folder is not None and not folder.is_dir():
        return complain(f"{folder}: no such folder")
    import anyio

    from querycad.mcp_server import over_stdio, server
    from querycad.runtime import EmbeddedRuntime

    with EmbeddedRuntime() as runtime:
        made = server(runtime, folder)
        if options.http is None:
            anyio.run(over_stdio, made)
        else:
            print(f"querycad: MCP at http://{LOOPBACK}:{options.http}/mcp, files in {folder}", file=sys.stderr)
            made.run("streamable-http", host=LOOPBACK, port=options.http)
    return EXIT_DONE
