"""Values that may be meant, while it is being found out which is."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass, field
from typing import Any

from querycad_contracts import Part
from querycad_contracts.parameters import ParameterAlternative, PartName


@dataclass(slots=True)
class Found:
    """A value that may be meant: as it is told, how probable it is, and what it rests on."""

    value: Any
    text: str
    confidence: float
    understood_as: str = ""
    parts: tuple[Part, ...] = ()
    code: str | None = None

    def alternative(self) -> ParameterAlternative:
        """As another value is told."""
        return ParameterAlternative(
            value=plain(self.value),
            text=self.text,
            confidence=round(self.confidence, 3),
            understood_as=self.understood_as,
            parts=names(self.parts),
        )


@dataclass(slots=True)
class Candidates:
    """All values that may be meant, and why it is not sure which; without any, why there is none."""

    found: list[Found] = field(default_factory=list)
    reason: str = ""
    asked: str = ""
    doubts: tuple[str, ...] = ()
    """Why even a probable value is not sure enough for who cannot look."""


def names(parts: Sequence[Part]) -> tuple[PartName, ...]:
    """The parts, in short."""
    return tuple(PartName(id=part.id, label=part.label) for part in parts)


def plain(value: Any) -> Any:
    """The value as JSON has it."""
    if isinstance(value, list | tuple):
        return [plain(each) for each in value]
    return value.model_dump(mode="json") if hasattr(value, "model_dump") else value
