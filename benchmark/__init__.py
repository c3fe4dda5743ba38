"""Is QueryCAD right, and is it fast? Models with true answers, and what measures with them; see docs/benchmark.md.

It lies in the checkout and is part of no package. The examples' helper for STEP files is made importable here.
"""

from __future__ import annotations

import sys
from pathlib import Path

ROOT = Path(__file__).resolve().parents[1]
"""Of the checkout; processes of the benchmark are started there, so that they find it."""

sys.path.append(str(ROOT / "examples"))
