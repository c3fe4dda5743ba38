"""Poses, axes, grasps and mates at the parts that a question is about."""

from __future__ import annotations

from collections.abc import Callable, Mapping, Sequence
from dataclasses import dataclass, replace
from typing import Any

from querycad_answering.judging import judge
from querycad_answering.understanding import Run
from querycad_contracts import AnswerRecord, AnswerType, Part, PartKind, Program, RunStatus, Vector
from querycad_contracts.parameters import Axis, Mate, ParameterRequest, ParameterType, Pose
from querycad_contracts.vectors import scale

from .candidate_values import Candidates, Found
from .ends import End, ends_of, is_end
from .formatting import Telling, number_text, triple_text
from .frames import MODEL, Rigid, axis, told
from .grasping import FACES, PLANES, Flat, grasps
from .mating import Fit, fits

FRAME = """frame = find_parts({{"ids": ["{part}"]}})[0].frame
solution = [list(frame.origin), list(frame.x), list(frame.y), list(frame.z)]"""
READINGS = 4
"""Of a question that are looked at: what is told beside the best."""
AT_MOST = 8
"""Parts that a question may name before nobody could choose among them."""
ASSEMBLED, ONLY_ONE, ONE_OF = 0.9, 0.7, 0.4
"""How sure are mates? What the file has assembled is meant, unless the recognition missed a hole or a shaft; where each
shaft has one hole that it fits, nothing but the size says so; where one has several, somebody has to choose. These are
judgements, not measured."""


@dataclass(frozen=True, slots=True)
class Reading:
    """One way to take a question: the parts that it is about, and the place that it gives, if it is one."""

    parts: tuple[Part, ...]
    place: Vector | None
    confidence: float
    understood_as: str
    code: str | None


def frame_of(part: Part, run: Run) -> Rigid | None:
    """A part's own axes; those of the file, at its centre, for what has none, as a block."""
    if part.kind is PartKind.MODEL:
        return replace(MODEL, origin=part.center)
    outcome = run(Program(code=FRAME.format(part=part.id), codegen="parser"))
    if outcome.status is not RunStatus.OK or not isinstance(outcome.value, list):
        return replace(MODEL, origin=part.center) if part.kind is PartKind.BODY else None
    origin, x, y, z = (tuple(each) for each in outcome.value)
    return Rigid(origin, x, y, z)


