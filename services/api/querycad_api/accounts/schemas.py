"""What is known of an account: its keys, what they are for, and who asks by one."""

from __future__ import annotations

from dataclasses import dataclass
from datetime import datetime
from enum import StrEnum

from querycad_contracts import Frozen, Tenant


class Scope(StrEnum):
    """What a key is for: asking about its tenant's models, or reading the whole service's metrics."""

    ASK = "ask"
    METRICS = "metrics"


class ApiKey(Frozen):
    """What is kept of a key."""

    id: str
    tenant: Tenant
    scope: Scope = Scope.ASK
    name: str = ""
    secret_sha256: str
    created: datetime


@dataclass(frozen=True, slots=True)
class Caller:
    """Whose models are meant, and by which key; its id is empty where there are none."""

    tenant: str
    key: str = ""
