"""Which parts fit a reading? Tags, names, threads, colours, places, and sizes among parts of one kind."""

from __future__ import annotations

import colorsys
import math
from collections.abc import Iterable, Sequence
from dataclasses import replace

from querycad_contracts import Part, Side
from querycad_segworker.tolerances import FACING
from querycad_segworker.vectors import dot, sub

from .lexicon import Choice, Lexicon, Pick, words_of
from .names import bodies_marked, bodies_named, is_whole
from .places import (
    TOUCH_M,
    coaxial,
    encloses,
    held,
    is_inside,
    lies_between,
    lies_in_wall,
    next_to,
    stands_out,
    touches,
)
from .reading import SIDE_WORDS, Place, Reading
from .roles import ROLES, Kinds
from .sizes import SAME_SIZE, SIZE_CONFIDENCE, at_ends, by_size, measure, ordered, outstanding

THREAD_TOLERANCE_M = 0.06e-3
"""A bore this near to a standard diameter has it: half the step between neighbouring tap drill sizes."""
LOOSE_PLACE_CONFIDENCE = 0.5
"""What is left when the place that a description names could not be checked."""
PRESUMED_CONFIDENCE = 0.6
"""A side is surer than other words: what is visible there is rather meant than what the words fit elsewhere."""
PURPOSE_CONFIDENCE = 0.9
"""A purpose ('for the dowel pins') hardly ever changes which parts are meant."""
WIDE = 0.7
"""A flange or plate is at least this wide, compared with the widest: two flanges of a pipe differ by less."""
_HOLDING = (
    "in", "of", "on", "at", "from", "to", "by", "inside", "within", "into", "onto", "through", "across", "along",
)  # fmt: skip
_TRAITS = ("with", "without")
_CORNER = "corner"
_SIDE = "side"
_WALL = "wall"
"""The term whose places are known by where they lie: a box's walls are rarely parts of their own."""
_IMPLIED = {
    "chamfer": ("beveled", "chamfered"),
    "round": ("rounded",),
    "fillet": ("rounded",),
    "hole": ("circular", "cylindrical", "hollow"),
    "gear": ("toothed",),
}
"""Attributes that all parts of a kind have."""
_OUTSIDE = frozenset(("groove", "outer", "turned"))
"""A groove that runs around a rim, tyre or shaft is on its outside."""
_TURNED = {"vertical": "horizontal", "horizontal": "vertical"}
"""A plate whose axis, the direction across it, is vertical is a horizontal plate."""
_DIRECTIONS = frozenset(("vertical", "horizontal"))
_OF_TEETH = ("axis", "radius", "diameter", "radii")
_FASTENERS = frozenset(("screw", "nut"))


