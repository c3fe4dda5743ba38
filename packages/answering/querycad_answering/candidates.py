"""The candidates for an answer: every reading of a question on every grounding, as a program with its features."""

from __future__ import annotations

import itertools
import math
from collections.abc import Callable, Iterable, Iterator, Mapping, Sequence
from collections.abc import Set as AbstractSet
from dataclasses import dataclass, field, replace
from functools import cache
from typing import Any

from querycad_contracts import AnswerType, Bottom, Grounded, Measure, Part, PartQuery
from querycad_language.forms import (
    Count,
    Distance,
    Either,
    Every,
    Exists,
    Form,
    Get,
    Parts,
    Reduce,
    Towards,
    Which,
    queries,
)
from querycad_language.lexicon import lexicon
from querycad_language.phrases import bare_of
from querycad_language.readings import Reading
from querycad_language.weights import weights

from .affinity import FEATURE, Affinity
from .programs import Unwritable, Written, write

GROUNDINGS = 5
"""Of the query of a program so many ways are followed."""
GUESSES = 6
"""And so many of those that guess what its noun means."""
GROUNDINGS_TOGETHER = 3
"""Where a program has several queries, of each so many."""
GUESSES_TOGETHER = 2
"""And so many guesses, with as many ways of the others."""
GUESSED = "guessed"
"""The feature of a way that only guesses what a noun means."""
OPTIONS = 4
"""So many meanings of a measure are followed."""
GUESSES_OPTIONS = 2
"""And of a guess."""
RUNS = 9
"""So many programs are run."""
ABSENCES = 3
"""So many readings of parts that the model may lack are weighed."""

_ANGLES = (AnswerType.ANGLE, AnswerType.ANGLES)
_SQUARE = math.pi / 2
_ALIKE_RAD = math.radians(0.1)
"""Angles nearer to each other than this are one: directions of freeform and meshed faces are that exact."""
_DRAFT_RAD = math.radians(15)
"""Castings and mouldings have less draft; chamfers and countersinks lean more."""
_VECTORS = {
    *(AnswerType.POINT, AnswerType.POINTS, AnswerType.DIRECTION, AnswerType.DIRECTIONS),
    *(AnswerType.SIZE, AnswerType.SIZES),
}

Features = dict[str, float]
Ground = Callable[[Sequence[PartQuery]], Sequence[Sequence[Grounded]]]


@dataclass(frozen=True, slots=True)
class Candidate:
    """One program that may answer, and what speaks for it."""

    reading: Reading
    grounds: dict[PartQuery, Grounded]
    written: Written
    features: Features
    value: Any = field(default=None, compare=False)

    @property
    def score(self) -> float:
        """The fitted weights of the features, added up."""
        return _score(self.features)


def _score(features: Features) -> float:
    table = weights()
    return math.fsum(table.get(name, 0.0) * value for name, value in features.items())


def candidates(
    readings: Sequence[Reading], ground: Ground, whole: Part, affinity: Affinity, limit: int = RUNS
) -> list[Candidate]:
    """The candidates that are worth running, the best first.

    `whole`: the part that stands for the model. `affinity`: of the question's words with that model.
    """
    asked: list[PartQuery] = []
    for reading in readings:
        asked += [query for query in queries(reading.form) if query not in asked]
    grounded = dict(zip(asked, ground(asked), strict=True)) if asked else {}
    best: dict[str, Candidate] = {}
    told = _told(readings, grounded)
    for reading in readings:
        for candidate in _of_reading(reading, grounded, whole, told, affinity):
            known = best.get(candidate.written.code)
            if known is None or candidate.score > known.score:
                best[candidate.written.code] = candidate
    return sorted(best.values(), key=lambda one: one.score, reverse=True)[:limit]


@dataclass(frozen=True, slots=True)
class Absence:
    """A reading of a part that the model lacks, which is answered by saying so; and what speaks for it."""

    query: PartQuery
    grounded: Grounded
    features: Features

    @property
    def score(self) -> float:
        """The fitted weights of the features, added up."""
        return _score(self.features)


