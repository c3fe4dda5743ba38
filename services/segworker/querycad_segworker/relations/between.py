"""Which parts lie between two of several others? The pairs are as many as the square of these, so few are looked at."""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from typing import TYPE_CHECKING

from querycad_contracts import Part
from querycad_contracts.places import TOUCH_M

if TYPE_CHECKING:
    import numpy as np
    from numpy.typing import NDArray

FEW = 64
"""The pairs of so many are looked at at once; of more, those on different sides of the part, a few each time."""
STEP = 8


def lying_between(found: Sequence[Part], others: Sequence[Part], whole: bool = False) -> list[Part]:
    """Those whose middle lies between those of two others, no farther aside than they reach.

    The `whole` part: it is no longer that way than they are apart, as the wall between two windows, not their plate.
    """
    import numpy as np  # a tenth of a second, for the one word that asks for this

    if len(others) < 2:
        return []
    center, extents = (np.array([getattr(o, name) for o in others]) for name in ("center", "extents"))
    pairs = np.triu_indices(len(others), 1) if len(others) <= FEW else None
    low, high = center - extents / 2 - TOUCH_M, center + extents / 2 + TOUCH_M

    def lies_between(part: Part) -> bool:
        at, size = np.array(part.center), np.array(part.extents)
        aside = (low > at) * 1 - (high < at)
        for some, more in _opposite(aside) if pairs is None else [pairs]:
            first, second = np.minimum(some, more), np.maximum(some, more)  # rounding is not the same both ways
            apart, ahead = center[second] - center[first], at - center[first]
            length, along = np.sqrt((apart * apart).sum(axis=1)), (ahead * apart).sum(axis=1)
            kept = (length >= TOUCH_M) & (along > 0.0) & (along < length**2)
            kept &= (aside[first] * aside[second] < 1).all(axis=1)
            if whole:
                kept &= (size * np.abs(apart)).sum(axis=1) <= length**2
            if kept.any():
                return True
        return False

    return [part for part in found if lies_between(part)]


def _opposite(aside: NDArray[np.int_]) -> Iterator[tuple[NDArray[np.intp], NDArray[np.intp]]]:
    """Pairs of those that lie so to a part along x, y, z, beyond it (1, -1) or beside it (0): not beyond it both."""
    import numpy as np

    code = aside @ (9, 3, 1)
    groups = [np.flatnonzero(code == one) for one in np.unique(code)]
    for k, some in enumerate(groups):
        for more in groups[k:]:
            if (aside[some[0]] * aside[more[0]] < 1).all():
                few, many = sorted((some, more), key=len)
                for start in range(0, len(few), STEP):
                    step = few[start : start + STEP]
                    yield np.repeat(step, len(many)), np.tile(many, len(step))
