"""The parts of one model, with what they are to one another: what grounding looks at."""

from __future__ import annotations

from collections import OrderedDict
from collections.abc import Iterable, Mapping, Sequence
from functools import cached_property

from querycad_contracts import Grounded, Measure, Part, PartKind, PartQuery
from querycad_language.lexicon import Sense, lexicon
from querycad_segworker.relations import orders
from querycad_segworker.relations.bore_steps import step_walls
from querycad_segworker.relations.nearby import Nearby
from querycad_segworker.relations.roles import ROLES, Kinds

from .names import all_words, holds, vocabulary
from .printed import printed_labels

CORE_TOLERANCE_M = 0.005e-3  # cores are no drill sizes: who draws one gives it three digits of a millimetre
SMALL_UNIFIED = {"4-40", "6-32", "8-32", "10-24", "10-32"}
"""Unified threads below 1/4 inch whose tap drills are taken for threads: the others are near metric clearance holes."""
THREAD_TOLERANCE_M = 0.06e-3
"""A bore this near to a standard diameter has it: half the step between neighbouring tap drill sizes."""
WALLS = (PartKind.WALL, PartKind.FLOOR)
_IMPLIED = {
    "chamfer": ("beveled", "chamfered"),
    "round": ("rounded",),
    "fillet": ("rounded",),
    "hole": ("circular", "cylindrical", "hollow"),
    "gear": ("toothed",),
}
"""Attributes that all parts of a kind have."""
_PLAIN = (Measure.DEPTH, Measure.HEIGHT, Measure.ANGLE, Measure.AREA, Measure.VOLUME)
"""Measures that a part has one value of."""
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
        return tags | {role for role in asked if role in ROLES and role not in tags and self.kinds.plays(part, role)}

    def has(self, part: Part, tags: Sequence[str]) -> bool:
        """Does it have one of the tags?"""
        return not self.tags(part, tags).isdisjoint(tags)

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
        return orders.without_twins(orders.picked(found, sense.pick, self.bodies) if sense.pick else found)

    def _fits(self, part: Part, sense: Sense) -> bool:
        tags = self.tags(part, (*sense.tags, *sense.any, *sense.without))
        return (
            tags.issuperset(sense.tags)
            and (not sense.any or not tags.isdisjoint(sense.any))
            and tags.isdisjoint(sense.without)
            and (not sense.name or holds(part.name, sense.name))
        )

    def file_named(self, words: Sequence[str]) -> bool:
        """Do these words name the whole model, by the name of its file or assembly? No motor is a motor bracket."""
        have = all_words(self.model.name) if self.model is not None else []
        if not words or not all(word in have for word in words):
            return False
        behind = {*have[have.index(words[-1]) + 1 :][:1]} - {"body", *lexicon().words("whole")}
        return lexicon().nouns.keys().isdisjoint(behind)


def values_of(part: Part, measure: Measure | None) -> list[float]:
    """Which values may a stated size be: those of the measure, or, without one, all that a part is named by?"""
    steps, hole = [2 * radius for radius in part.radii], part.kind == "hole"
    across, length = [part.diameter, *steps], [part.length, part.depth if hole else part.height]
    own: dict[Measure | None, list[float | None]] = {
        Measure.DIAMETER: across,
        Measure.OUTER_DIAMETER: across,
        Measure.INNER_DIAMETER: across[:2],
        Measure.RADIUS: [part.radius, *part.radii],
        Measure.WIDTH: [part.width, *(steps if hole else ())],
        Measure.LENGTH: [part.nominal_length] if part.nominal_length else length,
        Measure.THICKNESS: [part.thickness, part.height],
        **{one: [getattr(part, one.value)] for one in _PLAIN},
    }
    named = [part.width, part.length, part.thickness, part.height, part.depth]
    if part.kind in (PartKind.FILLET, PartKind.ROUND, PartKind.BEND):
        named = [part.radius]
    elif part.diameter is not None:
        named = across
    return [value for value in own.get(measure, named) if value is not None]
