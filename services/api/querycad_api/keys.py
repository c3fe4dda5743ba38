"""API keys: who may ask, and as which tenant. `python -m querycad_api.keys create | list | revoke`

A key is `qc_<id>_<secret>`. The file holds the SHA-256 of the secret alone: 256 random bits cannot be guessed, so that
a slow hash, which passwords need, would add nothing. The file is read again whenever it has changed, so that keys can
be made and revoked while the service runs, and before it is first started.
"""

from __future__ import annotations

import argparse
import fcntl
import hashlib
import hmac
import os
import re
import secrets
import sys
import tempfile
from collections.abc import Iterator, Sequence
from contextlib import contextmanager
from datetime import UTC, datetime
from enum import StrEnum
from pathlib import Path

from pydantic import TypeAdapter, ValidationError

from querycad_contracts import Frozen, Tenant

from .settings import ApiSettings

SECRET_BYTES = 32
_KEY = re.compile(r"qc_([0-9a-f]{12})_([A-Za-z0-9_-]{43})")
_TENANT: TypeAdapter[str] = TypeAdapter(Tenant)

EXIT_DONE, EXIT_BAD_INPUT = 0, 2


class Scope(StrEnum):
    """What a key is for: asking about its tenant's models, or reading the whole service's metrics."""

    ASK = "ask"
    METRICS = "metrics"


class ApiKey(Frozen):
    """What is kept of a key."""

    id: str
    tenant: Tenant
    scope: Scope = Scope.ASK
    name: str = ""
    secret_sha256: str
    created: datetime


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


def add_arguments(parser: argparse.ArgumentParser) -> None:
    """Adds what the command understands."""
    commands = parser.add_subparsers(dest="keys", required=True, metavar="COMMAND")
    create = commands.add_parser("create", help="make a key and print it, this once")
    create.add_argument("--tenant", required=True, help="whose models it opens: lower-case letters, digits, hyphens")
    create.add_argument("--name", default="", help="what it is for, to tell it from others")
    create.add_argument(
        "--scope", choices=[each.value for each in Scope], default=Scope.ASK.value, help="default: %(default)s"
    )
    commands.add_parser("list", help="print all keys, without their secrets")
    revoke = commands.add_parser("revoke", help="make a key worthless at once")
    revoke.add_argument("id", help="the 12 characters after qc_, as `list` prints them")


def run(options: argparse.Namespace, settings: ApiSettings | None = None) -> int:
    """Does what the command line says; returns the exit code."""
    ring = KeyRing((settings or ApiSettings.read()).keys)
    try:
        return _run(options, ring)
    except ValidationError:
        return _complain(f"{options.tenant!r} is no name of a tenant: lower-case letters, digits and hyphens, up to 40")
    except (OSError, ValueError) as error:
        return _complain(str(error))


def _run(options: argparse.Namespace, ring: KeyRing) -> int:
    if options.keys == "create":
        print(ring.create(options.tenant, options.name, Scope(options.scope)))  # noqa: T201 - the command's output
    elif options.keys == "list":
        for key in ring.all():
            print(key.id, key.tenant, key.scope.value, f"{key.created:%Y-%m-%d}", key.name)  # noqa: T201 - as above
    elif not ring.revoke(options.id):
        return _complain(f"there is no key {options.id}")
    return EXIT_DONE


def _complain(message: str) -> int:
    print(f"querycad: {message}", file=sys.stderr)  # noqa: T201 - the command's output
    return EXIT_BAD_INPUT


def main(arguments: Sequence[str] | None = None) -> int:
    """The command line."""
    parser = argparse.ArgumentParser(prog="python -m querycad_api.keys", description="Make and revoke API keys.")
    add_arguments(parser)
    return run(parser.parse_args(arguments))


if __name__ == "__main__":
    sys.exit(main())
