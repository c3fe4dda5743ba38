"""Pictures with numbered marks: the six sides, few numbers in each, and close-ups of what is small and close together.

A number stands for the same part in all pictures. It sits in a balloon beside the model, its leader ends on the part,
and the part has the balloon's colour. Nothing of the file's words is drawn.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray
from PIL import Image

from querycad_contracts import PlacedMark, Side
from querycad_segworker.mesh import Mesh
from querycad_segworker.render.palette import part_colors
from querycad_segworker.render.panels import Marked, Panel, draw_panel
from querycad_segworker.render.sheet import Sheet
from querycad_segworker.render.views import View, Viewpoint, choose_views, marked_faces
from querycad_segworker.visibility.cameras import side_camera
from querycad_segworker.visibility.raycast import Scene

from .candidates import Candidate

SIZE = (1120, 800)
"""Pixels of a picture: below what the large endpoints scale down to (some 1.15 megapixels)."""
PREVIEW = (1000, 740)
"""Pixels of the images in which candidates are measured; about as large as they will be drawn."""
A_PICTURE = 9
"""Marks in one picture: well apart, and each named by one digit more seldom than not."""
PICTURES = 16
"""Of a model. Each is a request for every phrase."""
SHOWN_SHARE = 0.3
"""A candidate is marked from where it shows at least this much of what its best side shows."""
SIDES_A_MARK = 3
"""From so many sides at most is one candidate marked: enough to vote."""
MIN_PIXELS = 12
"""Preview pixels below which nothing can be made out, not even enlarged."""
SMALL = 34.0
"""Pixels: candidates with less extent are marked in a close-up."""
NEAR = 0.22
"""Of the picture's width: small candidates nearer than this to one another share a close-up."""
_PAD = 8.0


@dataclass(frozen=True, slots=True)
class Planned:
    """One picture: where from, which candidates are marked, and whether they fill it."""

    viewpoint: Viewpoint
    marks: tuple[int, ...]
    enlarged: bool = False

    @property
    def name(self) -> str:
        """What the picture is called."""
        side = self.viewpoint.value if isinstance(self.viewpoint, Side) else "corner"
        return f"{side}, enlarged" if self.enlarged else side


def plan(mesh: Mesh, listed: Sequence[Candidate], scene: Scene) -> tuple[Planned, ...]:
    """Which pictures show all candidates, each legibly? Whole views first, then close-ups; at most `PICTURES`."""
    owner = _owners(mesh, listed)
    boxes: dict[Side, NDArray[np.float64]] = {}
    shown_m2 = np.zeros((len(Side), len(listed)))
    for row, side in enumerate(Side):
        camera = side_camera(side, scene.bounds, *PREVIEW)
        image = scene.render_ids(camera)
        pixels = _pixels(owner[image.face_id_map], len(listed))
        boxes[side] = np.array([_box(camera.to_pixels(mesh.of_faces(np.array(one.faces)).points_m)) for one in listed])
        for index, one in enumerate(listed):
            if one.anchor_m is not None and pixels[index] <= MIN_PIXELS:  # walls along the view: its opening is seen
                pixels[index] = np.prod(np.ptp(boxes[side][index], axis=0)) if side in one.sides else 0
            elif one.anchor_m is not None and side not in one.sides:
                pixels[index] = 0
        shown_m2[row] = np.where(pixels >= MIN_PIXELS, pixels * camera.pixel_m**2, 0.0)
    large: dict[Side, list[int]] = {side: [] for side in Side}
    small: dict[Side, list[int]] = {side: [] for side in Side}
    for index in range(len(listed)):
        order = np.argsort(-shown_m2[:, index], kind="stable")
        best = shown_m2[order[0], index]
        for row in order[:SIDES_A_MARK]:
            side = list(Side)[row]
            if best > 0 and shown_m2[row, index] >= SHOWN_SHARE * best:
                extent = float(np.ptp(boxes[side][index], axis=0).max())
                (large if extent >= SMALL else small)[side].append(index)
    whole = [
        Planned(side, chunk) for side in Side for chunk in _spread(large[side], boxes[side].mean(axis=1), A_PICTURE)
    ]
    close = [Planned(side, group, enlarged=True) for side in Side for group in _clusters(small[side], boxes[side])]
    return tuple(_fewest([*whole, *close], len(listed))[:PICTURES])


def draw(
    mesh: Mesh, listed: Sequence[Candidate], planned: Planned, scene: Scene
) -> tuple[Image.Image, tuple[PlacedMark, ...]]:
    """The picture, and where its marks are: the number of a candidate is its place among them, from 1."""
    sheet, bottom = Sheet(*SIZE), SIZE[1] - _PAD
    marked = _marked(mesh, listed, planned.marks, scene)
    view, left = View(planned.viewpoint, planned.marks), _PAD
    if planned.enlarged:
        left = SIZE[0] * 0.36
        overview = Panel(View(planned.viewpoint, ()), framed=planned.marks)
        draw_panel(sheet, marked, overview, (_PAD, _PAD, left - _PAD, bottom))
    panel = Panel(view, focus=planned.marks if planned.enlarged else None)
    balloons = draw_panel(sheet, marked, panel, (left, _PAD, SIZE[0] - _PAD, bottom))
    marks = tuple(
        PlacedMark(
            number=one.part + 1, part=listed[one.part].part, x=round(one.anchor[0], 1), y=round(one.anchor[1], 1)
        )
        for one in balloons
    )
    return sheet.finish(), marks


