"""One view of the model with its marked parts: rendered, and labelled with balloons."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from querycad_contracts import Vector
from querycad_segworker.visibility.cameras import Camera
from querycad_segworker.visibility.raycast import IdImage, Scene

from .labels import Balloon, Point, place_balloons, ring_around
from .palette import readable_on, rgb
from .shading import NEUTRAL, shade
from .sheet import MUTED, OVERSAMPLING, Box, Sheet
from .views import View, camera_at

RADII = (15.0, 12.0, 10.0, 8.0)
"""Radii of balloons, pixels: the largest with which all fit around the model. Below 8 a number cannot be read."""
STRIP = 44.0
"""Height of the strip below a view that holds its axes and its name."""
DETAIL_BELOW = 24.0
"""Parts all smaller than this, in pixels, cannot be told from one another: they get an enlarged view as well …"""
DETAIL_WITHIN = 0.35
"""… unless they are spread over more than this share of the view's width or height, which would enlarge nothing."""
DETAIL_MARGIN = 0.3
"""Share of an enlarged view left free on each side: the surroundings say where on the model one is."""
_CLEAR = 12.0  # between the model and the balloons


@dataclass(frozen=True, slots=True, eq=False)
class Marked:
    """The model with its marked parts, as every panel needs it."""

    scene: Scene
    ghosts: Scene
    """The marked faces alone."""
    part_of: NDArray[np.int32]
    """(F,) int32, part of each face, -1 for none."""
    colors: NDArray[np.uint8]
    """(parts, 3) uint8 sRGB."""
    anchors_m: tuple[Vector | None, ...]
    """Where each part's leader shall point."""

    def points_of(self, parts: tuple[int, ...]) -> NDArray[np.float64]:
        """Which vertices do the parts have? (N, 3) metres."""
        return self.ghosts.mesh.of_faces(np.flatnonzero(np.isin(self.part_of, parts))).points_m


@dataclass(frozen=True, slots=True)
class Panel:
    """What one panel of the sheet shows."""

    view: View
    """The parts numbered here; none in the overview beside an enlarged view."""
    focus: tuple[int, ...] | None = None
    """The parts that fill an enlarged view; None for the whole model."""
    framed: tuple[int, ...] = ()
    """The parts around which a frame marks what the enlarged view shows."""


def draw_panel(sheet: Sheet, marked: Marked, panel: Panel, box: Box) -> tuple[Balloon, ...]:
    """Draws the panel into the box; which parts got their number, and where? More than fit around the view do not."""
    left, top, right, bottom = box
    width, height = int(right - left), int(bottom - top - STRIP)
    camera = _camera(marked, panel, width, height)
    image = marked.scene.render_ids(camera, normals=True)
    ghost = marked.ghosts.render_ids(camera)
    face_colors = np.append(marked.colors, [NEUTRAL], axis=0).astype(np.uint8)[marked.part_of]  # -1: the neutral one
    sheet.paste(shade(image, face_colors, ghost), left, top)
    _draw_name(sheet, camera, panel, (left, bottom - STRIP))
    if panel.focus is not None:
        sheet.rectangle((left, top, left + width, top + height), 1.5, MUTED)
    if panel.framed:
        sheet.rectangle(_frame(marked, panel.framed, camera, box), 1.5, MUTED)
    spots = {
        part: (left + x / OVERSAMPLING, top + y / OVERSAMPLING)
        for part, (x, y) in _spots(marked, panel.view.parts, image, ghost).items()
    }
    return _draw_balloons(sheet, marked, spots, _outline(image, box))


def _camera(marked: Marked, panel: Panel, width: int, height: int) -> Camera:
    scene, viewpoint = marked.scene, panel.view.viewpoint
    size = (width * OVERSAMPLING, height * OVERSAMPLING)
    if panel.focus is not None:
        return camera_at(viewpoint, scene.bounds, size, DETAIL_MARGIN, marked.points_of(panel.focus))
    points = scene.mesh.points_m
    room = 2 * RADII[0] + _CLEAR + 4.0
    return camera_at(
        viewpoint, scene.bounds, size, min(0.2, room / min(width, height)), points if len(points) else scene.bounds
    )


def needs_detail(marked: Marked, view: View, width: int, height: int) -> bool:
    """Are the parts of this view so small and so close together that they must be enlarged to be made out?"""
    camera = _camera(marked, Panel(view), width, height)
    groups = [camera.to_pixels(points)[:, :2] for part in view.parts if len(points := marked.points_of((part,)))]
    if not groups:
        return False
    largest = max(float(np.ptp(spots, axis=0).max()) for spots in groups) / OVERSAMPLING
    spread = np.ptp(np.concatenate(groups), axis=0) / (camera.width, camera.height)
    return largest < DETAIL_BELOW and float(spread.max()) < DETAIL_WITHIN


