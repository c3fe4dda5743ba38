"""What does a model hold, in short? For lists of models, and for whoever writes programs about one."""

from __future__ import annotations

from collections import Counter, defaultdict
from collections.abc import Iterable, Sequence

from querycad_contracts import ModelSummary, Part, PartGroup, PartKind

from .grounding.printed import group_label
from .model import Model

BODIES_LISTED = 100
"""Of an assembly with thousands of bodies; the summary is to stay short."""
TERMS_LISTED = 30
"""Rarer names of parts help nobody to find out what the model is."""
GROUPS_LISTED = 60
_SOLIDS = (PartKind.PRISM, PartKind.WALL, PartKind.FLOOR)
"""What bodies are made of: a base plate, a leg."""


def summary(model: Model) -> ModelSummary:
    """What does the model hold, in short?"""
    shape = model.shape
    return ModelSummary(
        shape=shape.model_copy(update={"bodies": shape.bodies[:BODIES_LISTED]}),
        body_count=len(shape.bodies),
        part_counts=dict(sorted(Counter(part.kind for part in model.parts).items())),
        terms=dict(_terms(model.parts).most_common(TERMS_LISTED)),
        groups=_groups(model.parts)[:GROUPS_LISTED],
        units=model.units,
        warnings=model.warnings,
        timings_ms=model.timings_ms,
    )


def _terms(parts: Iterable[Part]) -> Counter[str]:
    """How many parts go by each name? The first words of a label say what a part is; numbered ones go by their kind."""
    named = ((part.label.partition(",")[0], part.kind) for part in parts if not part.kind.is_whole)
    return Counter(kind if any(map(str.isdigit, name)) else name for name, kind in named)


def _groups(parts: Sequence[Part]) -> tuple[PartGroup, ...]:
    """Which parts are alike? Cuts first, then what stands out, edges, and solids; the largest of each first."""
    layouts = _layouts(parts)
    several = sum(part.kind is PartKind.BODY for part in parts) > 1
    alike: dict[tuple[object, ...], list[Part]] = defaultdict(list)
    for part in parts:
        if part.kind.is_feature or part.kind in _SOLIDS or (several and part.kind is PartKind.BODY):
            size = tuple(round(extent, 5) for extent in sorted(part.extents)) if part.kind is PartKind.BODY else ()
            alike[part.kind, group_label(part), part.color, size].append(part)
    ranked = sorted(alike.values(), key=lambda group: (_rank(group[0].kind), -max(group[0].extents)))
    return tuple(_group(group, layouts) for group in ranked)


def _rank(kind: PartKind) -> int:
    """How early is a kind told of? What a drawing dimensions first."""
    ranks = (kind.cuts_in, kind.stands_out and kind not in _SOLIDS, not kind.breaks_edge and kind not in _SOLIDS)
    return next(i for i, is_so in enumerate((*ranks, kind.breaks_edge, True)) if is_so)


def _group(parts: Sequence[Part], layouts: dict[str, str]) -> PartGroup:
    first = parts[0]
    laid_out = {layouts.get(part.id, "") for part in parts}
    return PartGroup(
        count=len(parts),
        kind=first.kind,
        label=group_label(first),
        tags=tuple(tag for tag in first.tags if all(tag in part.tags for part in parts)),
        sides=tuple(side for side in first.sides if all(side in part.sides for part in parts)),
        hidden=not any(part.sides for part in parts),
        layout=laid_out.pop() if len(laid_out) == 1 else "",
        name=first.name or "" if first.kind is PartKind.BODY else "",
        color=first.color or "" if first.kind is PartKind.BODY else "",
        extents=first.extents,
    )


def _layouts(parts: Sequence[Part]) -> dict[str, str]:
    """What is the pattern called that each part lies in? 'bolt circle of 6, diameter 47 mm'."""
    return {
        child: " ".join((f"{part.label.partition(' of ')[0]} of {part.count},", part.label.partition(", ")[2]))
        for part in parts
        if part.kind is PartKind.PATTERN
        for child in part.children
    }
