"""Where in a picture may a phrase be seen? GroundingDINO through onnxruntime, for both exports that are in use.

| export | takes the image as | and the words as | gives |
|---|---|---|---|
| of transformers' model | `pixel_values`, `pixel_mask` | tokens | `logits`, `pred_boxes` |
| of the original repository | `img` | tokens, `position_ids`, `text_token_mask` | `logits`, `boxes` |

Tokens are `input_ids`, `token_type_ids` and `attention_mask`; `text_token_mask` says which token attends to which.
Logits are before the sigmoid, boxes centre, width and height as shares of the image. The first export makes the text
masks itself, and may have been traced with one phrase: a run asks for one.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from typing import Any

import numpy as np
from numpy.typing import NDArray

from querycad_segworker.segcad.ports import Detection

from .images import Size, normalised, padded, resize, size_by_edges, size_within
from .sessions import Graph, UnknownLayout
from .tokenizer import Prompt, Tokenizer, caption_of

IMAGE_INPUTS = ("pixel_values", "img")
BOX_OUTPUTS = ("pred_boxes", "boxes")


@dataclass(frozen=True, slots=True)
class DetectorOptions:
    """What of the detector can be chosen; the defaults are the published ones."""

    threshold: float = 0.30
    """Score that a box must exceed (QueryCAD paper)."""
    shortest_edge: int = 800
    longest_edge: int = 1333
    """Pixels of the image's edges, where the graph takes any size: what the reference's processor does."""


@dataclass(frozen=True, slots=True, eq=False)
class _Picture:
    """An image as the graph takes it."""

    pixels: NDArray[np.float32]
    """(3, H, W): the resized image, zeros to the right of it and below where the graph's size is fixed."""
    mask: NDArray[np.bool_]
    """(H, W): True where there is image."""
    extent: tuple[float, float]
    """Width and height, in pixels of the image given, of what the graph's boxes are shares of."""
    size: Size
    """Of the image given."""


class GroundingDino:
    """A detector in the sense of `ports.Detector`."""

    def __init__(self, graph: Graph, tokenizer: Tokenizer, options: DetectorOptions | None = None) -> None:
        """Raises UnknownLayout when the graph takes no image or gives no boxes under a known name."""
        self._graph, self._tokenizer, self._options = graph, tokenizer, options or DetectorOptions()
        self._image = _first(IMAGE_INPUTS, list(graph.inputs), graph)
        self._boxes = _first(BOX_OUTPUTS, graph.outputs, graph)

    def detect(self, image: NDArray[np.uint8], phrase: str) -> list[Detection]:
        """Where in the (H, W, 3) uint8 image may `phrase` be seen? Best score first; empty when nowhere."""
        return self.detect_views([image], phrase)[0]

    def detect_views(self, images: Sequence[NDArray[np.uint8]], phrase: str) -> list[list[Detection]]:
        """The same for images of one size: in one run where the graph takes several, else one after the other."""
        prompt = self._tokenizer.encode(caption_of(phrase), self._graph.inputs["input_ids"].shape[1])
        pictures = [self._picture(image) for image in images]
        batch = len(pictures) if self._graph.inputs[self._image].shape[0] is None else 1
        found: list[list[Detection]] = []
        for first in range(0, len(pictures), batch):
            part = pictures[first : first + batch]
            logits, boxes = self._graph.run(self._feeds(part, prompt), ["logits", self._boxes])
            found += [self._decode(*one, phrase) for one in zip(logits, boxes, part, strict=True)]
        return found

    def _picture(self, image: NDArray[np.uint8]) -> _Picture:
        """The image at the graph's size, or at the reference's where the graph takes any."""
        size = (image.shape[0], image.shape[1])
        height, width = self._graph.inputs[self._image].shape[2:]
        if height is None or width is None:
            inner = size_by_edges(size, self._options.shortest_edge, self._options.longest_edge)
            frame = inner
        else:
            frame = (height, width)
            inner = size_within(size, frame)
        pixels = padded(normalised(resize(image, inner)), frame)
        mask = np.zeros(frame, dtype=bool)
        mask[: inner[0], : inner[1]] = True
        # a graph that knows where the image ends gives shares of the image, any other shares of the frame
        seen = inner if "pixel_mask" in self._graph.inputs else frame
        return _Picture(pixels, mask, (size[1] * seen[1] / inner[1], size[0] * seen[0] / inner[0]), size)

    def _feeds(self, pictures: Sequence[_Picture], prompt: Prompt) -> dict[str, NDArray[Any]]:
        """Every input that a known export has; the graph takes those that it declares."""
        count = len(pictures)
        masks = self._graph.inputs.get("text_token_mask")
        token_mask = prompt.self_attention if masks is None or len(masks.shape) == 3 else prompt.attention_mask
        text = {
            "input_ids": prompt.input_ids,
            "token_type_ids": np.zeros_like(prompt.input_ids),
            "attention_mask": prompt.attention_mask,
            "position_ids": prompt.position_ids,
            "text_token_mask": token_mask,
            "text_self_attention_masks": prompt.self_attention,
        }
        feeds: dict[str, NDArray[Any]] = {name: np.stack([one] * count) for name, one in text.items()}
        feeds[self._image] = np.stack([picture.pixels for picture in pictures])
        feeds["pixel_mask"] = np.stack([picture.mask for picture in pictures])
        return feeds

    def _decode(self, logits: NDArray[Any], boxes: NDArray[Any], picture: _Picture, phrase: str) -> list[Detection]:
        """Detections from (Q, L) logits and (Q, 4) boxes; a box's score is that of its best token."""
        score = np.exp(-np.logaddexp(0.0, -logits.max(axis=1).astype(np.float64)))  # sigmoid; no overflow at -inf
        center, half = boxes[:, :2].astype(np.float64), boxes[:, 2:].astype(np.float64) / 2
        limit = (picture.size[1], picture.size[0])
        low = np.clip((center - half) * picture.extent, 0, limit)
        high = np.clip((center + half) * picture.extent, 0, limit)
        kept = np.flatnonzero((score > self._options.threshold) & (high > low).all(axis=1))
        kept = kept[np.argsort(-score[kept], kind="stable")]
        corners = np.hstack([low, high])
        return [Detection(_box(corners[i]), float(score[i]), phrase) for i in kept]


def _box(corners: NDArray[np.float64]) -> tuple[float, float, float, float]:
    x0, y0, x1, y1 = corners.tolist()
    return x0, y0, x1, y1


def _first(known: Sequence[str], found: Sequence[str], graph: Graph) -> str:
    for name in known:
        if name in found:
            return name
    raise UnknownLayout(f"{graph.path.name} is no known export of GroundingDINO: none of {', '.join(known)} in it")
