"""Do words and pictures mean the same parts? What vision found is put beside what geometry recognised (stage 7).

A find snaps to the recognised part that it mostly covers: that part has exact measures, and faces that no view shows.
Where geometry knows the words it decides, since it reads exact surfaces; vision makes it surer, chooses where geometry
is not more than half sure, and is alone where geometry knows nothing.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from typing import TYPE_CHECKING

import numpy as np
from numpy.typing import NDArray

from querycad_contracts import Evidence, Face, Grounding, Part, Side
from querycad_segworker.visibility.sides import faces_seen

from .region import region

if TYPE_CHECKING:  # the pipeline brings OpenCV, and eyes fuse without it
    from querycad_segworker.segcad.merge import Find
    from querycad_segworker.segcad.pipeline import Seen

MOSTLY = 0.5
"""A find covers a part mostly when it holds more than this share of the part's visible surface, and the part more than
this share of the find's: then no other part without common faces can be meant as well."""
HALF_SURE = 0.5
"""Up to here geometry itself says that its parts are at most half of what the words ask for."""


@dataclass(frozen=True, slots=True)
class Sighting:
    """One part that vision found."""

    part: Part
    """The recognised part that it snapped to; else one made of the faces found."""
    score: float
    views: tuple[str, ...]
    snapped: bool

    @property
    def reason(self) -> str:
        """Where was it seen?"""
        return f"seen from {', '.join(self.views)}, score {self.score:.2f}"


def sightings(
    seen: Seen,
    phrase: str,
    parts: Sequence[Part],
    faces: Sequence[Face],
    expected: Sequence[Part] = (),
) -> list[Sighting]:
    """Which parts did vision find? Finds of the same part are one; `expected` ones are preferred where several fit.

    parts: as recognised. faces: all of the model, by id. Without a part to snap to, the sides are those that show one
    of the faces.
    """
    weight = (seen.visibility.pixels * (seen.visibility.pixel_m**2)[:, None]).max(axis=0)
    found: dict[str, Sighting] = {}
    for find in seen.finds:
        snapped = _mostly(find, expected, weight) or _mostly(find, parts, weight)
        part = snapped or region(phrase, [faces[face] for face in sorted(find.faces)], _sides(find, faces, seen))
        known = found.get(part.id)
        views = tuple(dict.fromkeys((*(known.views if known else ()), *find.views)))
        score = max(find.score, known.score if known else 0.0)
        found[part.id] = Sighting(part, score, views, snapped is not None)
    return list(found.values())


def _mostly(find: Find, parts: Sequence[Part], weight: NDArray[np.float64]) -> Part | None:
    """The part that the find mostly covers; of several the most alike, by visible area in both over area in either."""
    best, most = None, 0.0
    own = float(weight[list(find.faces)].sum())
    for part in parts:
        common = float(weight[list(find.faces.intersection(part.faces))].sum())
        whole = float(weight[list(part.faces)].sum())
        if common > MOSTLY * whole and common > MOSTLY * own and common / (own + whole - common) > most:
            best, most = part, common / (own + whole - common)
    return best


def _sides(find: Find, faces: Sequence[Face], seen: Seen) -> tuple[Side, ...]:
    shown = faces_seen([face.area for face in faces], seen.visibility)[:, list(find.faces)]
    return tuple(side for row, side in enumerate(Side) if shown[row].any())


def by_vision(phrase: str, sides: Sequence[Side] | None, found: Sequence[Sighting]) -> Grounding:
    """What does `phrase` mean by sight alone, of what is visible from any of `sides`?"""
    wanted = [one for one in found if sides is None or set(sides) & set(one.part.sides)]
    message = ""
    if not wanted:
        place = f" visible from {' or '.join(sides)}" if sides and found else ""
        message = f"nothing that looks like '{phrase}' was seen{place}"
    return Grounding(
        description=phrase,
        sides=None if sides is None else tuple(sides),
        parts=tuple(_by_sight(one) for one in sorted(wanted, key=lambda one: one.part.id)),
        understood=True,
        message=message,
    )


def _by_sight(one: Sighting) -> Part:
    reason = f"{one.reason}; it mostly covers {one.part.id}" if one.snapped else one.reason
    evidence = Evidence(source="vision", confidence=min(1.0, one.score), reason=reason)
    return one.part.model_copy(update={"evidence": evidence})


def fuse(geometry: Grounding, found: Sequence[Sighting]) -> Grounding:
    """What do the words mean when both kinds of evidence are taken together? `found` is of all sides."""
    if not geometry.parts:
        return _vision_decides(geometry, found)
    seen = {one.part.id: one for one in found}
    agreed = [_agreed(part, seen[part.id]) for part in geometry.parts if part.id in seen]
    missed = [_missed(part) for part in geometry.parts if part.id not in seen]
    warnings = list(geometry.warnings)
    if agreed and missed and all(part.evidence.confidence <= HALF_SURE for part in geometry.parts):
        warnings.append(f"of {len(geometry.parts)} parts that geometry is not sure of, {len(agreed)} were also seen")
        missed = []
    known = {part.id for part in geometry.parts}
    others = [one for one in found if one.part.id not in known and _shown(one.part, geometry.sides)]
    if others:
        listed = ", ".join(f"{one.part.id} ({one.part.label})" for one in others)
        warnings.append(f"vision takes for '{geometry.description}' as well, geometry does not: {listed}")
    both = {part.id: part for part in (*agreed, *missed)}
    ordered = tuple(both[part.id] for part in geometry.parts if part.id in both)
    return geometry.model_copy(update={"parts": ordered, "warnings": tuple(warnings)})


def _vision_decides(geometry: Grounding, found: Sequence[Sighting]) -> Grounding:
    """Geometry does not know the words, or has none of it: what was seen is all there is."""
    sight = by_vision(geometry.description, geometry.sides, found)
    if not sight.parts:
        note = f"{geometry.message}; {sight.message}" if geometry.message else sight.message
        return geometry.model_copy(update={"message": note})
    warnings = (*geometry.warnings, f"found by sight alone: {geometry.message}")
    return sight.model_copy(update={"warnings": warnings})


def _shown(part: Part, sides: Sequence[Side] | None) -> bool:
    return sides is None or bool(set(sides) & set(part.sides))


def _agreed(part: Part, sighting: Sighting) -> Part:
    """Two kinds of evidence that fail independently are both wrong with the product of their doubts."""
    doubt = (1 - part.evidence.confidence) * (1 - min(1.0, sighting.score))
    return _with_evidence(part, "fused", 1 - doubt, f"vision agrees: {sighting.reason}")


def _missed(part: Part) -> Part:
    why = "vision did not find it" if part.sides else "vision cannot see it: it is hidden from all sides"
    return _with_evidence(part, part.evidence.source, part.evidence.confidence, why)


def _with_evidence(part: Part, source: str, confidence: float, note: str) -> Part:
    changed = Evidence(source=source, confidence=confidence, reason=f"{part.evidence.reason}; {note}")
    return part.model_copy(update={"evidence": changed})
