"""Parts that are named by what is printed of them: 'hole-4', 'hole 4', 'holes 4 and 6', 'face 36', 'Dowel pin 2'.

Each such name is put into the question as a noun with a number that only this question knows; the ids behind it stand
in the readings. What is named so is certain: a reading that passes over an id is none, and an id that the model lacks
is refused.
"""

from __future__ import annotations

import re
from collections.abc import Iterator, Mapping, Sequence
from dataclasses import dataclass, field, replace
from functools import cached_property
from typing import TypeVar, cast

from querycad_contracts import Failure, FailureCategory, Frozen, Part, PartKind, PartQuery
from querycad_language.describe import plural_of
from querycad_language.forms import Distance, Every, Form, Get, Reduce, Which, mapped, queries
from querycad_language.lexicon import lexicon
from querycad_language.readings import Reader
from querycad_language.readings.parses import Reading
from querycad_language.text import Text
from querycad_language.tokens import MAX_CHARS

from .drawing.callouts import callouts, carried_sections, ids_text
from .drawing.describing import SURFACES, is_bare_surface

T = TypeVar("T")

FIRST_ALIAS = 9001
"""Numbers from here on are names that only the question knows; no model numbers its parts so high in one kind."""
GROUP = "+"
"""Joins the ids of parts that are asked about together: 'hole-1+hole-2'."""
_ONE_ID = r"[a-z]+(?:[-_][a-z]+)*-[a-z]?\d+(?:\.\d+)*"
_ID = re.compile(rf"(?<![\w+-]){_ONE_ID}(?:\+{_ONE_ID})*(?![\w-]|\.\d)", re.IGNORECASE)
_STOCK = {*lexicon().words("material")}
_MATERIALS = "|".join(map(re.escape, _STOCK | {one for one, other in lexicon().spelling.items() if other in _STOCK}))
_NO_INCH = rf"(?:mm|m|cm|inch|met|milli|sq|cu|the|which|what)\w*|kg|{_MATERIALS}"
"""What stands behind an 'in' that is no inch."""
_UNIT = (
    rf"mm|cm|m|in(?! (?:{_NO_INCH})\b)|inch(?:es)?|ft|feet|deg|degrees?|kg|g|percent"
    r"|times|or more|or less"
)
_NUMBER = re.compile(rf"(?<![\w.,/+-])#?\d{{1,4}}(?![\w\"”″°×%:+-]|[.,/]\d|\s*(?:{_UNIT})\b|\s?[x×*])", re.IGNORECASE)
_WORDS = re.compile(r"(?:\b[a-z]+[ _-]){0,2}\b[a-z]+\s*(?:number |no\.? |#)?$", re.IGNORECASE)
NAME_CHARS = 120
"""So far before a number its noun may begin."""
LISTED = 100
"""Numbers that are one list at most."""
_NEXT = re.compile(r" ?(?:, ?(?:and |or )?| (?:and|or|to) |& ?)(?=#?\d)", re.IGNORECASE)
_JOINED = re.compile(r"⟦(\d+)⟧((?:(?:\s*,\s*(?:and |or )?|\s+and\s+|\s*&\s*)⟦\d+⟧)+)")
_MARK = re.compile(r"⟦(\d+)⟧")
_NO_MARKS = str.maketrans("⟦⟧", "[]")
"""What a question has of them is no mark of ours."""
_APART = re.compile(r"(⟦\d+⟧) in\b")
"""A name before 'in inches' is no number of inches."""
_GLUED = re.compile(r"\b([A-Za-z]{3,30})(\d{1,4})\b(?![.,]\d)")
"""A noun and its number in one: 'Hole4'."""
_CALLOUT = re.compile(
    r"Ø\d|\d x \d|\d (?:thick|across flats|wide)\b|\b(?:depth|height|pitch|length|[CR])\s?\d", re.IGNORECASE
)
_FACES = ("face", "faces", "surface", "surfaces")
_NO_NOUN = (PartKind.MODEL, PartKind.REGION)
_NO_LINE = (*_NO_NOUN, PartKind.BODY)


@dataclass(frozen=True, slots=True)
class Addressed:
    """A question whose ids have been found. `texts`: as they are to be read, the first that names all ids counts."""

    texts: tuple[str, ...]
    names: Mapping[int, tuple[str, ...]] = field(default_factory=dict)
    """Number of each name in the texts to the ids that it stands for."""
    notes: tuple[str, ...] = ()
    failure: Failure | None = None

    @property
    def ids(self) -> frozenset[str]:
        """All ids that the question names."""
        return frozenset(part for ids in self.names.values() for part in ids)


