"""What can be wrong with a file: one sentence each, written for the user.

FileProblem
├── NotStep            no STEP file at all, or not in a form that can be read
├── IncompleteFile     empty, cut short, or without geometry
├── NoLengthUnit       its numbers have no unit
├── UnreadableFile     the kernel cannot make sense of it
├── NotRead            it is known, and has to be read first
├── FileTooLarge       over the size limit
├── KernelDied         the kernel crashed, hung or ran out of memory on it
├── KernelKilled       the kernel's process was killed by somebody else
├── NoPlace            what is read of it cannot be kept anywhere
└── DiskFull           there is no space for what is read
"""

from __future__ import annotations

import errno


class FileProblem(Exception):
    """A file that cannot be answered about; `str()` is the sentence for the user."""

    retryable = False


class NotStep(FileProblem):
    """The file is not STEP (ISO 10303-21)."""


class IncompleteFile(FileProblem):
    """The file is STEP but something that every model needs is missing."""


class NoLengthUnit(FileProblem):
    """The file declares no length unit, so no length in it can be trusted."""


class UnreadableFile(FileProblem):
    """The kernel refused the file."""


class NotRead(FileProblem):
    """The file is known, but nothing is kept of it that this version can use: an ingest has to read it first."""

    retryable = True


class FileTooLarge(FileProblem):
    """The file is larger than the limit."""


class KernelDied(FileProblem):
    """The kernel's process crashed, ran out of time or out of memory."""


class DiskFull(FileProblem):
    """There is no space left for what was read; the file may be sound."""

    retryable = True
    CODES = (errno.ENOSPC, errno.EDQUOT)

    def __init__(self) -> None:
        super().__init__("the disk of the service is full; the file may be sound: try again when there is space")


class KernelKilled(FileProblem):
    """The kernel's process was killed from outside; the file may be sound."""

    retryable = True


class NoPlace(FileProblem):
    """The folder that keeps what is read of files cannot be written."""
