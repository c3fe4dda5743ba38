"""Requests to one address: so many at once, and so many in a minute."""

from __future__ import annotations

import threading

import pytest

from querycad_answering.llm.breaker import Gate, gate_of
from querycad_answering.llm.messages import LlmTooSlow, TimeLimit


class Clock:
    def __init__(self) -> None:
        self.now = 0.0
        self.slept: list[float] = []

    def __call__(self) -> float:
        return self.now

    def sleep(self, seconds: float) -> None:
        self.slept.append(seconds)
        self.now += seconds


def test_no_more_than_so_many_are_under_way_at_once() -> None:
    gate, most, inside, lock = Gate(2, 0), 0, 0, threading.Lock()
    go = threading.Event()

    def ask() -> None:
        nonlocal most, inside
        with gate.passed(TimeLimit(30)):
            with lock:
                inside += 1
                most = max(most, inside)
                if inside == 2:
                    go.set()
            go.wait(30)
            with lock:
                inside -= 1

    threads = [threading.Thread(target=ask) for _ in range(6)]
    for thread in threads:
        thread.start()
    for thread in threads:
        thread.join(60)
    assert (most, inside) == (2, 0)


def test_who_finds_no_place_in_time_is_told_and_the_place_is_free_again_after_an_error() -> None:
    gate = Gate(1, 0)
    with gate.passed(TimeLimit(10)), pytest.raises(LlmTooSlow), gate.passed(TimeLimit(0.05)):
        raise AssertionError("two at once")
    with pytest.raises(ZeroDivisionError), gate.passed(TimeLimit(10)):
        raise ZeroDivisionError
    with gate.passed(TimeLimit(10)):
        pass


def test_the_third_in_a_minute_of_two_waits_until_the_first_is_a_minute_old() -> None:
    clock = Clock()
    gate = Gate(4, 2, clock, clock.sleep)
    for _ in range(2):
        with gate.passed(TimeLimit(300, clock)):
            clock.now += 10
    with gate.passed(TimeLimit(300, clock)):
        assert (clock.slept, clock.now) == ([40.0], 60.0)
    with pytest.raises(LlmTooSlow, match="2 times a minute"), gate.passed(TimeLimit(5, clock)):
        raise AssertionError("three in a minute")


def test_all_who_ask_at_one_address_share_a_gate() -> None:
    assert gate_of("http://a/v1", 4, 0) is gate_of("http://a/v1", 4, 0)
    assert gate_of("http://a/v1", 4, 0) is not gate_of("http://b/v1", 4, 0)
