"""Source text that nobody wrote: whatever it is, there is an outcome, and the next program runs."""

from __future__ import annotations

import keyword

from hypothesis import HealthCheck, given, settings
from hypothesis import strategies as st
from tests.llm_sandbox.conftest import FakePartFinder
from tests.llm_sandbox.hostile import FAMILIES

from querycad_contracts import RunLimits, RunStatus
from querycad_sandbox import Sandbox

LIMITS = RunLimits(duration_s=0.1, memory_bytes=2**24, host_calls=50, output_bytes=200)
ENDS = set(RunStatus) - {RunStatus.CRASHED, RunStatus.CANCELLED}
EXAMPLES = 120
"""Of each kind: some ten seconds on one core. More are found by raising it."""
GOOD = "parts = find_parts('hole', sides=['top'])\nsolution = [p.radius for p in parts if p.depth > 0.001]"
CLAIMS = [claim for claims in FAMILIES.values() for claim in claims]
HARMLESS = [code for code, status in CLAIMS if len(code) < 400 and status is not RunStatus.TIMED_OUT]
SIGNS = "( ) [ ] { } : , . = == + - * ** / // % @ | & ~ < > := -> ' \" \\ # 0 1 1e9 1_0 x y f'{ }' 'hole'"
NAMES = "find_parts shape solution print __class__ lambda len"

words = st.sampled_from([*keyword.kwlist, *SIGNS.split(), *NAMES.split(), "\n", "\n    "])
fuzzed = settings(
    max_examples=EXAMPLES, deadline=None, derandomize=True, suppress_health_check=list(HealthCheck), database=None
)


def runs(sandbox: Sandbox, code: str) -> None:
    outcome = sandbox.run(code, FakePartFinder(), LIMITS)
    assert outcome.status in ENDS, outcome
    assert bool(outcome.message) == (outcome.status is not RunStatus.OK)
    good = sandbox.run(GOOD, FakePartFinder())
    assert (good.status, good.value) == (RunStatus.OK, [0.0025, 0.0025, 0.005])


@fuzzed
@given(st.text(max_size=300))
def test_any_text_has_an_outcome(sandbox: Sandbox, code: str) -> None:
    runs(sandbox, code)


@fuzzed
@given(st.lists(words, max_size=60).map(" ".join))
def test_any_row_of_words_has_an_outcome(sandbox: Sandbox, code: str) -> None:
    runs(sandbox, code)


@fuzzed
@given(st.sampled_from([GOOD, *HARMLESS]), st.integers(0, 400), st.integers(0, 20), st.text(max_size=8) | words)
def test_any_change_of_a_program_has_an_outcome(sandbox: Sandbox, code: str, at: int, cut: int, put: str) -> None:
    runs(sandbox, code[:at] + put + code[at + cut :])


@fuzzed
@given(st.sampled_from(HARMLESS), st.sampled_from(HARMLESS), st.integers(0, 400))
def test_any_two_halves_of_programs_have_an_outcome(sandbox: Sandbox, first: str, second: str, at: int) -> None:
    runs(sandbox, first[:at] + second[at:])