def absences(
    readings: Sequence[Reading],
    grounded: Mapping[PartQuery, Sequence[Grounded]],
    names: AbstractSet[str],
    affinity: Affinity,
) -> list[Absence]:
    """The readings of parts that the model may lack, the best first; a few.

    `names`: words of the file's product names; `affinity`: of the question's words. How many
    there are, and whether there is one, is answered: none.
    """
    best: dict[PartQuery, Absence] = {}
    for reading in readings:
        if isinstance(reading.form, Count | Exists | Every):
            continue
        for index, query in enumerate(queries(reading.form)):
            for way in _lacking(query, grounded.get(query, ()), names):
                features = {**reading.features, **_of_absence(query, way), "absent_place": float(index > 0)}
                features[f"form_{type(reading.form).__name__.lower()}"] = 1.0
                features[FEATURE] = affinity.of(features)
                found = Absence(query, way, features)
                if query not in best or found.score > best[query].score:
                    best[query] = found
    return sorted(best.values(), key=lambda one: one.score, reverse=True)[:ABSENCES]


def _lacking(query: PartQuery, ways: Sequence[Grounded], names: AbstractSet[str]) -> Iterator[Grounded]:
    """The groundings that find nothing; that there is none, where only something else stands in for the noun.

    Not so where the whole is meant and named so: the clamp in pvc_clamp.step.
    """
    empty = [way for way in ways if not way.parts]
    yield from empty
    named = query.known and names >= set(query.noun.split()) and any("whole_sense" in way.features for way in ways)
    if query.noun and not query.ids and not empty and not named and all(map(_stands_in, ways)):
        yield Grounded(parts=(), features={"nothing": 1.0})


def _stands_in(way: Grounded) -> bool:
    """Is it a guess, parts of a like kind, or the whole model, for a noun that nothing here is called by?"""
    return bool(_INSTEAD & way.features.keys()) and not CALLED_SO & way.features.keys()


def _of_absence(query: PartQuery, way: Grounded) -> Features:
    """What is known of the noun of a part that is not there, beside the features of its grounding."""
    noun = lexicon().nouns.get(query.noun) if query.known else None
    kind = "unknown" if noun is None else "product" if noun.product else "known"
    narrowed = any(name.endswith("_empties") for name in way.features)
    return {**way.features, "absent": 1.0, f"absent_{kind}": 1.0, "absent_narrowed": float(narrowed)}


def _told(
    readings: Sequence[Reading], grounded: dict[PartQuery, Sequence[Grounded]]
) -> list[tuple[frozenset[int], bool]]:
    """The words of readings about parts that the model has by that very name, and whether they speak of several."""
    found: list[tuple[frozenset[int], bool]] = []
    for reading in readings:
        target = reading.form.target if isinstance(reading.form, Get | Count | Exists | Parts) else None
        best = grounded[target][0] if target is not None and grounded[target] else None
        if target is not None and best is not None and best.parts and not any(map(best.features.get, _STRETCHED)):
            found.append((reading.used, target.plural))
    return found


def _passing(reading: Reading, told: Sequence[tuple[frozenset[int], bool]]) -> Features:
    """Does the whole answer, where parts that the model has are named?"""
    if not isinstance(reading.form, Get) or reading.form.target is not None:
        return {}
    passed = {plural for used, plural in told if used - reading.used}
    return {f"whole_passes_{'several' if plural else 'one'}": 1.0 for plural in passed}


def _of_reading(
    reading: Reading,
    grounded: dict[PartQuery, Sequence[Grounded]],
    whole: Part,
    told: Sequence[tuple[frozenset[int], bool]],
    affinity: Affinity,
) -> Iterable[Candidate]:
    own = list(queries(reading.form))
    for ways in _combined([_best(reading, query, grounded[query], affinity, i) for i, query in enumerate(own)]):
        grounds = {query: way for query, (_, way) in zip(own, ways, strict=True)}
        senses = {query: (way.parts, index) for query, (index, way) in zip(own, ways, strict=True)}
        if isinstance(reading.form, Every) and _in_two_senses(reading.form, grounds):
            continue
        guessed = any(GUESSED in way.features for way in grounds.values())
        for option in range(GUESSES_OPTIONS if guessed else OPTIONS):
            try:
                written = write(reading.form, senses, whole, option)
            except Unwritable:
                continue
            features = _features(reading, grounds, written) | _passing(reading, told)
            features[FEATURE] = affinity.of(features, grounds.values())
            yield Candidate(reading, grounds, written, features)
            if not written.reads:
                break


