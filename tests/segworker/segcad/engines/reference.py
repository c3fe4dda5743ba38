"""What do the public reference implementations answer? Tiny models with random weights, exported in every layout.

`build(folder)` makes the models with transformers (their processors included), exports each to ONNX in the layouts that
are in use, and writes what the references answer to the pictures of `cases.py` beside them. Needs the dependency group
`parity`. `python -m tests.segworker.segcad.engines.reference recorded.tar.xz` writes what the repository keeps.
"""

from __future__ import annotations

import shutil
import sys
import tempfile
import warnings
from collections.abc import Sequence
from pathlib import Path
from typing import Any

import numpy as np
import torch
from numpy.typing import NDArray

from .cases import EDGES, FRAME, PHRASES, THRESHOLD, boxes_in, pictures

# torchvision's wheel finds none of its operators beside a PyTorch for the CPU, and then does not even import; the
# processors use only its resizing, which is PyTorch's own.
_OPERATORS = torch.library.Library("torchvision", "DEF")
for _name in ("nms", "qnms"):
    _OPERATORS.define(f"{_name}(Tensor dets, Tensor scores, float iou_threshold) -> Tensor")

import transformers  # noqa: E402
import transformers.models.grounding_dino.modeling_grounding_dino as grounding_dino  # noqa: E402

from .exporting import CLS, MEAN, QUESTION, SEP, STD, STOP, export_detector, export_sam, export_sam2  # noqa: E402

WORDS = "hole round power connect ##or logo slot m ##4 4"
Answers = dict[str, NDArray[Any]]


def build(folder: Path, names: Sequence[str] | None = None) -> None:
    """Writes the exported models and `expected.npz`, for all pictures or those named."""
    asked = {name: image for name, image in pictures().items() if names is None or name in names}
    folder.mkdir(parents=True, exist_ok=True)
    vocabulary = _vocabulary()
    (folder / "vocab.txt").write_text("\n".join(vocabulary) + "\n", encoding="utf-8")
    with warnings.catch_warnings(), torch.no_grad():
        warnings.simplefilter("ignore")  # of the exporter, about constants that are meant
        detector, sam, sam2 = _detector(len(vocabulary)), _sam(), _sam2()
        expected: Answers = {}
        for name, image in asked.items():
            expected |= _keyed(name, _detector_answers(detector, folder / "vocab.txt", image))
            expected |= _keyed(name, _sam_answers(sam, image))
            expected |= _keyed(name, _sam2_answers(sam2, image))
        export_detector(detector, folder)
        export_sam(sam, folder)
        export_sam2(sam2, folder)
    np.savez_compressed(folder / "expected.npz", **expected)  # type: ignore[arg-type]


def _keyed(picture: str, answers: Answers) -> Answers:
    return {f"{picture}/{key}": value for key, value in answers.items()}


def _vocabulary() -> list[str]:
    """The words at the end of a vocabulary whose special tokens have BERT's numbers."""
    special = {0: "[PAD]", 100: "[UNK]", CLS: "[CLS]", SEP: "[SEP]", 103: "[MASK]", STOP: ".", QUESTION: "?"}
    return [special.get(i, f"[unused{i}]") for i in range(QUESTION + 1)] + WORDS.split()


def _random(model: Any, seed: int, spread: float) -> Any:
    """The model with noise on every weight: those that start as zero would leave parts of it untested.

    Rounded to eight bits of mantissa, so that the archive packs well.
    """
    generator = torch.Generator().manual_seed(seed)
    for weight in model.parameters():
        weight.add_(spread * torch.randn(weight.shape, generator=generator))
        weight.copy_(weight.bfloat16().float())
    return model.eval()


