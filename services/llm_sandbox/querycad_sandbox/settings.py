"""What can be set of the sandbox's service, by environment variables."""

from __future__ import annotations

from typing import Final

from pydantic import Field, SecretStr

from querycad_contracts.infrastructure import BrokerSettings, WallSettings

LOOPBACK: Final = ("localhost", "127.0.0.1", "::1")
"""What a sandbox is called by who is on its machine; a page that rebinds a name of its own calls it by that."""


class SandboxSettings(BrokerSettings, WallSettings):
    """Of one sandbox service."""

    sandbox_host: str = Field("127.0.0.1", description="Address that the sandbox listens on.")
    sandbox_port: int = Field(8101, ge=1, le=65535, description="Port that the sandbox listens on.")
    sandbox_token: SecretStr = Field(
        SecretStr(""),
        description="Token that callers must send; needed if other machines can reach this.",
    )
    sandbox_runs: int = Field(
        32, ge=1, le=256, description="Programs under way at the same time, those that wait for the segworker included."
    )
    sandbox_processes: int = Field(2, ge=1, le=64, description="Interpreters: programs that compute at the same time.")
    call_s: float = Field(20.0, gt=0, description="Seconds that the sandbox waits for a segworker, then asks again.")
    measure_s: float = Field(
        100.0, gt=0, description="The same for a distance, which may need the CAD kernel, and for looking at pictures."
    )