def _in_two_senses(form: Every, grounds: Mapping[PartQuery, Grounded]) -> bool:
    """Was one noun taken for parts of one kind, and for parts of others where all such are asked for?"""
    kinds, such = ({part.kind for part in grounds[query].parts} for query in (form.target, form.among))
    return form.target.noun == form.among.noun and bool(such) and kinds.isdisjoint(such)


@cache
def things() -> frozenset[str]:
    """Nouns for the whole model, or for anything: 'part', 'piece'."""
    return frozenset(lexicon().words("whole"))


Way = tuple[int, Grounded]
"""A way to ground a query, and which of them it is."""


def _best(
    reading: Reading, query: PartQuery, ways: Sequence[Grounded], affinity: Affinity, place: int
) -> tuple[list[Way], list[Way]]:
    """The ways to ground a query of a reading, the best first, and those that only guess what its noun means."""
    found = [(i, way) for i, way in enumerate(ways) if not _drops(reading, query, way)]
    if isinstance(reading.form, Count) or (isinstance(reading.form, Towards) and query.plural):
        # where there are holes, 'holes' are no pockets
        own = {part.kind for _, way in found if is_own(way) and _fits_number(way) for part in way.parts}
        kinds = [{part.kind for part in way.parts} for _, way in found]
        found = [one for one, told in zip(found, kinds, strict=True) if not (own and told) or own & told]
    found.sort(key=lambda one: _score(one[1].features) + affinity.of_way(place, one[1]), reverse=True)
    known = [one for one in found if GUESSED not in one[1].features]
    return known, [one for one in found if GUESSED in one[1].features]


def _fits_number(way: Grounded) -> bool:
    """Are there several parts where the words say so?"""
    return not way.features.get("one_for_plural")


def is_own(way: Grounded) -> bool:
    """Are these what the noun itself means, just as is said?"""
    other = {name for name, value in way.features.items() if value}
    return _STRETCHED.isdisjoint(other) and not any(name.endswith("_dropped") for name in other)


def _combined(ways: Sequence[tuple[list[Way], list[Way]]]) -> Iterator[tuple[Way, ...]]:
    """The ways to ground all queries of a reading together; of several queries one is guessed at most."""
    alone = len(ways) < 2
    most, guesses = (GROUNDINGS, GUESSES) if alone else (GROUNDINGS_TOGETHER, GUESSES_TOGETHER)
    yield from itertools.product(*(known[:most] for known, _ in ways))
    for i, (_, guessed) in enumerate(ways):
        others = [known[:GUESSES_TOGETHER] for known, _ in ways]
        yield from itertools.product(*others[:i], guessed[:guesses], *others[i + 1 :])


def _drops(reading: Reading, query: PartQuery, way: Grounded) -> bool:
    """Does the grounding leave out what is asked for: 'are the holes blind?', 'which holes are wider than 8 mm?'"""
    if GUESSED in way.features and query.known and isinstance(reading.form, Count | Exists | Every | Either | Parts):
        return True  # what is decided, counted or listed is no guess
    if "which" in reading.features:
        return not _DECIDABLE.isdisjoint(way.features)
    if isinstance(reading.form, Count | Exists) and not _SURE.isdisjoint(way.features):
        return True  # how wide holes are is known, and whether they are blind
    noun = lexicon().nouns.get(query.noun)
    if isinstance(reading.form, Count) and noun and noun.name == "object" and way.features.get("sense_stretch"):
        return True  # the parts of a model are its bodies
    if isinstance(reading.form, Exists) and not _ELSE.isdisjoint(way.features):
        return True  # that there is one elsewhere, or something like it, says nothing
    if isinstance(reading.form, Exists) and "adjective_agrees" not in way.features:
        ordered = [found for name in query.adjectives if (found := lexicon().adjectives.get(name)) and found.order]
        if any(found.tags for found in ordered) and way.parts:
            return True  # the hole nearest to the middle is no central one
    form = reading.form
    shown = (isinstance(form, Every) and query == form.among) or (isinstance(form, Either) and query in form.options)
    if isinstance(form, Every) and bare_of(form.target, "object") and query == form.among:  # 'is it a gear?'
        return not CALLED_SO & way.features.keys() and (
            _stands_in(way) or way.features.get("sense_stretch", 0.0) > NEAR_SENSE
        )
    everywhere = "check_place" in reading.features and "place_whole" in way.features  # 'in the part' says nothing
    return shown and (everywhere or any(name.endswith("_dropped") for name in way.features))


