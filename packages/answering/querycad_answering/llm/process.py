"""A language model that is a process of this machine: it reads a conversation on standard input and writes its reply.

Whatever can read JSON can take a model's place: another vendor's client, a script, a person at a terminal. The process
is started for each reply, without a shell, and ended with all its children when the time is up. It is sent one object:

    {"messages": [{"role": "system" | "user" | "assistant", "content": text}, …],
     "temperature": number, "max_tokens": number, "sample": number}

(a message with pictures has a list as its content, of one `text` and of `image_url`s with the PNG file's data URL),
and its standard output, as text, is the reply. An exit code other than 0 is no reply; the last line of its standard
error says why.
"""

from __future__ import annotations

import json
import os
import shlex
import signal
import subprocess
from contextlib import suppress
from tempfile import TemporaryFile
from threading import Timer

from .messages import LlmBusy, LlmRefused, Message, Reply, TimeLimit
from .settings import LlmSettings
from .wire import openai_messages

CHARS_A_TOKEN = 12
"""As of replies over HTTP: what is longer comes from a process that keeps no limit."""
COMPLAINT_BYTES = 2**16
SAID_CHARS = 200
"""Of what the process says on standard error, in the reason for which there is no reply."""
OF_OURS = ("QUERYCAD_LLM_API_KEY", "QUERYCAD_EYES_API_KEY")
"""What the process is not told: a key is for the address that it belongs to."""


class ProcessChatModel:
    """A language model behind a command of the settings."""

    def __init__(self, settings: LlmSettings) -> None:
        self._settings = settings
        self._command = shlex.split(settings.llm_command)

    def reply(self, conversation: tuple[Message, ...], temperature: float, sample: int, deadline: TimeLimit) -> Reply:
        """What does it say? Raises LlmError."""
        asked = {
            "messages": openai_messages(conversation),
            "temperature": temperature,
            "max_tokens": self._settings.llm_tokens,
            "sample": sample,
        }
        environment = {name: value for name, value in os.environ.items() if name not in OF_OURS}
        most = CHARS_A_TOKEN * self._settings.llm_tokens
        with TemporaryFile() as question, TemporaryFile() as complaint:  # files: no pipe that could be full
            question.write(json.dumps(asked).encode())
            question.seek(0)
            try:
                process = subprocess.Popen(
                    self._command,
                    stdin=question,
                    stdout=subprocess.PIPE,
                    stderr=complaint,
                    env=environment,
                    start_new_session=True,
                )
            except OSError as error:
                raise LlmRefused(f"the language model's command cannot be started: {error.strerror}") from error
            said = _said(process, 4 * most, deadline)  # no character has more bytes
            if process.returncode > 0:
                complaint.seek(0)
                lines = complaint.read(COMPLAINT_BYTES).decode("utf-8", "replace").strip().splitlines()
                why = f": {lines[-1][:SAID_CHARS]}" if lines else ""
                raise LlmBusy(f"the language model's command ended with code {process.returncode}{why}")
        text = said.decode("utf-8", "replace")
        return Reply(text[:most], cut=len(text) > most)


def _said(process: subprocess.Popen[bytes], most: int, deadline: TimeLimit) -> bytes:
    """What the process writes, up to so many bytes; it is ended then, and when the time is up. Raises LlmTooSlow."""
    timer = Timer(deadline.left_s(), _end, [process])
    timer.start()
    try:
        with process:  # waits for its end, which is why an interruption has to end it first
            assert process.stdout is not None
            try:
                said = process.stdout.read(most + 1)
            except BaseException:
                _end(process)
                raise
            if len(said) > most:
                _end(process)
    finally:
        timer.cancel()
        _end(process)  # and what it may have left behind
    deadline.left_s()
    if process.returncode < 0 and len(said) <= most:
        raise LlmBusy(f"the language model's command was ended by signal {-process.returncode}")
    return said


def _end(process: subprocess.Popen[bytes]) -> None:
    """Ends the process with all that it started."""
    with suppress(ProcessLookupError, PermissionError):
        os.killpg(process.pid, signal.SIGKILL)
