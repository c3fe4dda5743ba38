"""The sandbox as a service: `python -m querycad_sandbox.service`. What it answers is in `app.py`."""

from __future__ import annotations

import socket
import sys

from querycad_contracts.infrastructure import start_logging

from .settings import LOOPBACK, SandboxSettings
from .walls.enclosure import clean_environment, enclose


def main() -> None:
    """Serves until told to stop; SIGTERM lets running programs end."""
    settings = SandboxSettings.read()
    clean_environment(settings)
    start_logging("sandbox", settings.log_format)
    if settings.sandbox_host not in LOOPBACK and not settings.sandbox_token.get_secret_value():
        sys.exit("querycad_sandbox: QUERYCAD_SANDBOX_TOKEN is needed where others than this machine can ask for runs")

    import uvicorn  # what takes long to load comes after what starts this process anew

    from .app import make_app

    with socket.create_server((settings.sandbox_host, settings.sandbox_port)) as listener:
        layers = enclose(settings)  # no port is opened after this
        config = uvicorn.Config(
            make_app(settings, service_layers=layers), log_config=None, access_log=False, timeout_graceful_shutdown=10
        )
        uvicorn.Server(config).run(sockets=[listener])


if __name__ == "__main__":
    main()