class AddressedReader(Reader):
    """Reads a question in which some nouns are names of parts."""

    def __init__(self, text: str, addressed: Addressed, names: frozenset[str]) -> None:
        super().__init__(text, names)
        self._addressed = addressed

    @cached_property
    def readings(self) -> list[Reading]:
        """The readings, those that the words link best first; the ids are the model's own."""
        found = Reader.readings.func(self)  # type: ignore[attr-defined]
        names = self._addressed.names
        return [replace(one, form=_with_ids(one.form, names), skipped=_skipped(one.skipped, names)) for one in found]


def _skipped(words: Sequence[tuple[str, str]], names: Mapping[int, tuple[str, ...]]) -> tuple[tuple[str, str], ...]:
    """The words that are passed over, with ids for names."""
    found: list[tuple[str, str]] = []
    for kind, word in words:
        ids = names.get(int(word)) if word.isdigit() else None
        if ids is not None and found and found[-1][0] == "noun":
            found.pop()  # 'hole 9001'
        found.append((kind, ids_text(ids)) if ids is not None else (kind, word))
    return tuple(found)


def reader_of(addressed: Addressed, names: frozenset[str]) -> Reader:
    """Reads the first of the texts that has a reading with all ids; else the first."""
    if not addressed.names:
        return Reader(addressed.texts[0], names)
    readers = [AddressedReader(text, addressed, names) for text in addressed.texts]
    return next((one for one in readers if any(names_all(each, addressed.ids) for each in one.readings)), readers[0])


def names_all(reading: Reading, ids: frozenset[str]) -> bool:
    """Has the reading all these ids?

    'How far apart are they' asks neighbours in a row: of more than two parts that are named it says too little.
    """
    form = reading.form
    if isinstance(form, Distance) and form.second == "each other" and len(ids) > 2:
        return False
    return ids <= {part for query in queries(reading.form) for one in _with_places(query) for part in one.ids}


def _with_places(query: PartQuery) -> Iterator[PartQuery]:
    """The query, and those that say where: 'the counterbore at hole 9'."""
    yield query
    for place in query.places:
        if place.what is not None:
            yield from _with_places(place.what)


def is_certain(form: Form) -> bool:
    """Is nothing left to find: is every part that the form is about named by its id, and by nothing that restricts it?

    What words such as 'difference' do with the values is not certain.
    """
    if isinstance(form, Every) or (isinstance(form, Get) and form.reduce is Reduce.DIFFERENT):
        return False
    return all(query.ids and not is_restricted(query) for query in queries(form))


def is_restricted(query: PartQuery) -> bool:
    """Do words beside the ids say which parts: 'the blind hole 4'?"""
    plain = PartQuery()
    own = query.noun in _KINDS or not query.noun
    return not own or any(getattr(query, name) != getattr(plain, name) for name in _RESTRICTS)


_RESTRICTS = ("adjectives", "lacking", "sizes", "threads", "colors", "ranks", "places", "sides", "unseen", "excluded")


def folded(text: str) -> str:
    """A question in one line, with single blanks, no longer than is read: what is done with it before all else."""
    return " ".join(text[: 2 * MAX_CHARS].split())[:MAX_CHARS]


def may_name_parts(question: str) -> bool:
    """Does the question hold anything that could be an id? Only then are all parts of the model asked for."""
    return bool(
        _CALLOUT.search(question) or _ID.search(question) or _NUMBER.search(question) or _GLUED.search(question)
    )


def address(question: str, parts: Sequence[Part]) -> Addressed:
    """Which parts does the question name by their ids?"""
    finder = _Finder(parts)
    apart = _GLUED.sub(lambda match: f"{match[1]} {match[2]}" if _noun_name(match[1]) else match[0], question)
    marked = finder.products(finder.callouts(apart.translate(_NO_MARKS)))
    marked = _ID.sub(finder.full, marked)
    marked = finder.numbered(marked)
    if finder.missing:
        return Addressed((question,), failure=Failure(category=FailureCategory.NOT_GROUNDED, message=finder.missing))
    if not finder.found:
        return Addressed((question,))
    grouped = _JOINED.sub(finder.joined, marked)
    texts = tuple(dict.fromkeys(_MARK.sub(finder.alias, _APART.sub(r"\1, in", text)) for text in (marked, grouped)))
    names = {FIRST_ALIAS + i: ids for i, ids in enumerate(finder.found)}
    return Addressed(texts, names, notes=tuple(finder.notes))


