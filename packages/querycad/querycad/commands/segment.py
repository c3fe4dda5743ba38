"""`querycad segment`: what every stage of the vision path makes of a model, as pictures."""

from __future__ import annotations

import argparse
from pathlib import Path

from querycad.settings import weights_folder
from querycad_contracts import Face
from querycad_segworker.grounding.find import find
from querycad_segworker.grounding.inventory import Inventory
from querycad_segworker.model import Artefacts, Model

from .outcomes import EXIT_BAD_INPUT, EXIT_DONE, EXIT_FAILED, complain
from .reading import read


def segment(options: argparse.Namespace) -> int:
    """Looks for the phrase and writes the pictures; returns the exit code: 2 where there is nothing to look with."""
    artefacts = read(options.file)
    if artefacts is None:
        return EXIT_BAD_INPUT
    try:
        return _segment(options, artefacts, artefacts.load_model(), artefacts.load_faces())
    except OSError as error:
        return complain(f"{options.out}: {error.strerror}", EXIT_FAILED)


def _segment(options: argparse.Namespace, artefacts: Artefacts, model: Model, faces: tuple[Face, ...]) -> int:
    from querycad_segworker.fusing.fusion import sightings
    from querycad_segworker.segcad.engines.known import KnownParts
    from querycad_segworker.segcad.engines.null_models import NULL_MODELS
    from querycad_segworker.segcad.inspection.show import SHEET, look_and_draw, save_views
    from querycad_segworker.segcad.ports import VisionOptions, WeightsAbsent

    numbers = VisionOptions(
        views=options.views,
        width=options.size[0],
        height=options.size[1],
        shaded=options.shaded,
        box_threshold=options.box_threshold,
        azimuth_offset_deg=options.azimuth,
        elevation_deg=options.elevation,
        color_seed=options.color_seed,
        face_share=options.face_share,
        largest_mask=options.largest_mask,
        covered=options.covered,
        join_neighbours=options.join_neighbours,
    )
    absent = ""
    if options.known:
        meant = find(Inventory(model.parts), options.phrase)
        if not meant.parts:
            return complain(f"not grounded: {meant.message}")
        models = KnownParts(len(faces), [part.faces for part in meant.parts], numbers.color_seed).models
    else:
        from querycad_segworker.segcad.engines.sessions import UnknownLayout
        from querycad_segworker.segcad.engines.weights import load_models

        try:
            models = load_models(weights_folder(), numbers.box_threshold)
        except (WeightsAbsent, UnknownLayout) as state:
            models, absent = NULL_MODELS, str(state)
    out = Path(options.out)
    seen = look_and_draw(artefacts, len(faces), options.phrase, models, out / SHEET, numbers, save_views(out))
    for one in sightings(seen, options.phrase, model.parts, faces):
        ids = ", ".join(map(str, one.part.faces[:8])) + (" …" if len(one.part.faces) > 8 else "")
        print(f"{one.part.id}: {one.part.label} (faces {ids}; {one.reason})")
    print(f"pictures: {out}")
    return complain(f"only rendered: {absent}") if absent else EXIT_DONE
