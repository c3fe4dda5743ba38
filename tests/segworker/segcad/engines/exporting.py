"""How are the references' models exported? Each in the layouts that are in use, as small as it gets.

Needs the dependency group `parity`.
"""

from __future__ import annotations

import io
from collections.abc import Callable, Iterator, Sequence
from contextlib import contextmanager
from dataclasses import dataclass
from pathlib import Path
from typing import Any

import onnx
import onnxruntime
import torch
import transformers.models.grounding_dino.modeling_grounding_dino as grounding_dino

from .cases import BOXES, EDGES, FRAME

CLS, SEP, STOP, QUESTION = 101, 102, 1012, 1029
"""Token numbers of BERT's vocabulary that are written into the reference's code."""
OPSET = 17
MEAN, STD = [0.485, 0.456, 0.406], [0.229, 0.224, 0.225]
SMALL = FRAME // 4
PICTURE = {0: "batch", 2: "height", 3: "width"}
Axes = dict[str, dict[int, str]]


@dataclass(frozen=True)
class Export:
    """One graph: a function of tensors, traced with `inputs`; `axes` are free, unless `fixed` says their length."""

    function: Callable[..., Any]
    inputs: dict[str, Any]
    outputs: Sequence[str]
    axes: Axes
    fixed: dict[str, int] | None = None


def export_detector(model: Any, folder: Path) -> None:
    """`detector-transformers` takes a square of FRAME pixels, `detector-original` a picture of EDGES."""
    tokens = torch.tensor([[CLS, QUESTION + 1, QUESTION + 2, STOP, SEP]])
    mask, places = exportable_masks(tokens, model.model.special_tokens)
    words = {0: "batch", 1: "tokens"}

    def of_transformers(image: Any, words: Any, types: Any, real: Any, inside: Any) -> Any:
        outputs = model(image, words, types, real, inside)
        return outputs.logits, outputs.pred_boxes

    def original(image: Any, words: Any, real: Any, places: Any, types: Any, mask: Any) -> Any:
        with _text_masks(lambda input_ids, special_tokens: (mask, places)):
            outputs = model(image, words, types, real)
        return outputs.logits, outputs.pred_boxes

    # tracing fixes what depends on the picture's size, so each export is traced with the size that it is asked with
    text = {
        "input_ids": tokens,
        "token_type_ids": torch.zeros_like(tokens),
        "attention_mask": torch.ones_like(tokens),
    }
    inputs = {"pixel_values": torch.randn(1, 3, FRAME, FRAME)} | text
    inputs["pixel_mask"] = torch.ones(1, FRAME, FRAME, dtype=torch.long)
    axes: Axes = {"pixel_values": PICTURE, "pixel_mask": {0: "batch", 1: "height", 2: "width"}}
    fixed = {"batch": 1, "height": FRAME, "width": FRAME}
    with _text_masks(exportable_masks):
        graph = Export(of_transformers, inputs, ["logits", "pred_boxes"], axes | dict.fromkeys(text, words), fixed)
        write(model, graph, folder / "detector-transformers/model.onnx")
    inputs = {
        "img": torch.randn(1, 3, *EDGES),
        "input_ids": tokens,
        "attention_mask": torch.ones_like(tokens, dtype=torch.bool),
        "position_ids": places,
        "token_type_ids": text["token_type_ids"],
        "text_token_mask": mask,
    }
    axes = dict.fromkeys(inputs, words) | {"text_token_mask": words | {2: "tokens"}, "img": PICTURE}
    write(model, Export(original, inputs, ["logits", "boxes"], axes), folder / "detector-original/model.onnx")


@contextmanager
def _text_masks(function: Any) -> Iterator[None]:
    """The reference's text masks made by another function while the context lasts."""
    name = "generate_masks_with_special_tokens_and_transfer_map"
    before = getattr(grounding_dino, name)
    setattr(grounding_dino, name, function)
    try:
        yield
    finally:
        setattr(grounding_dino, name, before)


def exportable_masks(input_ids: Any, special_tokens: Any) -> Any:
    """The reference's text masks in operations that ONNX has: it has no running maximum."""
    length = input_ids.shape[1]
    at = torch.arange(length)
    ends = (input_ids[:, :, None] == special_tokens).any(-1)[:, None, :]
    closing = torch.where(ends & (at >= at[:, None]), at, length).amin(-1)
    opening = torch.where(ends & (at < at[:, None]), at, -1).amax(-1)
    phrase = (closing != 0) & (closing < length - 1)
    mask = ((closing[:, :, None] == closing[:, None, :]) & phrase[:, None, :]) | (at[:, None] == at)
    return mask, torch.where(phrase, at - opening - 1, 0)


