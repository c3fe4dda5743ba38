"""The parts of one model, with what they are to one another: what grounding looks at."""

from __future__ import annotations

import math
from collections import OrderedDict
from collections.abc import Iterable, Mapping, Sequence
from functools import cached_property

from querycad_contracts import Grounded, Measure, Part, PartKind, PartQuery
from querycad_language.lexicon import Adjective, Sense, lexicon
from querycad_segworker.relations import orders
from querycad_segworker.relations.bore_steps import step_walls
from querycad_segworker.relations.nearby import Nearby
from querycad_segworker.relations.roles import ROLES, Kinds

from .names import all_words, holds, share, vocabulary
from .printed import printed_labels

CORNER_SHARE = 0.5  # in a corner is what lies at least half-way out to two edges
CORE_TOLERANCE_M = 0.005e-3  # cores are no drill sizes: who draws one gives it three digits of a millimetre
SMALL_UNIFIED = {"4-40", "6-32", "8-32", "10-24", "10-32"}
"""Unified threads below 1/4 inch whose tap drills are taken for threads: the others are near metric clearance holes."""
THREAD_TOLERANCE_M = 0.06e-3
"""A bore this near to a standard diameter has it: half the step between neighbouring tap drill sizes."""
WALLS = (PartKind.WALL, PartKind.FLOOR)
WIDE = 0.7  # a flange or plate is at least this wide, compared with the widest
_IMPLIED = {
    "chamfer": ("beveled", "chamfered"),
    "round": ("rounded",),
    "fillet": ("rounded",),
    "hole": ("circular", "cylindrical", "hollow"),
    "gear": ("toothed",),
}
"""Attributes that all parts of a kind have."""
_TURNED = {"vertical": "horizontal", "horizontal": "vertical"}


