"""What do the services write to their logs? One line an event, each with the id of the HTTP request that it is about.

The id comes with the request (`X-Request-ID`) or is made by the api; tasks and runs carry it on.
"""

from __future__ import annotations

import json
import logging
import sys
from datetime import UTC, datetime
from enum import StrEnum
from typing import Any

from querycad_contracts import current_request

_PLAIN = frozenset(logging.makeLogRecord({}).__dict__) | {"message", "asctime", "request", "taskName"}
"""What every record has; anything else was given with `extra`."""


class LogFormat(StrEnum):
    """How a log is written: for people, or one JSON object a line."""

    TEXT = "text"
    JSON = "json"


def start_logging(service: str, form: LogFormat = LogFormat.TEXT) -> None:
    """Sends the log of this process to standard error; libraries' loggers go the same way."""
    handler = logging.StreamHandler(sys.stderr)
    handler.setFormatter(_Json(service) if form is LogFormat.JSON else _Text())
    handler.addFilter(_note_request)
    root = logging.getLogger()
    root.handlers[:] = [handler]
    root.setLevel(logging.INFO)
    logging.captureWarnings(True)
    for chatty in ("httpx", "celery.worker.strategy", "celery.app.trace"):  # several lines for each of ours
        logging.getLogger(chatty).setLevel(logging.WARNING)


def printable(text: str) -> str:
    """The text in one line: what is not visible, such as a line end or an escape, is written as JSON has it."""
    if text.isprintable():
        return text
    return "".join(each if each.isprintable() else json.dumps(each)[1:-1] for each in text)


def _note_request(record: logging.LogRecord) -> bool:
    record.request = current_request()
    return True


def _given(record: logging.LogRecord) -> dict[str, object]:
    return {name: value for name, value in record.__dict__.items() if name not in _PLAIN}


class _Json(logging.Formatter):
    """One JSON object a line."""

    def __init__(self, service: str) -> None:
        super().__init__()
        self._service = service

    def format(self, record: logging.LogRecord) -> str:
        """The line."""
        line: dict[str, object] = {
            "at": datetime.fromtimestamp(record.created, UTC).isoformat(timespec="milliseconds"),
            "level": record.levelname.lower(),
            "service": self._service,
            "request": getattr(record, "request", ""),
            "logger": record.name,
            "message": record.getMessage(),
            **_given(record),
        }
        if record.exc_info:
            line["error"] = self.formatException(record.exc_info)
        return printable(json.dumps(line, default=str, ensure_ascii=False))


class _Text(logging.Formatter):
    """Time, level, request, message and what else was given."""

    def __init__(self) -> None:
        super().__init__("%(asctime)s %(levelname)s %(request)s %(name)s: %(message)s")

    def formatMessage(self, record: logging.LogRecord) -> str:  # noqa: N802 - as the library calls it
        """The line; a traceback follows on lines of its own."""
        given = (f"{name}={value}" for name, value in _given(record).items())
        return printable(" ".join([super().formatMessage(record), *given]))

    def formatException(self, ei: Any) -> str:  # noqa: N802 - as above
        """The traceback, line by line."""
        return "\n".join(map(printable, super().formatException(ei).split("\n")))
