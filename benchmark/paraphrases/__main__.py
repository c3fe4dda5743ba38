"""Do many ways to ask the same have the same answer? No truth is needed: ways that differ are wrong, or the others are.

`python -m benchmark.paraphrases [FILE.step …]` asks every family of `families.json` about each model (the examples,
where none is given), in process and without a language model, and prints the share of ways that agree with most of
their family; `--odd` prints those that do not. Run it in the repository's root.
"""

from __future__ import annotations

import argparse
import json
from collections import Counter, defaultdict
from collections.abc import Iterator
from dataclasses import dataclass
from pathlib import Path

from querycad.runtime import EmbeddedRuntime
from querycad_answering.ranking import key

FAMILIES = Path(__file__).with_name("families.json")


@dataclass(frozen=True, slots=True)
class Way:
    """One way to ask, what was answered, and what most ways of its family were answered."""

    family: str
    model: str
    question: str
    answer: str
    most: str


def ways(runtime: EmbeddedRuntime, model: Path, only: frozenset[str] = frozenset()) -> Iterator[Way]:
    """All ways of all families about one model; of a family with a noun, once for each kind of part that it has."""
    data = json.loads(FAMILIES.read_text(encoding="utf-8"))
    kinds = {str(part.kind) for part in runtime.open(model).parts}
    for family, texts in data["families"].items():
        if only and family not in only:
            continue
        needed = data["kinds"].get(family, data["nouns"])
        named = any("{" in text for text in texts)
        if not named and family in data["kinds"] and not kinds & set(needed):
            continue
        for noun in [kind for kind in needed if kind in kinds] if named else [""]:
            asked = [text.format(x=noun, X=data["nouns"].get(noun, "")) for text in texts]
            answers = [_answer(runtime, model, question) for question in asked]
            most = Counter(answers).most_common(1)[0][0]
            for question, answer in zip(asked, answers, strict=True):
                yield Way(family, model.stem, question, answer, most)


def _answer(runtime: EmbeddedRuntime, model: Path, question: str) -> str:
    """The most probable value, sure or not, as text that is the same for the same value."""
    answer = runtime.ask(model, question).answer
    return key(answer.value) if answer is not None else "none"


def main() -> None:
    """Asks, and prints a line a family."""
    parser = argparse.ArgumentParser(prog="python -m benchmark.paraphrases", description=__doc__)
    parser.add_argument("files", nargs="*", type=Path)
    parser.add_argument("--odd", action="store_true", help="print the ways that differ from most of their family")
    options = parser.parse_args()
    runtime = EmbeddedRuntime()
    found: dict[str, list[Way]] = defaultdict(list)
    for file in options.files or sorted(Path("examples").glob("*.step")):
        for way in ways(runtime, file):
            found[way.family].append(way)
    for family, asked in found.items():
        odd = [way for way in asked if way.answer != way.most]
        print(f"{family:24} {len(asked):5} {1 - len(odd) / len(asked):.3f}")
        for way in odd if options.odd else ():
            print(f"    {way.model}: {way.question}  {way.answer[:60]}  (most: {way.most[:60]})")
    whole = [way for asked in found.values() for way in asked]
    print(f"{'all':24} {len(whole):5} {sum(way.answer == way.most for way in whole) / len(whole):.3f}")


if __name__ == "__main__":
    main()
