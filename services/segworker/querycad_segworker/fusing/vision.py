"""Looks at one model for a phrase: vision's side of `find_parts`. Nothing is loaded before somebody asks for it."""

from __future__ import annotations

import tempfile
from collections.abc import Callable, Sequence
from pathlib import Path
from typing import TYPE_CHECKING

from querycad_contracts import Face, GroundedBy, Grounding, Part
from querycad_segworker.model import Artefacts, sheet_name

if TYPE_CHECKING:
    from querycad_segworker.segcad.pipeline import Seen
    from querycad_segworker.segcad.ports import VisionModels, VisionOptions

PHRASES_KEPT = 32
"""Of a model: what was seen is a few numbers a part, finding it again takes seconds."""

Networks = Callable[[], "VisionModels"]
"""Gives the networks that look at pictures, loaded when it is called. Raises WeightsAbsent."""

Keep = Callable[[Path, Path], None]
"""Gives a finished picture, the first path, its place, the second one, on the same file system."""


def keep_here(unfinished: Path, place: Path) -> None:
    """Keeps a picture on this machine, all at once."""
    unfinished.replace(place)


class Vision:
    """What vision finds in one model."""

    def __init__(
        self, artefacts: Artefacts, networks: Networks, options: VisionOptions | None = None, keep: Keep = keep_here
    ) -> None:
        self._artefacts = artefacts
        self._networks = networks
        self._keep = keep
        self._options = options
        self._seen: dict[str, Seen] = {}

    def ground(self, by_words: Grounding, mode: GroundedBy, parts: Sequence[Part], faces: Sequence[Face]) -> Grounding:
        """What does the description mean by sight, or by words and sight together? `by_words`: what geometry says."""
        from querycad_segworker.segcad.engines.sessions import UnknownLayout
        from querycad_segworker.segcad.ports import WeightsAbsent

        from .fusion import by_vision, fuse, sightings

        phrase = by_words.description
        try:
            seen = self._look(phrase, len(faces))
        except (WeightsAbsent, UnknownLayout) as unusable:
            return _without_weights(by_words, str(unusable))
        expected = by_words.parts if mode is GroundedBy.FUSED else ()
        found = sightings(seen, phrase, parts, faces, expected)
        result = by_vision(phrase, by_words.sides, found) if mode is GroundedBy.VISION else fuse(by_words, found)
        return result.model_copy(
            update={"parts": tuple(with_picture(part, sheet_name(phrase)) for part in result.parts)}
        )

    def _look(self, phrase: str, face_count: int) -> Seen:
        """What is seen of the phrase; the sheet of pictures that shows how is kept with the model."""
        if phrase not in self._seen:
            models = self._networks()
            from querycad_segworker.segcad.inspection.show import look_and_draw

            sheet = self._artefacts.sight(sheet_name(phrase))
            sheet.parent.mkdir(parents=True, exist_ok=True)
            with tempfile.TemporaryDirectory(prefix="draw-", dir=sheet.parent) as scratch:
                drawn = Path(scratch) / sheet.name
                seen = look_and_draw(self._artefacts, face_count, phrase, models, drawn, self._options)
                self._keep(drawn, sheet)
            self._seen[phrase] = seen
            while len(self._seen) > PHRASES_KEPT:
                self._seen.pop(next(iter(self._seen)))
        return self._seen[phrase]


def with_picture(part: Part, sheet: str) -> Part:
    """The same part, whose evidence tells which sheet shows what was seen."""
    evidence = part.evidence.model_copy(update={"picture": sheet})
    return part.model_copy(update={"evidence": evidence})


def _without_weights(by_words: Grounding, why: str) -> Grounding:
    """Without weights geometry answers alone, and says so."""
    if by_words.parts:
        return by_words.model_copy(update={"warnings": (*by_words.warnings, f"grounded on geometry alone: {why}")})
    return by_words.model_copy(update={"message": f"{by_words.message}; vision cannot look: {why}"})


def networks_in(weights: Path, options: VisionOptions | None = None) -> Networks:
    """The networks whose weights are in this folder, QUERYCAD_HOME/weights as a rule."""

    def load() -> VisionModels:
        from querycad_segworker.segcad.engines.weights import load_models

        return load_models(weights) if options is None else load_models(weights, options.box_threshold)

    return load


def no_networks() -> VisionModels:
    """Raises WeightsAbsent."""
    from querycad_segworker.segcad.ports import WeightsAbsent

    raise WeightsAbsent("no networks are set up")
