"""What can be set of the api and of its question workers, by environment variables."""

from __future__ import annotations

from pydantic import Field

from querycad_contracts import StorageSettings, WorkerSettings


class ApiSettings(WorkerSettings, StorageSettings):
    """Of the web process and of the question workers."""

    api_host: str = Field("127.0.0.1", description="Address that the api listens on.")
    api_port: int = Field(8000, ge=1, le=65535, description="Port that the api listens on.")
    upload_mib: int = Field(512, ge=1, description="Largest file accepted.")
    wait_s: int = Field(60, ge=0, le=600, description="Longest wait that a client's `Prefer: wait` is granted.")
    answers_days: int = Field(30, ge=1, description="How long jobs and their answers are kept.")
    sandbox_url: str = Field("http://127.0.0.1:8101", description="Where the sandbox is.")
    question_processes: int = Field(2, ge=1, le=64, description="Questions that a question worker answers at once.")
    question_s: int = Field(240, ge=10, description="Seconds after which a question is given up.")
