"""What can be set of a segworker, by environment variables."""

from __future__ import annotations

from pydantic import Field

from querycad_contracts.infrastructure import StorageSettings, WallSettings, WorkerSettings


class SegworkerSettings(WorkerSettings, StorageSettings, WallSettings):
    """Of one segworker process and its children."""

    segworker_queues: str = Field(
        "ingest,segcad,pictures", description="Queues that a segworker takes tasks from, with commas between them."
    )
    segworker_processes: int = Field(1, ge=1, le=64, description="Tasks that a segworker does at the same time.")
    segworker_memory_mib: int = Field(
        1024, ge=128, description="Resident memory after which a segworker's process is replaced, between two tasks."
    )
    segworker_models: int = Field(64, ge=1, description="Recognised models that each process keeps in memory.")
    ingest_memory_mib: int = Field(4096, ge=1024, description="Address space of the process that reads a file.")
    ingest_s: int = Field(180, ge=1, description="Seconds that reading one file may take.")
