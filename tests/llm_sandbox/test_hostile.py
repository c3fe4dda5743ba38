"""Programs that mean harm, run by the service as it is deployed: each ends with the status stated, hands nothing out,
and leaves the service as it was."""

from __future__ import annotations

import socket
from pathlib import Path

import pytest
from tests.llm_sandbox.conftest import MODEL, Service
from tests.llm_sandbox.hostile import FAMILIES, LIMITS, OK, hidden

from querycad_contracts import RunStatus

CLAIMS = [(family, code, status) for family, claims in FAMILIES.items() for code, status in claims]
IDS = [f"{family}-{number}-{code[:40]!r}" for number, (family, code, _) in enumerate(CLAIMS)]


@pytest.mark.parametrize(("family", "code", "status"), CLAIMS, ids=IDS)
def test_a_hostile_program_ends_as_stated_and_leaves_the_service_well(
    service: Service, family: str, code: str, status: RunStatus | set[RunStatus]
) -> None:
    outcome = service.run(code, LIMITS)
    assert outcome.status in (status if isinstance(status, set) else {status}), outcome
    assert len(outcome.message) <= 2000
    assert len(outcome.printed.encode()) <= LIMITS.output_bytes
    if outcome.status is not OK:
        assert outcome.value is None
        assert outcome.message
    good = service.run('solution = [p.id for p in find_parts("hole")]')
    assert (good.status, good.value) == (OK, ["hole-1", "hole-2", "hole-3"])


def test_the_families_are_large() -> None:
    assert len({code for _, code, _ in CLAIMS}) == len(CLAIMS) >= 150
    assert all(len(claims) >= 5 for claims in FAMILIES.values())


def test_after_all_of_them_it_is_the_same_process_and_asked_for_one_model(service: Service) -> None:
    assert service.process.poll() is None
    assert service.client.get("/readyz").json()["checks"] == {"broker": True, "interpreter": True, "walls": True}
    service.run("solution = len(find_parts('hole'))")
    assert service.segworker.models == {MODEL}


def test_text_that_is_no_unicode_is_no_request(service: Service) -> None:
    assert service.post("solution = '\ud800'").status_code == 422


def test_a_parts_id_cannot_be_changed_for_the_host(service: Service) -> None:
    code = "p = find_parts('hole')[0]\np.id = 'boss-1'\np.radius = 9.0\nsolution = [p, p.distance_to(p)]"
    assert service.run(code).value == [{"part": "hole-1"}, 0.0]


def test_a_later_run_gets_its_parts_unchanged(service: Service) -> None:
    service.run("for p in find_parts('hole'):\n    p.radius = 9.0\n    p.tags.clear()\nsolution = 1")
    assert service.run("solution = [p.radius for p in find_parts('hole')]").value == [0.0025, 0.0025, 0.005]


@pytest.mark.parametrize(
    "code",
    [
        "import os\nsolution = os.getcwd()",
        "import sys\nsolution = [sys.version, sys.platform, str(sys.argv)]",
        "solution = [__name__, __file__]",
        hidden("solution = str(locals())"),
        hidden("import os\nsolution = str(os.environ)"),
        "solution = str([find_parts, shape, print, find_parts('hole')[0].faces[0]])",
        "solution = find_parts(1)",
    ],
)
def test_what_a_program_can_see_says_nothing_of_the_host(service: Service, code: str) -> None:
    outcome = service.run(code, LIMITS)
    seen = f"{outcome.value} {outcome.message}"
    own = (str(service.process.pid), str(Path.cwd()), str(Path.home()), socket.gethostname())
    for secret in (*own, "site-packages", "querycad_", "hunter2"):
        assert secret not in seen