def export_sam(model: Any, folder: Path) -> None:
    """`sam-exporter`, the same with `-raw`, whose encoder normalises and whose decoder takes several, `sam-points`."""
    picture = torch.randn(1, 3, FRAME, FRAME)
    embedding, places = model.get_image_embeddings(picture), model.get_image_wide_positional_embeddings()

    def encode(image: Any) -> Any:
        return model.vision_encoder(image)[0]

    def encode_raw(image: Any) -> Any:
        pixels = ((image / 255 - torch.tensor(MEAN)) / torch.tensor(STD)).permute(2, 0, 1)[None]
        return encode(torch.nn.functional.pad(pixels, (0, FRAME - pixels.shape[3], 0, FRAME - pixels.shape[2])))

    def encode_with_places(image: Any) -> Any:
        return encode(image), model.get_image_wide_positional_embeddings()

    def decode_points(points: Any, labels: Any, embedding: Any, places: Any) -> Any:
        sparse, dense = model.prompt_encoder(points, labels, None, None)
        masks, scores = model.mask_decoder(embedding, places, sparse, dense, multimask_output=True)
        return scores, masks

    out = folder / "sam-exporter"
    write(model, Export(encode, {"input_image": picture}, ["image_embeddings"], {}), out / "encoder.onnx")
    free: Axes = {"point_coords": {1: "points"}, "point_labels": {1: "points"}}
    write(model, _exporter_decoder(model, embedding, places, 1, free), out / "decoder.onnx")
    out = folder / "sam-exporter-raw"
    raw: Axes = {"input_image": {0: "height", 1: "width"}}
    image = {"input_image": 255 * torch.rand(96, FRAME, 3)}
    write(model, Export(encode_raw, image, ["image_embeddings"], raw), out / "encoder.onnx")
    free = {name: axes | {0: "boxes"} for name, axes in free.items()}
    write(model, _exporter_decoder(model, embedding, places, 2, free), out / "decoder.onnx")
    out = folder / "sam-points"
    found = {"image_embeddings": embedding, "image_positional_embeddings": places}
    batch: Axes = {"pixel_values": {0: "batch"}}
    write(model, Export(encode_with_places, {"pixel_values": picture}, list(found), batch), out / "encoder.onnx")
    prompt = {"input_points": FRAME * torch.rand(1, 2, 1, 2), "input_labels": torch.ones(1, 2, 1, dtype=torch.long)}
    prompts = {0: "batch", 1: "prompts", 2: "points"}
    axes: Axes = dict.fromkeys(prompt, prompts)
    write(model, Export(decode_points, prompt | found, ["iou_scores", "pred_masks"], axes), out / "decoder.onnx")


def _exporter_decoder(model: Any, embedding: Any, places: Any, boxes: int, axes: Axes) -> Export:
    """The decoder as the original repository exports it: labels 2 and 3 are a box's corners, four masks come out."""

    def decode(embedding: Any, points: Any, labels: Any, mask_input: Any, has_mask: Any, size: Any) -> Any:
        encoder = model.prompt_encoder
        sparse = encoder.shared_embedding(points[:, None] + 0.5, (FRAME, FRAME))[:, 0]
        sparse = torch.where(labels[:, :, None] == -1, encoder.not_a_point_embed.weight, sparse)
        for number, kind in enumerate(encoder.point_embed):
            sparse = torch.where(labels[:, :, None] == number, sparse + kind.weight, sparse)
        none = encoder.no_mask_embed.weight.reshape(1, -1, 1, 1)
        dense = has_mask * encoder.mask_embed(mask_input) + (1 - has_mask) * none
        found = [
            model.mask_decoder(embedding, places, sparse[None], dense, multimask_output=several)
            for several in (False, True)
        ]
        small, scores = (torch.cat([one[i] for one in found], dim=2)[0] for i in (0, 1))
        masks = torch.nn.functional.interpolate(small, (FRAME, FRAME), mode="bilinear", align_corners=False)
        return masks + 0 * size.sum(), scores, small

    inputs = {
        "image_embeddings": embedding,
        "point_coords": FRAME * torch.rand(boxes, 2, 2),
        "point_labels": torch.tensor([[2.0, 3.0]] * boxes),
        "mask_input": torch.zeros(1, 1, SMALL, SMALL),
        "has_mask_input": torch.zeros(1),
        "orig_im_size": torch.tensor([72.0, 120.0]),
    }
    return Export(decode, inputs, ["masks", "iou_predictions", "low_res_masks"], axes)


