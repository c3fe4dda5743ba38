"""The `PartFinder` port on this machine: answers from artefacts, and asks the kernel only for new measurements."""

from __future__ import annotations

import importlib.util
from collections.abc import Sequence
from copy import copy
from functools import cache, cached_property
from pathlib import Path
from typing import TYPE_CHECKING

from querycad_contracts import (
    Face,
    FaceQuery,
    FoundFaces,
    Grounded,
    GroundedBy,
    Grounding,
    MarkedPicture,
    Part,
    PartQuery,
    PictureRequest,
    Shape,
    Side,
    Sight,
    Vector,
    needs_eyes,
)
from querycad_language.phrases import noun_phrase

from .eyes.sights import Fetch, Sights, nothing_elsewhere, part_of
from .face_table import chosen, owned
from .fusing.region import faces_of_id, region
from .fusing.vision import Keep, Networks, Vision, keep_here, no_networks
from .grounding.find import find, present
from .grounding.ground import ground
from .grounding.inventory import Inventory
from .measuring import Kernel
from .model import Artefacts
from .vectors import AXES, cross, dot, line_distance, norm

if TYPE_CHECKING:
    from .segcad.ports import VisionOptions


NO_EYES = "geometry alone answered: networks that look at pictures are an extra, 'querycad[vision]'"


class LocalPartFinder:
    """Finds and measures the parts of one model. Nothing here imports the kernel."""

    grounding = GroundedBy.GEOMETRY
    """By which evidence words are turned into parts."""

    def __init__(
        self,
        artefacts: Artefacts,
        networks: Networks = no_networks,
        vision: VisionOptions | None = None,
        keep: Keep = keep_here,
        fetch: Fetch = nothing_elsewhere,
    ) -> None:
        """`networks` gives those that look at pictures when vision is asked, or raises WeightsAbsent.

        `keep` puts pictures, and what eyes saw in them, where others find them; `fetch` brings what others made.
        """
        self.artefacts = artefacts
        self._vision = Vision(artefacts, networks, vision, keep)
        self._sights = Sights(artefacts, keep, fetch)
        self._kernel = Kernel(artefacts)
        self.model = artefacts.load_model()

    @cached_property
    def _parts(self) -> dict[str, Part]:
        return {part.id: part for part in self.model.parts}

    @cached_property
    def _faces(self) -> tuple[Face, ...]:
        return owned(self.artefacts.load_faces(), self.model.parts)

    def grounded_by(self, grounding: GroundedBy) -> LocalPartFinder:
        """The same model, with words turned into parts by this evidence; what is known of it is shared."""
        if grounding is self.grounding:
            return self
        other = copy(self)
        other.grounding = grounding
        return other

    def shape(self) -> Shape:
        """What is the whole model?"""
        return self.model.shape

    @cached_property
    def _inventory(self) -> Inventory:
        return Inventory(self.model.parts)

    @property
    def whole(self) -> Part:
        """The part that stands for the whole model."""
        return self._inventory.parts[0] if self._inventory.model is None else self._inventory.model

    @property
    def names(self) -> frozenset[str]:
        """Words of the product names in the file."""
        return self._inventory.names

    @property
    def kinds(self) -> tuple[str, ...]:
        """Kinds of part that the model has, the most frequent first."""
        return present(self._inventory)

    def ground(self, queries: Sequence[PartQuery]) -> tuple[tuple[Grounded, ...], ...]:
        """In which ways can each query be grounded on the model, the best first?"""
        return tuple(self._ways(query) for query in queries)

    def _ways(self, query: PartQuery) -> tuple[Grounded, ...]:
        """What geometry does not have is looked for, where sight has a say."""
        ways = tuple(ground(self._inventory, query))
        looks = needs_eyes(ways) if self.grounding is GroundedBy.EYES else not ways[0].parts
        if self.grounding is GroundedBy.GEOMETRY or not looks:
            return ways
        seen = self.find_parts(query)
        if self.grounding is GroundedBy.EYES and not seen.seen_by:
            return ways
        return (Grounded(parts=seen.parts, features={}, reason=seen.description), *ways) if seen.parts else ways

    def find_parts(self, description: str | PartQuery, sides: Sequence[Side] | None = None) -> Grounding:
        """Which parts does `description` mean, of those visible from any of `sides`?"""
        by_words = find(self._inventory, description, sides)
        if self.grounding is GroundedBy.GEOMETRY:
            return by_words
        if self.grounding is GroundedBy.EYES:
            query = noun_phrase(description, self.names) if isinstance(description, str) else description
            guessed = needs_eyes(tuple(ground(self._inventory, query)))
            return self._sights.ground(by_words, self._parts, self._faces, guessed)
        if not can_look():
            return by_words.model_copy(update={"warnings": (*by_words.warnings, NO_EYES)})
        return self._vision.ground(by_words, self.grounding, self.model.parts, self._faces)

    def look(self, phrase: str) -> Grounding:
        """Which parts look like this to whoever was shown pictures of them? Geometry has no say."""
        by_words = Grounding(description=" ".join(phrase.split()), sides=None, parts=(), understood=True)
        return self._sights.ground(by_words, self._parts, self._faces, guessed=True, alone=True)

    def marked(self, asked: PictureRequest | None = None) -> tuple[MarkedPicture, ...]:
        """The pictures with marks on all that could be meant; or the one that a program asks for. Raises KeyError."""
        if asked is not None:
            return (self._sights.picture(asked, self._parts, self._faces),)
        return self._sights.pictures(self.model.parts, self._faces)

    def png(self, name: str) -> bytes:
        """A marked picture. Raises OSError."""
        return self.picture_file(name).read_bytes()

    def picture_file(self, name: str) -> Path:
        """Where on this machine is a marked picture?"""
        return self._sights.file(name)

    def keep_sight(self, sight: Sight) -> None:
        """Keeps what was seen. Raises KeyError where a part is none of the model's."""
        for one in sight.found:
            part_of(one.part, self._parts, self._faces)
        self._sights.keep(sight)

    def parts(self) -> tuple[Part, ...]:
        """Which parts were recognised in the model?"""
        return self.model.parts

    def find_faces(self, query: FaceQuery) -> FoundFaces:
        """Which faces are so?"""
        found = chosen(self._faces, query, norm(self.model.shape.extents))
        return FoundFaces(faces=found, part=region(_said(query), found) if found else None)

    def faces(self, ids: Sequence[int]) -> tuple[Face, ...]:
        """What are the faces with these ids? Raises KeyError for an id the model does not have."""
        if any(not 0 <= i < len(self._faces) for i in ids):
            raise KeyError(f"the model has faces 0 to {len(self._faces) - 1}")
        return tuple(self._faces[i] for i in ids)

    def _part(self, part: str) -> Part:
        """The part with this id, recognised or made of faces that were seen. Raises KeyError."""
        faces = faces_of_id(part)
        return self._parts[part] if faces is None else region(part, self.faces(faces))

    def distance(self, part_a: str, part_b: str) -> float:
        """How far apart are the surfaces of two parts, in metres? Exact, by the kernel in a process of its own."""
        first, second = self._part(part_a), self._part(part_b)
        if set(first.faces) & set(second.faces):
            return 0.0
        between = _between_cylinders(first, second)
        if between is not None:
            return between
        return self._kernel.measure("distance", first.faces, second.faces)

    def overlap(self, part_a: str, part_b: str) -> float:
        """Which volume do two closed bodies share, in m3? By the kernel, where their boxes do."""
        first, second = self._part(part_a), self._part(part_b)
        reach = zip(first.center, second.center, first.extents, second.extents, strict=True)
        if any(abs(a - b) >= (size_a + size_b) / 2 for a, b, size_a, size_b in reach):
            return 0.0
        return self._kernel.measure("overlap", first.faces, second.faces)

    def extent(self, part: str, direction: Vector) -> float:
        """How far does a part extend along a unit vector, in metres? By the kernel where that is no axis of the file.

        Raises KeyError for an unknown part id.
        """
        found = self._part(part)
        for axis, extent in zip(AXES, found.extents, strict=True):
            if abs(dot(axis, direction)) > 1 - 1e-12:
                return extent
        return self._kernel.measure("extent", found.faces, direction=direction)

    def edge_distance(self, part: str) -> float:
        """How far is a part from the outer edge of the face it lies in, in metres?"""
        found = self._part(part)
        return (
            found.edge_distance
            if found.edge_distance is not None
            else self._kernel.measure("edge_distance", found.faces)
        )


