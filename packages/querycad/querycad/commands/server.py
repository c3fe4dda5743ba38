"""`--server`: a command's model is read, and its answers computed, by a running service."""

from __future__ import annotations

import argparse
import os
from collections.abc import Callable
from typing import TYPE_CHECKING

import httpx
from pydantic import ValidationError

from querycad.client import Client, ClientError, ServerProblem

from .outcomes import EXIT_BAD_INPUT, EXIT_FAILED, complain, first_of

if TYPE_CHECKING:
    from querycad.model import Model

    from .reading import OpenModel

KEY_VARIABLE = "QUERYCAD_API_KEY"
"""Not an option: the command line is there for all to see."""


def on_server(options: argparse.Namespace, work: Callable[[OpenModel], int]) -> int:
    """Does the work with what opens `options.file` at `options.server`; returns the exit code."""
    try:
        with Client(options.server, _key()) as client:

            def open_model(progress: Callable[[str], None]) -> Model:
                progress("read")
                return client.open(options.file)

            return work(open_model)
    except ServerProblem as error:
        is_input = error.problem.status < httpx.codes.INTERNAL_SERVER_ERROR
        return complain(f"{options.file}: {error}", EXIT_BAD_INPUT if is_input else EXIT_FAILED)
    except (ClientError, TimeoutError) as error:
        return complain(str(error), EXIT_FAILED)
    except OSError as error:
        return complain(f"{options.file}: {error.strerror}")
    except ValidationError as error:  # a question that no service would take
        return complain(first_of(error))
    except ValueError as error:
        return complain(str(error))


def _key() -> str:
    """The API key. Raises ValueError for what is none."""
    key = os.environ.get(KEY_VARIABLE, "")
    if not (key.isascii() and key.isprintable()):
        raise ValueError(f"{KEY_VARIABLE} holds no API key")
    return key
