"""What is kept of a model once its file has been read, and where: one folder under the file's SHA-256."""

from __future__ import annotations

import hashlib
import shutil
import tempfile
from collections.abc import Sequence
from contextlib import suppress
from dataclasses import dataclass
from pathlib import Path

from pydantic import TypeAdapter

from querycad_contracts import AnswerRecord, Face, Frozen, Part, Refusal, Shape

from .errors import NoPlace

ARTEFACT_VERSION = 85
"""Raise it whenever recognition or the files below change: older artefacts are then made anew."""

_FACES = TypeAdapter(tuple[Face, ...])
_REFUSED = TypeAdapter(tuple[Refusal, ...])


class Model(Frozen):
    """A model as recognised: everything that a question without new measurements needs."""

    sha256: str
    file_name: str
    shape: Shape
    parts: tuple[Part, ...]
    units: tuple[str, ...] = ()
    """Names of the length units that the file declares; all values here are SI."""
    warnings: tuple[str, ...]
    timings_ms: dict[str, float]


@dataclass(frozen=True, slots=True)
class Artefacts:
    """The files of one model."""

    folder: Path

    @property
    def model(self) -> Path:
        """`Model` as JSON."""
        return self.folder / "model.json"

    @property
    def faces(self) -> Path:
        """All faces as a JSON list, in order of their ids."""
        return self.folder / "faces.json"

    @property
    def refused(self) -> Path:
        """What recognition refused, with reasons, as a JSON list."""
        return self.folder / "refused.json"

    @property
    def mesh(self) -> Path:
        """`mesh.Mesh` as arrays."""
        return self.folder / "mesh.npz"

    @property
    def face_pairs(self) -> Path:
        """Which faces meet: (E, 2) int32 ids as an array, each pair once."""
        return self.folder / "face_pairs.npy"

    def sight(self, name: str) -> Path:
        """A sheet that shows how a phrase was seen; there once vision has looked for it."""
        return self.folder / "sight" / name

    @property
    def kernel_faces(self) -> Path:
        """The faces in the kernel's binary format, for measurements that need exact surfaces; not there of a mesh."""
        return self.folder / "faces.bin"

    def size_bytes(self) -> int:
        """What is kept of the model, older versions included?"""
        total = 0
        with suppress(FileNotFoundError):  # it is being deleted
            for path in self.folder.parent.rglob("*"):
                total += path.stat().st_size if path.is_file() else 0
        return total

    def load_model(self) -> Model:
        """What was recognised?"""
        return Model.model_validate_json(self.model.read_bytes())

    def load_faces(self) -> tuple[Face, ...]:
        """Which faces does the model have?"""
        return _FACES.validate_json(self.faces.read_bytes())

    def load_refused(self) -> tuple[Refusal, ...]:
        """What looked like a part, and why is it none?"""
        return _REFUSED.validate_json(self.refused.read_bytes())

    def save(self, model: Model, faces: Sequence[Face], refused: Sequence[Refusal] = ()) -> None:
        """Keeps what was recognised."""
        self.refused.write_bytes(_REFUSED.dump_json(tuple(refused)))
        self.faces.write_bytes(_FACES.dump_json(tuple(faces), exclude_defaults=True))
        self.model.write_text(model.model_dump_json(exclude_defaults=True), encoding="utf-8")


class ModelStore:
    """Artefacts by the file's SHA-256, in a folder of this machine. Safe for several processes at once."""

    def __init__(self, root: Path) -> None:
        self.root = root

    def find(self, sha256: str) -> Artefacts | None:
        """Which artefacts are kept for this file? None when there are none of this version."""
        artefacts = Artefacts(self.folder(sha256))
        return artefacts if artefacts.model.exists() else None

    def scratch(self) -> Path:
        """A new empty folder on the same file system, for what `keep` will put in place. Raises NoPlace."""
        try:
            self.root.mkdir(parents=True, exist_ok=True)
            return Path(tempfile.mkdtemp(prefix="ingest-", dir=self.root))
        except OSError as error:
            raise NoPlace(
                f"what is read of it cannot be kept in {self.root} ({error.strerror}); "
                "set QUERYCAD_HOME to a folder that can be written"
            ) from error

    def keep(self, sha256: str, scratch: Path) -> Artefacts:
        """Puts a finished scratch folder in place, all at once; where another process was faster, its result stays."""
        target = self.folder(sha256)
        target.parent.mkdir(parents=True, exist_ok=True)
        try:
            scratch.rename(target)
        except OSError:
            shutil.rmtree(scratch, ignore_errors=True)
        return Artefacts(target)

    def folder(self, sha256: str) -> Path:
        """Where are this file's artefacts, or would be? In the folder of this version."""
        return self.root / sha256[:2] / sha256 / f"v{ARTEFACT_VERSION}"


def file_sha256(path: Path) -> str:
    """What identifies the file's content? Hexadecimal SHA-256."""
    with path.open("rb") as stream:
        return hashlib.file_digest(stream, "sha256").hexdigest()


def sheet_name(phrase: str) -> str:
    """What is the file with the pictures of a phrase called?"""
    return f"{hashlib.sha256(phrase.encode()).hexdigest()[:32]}.png"


def sheets_of(record: AnswerRecord) -> tuple[str, ...]:
    """Which sheets show what vision saw of this answer? Names of files, each once."""
    names = (part.evidence.picture for part in record.parts)
    return tuple(dict.fromkeys(Path(name).name for name in names if name is not None))