@cache
def can_look() -> bool:
    """Is the extra installed that networks run with?"""
    return all(importlib.util.find_spec(name) is not None for name in ("cv2", "onnxruntime", "tokenizers"))


def _said(query: FaceQuery) -> str:
    """What is a part of these faces called?"""
    around = ["coaxial"] if query.coaxial_with is not None else []
    facing = [f"{query.facing.value} facing"] if query.facing is not None else []
    kinds = [one.value for one in (query.convexity, query.kind) if one is not None]
    return " ".join([*around, *facing, *kinds, "faces"])


def _between_cylinders(a: Part, b: Part) -> float | None:
    """The gap between two plain round walls side by side, without the kernel: the axes' distance less both radii.

    None where that does not hold: axes not parallel, no overlap along them, several steps, or one inside the other.
    """
    if a.axis is None or b.axis is None or a.radius is None or b.radius is None:
        return None
    if len(a.radii) != 1 or len(b.radii) != 1 or "conical" in (*a.tags, *b.tags):
        return None
    if norm(cross(a.axis, b.axis)) > 1e-9:
        return None
    spans = []
    for part in (a, b):
        middle, half = dot(part.center, a.axis), (part.depth or part.height or 0.0) / 2
        spans.append((middle - half, middle + half))
    gap = line_distance(b.center, a.center, a.axis) - a.radius - b.radius
    overlap = min(spans[0][1], spans[1][1]) - max(spans[0][0], spans[1][0])
    return gap if gap > 0 and overlap > 0 else None
