"""Ports for servers that tests start."""

from __future__ import annotations

import contextlib
import random
import socket

PORTS = (20_000, 32_000)


def free_port() -> int:
    """A port that nobody listens on, below those that outgoing connections take until the server is up.

    Drawn by chance: test processes that start at once, and look for the first free one, take the same.
    """
    while True:
        with socket.socket() as probe, contextlib.suppress(OSError):
            probe.bind(("127.0.0.1", random.SystemRandom().randint(*PORTS)))
            return int(probe.getsockname()[1])
