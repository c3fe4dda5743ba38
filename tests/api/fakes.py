"""A small model that was never read, and a sandbox that runs nothing."""

from __future__ import annotations

import hashlib
from collections.abc import Callable

from querycad_contracts import Grounding, ModelSummary, Program, RunOutcome, RunStatus, Shape

STEP = b"ISO-10303-21;\n"
MODEL = hashlib.sha256(STEP).hexdigest()
BOX = Shape(name="box", center=(0, 0, 0), extents=(0.1, 0.2, 0.3), volume=0.006, area=0.22, bodies=(), face_count=6)
SUMMARY = ModelSummary(shape=BOX, body_count=1, part_counts={}, warnings=("it was tilted",), timings_ms={})
NO_HOLE = Grounding(description="hole", sides=None, parts=(), understood=True, message="there is no hole")


class FakeSandbox:
    """Runs nothing: says that there are no holes, or raises what it is told to."""

    def __init__(self, error: Exception | None = None) -> None:
        self.error = error
        self.runs = 0
        self.before: Callable[[], object] = lambda: None

    def run(self, program: Program, model: str, *_: object) -> RunOutcome:
        self.runs += 1
        self.before()
        if self.error is not None:
            raise self.error
        return RunOutcome(status=RunStatus.OK, value=0, groundings=(NO_HOLE,))
