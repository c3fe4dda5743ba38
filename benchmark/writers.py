"""Who writes the better programs: the parser, a language model in one go, or the same as an agent?

`python -m benchmark.writers` asks a sample of facts-dev, CAD-Q&A and `benchmark/specified`, drawn by seed, in all
ways, and prints a table. Which language model that is the environment says: QUERYCAD_LLM_… as in docs/llm.md. Where
QUERYCAD_LLM_CONSTRAINED is set, it is also asked in one go without. Each outcome is a line of a file, and a run goes on
where one was interrupted; a question is asked in all ways before the next model's, so that what there is by then can be
compared. Run it in the repository's root.
"""

from __future__ import annotations

import argparse
import json
import random
import time
from collections import Counter
from collections.abc import Iterator, Sequence
from contextlib import ExitStack
from dataclasses import asdict, dataclass, field
from pathlib import Path
from typing import Any

from benchmark.understanding.data import Question, is_right, questions
from benchmark.understanding.data import asked as asked_in
from querycad.runtime import EmbeddedRuntime
from querycad_answering.llm import LlmSettings
from querycad_contracts import AnswerOptions, AnswerRecord, Codegen

SETS: dict[str, str | tuple[str, ...]] = {
    "facts-dev": "facts:",
    "CAD-Q&A": "cad-qa",
    "specified": ("specifier", "library_user", "side_viewer"),
}
"""Names of the sets, and how their writers begin."""
SPECIFIED = Path("benchmark/specified")
SEED = 18
COLUMNS = (
    *("questions", "asked", "way", "right", "wrong", "no answer", "the parser stepped in", "replies"),
    *("tokens written", "seconds"),
)
PARSER, SINGLE, HELD, AGENT = "parser", "llm", "llm-constrained", "agent"


@dataclass(frozen=True, slots=True)
class Outcome:
    """What came of one question, asked in one way."""

    way: str
    set: str
    model: str
    question: str
    truth: Any
    value: Any
    right: bool
    status: str
    codegen: str | None
    """Who wrote the program that answers: the parser, where the language model has none."""
    replies: int
    tokens_in: int
    tokens_out: int
    seconds: float
    warnings: tuple[str, ...] = ()
    attempts: list[dict[str, Any]] = field(default_factory=list)

    @property
    def stepped_in(self) -> bool:
        """Did the parser answer for a language model that has no answer?"""
        return self.way != PARSER and self.codegen == "parser"


def sample(wanted: dict[str, int], seed: int) -> list[tuple[str, Question]]:
    """So many questions of each set, in proportion from each of its writers; model by model, in any order."""
    drawn: list[tuple[str, Question]] = []
    source = [*questions(), *(one for file in sorted(SPECIFIED.glob("*.json")) for one in asked_in(file))]
    for name, number in wanted.items():
        chance = random.Random(f"{seed} {name}")  # noqa: S311 - no secret
        of_set = [one for one in source if one.writer.startswith(SETS[name])]
        strata: dict[str, list[Question]] = {}
        for one in of_set:
            strata.setdefault(one.writer, []).append(one)
        for stratum in strata.values():
            chance.shuffle(stratum)
        # The question at each place of its stratum comes when that share of every stratum has been drawn.
        ranked = sorted(
            ((place + 0.5) / len(stratum), one.writer, one.model, one.question)
            for stratum in strata.values()
            for place, one in enumerate(stratum)
        )
        keys = {row[1:] for row in ranked[:number]}
        drawn += [(name, one) for one in of_set if (one.writer, one.model, one.question) in keys]
    models = sorted({one.model for _, one in drawn})
    random.Random(seed).shuffle(models)  # noqa: S311 - no secret
    return sorted(drawn, key=lambda item: models.index(item[1].model))


def ways(settings: LlmSettings) -> dict[str, tuple[Codegen, LlmSettings]]:
    """In which ways is each question asked? Without a language model, by the parser alone."""
    found = {PARSER: (Codegen.PARSER, settings)}
    if settings.is_configured:
        free = LlmSettings.model_validate(settings.model_dump() | {"llm_constrained": "none"})
        found[SINGLE] = (Codegen.LLM, free)
        if free.constrained is not settings.constrained:
            found[HELD] = (Codegen.LLM, settings)
        found[AGENT] = (Codegen.AGENT, settings)
    return found


def ask(runtime: EmbeddedRuntime, way: str, codegen: Codegen, of_set: str, one: Question) -> Outcome:
    """What comes of the question?"""
    runtime.view(one.file)  # read before the clock starts
    start = time.perf_counter()
    record: AnswerRecord = runtime.ask(one.file, one.question, options=AnswerOptions(codegen=codegen))
    seconds = time.perf_counter() - start
    value = record.answer.value if record.answer is not None else None
    plain = json.loads(json.dumps(value, default=str))
    return Outcome(
        way=way,
        set=of_set,
        model=one.model,
        question=one.question,
        truth=one.truth if one.pattern is None else one.pattern,
        value=plain,
        right=is_right(plain, one),
        status=record.status.value,
        codegen=record.codegen,
        replies=len(record.attempts),
        tokens_in=record.tokens.input if record.tokens is not None else 0,
        tokens_out=record.tokens.output if record.tokens is not None else 0,
        seconds=round(seconds, 1),
        warnings=record.warnings,
        attempts=[attempt.model_dump(mode="json") for attempt in record.attempts],
    )


