"""The lexicon: which words mean which parts, measures, places and relations. The words are data, in `data/*.toml`."""

from __future__ import annotations

import re
import tomllib
from collections.abc import Iterable, Iterator, Sequence
from dataclasses import dataclass, field
from functools import cache, cached_property
from importlib.resources import files
from typing import Any, Literal, get_args

from querycad_contracts import Measure, Relation, Side

Order = Literal["size", "length", "width", "depth", "height", "thickness", "distance", "corner"]
Pick = Literal["lowest", "largest", "smallest", "wide", "standing", "tall", "low", "most", "elongated"]
Degree = Literal["positive", "more", "less", "most", "least"]
"""In the order of the lists of a scale in measures.toml."""
_MARKS: dict[str, tuple[str, Any]] = {
    **{mark: (mark, True) for mark in ("alone", "several")},
    **{mark: ("step", mark) for mark in ("widest", "narrowest")},
}
"""What marks of a sense other than picks set."""
_VALUES: dict[str, type[Side | Relation]] = {
    "side": Side, "view": Side, "place_extreme": Side, "ground": Side, "relation": Relation, "behind": Relation,
}  # fmt: skip
"""What the names in the tables of words.toml stand for; else for themselves."""
INCH = 0.0254


@dataclass(frozen=True, slots=True)
class Sense:
    """One thing that a noun can mean: the demands on a part, and how far it is from the word (0 to 1)."""

    kind: tuple[str, ...]
    tags: tuple[str, ...] = ()
    any: tuple[str, ...] = ()
    without: tuple[str, ...] = ()
    name: tuple[str, ...] = ()
    alone: bool = False
    several: bool = False
    step: Literal["widest", "narrowest"] | None = None
    pick: Pick | None = None
    stretch: float = 0.0


@dataclass(frozen=True, slots=True)
class Noun:
    """A noun for parts: its canonical name and its senses, the narrowest first."""

    name: str
    senses: tuple[Sense, ...]
    product: bool = False  # it may name the whole model
    apart: bool = False  # said apart it means the same: 'the bore of the cylinder'
    measure: Measure = Measure.MAGNITUDE  # what is asked where no measure is said: 'fork gap?' asks how wide it is


@dataclass(frozen=True, slots=True)
class Adjective:
    """What is demanded of parts: one of `tags`, else one of `fallback`, else a place in an order; none: nothing."""

    name: str
    tags: tuple[str, ...] = ()
    fallback: tuple[str, ...] = ()
    lacks: tuple[str, ...] = ()
    order: Order | None = None
    most: bool = True
    whole: bool = False
    loose: bool = False
    unchecked: bool = False
    decided: bool = False  # bodies and models without the tag are not so
    opposite: tuple[str, ...] = ()  # what has one of these tags, and none of its own, is surely not so


@dataclass(frozen=True, slots=True)
class Scale:
    """An adjective of a measure: 'deep', 'deeper', 'deepest', 'shallower'."""

    measure: Measure
    degree: Degree


@dataclass(frozen=True, slots=True)
class Span:
    """A stretch of tokens that the lexicon has a meaning for. `end` is exclusive."""

    start: int
    end: int
    category: str
    value: Any

    @property
    def tokens(self) -> range:
        """Where its tokens are."""
        return range(self.start, self.end)


_ARTICLES = frozenset(("the", "a", "an", "its", "their"))
_LEADING = ("of", "in", "across", "over", "at", "along", "between", "on")
_TAKEN = ("measure", "over_all", "facewise", "outside_to_outside", "surface_to_surface", "center_to_center")
"""Phrases of these categories are the same with an article behind a preposition of theirs."""


