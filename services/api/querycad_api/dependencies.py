"""What endpoints are given: state, queues, settings, and the wait that the client prefers."""

from __future__ import annotations

import re
from dataclasses import dataclass
from typing import Annotated, cast

from fastapi import Depends, Header, Request

from querycad_contracts import ModelResource

from .broker import Broker
from .problems import ModelNotFound
from .settings import ApiSettings
from .state import State

_WAIT = re.compile(r"(?:^|[,;\s])wait\s*=\s*(\d{1,6})\b")


@dataclass(frozen=True, slots=True)
class Services:
    """What every endpoint may need."""

    settings: ApiSettings
    state: State
    broker: Broker

    async def model(self, model: str) -> ModelResource:
        """The uploaded model. Raises ModelNotFound."""
        found = await self.state.model(model)
        if found is None:
            raise ModelNotFound("there is no model with this id; upload its file first")
        return found


def services(request: Request) -> Services:
    """The application's services."""
    return cast("Services", request.app.state.services)


ServicesDep = Annotated[Services, Depends(services)]


def preferred_wait_s(
    given: ServicesDep,
    prefer: Annotated[
        str | None,
        Header(description="`wait=N`: answer within N seconds (RFC 7240).", examples=["wait=10"]),
    ] = None,
) -> int:
    """How long does the client want to wait, as far as it is granted? 0 when it did not say."""
    wanted = _WAIT.search(prefer or "")
    return min(int(wanted[1]), given.settings.wait_s) if wanted else 0


WaitDep = Annotated[int, Depends(preferred_wait_s)]
