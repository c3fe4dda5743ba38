"""How well the words of a question and a program go together, beyond what the named features say.

Each word of a question, and each two neighbouring ones, are paired with each trait of a program: its form, its measure
and what that means, the kind of its parts, how its words link them. Each word is paired with what the parts are
(`part_traits`), too. `make fit` gives every pair a small weight; they stand in one table by hash, as two pairs may
share a place (Weinberger et al., Feature Hashing, ICML 2009).
"""

from __future__ import annotations

import math
import re
import struct
import zlib
from array import array
from collections.abc import Iterable, Mapping, Sequence
from functools import cache
from importlib.resources import files
from itertools import islice, pairwise

from querycad_contracts import Grounded, Part

from .part_traits import part_traits

SLOTS = 1 << 18
"""Places of the table; with four times as many nothing is answered better."""
FEATURE = "affinity"
PART_SHARE = 0.25
"""What a trait of parts counts beside one of the program: there are more of them, and each says less."""
MOST_WAYS = 2
"""So many queries of a program have parts that are looked at."""
_MIX = 2654435761  # the golden ratio of 32 bits: Knuth, The Art of Computer Programming, 6.4
_NUMBER = re.compile(r"[\d.,]+")
_SAYS_NOTHING = frozenset((
    "the", "a", "an", "of", "be", "to", "and", "it", "in", "for", "at", "by", "with", "from", "this", "that",
    "i", "you", "me", "my", "we", "do",
))  # fmt: skip
_TRAITS = frozenset((
    "asked_how", "along_axis", "overhang", "distance", "material_between", "link_whole", "check_place", "which_side",
    "level", "two_anchors", "each_other", "place_between", "place_as_anchor", "step_widest", "step_narrowest",
    "whole_sense", "sense_kin", "no_noun", "measure_option", "view_apart", "absent",
))  # fmt: skip
"""Features that say what a program is, beside its form, its measures and its kinds of part."""


def grams(words: Sequence[str]) -> list[str]:
    """The words of a question that may say something, and every two neighbouring ones; all numbers are one word."""
    told = ["0" if _NUMBER.fullmatch(word) else word for word in words]
    pairs = {f"{one} {other}" for one, other in pairwise(told)}
    return sorted({*told} - _SAYS_NOTHING) + sorted(pairs)


def traits(features: Mapping[str, float]) -> list[str]:
    """What a program is, by the features of its candidate: measures and kinds by themselves too."""
    found = [name for name, value in features.items() if value and _tells(name)]
    measures = {f"measure {name.partition(' as ')[0]}" for name in found if " as " in name}
    kinds = {f"kind {name.partition(' of ')[2]}" for name in found if " of " in name}
    return [*found, *sorted(measures | kinds)]


def _tells(name: str) -> bool:
    return name in _TRAITS or name.startswith("form_") or " as " in name or " of " in name


def placed(place: int, trait: str) -> str:
    """A trait of the parts of the first, or of the second query of a program."""
    return f"{place} {trait}"


def code(text: str) -> int:
    """The number that a word or a trait is known by."""
    return zlib.crc32(text.encode())


def slot(gram: int, trait: int) -> int:
    """The place of a pair, by the codes of both."""
    return (gram * _MIX ^ trait) % SLOTS


@cache
def _table() -> tuple[float, array[int]]:
    """What one step of a weight is, and the steps of all places."""
    return unpacked(files(__package__).joinpath("data").joinpath("affinity.bin").read_bytes())


def packed(weights: Sequence[float]) -> bytes:
    """The table as the package holds it: 8 bits a place, compressed."""
    step = max(map(abs, weights)) / 127 or 1.0
    steps = array("b", (round(weight / step) for weight in weights))
    return zlib.compress(struct.pack("<d", step) + steps.tobytes(), 9)


def unpacked(data: bytes) -> tuple[float, array[int]]:
    """What `packed` wrote."""
    raw = zlib.decompress(data)
    return struct.unpack_from("<d", raw)[0], array("b", raw[8:])


class Affinity:
    """The weights of the words of one question, added up for each trait when it is first asked for."""

    def __init__(self, words: Sequence[str], whole: Part) -> None:
        """`whole`: the part that stands for the model."""
        self._whole = whole
        self._codes = {gram: code(gram) for gram in grams(words)}
        self._known: dict[str, float] = {}
        self._ways: dict[tuple[int, int], tuple[Grounded, float]] = {}

    def of(self, features: Mapping[str, float], ways: Iterable[Grounded] = ()) -> float:
        """What speaks for a program of such features. `ways`: how each of its queries was grounded."""
        of_parts = (self.of_way(place, way) for place, way in enumerate(islice(ways, MOST_WAYS)))
        return math.fsum((*map(self._of_trait, traits(features)), *of_parts))

    def of_way(self, place: int, way: Grounded) -> float:
        """What speaks for the parts of one way to ground a query, by its place in the program."""
        key = place, id(way)  # which is kept beside, so that no other one gets its id
        if key not in self._ways:
            own = (self._of_trait(placed(place, trait), True) for trait in part_traits(way, self._whole))
            self._ways[key] = way, PART_SHARE * math.fsum(own)
        return self._ways[key][1]

    def _of_trait(self, trait: str, alone: bool = False) -> float:
        """Of all words together; of single words `alone`."""
        if (known := self._known.get(trait)) is None:
            step, steps = _table()
            own = code(trait)
            total = sum(steps[slot(gram, own)] for word, gram in self._codes.items() if not (alone and " " in word))
            known = self._known[trait] = step * total / math.sqrt(len(self._codes) or 1)
        return known
