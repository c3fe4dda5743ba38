"""What does a model hold, in short? For lists of models, and for whoever writes programs about one."""

from __future__ import annotations

from collections import Counter
from collections.abc import Iterable

from querycad_contracts import ModelSummary, Part

from .model import Model

BODIES_LISTED = 100
"""Of an assembly with thousands of bodies; the summary is to stay short."""
TERMS_LISTED = 30
"""Rarer names of parts help nobody to find out what the model is."""


def summary(model: Model) -> ModelSummary:
    """What does the model hold, in short?"""
    shape = model.shape
    return ModelSummary(
        shape=shape.model_copy(update={"bodies": shape.bodies[:BODIES_LISTED]}),
        body_count=len(shape.bodies),
        part_counts=dict(sorted(Counter(part.kind for part in model.parts).items())),
        terms=dict(_terms(model.parts).most_common(TERMS_LISTED)),
        units=model.units,
        warnings=model.warnings,
        timings_ms=model.timings_ms,
    )


def _terms(parts: Iterable[Part]) -> Counter[str]:
    """How many parts go by each name? The first words of a label say what a part is; numbered ones go by their kind."""
    named = ((part.label.partition(",")[0], part.kind) for part in parts if part.kind not in ("body", "model"))
    return Counter(kind if any(map(str.isdigit, name)) else name for name, kind in named)
