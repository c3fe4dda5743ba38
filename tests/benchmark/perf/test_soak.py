"""What a soak tells of growth."""

from __future__ import annotations

import pytest
from benchmark.perf.soak import slope


def test_what_is_taken_while_a_file_is_read_is_no_growth() -> None:
    samples = [(5.0 * n, {"memory_mib": 300.0 + (100.0 if n % 12 > 2 + n // 60 else 0.0)}) for n in range(240)]
    assert slope(samples, "memory_mib") == 0.0


def test_what_stays_is_growth() -> None:
    samples = [(5.0 * n, {"memory_mib": 300.0 + n // 12 + (100.0 if n % 2 else 0.0)}) for n in range(240)]
    assert slope(samples, "memory_mib") * 3600 == pytest.approx(60.0)


def test_a_run_of_less_than_two_minutes_has_no_slope() -> None:
    assert slope([(1.0, {"handles": 3.0})], "handles") == 0.0
