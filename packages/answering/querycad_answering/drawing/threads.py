"""What is a thread called, and which threads does a plain hole suit?"""

from __future__ import annotations

import re

from querycad_contracts import Part
from querycad_language.lexicon import lexicon

_NAMED = re.compile(r"m([\d.]+)x([\d.]+)")
CORE = 1.0825
"""A nut thread's core is this many pitches smaller than its nominal diameter (ISO 68-1: D1 = D - 1.0825 P)."""
NEAR = 0.02
"""A modelled thread's diameter and pitch differ from the nominal ones by less than this share; the next size is 12 %
away or more (ISO 261, from M1.6 to M64)."""
SAME = 2e-5
"""A hole has a diameter of the tables when it differs by less than this, metres: they have two decimals of a
millimetre."""


def thread_name(part: Part) -> str | None:
    """What is the modelled thread of a hole or shaft called: 'M6', 'M8x1'? None where it is none, or of no standard."""
    if "threaded" not in part.tags or part.pitch is None or part.diameter is None:
        return None
    nominal = part.diameter + (CORE * part.pitch if part.kind == "hole" else 0.0)
    for name, drills in lexicon().threads.items():
        match = _NAMED.fullmatch(name)
        if match is None:
            continue
        size, pitch = float(match[1]) * 1e-3, float(match[2]) * 1e-3
        if abs(nominal - size) < NEAR * size and abs(part.pitch - pitch) < 2 * NEAR * pitch:
            coarse = lexicon().threads.get(f"m{match[1]}") == drills
            return f"M{match[1]}" if coarse else f"M{match[1]}x{match[2]}"
    return None


def suits(part: Part) -> tuple[str, ...]:
    """Which metric coarse threads may a plain round hole be meant for: 'tap drill M6', 'clears M5 (medium)'?

    By its diameter alone, after ISO 2306 and ISO 273: a hole of another purpose may have it, too.
    """
    if part.kind != "hole" or part.diameter is None or "threaded" in part.tags:
        return ()
    found = []
    for name, (tap, *clear) in lexicon().threads.items():
        if "x" in name or not name.startswith("m"):
            continue
        said = name.upper()
        if abs(part.diameter - tap) < SAME:
            found.append(f"tap drill {said}")
        for fit, size in zip(("close", "medium", "loose"), clear, strict=False):
            if abs(part.diameter - size) < SAME:
                found.append(f"clears {said} ({fit})")
    return tuple(found)
