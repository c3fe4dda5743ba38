"""What did each stage see? A picture a stage of every view, and all of them on one sheet."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass, replace

import cv2
import numpy as np
from numpy.typing import NDArray
from PIL import Image, ImageDraw, ImageFont

from querycad_segworker.render.palette import part_colors, readable_on, rgb
from querycad_segworker.render.shading import NEUTRAL, shade
from querycad_segworker.render.sheet import MUTED, OVERSAMPLING, Sheet
from querycad_segworker.segcad.pipeline import Looked
from querycad_segworker.segcad.ports import Masks
from querycad_segworker.segcad.render import View
from querycad_segworker.visibility.renderer import Renderer

STAGES = ("rendered", "boxes", "masks", "faces")
"""The pictures of a view, in the order of the stages; also what their files are called."""
PALE = 0.25
"""What is left of the colours where boxes or masks are drawn over them."""
MASKED = 0.6
"""Opacity of a mask: the faces under it can still be told apart."""
DISCARDED = (120, 120, 120)
PRUNED = (70, 70, 70)
"""sRGB of faces that were masked but do not hang together with the nearest one."""
_TILE = (448, 252)
_GAP, _NAME, _HEAD = 8, 84, 64


@dataclass(frozen=True, slots=True, eq=False)
class ViewPictures:
    """(H, W, 3) uint8 sRGB each, as large as the view."""

    view: str
    rendered: NDArray[np.uint8]
    boxes: NDArray[np.uint8]
    """With each detection's score."""
    masks: NDArray[np.uint8]
    """Discarded ones are grey, with the reason."""
    faces: NDArray[np.uint8]
    """The faces that were selected, in the colour of their mask; dark, those that were pruned again."""

    def of_stages(self) -> tuple[NDArray[np.uint8], ...]:
        """In the order of `STAGES`."""
        return (self.rendered, self.boxes, self.masks, self.faces)


def draw_view(looked: Looked, renderer: Renderer) -> ViewPictures:
    """What did the stages make of this view?"""
    colors = part_colors(len(looked.detections))
    return ViewPictures(
        view=looked.view.camera.name,
        rendered=looked.view.picture,
        boxes=_boxes(looked, colors),
        masks=_masks(looked, colors),
        faces=_faces(looked, colors, renderer),
    )


def _pale(picture: NDArray[np.uint8]) -> NDArray[np.uint8]:
    return (255 - (255 - picture.astype(np.float32)) * PALE).astype(np.uint8)


def _boxes(looked: Looked, colors: NDArray[np.uint8]) -> NDArray[np.uint8]:
    image = Image.fromarray(_pale(looked.view.picture))
    draw, line = ImageDraw.Draw(image), _line(image.height)
    for detection, color in zip(looked.detections, colors, strict=True):
        left, top, right, bottom = detection.box
        draw.rectangle((left, top, max(left, right - 1), max(top, bottom - 1)), outline=rgb(color), width=line)
    for detection, color in zip(looked.detections, colors, strict=True):
        _tag(draw, (detection.box[0], detection.box[1]), f"{detection.score:.2f}", rgb(color), image.height)
    return np.asarray(image)


def _masks(looked: Looked, colors: NDArray[np.uint8]) -> NDArray[np.uint8]:
    picture = _pale(looked.view.picture)
    gone = {each.mask: each.reason for each in looked.discarded}
    tags = []
    for index in sorted(range(len(colors)), key=lambda i: (i not in gone, -int(looked.masks.masks[i].sum()))):
        mask = looked.masks.masks[index]
        color = DISCARDED if index in gone else rgb(colors[index])
        picture[mask] = (picture[mask] * (1 - MASKED) + np.array(color) * MASKED).astype(np.uint8)
        outline, _ = cv2.findContours(mask.astype(np.uint8), cv2.RETR_EXTERNAL, cv2.CHAIN_APPROX_NONE)
        cv2.drawContours(picture, outline, -1, color, _line(len(picture)))
        if index in gone:
            tags.append((looked.detections[index].box, gone[index]))
    image = Image.fromarray(picture)
    draw = ImageDraw.Draw(image)
    for box, reason in tags:
        _tag(draw, (box[0], box[1]), reason, DISCARDED, image.height)
    return np.asarray(image)


