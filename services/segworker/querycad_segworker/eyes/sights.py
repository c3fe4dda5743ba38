"""What eyes saw in one model: the pictures that they are shown, what they said, and what becomes of words by that."""

from __future__ import annotations

import tempfile
from collections.abc import Callable, Sequence
from hashlib import sha256
from pathlib import Path

from PIL import Image
from pydantic import TypeAdapter, ValidationError

from querycad_contracts import Face, Grounding, MarkedPicture, Part, PictureRequest, Sight
from querycad_segworker.fusing.region import faces_of_id, region
from querycad_segworker.fusing.vision import Keep, with_picture
from querycad_segworker.model import Artefacts, sheet_name

VERSION = 1
"""Raise it when candidates, numbers or pictures change: older ones are then drawn anew."""
SHEETS = 2
"""Pictures that go with an answer, those with most of what was found first."""
NOT_LOOKED = "nobody has looked at pictures for it: geometry alone answered"
_PICTURES = TypeAdapter(tuple[MarkedPicture, ...])

Fetch = Callable[[Path], None]
"""Brings a file here that another machine has made, if there is one."""


def nothing_elsewhere(_: Path) -> None:
    """All files are on this machine."""


class Sights:
    """What eyes were shown of one model, and saw in it."""

    def __init__(self, artefacts: Artefacts, keep: Keep, fetch: Fetch = nothing_elsewhere) -> None:
        self._artefacts = artefacts
        self._keep = keep
        self._fetch = fetch

    def file(self, name: str) -> Path:
        """Where is a picture of this name?"""
        return self._artefacts.sight(Path(name).name)

    def pictures(self, parts: Sequence[Part], faces: Sequence[Face]) -> tuple[MarkedPicture, ...]:
        """The pictures with marks on all candidates, and what their numbers stand for; drawn once a model."""
        sidecar = self._artefacts.sight(f"marks-{VERSION}.json")
        self._fetch(sidecar)
        if sidecar.is_file():
            return _PICTURES.validate_json(sidecar.read_bytes())
        from querycad_segworker.mesh import Mesh
        from querycad_segworker.visibility.raycast import Scene

        from .candidates import candidates
        from .pictures import draw, plan

        listed, _ = candidates(parts, faces)
        if not listed:
            return ()
        mesh = Mesh.load(self._artefacts.mesh)
        scene = Scene(mesh, threads=1)  # a segworker is one of several processes that share the machine
        made: list[MarkedPicture] = []
        for number, planned in enumerate(plan(mesh, listed, scene), start=1):
            image, marks = draw(mesh, listed, planned, scene)
            name = f"marks-{VERSION}-{number}.png"
            self._save(name, image)
            made.append(MarkedPicture(name=name, view=planned.name, marks=marks))
        found = tuple(made)
        self._write(sidecar.name, lambda path: path.write_bytes(_PICTURES.dump_json(found)))
        return found

    def picture(self, asked: PictureRequest, parts: dict[str, Part], faces: Sequence[Face]) -> MarkedPicture:
        """The picture that a program asks for. Raises KeyError for an unknown part."""
        from querycad_segworker.mesh import Mesh

        from .candidates import Candidate
        from .pictures import asked_picture

        shown = [part_of(each, parts, faces) for each in asked.parts]
        listed = [Candidate(one.id, one.faces, one.area or 0.0, one.sides, one.opening or one.tip) for one in shown]
        name = f"asked-{sha256(asked.model_dump_json().encode()).hexdigest()[:32]}.png"
        image, planned = asked_picture(Mesh.load(self._artefacts.mesh), listed, asked.side)
        self._save(name, image)
        return MarkedPicture(name=name, view=planned.name, marks=())

    def known(self, phrase: str) -> Sight | None:
        """What was seen of this phrase? None where nobody has looked."""
        path = self._artefacts.sight(_sight_name(phrase))
        self._fetch(path)
        try:
            return Sight.model_validate_json(path.read_bytes())
        except (OSError, ValidationError):
            return None

    def keep(self, sight: Sight) -> None:
        """Keeps what was seen, with the pictures that show it."""
        images = []
        for name in sight.pictures[:SHEETS]:
            path = self.file(name)
            self._fetch(path)
            with Image.open(path) as picture:
                images.append(picture.convert("RGB"))
        if images:
            from querycad_segworker.render.evidence import stacked

            self._save(_sheet(sight.phrase), stacked(images))
        self._write(_sight_name(sight.phrase), lambda path: path.write_text(sight.model_dump_json(), encoding="utf-8"))

    def ground(
        self,
        by_words: Grounding,
        parts: dict[str, Part],
        faces: Sequence[Face],
        guessed: bool,
        alone: bool = False,
    ) -> Grounding:
        """What does the description mean when what was seen is taken into account; or, `alone`, is all there is?

        `guessed`: geometry has no name of its own for it, so that what was seen goes before.
        """
        from querycad_segworker.fusing.fusion import Sighting, by_vision, fuse  # brings NumPy

        phrase = by_words.description
        sight = self.known(phrase)
        if sight is None:
            empty = by_vision(phrase, by_words.sides, ()) if alone else by_words
            return empty.model_copy(update={"seen_by": "", "warnings": (*by_words.warnings, NOT_LOOKED)})
        found = [
            Sighting(part_of(one.part, parts, faces, phrase), one.score, one.views, faces_of_id(one.part) is None)
            for one in sight.found
        ]
        result = by_vision(phrase, by_words.sides, found) if guessed else fuse(by_words, found)
        if guessed and not result.parts and not alone:
            result = fuse(by_words, found)
        elif guessed and result.parts:
            result = result.model_copy(
                update={"warnings": (*by_words.warnings, f"found by sight alone, by {sight.by}")}
            )
        told = tuple(with_picture(part, _sheet(phrase)) for part in result.parts)
        return result.model_copy(update={"parts": told, "seen_by": sight.by})

    def _save(self, name: str, image: Image.Image) -> None:
        self._write(name, lambda path: image.save(path, format="PNG"))

    def _write(self, name: str, write: Callable[[Path], object]) -> None:
        place = self._artefacts.sight(name)
        place.parent.mkdir(parents=True, exist_ok=True)
        with tempfile.TemporaryDirectory(prefix="draw-", dir=place.parent) as scratch:
            unfinished = Path(scratch) / name
            write(unfinished)
            self._keep(unfinished, place)


def part_of(name: str, parts: dict[str, Part], faces: Sequence[Face], phrase: str = "") -> Part:
    """The part with this id, recognised or made of faces. Raises KeyError."""
    made_of = faces_of_id(name)
    if made_of is None:
        return parts[name]
    if any(not 0 <= face < len(faces) for face in made_of):
        raise KeyError(name)
    return region(phrase or name, [faces[face] for face in made_of])


def _sight_name(phrase: str) -> str:
    return f"{sha256(phrase.encode()).hexdigest()[:32]}.json"


def _sheet(phrase: str) -> str:
    """Eyes and networks may have looked for the same words."""
    return sheet_name(f"eyes: {phrase}")
