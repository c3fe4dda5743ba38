"""What is printed of a model: the names and labels of its parts, as lists, descriptions and prompts write them."""

from __future__ import annotations

import re
from collections import defaultdict
from collections.abc import Iterator, Mapping, Sequence

from querycad_contracts import Part
from querycad_language.lexicon import lexicon

_OF_WHICH = re.compile(r"(?: \d+)? of \w+ \d+(?=,|$)| \d+$")
"""'chamfer of boss 10', 'tooth 3 of gear 1': which one is no matter to a group."""
_COUNT = re.compile(r"^\d+ ?x (?=[^\W\d])")
_WORD = re.compile(r"[^\W_]+(?:\.\d+)?")


def group_label(part: Part) -> str:
    """The label that a part shares with those like it: '4 x through hole, diameter 9 mm, depth 15 mm' has it once."""
    return _OF_WHICH.sub("", part.label)


def printed_labels(parts: Sequence[Part], alone: bool) -> Mapping[str, tuple[Part, ...]]:
    """Whole labels, names of bodies, and what labels begin with, such as 'spotfaced through hole', to their parts.

    A name has the parts of longer names that end in it, too: a counterbored through hole is a through hole. `alone`:
    the file holds one body, whose name is that of the model.
    """
    found: dict[str, list[Part]] = defaultdict(list)
    for part in parts:
        for text in dict.fromkeys(_texts(part, alone)):
            found[text].append(part)
    return {text: tuple(those) for text, those in found.items()}


def _texts(part: Part, alone: bool) -> Iterator[str]:
    if part.kind.is_whole:
        name = key(part.name or "")
        if name and (" " in name if part.kind == "model" else not alone):
            yield name
        return
    label = group_label(part)
    name = label.partition(",")[0].partition(" of ")[0] if part.kind == "pattern" else label.partition(",")[0]
    words = key(name).split()
    yield key(label)
    yield " ".join(words)
    yield from (" ".join(words[at:]) for at in range(1, len(words) - 1))


def key(said: str) -> str:
    """The words of a label, folded, in the singular and without a count before them: '4 x through holes, …'."""
    lex = lexicon()
    return " ".join(lex.fold(word) for word in _WORD.findall(_COUNT.sub("", said)))