def _detector(words: int) -> Any:
    torch.manual_seed(1)
    swin = transformers.SwinConfig(
        embed_dim=4, depths=[1, 1, 1, 1], num_heads=[1, 1, 2, 2], window_size=2, image_size=FRAME, mlp_ratio=2.0,
        out_features=["stage2", "stage3", "stage4"],
    )  # fmt: skip
    bert = transformers.BertConfig(
        vocab_size=words, hidden_size=8, num_hidden_layers=1, num_attention_heads=2, intermediate_size=16,
        max_position_embeddings=32,
    )  # fmt: skip
    config = transformers.GroundingDinoConfig(
        backbone_config=swin, text_config=bert, d_model=32, num_queries=16, max_text_len=32, num_feature_levels=4,
        encoder_layers=1, encoder_ffn_dim=16, encoder_attention_heads=2, encoder_n_points=2,
        decoder_layers=2, decoder_ffn_dim=16, decoder_attention_heads=2, decoder_n_points=2,
    )  # fmt: skip
    return _random(transformers.GroundingDinoForObjectDetection(config), seed=2, spread=0.05)


def _detector_answers(model: Any, vocab: Path, image: NDArray[np.uint8]) -> Answers:
    """Boxes and scores over the threshold, best first, and the inputs that the reference's processors make."""
    tokenizer = transformers.BertTokenizer(vocab=str(vocab))
    sizes: dict[str, dict[str, Any]] = {
        "free": {"size": {"shortest_edge": EDGES[0], "longest_edge": EDGES[1]}},
        "fixed": {"size": {"max_height": FRAME, "max_width": FRAME}, "pad_size": {"height": FRAME, "width": FRAME}},
    }
    answers: Answers = {}
    for kind, size in sizes.items():
        processor = transformers.GroundingDinoProcessor(transformers.GroundingDinoImageProcessorPil(), tokenizer)
        for key, phrase in PHRASES.items():
            inputs = processor(images=image, text=[[phrase]], return_tensors="pt", images_kwargs=size)
            outputs = model(**inputs)
            (found,) = processor.post_process_grounded_object_detection(
                outputs, inputs["input_ids"], threshold=THRESHOLD, target_sizes=[image.shape[:2]]
            )
            order = found["scores"].argsort(descending=True, stable=True)
            values = inputs["pixel_values"][0].permute(1, 2, 0) * torch.tensor(STD) + torch.tensor(MEAN)
            answers[f"{kind}/pixels"] = (255 * values).round().numpy().astype(np.uint8)
            answers[f"{kind}/{key}/scores"] = found["scores"][order].numpy()
            answers[f"{kind}/{key}/boxes"] = found["boxes"][order].numpy()
            mask, places = grounding_dino.generate_masks_with_special_tokens_and_transfer_map(
                inputs["input_ids"], model.model.special_tokens
            )
            answers[f"{kind}/{key}/input_ids"] = inputs["input_ids"][0].numpy()
            answers[f"{kind}/{key}/self_attention"] = mask[0].numpy()
            answers[f"{kind}/{key}/position_ids"] = places[0].numpy()
    return answers


def _sam() -> Any:
    torch.manual_seed(3)
    config = transformers.SamConfig(
        vision_config={
            "hidden_size": 16, "output_channels": 16, "num_hidden_layers": 2, "num_attention_heads": 2, "mlp_dim": 32,
            "image_size": FRAME, "patch_size": 16, "window_size": 4, "global_attn_indexes": [1], "num_pos_feats": 8,
        },
        prompt_encoder_config={
            "hidden_size": 16, "image_size": FRAME, "patch_size": 16, "mask_input_channels": 4,
            "image_embedding_size": FRAME // 16,
        },
        mask_decoder_config={
            "hidden_size": 16, "mlp_dim": 32, "num_hidden_layers": 2, "num_attention_heads": 2,
            "iou_head_hidden_dim": 16,
        },
    )  # fmt: skip
    return _random(transformers.SamModel(config), seed=4, spread=0.08)


