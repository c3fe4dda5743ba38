"""What recognition asks of the space about the material: can one see from here to there, and what comes next?"""

from __future__ import annotations

from collections.abc import Callable

import numpy as np
from numpy.typing import ArrayLike, NDArray

from querycad_contracts import Vector

IsClear = Callable[[Vector, Vector], bool]
"""Is the straight way between two points free of material?"""
Ahead = Callable[[ArrayLike, ArrayLike], tuple[NDArray[np.float64], NDArray[np.int32]]]
"""From points (N, 3), metres, along unit directions (N, 3): how far is the next surface, (N,) metres, infinite where
nothing is, and which face is it, (N,) ids, negative where nothing is? A point on a surface starts beyond it."""