class Inventory:
    """The parts of one model by kind, name and attribute."""

    def __init__(self, parts: Sequence[Part]) -> None:
        self.parts = tuple(parts)
        self.kinds = Kinds(parts)
        self.bodies = self.kinds.get("body")
        self.alone = len(self.bodies) <= 1
        self.model = next((part for part in parts if part.kind == "model"), None)
        self.by_id = {part.id: part for part in parts}
        self.names = vocabulary(parts)
        self._roles: dict[tuple[str, str], bool] = {}
        self._found: dict[Sense, list[Part]] = {}
        self.grounded: OrderedDict[tuple[PartQuery, int], list[Grounded]] = OrderedDict()
        """Ways to ground queries, by how deep in others these stand: one question asks for each several times."""

    @cached_property
    def nearby(self) -> Nearby:
        """What is near to each part."""
        return Nearby(self.parts)

    @cached_property
    def printed(self) -> Mapping[str, tuple[Part, ...]]:
        """What is printed of the parts, folded, to the parts that it is printed of."""
        return printed_labels(self.parts, self.alone)

    @cached_property
    def alike(self) -> list[list[Part]]:
        """An assembly's largest bodies; what is cut in or stands out, walls too: most alike first, then largest."""
        groups = orders.by_size([p for p in self.parts if p.kind.cuts_in or p.kind.stands_out or p.kind in WALLS])
        groups.sort(key=lambda group: (len(group), orders.size(group[0])), reverse=True)
        bodies = orders.by_size(self.bodies if len(self.bodies) > 1 else ())
        return [*sorted(bodies, key=lambda group: orders.size(group[0]), reverse=True)[:3], *groups]

    @cached_property
    def near(self) -> float:
        """How far apart are parts that lie equally far towards a side, metres? A fiftieth of the longest extent."""
        return 0.02 * (max(self.model.extents) if self.model is not None else 1.0)

    @property
    def lies(self) -> bool:
        """Is it less high than wide and deep?"""
        return self.model is not None and self.model.extents[2] < min(self.model.extents[:2])

    @cached_property
    def cores(self) -> list[tuple[float, float]]:
        """Tap drills and cores of the usual threads, and how near to them a hole is taken for one, metres."""
        metric = {name for name in lexicon().threads if name[0] == "m" and "x" not in name}
        inch = {name for name in lexicon().threads if "/" in name and name[0] != "g" and not name.endswith("npt")}
        usual = [lexicon().threads[name] for name in metric | inch | SMALL_UNIFIED]
        near = {"tap drill": THREAD_TOLERANCE_M, "core": CORE_TOLERANCE_M}
        return [(holes[role], tolerance) for holes in usual for role, tolerance in near.items()]

    def tags(self, part: Part, asked: Iterable[str] = ()) -> set[str]:
        """The attributes of a part; those that only other parts can give where they are asked for."""
        tags = {part.kind, *part.tags, *_IMPLIED.get(part.kind, ())}
        if "plate" in part.tags:
            tags = {_TURNED.get(tag, tag) for tag in tags}
        if "elongated" in part.tags and part.kind.cuts_in:  # a vertical slot runs up, and does not open there
            tags = tags - {*_TURNED} | {"vertical" if part.extents[2] == max(part.extents) else "horizontal"}
        if part.kind == "hole" and part.diameter is not None:
            if any(abs(part.diameter - core) <= near for core, near in self.cores):
                tags.add("core_diameter")
        return tags | {role for role in asked if role in ROLES and role not in tags and self._plays(part, role)}

    def has(self, part: Part, tags: Sequence[str]) -> bool:
        """Does it have one of the tags?"""
        return not self.tags(part, tags).isdisjoint(tags)

    def _plays(self, part: Part, role: str) -> bool:
        if (part.id, role) not in self._roles:
            self._roles[part.id, role] = ROLES[role](part, self.kinds)
        return self._roles[part.id, role]

    # What a noun means

    def of_sense(self, sense: Sense) -> list[Part]:
        """The parts that a sense of a noun demands."""
        if sense not in self._found:
            self._found[sense] = self._of_sense(sense)
        return self._found[sense]

    def _of_sense(self, sense: Sense) -> list[Part]:
        if (sense.alone and not self.alone) or (sense.several and self.alone):
            return []
        if sense.name and self.alone and sense.kind == ("body",):
            return []  # the name of the only body says what the whole is
        found = [part for part in self.kinds.get(*sense.kind) if self._fits(part, sense)]
        if sense.step is not None:
            found = step_walls(found, sense.step == "widest", self.kinds)
        return orders.without_twins(self._picked(found, sense.pick) if sense.pick else found)

    def _fits(self, part: Part, sense: Sense) -> bool:
        tags = self.tags(part, (*sense.tags, *sense.any, *sense.without))
        return (
            tags.issuperset(sense.tags)
            and (not sense.any or not tags.isdisjoint(sense.any))
            and tags.isdisjoint(sense.without)
            and (not sense.name or holds(part.name, sense.name))
        )

    def _picked(self, found: list[Part], pick: str) -> list[Part]:
        if not found:
            return found
        match pick:
            case "elongated":
                return [part for part in found if part.kind == "slot" or {"elongated", "obround"} & set(part.tags)]
            case "standing" | "tall" | "low":
                found = [part for part in found if self._stands(part)]
                heights = [part.height or 0.0 for part in found] or [0.0]
                low = max(heights) / 2 if pick == "tall" else 0.0
                high = 2 * min(heights) if pick == "low" else math.inf
                return [part for part in found if low <= (part.height or 0.0) <= high]
            case "most":
                group = max(orders.by_size(found), key=len)
                return group if len(group) > 2 else []
            case "lowest":
                near = 0.02 * max(part.extents[2] for part in found) + 1e-9
                return orders.first(found, lambda part: part.extents[2] / 2 - part.center[2], near)
        sizes = [orders.size(part) for part in found]
        if pick == "smallest":
            return orders.first(found, lambda part: -orders.size(part), 1e-3 * min(sizes))
        return orders.first(found, orders.size, (1e-3 if pick == "largest" else 1 - WIDE) * max(sizes))

    def _stands(self, part: Part) -> bool:
        """Does it stand out of its body, instead of being the body's own outline?"""
        body = next((b for b in self.bodies if set(part.faces) <= set(b.faces)), None)
        if body is None or body.diameter is None or part.diameter is None:
            return True
        return part.diameter < body.diameter / orders.SAME_SIZE

    # Names

    def body_named(self, words: Sequence[str]) -> list[tuple[Part, float]]:
        """Bodies of an assembly whose names hold the head noun of a phrase, with the share of its words they hold."""
        if self.alone or not words:
            return []
        scored = [(body, share(body.name, words)) for body in self.bodies]
        return [(body, score) for body, score in scored if score > 0]

    def file_named(self, words: Sequence[str]) -> bool:
        """Do these words name the whole model, by the name of its file or assembly?"""
        have = all_words(self.model.name) if self.model is not None else []
        return bool(words) and all(word in have for word in words)

    # Orders

    def ordered(self, found: Sequence[Part], adjective: Adjective, count: int | None) -> list[Part]:
        """Those that an adjective such as 'large' or 'outer' chooses among parts that differ in a measure or place."""
        if adjective.order is None or len(found) < 2 or self.model is None:
            return list(found)
        order, middle = adjective.order, self.model
        if order == "corner":
            return [part for part in found if orders.out_to_corner(part, middle) >= CORNER_SHARE - 1e-6] or list(found)
        aside = order == "distance"
        values = [orders.off_center(p, middle) for p in found] if aside else orders.compared(found, order)
        return orders.end_of(found, values, adjective.most, count)


def values_of(part: Part, measure: Measure | None) -> list[float]:
    """Which values may a stated size be: those of the measure, or, without one, all that a part is named by?"""
    steps, hole = [2 * radius for radius in part.radii], part.kind == "hole"
    found: list[float | None]
    match measure:
        case Measure.DIAMETER | Measure.OUTER_DIAMETER:
            found = [part.diameter, *steps]
        case Measure.INNER_DIAMETER:
            found = [part.diameter, *steps[:1]]
        case Measure.RADIUS:
            found = [part.radius, *part.radii]
        case Measure.WIDTH:
            found = [part.width, *(steps if hole else ())]
        case Measure.LENGTH:
            plain = [part.length, part.depth if hole else part.height]
            found = [part.nominal_length] if part.nominal_length else plain
        case Measure.THICKNESS:
            found = [part.thickness, part.height]
        case Measure.DEPTH | Measure.HEIGHT | Measure.ANGLE | Measure.AREA | Measure.VOLUME:
            found = [getattr(part, measure.value)]
        case _ if part.kind in (PartKind.FILLET, PartKind.ROUND, PartKind.BEND):
            found = [part.radius]
        case _ if part.diameter is not None:
            found = [part.diameter, *steps]
        case _:
            found = [part.width, part.length, part.thickness, part.height, part.depth]
    return [value for value in found if value is not None]
