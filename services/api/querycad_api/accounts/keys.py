"""The file of API keys: who may ask, and as which tenant.

A key is `qc_<id>_<secret>`. The file holds the SHA-256 of the secret alone: 256 random bits cannot be guessed, so that
a slow hash, which passwords need, would add nothing. The file is read again whenever it has changed, so that keys can
be made and revoked while the service runs, and before it is first started.
"""

from __future__ import annotations

import fcntl
import hashlib
import hmac
import os
import re
import secrets
import tempfile
from collections.abc import Iterator
from contextlib import contextmanager
from datetime import UTC, datetime
from pathlib import Path

from pydantic import TypeAdapter, ValidationError

from querycad_contracts import Frozen, Tenant

from .schemas import ApiKey, Scope

SECRET_BYTES = 32
_KEY = re.compile(r"qc_([0-9a-f]{12})_([A-Za-z0-9_-]{43})")
_TENANT: TypeAdapter[str] = TypeAdapter(Tenant)


class _KeyFile(Frozen):
    keys: tuple[ApiKey, ...] = ()


class KeyRing:
    """The keys of one file. Raises OSError when it cannot be read or written, ValueError when it holds other things."""

    def __init__(self, path: Path) -> None:
        self._path = path
        self._stamp: tuple[int, int, int] | None = None
        self._keys: dict[str, ApiKey] = {}

    def find(self, presented: str) -> ApiKey | None:
        """Whose key is this? None when it is nobody's, or nobody's any more."""
        parts = _KEY.fullmatch(presented)
        if parts is None:
            return None
        key = self._read().get(parts[1])
        if key is None or not hmac.compare_digest(key.secret_sha256, _sha256(parts[2])):
            return None
        return key

    def all(self) -> tuple[ApiKey, ...]:
        """All keys, the oldest first."""
        return tuple(self._read().values())

    def create(self, tenant: str, name: str = "", scope: Scope = Scope.ASK) -> str:
        """Makes a key; it is told this once and cannot be found out again."""
        key_id, secret = secrets.token_hex(6), secrets.token_urlsafe(SECRET_BYTES)
        key = ApiKey(
            id=key_id,
            tenant=_TENANT.validate_python(tenant),
            scope=scope,
            name=name,
            secret_sha256=_sha256(secret),
            created=datetime.now(UTC),
        )
        with self._changing() as keys:
            keys[key_id] = key
        return f"qc_{key_id}_{secret}"

    def revoke(self, key_id: str) -> bool:
        """Makes a key worthless at once; False when there is none of this id."""
        with self._changing() as keys:
            return keys.pop(key_id, None) is not None

    def _read(self) -> dict[str, ApiKey]:
        try:
            status = self._path.stat()
        except FileNotFoundError:
            return {}
        stamp = (status.st_ino, status.st_mtime_ns, status.st_size)
        if stamp != self._stamp:
            try:
                found = _KeyFile.model_validate_json(self._path.read_bytes())
            except ValidationError as error:
                raise ValueError(f"{self._path}: no file of API keys") from error
            self._keys, self._stamp = {key.id: key for key in found.keys}, stamp
        return self._keys

    @contextmanager
    def _changing(self) -> Iterator[dict[str, ApiKey]]:
        """The keys, to be changed; written all at once, one process at a time."""
        self._path.parent.mkdir(parents=True, exist_ok=True)
        with self._path.with_suffix(".lock").open("w") as lock:
            fcntl.flock(lock, fcntl.LOCK_EX)
            keys = dict(self._read())
            yield keys
            data = _KeyFile(keys=tuple(keys.values())).model_dump_json(indent=1)
            handle, name = tempfile.mkstemp(prefix="keys-", dir=self._path.parent)  # for this user's eyes only
            with os.fdopen(handle, "w", encoding="utf-8") as file:
                file.write(data + "\n")
                file.flush()
                os.fsync(file.fileno())
            Path(name).replace(self._path)


def _sha256(secret: str) -> str:
    return hashlib.sha256(secret.encode()).hexdigest()
