"""What recognition asks of the space about the material: can one see from here to there?"""

from __future__ import annotations

from collections.abc import Callable

from querycad_contracts import Vector

IsClear = Callable[[Vector, Vector], bool]
"""Is the straight way between two points free of material?"""