@dataclass(frozen=True, slots=True)
class Placing:
    """What there is at parts of one model. `parts` are all of them, by id."""

    parts: Mapping[str, Part]
    run: Run
    telling: Telling

    def readings(self, record: AnswerRecord) -> list[Reading]:
        """The ways to take the question, the best first; of the others, their programs tell the parts."""
        assert record.answer is not None
        sure = record.confidence if record.confidence is not None else 0.0
        found = [
            Reading(
                self._known(record.parts),
                _place(record.answer.type, record.answer.value),
                sure,
                record.understood_as,
                record.code,
            )
        ]
        for other in record.alternatives[: READINGS - 1]:
            program = Program(code=other.code, codegen=other.codegen, expects=other.answer.type)
            verdict = judge(program, self.run(program))
            if verdict.answer is not None and other.confidence is not None:
                place = _place(verdict.answer.type, verdict.answer.value)
                parts = self._known(verdict.parts)
                found.append(Reading(parts, place, other.confidence, other.understood_as, other.code))
        return found

    def at(self, one: ParameterRequest, reading: Reading) -> Candidates:
        """What is wanted, at each of the parts that a reading is about."""
        parts = reading.parts or tuple(part for part in self.parts.values() if part.kind is PartKind.MODEL)
        several = ""
        if len(parts) > 1:
            several = f"{len(parts)} parts are meant: {', '.join(part.id for part in parts[:AT_MOST])}"
        candidates = Candidates(reason=several)
        for part in parts[:AT_MOST]:
            share = replace(reading, confidence=reading.confidence / len(parts))
            if one.type is ParameterType.GRASPS:
                found, reason = self._grasps(one, part, share)
            else:
                found, reason = self._ends(one, part, share)
            candidates.found += found
            candidates.reason = "; ".join(filter(None, (candidates.reason, reason)))
        return candidates

    def mates(
        self,
        one: ParameterRequest,
        parts: Sequence[Part],
        other: Callable[[], Sequence[Part]] | None,
        other_id: str | None,
    ) -> Candidates:
        """Which hole takes which shaft, in this model, or between it and the other one?"""
        found = fits(parts, other() if other is not None else None)
        if not found:
            return Candidates(reason=_no_mates(parts, other is not None))
        shafts: dict[str, list[Fit]] = {}
        for fit in found:
            shafts.setdefault(f"{fit.models[1]}:{fit.shaft.id}", []).append(fit)
        choices = max(len({(fit.hole.diameter, fit.hole.id) for fit in each}) for each in shafts.values())
        sure = ASSEMBLED if all(fit.assembled for fit in found) else ONLY_ONE if choices == 1 else ONE_OF
        ids = (None, other_id)
        pairs = [fit.told(self.telling.metres, ids) for fit in found]
        text = ", ".join(_mate_text(mate, self.telling.unit.value) for mate in pairs[:AT_MOST])
        rests_on = tuple(dict.fromkeys(part for fit in found for part in (fit.hole, fit.shaft)))
        mates = Found(pairs, text, sure, "which hole takes which shaft", rests_on)
        reason = f"a shaft fits {choices} holes: which one it goes into is a choice" if sure == ONE_OF else ""
        return Candidates([mates], reason, one.question or "")

    def _ends(self, one: ParameterRequest, part: Part, reading: Reading) -> tuple[list[Found], str]:
        found = ends_of(part, one.side, reading.place)
        if not found.ends:
            if one.type is ParameterType.POSE and one.side is None:
                return self._own_pose(part, reading)
            where = f" on the {one.side.value}" if one.side is not None else ""
            return [], f"{part.id} has neither an opening nor a free end{where}: say from which `side` it is come at"
        ends = found.ends[:1] if found.told_apart else found.ends
        at_each = [self._found(one, part, end, reading, reading.confidence / len(ends)) for end in ends]
        reason = "" if found.told_apart else f"{part.id} has {len(ends)} ends that are alike: say which by `side`"
        return at_each, reason

    def _found(self, one: ParameterRequest, part: Part, end: End, reading: Reading, confidence: float) -> Found:
        if one.type is ParameterType.POINT:
            return self._of(told(self.telling.frame.point(end.point), self.telling.metres), part, reading, confidence)
        if one.type is ParameterType.POSE:
            place = end.point if reading.place is None or is_end(part, reading.place) else reading.place
            own = frame_of(part, self.run)
            pose = Rigid.along(place, scale(end.outward, -1.0), own.x if own is not None else None)
            return self._of(self._pose(pose), part, reading, confidence)
        way = scale(end.outward, -1.0) if one.type is ParameterType.APPROACH else end.outward
        return self._of(axis(end.point, way, self.telling.frame, self.telling.metres), part, reading, confidence)

    def _own_pose(self, part: Part, reading: Reading) -> tuple[list[Found], str]:
        """Of what is come at from nowhere in particular: its own axes."""
        own = frame_of(part, self.run)
        if own is None:
            return [], f"{part.id} has no axes of its own"
        placed = replace(own, origin=reading.place or part.center)
        return [self._of(self._pose(placed), part, reading, reading.confidence)], ""

    def _pose(self, pose: Rigid) -> Pose:
        return self.telling.frame.seen(pose).pose(self.telling.metres)

    def _grasps(self, one: ParameterRequest, part: Part, reading: Reading) -> tuple[list[Found], str]:
        faces = "faces()" if part.kind is PartKind.MODEL else "part.faces"
        code = PLANES.format(part=part.id, faces=faces, most=FACES)
        outcome = self.run(Program(code=code, codegen="parser"))
        if outcome.status is not RunStatus.OK:
            return [], f"the faces of {part.id} could not be looked at: {outcome.message}"
        at_most = one.at_most * self.telling.metres if one.at_most is not None else None
        flats = [Flat.of(each) for each in outcome.value]
        pairs = grasps(flats, self.telling.frame, self.telling.metres, at_most)
        if not pairs:
            within = f" within {number_text(one.at_most)} {self.telling.unit.value}" if one.at_most is not None else ""
            return [], f"{part.id} has no opposite parallel faces{within}"
        found = self._of(pairs, part, reading, reading.confidence)
        found.code = code
        return [found], ""

    def _of(self, value: Any, part: Part, reading: Reading, confidence: float) -> Found:
        text = f"{_value_text(value, self.telling.unit.value)} ({part.id})"
        return Found(value, text, confidence, reading.understood_as, (part,), reading.code)

    def _known(self, parts: Sequence[Part]) -> tuple[Part, ...]:
        """The parts as they were recognised, with their faces and ends."""
        return tuple(self.parts[part.id] for part in parts if part.id in self.parts)


def _place(kind: AnswerType, value: Any) -> Vector | None:
    return (float(value[0]), float(value[1]), float(value[2])) if kind is AnswerType.POINT else None


def _value_text(value: Pose | Axis | Vector | list[Any], unit: str) -> str:
    if isinstance(value, tuple):
        return triple_text(value, unit)
    if isinstance(value, Pose):
        ways = [value.matrix[row][2] for row in range(3)]
        return f"at {triple_text(value.position, unit)}, z along {triple_text(ways)}"
    if isinstance(value, Axis):
        return f"from {triple_text(value.point, unit)} along {triple_text(value.direction)}"
    count = f"{len(value)} pairs of faces" if len(value) > 1 else "one pair of faces"
    return f"{count}, the first {number_text(value[0].distance)} {unit} apart"


def _mate_text(mate: Mate, unit: str) -> str:
    fit = f"clearance {number_text(mate.clearance)} {unit}" if mate.clearance else "line to line"
    return f"{mate.shaft} in {mate.hole} ({fit})"


def _no_mates(parts: Sequence[Part], two: bool) -> str:
    holes = {round(part.diameter * 1e3, 3) for part in parts if part.kind is PartKind.HOLE and part.diameter}
    sizes = ", ".join(f"{size:g}" for size in sorted(holes)[:AT_MOST])
    its = f"its holes have {sizes} mm" if holes else "it has no holes"
    return f"no hole takes a shaft of {'the other model' if two else 'another body'}; {its}"
