"""`querycad ask --server`: the same answers, computed by a running service."""

from __future__ import annotations

import argparse
import os
import sys
from collections.abc import Callable
from typing import TYPE_CHECKING

import httpx
from pydantic import ValidationError

from querycad.client import Client, ClientError, ServerProblem

if TYPE_CHECKING:
    from querycad.model import Model

    from .ask import OpenModel

KEY_VARIABLE = "QUERYCAD_API_KEY"
"""Not an option: the command line is there for all to see."""

EXIT_FAILED, EXIT_BAD_INPUT = 1, 2


def ask_server(options: argparse.Namespace, answer_each: Callable[[OpenModel], int]) -> int:
    """Lets the service answer; returns the exit code."""
    try:
        with Client(options.server, _key()) as client:

            def open_model(progress: Callable[[str], None]) -> Model:
                progress("read")
                return client.open(options.file)

            return answer_each(open_model)
    except ServerProblem as error:
        print(f"querycad: {options.file}: {error}", file=sys.stderr)
        return EXIT_BAD_INPUT if error.problem.status < httpx.codes.INTERNAL_SERVER_ERROR else EXIT_FAILED
    except (ClientError, TimeoutError) as error:
        print(f"querycad: {error}", file=sys.stderr)
        return EXIT_FAILED
    except OSError as error:
        print(f"querycad: {options.file}: {error.strerror}", file=sys.stderr)
        return EXIT_BAD_INPUT
    except ValidationError as error:  # a question that no service would take
        first = error.errors()[0]
        print(f"querycad: {'.'.join(map(str, first['loc']))}: {first['msg']}", file=sys.stderr)
        return EXIT_BAD_INPUT
    except ValueError as error:
        print(f"querycad: {error}", file=sys.stderr)
        return EXIT_BAD_INPUT


def _key() -> str:
    """The API key. Raises ValueError for what is none."""
    key = os.environ.get(KEY_VARIABLE, "")
    if not (key.isascii() and key.isprintable()):
        raise ValueError(f"{KEY_VARIABLE} holds no API key")
    return key
