"""One runtime in the test's own process for all tests of a module."""

from __future__ import annotations

from collections.abc import Iterator

import pytest

from querycad import EmbeddedRuntime


@pytest.fixture(scope="module")
def runtime(tmp_path_factory: pytest.TempPathFactory) -> Iterator[EmbeddedRuntime]:
    with EmbeddedRuntime(tmp_path_factory.mktemp("models")) as made:
        yield made
