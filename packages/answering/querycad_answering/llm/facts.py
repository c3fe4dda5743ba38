"""What a prompt tells of the model, so that programs call parts by terms that it has."""

from __future__ import annotations

from collections import Counter
from collections.abc import Iterable

from querycad_contracts import ModelSummary

TERMS_TOLD = 12
BODIES_TOLD = 12
NAME_CHARS = 40
"""Product names are the file's to choose."""


def facts(summary: ModelSummary) -> str:
    """How large is the model, which bodies has it, and which parts, how many of each? A few lines."""
    shape = summary.shape
    x, y, z = (f"{extent:.4g}" for extent in shape.extents)
    lines = [f"{_clean(shape.name) or 'unnamed'}, {x} x {y} x {z} m along x, y, z."]
    if summary.body_count > 1:
        names = Counter(_clean(body.name) or "unnamed" for body in shape.bodies)
        lines.append(f"{summary.body_count} bodies: {_listed(names.most_common(BODIES_TOLD), len(names))}.")
    if summary.terms:
        told = list(summary.terms.items())[:TERMS_TOLD]
        lines.append(f"Among its parts: {_listed(told, len(summary.terms))}.")
    return "\n".join(lines)


def _listed(counts: Iterable[tuple[str, int]], total: int) -> str:
    listed = [f"{count} x {name}" for name, count in counts]
    return ", ".join(listed) + (" and others" if total > len(listed) else "")


def _clean(name: str) -> str:
    """A name on one line, without what could be taken for a part of the prompt's own layout."""
    return " ".join("".join(c if c.isalnum() or c in " -.,+/()" else " " for c in name).split())[:NAME_CHARS]
