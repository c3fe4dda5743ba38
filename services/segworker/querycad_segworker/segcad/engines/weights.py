"""Which networks' weights are there, are they what they should be, and what do they load as?

One folder a model under QUERYCAD_HOME/weights. A folder with `model.onnx` and `vocab.txt` is a detector, one with
`encoder.onnx` and `decoder.onnx` a segmenter, whether `weights.toml` knows its name or not: an export of one's own is
used by laying it there, and goes before those that are known.
"""

from __future__ import annotations

import hashlib
import os
import tomllib
from collections.abc import Iterator
from enum import StrEnum
from functools import cache
from importlib.resources import files
from pathlib import Path

from pydantic import Field

from querycad_contracts import Frozen
from querycad_segworker.segcad.ports import VisionModels, WeightsAbsent

from .grounding_dino import DetectorOptions, GroundingDino
from .sam import Sam
from .sessions import Graph, UnknownLayout
from .tokenizer import Tokenizer

HUB = "https://huggingface.co"
RECORD = "SHA256SUMS"
"""File in each model's folder with the sums of what was pulled: for `sha256sum -c`, and where the list knows none."""


class Role(StrEnum):
    """What a model is for."""

    DETECTOR = "detector"
    SEGMENTER = "segmenter"

    @property
    def files(self) -> tuple[str, str]:
        """The files by which a folder is one."""
        return ("model.onnx", "vocab.txt") if self is Role.DETECTOR else ("encoder.onnx", "decoder.onnx")


class WeightFile(Frozen):
    """A file of a model."""

    name: str
    """In the model's folder. What a graph refers to keeps its own name."""
    path: str
    """In the repository."""
    size_mb: float
    """About, in 10^6 bytes."""
    sha256: str | None = Field(None, pattern="^[0-9a-f]{64}$")


class Model(Frozen):
    """A model of the list."""

    name: str
    role: Role
    licence: str
    repository: str
    revision: str
    note: str
    files: tuple[WeightFile, ...]

    @property
    def size_mb(self) -> float:
        """How much is there to pull, in 10^6 bytes?"""
        return sum(file.size_mb for file in self.files)

    def url(self, file: WeightFile, hub: str = HUB) -> str:
        """Where is the file, at this hub or at one with the same paths?"""
        return f"{hub.rstrip('/')}/{self.repository}/resolve/{self.revision}/{file.path}"


class _Manifest(Frozen):
    models: tuple[Model, ...]


class Check(StrEnum):
    """What is known of a file on this machine."""

    GOOD = "good"
    AS_PULLED = "as first pulled"
    UNKNOWN = "nothing to compare with"
    WRONG = "checksum mismatch"
    ABSENT = "absent"


@cache
def known_models() -> tuple[Model, ...]:
    """The models of the list, those to be preferred first."""
    text = files(__package__).joinpath("weights.toml").read_text(encoding="utf-8")
    return _Manifest.model_validate(tomllib.loads(text)).models


def default_models() -> tuple[Model, ...]:
    """What is needed: the first detector and the first segmenter of the list."""
    return tuple(next(model for model in known_models() if model.role is role) for role in Role)


def sha256_of(path: Path) -> str:
    """The SHA-256 of a file's content, in hexadecimal."""
    with path.open("rb") as content:
        return hashlib.file_digest(content, "sha256").hexdigest()


def recorded_sums(folder: Path) -> dict[str, str]:
    """The sums that were recorded when the folder's files were pulled, by file name."""
    record = folder / RECORD
    lines = record.read_text(encoding="utf-8").splitlines() if record.is_file() else []
    return {name: digest for digest, _, name in (line.partition("  ") for line in lines)}


def record_sum(folder: Path, name: str, digest: str) -> None:
    """Keeps the sum of a file that was pulled."""
    sums = recorded_sums(folder) | {name: digest}
    part = folder / f"{RECORD}.part"
    part.write_text("".join(f"{sums[name]}  {name}\n" for name in sorted(sums)), encoding="utf-8")
    part.replace(folder / RECORD)


def check(folder: Path, file: WeightFile) -> Check:
    """Is the file in the model's folder what it should be? Reads it whole."""
    path = folder / file.name
    if not path.is_file():
        return Check.ABSENT
    expected = file.sha256 or recorded_sums(folder).get(file.name)
    if expected is None:
        return Check.UNKNOWN
    if sha256_of(path) != expected:
        return Check.WRONG
    return Check.GOOD if file.sha256 else Check.AS_PULLED


def is_complete(folder: Path, model: Model) -> bool:
    """Are all files of the model there? Looks at no content."""
    return all((folder / file.name).is_file() for file in model.files)


def present(weights: Path, role: Role) -> Iterator[Path]:
    """The folders with a complete model of this role, the one to be used first."""
    known = {model.name: model for model in known_models()}
    own = sorted(folder for folder in weights.glob("*") if folder.name not in known)
    yield from (folder for folder in own if all((folder / name).is_file() for name in role.files))
    for model in known.values():
        if model.role is role and is_complete(weights / model.name, model):
            yield weights / model.name


def absence(weights: Path) -> str | None:
    """Which weights are missing, and how does one get them? None when the vision path can look."""
    roles = [role for role in Role if next(present(weights, role), None) is None]
    if not roles:
        return None
    missing = " and ".join(f"of a {role}" for role in roles)
    size = sum(model.size_mb for model in default_models() if model.role in roles)
    return f"no weights {missing} in {weights}: `querycad models pull` gets them (about {size:.0f} MB)"


def load_models(weights: Path, box_threshold: float = DetectorOptions().threshold) -> VisionModels:
    """The detector and the segmenter to be used, loaded once a process.

    weights: QUERYCAD_HOME/weights. Raises WeightsAbsent, for spoilt weights and unknown layouts too.
    """
    missing = absence(weights)
    if missing:
        raise WeightsAbsent(missing)
    # A session made before a fork has no threads after it, and hangs when it runs or is deleted: the process is part of
    # what sessions are kept by, and none is ever let go.
    process = os.getpid()
    try:
        graph, tokenizer = _detector(process, next(present(weights, Role.DETECTOR)))
        detector = GroundingDino(graph, tokenizer, DetectorOptions(threshold=box_threshold))
        return VisionModels(detector, Sam(*_segmenter(process, next(present(weights, Role.SEGMENTER)))))
    except UnknownLayout as error:
        raise WeightsAbsent(f"the weights cannot be used: {error}; `querycad models verify` checks them") from error


@cache
def _detector(process: int, folder: Path) -> tuple[Graph, Tokenizer]:
    del process
    return Graph(folder / "model.onnx"), Tokenizer(folder / "vocab.txt")


@cache
def _segmenter(process: int, folder: Path) -> tuple[Graph, Graph]:
    del process
    return Graph(folder / "encoder.onnx"), Graph(folder / "decoder.onnx")