def _features(reading: Reading, grounds: dict[PartQuery, Grounded], written: Written) -> Features:
    """Those of the words, of the groundings, and of the measures."""
    features: Features = dict(reading.features)
    for query, grounded in grounds.items():
        thing = not things().isdisjoint(query.words[-1:])  # 'the narrow bit' may be any part
        guessed = {"guessed_thing" if thing else "guessed_known": 1.0} if query.known else {}
        for name, value in (grounded.features | (guessed if GUESSED in grounded.features else {})).items():
            features[name] = features.get(name, 0.0) + value
    for read in written.reads:
        for name in (f"measure_{read.grade}", f"{read.measure} of {read.kind}", f"{read.measure} as {read.expression}"):
            features[name] = features.get(name, 0.0) + 1.0 / len(written.reads)
    if written.option:
        features["measure_option"] = float(written.option)
    features[f"form_{type(reading.form).__name__.lower()}"] = 1.0
    form = reading.form
    if isinstance(form, Get):
        features.update(_of_get(form, grounds, features.get("overall_part", 0.0)))
    if isinstance(form, Count | Exists | Parts):
        if not grounds[form.target].parts:
            features["counts_none"] = 1.0
            features["exists_none"] = float(isinstance(form, Exists))
        if any(name.endswith("_empties") for name in features):
            features["count_empties"] = 1.0
        if any(name.endswith(("_dropped", "_unknown")) for name in features):
            features["count_dropped"] = 1.0
        if "sense_kin" in features:
            features["count_kin"] = 1.0
    features.update(_of_two(form, grounds))
    features.update(_of_steps(written))
    return features


def _of_two(form: Form, grounds: dict[PartQuery, Grounded]) -> Features:
    """Are two parts that have different names the same one? Then one of them is hardly meant, unless that is asked."""
    if isinstance(form, Every):
        return {}
    named = {query.noun: frozenset(part.id for part in way.parts) for query, way in grounds.items()}
    return {"same_parts": float(len(named) > len(set(named.values())))}


def _of_steps(written: Written) -> Features:
    """Which step of a stepped part is read? Which words go with it is left to `affinity`."""
    widest = "max(p.radii)" in written.code or "outer_diameter" in written.code
    narrowest = not widest and ("min(p.radii)" in written.code or "inner_diameter" in written.code)
    return {name: 1.0 for name, holds in (("step_widest", widest), ("step_narrowest", narrowest)) if holds}


_DECIDABLE = frozenset(("size_dropped", "color_dropped", "denied_dropped"))
"""What a model surely shows, and cannot be left out where it says which parts are asked for."""
_SURE = frozenset(("size_dropped", "thread_dropped", "denied_dropped"))
"""What is counted is never the parts that are surely not so."""
_ELSE = frozenset((
    "place_dropped", "adjective_dropped", "trait_dropped", "sense_kin", "kin_instead", "modifier_means",
))  # fmt: skip
"""Groundings to other parts than are asked for."""
_STRETCHED = frozenset(("guessed", "sense_kin", "sense_wide", "sense_stretch", "whole_sense"))
"""Groundings of a noun that is no name of the parts' kind."""
_INSTEAD = frozenset(("guessed", "sense_kin", "sense_wide", "unknown_words", "whole_sense"))
"""Features of groundings to what has another name than the noun."""
NEAR_SENSE = 0.5
"""A model is a tube, or a washer, where no further sense of the noun has to be taken for it to be one."""
CALLED_SO = frozenset(("by_name", "file_named", "name_all"))
"""Features of a noun that names the model: its file or its body is called so."""
_HOLLOW = frozenset((Measure.DEPTH, Measure.OPENING, Measure.BOTTOM, Measure.EDGE_DISTANCE))


def _of_get(form: Get, grounds: dict[PartQuery, Grounded], overall: float) -> Features:
    """How the number of parts fits to the words, and whether the measure is one of the whole."""
    features: Features = {}
    measure = form.measures[0]
    if form.target is None:
        return {"whole_hollow": 1.0} if measure in _HOLLOW else {}
    parts = grounds[form.target].parts
    if form.reduce is Reduce.EACH and len(parts) == 1:
        features["each_of_one"] = 1.0
    if parts and measure is Measure.DEPTH:
        features["depth_through"] = float(all(part.bottom is Bottom.THROUGH for part in parts))
    if parts and parts[0].kind.is_whole:
        features["whole_as_part"] = float(parts[0].kind == "model")
        features["overall_is_whole"] = overall
    return features


