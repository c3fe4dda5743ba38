"""A running service as a system to be measured: `querycad bench --server URL`."""

from __future__ import annotations

import os
from pathlib import Path
from time import perf_counter

from querycad.client import Client, ClientError
from querycad.commands.server import KEY_VARIABLE
from querycad_contracts import AnswerOptions, Codegen, ModelStatus

from .systems import Reply, SystemOptions, UnknownSystem, reply_of

READ_S = 300.0


class ServedSystem:
    """Asks a service, with the key that the environment has. Raises UnknownSystem where it is not ready."""

    def __init__(self, options: SystemOptions) -> None:
        if options.server is None:
            raise UnknownSystem("no service is named: --server says where it is")
        self._options = options
        self._how = AnswerOptions(codegen=Codegen(options.codegen), grounding=options.grounding)
        self._client = Client(options.server, os.environ.get(KEY_VARIABLE) or None)
        self._models: dict[Path, str] = {}
        try:
            health = self._client.health()
        except ClientError as error:
            raise UnknownSystem(f"{options.server}: {error}") from error
        if not health.ready:
            missing = ", ".join(name for name, there in health.checks.items() if not there)
            raise UnknownSystem(f"{options.server} is not ready: {missing}")

    def ask(self, file: Path, question: str) -> Reply:
        """What is the answer? The time is that of the whole request, without that of reading the model."""
        try:
            if file not in self._models:
                model = self._client.upload(file, READ_S)
                if model.status is not ModelStatus.READY:
                    why = model.failure.message if model.failure is not None else f"not read within {READ_S:g} s"
                    return Reply(failure="bad_input", message=why)
                self._models[file] = model.id
            start = perf_counter()
            record = self._client.ask(self._models[file], question, options=self._how)
            return reply_of(record, perf_counter() - start)
        except (ClientError, TimeoutError) as error:
            return Reply(failure="internal", message=str(error))

    def close(self) -> None:
        """Closes the connection."""
        self._client.close()