def _frame(marked: Marked, parts: tuple[int, ...], camera: Camera, box: Box) -> Box:
    """Around what does an enlarged view of these parts look, on the sheet?"""
    spots = camera.to_pixels(marked.points_of(parts))[:, :2] / OVERSAMPLING
    low, high = spots.min(axis=0), spots.max(axis=0)
    grow = float((high - low).max()) * DETAIL_MARGIN / (1 - 2 * DETAIL_MARGIN) + 6.0
    return (
        max(box[0], box[0] + float(low[0]) - grow),
        max(box[1], box[1] + float(low[1]) - grow),
        min(box[2], box[0] + float(high[0]) + grow),
        min(box[3] - STRIP, box[1] + float(high[1]) + grow),
    )


def _spots(marked: Marked, parts: tuple[int, ...], image: IdImage, ghost: IdImage) -> dict[int, Point]:
    """Where on the image do the leaders of the parts end? Parts outside the image are left out.

    At the anchor where nothing hides it, else on the part's visible pixels, else on where it shines through.
    """
    lookup = np.append(marked.part_of, -1)
    spots = _middles(lookup[ghost.face_id_map], parts)
    spots.update(_middles(lookup[image.face_id_map], parts))
    camera = image.camera
    for part in parts:
        anchor = marked.anchors_m[part]
        if anchor is None:
            continue
        x, y, depth = (float(value) for value in camera.to_pixels([anchor])[0])
        if not (0 <= x < camera.width and 0 <= y < camera.height):
            continue
        if image.depth_m[int(y), int(x)] > depth - 2 * camera.pixel_m:
            spots[part] = (x, y)
    return spots


def _middles(part_map: NDArray[np.int32], parts: tuple[int, ...]) -> dict[int, Point]:
    """The pixel of each part that lies in the middle of it: of those nearest to the centroid, inside the shape."""
    flat = np.flatnonzero(np.isin(part_map, parts))
    owner = part_map.reshape(-1)[flat]
    order = np.argsort(owner, kind="stable")
    starts = np.searchsorted(owner[order], parts)
    ends = np.searchsorted(owner[order], parts, side="right")
    middles = {}
    for part, start, end in zip(parts, starts, ends, strict=True):
        if start == end:
            continue
        rows, columns = np.divmod(flat[order[start:end]], part_map.shape[1])
        center = (columns.mean(), rows.mean())
        nearest = int(((columns - center[0]) ** 2 + (rows - center[1]) ** 2).argmin())
        middles[part] = (float(columns[nearest]) + 0.5, float(rows[nearest]) + 0.5)
    return middles


def _outline(image: IdImage, box: Box) -> NDArray[np.float64]:
    """Around what do the balloons sit? (N, 2) on the sheet: the silhouette and some air, as far as there is room."""
    left, top, right, bottom = box
    room = 2 * RADII[0] + 3.0
    shown = image.face_id_map >= 0
    rows = np.flatnonzero(shown.any(axis=1))
    ends = np.concatenate([shown[rows].argmax(axis=1), shown.shape[1] - 1 - shown[rows, ::-1].argmax(axis=1)])
    spots = np.stack([ends, np.tile(rows, 2)], axis=1) / OVERSAMPLING
    air = np.concatenate([spots + np.array([left + x, top + y]) for x in (-_CLEAR, _CLEAR) for y in (-_CLEAR, _CLEAR)])
    limits = np.array([[left + room, top + room], [right - room, bottom - STRIP - room]])
    return np.clip(air, *limits) if len(air) else limits


def _draw_balloons(
    sheet: Sheet, marked: Marked, spots: dict[int, Point], outline: NDArray[np.float64]
) -> tuple[Balloon, ...]:
    """Draws the balloons as large as they fit; which are there?"""
    for radius in RADII:
        ring = ring_around(outline, radius)
        if len(ring.rims) >= len(spots):
            break
    fitting = dict(list(spots.items())[: len(ring.rims)])
    balloons = place_balloons(fitting, ring)
    for balloon in balloons:
        sheet.leader(balloon)
    for balloon in balloons:
        color = marked.colors[balloon.part]
        sheet.numbered(balloon.part + 1, balloon.center, radius, rgb(color), readable_on(color))
    return balloons


def _draw_name(sheet: Sheet, camera: Camera, panel: Panel, at: Point) -> None:
    """The three axes as this view shows them, and where it looks from."""
    x, y = at
    origin = (x + 22.0, y + 24.0)
    for axis, (name, color) in enumerate((("x", (200, 40, 40)), ("y", (30, 140, 50)), ("z", (40, 80, 200)))):
        end = (origin[0] + 16 * camera.right[axis], origin[1] - 16 * camera.up[axis])
        if np.hypot(end[0] - origin[0], end[1] - origin[1]) < 4:
            continue  # it points at the viewer or away
        sheet.line([origin, end], 1.5, color)
        tip = (origin[0] + 22 * camera.right[axis], origin[1] - 22 * camera.up[axis])
        sheet.text(tip, name, 11, color, "mm")
    kind = "enlarged, seen from" if panel.focus is not None else "seen from"
    sheet.text((x + 56, y + 24), f"{kind} {camera.name}", 14, MUTED, "lm")
