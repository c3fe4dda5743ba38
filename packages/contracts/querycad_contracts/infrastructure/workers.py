"""What all Celery workers have in common: how they take tasks, say that they live, log, and go on after a crash.

Imported by workers alone: who only sends tasks needs no Celery.
"""

from __future__ import annotations

import gc
from collections.abc import Sequence
from typing import Any

from querycad_contracts import Queue, alive_key

from .logs import start_logging
from .settings import WorkerSettings
from .tracing import start_worker_tracing

ALIVE_S = 10
"""A worker counts as there this long after its last heartbeat; there is one every 2 seconds."""
VISIBILITY_MARGIN_S = 10
"""Redis gives a task to another worker this long after it must have ended; until then two would do the same."""
RESTORE_S = 5
"""Between two looks for tasks that were taken and not done in time."""
REPLY_S = 60
"""Who asked takes the reply at once; one that nobody waits for any more goes away."""
STORE_PAUSE_S = 1.0
"""The longest pause between two tries to reach a store that is away."""


def worker_app(
    name: str,
    settings: WorkerSettings,
    queues: Sequence[Queue],
    *,
    processes: int,
    memory_mib: int,
    longest_s: int,
    store_tries: int,
    missing_walls: Sequence[str] = (),
) -> Any:
    """The Celery application, still without tasks, of a worker on these queues.

    `memory_mib`: size at which a process is replaced once its task is done. `longest_s`: after which every task has
    ended. A task is acknowledged when it is done, so that one whose worker died is done by another. `missing_walls`,
    which the worker does without, are told with every heartbeat.
    """
    from celery import Celery
    from celery.signals import heartbeat_sent, setup_logging, worker_before_create_process
    from kombu import Queue as KombuQueue
    from redis import Redis

    app = Celery(name, broker=settings.redis_url)
    redis = Redis.from_url(settings.redis_url)  # connects when used, in each process anew
    undone = "querycad:" + "+".join(queue.value for queue in queues)
    app.conf.update(
        _taking(undone, longest_s, store_tries),
        task_queues=[KombuQueue(queue.value) for queue in queues],
        worker_concurrency=processes,
        worker_max_memory_per_child=memory_mib * 1024,
    )

    def say_alive(**_: object) -> None:
        for queue in queues:
            redis.set(alive_key(queue), " ".join(missing_walls), ex=ALIVE_S)

    heartbeat_sent.connect(say_alive, weak=False)
    worker_before_create_process.connect(_share_pages, weak=False)
    service = "+".join(sorted(queue.value for queue in queues))
    setup_logging.connect(lambda **_: start_logging(service, settings.log_format), weak=False)
    start_worker_tracing(name.replace("_", "-"), settings.traces)
    if settings.sole_worker:
        app.steps["consumer"].add(_take_over(redis, f"{undone}:unacked_index"))
    return app


def _taking(undone: str, longest_s: int, store_tries: int) -> dict[str, Any]:
    """How are tasks taken, and given back? Settings of Celery; `undone` begins the keys of those that are taken."""
    return {
        "worker_pool": "prefork",
        "worker_prefetch_multiplier": 1,
        "worker_redirect_stdouts": False,
        "worker_cancel_long_running_tasks_on_connection_loss": False,
        "broker_connection_retry_on_startup": True,
        "broker_transport_options": {
            "visibility_timeout": longest_s + VISIBILITY_MARGIN_S,
            # of these queues alone: whoever looks for lost tasks must not give out others' too early
            "unacked_key": f"{undone}:unacked",
            "unacked_index_key": f"{undone}:unacked_index",
            "unacked_mutex_key": f"{undone}:unacked_mutex",
            "unacked_restore_interval": RESTORE_S,
            "unacked_restore_throttle": 1,
        },
        "task_publish_retry_policy": {
            "max_retries": store_tries,
            "interval_start": 0,
            "interval_step": 0.1,
            "interval_max": STORE_PAUSE_S,
        },
        "task_acks_late": True,
        "task_reject_on_worker_lost": True,
        "task_ignore_result": True,
    }


def _share_pages(**_: object) -> None:
    """Keeps the collector from what a fork inherits: its first full pass would copy every page, some 17 MiB each side.

    It comes after minutes of work, and looks like a leak.
    """
    gc.collect()
    gc.freeze()


def _take_over(redis: Any, index: str) -> Any:
    """What a sole worker does each time that it connects: tasks that were taken and not done are due at once.

    Its predecessor may have died with them, or the store while it had them.
    """
    from celery.bootsteps import StartStopStep

    class TakeOver(StartStopStep):  # type: ignore[misc]  # Celery is untyped
        requires = ("celery.worker.consumer.tasks:Tasks",)

        def start(self, _consumer: object) -> None:
            for tag in redis.zrange(index, 0, -1):
                redis.zadd(index, {tag: 0}, xx=True)

    return TakeOver