@dataclass
class Lexicon:
    """All phrases of the language by their words, folded and in the singular."""

    nouns: dict[str, Noun] = field(default_factory=dict)
    adjectives: dict[str, Adjective] = field(default_factory=dict)
    threads: dict[str, dict[str, float]] = field(default_factory=dict)
    """Name to pitch and holes, metres: 'core', 'tap drill', 'nominal', 'close', 'medium', 'loose' (clearance)."""
    hues: dict[str, tuple[float, float]] = field(default_factory=dict)
    units: dict[str, tuple[float, int]] = field(default_factory=dict)
    spelling: dict[str, str] = field(default_factory=dict)
    irregular: dict[str, str] = field(default_factory=dict)
    uninflected: frozenset[str] = frozenset()
    phrases: dict[str, list[tuple[str, Any]]] = field(default_factory=dict)  # phrase to its meanings: (category, value)
    longest: int = 1

    def add(self, category: str, value: Any, phrases: Iterable[str]) -> None:
        """Enters phrases of a category; words are folded as tokens are."""
        for phrase in phrases:
            words = [self.fold(word) for word in phrase.split()]
            meanings = self.phrases.setdefault(" ".join(words), [])
            if not any(known == category for known, _ in meanings):
                meanings.append((category, value))
            self.longest = max(self.longest, len(words))

    def fold(self, word: str) -> str:
        """Lower case, one spelling, singular."""
        word = self.spelling.get(word.lower(), word.lower())
        return self.singular(word) if " " not in word else word

    def singular(self, word: str) -> str:
        """Which singular does the word stand for, by the rules of English nouns?"""
        if word in self.irregular:
            return self.irregular[word]
        if word in self.uninflected or len(word) < 4 or not word.endswith("s") or word.endswith(("ss", "us", "is")):
            return word
        if word.endswith("ies"):
            return word[:-3] + "y"
        return word[:-2] if word.endswith(("ches", "shes", "sses", "xes", "zzes")) else word[:-1]

    def spans(self, words: Sequence[str]) -> list[list[Span]]:
        """Every phrase that begins at each word, the longest first; 'across its flats' is 'across flats'."""
        return [
            [
                Span(start, end, category, value)
                for end in range(min(len(words), start + self.longest), start, -1)
                for category, value in self._meanings(words[start:end])
            ]
            for start in range(len(words))
        ]

    def _meanings(self, words: Sequence[str]) -> Sequence[tuple[str, Any]]:
        found = self.phrases.get(" ".join(words), ())
        if found or len(words) < 3 or _ARTICLES.isdisjoint(words[1:-1]):
            return found
        bare = [word for i, word in enumerate(words) if not (i and word in _ARTICLES and words[i - 1] in _LEADING)]
        return [one for one in self.phrases.get(" ".join(bare), ()) if one[0] in _TAKEN] if len(bare) > 1 else ()

    @cached_property
    def vocabulary(self) -> frozenset[str]:
        """Every single word that occurs in some phrase."""
        return frozenset(word for phrase in self.phrases for word in phrase.split())

    @cached_property
    def turning(self) -> frozenset[str]:
        """Nouns of what turns: its width is along its axis."""
        return frozenset(self.words("turning"))

    @cached_property
    def wholes(self) -> frozenset[str]:
        """Adjectives that say that all of something is meant: 'complete'."""
        return frozenset(name for name, adjective in self.adjectives.items() if adjective.whole)

    @cached_property
    def plurals(self) -> dict[str, str]:
        """Plurals that no rule gives, by their singulars: 'feet' of 'foot'."""
        return {one: many for many, one in reversed(self.irregular.items())}

    def is_comparative(self, word: str) -> bool:
        """Does it compare two: 'larger', 'shorter'?"""
        scale = dict(self.phrases.get(word, ())).get("scale")
        return scale is not None and scale.degree in ("more", "less")

    def words(self, category: str) -> Iterator[str]:
        """All phrases of a category."""
        return (phrase for phrase, meanings in self.phrases.items() if any(c == category for c, _ in meanings))


def _load(name: str) -> dict[str, Any]:
    return tomllib.loads(files(__package__).joinpath("data").joinpath(f"{name}.toml").read_text(encoding="utf-8"))


def _sense(line: str) -> Sense:
    """'hole/cutout through (round|square) -tight @largest ~0.6', as parts.toml explains it."""
    kind, *demands = re.findall(r"\(.+?\)|\[.+?\]|\S+", line)
    signed = {sign: [one[1:].rstrip(")]") for one in demands if one[0] == sign] for sign in "([-@~"}
    fields = dict(_MARKS.get(mark, ("pick", mark)) for mark in signed["@"])
    return Sense(
        kind=tuple(kind.split("/")),
        tags=tuple(one for one in demands if one[0] not in signed),
        any=tuple(tag for tags in signed["("] for tag in tags.split("|")),
        name=tuple(name for names in signed["["] for name in names.split("|")),
        without=tuple(signed["-"]),
        stretch=float(next(iter(signed["~"]), 0)),
        **fields,
    )


@cache
def lexicon() -> Lexicon:
    """The product's lexicon, read once a process."""
    words = _load("words")
    lex = Lexicon(
        spelling=dict(pair.split(": ") for pairs in words.pop("spelling").values() for pair in pairs),
        irregular=words.pop("irregular"),
        uninflected=frozenset(words.pop("uninflected")),
    )  # fmt: skip
    _add_parts(lex, _load("parts"))
    _add_adjectives(lex, _load("adjectives")["adjective"])
    _add_measures(lex, _load("measures"))
    _add_words(lex, words)
    _add_standards(lex, _load("standards"))
    return lex


