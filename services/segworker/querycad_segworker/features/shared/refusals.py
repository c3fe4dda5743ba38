"""Why did a recogniser not take what looked like one of its parts? Reasons are gathered while recognition runs."""

from __future__ import annotations

from collections.abc import Iterable, Iterator, Sequence
from contextlib import contextmanager
from contextvars import ContextVar

from querycad_contracts import Part, Refusal

_gathered: ContextVar[dict[Refusal, None] | None] = ContextVar("refusals", default=None)
"""Recognisers are plain functions of a B-rep; what they refuse lies beside their results."""


@contextmanager
def gathering() -> Iterator[dict[Refusal, None]]:
    """Gathers what is refused inside the block, in order, each refusal once."""
    gathered: dict[Refusal, None] = {}
    token = _gathered.set(gathered)
    try:
        yield gathered
    finally:
        _gathered.reset(token)


def refuse(kind: str, faces: Iterable[int], reason: str) -> None:
    """Notes why these faces are no part of this kind; does nothing where nobody gathers."""
    gathered = _gathered.get()
    if gathered is not None:
        gathered[Refusal(kind=kind, faces=tuple(sorted(set(faces))), reason=reason)] = None


def left_refused(gathered: Iterable[Refusal], parts: Sequence[Part]) -> tuple[Refusal, ...]:
    """Those whose faces did not end up in a part of the same kind by another way; sorted by kind and faces."""
    taken: dict[str, list[frozenset[int]]] = {}
    for part in parts:
        taken.setdefault(part.kind, []).append(frozenset(part.faces))
    left = [
        refusal
        for refusal in gathered
        if not any(faces.issuperset(refusal.faces) for faces in taken.get(refusal.kind, ()))
    ]
    return tuple(sorted(left, key=lambda refusal: (refusal.kind, refusal.faces, refusal.reason)))
