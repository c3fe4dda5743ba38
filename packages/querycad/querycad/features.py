"""`querycad features`: what recognition finds on a model, and what it refused and why."""

from __future__ import annotations

import argparse
import json
import sys
from collections.abc import Iterable
from pathlib import Path

from querycad_segworker.errors import FileProblem
from querycad_segworker.ingest import ingest
from querycad_segworker.model import ModelStore

from .settings import model_store

EXIT_DONE, EXIT_BAD_INPUT = 0, 2


def features(options: argparse.Namespace) -> int:
    """Prints the parts of a model, or what was refused; returns the exit code."""
    try:
        artefacts = ingest(Path(options.file), ModelStore(model_store()))
    except FileProblem as problem:
        print(f"querycad: {options.file}: {problem}", file=sys.stderr)
        return EXIT_BAD_INPUT
    if options.refused:
        refused = [refusal for refusal in artefacts.load_refused() if options.kind in (None, refusal.kind)]
        lines = [f"no {r.kind}: {r.reason} (faces {_listed(r.faces)})" for r in refused]
        records = [refusal.model_dump(mode="json") for refusal in refused]
    else:
        parts = [part for part in artefacts.load_model().parts if options.kind in (None, part.kind)]
        lines = [f"{part.id}: {part.label} (faces {_listed(part.faces)})" for part in parts]
        records = [part.model_dump(mode="json", exclude_defaults=True) for part in parts]
    print(json.dumps(records) if options.json else "\n".join(lines))
    return EXIT_DONE


def _listed(faces: Iterable[int], most: int = 8) -> str:
    ids = [str(face) for face in faces]
    more = f" and {len(ids) - most} more" if len(ids) > most else ""
    return ", ".join(ids[:most]) + more