def kept(path: Path) -> list[Outcome]:
    """The outcomes in a file."""
    if not path.is_file():
        return []
    return [Outcome(**json.loads(line)) for line in path.read_text(encoding="utf-8").splitlines()]


def table(outcomes: Sequence[Outcome]) -> Iterator[str]:
    """Of the questions that were asked in every way: how many are right, by set and way."""
    names = list(dict.fromkeys(one.way for one in outcomes))
    asked = Counter((one.set, one.model, one.question) for one in outcomes)
    whole = [one for one in outcomes if asked[one.set, one.model, one.question] == len(names)]
    yield f"| {' | '.join(COLUMNS)} |"
    yield "|---|--:|---|--:|--:|--:|--:|--:|--:|--:|"
    for name in [*dict.fromkeys(one.set for one in whole), "both"]:
        for way in names:
            of = [one for one in whole if one.way == way and name in (one.set, "both")]
            if not of:
                continue
            right, none = sum(one.right for one in of), sum(one.value is None for one in of)
            cells = (name, len(of), way, right, len(of) - right - none, none, sum(one.stepped_in for one in of))
            means = [
                sum(values) / len(of)
                for values in zip(*((o.replies, o.tokens_out, o.seconds) for o in of), strict=True)
            ]
            yield f"| {' | '.join(map(str, cells))} | {means[0]:.1f} | {means[1]:.0f} | {means[2]:.0f} |"


def differences(outcomes: Sequence[Outcome], first: str, second: str) -> Iterator[str]:
    """The questions of which one of two ways has the right answer, and the other has not."""
    by_key: dict[tuple[str, str], dict[str, Outcome]] = {}
    for one in outcomes:
        by_key.setdefault((one.model, one.question), {})[one.way] = one
    for (model, question), of in by_key.items():
        if first in of and second in of and of[first].right != of[second].right:
            winner = first if of[first].right else second
            yield f"{winner}: {model}: {question}\n  {of[first].truth}"
            yield from (
                f"  {way}: {of[way].value} by {of[way].codegen}, {of[way].replies} replies" for way in (first, second)
            )


def asked(
    drawn: Sequence[tuple[str, Question]],
    chosen: dict[str, tuple[Codegen, LlmSettings]],
    file: Path,
    known: Sequence[Outcome],
) -> Iterator[Outcome]:
    """Asks what is not known yet, all of one model in one way after the other, and adds it to the file."""
    done = {(one.way, one.model, one.question) for one in known}
    file.parent.mkdir(parents=True, exist_ok=True)
    with ExitStack() as stack:
        store = file.with_suffix(".models")
        runtimes = {way: stack.enter_context(EmbeddedRuntime(store, llm=llm)) for way, (_, llm) in chosen.items()}
        for model in dict.fromkeys(one.model for _, one in drawn):
            for way, (codegen, _) in chosen.items():
                for of_set, one in drawn:
                    if one.model != model or (way, model, one.question) in done:
                        continue
                    outcome = ask(runtimes[way], way, codegen, of_set, one)
                    with file.open("a", encoding="utf-8") as lines:
                        lines.write(json.dumps(asdict(outcome), ensure_ascii=False) + "\n")
                    yield outcome


def main(argv: Sequence[str] | None = None) -> int:
    """Asks and prints; returns the exit code."""
    parser = argparse.ArgumentParser(prog="python -m benchmark.writers", description=__doc__.splitlines()[0])
    parser.add_argument("--facts", type=int, default=36, metavar="N", help="questions of facts-dev (36)")
    parser.add_argument("--published", type=int, default=24, metavar="N", help="questions of CAD-Q&A (24)")
    parser.add_argument("--specified", type=int, default=0, metavar="N", help="questions of benchmark/specified (0)")
    parser.add_argument("--seed", type=int, default=SEED, help=f"which are drawn ({SEED})")
    parser.add_argument("--ways", metavar="WAY,…", help=f"some of {PARSER}, {SINGLE}, {HELD}, {AGENT}")
    parser.add_argument("--out", type=Path, default=Path("build/writers.jsonl"), help="where outcomes are kept")
    parser.add_argument("--table", action="store_true", help="ask nothing: print what was kept")
    parser.add_argument("--differ", nargs=2, metavar="WAY", help="print where only one of two ways is right")
    options = parser.parse_args(argv)
    outcomes = kept(options.out)
    if not options.table:
        chosen = ways(LlmSettings.read())
        named = options.ways.split(",") if options.ways else list(chosen)
        if unknown := [way for way in named if way not in chosen]:
            parser.error(f"there is no way {unknown[0]!r} here; there are: {', '.join(chosen)}")
        wanted = {"facts-dev": options.facts, "CAD-Q&A": options.published, "specified": options.specified}
        drawn = sample(wanted, options.seed)
        for one in asked(drawn, {way: chosen[way] for way in named}, options.out, tuple(outcomes)):
            outcomes.append(one)
            mark = "right" if one.right else "wrong"
            print(f"{mark} {one.way}: {one.question} ({one.replies} replies, {one.seconds:.0f} s)", flush=True)
    print("\n".join(differences(outcomes, *options.differ) if options.differ else table(outcomes)))
    return 0


if __name__ == "__main__":
    raise SystemExit(main())