class Parts:
    """The parts of one model, with what they are to one another."""

    def __init__(self, parts: Sequence[Part], words: Lexicon) -> None:
        self.all = parts
        self.words = words
        self.kinds = Kinds(parts)
        self._roles: dict[tuple[str, str], bool] = {}
        self.bodies = self.kinds.get("body")
        self.alone = len(self.bodies) == 1
        self.model = next((part for part in parts if part.kind == "model"), None)
        lettering = [body for body in self.bodies if _name_holds(body.name, words.terms["logo"].choices[0].name)]
        self._lettering = (
            frozenset(face for body in lettering for face in body.faces) if not self.alone else frozenset()
        )
        self._cores = sorted(words.cores)

    def named(self, reading: Reading, sides: Sequence[Side] | None) -> list[Part]:
        """The bodies that the words name; adjectives that hold for none of them say nothing more, but denials do."""
        found = bodies_named(self.all, reading.words, sides)
        kept = self._narrowed(found, reading) if found else []
        return kept or ([] if reading.without else found)

    def as_named(self, bodies: list[Part], reading: Reading) -> list[Part]:
        """The same bodies; one that is called a gear is as wide as its teeth reach, and turns about their axis."""
        if reading.term is None or reading.term.choices[0].kind != ("gear",):
            return bodies
        measured = []
        for body in bodies:
            gears = [part for part in self.all if part.kind == "gear" and set(part.faces) <= set(body.faces)]
            update = {name: getattr(gears[0], name) for name in _OF_TEETH} if len(gears) == 1 else {}
            measured.append(body.model_copy(update=update))
        return measured

    def marked(self, reading: Reading) -> list[Part]:
        """The bodies whose names hold all words of the description, such as a standard's number."""
        words = [*reading.words[:-1], *reading.words[-1:]]
        return bodies_marked(self.bodies, words) if len(self.bodies) > 1 else []

    def choose(
        self, reading: Reading, sides: Sequence[Side] | None = None, among: Sequence[Part] | None = None
    ) -> list[Part]:
        """The parts of the first reading of the term that finds any, wherever they can be seen from.

        Readings that hold at the place named come first. `sides` do not change which reading it is, but for two things:
        what is visible from nowhere is not meant, and 'the largest' is the largest of those visible from there.
        """
        assert reading.term is not None
        self._cores = sorted({*self._cores, *(self.words.threads[name][0] for name in reading.threads)})
        choices = list(reading.term.choices)
        if reading.colors:
            choices.append(Choice(("body",), confidence=0.7))
        # The name of a single body says what the whole is, not which of its features is meant: looked at last.
        choices.sort(key=lambda choice: self.alone and bool(choice.name))
        unseen: list[Part] = []
        for loose, choice in [(False, choice) for choice in choices] + [(True, choice) for choice in choices]:
            if (choice.alone and not self.alone) or (choice.several and self.alone):
                continue
            if (choice.kind == ("model",) or choice.alone) and is_narrowed(reading, sides):
                continue  # 'the handle on the right' is a part of the model
            found = without_twins([part for part in (self.all if among is None else among) if self._fits(part, choice)])
            found = found if reading.places else self._but_letters(found)
            found = self._narrowed(found, reading, loose)
            found = self._picked(seen_from(found, sides) or found, choice.pick, reading.count) if choice.pick else found
            for place in reading.places:  # 'the plate without the boss' is the plate: traits are looked at last
                if found and place.relation in _TRAITS:
                    found = self._placed(found, place, reading, loose)
            found = self._steps(found, choice.step) if choice.step else found
            if unseen and not (choice.also and seen_from(found, sides)):
                return unseen
            if found and (sides is None or any(part.sides for part in found)):
                following = choices.index(choice) + 1
                if following < len(choices) and choices[following].also and not seen_from(found, sides):
                    unseen = found
                    continue
                if choice.confidence < 1.0:
                    reading.doubt(f"'{reading.phrase}' was taken in a wider sense", choice.confidence)
                return found
        return unseen

    def presumed(self, found: Sequence[Part], reading: Reading, sides: Sequence[Side]) -> list[Part]:
        """'The bleed screw hole on the left' is there: where one is meant, its side is surer than what else is said.

        Of the same kind of parts visible from there, those that the noun means in any sense, then those that its last
        word means, then those without adjectives; else what lies towards that side, though something covers it.
        """
        assert reading.term is not None
        kinds = {part.kind for part in found}
        visible = [part for part in seen_from(self.all, sides) if part.kind in kinds]
        term = self.words.terms.get(reading.phrase.split()[-1], reading.term)
        sizes = [adjective for adjective in reading.adjectives if adjective.order]
        for noun, said in ((reading.term, reading.adjectives), (term, reading.adjectives), (term, sizes)):
            wider = replace(reading, term=noun, adjectives=said, places=list(reading.places), notes=[])
            if visible and (kept := self.choose(wider, sides, visible)):
                words = " ".join(reading.words)
                reading.doubt(f"'{words}' was taken as what is visible from there", PRESUMED_CONFIDENCE)
                return kept
        covered = [part for part in found if any(self._lies_towards(part, side) for side in sides)]
        if covered:
            reading.doubt(f"none is visible from the {sides[0]}: what lies there was taken", PRESUMED_CONFIDENCE)
        return at_ends(covered, sides[:1], self.model)

    def _lies_towards(self, part: Part, side: Side) -> bool:
        """Does it lie in that half of the model?"""
        return self.model is not None and dot(sub(part.center, self.model.center), side.outward) > TOUCH_M

    def told_apart(self, found: list[Part], reading: Reading, sides: Sequence[Side] | None = None) -> list[Part]:
        """Of several parts, those that are the large ones, the outer ones, or as many as the description says."""
        for adjective in reading.adjectives:
            tagged = [part for part in found if self._has(part, adjective.tags)]
            if adjective.order and len(tagged) in (0, len(found)):
                found = ordered(found, adjective, reading, self.model)
        for side in reading.ends:
            if not all(_names_side(part, side) for part in found):
                found = at_ends(found, (side,), self.model)
        if reading.one:
            raised = all(stands_out(part) for part in found)  # 'the flange on the top' is the topmost
            toward = sides if sides and len(sides) == 1 and raised else reading.toward
            return outstanding(at_ends(found, toward, self.model), reading, self.model)
        wanted = reading.count
        if wanted is None or wanted < 2 or len(found) == wanted or len(found) < 2:
            return found
        groups = [group for group in by_size(found) if len(group) == wanted]
        if len(found) > wanted and len(groups) == 1:
            reading.doubt(f"of {len(found)} the {wanted} of one size were taken", SIZE_CONFIDENCE)
            return groups[0]
        if any(place.relation == "" for place in reading.places):  # 'the five wheel bolt holes' need not be in a wheel
            wider = replace(reading, places=[place for place in reading.places if place.relation], notes=[])
            groups = [group for group in by_size(seen_from(self.choose(wider, sides), sides)) if len(group) == wanted]
            if len(groups) == 1:
                reading.doubt(f"the model has {wanted} of one size, elsewhere than the words say", SIZE_CONFIDENCE)
                return groups[0]
        reading.doubt(f"the model has {len(found)} of them, not {wanted}", SIZE_CONFIDENCE)
        return found

    def tags(self, part: Part, asked: Iterable[str] = ()) -> set[str]:
        """The part's own tags, those of its kind, and of what it is to other parts those `asked` for."""
        tags = {*part.tags, *_IMPLIED.get(part.kind, ())}
        if part.kind == "prism" and "plate" in tags:
            tags = {_TURNED.get(tag, tag) for tag in tags}
        if part.kind == "hole" and part.diameter is not None:
            if any(abs(part.diameter - core) <= THREAD_TOLERANCE_M for core in self._cores):
                tags.add("core_diameter")
        return tags | {role for role in asked if role in ROLES and role not in tags and self._plays(part, role)}

    def _plays(self, part: Part, role: str) -> bool:
        if (part.id, role) not in self._roles:
            self._roles[part.id, role] = ROLES[role](part, self.kinds)
        return self._roles[part.id, role]

    def _has(self, part: Part, tags: Sequence[str]) -> bool:
        """Does it have one of the tags?"""
        return not self.tags(part, tags).isdisjoint(tags)

    def _tagged(self, found: Sequence[Part], tags: Sequence[str]) -> bool:
        return any(self._has(part, tags) for part in found)

    def _fits(self, part: Part, choice: Choice) -> bool:
        if part.kind not in choice.kind:
            return False
        tags = self.tags(part, (*choice.tags, *choice.any, *choice.without))
        return (
            tags.issuperset(choice.tags)
            and (not choice.any or not tags.isdisjoint(choice.any))
            and tags.isdisjoint(choice.without)
            and (not choice.name or _name_holds(part.name, choice.name))
        )

    def _narrowed(self, found: list[Part], reading: Reading, loose: bool = True) -> list[Part]:
        """Those that adjectives, threads and colours hold for, and that lie in the places named.

        `loose`: a place that cannot be checked is left out.
        """
        for adjective in reading.adjectives:
            if set(adjective.tags) <= _DIRECTIONS and adjective.tags and not self._tagged(found, tuple(_DIRECTIONS)):
                continue  # corners and flat parts have no axis that could be vertical
            shared = adjective.order and all(self._has(part, adjective.tags) for part in found)
            if adjective.tags and not shared and (not adjective.order or self._tagged(found, adjective.tags)):
                kept = [part for part in found if self._has(part, adjective.tags)]
                wider = [part for part in found if self._has(part, adjective.fallback)]
                if adjective.loose and found and not kept and not wider and not any(p.kind == "hole" for p in found):
                    note = f"'{adjective.name}' was not checked: such details are often not modelled"
                    reading.doubt(note, LOOSE_PLACE_CONFIDENCE)
                    continue
                if wider and not kept and adjective.fallback_confidence < 1.0:
                    reading.doubt(f"'{adjective.name}' was taken in a wider sense", adjective.fallback_confidence)
                found = kept or wider
        for adjective in reading.without:
            sure = adjective.fallback if adjective.fallback_confidence == 1.0 else ()
            found = [part for part in found if not self._has(part, (*adjective.tags, *sure))]
        found = [part for part in found if all(self._has_thread(part, name) for name in reading.threads)]
        found = [part for part in found if all(self._has_color(part.color, name) for name in reading.colors)]
        for place in reading.places:
            if found and place.relation not in _TRAITS:
                found = self._placed(found, place, reading, loose)
        return found

    def _but_letters(self, found: list[Part]) -> list[Part]:
        """Without the gaps and strokes of letters: they are meant only where nothing else is."""
        features = [p for p in found if p.kind not in ("body", "model")]
        letters = {p.id for p in features if self._lettering.issuperset(p.faces)}
        return [p for p in found if p.id not in letters] if len(letters) < len(features) else found

    def _has_thread(self, part: Part, name: str) -> bool:
        if part.kind == "body":
            return bool(bodies_marked([part], [name.partition("x")[0]]))  # the 20 of an 'M5x20' is its length
        return part.diameter is not None and any(
            abs(part.diameter - d) <= THREAD_TOLERANCE_M for d in self.words.threads[name]
        )

    def _has_color(self, color: str | None, name: str) -> bool:
        return has_color(color, name, self.words.hues)

    # Places

    def _placed(self, found: list[Part], place: Place, reading: Reading, loose: bool) -> list[Part]:
        """Those at a place. One that cannot be checked is said to be left out, unless it is a body of an assembly."""
        said = f"'{place.relation} {' '.join(place.what.words)}'".replace("' ", "'")
        if place.relation == "for":
            reading.doubt(f"{said} is not checked", PURPOSE_CONFIDENCE)
            return found
        if (kept := self._by_position(found, place)) is not None:
            return kept
        holders = self.named(place.what, None)
        if not holders and place.relation in _HOLDING and is_whole(self.all, place.what.words):
            return found
        holders = holders or self._holders(place.what)
        if any(holder.kind == "model" for holder in holders):
            return found
        kept = self._related(found, place.relation, holders)
        if kept or not loose or (place.relation in _HOLDING and holders and all(h.kind == "body" for h in holders)):
            return kept
        if place.relation == "without" and holders and len(found) > 1:
            return kept
        seen = seen_from(found, place.what.ends) if place.what.ends and not holders else []
        instead = "what is visible from there was taken" if seen else "was left out"
        reading.doubt(f"{said} could not be checked{':' if seen else ' and'} {instead}", LOOSE_PLACE_CONFIDENCE)
        return seen or found

    def _by_position(self, found: list[Part], place: Place) -> list[Part] | None:
        """Those at a place that is known without parts that make it; None where it is not of that kind."""
        ends, term = place.what.ends, place.what.term
        kept: list[Part] = []
        if place.relation == "around":
            kept = [part for part in found if {part.kind, *part.tags} >= _OUTSIDE]
        elif term is self.words.terms[_WALL] and ends and self.model and place.relation in _HOLDING:
            if any(part.normal or part.axis for part in found):
                return [part for part in found if all(lies_in_wall(part, side, self.model) for side in ends)]
        elif place.what.words == [_SIDE] and place.relation in _HOLDING:  # neither from above nor from below
            directions = [(part, part.normal or part.axis) for part in found]
            kept = [part for part, along in directions if along is not None and abs(along[2]) < FACING.side]
        elif term is self.words.terms[_CORNER] and all(part.kind.breaks_edge for part in found):
            kept = at_ends(found, ends, self.model)  # a bevel at the corner is the corner
        return kept or None

    def _holders(self, place: Reading) -> list[Part]:
        if place.term is None or place.head_unknown:
            return []
        return self.told_apart(self.choose(place), place)

    def _related(self, found: list[Part], relation: str, holders: Sequence[Part]) -> list[Part]:
        """Those that stand so to one of the holders; none where the relation is not known."""
        match relation:
            case "with":
                having = [p for p in found if any(h.id != p.id and is_inside(h, p) for h in holders)]
                return having or next_to(found, holders)
            case "without":
                return [p for p in found if not any(h.id != p.id and is_inside(h, p) for h in holders)]
            case "near":
                return next_to(found, holders)
            case "between" if len(holders) > 1:
                return [p for p in found if p.id not in {h.id for h in holders} and lies_between(p, holders)]
            case "around":
                around = [p for p in found if any(encloses(p, h) for h in holders)]
                if not around and all(p.kind.breaks_edge for p in found):
                    return next_to(found, holders)
                return around or [p for p in found if not any(coaxial(p, h) for h in holders)]
            case _ if relation in (*_HOLDING, ""):
                return held(found, relation, holders)
        return []

    # Picks and sizes

    def _picked(self, found: list[Part], pick: Pick, count: int | None = None) -> list[Part]:
        if not found:
            return found
        if pick == "lowest":
            lowest = min(part.center[2] - part.extents[2] / 2 for part in found)
            near = 0.02 * max(part.extents[2] for part in found) + 1e-9
            return [part for part in found if part.center[2] - part.extents[2] / 2 <= lowest + near]
        if pick == "elongated":
            long = [part for part in found if part.kind == "slot" or {"elongated", "obround"} & set(part.tags)]
            return [part for part in long if not any(_leads_on(part, other) for other in long)]
        if pick == "standing":
            return [part for part in found if self._stands(part)]
        if pick == "most":
            groups = by_size(found)
            return max(groups, key=len) if max(map(len, groups)) > 2 else []
        sizes = [measure(part, "size") for part in found]
        if pick == "wide":
            return [part for part, size in zip(found, sizes, strict=True) if size >= WIDE * max(sizes)]
        ranked = sorted(sizes, reverse=pick != "smallest")
        limits = ranked[: count or 1]  # 'the two bearing bores' are the two largest
        return [part for part, size in zip(found, sizes, strict=True) if any(abs(size - s) <= 1e-3 * s for s in limits)]

    def _stands(self, part: Part) -> bool:
        """Does it stand out of its body, instead of being the body's own outline?"""
        body = next((b for b in self.bodies if set(part.faces) <= set(b.faces)), None)
        if body is None or body.diameter is None or part.diameter is None:
            return True
        return part.diameter < body.diameter / SAME_SIZE or self._stands_out(body)

    def _stands_out(self, body: Part) -> bool:
        """Is it, as a whole, what stands out of another body that is larger across its axis? Fasteners are not."""
        axis = body.axis
        if axis is None or not _FASTENERS.isdisjoint(body.tags):
            return False
        along = max(range(3), key=lambda i: abs(axis[i]))
        for other in self.bodies:
            if other.id == body.id or not touches(body, other):
                continue
            apart = [abs(a - b) for a, b in zip(body.center, other.center, strict=True)]
            larger = all(
                other.extents[i] > SAME_SIZE * body.extents[i] and apart[i] <= other.extents[i] / 2
                for i in range(3)
                if i != along
            )
            if larger and apart[along] + body.extents[along] / 2 > other.extents[along] / 2 + TOUCH_M:
                return True
        return False

    def _steps(self, holes: Sequence[Part], step: str) -> list[Part]:
        """The cylindrical wall of the widest or the narrowest step of each hole, visible from where it opens."""
        walls = []
        for hole in holes:
            walls_of = [p for p in self.all if p.kind == "cylinder" and "inner" in p.tags]
            inner = [p for p in walls_of if p.radius and set(p.faces) <= set(hole.faces)]
            pick = max if step == "widest" else min
            wall = pick(inner, key=lambda part: part.radius or 0.0, default=None)
            if wall is not None and len({round(p.radius or 0.0, 7) for p in inner}) > 1:
                opening = tuple(s for s in hole.sides if hole.normal and dot(s.outward, hole.normal) > 0.5)
                walls.append(wall.model_copy(update={"sides": opening or hole.sides}))
        return walls


