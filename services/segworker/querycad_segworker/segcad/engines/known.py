"""What would vision find if its networks were perfect? Boxes and masks drawn from parts that are already known.

It sees nothing but the flat picture, in which every face has a colour of its own. With it the stages around the
networks are measured alone, and their pictures drawn where the networks' weights are missing.
"""

from __future__ import annotations

from collections.abc import Iterable, Sequence

import cv2
import numpy as np
from numpy.typing import NDArray

from querycad_segworker.render.colored import face_colors
from querycad_segworker.segcad.ports import Detection, Masks, VisionModels


class KnownParts:
    """A detector and a segmenter for parts given by their faces, whatever the phrase."""

    def __init__(self, face_count: int, parts: Sequence[Iterable[int]], color_seed: int = 0) -> None:
        self._face_of = np.full(1 << 24, -1, dtype=np.int32)
        self._face_of[_packed(face_colors(face_count, color_seed))] = np.arange(face_count)
        self._of_part = np.zeros((len(parts), face_count + 1), dtype=np.bool_)  # index -1: the background
        for row, faces in enumerate(parts):
            self._of_part[row, list(faces)] = True
        self._last: tuple[NDArray[np.uint8], list[NDArray[np.bool_]]] | None = None

    @property
    def models(self) -> VisionModels:
        """These in the place of both networks."""
        return VisionModels(self, self)

    def detect(self, image: NDArray[np.uint8], phrase: str) -> list[Detection]:
        """The boxes around all parts of which the flat (H, W, 3) uint8 image shows something."""
        return [Detection(_box(mask), 1.0, phrase) for mask in self._masks(image)]

    def segment(self, image: NDArray[np.uint8], boxes: NDArray[np.float32]) -> Masks:
        """The pixels of the parts that have just these boxes; of parts with the same box, one after the other."""
        left = [(_box(mask), mask) for mask in self._masks(image)]
        chosen = []
        for box in boxes:
            index = next(i for i, (known, _) in enumerate(left) if np.allclose(known, box))
            chosen.append(left.pop(index)[1])
        return Masks(np.stack(chosen), np.ones(len(chosen), dtype=np.float32))

    def _masks(self, image: NDArray[np.uint8]) -> list[NDArray[np.bool_]]:
        if self._last is None or self._last[0] is not image:  # detected and segmented in one go
            faces = self._face_of[_packed(image)]
            shown = self._of_part[self._of_part[:, np.unique(faces)].any(axis=1)]
            self._last = (image, [row[faces] for row in shown])
        return self._last[1]


def _packed(colors: NDArray[np.uint8]) -> NDArray[np.uint32]:
    """The colours as one number each, (...) uint32."""
    padded = cv2.cvtColor(colors.reshape(len(colors), -1, 3), cv2.COLOR_RGB2RGBA)
    return (padded.view(np.uint32) & np.uint32(0xFFFFFF)).reshape(colors.shape[:-1])


def _box(mask: NDArray[np.bool_]) -> tuple[float, float, float, float]:
    rows, columns = np.flatnonzero(mask.any(axis=1)), np.flatnonzero(mask.any(axis=0))
    return float(columns[0]), float(rows[0]), float(columns[-1] + 1), float(rows[-1] + 1)
