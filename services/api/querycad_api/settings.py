"""What can be set of the api and of its question workers, by environment variables."""

from __future__ import annotations

import ipaddress
from pathlib import Path

from pydantic import Field, SecretStr

from querycad_answering.llm import LlmSettings
from querycad_contracts.infrastructure import StorageSettings, WorkerSettings


class ApiSettings(WorkerSettings, StorageSettings, LlmSettings):
    """Of the web process and of the question workers."""

    api_host: str = Field("127.0.0.1", description="Address that the api listens on.")
    api_port: int = Field(8000, ge=1, le=65535, description="Port that the api listens on.")
    api_connections: int = Field(2000, ge=16, description="Connections at the same time; more are asked to retry.")
    api_address_connections: int = Field(256, ge=1, description="Of these, from one address; a proxy needs more.")
    upload_mib: int = Field(512, ge=1, description="Largest file accepted.")
    wait_s: int = Field(60, ge=0, le=600, description="Longest wait that a client's `Prefer: wait` is granted.")
    tenant_mib: int = Field(20480, ge=1, description="Files of a tenant and what is read of them, together.")
    tenant_answers: int = Field(20000, ge=1, description="Answers kept for a tenant; the oldest go first.")
    tenant_answers_mib: int = Field(
        1024, ge=1, description="Size of a tenant's answers, together; the oldest go first."
    )
    failed_days: int = Field(7, ge=1, description="How long a file that could not be read is kept.")
    answers_days: int = Field(30, ge=1, description="How long jobs and their answers are kept.")
    auth: bool | None = Field(
        None, description="Whether API keys are asked for. Unset: unless the api listens on loopback alone."
    )
    keys_file: Path | None = Field(None, description="File of API keys; unset: `keys.json` in `QUERYCAD_HOME`.")
    key_rate: str = Field(
        "1200/minute", pattern=r"^\d+/(second|minute|hour|day)$", description="Requests that an API key may make."
    )
    key_questions: int = Field(200, ge=1, description="Questions of an API key that may be open at the same time.")
    cors_origins: str = Field(
        "", description="Origins whose pages may call the api from a browser, with commas between them."
    )
    sandbox_url: str = Field("http://127.0.0.1:8101", description="Where the sandbox is.")
    sandbox_token: SecretStr = Field(SecretStr(""), description="What the sandbox asks for.")
    question_processes: int = Field(2, ge=1, le=64, description="Questions that a question worker answers at once.")
    question_s: int = Field(240, ge=10, description="Seconds after which a question is given up.")

    @property
    def on_loopback(self) -> bool:
        """Can only this machine reach the api?"""
        if self.api_host == "localhost":
            return True
        try:
            return ipaddress.ip_address(self.api_host).is_loopback
        except ValueError:
            return False

    @property
    def asks_for_keys(self) -> bool:
        """Does a request need an API key?"""
        return not self.on_loopback if self.auth is None else self.auth

    @property
    def keys(self) -> Path:
        """The file of API keys."""
        return self.keys_file or self.home / "keys.json"

    @property
    def origins(self) -> list[str]:
        """Origins whose pages may call the api."""
        return [each.strip() for each in self.cors_origins.split(",") if each.strip()]
