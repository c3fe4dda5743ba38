"""Programs that keep the model's objects: what they hold outside the interpreter counts, too."""

from __future__ import annotations

from collections.abc import Sequence

from tests.llm_sandbox.conftest import FakePartFinder, make_part

from querycad_contracts import Grounding, PartQuery, RunLimits, RunStatus, Side
from querycad_sandbox.sandbox import HOST_SHARE, Sandbox


class LargePartFinder(FakePartFinder):
    """A model of very many parts, all of which every phrase means."""

    def __init__(self, parts: int) -> None:
        super().__init__()
        self.many = tuple(make_part(f"hole-{i}", **FIRST) for i in range(parts))

    def find_parts(self, description: str | PartQuery, sides: Sequence[Side] | None = None) -> Grounding:
        self.calls.append(("find_parts", description))
        return Grounding(description="hole", sides=None, parts=self.many, understood=True)


FIRST = FakePartFinder().parts()[0].model_dump(exclude={"id", "evidence"})


def test_parts_that_a_program_asks_for_again_and_again_count_towards_its_memory() -> None:
    finder = LargePartFinder(500)
    limits = RunLimits(memory_bytes=4 * 2**20)
    code = "solution = 0\nfor i in range(90):\n    solution = solution + len(find_parts('hole ' + str(i)))"
    with Sandbox(workers=1) as sandbox:
        outcome = sandbox.run(code, finder, limits)
        assert outcome.status is RunStatus.OUT_OF_MEMORY
        assert len(finder.calls) <= HOST_SHARE * limits.memory_bytes // (500 * 6000) + 1
        assert len(outcome.model_dump_json()) < HOST_SHARE * limits.memory_bytes
        assert sandbox.run("solution = len(find_parts('hole'))", finder, limits).value == 500


def test_a_function_is_no_value() -> None:
    with Sandbox(workers=1) as sandbox:
        for code in (
            "solution = len",
            "solution = find_parts",
            "def f():\n    return 1\nsolution = f",
            "solution = [len]",
        ):
            assert sandbox.run(code, FakePartFinder(), check=False).status is RunStatus.REFUSED
