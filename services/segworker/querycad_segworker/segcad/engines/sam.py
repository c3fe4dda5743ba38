"""Which pixels belong to what a box holds? SAM through onnxruntime, for the three exports that are in use.

| layout | encoder takes and gives | decoder takes |
|---|---|---|
| samexporter | `input_image` > `image_embeddings` | `point_coords`: a box is two points, labelled 2 and 3 |
| transformers, SAM 2.1 | `pixel_values` > `image_embeddings.0`, `.1`, `.2` | `input_boxes` |
| transformers, SAM | `pixel_values` > `image_embeddings`, `image_positional_embeddings` | `input_points` only |

The image is embedded once, the boxes are decoded together. Masks come out small (a quarter of the network's image,
which is 1024 pixels for all published weights) and are enlarged here: the exports' own enlargement is fixed to the
image that they were traced with.
"""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass
from typing import Any, Protocol

import numpy as np
from numpy.typing import NDArray

from querycad_segworker.segcad.ports import Masks

from .images import Size, enlarged, normalised, padded, resize, size_by_longest
from .sessions import Graph, UnknownLayout

SIDE = 1024
"""Edge of the network's square image, where the graph does not say (all published SAM weights)."""
MASK_SCALE = 4
"""The network's image is so many times larger than the masks that it gives (SAM, appendix A)."""
POSITIVE, CORNER, OPPOSITE_CORNER = 1, 2, 3
"""SAM's labels of points: on the object; the upper left and the lower right corner of a box."""

Small = tuple[NDArray[np.float32], NDArray[np.float32]]
"""(N, h, w) logits of the mask of each box, above 0 where the object is, and (N,) estimates of its quality."""


@dataclass(frozen=True, slots=True, eq=False)
class Embedded:
    """An image as the decoder takes it."""

    feeds: dict[str, NDArray[Any]]
    """The decoder's inputs that come from the image."""
    inner: Size
    """The image's own part of the network's square, at its upper left."""


class Layout(Protocol):
    """What differs between the exports."""

    side: int
    """Edge of the network's image in pixels."""
    square: bool
    """Whether the image is stretched to the square, instead of padded."""

    def embed(self, resized: NDArray[np.uint8]) -> Embedded:
        """The (h, w, 3) image, which has the network's size already, embedded."""
        ...

    def decode(self, image: Embedded, boxes: NDArray[np.float32]) -> Small:
        """The mask of each of the (N, 4) boxes in pixels of the network's image."""
        ...


class Sam:
    """A segmenter in the sense of `ports.Segmenter`."""

    def __init__(self, encoder: Graph, decoder: Graph) -> None:
        """Raises UnknownLayout when the decoder's inputs are those of no known export."""
        self._layout = layout_of(encoder, decoder)

    def segment(self, image: NDArray[np.uint8], boxes: NDArray[np.float32]) -> Masks:
        """Which pixels of the (H, W, 3) uint8 image belong to what each of the (N, 4) boxes holds?"""
        logits, scores = self.mask_logits(image, boxes)
        return Masks(np.stack([mask > 0 for mask in logits]), scores)

    def mask_logits(
        self, image: NDArray[np.uint8], boxes: NDArray[np.float32]
    ) -> tuple[Iterator[NDArray[np.float32]], NDArray[np.float32]]:
        """(H, W) float32 of each box, above 0 where the object is, made as they are taken; and their (N,) scores."""
        size = (image.shape[0], image.shape[1])
        layout, side = self._layout, self._layout.side
        inner = (side, side) if layout.square else size_by_longest(size, side)
        scale = np.array([inner[1] / size[1], inner[0] / size[0]] * 2, dtype=np.float32)
        scaled = np.asarray(boxes, dtype=np.float32).reshape(-1, 4) * scale
        masks, scores = layout.decode(layout.embed(resize(image, inner)), scaled)
        return (_to_image(mask, inner, side, size) for mask in masks), scores


def _to_image(mask: NDArray[np.float32], inner: Size, side: int, size: Size) -> NDArray[np.float32]:
    """A small mask in the image's pixels; over the padded square first, as the reference does, so that both agree."""
    if inner != (side, side):
        mask = enlarged(mask, (side, side))[: inner[0], : inner[1]]
    return enlarged(mask, size)


class SamExporter:
    """The layout of samexporter and of the original repository's export: boxes are pairs of points."""

    square = False

    def __init__(self, encoder: Graph, decoder: Graph) -> None:
        self._encoder, self._decoder = encoder, decoder
        self._own_transform = len(encoder.inputs["input_image"].shape) == 3
        mask = decoder.inputs["mask_input"].shape
        self._mask_side = mask[-1] or SIDE // MASK_SCALE
        self.side = self._mask_side * MASK_SCALE
        self._together = decoder.inputs["point_coords"].shape[0] is None

    def embed(self, resized: NDArray[np.uint8]) -> Embedded:
        """(h, w, 3) raw where the encoder normalises itself, else (1, 3, side, side)."""
        image: NDArray[Any] = resized
        if not self._own_transform:
            image = padded(normalised(resized), (self.side, self.side))[None]
        (embedding,) = self._encoder.run({"input_image": image}, ["image_embeddings"])
        return Embedded({"image_embeddings": embedding}, (resized.shape[0], resized.shape[1]))

    def decode(self, image: Embedded, boxes: NDArray[np.float32]) -> Small:
        """One run for all boxes where the graph takes several; the published ones are fixed to one.

        Of four masks the first is that for unambiguous prompts, such as a box (SAM, appendix A); else the best scored.
        """
        batches = [boxes] if self._together else [boxes[i : i + 1] for i in range(len(boxes))]
        found = [self._run(image, batch) for batch in batches]
        masks, scores = (np.concatenate([one[i] for one in found]).astype(np.float32) for i in (0, 1))
        return _picked(masks, scores, np.zeros(len(masks), dtype=int) if masks.shape[1] == 4 else scores.argmax(axis=1))

    def _run(self, image: Embedded, boxes: NDArray[np.float32]) -> tuple[NDArray[Any], ...]:
        count, side = len(boxes), self._mask_side
        feeds = image.feeds | {
            "point_coords": boxes.reshape(count, 2, 2),
            "point_labels": np.tile([CORNER, OPPOSITE_CORNER], (count, 1)),
            "mask_input": np.zeros((1, 1, side, side)),
            "has_mask_input": np.zeros(1),
            "orig_im_size": np.full(2, self.side),  # of the output `masks`, which is not asked for
        }
        return self._decoder.run(feeds, ["low_res_masks", "iou_predictions"])