def _add_parts(lex: Lexicon, data: dict[str, Any]) -> None:
    for entry in data["part"]:
        words, senses = entry.pop("words"), tuple(_sense(line) for line in entry.pop("senses"))
        measure = Measure(entry.pop("measure", Measure.MAGNITUDE))
        noun = Noun(words[0], senses, measure=measure, **entry)
        lex.nouns |= dict.fromkeys(words, noun)
        lex.add("noun", noun, words)
    for word in data["products"]:
        senses = tuple(map(_sense, ("model @alone", f"body [{word}]", "model ~0.5")))
        lex.add("noun", lex.nouns.setdefault(word, Noun(word, senses, product=True)), [word])


def _add_adjectives(lex: Lexicon, entries: list[dict[str, Any]]) -> None:
    for entry in entries:
        words, nouns = entry.pop("words"), entry.pop("nouns", ())
        fields: dict[str, Any] = {name: tuple(v) if isinstance(v, list) else v for name, v in entry.items()}
        adjective = Adjective(words[0], **fields)
        lex.adjectives |= dict.fromkeys(words, adjective)
        lex.add("adjective", adjective, words)
        lex.add("trait", adjective, nouns)


def _add_words(lex: Lexicon, words: dict[str, Any]) -> None:
    """The closed classes: those with values of their own, and the plain lists of words."""
    for factor, power, names in words.pop("unit").values():
        lex.units |= dict.fromkeys(names, (factor, power))
    for category in ("number", "ordinal"):
        for word, value in words.pop(category).items():
            lex.add(category, value, [word])
    plain = words.pop("category")
    for category, table in words.items():
        for index, (name, names) in enumerate(table.items()):
            lex.add(category, index if category == "axis" else _VALUES.get(category, str)(name), names)
    for category, names in plain.items():
        lex.add(category, category, names)


def _add_measures(lex: Lexicon, data: dict[str, Any]) -> None:
    for name, phrases in data["nouns"].items():
        lex.add("measure", Measure(name), phrases)
    for name, degrees in data["scale"].items():
        for degree, phrases in zip(get_args(Degree), degrees, strict=True):
            lex.add("scale", Scale(Measure(name), degree), phrases)
    for category in ("reach", "verbs"):
        for name, phrases in data[category].items():
            gerunds = [re.sub(r"^(\S+?)e?(?!\S)", r"\1ing", phrase) for phrase in phrases]  # 'sticking out'
            lex.add(category, Measure(name), [*phrases, *gerunds])


def _screw_holes(nominal: float, pitch: float, tap: float, clear: Sequence[float], unit: float) -> dict[str, float]:
    """The holes of a thread by ISO 68-1 and ASME B1.1: D1 = D - 1.0825 P."""
    named = {"pitch": pitch, "core": nominal - 1.0825 * pitch, "tap drill": tap, "nominal": nominal}
    named |= dict(zip(("close", "medium", "loose"), clear, strict=False))
    return {name: size * unit for name, size in named.items()}


def _add_standards(lex: Lexicon, data: dict[str, Any]) -> None:
    for size, pitches, clear in data["metric"]:
        for pitch in pitches:
            tap = round(float(size) - pitch, 1 if float(size) >= 3 else 2)
            lex.threads[f"m{size}x{pitch:g}"] = holes = _screw_holes(float(size), pitch, tap, clear, 1e-3)
            lex.threads.setdefault(f"m{size}", holes)
    for size, nominal, per_inch, drills, clear in data["unified"]:
        for turns, tap in zip(per_inch, drills, strict=True):
            lex.threads[f"{size}-{turns}"] = _screw_holes(nominal, 1 / turns, tap, clear, INCH)
    for name, major, minor, tap in data["pipe"]:
        pitch = (major - minor) / 1.2807  # Whitworth's form: 2 x 0.640327 pitches deep
        lex.threads[name.lower()] = _screw_holes(major, pitch, tap, (), 1e-3) | {"core": minor * 1e-3}
    for name, outside, tap in data["npt"]:
        lex.threads[f"{name}npt"] = {"tap drill": tap * INCH, "nominal": outside * INCH}
    for name, density in data["material"].items():
        lex.add("material", float(density), [name])
    for name, (low, high) in data["colour"].items():
        lex.hues[name] = (float(low), float(high))
        lex.add("color", name, [name])
    lex.add("color", "gray", ["gray"])
    lex.phrases |= {name: [("color", name)] for name in ("silver", "black", "white")}
