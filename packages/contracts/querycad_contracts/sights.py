"""What eyes are shown, and what they say: pictures with numbered marks, and the marks that a phrase means."""

from __future__ import annotations

from pydantic import Field

from .geometry import Frozen
from .queries import Grounded
from .runs import PictureRequest
from .services import ModelTask

_GUESSED = ("sense_stretch", "unknown_whole", "unknown_words", "kin_instead", "guessed")
"""Features of a grounding whose noun geometry takes for something else, or knows only a part of …"""
GUESSED = 0.5
"""… by so much: a lesser stretch is another word for the same."""


def needs_eyes(ways: tuple[Grounded, ...]) -> bool:
    """Is what is meant better looked for? Geometry has none of it, or no name of its own for it. `ways`: best first."""
    return not ways[0].parts or any(ways[0].features.get(name, 0.0) >= GUESSED for name in _GUESSED)


class PlacedMark(Frozen):
    """One number in a picture. The same number is the same part in all pictures of a model."""

    number: int = Field(ge=1)
    part: str = Field(description="Id of the part that it stands for, recognised or made of faces: 'faces-3:5'.")
    x: float = Field(description="Where its leader ends, in pixels from the left.")
    y: float = Field(description="The same, from the top.")


class MarkedPicture(Frozen):
    """A picture with numbered marks. The picture holds the numbers and the side, and no word of the file."""

    name: str = Field(description="Name of the PNG file among those of the model.")
    view: str = Field(description="Such as 'top', or 'top, enlarged'.")
    marks: tuple[PlacedMark, ...]


class Sighted(Frozen):
    """A part that was seen to be what a phrase means."""

    part: str
    score: float = Field(ge=0, le=1, description="How sure, over all pictures in which it has a mark.")
    views: tuple[str, ...] = Field(description="The pictures in which it was said to be meant.")


class Sight(Frozen):
    """What was seen of one phrase on one model."""

    phrase: str = Field(max_length=300)
    by: str = Field(max_length=200, description="Who looked: name of the language model.")
    found: tuple[Sighted, ...] = Field(max_length=1000)
    pictures: tuple[str, ...] = Field((), max_length=100, description="Names of the pictures that show what was found.")


class MarkTask(ModelTask):
    """Draw the pictures with marks on all candidates; or the one that a program asks for."""

    asked: PictureRequest | None = None


class SightTask(ModelTask):
    """Keep what was seen."""

    sight: Sight