class _OfTransformers:
    """What the two layouts of transformers share: the encoder's input, and whose size the graph says."""

    square = False
    embeddings: tuple[str, ...]

    def __init__(self, encoder: Graph, decoder: Graph) -> None:
        self._encoder, self._decoder = encoder, decoder
        self.side = encoder.inputs["pixel_values"].shape[-1] or SIDE

    def embed(self, resized: NDArray[np.uint8]) -> Embedded:
        """Each embedding under the name by which the decoder takes it."""
        pixels = padded(normalised(resized), (self.side, self.side))[None]
        found = self._encoder.run({"pixel_values": pixels}, self.embeddings)
        return Embedded(dict(zip(self.embeddings, found, strict=True)), (resized.shape[0], resized.shape[1]))

    def _run(self, feeds: dict[str, NDArray[Any]]) -> Small:
        """(N, M, h, w) and (N, M): M masks a box."""
        masks, scores = self._decoder.run(feeds, ["pred_masks", "iou_scores"])
        return masks[0].astype(np.float32), scores[0].astype(np.float32)


class Sam2(_OfTransformers):
    """SAM 2.1 as transformers exports it: takes boxes, stretches the image to the square."""

    square = True
    embeddings = ("image_embeddings.0", "image_embeddings.1", "image_embeddings.2")

    def decode(self, image: Embedded, boxes: NDArray[np.float32]) -> Small:
        """All boxes of the image in one run, and no points beside them.

        The best scored of three: this export gives no mask for unambiguous prompts.
        """
        no_points = {"input_points": np.zeros((1, 1, 0, 2)), "input_labels": np.zeros((1, len(boxes), 0))}
        masks, scores = self._run(image.feeds | no_points | {"input_boxes": boxes[None]})
        return _picked(masks, scores, scores.argmax(axis=1))


class SamPoints(_OfTransformers):
    """SAM as transformers exported it first: points only. The middle of the box asks, the box itself decides."""

    embeddings = ("image_embeddings", "image_positional_embeddings")

    def decode(self, image: Embedded, boxes: NDArray[np.float32]) -> Small:
        """One point a box, all in one run.

        Of three masks that most like the box: a point may mean a part, the object, or what the object is a part of.
        """
        middles = (boxes[:, :2] + boxes[:, 2:]) / 2
        labels = np.full((1, len(boxes), 1), POSITIVE)
        masks, scores = self._run(image.feeds | {"input_points": middles[None, :, None], "input_labels": labels})
        return _picked(masks, scores, self._likeness(masks, boxes, image.inner).argmax(axis=1))

    def _likeness(self, masks: NDArray[np.float32], boxes: NDArray[np.float32], inner: Size) -> NDArray[np.float64]:
        """(N, M) intersection over union of each mask with its box, without what lies in the padding."""
        scale = self.side / masks.shape[-1]
        rows, columns = (-(-length // round(scale)) for length in inner)
        centers = (np.arange(masks.shape[-1]) + 0.5) * scale
        x0, y0, x1, y1 = boxes.T[:, :, None]
        upright, across = (y0 <= centers) & (centers < y1), (x0 <= centers) & (centers < x1)
        inside = (upright[:, :, None] & across[:, None, :])[:, None, :rows, :columns]
        on = masks[:, :, :rows, :columns] > 0
        common, either = (on & inside).sum(axis=(2, 3)), (on | inside).sum(axis=(2, 3))
        return np.asarray(common / np.maximum(either, 1), dtype=np.float64)


def layout_of(encoder: Graph, decoder: Graph) -> Layout:
    """Which export are these two graphs? By the decoder's input names. Raises UnknownLayout."""
    inputs = decoder.inputs.keys()
    if "point_coords" in inputs and "input_image" in encoder.inputs:
        return SamExporter(encoder, decoder)
    if "pixel_values" in encoder.inputs and "input_boxes" in inputs:
        return Sam2(encoder, decoder)
    if "pixel_values" in encoder.inputs and "input_points" in inputs:
        return SamPoints(encoder, decoder)
    raise UnknownLayout(
        f"{encoder.path.name} ({', '.join(encoder.inputs)}) and {decoder.path.name} ({', '.join(inputs)}) "
        "are no known export of SAM"
    )


def _picked(masks: NDArray[np.float32], scores: NDArray[np.float32], best: NDArray[Any]) -> Small:
    """Of (N, M, h, w) masks and (N, M) scores, the one of each box."""
    every = np.arange(len(masks))
    return masks[every, best], scores[every, best]