def _faces(looked: Looked, colors: NDArray[np.uint8], renderer: Renderer) -> NDArray[np.uint8]:
    table = np.full((len(looked.view.visible), 3), NEUTRAL, dtype=np.uint8)
    pairs = list(zip(looked.aligned, looked.finds, strict=True))
    for aligned, found in pairs:
        table[list(aligned.faces - found.faces)] = PRUNED
    for aligned, found in pairs:
        table[list(found.faces)] = colors[aligned.mask]
    return shade(renderer.render_ids(looked.view.camera, normals=True), table)


def contact_sheet(title: str, rows: Sequence[ViewPictures]) -> Image.Image:
    """All stages of these views on one sheet, a row a view."""
    width = _NAME + len(STAGES) * (_TILE[0] + _GAP)
    sheet = Sheet(width, _HEAD + len(rows) * (_TILE[1] + _GAP))
    sheet.text((_GAP, 8), sheet.wrap(title, 18, width - 2 * _GAP, 1)[0], 18, bold=True)
    for column, stage in enumerate(STAGES):
        sheet.text((_NAME + column * (_TILE[0] + _GAP), 38), stage, 14, MUTED)
    for number, row in enumerate(rows):
        top = _HEAD + number * (_TILE[1] + _GAP)
        for line, word in enumerate(row.view.split()):
            sheet.text((_GAP, top + 4 + 18 * line), word, 14)
        for column, picture in enumerate(row.of_stages()):
            left = _NAME + column * (_TILE[0] + _GAP)
            sheet.paste(_resized(picture), left, top)
            sheet.rectangle((left, top, left + _TILE[0], top + _TILE[1]), 0.5, MUTED)
    return sheet.finish()


def reduced(looked: Looked) -> Looked:
    """The same, just large enough for a tile of the sheet: drawn in a tenth of the time."""
    camera, view = looked.view.camera, looked.view
    width, height = _TILE[0] * OVERSAMPLING, _TILE[1] * OVERSAMPLING
    across, down = width / camera.width, height / camera.height
    smaller = replace(camera, width=width, height=height, pixel_m=camera.pixel_m / min(across, down))
    ids = replace(view.ids, camera=smaller)
    masks = [
        cv2.resize(np.ascontiguousarray(mask).view(np.uint8), (width, height), interpolation=cv2.INTER_NEAREST)
        for mask in looked.masks.masks
    ]
    return replace(
        looked,
        view=View(ids, _resized(view.picture), view.visible),
        detections=tuple(
            replace(one, box=(one.box[0] * across, one.box[1] * down, one.box[2] * across, one.box[3] * down))
            for one in looked.detections
        ),
        masks=Masks(np.array(masks, dtype=np.bool_).reshape(-1, height, width), looked.masks.scores),
    )


def _resized(picture: NDArray[np.uint8]) -> NDArray[np.uint8]:
    """The picture in the pixels that a tile of the sheet is drawn with."""
    size = (_TILE[0] * OVERSAMPLING, _TILE[1] * OVERSAMPLING)
    if picture.shape[1::-1] == size:
        return picture
    return np.asarray(cv2.resize(picture, size, interpolation=cv2.INTER_AREA), dtype=np.uint8)


def _line(height: int) -> int:
    return max(1, round(height / 360))


def _tag(
    draw: ImageDraw.ImageDraw, at: tuple[float, float], text: str, color: tuple[int, int, int], height: int
) -> None:
    """A label on a ground of its colour, above the point where there is room, else below it."""
    font = ImageFont.load_default(size=max(10.0, height / 32))
    left, top, right, bottom = draw.textbbox((0, 0), text, font=font)
    pad = 2.0
    wide, high = right - left + 2 * pad, bottom - top + 2 * pad
    x = max(0.0, min(at[0], draw.im.size[0] - wide))
    y = at[1] - high if at[1] >= high else at[1]
    draw.rectangle((x, y, x + wide, y + high), fill=color)
    draw.text((x + pad - left, y + pad - top), text, font=font, fill=readable_on(np.array(color, dtype=np.uint8)))
