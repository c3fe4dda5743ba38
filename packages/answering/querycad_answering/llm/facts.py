"""What a prompt tells of the model, so that programs call parts by what it has: kinds, tags, sizes, sides, layouts."""

from __future__ import annotations

import json
from collections import Counter
from math import prod

from querycad_contracts import ModelSummary, PartGroup, PartKind, Side

BUDGET_CHARS = 800
"""Of all lines: some 240 tokens, so that a prompt stays below 3,000 with the names beside them."""
CAPABLE_CHARS = 4000
"""For a capable model."""
LEFT_CHARS, KINDS_TOLD = 90, 5
"""Of the line on what there is no room for."""
BODIES_TOLD = 5
NAME_CHARS = 40
"""Product names are the file's to choose."""
PLAIN_TAGS = frozenset(("circular", "grounded", "horizontal", "lying", "planar", "repeated", "upright", "vertical"))
"""Of these the label, the sides and the layout say as much."""
TAGS_TOLD = 3


def facts(summary: ModelSummary, budget: int = BUDGET_CHARS) -> str:
    """How large is the model, how does it stand, which bodies and which parts has it, of what size, seen from where?

    Parts that are alike share a line; those that say most of a model come first, and what the budget leaves no room for
    is named by its kinds. `budget`: characters in all.
    """
    shape = summary.shape
    x, y, z = (f"{extent:.4g}" for extent in shape.extents)
    stands = f", {shape.up.value} is likely up" if shape.up is not None else ""
    thick = f", sheet or plate {_mm(shape.thickness)} mm thick" if shape.thickness is not None else ""
    lines = [f"{x} x {y} x {z} m along x, y, z{stands}{thick}."]
    if summary.body_count > 1:
        lines.append(f"{summary.body_count} bodies: {_bodies(summary)}.")
    groups = sorted((group for group in summary.groups if group.kind is not PartKind.BODY), key=_rank)
    if not groups:
        return "\n".join(lines)
    lines.append("Parts, as: number x label {kind; tags} seen from, layout:")
    told, left = _told(groups, budget - LEFT_CHARS - sum(len(line) + 1 for line in lines))
    lines += told
    if budget > BUDGET_CHARS:
        counted = ", ".join(f"{count} {kind}" for kind, count in summary.part_counts.items())
        lines.append(f"All kinds, surfaces among them, as parts(kind) takes them: {counted}.")
    if left:
        kinds = [f"{count} x {kind}" for kind, count in left.most_common(KINDS_TOLD)]
        lines.append(f"Not listed: {', '.join(kinds)}{' …' if len(left) > KINDS_TOLD else ''}.")
    return "\n".join(lines)


def _rank(group: PartGroup) -> int:
    """How early is it told of? Cuts of no plain outline come behind the others: their sizes say little of them."""
    if not group.kind.is_feature:
        return 3
    return 0 if group.kind.cuts_in and "free" not in group.tags else 1 if group.kind.cuts_in else 2


def names(summary: ModelSummary) -> str:
    """What are model and bodies called in the file? A line of JSON, its bodies in the order in which `facts` has them.

    Whoever made the file chose these words: they go where the question is, as data, not among the rules.
    """
    bodies = [_clean(name) for name, _ in _body_groups(summary)[:BODIES_TOLD]] if summary.body_count > 1 else []
    told = {"model": _clean(summary.shape.name)} | ({"bodies": bodies} if any(bodies) else {})
    return json.dumps(told, ensure_ascii=False) if any(told.values()) else ""


def _told(groups: list[PartGroup], room: int) -> tuple[list[str], Counter[str]]:
    """The lines that there is room for, in characters, and how many parts of each kind are in none."""
    lines: list[str] = []
    left: Counter[str] = Counter()
    for group in groups:
        line = _line(group)
        if len(line) < room:
            lines.append(line)
        else:
            left[group.kind.value] += group.count
        room -= len(line) + 1 if len(line) < room else 0
    return lines, left


def _line(group: PartGroup) -> str:
    tags = [tag for tag in group.tags if tag not in PLAIN_TAGS and tag != group.kind][:TAGS_TOLD]
    what = "; ".join(filter(None, (group.kind.value, ", ".join(tags))))
    sides = "all sides" if len(group.sides) == len(Side) else ", ".join(group.sides)
    seen = " hidden" if group.hidden else f" {sides}" if sides else ""
    layout = f", {group.layout}" if group.layout else ""
    return f"{group.count} x {_clean(group.label, 90)} {{{what}}}{seen}{layout}"


def _bodies(summary: ModelSummary) -> str:
    """Colours and sizes of bodies, alike ones together."""
    groups = _body_groups(summary)
    total = len(groups)
    told = ", ".join(line for _, line in groups[:BODIES_TOLD])
    return told + (f" and {total - BODIES_TOLD} smaller kinds" if total > BODIES_TOLD else "")


def _body_groups(summary: ModelSummary) -> list[tuple[str, str]]:
    """Name of each group of bodies that are alike, and what is told of it beside; the largest first."""
    groups = [group for group in summary.groups if group.kind is PartKind.BODY]
    if not groups:
        counted = Counter(body.name for body in summary.shape.bodies)
        return [(name, f"{count} alike") for name, count in counted.most_common()]
    groups.sort(key=lambda group: -prod(group.extents))
    return [(group.name, _body(group)) for group in groups]


def _body(group: PartGroup) -> str:
    size = " x ".join(_mm(extent) for extent in group.extents)
    color = f"{_clean(group.color)} " if group.color else ""
    return f"{group.count} x {color}({size} mm)"


def _mm(metres: float) -> str:
    return f"{metres * 1e3:.4g}"


def _clean(name: str, most: int = NAME_CHARS) -> str:
    """A name on one line, without what could be taken for a part of the prompt's own layout."""
    return " ".join("".join(c if c.isalnum() or c in " -.,+/()" else " " for c in name).split())[:most]
