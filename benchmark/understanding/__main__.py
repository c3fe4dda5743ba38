"""`python -m benchmark.understanding`: collect candidates, fit the weights, print the cross-validated score.

python -m benchmark.understanding fit               collect, cross-validate, fit, write weights.toml and the figures
python -m benchmark.understanding score FILE ...    the score of questions that nothing was fitted on
python -m benchmark.understanding ask FILE ...      likewise, of what the product answers, several questions in one too
python -m benchmark.understanding compare OLD NEW   two collections beside each other: what was gained, what was lost

`--rows PATH` keeps what fit and score collect, to compare it later; fit reads it instead where it is there.
"""

from __future__ import annotations

import argparse
import hashlib
import json
import tomllib
from pathlib import Path

from benchmark.scoring.own_models import own_models
from querycad_answering.affinity import packed
from querycad_language.weights import calibration, weights

from .affinity import Pairs
from .collect import Row, collect, kept, read_kept
from .compare import compared
from .cross_validation import asks_for_missing, cross_validated, fitted, judged, risk_and_coverage, summary
from .data import Question, asked, questions
from .fit import Table
from .plot import draw
from .product import answered_by_product
from .table import write

PRIOR = Path(__file__).with_name("prior.toml")
RESULTS = Path(__file__).with_name("results.json")
AFFINITY = Path("packages/answering/querycad_answering/data/affinity.bin")
STORE = Path("build/understanding")


def main() -> int:
    """Runs one of the commands; returns the exit code."""
    parser = argparse.ArgumentParser(prog="python -m benchmark.understanding", description=__doc__)
    parser.add_argument("command", choices=("fit", "score", "ask", "compare"))
    parser.add_argument("files", nargs="*", type=Path, help="of score and ask: files as in benchmark/asked")
    parser.add_argument("--rows", type=Path, help="where the candidates of all questions are kept")
    parser.add_argument("--jobs", type=int, default=2)
    parser.add_argument(
        "--rounds", type=int, default=1, help="of fit: candidates are collected anew with the new weights"
    )
    options = parser.parse_args()
    if options.command == "compare":
        print(compared(*map(read_kept, options.files)))
        return 0
    own_models(options.jobs)
    own_models(options.jobs, last_look=True)
    if options.command == "fit":
        return _fit(options.jobs, options.rounds, options.rows)
    data = [one for file in options.files for one in asked(file)] or questions(held_out=True)
    if options.command == "ask":
        print(summary(answered_by_product(data, STORE, options.jobs)))
    else:
        rows: list[Row] = kept(collect(data, STORE, options.jobs), options.rows)
        print(summary(judged(rows, weights(), calibration())))
    return 0


def _fit(jobs: int, rounds: int, path: Path | None) -> int:
    prior: Table = tomllib.loads(PRIOR.read_text(encoding="utf-8"))["weights"]
    data = questions()
    for number in range(rounds):
        known = path is not None and path.exists() and number == 0
        rows = read_kept(path) if path is not None and known else kept(collect(data, STORE, jobs), path)
        if {_name(row.question) for row in rows} != set(map(_name, data)):
            raise SystemExit(f"{path} holds other questions than there are now: collect them anew")
        told, doubts = cross_validated(rows, prior, jobs)
        table, pairs = fitted(rows, prior, Pairs(rows))
        text = summary(told)
        there = [one for one in told if not asks_for_missing(one.fold)]
        right = sum(one.right for one in there) / len(there)
        AFFINITY.write_bytes(packed(pairs.tolist()))
        write(
            table,
            doubts,
            f"{len(data)} questions, data {_hash(data)}; cross-validated by writer and model: {right:.3f} right",
        )
    print(text)
    draw(there)
    curve = [{"threshold": t, "coverage": round(c, 4), "risk": round(r, 4)} for t, c, r in risk_and_coverage(there)]
    RESULTS.write_text(
        json.dumps({"data": _hash(data), "table": text.splitlines(), "risk_and_coverage": curve}, indent=1) + "\n",
        encoding="utf-8",
    )
    return 0


def _name(one: Question) -> tuple[str, str, str]:
    return one.model, one.writer, one.question


def _hash(data: list[Question]) -> str:
    """What identifies the questions that the weights were fitted on."""
    text = json.dumps([[one.model, one.writer, one.question, repr(one.truth)] for one in data])
    return hashlib.sha256(text.encode()).hexdigest()[:16]


if __name__ == "__main__":
    raise SystemExit(main())
