"""Tables of a model's parts: of holes, bends, fasteners, bodies …; a row for each part, or for all that are alike."""

from __future__ import annotations

import re
from collections.abc import Callable, Iterable, Mapping, Sequence
from dataclasses import dataclass

from querycad_contracts import Bottom, Column, LengthUnit, Part, PartKind, Quantity, Table, TableKind, Vector
from querycad_contracts.drawings import Cell

from .callouts import Known, callout, carried_sections, ids_text
from .numbers import direction
from .threads import suits, thread_name

FASTENER_TAGS = ("screw", "nut", "washer")
_INSTANCE = re.compile(r"[\s_:.#-]{0,8}\d{1,9}$")
"""What counts the instances of one product in their names: 'Dowel pin 2', 'screw_3'."""
_VOLUME_DIGITS = 4
"""Bodies are instances of one where their volumes and their surfaces are the same to four digits."""

_KINDS: dict[TableKind, tuple[PartKind, ...]] = {
    TableKind.HOLES: (PartKind.HOLE, PartKind.DIMPLE),
    TableKind.SLOTS: (
        PartKind.SLOT,
        PartKind.POCKET,
        PartKind.CUTOUT,
        PartKind.CHANNEL,
        PartKind.STEP,
        PartKind.NOTCH,
        PartKind.GROOVE,
        PartKind.CAVITY,
    ),
    TableKind.BOSSES: (PartKind.BOSS, PartKind.PROTRUSION, PartKind.RIB, PartKind.GEAR),
    TableKind.EDGES: (PartKind.FILLET, PartKind.ROUND, PartKind.CHAMFER),
    TableKind.BENDS: (PartKind.BEND,),
    TableKind.PATTERNS: (PartKind.PATTERN,),
    TableKind.FASTENERS: (PartKind.BODY,),
    TableKind.BODIES: (PartKind.BODY,),
}


@dataclass(frozen=True, slots=True)
class _Row:
    """Parts that a row stands for: one, or all that are alike. `alike` are those, the row's own among them."""

    parts: tuple[Part, ...]
    alike: tuple[Part, ...]
    tag: str
    known: Known
    unit: LengthUnit

    @property
    def first(self) -> Part:
        return self.parts[0]

    @property
    def place(self) -> Vector | None:
        """The centre of the opening, of the tip, or the middle; none of several parts."""
        return (self.first.opening or self.first.tip or self.first.center) if len(self.parts) == 1 else None


_Cells = Sequence[tuple[Column, Callable[[_Row], Cell]]]


def table(
    kind: TableKind, parts: Sequence[Part], *, grouped: bool | None = None, unit: LengthUnit = LengthUnit.MM
) -> Table:
    """The table of these parts of a model.

    `grouped`: like parts are one row, which has no place; None: bodies and fasteners are. `unit` is that of the
    callouts, which are text; numbers are SI.
    """
    if grouped is None:
        grouped = kind in (TableKind.FASTENERS, TableKind.BODIES)
    known = {part.id: part for part in parts}
    wanted = _wanted(kind, parts)
    groups = list(_alike(kind, wanted, known))
    rows = []
    for index, alike in enumerate(groups):
        tag = _letters(index)
        if grouped:
            rows.append(_Row(alike, alike, tag, known, unit))
        else:
            rows += [
                _Row((part,), alike, f"{tag}{number}" if len(alike) > 1 else tag, known, unit)
                for number, part in enumerate(alike, 1)
            ]
    cells = _CELLS[kind]
    return Table(
        kind=kind,
        columns=tuple(column for column, _ in cells),
        rows=tuple(tuple(cell(row) for _, cell in cells) for row in rows),
        ids=tuple(tuple(part.id for part in row.parts) for row in rows),
        parts=len(wanted),
    )


def is_fastener(part: Part) -> bool:
    """Is the body a screw, nut or washer, by its form or by its product name?"""
    words = re.findall(r"[a-z]+", (part.name or "").lower())
    return bool({*part.tags, *words} & {*FASTENER_TAGS, "bolt"})


