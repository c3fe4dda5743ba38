"""Puts on the queue again what was lost on its way.

A message is taken off its queue and noted as taken in two steps; who is killed between them takes it along. So do an
api that dies after it has kept a job, and a store that comes back without its last moment. Every job and every file
that is waited for is therefore looked at again after a while. What is sent twice does no harm: a job is answered once.
"""

from __future__ import annotations

import asyncio
import logging
from uuid import uuid4

from redis.exceptions import RedisError

from querycad_api.dependencies import Application
from querycad_api.problems import ServiceUnavailable
from querycad_contracts import Queue, working_for

LOOK_S = 5.0
"""Between two looks, by whichever api process comes first."""
QUESTION_MARGIN_S = 60.0
"""A question ends this long after its time limit at the latest, its worker's death and replacement included."""

log = logging.getLogger(__name__)


async def redeliver(application: Application) -> None:
    """Looks again and again, until it is cancelled."""
    while True:
        await asyncio.sleep(LOOK_S)
        try:
            if await application.state.turn("sweep", LOOK_S):
                await redeliver_once(application)
        except (RedisError, ServiceUnavailable) as error:
            log.warning("not looked for lost tasks: %s", error)
        except Exception:
            log.exception("not looked for lost tasks")


async def redeliver_once(application: Application) -> None:
    """Sends again what nobody seems to have. Raises RedisError and ServiceUnavailable."""
    state, broker = application.state, application.broker
    _, waiting = await state.totals(Queue.QUESTIONS.value, Queue.INGEST.value)
    longest_s = application.settings.question_s + QUESTION_MARGIN_S
    for task in await state.stalled_jobs(waiting[Queue.QUESTIONS.value] > 0, longest_s):
        with working_for(task.request):
            log.warning("sent again", extra={"job": task.job})
            await broker.questions([task])
    if waiting[Queue.INGEST.value]:
        return
    for tenant, model in await state.stalled_models():
        log.warning("sent again", extra={"model": model.id})
        ingest = uuid4().hex
        await state.reading(tenant, model.id, ingest)
        await broker.ingest(model, tenant, ingest)
