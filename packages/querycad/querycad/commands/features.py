"""`querycad features`: what recognition finds on a model, as a drawing would say it, and what it refused and why."""

from __future__ import annotations

import argparse
import json
from collections import Counter
from collections.abc import Iterable, Iterator, Sequence

from querycad_answering.drawing.callouts import callout, callouts, carried_sections
from querycad_answering.drawing.describing import is_bare_surface, listing
from querycad_answering.drawing.numbers import unit_name
from querycad_contracts import LengthUnit, Part, PartKind
from querycad_language.describe import plural_of
from querycad_segworker.model import Artefacts

from .outcomes import EXIT_BAD_INPUT, EXIT_DONE, complain
from .reading import read

FACES_LISTED = 8


def features(options: argparse.Namespace) -> int:
    """Prints the parts of a model, or what was refused; returns the exit code."""
    if options.kind is not None and not options.refused:
        singular = options.kind.lower().removesuffix("s")
        kinds = [kind.value for kind in PartKind if kind is not PartKind.REGION]
        options.kind = next((kind for kind in kinds if kind in (options.kind.lower(), singular)), options.kind)
        if options.kind not in kinds:
            return complain(f"no kind of part is called '{options.kind}'; there are {', '.join(kinds)}")
    artefacts = read(options.file)
    if artefacts is None:
        return EXIT_BAD_INPUT
    if options.refused:
        return _refused(artefacts, options)
    parts = artefacts.load_model().parts
    wanted = [part for part in parts if options.kind in (None, part.kind)]
    if options.json:
        print(json.dumps([part.model_dump(mode="json", exclude_defaults=True) for part in wanted]))
        return EXIT_DONE
    if options.kind is not None and not wanted:
        present = ", ".join(sorted({part.kind.value for part in parts}))
        return complain(f"{options.file}: the model has no {options.kind}; it has {present}")
    for line in _each(wanted, parts, options) if options.all else _grouped(wanted, parts, options):
        print(line)
    return EXIT_DONE


def _refused(artefacts: Artefacts, options: argparse.Namespace) -> int:
    refused = artefacts.load_refused()
    wanted = [refusal for refusal in refused if options.kind in (None, refusal.kind)]
    if options.kind is not None and not wanted:
        return complain(
            f"nothing was refused as '{options.kind}', but as {', '.join(sorted({r.kind for r in refused}))}"
        )
    if options.json:
        print(json.dumps([refusal.model_dump(mode="json") for refusal in wanted]))
    for refusal in () if options.json else wanted:
        print(f"no {refusal.kind}: {refusal.reason} (faces {listed(refusal.faces)})")
    return EXIT_DONE


def _each(wanted: Sequence[Part], parts: Sequence[Part], options: argparse.Namespace) -> Iterator[str]:
    known = {part.id: part for part in parts}
    unit = LengthUnit(options.unit)
    for part in wanted:
        text = callout(part, unit, known, symbols=options.symbols)
        yield f"{part.id}: {text} (faces {listed(part.faces)})"


def _grouped(wanted: Sequence[Part], parts: Sequence[Part], options: argparse.Namespace) -> Iterator[str]:
    known = {part.id: part for part in parts}
    unit = LengthUnit(options.unit)
    if options.kind is not None:
        told, surfaces = list(wanted), Counter[str]()
    else:
        carried = carried_sections(parts)
        bare = [part for part in wanted if is_bare_surface(part)]
        left_out = {*carried, *(part.id for part in bare)}
        told = [part for part in wanted if part.kind is not PartKind.MODEL and part.id not in left_out]
        surfaces = Counter(part.kind.value for part in bare)
    yield f"lengths in {unit_name(unit)}"
    yield from listing(callouts(told, unit, known, symbols=options.symbols))
    if surfaces:
        counted = ", ".join(f"{count} {kind if count == 1 else plural_of(kind)}" for kind, count in surfaces.items())
        yield f"surfaces by shape: {counted}; --kind lists those of one, --all each part"


def listed(faces: Iterable[int]) -> str:
    """The numbers of faces; after `FACES_LISTED` the rest is counted."""
    ids = [str(face) for face in faces]
    more = f" and {len(ids) - FACES_LISTED} more" if len(ids) > FACES_LISTED else ""
    return ", ".join(ids[:FACES_LISTED]) + more
