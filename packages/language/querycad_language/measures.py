"""What values of a measure are: of which type, one or several, and which are lengths."""

from __future__ import annotations

from querycad_contracts import AnswerType, Measure, PartKind, Side

WHOLE = frozenset(kind for kind in PartKind if kind.is_whole)
EXTENTS = (Measure.X_EXTENT, Measure.Y_EXTENT, Measure.Z_EXTENT)
ENDS = {
    Measure.TOP_END: Side.TOP, Measure.BOTTOM_END: Side.BOTTOM, Measure.LEFT_END: Side.LEFT,
    Measure.RIGHT_END: Side.RIGHT, Measure.FRONT_END: Side.FRONT, Measure.BACK_END: Side.BACK,
}  # fmt: skip
"""The side that each end of a part lies on."""
_TYPES = {
    Measure.SIZE: AnswerType.SIZE, Measure.HALF_SIZE: AnswerType.SIZE, Measure.VOLUME: AnswerType.VOLUME,
    Measure.REMOVED: AnswerType.VOLUME, Measure.FILL: AnswerType.NUMBER, Measure.LONG_AXIS: AnswerType.TEXT,
    Measure.MASS: AnswerType.NUMBER, Measure.COUNT: AnswerType.COUNT,
    Measure.FACE_COUNT: AnswerType.COUNT, Measure.EDGE_COUNT: AnswerType.COUNT, Measure.SIDES: AnswerType.TEXTS,
    Measure.MIRROR_PLANES: AnswerType.DIRECTIONS, Measure.INERTIA: AnswerType.NUMBERS,
    **dict.fromkeys((Measure.ANGLE, Measure.INCLUDED_ANGLE, Measure.DRAFT, Measure.INCLINATION), AnswerType.ANGLE),
    **dict.fromkeys((Measure.AREA, Measure.OPENING_AREA, Measure.STANDING_AREA), AnswerType.AREA),
    Measure.CROSS_SECTION_AREA: AnswerType.AREA, Measure.ANGULAR_PITCH: AnswerType.ANGLE,
    **dict.fromkeys((Measure.POSITION, Measure.CENTER_OF_MASS, Measure.OPENING, Measure.TIP, *ENDS), AnswerType.POINT),
    **dict.fromkeys((Measure.FLOOR_CENTER, Measure.MIN_CORNER, Measure.MAX_CORNER), AnswerType.POINT),
    **dict.fromkeys((Measure.AXIS, Measure.NORMAL, Measure.DIRECTION, Measure.APPROACH), AnswerType.DIRECTION),
    **dict.fromkeys((Measure.NAME, Measure.KIND, Measure.COLOR, Measure.BOTTOM), AnswerType.TEXT),
}  # fmt: skip
"""Of what is no single length."""
SCALARS = frozenset(getattr(AnswerType, name) for name in ["LENGTH", "AREA", "VOLUME", "ANGLE", "NUMBER", "COUNT"])
_MANY = {kind: AnswerType(f"{kind}s") for kind in AnswerType if f"{kind}s" in [*AnswerType]}
_MANY[AnswerType.COUNT] = AnswerType.NUMBERS


def answer_type(measure: Measure, several: bool = False) -> AnswerType:
    """Which type have values of a measure?"""
    kind = _TYPES.get(measure, AnswerType.LENGTH)
    return of_several(kind) if several else kind


def of_several(kind: AnswerType) -> AnswerType:
    """Which type has a list of such values?"""
    return _MANY.get(kind, kind)


def is_length(measure: Measure) -> bool:
    """Is it a single length?"""
    return measure not in _TYPES
