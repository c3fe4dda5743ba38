"""`querycad explain`: what a question can mean on a model, what speaks for each reading, and what each would answer."""

from __future__ import annotations

import argparse
import json
from collections.abc import Sequence
from typing import Any

from querycad.runtime import EmbeddedRuntime
from querycad_answering.candidates import Absence, Candidate
from querycad_answering.confidence import skipped, unchecked
from querycad_answering.ranking import Value, key, softmax
from querycad_answering.typed import WrongAnswerType, typed_answer
from querycad_answering.understanding import Understanding, meant
from querycad_contracts import Expectation, LengthUnit
from querycad_language.describe import noun_phrase
from querycad_language.weights import weights
from querycad_segworker.errors import FileProblem

from .outcomes import EXIT_DONE, complain_of

FEATURES_SHOWN = 6
"""Of each reading those that weigh most."""


def explain(options: argparse.Namespace) -> int:
    """Prints the readings, the best first; returns the exit code."""
    with EmbeddedRuntime() as runtime:
        try:
            view = runtime.view(options.file)
            understanding = Understanding(options.question, view, Expectation())
            tried = understanding.tried(runtime.runner(options.file), every=True)
        except FileProblem as problem:
            return complain_of(options.file, problem)
    ranking = understanding.ranking(tried)
    refused = understanding.refused or understanding.missing(ranking)
    unit = LengthUnit(options.unit)
    told = _told(tried, ranking.values, unit)
    lacking = [_lacking(one) for one in understanding.absences]
    if options.json:
        refusal = refused.model_dump(mode="json") if refused is not None else None
        print(json.dumps({"question": options.question, "refused": refusal, "readings": told, "absent": lacking}))
        return EXIT_DONE
    if refused is not None:
        print(f"refused: {refused.message}")
    if not told:
        print("no reading")
    for number, reading in enumerate(told, 1):
        _print(number, reading)
    if lacking:
        print(f"the part may be missing, probability {ranking.absent:.2f}:")
    for one in lacking:
        print(f"-  {one['part']}: score {one['score']:.2f}")
    return EXIT_DONE


def _lacking(absence: Absence) -> dict[str, Any]:
    """A part that the model may lack, and what speaks for that."""
    part = noun_phrase(absence.query)
    return {"part": part, "score": round(absence.score, 3), "features": _features(absence)}


def _told(tried: list[Candidate], found: Sequence[Value], unit: LengthUnit) -> list[dict[str, Any]]:
    """Each program that was run, with the confidence of its value."""
    shares = softmax([one.score for one in tried]) if tried else []
    sure = {key(value.candidate.value): value.confidence for value in found}
    readings = []
    for candidate, share in sorted(zip(tried, shares, strict=True), key=lambda pair: pair[1], reverse=True):
        readings.append(
            {
                "understood_as": meant(candidate),
                "score": round(candidate.score, 3),
                "probability": round(share, 4),
                "confidence": round(sure[key(candidate.value)], 3) if key(candidate.value) in sure else None,
                "value": candidate.value,
                "text": _text(candidate, unit),
                "features": _features(candidate),
                "skipped": list(skipped(candidate)),
                "unchecked": list(unchecked(candidate)),
                "parts": [part.id for grounded in candidate.grounds.values() for part in grounded.parts],
                "code": candidate.written.code,
            }
        )
    return readings


def _features(candidate: Candidate | Absence) -> dict[str, dict[str, float]]:
    """Each feature with its value, weight and product, those that decide most first."""
    table = weights()
    found = {
        name: {"value": round(value, 3), "weight": table.get(name, 0.0), "adds": round(table.get(name, 0.0) * value, 3)}
        for name, value in candidate.features.items()
        if value
    }
    return dict(sorted(found.items(), key=lambda item: abs(item[1]["adds"]), reverse=True))


def _text(candidate: Candidate, unit: LengthUnit) -> str:
    if candidate.value is None:
        return "no value"
    try:
        return typed_answer(candidate.value, candidate.written.expects, unit, candidate.written.code).text
    except WrongAnswerType as error:
        return str(error)


def _print(number: int, reading: dict[str, Any]) -> None:
    sure = "" if reading["confidence"] is None else f", confidence {reading['confidence']:.2f}"
    print(f"{number}. {reading['understood_as']}: {reading['text']}")
    print(f"   score {reading['score']:.2f}, probability {reading['probability']:.2f}{sure}")
    shown = list(reading["features"].items())[:FEATURES_SHOWN]
    print("   " + ", ".join(f"{name} {one['adds']:+.2f}" for name, one in shown))
    if reading["skipped"]:
        print(f"   skipped: {', '.join(reading['skipped'])}")
    if reading["unchecked"]:
        print(f"   not checked: {', '.join(reading['unchecked'])}")
