"""The command that makes and revokes API keys: `python -m querycad_api.accounts create | list | revoke`"""

from __future__ import annotations

import argparse
import sys
from collections.abc import Sequence

from pydantic import ValidationError

from querycad_api.settings import ApiSettings

from .keys import KeyRing
from .schemas import Scope

EXIT_DONE, EXIT_BAD_INPUT = 0, 2


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
    parser = argparse.ArgumentParser(prog="python -m querycad_api.accounts", description="Make and revoke API keys.")
    add_arguments(parser)
    return run(parser.parse_args(arguments))