def _names_side(part: Part, side: Side) -> bool:
    """Is the side a word of the body's own name: 'left leaf'?"""
    return any(word in SIDE_WORDS[side] for word in words_of((part.name or "").replace("_", " ")))


def seen_from(found: Sequence[Part], sides: Sequence[Side] | None) -> list[Part]:
    """Those visible from any of the sides; all when None."""
    return [part for part in found if sides is None or set(sides) & set(part.sides)]


def is_narrowed(reading: Reading, sides: Sequence[Side] | None) -> bool:
    """Does the description say which of several, so that it cannot be the whole model?"""
    return bool(sides or reading.toward or reading.count) or any(place.relation for place in reading.places)


def _leads_on(part: Part, other: Part) -> bool:
    """Is it the counterbore of a slot that goes on through its floor, and so no slot of its own?"""
    return other.kind == "cutout" and other.id in part.children and "obround" in part.tags and "obround" in other.tags


def without_twins(found: list[Part]) -> list[Part]:
    """Without those that are another one over again, as a protrusion is a block: most of their faces are the same."""
    kept: list[Part] = []
    for part in found:
        twins = (p for p in kept if p.kind != part.kind and p.kind.stands_out and part.kind.stands_out)
        faces = set(part.faces)
        if not any(2 * len(faces & set(p.faces)) > min(len(faces), len(p.faces)) for p in twins):
            kept.append(part)
    return kept


