"""Which hole takes which shaft? By diameter, and by what a file has assembled already."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass

from querycad_contracts import Part, PartKind
from querycad_contracts.parameters import Mate
from querycad_contracts.vectors import cross, dot, norm, scale, sub, unit

from .frames import told_length

LINE_TO_LINE = 1e-6
"""Metres. Diameters that are nominally the same differ by less in a file."""
COAXIAL = 1e-5
"""Metres between two axes that are one, and the sine of the angle between them: recognition's own accuracy."""

LOOSE = 0.25 + 1e-6
"""Of a shaft's diameter: the clearance of the loosest hole that is made for it, M1.6 in 2 mm (ISO 273, coarse). What is
looser has only an axis in common, such as the rings of a bearing."""


@dataclass(frozen=True, slots=True)
class Fit:
    """A hole and a shaft; each with the number of the model that it is of, 0 or 1."""

    hole: Part
    shaft: Part
    models: tuple[int, int]
    assembled: bool

    @property
    def clearance(self) -> float:
        """The hole's diameter less the shaft's, in metres."""
        return (self.hole.diameter or 0.0) - (self.shaft.diameter or 0.0)

    def told(self, metres: float, ids: Sequence[str | None]) -> Mate:
        """As it is told; `ids` are those of the models, None for the one asked about."""
        depth = min(self.hole.depth or 0.0, _length(self.shaft))
        return Mate(
            hole=self.hole.id,
            shaft=self.shaft.id,
            hole_model=ids[self.models[0]],
            shaft_model=ids[self.models[1]],
            hole_diameter=told_length(self.hole.diameter or 0.0, metres),
            shaft_diameter=told_length(self.shaft.diameter or 0.0, metres),
            clearance=0.0 if abs(self.clearance) < LINE_TO_LINE else told_length(self.clearance, metres),
            depth=told_length(depth, metres),
            assembled=self.assembled,
        )


def loosest(diameter: float) -> float:
    """How much larger may a hole be that is made for a shaft? The loosest clearance fit in common use, H11/c11.

    ISO 286-1: tolerance unit i = 0.45 D^(1/3) + 0.001 D micrometres, IT11 = 100 i, deviation c = 52 D^0.2 up to 40 mm
    and 95 + 0.8 D above; the largest clearance is c + 2 IT11. Metres.
    """
    mm = diameter * 1e3
    tolerance_um = 100 * (0.45 * mm ** (1 / 3) + 0.001 * mm)
    deviation_um = 52 * mm**0.2 if mm <= 40 else 95 + 0.8 * mm
    return float(deviation_um + 2 * tolerance_um) * 1e-6


def fits(parts: Sequence[Part], others: Sequence[Part] | None = None) -> list[Fit]:
    """Every hole with every shaft that it takes, the tightest first.

    Of one model, hole and shaft are of different bodies, and where some are assembled only these are told of their
    shafts and holes; of two models, one is of each. A shaft that is a whole body stands for its own boss.
    """
    if others is None:
        holes, shafts, body_of = _holes(parts), _shafts(parts), _bodies(parts)
        pairs = [
            Fit(hole, shaft, (0, 0), _assembled(hole, shaft))
            for hole in holes
            for shaft in shafts
            if body_of.get(hole.id) != body_of.get(shaft.id)
        ]
    else:
        pairs = [Fit(hole, shaft, (0, 1), False) for hole in _holes(parts) for shaft in _shafts(others)]
        pairs += [Fit(hole, shaft, (1, 0), False) for hole in _holes(others) for shaft in _shafts(parts)]
    taken = [fit for fit in pairs if -LINE_TO_LINE <= fit.clearance <= loosest(fit.shaft.diameter or 0.0)]
    # a screw in its clearance hole is looser than any fit, but the file shows that it is meant
    taken += [
        fit
        for fit in pairs
        if fit.assembled and loosest(fit.shaft.diameter or 0.0) < fit.clearance <= LOOSE * (fit.shaft.diameter or 0.0)
    ]
    held = {part for fit in taken if fit.assembled for part in (fit.hole.id, fit.shaft.id)}
    kept = [fit for fit in taken if fit.assembled or (fit.hole.id not in held and fit.shaft.id not in held)]
    return sorted(kept, key=lambda fit: (fit.clearance > LINE_TO_LINE, fit.clearance, fit.hole.id, fit.shaft.id))


def _holes(parts: Sequence[Part]) -> list[Part]:
    return [
        part for part in parts if part.kind is PartKind.HOLE and part.diameter and part.axis and "circular" in part.tags
    ]


def _shafts(parts: Sequence[Part]) -> list[Part]:
    """Bosses that are round, and bodies that are shafts; not the boss that such a body is made of."""
    bodies = [part for part in parts if part.kind is PartKind.BODY and part.diameter and part.axis and part.tips]
    own = {face for body in bodies for face in body.faces}
    bosses = [
        part
        for part in parts
        if part.kind is PartKind.BOSS and part.diameter and part.axis and "cylindrical" in part.tags
    ]
    return bodies + [boss for boss in bosses if not own.issuperset(boss.faces)]


def _bodies(parts: Sequence[Part]) -> dict[str, str]:
    """The body that each part is of, by their ids."""
    body_of_face = {face: part.id for part in parts if part.kind is PartKind.BODY for face in part.faces}
    return {part.id: body_of_face[part.faces[0]] for part in parts if part.faces and part.faces[0] in body_of_face}


def _assembled(hole: Part, shaft: Part) -> bool:
    """Is the shaft in the hole? They share an axis, and overlap along it."""
    assert hole.axis is not None
    assert shaft.axis is not None
    axis, apart = unit(hole.axis), sub(shaft.center, hole.center)
    if norm(cross(axis, unit(shaft.axis))) > COAXIAL or norm(sub(apart, scale(axis, dot(apart, axis)))) > COAXIAL:
        return False
    return abs(dot(apart, axis)) < ((hole.depth or 0.0) + _length(shaft)) / 2 - LINE_TO_LINE


def _length(shaft: Part) -> float:
    """Along its axis."""
    if len(shaft.tips) == 2:
        return norm(sub(shaft.tips[0], shaft.tips[1]))
    return shaft.height or shaft.length or 0.0