def _sam_answers(model: Any, image: NDArray[np.uint8]) -> Answers:
    """Of a box the mask for unambiguous prompts; of its middle, of three, that which is most like the box.

    Logits at the picture's size.
    """
    side = {"height": FRAME, "width": FRAME}
    processor = transformers.SamProcessor(
        transformers.SamImageProcessorPil(size={"longest_edge": FRAME}, pad_size=side)
    )
    boxes = boxes_in(image)
    answers: Answers = {}
    middles = ((boxes[:, :2] + boxes[:, 2:]) / 2).tolist()
    for key, prompt, several in (
        ("box", {"input_boxes": [boxes.tolist()]}, False),
        ("points", {"input_points": [[[middle] for middle in middles]], "input_labels": [[[1]] * len(boxes)]}, True),
    ):
        inputs = processor(image, return_tensors="pt", **prompt)
        prompts = {name: inputs[name] for name in prompt}
        outputs = model(pixel_values=inputs["pixel_values"], multimask_output=several, **prompts)
        (masks,) = processor.image_processor.post_process_masks(
            outputs.pred_masks, inputs["original_sizes"], inputs["reshaped_input_sizes"], binarize=False
        )
        scores = outputs.iou_scores[0]
        best = torch.stack([_fit(of_box, box) for of_box, box in zip(masks, torch.tensor(boxes), strict=True)]).argmax(
            1
        )
        answers |= _picked(f"sam/{key}", masks, scores, best)
    return answers


def _fit(masks: Any, box: Any) -> Any:
    """(M,) intersection over union of each (M, H, W) mask with the box."""
    y, x = (torch.arange(length) + 0.5 for length in masks.shape[1:])
    inside = ((y >= box[1]) & (y < box[3]))[:, None] & (x >= box[0]) & (x < box[2])
    return ((masks > 0) & inside).sum((1, 2)) / ((masks > 0) | inside).sum((1, 2))


def _picked(key: str, masks: Any, scores: Any, best: Any) -> Answers:
    rows = torch.arange(len(best))
    return {f"{key}/masks": masks[rows, best].numpy(), f"{key}/scores": scores[rows, best].numpy()}


def _sam2() -> Any:
    torch.manual_seed(5)
    small = FRAME // 4
    hiera = {
        "hidden_size": 8, "num_attention_heads": 1, "blocks_per_stage": [1, 1, 2, 1], "image_size": [FRAME, FRAME],
        "embed_dim_per_stage": [8, 16, 32, 64], "num_attention_heads_per_stage": [1, 1, 2, 2],
        "window_size_per_stage": [8, 4, 4, 4], "global_attention_blocks": [3],
        "window_positional_embedding_background_size": [4, 4], "mlp_ratio": 2.0,
    }  # fmt: skip
    config = transformers.Sam2Config(
        vision_config={
            "backbone_config": transformers.Sam2HieraDetConfig(**hiera), "backbone_channel_list": [64, 32, 16, 8],
            "backbone_feature_sizes": [[small, small], [small // 2, small // 2], [small // 4, small // 4]],
            "fpn_hidden_size": 32,
        },
        prompt_encoder_config={"hidden_size": 32, "image_size": FRAME, "patch_size": 16, "mask_input_channels": 4},
        mask_decoder_config={
            "hidden_size": 32, "mlp_dim": 32, "num_hidden_layers": 1, "num_attention_heads": 2,
            "iou_head_hidden_dim": 16,
        },
    )  # fmt: skip
    return _random(transformers.Sam2Model(config), seed=6, spread=0.08)


def _sam2_answers(model: Any, image: NDArray[np.uint8]) -> Answers:
    """Of the three masks of every box that with the best score. Logits at the picture's size."""
    processor = transformers.Sam2Processor(
        transformers.Sam2ImageProcessor(size={"height": FRAME, "width": FRAME}), target_size=FRAME
    )
    inputs = processor(image, input_boxes=[boxes_in(image).tolist()], return_tensors="pt")
    outputs = model(pixel_values=inputs["pixel_values"], input_boxes=inputs["input_boxes"], multimask_output=True)
    (masks,) = processor.post_process_masks(outputs.pred_masks, inputs["original_sizes"], binarize=False)
    return _picked("sam2", masks, outputs.iou_scores[0], outputs.iou_scores[0].argmax(1))


if __name__ == "__main__":
    with tempfile.TemporaryDirectory() as made:
        build(Path(made), ["lying", "standing"])
        shutil.make_archive(sys.argv[1].removesuffix(".tar.xz"), "xztar", made)