def asked_picture(mesh: Mesh, shown: Sequence[Candidate], side: Side | None) -> tuple[Image.Image, Planned]:
    """The picture that a program asks for: these parts, numbered, from a side or from wherever they are seen best."""
    scene = Scene(mesh, threads=1)
    every = tuple(range(len(shown)))
    viewpoint: Viewpoint
    if side is not None:
        viewpoint = side
    else:
        viewpoint = choose_views(scene, _owners(mesh, shown), len(shown))[0].viewpoint
    planned = Planned(viewpoint, every)
    return draw(mesh, shown, planned, scene)[0], planned


def _owners(mesh: Mesh, listed: Sequence[Candidate]) -> NDArray[np.int32]:
    """(F + 1,) int32, index of each face's candidate, -1 for none and for the background; the smallest has a face."""
    count = max([int(mesh.triangle_face.max(initial=-1)), *(face for one in listed for face in one.faces)]) + 1
    last = len(listed) - 1
    owner = marked_faces(count, [one.faces for one in reversed(listed)])
    owner = np.where(owner >= 0, last - owner, -1).astype(np.int32)
    return np.append(owner, np.int32(-1))


def _pixels(owner_map: NDArray[np.int32], count: int) -> NDArray[np.float64]:
    return np.bincount(owner_map[owner_map >= 0].reshape(-1), minlength=count).astype(np.float64)


def _box(spots: NDArray[np.float64]) -> NDArray[np.float64]:
    """(2, 2): lower and upper corner, in pixels, of what is at these (N, 3) places; zeros of nothing."""
    return np.zeros((2, 2)) if not len(spots) else np.array([spots[:, :2].min(axis=0), spots[:, :2].max(axis=0)])


def _marked(mesh: Mesh, listed: Sequence[Candidate], marks: Sequence[int], scene: Scene) -> Marked:
    """The model with these candidates coloured, each unlike the others of the picture."""
    owner = _owners(mesh, [one if i in marks else Candidate(one.part, (), 0.0) for i, one in enumerate(listed)])[:-1]
    colors = np.zeros((len(listed), 3), dtype=np.uint8)
    colors[list(marks)] = part_colors(len(marks))
    ghosts = Scene(mesh.of_faces(np.flatnonzero(owner >= 0)), threads=1)
    return Marked(scene, ghosts, owner, colors, tuple(one.anchor_m for one in listed))


def _spread(chosen: Sequence[int], middles: NDArray[np.float64], most: int) -> list[tuple[int, ...]]:
    """As few groups as hold them, the members of each far apart: in order of their places, dealt out in turns."""
    if not chosen:
        return []
    groups = -(-len(chosen) // most)
    placed = sorted(chosen, key=lambda index: (*np.round(middles[index] / 40), index))
    return [tuple(sorted(placed[start::groups])) for start in range(groups)]


def _clusters(chosen: Sequence[int], boxes: NDArray[np.float64]) -> list[tuple[int, ...]]:
    """Groups of what lies close together, none with more than `A_PICTURE`; `boxes`: (N, 2, 2) pixels."""
    middles = boxes.mean(axis=1)
    groups: list[list[int]] = []
    for index in chosen:
        near = [one for one in groups if _gap(middles, index, one) < NEAR * PREVIEW[0]]
        groups = [one for one in groups if one not in near]
        groups.append([index, *(other for one in near for other in one)])
    waiting, done = groups, []
    while waiting:
        group = waiting.pop()
        if len(group) <= A_PICTURE:
            done.append(tuple(sorted(group)))
            continue
        spots = middles[group]
        axis = int(np.ptp(spots, axis=0).argmax())
        ordered = [group[i] for i in np.argsort(spots[:, axis], kind="stable")]
        waiting += [ordered[: len(ordered) // 2], ordered[len(ordered) // 2 :]]
    return sorted(done)


def _gap(middles: NDArray[np.float64], index: int, group: Sequence[int]) -> float:
    return float(np.linalg.norm(middles[list(group)] - middles[index], axis=1).min())


def _fewest(planned: Sequence[Planned], count: int) -> list[Planned]:
    """Those that are needed first: greedily, the picture that shows most marks that no picture before has shown.

    Then the rest in order, from which marks are seen a second and a third time.
    """
    left, waiting, chosen = set(range(count)), list(planned), []
    while waiting:
        best = max(waiting, key=lambda one: len(left.intersection(one.marks)))
        if not left.intersection(best.marks):
            break
        chosen.append(best)
        waiting.remove(best)
        left -= set(best.marks)
    return [*chosen, *waiting]