def export_sam2(model: Any, folder: Path) -> None:
    """`sam2`: the prompt's axes are free, and traced with one box, beside which there is no point."""

    def encode(image: Any) -> Any:
        return tuple(model.get_image_embeddings(image))

    def decode(points: Any, labels: Any, boxes: Any, *levels: Any) -> Any:
        outputs = model(
            image_embeddings=list(levels),
            input_points=points,
            input_labels=labels,
            input_boxes=boxes,
            multimask_output=True,
        )
        return outputs.iou_scores, outputs.pred_masks, outputs.object_score_logits

    picture = torch.randn(1, 3, FRAME, FRAME)
    levels = {f"image_embeddings.{i}": level for i, level in enumerate(model.get_image_embeddings(picture))}
    batch: Axes = {"pixel_values": {0: "batch"}}
    graph = Export(encode, {"pixel_values": picture}, list(levels), batch)
    write(model, graph, folder / "sam2/encoder.onnx")
    prompt = {
        "input_points": torch.zeros(1, 1, 0, 2),
        "input_labels": torch.zeros(1, 1, 0, dtype=torch.long),
        "input_boxes": FRAME * torch.tensor(BOXES[:1], dtype=torch.float32)[None],
    }
    axes: Axes = {
        "input_points": {0: "batch", 1: "point_prompts", 2: "points"},
        "input_labels": {0: "batch", 1: "prompts", 2: "points"},
        "input_boxes": {0: "batch", 1: "prompts"},
    }
    outputs = ["iou_scores", "pred_masks", "object_score_logits"]
    write(model, Export(decode, prompt | levels, outputs, axes), folder / "sam2/decoder.onnx")


class _Traced(torch.nn.Module):  # type: ignore[misc]  # PyTorch is not installed where types are checked
    """A function as the exporter takes it: with the model whose weights it uses."""

    def __init__(self, model: Any, function: Callable[..., Any]) -> None:
        super().__init__()
        self.model, self.function = model, function

    def forward(self, *inputs: Any) -> Any:
        return self.function(*inputs)


def write(model: Any, graph: Export, path: Path) -> None:
    """Writes the graph, as small as it gets: constants folded, names inside shortened."""
    path.parent.mkdir(parents=True, exist_ok=True)
    buffer = io.BytesIO()
    names = list(graph.inputs)
    torch.onnx.export(
        _Traced(model, graph.function).eval(),
        tuple(graph.inputs.values()),
        buffer,
        input_names=names,
        output_names=list(graph.outputs),
        dynamic_axes=graph.axes,
        opset_version=OPSET,
        dynamo=False,
    )
    exported = onnx.load_from_string(buffer.getvalue())
    for value in exported.graph.input:
        for dimension in value.type.tensor_type.shape.dim:
            if dimension.dim_param in (graph.fixed or {}):
                dimension.dim_value = (graph.fixed or {})[dimension.dim_param]
    options = onnxruntime.SessionOptions()
    options.graph_optimization_level = onnxruntime.GraphOptimizationLevel.ORT_ENABLE_BASIC
    options.optimized_model_filepath = str(path)
    options.log_severity_level = 3
    onnxruntime.InferenceSession(exported.SerializeToString(), options, providers=["CPUExecutionProvider"])
    folded = onnx.load(path)
    _shorten(folded.graph, {*names, *graph.outputs}, {})
    del folded.graph.value_info[:], folded.metadata_props[:]
    onnx.checker.check_model(folded)
    onnx.save(folded, path)


def _shorten(graph: Any, kept: set[str], short: dict[str, str]) -> None:
    """Gives every value inside a short name, and no name to the operations; subgraphs see the names around them."""

    def renamed(value: str) -> str:
        return value if not value or value in kept else short.setdefault(value, f"v{len(short)}")

    for value in [*graph.initializer, *graph.input, *graph.output]:
        value.name = renamed(value.name)
    for node in graph.node:
        node.name, node.doc_string = "", ""
        node.input[:] = [renamed(value) for value in node.input]
        node.output[:] = [renamed(value) for value in node.output]
        for attribute in node.attribute:
            for inner in [attribute.g] if attribute.HasField("g") else attribute.graphs:
                _shorten(inner, kept, short)
