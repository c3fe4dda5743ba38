"""The sheet that a picture is laid out on: panels, text, balloons, all antialiased."""

from __future__ import annotations

import re
import unicodedata
from functools import lru_cache

import numpy as np
from numpy.typing import NDArray
from PIL import Image, ImageDraw, ImageFont

from .labels import Balloon, Point

OVERSAMPLING = 2
"""Everything is drawn twice as large and averaged down: smooth edges for a quarter of what 4x would cost."""

Box = tuple[float, float, float, float]
"""Left, top, right, bottom."""
Color = tuple[int, int, int]
DARK: Color = (30, 34, 40)
MUTED: Color = (105, 112, 122)

_SPELLED = str.maketrans(
    {
        "×": "x",
        "⌀": "diameter ",
        "Ø": "diameter ",
        "ß": "ss",
        "≤": "<=",
        "≥": ">=",
        "−": "-",
        "–": "-",
        "—": "-",
        "→": "->",
    }
)
_DRAWABLE = set(map(chr, range(32, 127))) | set("©«°±´·»‘’“”…‹›™")
"""What Pillow's built-in font has shapes for."""
_UNIT = re.compile(r"(?<=\d) (?=(?:mm|cm|m|in|deg)\b)")
"""The space between a number and its unit, where no line breaks (ISO 80000-1)."""


class Sheet:
    """A white sheet; all coordinates and sizes are pixels of the finished picture, (x, y) from its upper left."""

    def __init__(self, width: int, height: int) -> None:
        self.width, self.height = width, height
        self._image = Image.new("RGB", (width * OVERSAMPLING, height * OVERSAMPLING), "white")
        self._draw = ImageDraw.Draw(self._image)

    def finish(self) -> Image.Image:
        """What does the finished picture look like?"""
        return self._image.reduce(OVERSAMPLING)

    def paste(self, pixels: NDArray[np.uint8], left: float, top: float) -> None:
        """Puts (H, W, 3) uint8 pixels, already oversampled, on the sheet."""
        self._image.paste(Image.fromarray(pixels), (round(left * OVERSAMPLING), round(top * OVERSAMPLING)))

    def text(
        self, at: Point, text: str, size: float, color: Color = DARK, anchor: str = "la", bold: bool = False
    ) -> None:
        """Writes one line; `anchor` as in Pillow ('la' upper left, 'mm' middle)."""
        stroke = round(size * OVERSAMPLING / 40) if bold else 0
        self._draw.text(_scaled(at), plain(text), fill=color, font=_font(size), anchor=anchor, stroke_width=stroke)

    def wrap(self, text: str, size: float, width: float, lines: int) -> list[str]:
        """How does the text break into at most so many lines of that width? What does not fit ends in '…'."""
        font, room = _font(size), width * OVERSAMPLING
        rows: list[str] = []
        for word in _UNIT.sub("\0", plain(text)).split():
            joined = f"{rows[-1]} {word}" if rows else word
            if rows and font.getlength(joined.replace("\0", " ")) <= room:
                rows[-1] = joined
            else:
                rows.append(word)
        kept = [row.replace("\0", " ") for row in rows[:lines]]
        for index, row in enumerate(kept):
            cut, dots = row, "…" if index == lines - 1 and len(rows) > lines else ""
            while len(cut) > 1 and font.getlength(cut + dots) > room:
                cut, dots = cut[:-1], "…"
            kept[index] = cut + dots
        return kept

    def line(self, points: list[Point], width: float, color: Color) -> None:
        """Draws a line through the points."""
        self._draw.line(
            [_scaled(point) for point in points], fill=color, width=round(width * OVERSAMPLING), joint="curve"
        )

    def rectangle(self, box: Box, width: float, color: Color) -> None:
        """Draws the outline of a box."""
        left, top, right, bottom = box
        self._draw.rectangle(
            (*_scaled((left, top)), *_scaled((right, bottom))), outline=color, width=round(width * OVERSAMPLING)
        )

    def disc(self, center: Point, radius: float, fill: Color, outline: Color, width: float = 1.0) -> None:
        """Draws a filled circle."""
        x, y = center
        corners = (*_scaled((x - radius, y - radius)), *_scaled((x + radius, y + radius)))
        self._draw.ellipse(corners, fill=fill, outline=outline, width=round(width * OVERSAMPLING))

    def leader(self, balloon: Balloon) -> None:
        """Draws the line from a balloon to its part, light on both sides so that it reads on any colour."""
        self.line([balloon.rim, balloon.anchor], 3.5, (255, 255, 255))
        self.line([balloon.rim, balloon.anchor], 1.5, DARK)
        self.disc(balloon.anchor, 3.5, DARK, (255, 255, 255))

    def numbered(self, number: int, center: Point, radius: float, fill: Color, ink: Color) -> None:
        """Draws a circle of the part's colour with its number."""
        self.disc(center, radius, fill, DARK, 1.5)
        size = radius * (1.25 if number < 10 else 1.05 if number < 100 else 0.8)
        self.text(center, str(number), size, ink, "mm")


def plain(text: str) -> str:
    """How is the text written in the characters that the font has? Accents are dropped, unknown characters are '?'."""
    spelled = unicodedata.normalize("NFKD", text.translate(_SPELLED).replace("…", "\0"))
    kept = (char for char in spelled if not unicodedata.combining(char))
    return "".join(
        "…" if char == "\0" else char if char in _DRAWABLE else " " if char.isspace() else "?" for char in kept
    )


@lru_cache(maxsize=32)
def _font(size: float) -> ImageFont.FreeTypeFont:
    font = ImageFont.load_default(size=size * OVERSAMPLING)
    if not isinstance(font, ImageFont.FreeTypeFont):
        raise RuntimeError("Pillow was built without FreeType, so text cannot be drawn")
    return font


def _scaled(point: Point) -> tuple[float, float]:
    return (point[0] * OVERSAMPLING, point[1] * OVERSAMPLING)