MOST_DIGITS = 4
ROUND = 1e-5
"""Millimetres or degrees within which a value is a round one."""
INCH = 25.4


def _digits(value: float) -> int:
    """How many decimals a value in mm or degrees needs: what was chosen has few (ISO 3), or is a part of an inch."""
    found = [digits for digits in range(MOST_DIGITS) if abs(value - round(value, digits)) < ROUND]
    parts = ((64, 1), (1000, 2))  # of an inch
    found += [digits for part, digits in parts if abs(value - round(value / INCH * part) / part * INCH) < ROUND]
    return min(found, default=MOST_DIGITS)


NEAR = 1e-6
"""Metres within which a value is an extent."""


def _of_angle(candidate: Candidate, values: Sequence[float | str]) -> dict[str, float]:
    """Nobody asks what parallel axes enclose, nor how far what stands upright leans."""
    leans = not any(read.expression.endswith(".angle") for read in candidate.written.reads)
    angles = [value for value in values if not isinstance(value, str)]
    square = bool(angles) and all(abs(value - _SQUARE) < _ALIKE_RAD for value in angles)
    told = {"value_zero": any(abs(value) < _ALIKE_RAD for value in angles), "value_square": leans and square}
    drafted = any(read.measure == Measure.DRAFT for read in candidate.written.reads)
    told["value_steep"] = drafted and any(abs(value) > _DRAFT_RAD for value in angles)
    return {name: 1.0 for name, holds in told.items() if holds and candidate.written.expects in _ANGLES}


def with_value(candidate: Candidate, value: Any, extents: Sequence[float]) -> Candidate:
    """The candidate after its run, with features of the value: how many, how large, whether there is one."""
    features = dict(candidate.features)
    form = candidate.reading.form
    listed = value if isinstance(value, list) else [value]
    if candidate.written.expects in _VECTORS and all(isinstance(v, float) for v in listed):
        listed = [value]  # its coordinates are not several values
    flat = [round(v, 7) if isinstance(v, float) else repr(v) for v in listed]
    distinct = len(set(flat))
    if value is None or (value == [] and candidate.written.expects is not AnswerType.PARTS):  # 'none' is an answer
        features["value_none"] = 1.0
    one = isinstance(form, Get | Distance) and form.reduce is Reduce.ONE
    asked = max(len(form.measures), 1 + ("[*" in candidate.written.code)) if isinstance(form, Get) else 1
    if one and distinct > asked:
        features["values_several_for_one"] = 1.0
    if isinstance(form, Get) and len(form.measures) == 1 and form.reduce is Reduce.EACH and distinct > 1:
        features["values_differ_for_each"] = 1.0
    if isinstance(form, Which) and str(value).endswith("alike"):
        features["value_alike"] = 1.0  # neither is wider: then other parts are meant
    features |= _of_angle(candidate, flat)
    if candidate.written.expects in (AnswerType.LENGTH, AnswerType.LENGTHS):
        sizes = [v for v in listed if isinstance(v, float | int) and not isinstance(v, bool)]
        diagonal = math.dist((0.0, 0.0, 0.0), tuple(extents))
        if sizes and max(sizes) > 1.001 * diagonal:
            features["value_too_large"] = 1.0
        if sizes and min(sizes) <= 1e-7:
            features["value_zero"] = 1.0
        if (
            sizes
            and any(abs(max(sizes) - extent) < NEAR for extent in extents)
            and not (isinstance(form, Get) and form.target is None)
        ):
            features["value_is_extent"] = 1.0
    if candidate.written.expects in (AnswerType.LENGTH, AnswerType.LENGTHS, *_ANGLES):
        scale = 180 / math.pi if candidate.written.expects in _ANGLES else 1e3
        numbers = [v * scale for v in listed if isinstance(v, float)]
        features["value_digits"] = min(map(_digits, numbers), default=0) / MOST_DIGITS
    return replace(candidate, features=features, value=value)