def turned_to(found: list[Part], sides: Sequence[Side]) -> list[Part]:
    """Of what stands out, those that stand towards the sides where any does: a pin is on the top when it points up."""
    turned = [p for p in found if p.normal and any(dot(p.normal, side.outward) > FACING.side for side in sides)]
    standing = [p for p in found if p.kind.stands_out]
    return [p for p in found if p not in standing or p in turned] if any(p in turned for p in standing) else found


def has_color(color: str | None, name: str, hues: dict[str, tuple[float, float]]) -> bool:
    """Does a hexadecimal colour go by this name? Greys by saturation below 15 %, black and white by brightness."""
    if color is None:
        return False
    r, g, b = (int(color[i : i + 2], 16) / 255 for i in (1, 3, 5))
    hue, saturation, value = colorsys.rgb_to_hsv(r, g, b)
    if name == "black":
        return value < 0.2
    if name == "white":
        return saturation < 0.15 and value > 0.9
    if name in ("grey", "gray", "silver"):
        return saturation < 0.15 and 0.2 <= value <= 0.9
    low, high = hues[name]
    degrees = math.degrees(hue * math.tau)
    inside = low <= degrees < high if low < high else degrees >= low or degrees < high
    return saturation >= 0.15 and value >= 0.2 and inside


def _name_holds(name: str | None, wanted: Iterable[str]) -> bool:
    """Does a product name hold one of these words, or runs of words such as 'iso 4762'?"""
    text = f" {' '.join(words_of((name or '').replace('_', ' ')))} "
    return any(f" {word} " in text or f" {word}s " in text for word in wanted)