def product_name(parts: Sequence[Part]) -> str:
    """What are these instances of one product called? Without the number that tells their names from each other."""
    names = {part.name or "" for part in parts}
    return names.pop() if len(names) == 1 else _INSTANCE.sub("", min(names))


def alike_bodies(kind: TableKind, parts: Sequence[Part]) -> tuple[tuple[Part, ...], ...]:
    """The bodies, or fasteners, of the model; instances of one product together."""
    return tuple(_alike(kind, _wanted(kind, parts), {}))


def _wanted(kind: TableKind, parts: Sequence[Part]) -> list[Part]:
    found = [part for part in parts if part.kind in _KINDS[kind]]
    if kind is TableKind.FASTENERS:
        return [part for part in found if is_fastener(part)]
    if kind is TableKind.EDGES:
        carried = carried_sections(parts)
        return [part for part in found if part.id not in carried]
    if kind is TableKind.BOSSES:
        return list(distinct(found))
    return found


def distinct(parts: Iterable[Part]) -> Iterable[Part]:
    """The parts, a pad left out whose walls are those of a rib, boss or gear: one feature is told once."""
    parts = list(parts)
    named = {face for part in parts if part.kind in (PartKind.RIB, PartKind.BOSS, PartKind.GEAR) for face in part.faces}
    for part in parts:
        if part.kind is not PartKind.PROTRUSION or len(named & set(part.faces)) * 2 < len(part.faces):
            yield part


def _alike(kind: TableKind, parts: Sequence[Part], known: Known) -> Iterable[tuple[Part, ...]]:
    """The parts that a drawing would not tell apart; of bodies, instances of one product."""
    groups: dict[object, list[Part]] = {}
    bodies = kind in (TableKind.FASTENERS, TableKind.BODIES)
    for part in parts:
        groups.setdefault(_product(part) if bodies else (part.kind, callout(part, known=known)), []).append(part)
    return (tuple(group) for group in groups.values())


def _product(part: Part) -> tuple[object, ...]:
    """What makes two bodies one product: name, colour, volume and surface, whichever way each is turned."""
    amounts = (f"{amount or 0.0:.{_VOLUME_DIGITS}g}" for amount in (part.volume, part.area))
    return _INSTANCE.sub("", part.name or ""), part.color, *amounts


def _letters(index: int) -> str:
    """A, B … Z, AA, AB …"""
    text = ""
    index += 1
    while index:
        index, rest = divmod(index - 1, 26)
        text = chr(ord("A") + rest) + text
    return text


def _text(name: str, value: Callable[[Part], str | None]) -> tuple[Column, Callable[[_Row], Cell]]:
    return Column(name=name), lambda row: value(row.first) or None


def _size(
    name: str, value: Callable[[Part], float | None], quantity: Quantity = Quantity.LENGTH
) -> tuple[Column, Callable[[_Row], Cell]]:
    return Column(name=name, quantity=quantity), lambda row: value(row.first)


def _at(index: int) -> tuple[Column, Callable[[_Row], Cell]]:
    column = Column(name="xyz"[index], quantity=Quantity.LENGTH)
    return column, lambda row: None if row.place is None else row.place[index]


_WAYS: Mapping[Bottom | None, str] = {Bottom.THROUGH: "through", Bottom.BORE: "into a bore"}


def _type(part: Part) -> str:
    """What a hole is: 'through, counterbored'; what a slot is: 'rectangular pocket'."""
    if part.kind is PartKind.HOLE:
        ways = _WAYS.get(part.bottom, "blind")
        more = [tag for tag in ("counterbored", "countersunk", "spotfaced", "threaded", "conical") if tag in part.tags]
        return ", ".join((ways, *more))
    return part.label.partition(",")[0].partition(" of ")[0] or part.kind.value


def _outline(part: Part) -> tuple[float | None, float | None]:
    """Width and length of an opening in its own frame; a ring's width alone."""
    if part.kind is PartKind.GROOVE:
        return part.width, None
    return (part.local_size[1], part.local_size[0]) if part.local_size else (part.width, part.length)


