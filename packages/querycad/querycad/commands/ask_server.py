"""`querycad ask --server`: the same answers, computed by a running service."""

from __future__ import annotations

import argparse
import os
import sys
from collections.abc import Callable
from pathlib import Path
from typing import Self

import httpx
from pydantic import ValidationError

from querycad.client import Client, ClientError, ServerProblem
from querycad_contracts import AnswerOptions, AnswerRecord, LengthUnit, ModelStatus, Part

READ_S = 300.0
KEY_VARIABLE = "QUERYCAD_API_KEY"
"""Not an option: the command line is there for all to see."""

EXIT_FAILED, EXIT_BAD_INPUT = 1, 2


def ask_server(options: argparse.Namespace, answer_each: Callable[[ServerRuntime], int]) -> int:
    """Lets the service answer; returns the exit code."""
    try:
        return answer_each(ServerRuntime(options.server))
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


class ServerRuntime:
    """Answers questions about files on this machine by uploading them to a service.

    Raises ClientError, OSError, and ValueError for what no service would take.
    """

    def __init__(self, url: str) -> None:
        key = os.environ.get(KEY_VARIABLE, "")
        if not (key.isascii() and key.isprintable()):
            raise ValueError(f"{KEY_VARIABLE} holds no API key")
        self._client = Client(url, key)
        self._models: dict[str, str] = {}
        self._job = ""

    def __enter__(self) -> Self:
        return self

    def __exit__(self, *_: object) -> None:
        self._client.close()

    def ask(
        self,
        file: Path | str,
        question: str,
        unit: LengthUnit = LengthUnit.MM,
        progress: Callable[[str], None] | None = None,
        options: AnswerOptions | None = None,
    ) -> AnswerRecord:
        """What is the answer to the question about this file?"""
        if str(file) not in self._models:
            if progress is not None:
                progress("read")
            model = self._client.upload(file, READ_S)
            if model.status is ModelStatus.READING:
                raise TimeoutError(f"the service did not read the file within {READ_S:g} s")
            self._models[str(file)] = model.id
        job = self._client.submit(self._models[str(file)], question, unit, options)
        self._job = job.id
        return self._client.wait(job.id)

    def parts(self, _file: Path | str) -> tuple[Part, ...]:
        """Nothing: the parts of an answer are in its record, those that they carry are not fetched."""
        return ()

    def draw(self, file: Path | str, _record: AnswerRecord, path: Path) -> None:
        """Writes the picture of the last answer. Raises OSError."""
        path.parent.mkdir(parents=True, exist_ok=True)
        path.write_bytes(self._client.picture(self._models[str(file)], self._job))