class _Finder:
    """Finds the ids of one question, and numbers them."""

    def __init__(self, parts: Sequence[Part]) -> None:
        self._parts = {part.id: part for part in parts}
        self._by_lower = {part.id.lower(): part.id for part in parts}
        self._bodies: dict[str, str | None] = {}
        for part in parts:
            if part.kind is PartKind.BODY:
                name = (part.name or "").lower()
                self._bodies[name] = None if name in self._bodies else part.id
        self.found: list[tuple[str, ...]] = []
        self.notes: list[str] = []
        self.missing = ""

    def callouts(self, text: str) -> str:
        """What lists print of like parts: '8x Ø16 THRU, counterbore Ø26 depth 8', with or without the number before."""
        if not _CALLOUT.search(text):
            return text
        told = [part for part in self._parts.values() if not (part.kind in _NO_LINE or is_bare_surface(part))]
        carried = carried_sections(told)  # lists leave these out
        groups: dict[str, tuple[str, ...]] = {}
        for parts in ([part for part in told if part.id not in carried], told):
            for one in callouts(parts, known=self._parts):
                groups.setdefault(re.sub(r"^\d+x ", "", one.text), one.ids)
        for said in sorted((one for one in groups if " " in one or one.startswith("C")), key=len, reverse=True):
            noun = r"(?: holes?\b)?" if " " in said else r" chamfers?\b"
            mark = re.compile(rf"(?<![\w.])(?:\d+ ?x )?{re.escape(said)}{noun}(?!\w|[.,]\d)", re.IGNORECASE)
            text = mark.sub(lambda _, ids=groups[said]: self._mark(ids), text)  # type: ignore[misc]
        return text

    def products(self, text: str) -> str:
        """Names of bodies in full that end in a number, which only one body has: 'Hexagonal screw M6 2'."""
        names = [name for name in self._bodies if name[-1:].isdigit() and " " in name]
        for name in sorted(names, key=len, reverse=True):
            if self._bodies[name] is not None:
                mark = re.compile(rf"(?<!\w){re.escape(name)}(?!\w|[.,]\d)", re.IGNORECASE)
                text = mark.sub(lambda _, part=self._bodies[name]: self._mark((part,)), text)  # type: ignore[misc]
        return text

    def full(self, match: re.Match[str]) -> str:
        """An id in full; of another stem than the model's parts have, the words stay."""
        said = match[0].lower().split(GROUP)
        parts = [self._by_lower.get(one) for one in said]
        if all(parts):
            return self._mark(tuple(dict.fromkeys(part for part in parts if part)))
        missing = said[parts.index(None)]
        stem = missing.rpartition("-")[0]
        if stem in _KINDS or any(known.rpartition("-")[0] == stem for known in self._by_lower):
            self._lacks(missing, stem)
        return match[0]

    def numbered(self, text: str) -> str:
        """Nouns with numbers: 'hole 4', 'holes 1, 2 and 4'."""
        out, at = [], 0
        for match in _NUMBER.finditer(text):
            if match.start() < at:
                continue
            words = _WORDS.search(text, max(0, match.start() - NAME_CHARS), match.start())
            numbers, end, ways = self._numbers(text, match)
            named = words and words.start() >= at and self._named(words[0], numbers, ways)
            if words and named:
                taken, marks = named
                out += [text[at : words.start()], words[0][: len(words[0]) - taken], marks]
                at = end
        return "".join([*out, text[at:]])

    def _numbers(self, text: str, first: re.Match[str]) -> tuple[list[int], int, list[str]]:
        """The numbers of a list, where it ends, and what stands between them."""
        numbers, end, ways = [int(first[0].lstrip("#"))], first.end(), list[str]()
        while len(numbers) < LISTED and (between := _NEXT.match(text, end)):
            if (match := _NUMBER.match(text, between.end())) is None:
                break
            numbers.append(int(match[0].lstrip("#")))
            ways.append(between[0])
            end = match.end()
        return numbers, end, ways

    def _named(self, said: str, numbers: list[int], ways: list[str]) -> tuple[int, str] | None:
        """How many letters of the words before the numbers belong to the name, and the marks; None where it is none."""
        bare = re.sub(r"\s*(?:number |no\.? |#)?$", "", said, flags=re.IGNORECASE)
        words = re.split(r"[ _-]", bare)
        if any("to" in way for way in ways) and words[-1].lower().endswith("s") and len(numbers) == 2:
            numbers, ways = list(range(numbers[0], numbers[1] + 1)), [", "] * (numbers[1] - numbers[0])
        for first in range(len(words)):
            phrase = words[first:]
            taken = len(said) - sum(len(word) + 1 for word in words[:first])
            ids = [self._id_of(phrase, number) for number in numbers]
            if all(ids):
                marks = [self._mark(one) for one in ids if one]
                return taken, marks[0] + "".join(way + mark for way, mark in zip(ways, marks[1:], strict=True))
        noun = _noun_name(words[-1])
        stems = {known.rpartition("-")[0] for known in self._by_lower}
        listed = len(numbers) > 1 or not words[-1].lower().endswith("s")
        if noun and listed and ({noun, words[-1].lower()} & (stems | _KINDS)):
            lacking = next(n for n in numbers if self._id_of(words[-1:], n) is None)
            self._lacks(f"{noun if noun in stems | _KINDS else words[-1].lower()}-{lacking}", noun)
        return None

    def _id_of(self, phrase: list[str], number: int) -> tuple[str, ...] | None:
        """The part that these words and this number name."""
        if len(phrase) == 1 and phrase[0].lower() in _FACES:
            return self._face(number)
        words = [word.lower() for word in phrase]
        singular = _noun_name(words[-1])
        for last in dict.fromkeys((words[-1], words[-1].removesuffix("s"), singular or words[-1])):
            stem = "-".join((*words[:-1], last))
            if (known := self._by_lower.get(f"{stem}-{number}")) is not None:
                return (known,)
            if len(words) == 1:
                ends = [part for low, part in self._by_lower.items() if low.endswith(f"-{last}-{number}")]
                if len(ends) == 1:
                    return (ends[0],)
        return None

    def _face(self, number: int) -> tuple[str, ...] | None:
        """The surface that is the face with this number of the file: the number that is printed behind 'faces'."""
        having = [part for part in self._parts.values() if number in part.faces]
        surfaces = [part for part in having if part.kind in SURFACES]
        surfaces = surfaces or [part for part in having if len(part.faces) == 1]  # a round is no surface of its own
        if not surfaces:
            return None
        part = min(surfaces, key=lambda one: len(one.faces))  # a cylinder may be two halves
        other = self._by_lower.get(f"face-{number}")
        if other not in (None, part.id):
            self.notes.append(f"face {number} is the face of that number in the file, {part.id}; {other} is another")
        return (part.id,)

    def _lacks(self, said: str, noun: str) -> None:
        stem = said.rpartition("-")[0]
        there = [part for part in self._parts if re.fullmatch(rf"(?:.+-)?{re.escape(stem)}-[^-]+", part)]
        has = f"it has {ids_text(there, 4)}" if there else f"it has no {noun or stem} at all"
        if stem == "face":
            last = max((face for part in self._parts.values() for face in part.faces), default=0)
            has = f"its faces have the numbers 0 to {last}; its flat faces are {ids_text(there, 4)}"
        self.missing = self.missing or f"the model has no {said}; {has}"

    def joined(self, match: re.Match[str]) -> str:
        """Names in a list, as one name of several parts."""
        numbers = [int(match[1]), *(int(each) for each in _MARK.findall(match[2]))]
        return self._mark(tuple(dict.fromkeys(part for number in numbers for part in self.found[number])))

    def _mark(self, ids: tuple[str, ...]) -> str:
        self.found.append(ids)
        return f"⟦{len(self.found) - 1}⟧"

    def alias(self, match: re.Match[str]) -> str:
        """A noun that the reader knows, with the name's number; a plural where it stands for several parts."""
        number = int(match[1])
        ids = self.found[number]
        kind = self._parts[ids[0]].kind
        noun = "part" if kind in _NO_NOUN else kind.value.replace("_", " ")
        return f"{plural_of(noun) if len(ids) > 1 else noun} {FIRST_ALIAS + number}"