def _common(texts: Iterable[str]) -> str | None:
    """The one text that all are; None where they differ."""
    different = set(texts)
    return different.pop() if len(different) == 1 else None


_TAG = (Column(name="tag"), lambda row: row.tag)
_COUNT = (Column(name="count", quantity=Quantity.COUNT), lambda row: len(row.alike))
_IDS = (Column(name="ids"), lambda row: ids_text([part.id for part in row.parts]))
_CALLOUT = (
    Column(name="callout"),
    lambda row: callout(row.first, row.unit, row.known),
)
_NAME = (Column(name="name"), lambda row: product_name(row.parts) or None)
_AXIS = (
    Column(name="axis"),
    lambda row: _common(direction(way) for part in row.parts if (way := part.normal or part.axis)),
)
_COLOR = _text("color", lambda part: part.color)

_NAMED = (_TAG, _IDS)
_PLACE = (_at(0), _at(1), _at(2))

_CELLS: Mapping[TableKind, _Cells] = {
    TableKind.HOLES: (
        *_NAMED,
        *_PLACE,
        _AXIS,
        _size("diameter", lambda part: part.diameter),
        _size("depth", lambda part: part.depth),
        _text("type", _type),
        _text("thread", thread_name),
        _text("suits", lambda part: ", ".join(map(str, suits(part)))),
        _CALLOUT,
        _COUNT,
    ),
    TableKind.SLOTS: (
        *_NAMED,
        *_PLACE,
        _AXIS,
        _size("width", lambda part: _outline(part)[0]),
        _size("length", lambda part: _outline(part)[1]),
        _size("depth", lambda part: part.depth),
        _text("type", _type),
        _CALLOUT,
        _COUNT,
    ),
    TableKind.BOSSES: (
        *_NAMED,
        *_PLACE,
        _AXIS,
        _size("diameter", lambda part: part.diameter),
        _size("height", lambda part: part.height),
        _size("thickness", lambda part: part.thickness if part.kind is PartKind.RIB else None),
        _text("type", _type),
        _text("thread", thread_name),
        _CALLOUT,
        _COUNT,
    ),
    TableKind.EDGES: (
        *_NAMED,
        _text("type", lambda part: part.kind.value),
        _size("size", lambda part: part.chamfer_size if part.kind is PartKind.CHAMFER else part.radius),
        _size("angle", lambda part: part.angle, Quantity.ANGLE),
        _CALLOUT,
        _COUNT,
    ),
    TableKind.BENDS: (
        *_NAMED,
        _size("inside radius", lambda part: part.bend_radius),
        _size("angle", lambda part: part.bend_angle, Quantity.ANGLE),
        _size("length", lambda part: part.length),
        _size("thickness", lambda part: part.thickness),
        _AXIS,
        *_PLACE,
        _COUNT,
    ),
    TableKind.PATTERNS: (
        *_NAMED,
        _size("members", lambda part: part.count, Quantity.COUNT),
        _size("diameter", lambda part: part.diameter),
        _size("pitch", lambda part: part.pitch),
        _CALLOUT,
        *_PLACE,
    ),
    TableKind.FASTENERS: (
        _TAG,
        _NAME,
        _text("type", lambda part: next((tag for tag in FASTENER_TAGS if tag in part.tags), None)),
        _size("diameter", lambda part: part.diameter),
        (Column(name="length", quantity=Quantity.LENGTH), lambda row: row.first.nominal_length),
        _size("overall length", lambda part: part.length if "screw" in part.tags else max(part.extents)),
        _size("across flats", lambda part: part.across_flats),
        _COLOR,
        _COUNT,
        _IDS,
    ),
    TableKind.BODIES: (
        _TAG,
        _NAME,
        _COUNT,
        _size("x size", lambda part: part.extents[0]),
        _size("y size", lambda part: part.extents[1]),
        _size("z size", lambda part: part.extents[2]),
        _size("volume", lambda part: part.volume, Quantity.VOLUME),
        _size("area", lambda part: part.area, Quantity.AREA),
        _COLOR,
        _IDS,
    ),
}
