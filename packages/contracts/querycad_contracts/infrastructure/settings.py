"""How are settings read? From environment variables: the field `redis_url` is QUERYCAD_REDIS_URL."""

from __future__ import annotations

import os
from collections.abc import Mapping, Sequence
from enum import StrEnum
from pathlib import Path
from typing import Self

from pydantic import Field

from querycad_contracts import Frozen

from .logs import LogFormat

PREFIX = "QUERYCAD_"


def upload_name(model: str) -> str:
    """Under which name is the uploaded file with this SHA-256 in the store?"""
    return f"files/{model[:2]}/{model}"


def models_name(model: str) -> str:
    """Under which name is all that was made of the file with this SHA-256, in whatever version?"""
    return f"models/{model[:2]}/{model}"


def picture_name(job: str) -> str:
    """Under which name is the picture of an answer?"""
    return f"pictures/{job}.png"


def compressed_name(name: str) -> str:
    """Under which name is a file that is sent compressed by gzip, where it was compressed once for all?"""
    return f"{name}.gz"


def default_home() -> Path:
    """Where is everything kept when nothing is said? `querycad` in the user's cache folder (XDG base directories)."""
    cache = os.environ.get("XDG_CACHE_HOME")
    return (Path(cache) if cache else Path.home() / ".cache") / "querycad"


class Settings(Frozen):
    """Base of a service's settings."""

    @classmethod
    def read(cls, environ: Mapping[str, str] | None = None) -> Self:
        """What does the environment say? Raises pydantic.ValidationError, with the setting's name, for a bad value."""
        given = os.environ if environ is None else environ
        values = {name: given[cls.variable(name)] for name in cls.model_fields if given.get(cls.variable(name))}
        return cls.model_validate(values)

    @staticmethod
    def variable(field: str) -> str:
        """Which environment variable holds the field?"""
        return PREFIX + field.upper()


class Walls(StrEnum):
    """What holds where a wall around the interpreter, or around the CAD kernel, cannot be raised."""

    REQUIRED = "required"
    """No program is run, no file is read."""
    AVAILABLE = "available"
    """It is done behind those that there are; health, log and answers name the others."""


class WallSettings(Settings):
    """Of everything that runs programs or the CAD kernel."""

    walls: Walls = Field(
        Walls.REQUIRED,
        description="`required`: nothing is run and no file read unless all walls are up; `available`: degraded.",
    )


class WallsMissing(RuntimeError):
    """Nothing is done: walls around what would do it are not up, and nobody said that it may do without."""

    def __init__(self, undone: str, around: str, missing: Sequence[str]) -> None:
        """`undone`: what is not done, as a sentence's start, such as 'no program is run'."""
        variable = WallSettings.variable("walls")
        super().__init__(
            f"{undone}: these walls around {around} are not up: {', '.join(missing)}; "
            f"{variable}={Walls.AVAILABLE} does without them"
        )


class BrokerSettings(Settings):
    """What every service of the distributed runtime knows."""

    log_format: LogFormat = Field(LogFormat.TEXT, description="`text` for people, or `json`: one object a line.")
    traces: bool = Field(
        False, description="Whether OpenTelemetry traces are sent, where its own variables say; needs an extra."
    )

    redis_url: str = Field(
        "redis://127.0.0.1:6379/0", description="Redis-protocol server: queues, state of models and jobs, answers."
    )


class WorkerSettings(BrokerSettings):
    """Of processes that take tasks from a queue."""

    sole_worker: bool = Field(
        False,
        description="Whether no other worker has these queues: what a predecessor left undone is then begun at once.",
    )


class StorageSettings(Settings):
    """Of services that see the shared folder."""

    home: Path = Field(
        default_factory=default_home,
        description="Folder for uploaded files, artefacts and pictures, shared by api and segworker.",
    )

    files_url: str = Field(
        "",
        pattern=r"^(s3://[^/]+(/.*)?)?$",
        description="S3-compatible store, `s3://bucket/prefix`, for what is shared; `home` is then a cache.",
    )

    @property
    def models(self) -> Path:
        """The folder of artefacts, as in `querycad_segworker.model.ModelStore`."""
        return self.home / "models"

    @property
    def weights(self) -> Path:
        """The folder of the vision path's weights, one inside it for each network."""
        return self.home / "weights"

    def upload(self, model: str) -> Path:
        """Where is the uploaded file with this SHA-256?"""
        return self.home / upload_name(model)