_KINDS = frozenset(kind.value for kind in PartKind) - {kind.value for kind in _NO_NOUN}


def _noun_name(word: str) -> str | None:
    """What the lexicon calls a noun: 'bores' is 'hole'."""
    span = Text(word).find(0, "noun")
    return span.value.name if span is not None and span.end == 1 else None


def _with_ids(form: Form, names: Mapping[int, tuple[str, ...]]) -> Form:
    """The form with the model's ids for names."""
    found = mapped(form, lambda query: _named(query, names))
    if isinstance(found, Every):  # 'is hole 4 counterbored': among all that are, not among itself
        return replace(found, among=found.among.model_copy(update={"ids": ()}))
    if isinstance(found, Which):  # a part that is named by its id is called so
        ids = [[part for query in queries(one) for part in query.ids] for one in (found.left, found.right)]
        first, second = (ids_text(own) or word for own, word in zip(ids, found.words, strict=True))
        return replace(found, words=(first, second))
    return found


def _named(value: T, names: Mapping[int, tuple[str, ...]]) -> T:
    """A query, or what it is made of, with the model's ids for names."""
    if isinstance(value, tuple):
        return cast("T", tuple(_named(each, names) for each in value))
    if not isinstance(value, Frozen):
        return value
    changed = {name: _named(getattr(value, name), names) for name in type(value).model_fields}
    if isinstance(value, PartQuery):
        changed["ids"] = tuple(_own(value.ids, names))
    return cast("T", value.model_copy(update=changed))


def _own(ids: Sequence[str], names: Mapping[int, tuple[str, ...]]) -> Iterator[str]:
    for part in ids:
        tail = part.rpartition("-")[2]
        yield from names.get(int(tail), (part,)) if tail.isdecimal() else (part,)
