"""Which colours tell parts apart?"""

from __future__ import annotations

import colorsys

import numpy as np
from numpy.typing import NDArray

_FIRST = ("#0072B2", "#D55E00", "#009E73", "#CC79A7", "#E69F00", "#56B4E9", "#B8A800")
"""Okabe and Ito, "Color Universal Design" (2008): told apart with any kind of colour vision; the yellow is darkened to
stand out from light grey, black is left to the lines."""
_GOLDEN = 0.618034
"""Share of the colour circle between successive hues: any number of them stays spread out (golden angle)."""


def part_colors(count: int) -> NDArray[np.uint8]:
    """Which colour has each part? (count, 3) uint8 sRGB, always the same; well separated for the first dozens."""
    colors = [tuple(bytes.fromhex(name[1:])) for name in _FIRST[:count]]
    for index in range(len(colors), count):
        hue = (0.08 + index * _GOLDEN) % 1.0
        lightness = (0.42, 0.58, 0.34)[index % 3]
        colors.append(tuple(round(255 * channel) for channel in colorsys.hls_to_rgb(hue, lightness, 0.75)))
    return np.array(colors, dtype=np.uint8).reshape(count, 3)


def rgb(color: NDArray[np.uint8]) -> tuple[int, int, int]:
    """What are red, green and blue as plain numbers?"""
    red, green, blue = (int(channel) for channel in color)
    return (red, green, blue)


def readable_on(color: NDArray[np.uint8]) -> tuple[int, int, int]:
    """Is black or white text read better on this colour? By relative luminance (WCAG 2.2)."""
    linear = (np.asarray(color, dtype=np.float64) / 255) ** 2.2
    luminance = float(linear @ (0.2126, 0.7152, 0.0722))
    return (0, 0, 0) if (luminance + 0.05) ** 2 > 1.05 * 0.05 else (255, 255, 255)
