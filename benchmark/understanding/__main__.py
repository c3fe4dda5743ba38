"""`python -m benchmark.understanding`: collect candidates, fit the weights, print the cross-validated score.

python -m benchmark.understanding fit              collect, cross-validate, fit, write weights.toml and the figures
python -m benchmark.understanding score FILE ...   the score of questions that nothing was fitted on
python -m benchmark.understanding ask FILE ...     likewise, of what the product answers, several questions in one too
"""

from __future__ import annotations

import argparse
import hashlib
import json
import tomllib
from pathlib import Path

from benchmark.scoring.own_models import own_models
from querycad_language.weights import calibration, weights

from .collect import Row, collect
from .cross_validation import asks_for_missing, cross_validated, judged, risk_and_coverage, summary, weights_of
from .data import Question, asked, questions
from .fit import Table
from .plot import draw
from .product import answered_by_product
from .table import write

PRIOR = Path(__file__).with_name("prior.toml")
RESULTS = Path(__file__).with_name("results.json")
STORE = Path("build/understanding")


def main() -> int:
    """Runs one of the commands; returns the exit code."""
    parser = argparse.ArgumentParser(prog="python -m benchmark.understanding", description=__doc__)
    parser.add_argument("command", choices=("fit", "score", "ask"))
    parser.add_argument("files", nargs="*", type=Path, help="of score and ask: files as in benchmark/asked")
    parser.add_argument("--jobs", type=int, default=2)
    parser.add_argument(
        "--rounds", type=int, default=1, help="of fit: candidates are collected anew with the new weights"
    )
    options = parser.parse_args()
    own_models(options.jobs)
    own_models(options.jobs, last_look=True)
    if options.command == "fit":
        return _fit(options.jobs, options.rounds)
    data = [one for file in options.files for one in asked(file)] or questions(held_out=True)
    if options.command == "ask":
        print(summary(answered_by_product(data, STORE, options.jobs)))
    else:
        rows: list[Row] = collect(data, STORE, options.jobs)
        print(summary(judged(rows, weights(), calibration())))
    return 0


def _fit(jobs: int, rounds: int) -> int:
    prior: Table = tomllib.loads(PRIOR.read_text(encoding="utf-8"))["weights"]
    data = questions()
    for _ in range(rounds):
        rows = collect(data, STORE, jobs)
        table, doubts = weights_of(rows, prior)
        told = cross_validated(rows, prior, jobs)
        text = summary(told)
        there = [one for one in told if not asks_for_missing(one.fold)]
        right = sum(one.right for one in there) / len(there)
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


def _hash(data: list[Question]) -> str:
    """What identifies the questions that the weights were fitted on."""
    text = json.dumps([[one.model, one.writer, one.question, repr(one.truth)] for one in data])
    return hashlib.sha256(text.encode()).hexdigest()[:16]


if __name__ == "__main__":
    raise SystemExit(main())
