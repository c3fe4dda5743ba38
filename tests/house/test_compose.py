"""docker-compose.yml and the Dockerfiles: the processes of `querycad serve`, each shut in as far as it can be."""

from __future__ import annotations

import importlib.util
import re
import subprocess
import sys
import tomllib
from pathlib import Path
from typing import Any

import pytest
import yaml

from querycad.serve import Ports, commands
from querycad_answering.llm.settings import LlmSettings
from querycad_api.settings import ApiSettings
from querycad_contracts.infrastructure import Settings
from querycad_sandbox.settings import SandboxSettings
from querycad_segworker.settings import SegworkerSettings

ROOT = Path(__file__).parents[2]
COMPOSE: dict[str, Any] = yaml.safe_load((ROOT / "docker-compose.yml").read_text(encoding="utf-8"))
SERVICES: dict[str, dict[str, Any]] = COMPOSE["services"]
OWN = {name: service for name, service in SERVICES.items() if "build" in service}
DOCKERFILES = sorted(ROOT.glob("services/*/Dockerfile"))
SETTINGS: dict[str, type[Settings]] = {
    "querycad_api": ApiSettings,
    "querycad_sandbox": SandboxSettings,
    "querycad_segworker": SegworkerSettings,
}

Instruction = tuple[str, str]


def instructions(dockerfile: Path) -> list[Instruction]:
    """The file's instructions and their arguments, comments left out and continued lines joined."""
    lines = [line for line in dockerfile.read_text(encoding="utf-8").splitlines() if not line.lstrip().startswith("#")]
    whole = "\n".join(lines).replace("\\\n", " ")
    return [(name, rest.strip()) for name, _, rest in (line.partition(" ") for line in whole.splitlines() if line)]


def runtime(dockerfile: Path) -> list[Instruction]:
    """The instructions of the last stage, its FROM first."""
    found = instructions(dockerfile)
    last = max(number for number, (name, _) in enumerate(found) if name == "FROM")
    return found[last:]


def module(service: dict[str, Any]) -> str:
    """Which module does the service's command run?"""
    python, flag, name = service["command"]
    assert (python, flag) == ("python", "-m")
    return str(name)


def settings(service: dict[str, Any]) -> type[Settings]:
    return SETTINGS[module(service).partition(".")[0]]


def dockerfile(service: dict[str, Any]) -> Path:
    build: dict[str, str] = service["build"]
    return ROOT / build["context"] / build["dockerfile"]


def packages_of(folder: Path) -> dict[str, str]:
    """The packages of ours that a service is made of: their names, and the folders that they lie in."""
    found: dict[str, str] = {}
    waiting = [folder]
    while waiting:
        said = tomllib.loads((waiting[0] / "pyproject.toml").read_text(encoding="utf-8"))
        (name,) = said["tool"]["hatch"]["build"]["targets"]["wheel"]["packages"]
        found[name] = str(waiting.pop(0).relative_to(ROOT))
        ours = [each for each in said["project"]["dependencies"] if each.startswith("querycad-")]
        waiting += [ROOT / "packages" / each.removeprefix("querycad-") for each in ours]
    return found


def has_health_check(name: str) -> bool:
    service = SERVICES[name]
    return "healthcheck" in service or any(each == "HEALTHCHECK" for each, _ in runtime(dockerfile(service)))


def test_it_has_the_processes_of_querycad_serve() -> None:
    served = commands(Path("/data"), Ports(8000, 8101, 6379), 1, "password", {})[1:]  # but for the store
    assert sorted(command.arguments[-1] for command in served) == sorted(map(module, OWN.values()))
    queues = {
        command.environment["QUERYCAD_SEGWORKER_QUEUES"]
        for command in served
        if "QUERYCAD_SEGWORKER_QUEUES" in command.environment
    }
    assert queues == {
        service["environment"]["QUERYCAD_SEGWORKER_QUEUES"]
        for service in OWN.values()
        if settings(service) is SegworkerSettings
    }


def test_the_file_is_as_the_compose_specification_has_it() -> None:
    checker = Path(sys.executable).with_name("check-jsonschema")
    command = [str(checker), "--builtin-schema", "vendor.compose-spec", str(ROOT / "docker-compose.yml")]
    done = subprocess.run(command, capture_output=True, text=True, check=False)
    assert done.returncode == 0, done.stdout + done.stderr


@pytest.mark.parametrize("path", DOCKERFILES, ids=lambda path: path.parent.name)
def test_a_dockerfile_has_no_fault_that_the_linter_knows(path: Path) -> None:
    command = [str(Path(sys.executable).with_name("hadolint")), "--no-color", str(path)]
    done = subprocess.run(command, capture_output=True, text=True, check=False)
    assert done.returncode == 0, done.stdout + done.stderr


def test_it_sets_what_querycad_serve_sets_but_that_a_worker_is_the_only_one() -> None:
    served = commands(Path("/data"), Ports(8000, 8101, 6379), 1, "password", {})
    set_there = {name for command in served for name in command.environment if name.startswith("QUERYCAD_")}
    set_here = {name for service in OWN.values() for name in service["environment"]}
    assert set_here == set_there - {"QUERYCAD_SOLE_WORKER"} | {"QUERYCAD_LOG_FORMAT"}


@pytest.mark.parametrize("name", OWN)
def test_a_command_names_a_module_that_exists(name: str) -> None:
    assert importlib.util.find_spec(module(OWN[name])) is not None


@pytest.mark.parametrize("name", OWN)
def test_a_service_is_given_only_settings_that_it_reads_and_values_that_they_take(name: str) -> None:
    service = OWN[name]
    kind = settings(service)
    environment = service["environment"]
    assert environment.keys() <= {kind.variable(field) for field in kind.model_fields}
    kind.read(environment)


def test_the_images_set_only_settings_that_their_service_reads() -> None:
    for service in OWN.values():
        kind = settings(service)
        for name, rest in instructions(dockerfile(service)):
            if name == "ENV":
                used = set(re.findall(r"\b(QUERYCAD_\w+)=", rest))
                assert used <= {kind.variable(field) for field in kind.model_fields}


def test_a_health_check_asks_for_the_worker_of_the_services_own_queues() -> None:
    for service in OWN.values():
        if "healthcheck" in service:
            queues = service["environment"].get("QUERYCAD_SEGWORKER_QUEUES", "questions")
            node = "+".join(sorted(queues.split(",")))
            assert f'--destination "{node}@$$(hostname)"' in service["healthcheck"]["test"][1]


@pytest.mark.parametrize("name", SERVICES)
def test_every_container_has_a_health_check(name: str) -> None:
    assert has_health_check(name)


@pytest.mark.parametrize("name", SERVICES)
def test_every_container_is_shut_in(name: str) -> None:
    service = SERVICES[name]
    assert service["read_only"] is True
    assert service["mem_limit"]
    assert 0 < service["pids_limit"] <= 512
    assert service["logging"]["options"].keys() == {"max-size", "max-file"}
    assert all(re.fullmatch(r"/tmp:size=\d+m,mode=1777", each) for each in service["tmpfs"])  # noqa: S108
    assert service["cap_drop"] == ["ALL"]
    assert "cap_add" not in service
    assert "privileged" not in service
    assert service["security_opt"] == ["no-new-privileges:true"]
    assert all(Path(volume.partition(":")[0]).name in COMPOSE["volumes"] for volume in service.get("volumes", []))


@pytest.mark.parametrize("name", SERVICES)
def test_only_the_api_is_on_a_network_with_a_way_out(name: str) -> None:
    networks = SERVICES[name]["networks"]
    assert networks
    open_ones = [each for each in networks if not COMPOSE["networks"][each].get("internal")]
    assert bool(open_ones) == (name == "api")
    assert ("ports" in SERVICES[name]) == (name == "api")
    assert "network_mode" not in SERVICES[name]


def test_the_api_is_published_to_this_machine_alone() -> None:
    (port,) = SERVICES["api"]["ports"]
    assert port == f"127.0.0.1:8000:{SERVICES['api']['environment']['QUERYCAD_API_PORT']}"


def test_addresses_name_a_service_that_is_there_and_its_port() -> None:
    sandbox = SERVICES["sandbox"]["environment"]["QUERYCAD_SANDBOX_PORT"]
    for service in OWN.values():
        environment = service["environment"]
        assert environment.get("QUERYCAD_SANDBOX_URL", f"http://sandbox:{sandbox}") == f"http://sandbox:{sandbox}"
        assert environment["QUERYCAD_REDIS_URL"].endswith("@redis:6379/0")
        assert service["depends_on"]["redis"] == {"condition": "service_healthy"}


def test_no_password_has_a_default_and_the_example_names_each() -> None:
    text = (ROOT / "docker-compose.yml").read_text(encoding="utf-8")
    uses = re.findall(r"(?<!\$)\$\{?(?:REDIS_\w*PASSWORD|SANDBOX_TOKEN)[^}]*\}?", text)
    assert len(uses) >= 2 * 5 - 1  # each of a service by the store and by the service
    assert all(re.match(r"\$\{(?:REDIS_\w*PASSWORD|SANDBOX_TOKEN):\?", use) for use in uses)
    example = (ROOT / ".env.example").read_text(encoding="utf-8")
    assert sorted({use[2:].partition(":")[0] for use in uses}) == sorted(
        re.findall(r"^((?:REDIS|SANDBOX)_\w+)=$", example, re.M)
    )
    optional = set(re.findall(r"^#(\w+)=", example, re.M))
    beside = (ROOT / "docker-compose.llm.yml").read_text(encoding="utf-8")
    assert {f"${{{name}" in text + beside or f"{name}:" in beside for name in optional} == {True}


def test_the_example_of_settings_makes_passwords_as_it_says() -> None:
    text = (ROOT / ".env.example").read_text(encoding="utf-8")
    (command,) = re.findall(r"^#   (sed .*) > \.env$", text, re.M)
    made = subprocess.run(["sh", "-c", command], cwd=ROOT, capture_output=True, text=True, check=True).stdout
    passwords = re.findall(r"^(?:REDIS|SANDBOX)_\w+=([0-9a-f]{48})$", made, re.M)
    assert len(set(passwords)) == 6


def test_every_service_is_a_user_of_the_store_with_a_password_of_its_own() -> None:
    users = {
        name: re.findall(r"redis://(\w+):\$\{REDIS_(\w+)_PASSWORD", OWN[name]["environment"]["QUERYCAD_REDIS_URL"])
        for name in OWN
    }
    assert all(found == [(found[0][0], found[0][0].upper())] for found in users.values())
    known = re.findall(r'"user (\w+) on >\$\$REDIS_(\w+)_PASSWORD', SERVICES["redis"]["command"][-1])
    assert {user for user, _ in known} == {found[0][0] for found in users.values()}
    assert all(name == user.upper() for user, name in known)


def test_images_have_the_version_as_their_tag() -> None:
    version = (ROOT / "VERSION").read_text(encoding="utf-8").strip()
    for service in OWN.values():
        assert service["image"].endswith(f":${{QUERYCAD_VERSION:-{version}}}")


def test_networks_join_only_who_must_reach_whom() -> None:
    members = {
        network: {name for name, service in SERVICES.items() if network in service["networks"]}
        for network in COMPOSE["networks"]
    }
    assert members["queue"] == set(SERVICES)  # all need the store
    assert members["programs"] == {"api", "questions", "sandbox"}
    assert members["outside"] == {"api"}


def test_the_store_keeps_its_data_in_a_volume_and_the_files_are_shared() -> None:
    assert SERVICES["redis"]["user"] == "valkey"  # the image starts as root otherwise
    assert SERVICES["redis"]["volumes"] == ["store:/data"]
    assert "--dir /data --appendonly yes" in SERVICES["redis"]["command"][-1]
    homes = {name for name, service in OWN.items() if "QUERYCAD_HOME" in service["environment"]}
    assert homes == {"api", "ingest", "segworker", "pictures"}
    assert all(f"files:{OWN[name]['environment']['QUERYCAD_HOME']}" in OWN[name]["volumes"] for name in homes)


def test_what_may_be_scaled_has_no_name_or_port_of_its_own() -> None:
    for name in ("questions", "ingest", "segworker", "pictures", "sandbox"):
        assert not {"container_name", "hostname", "ports"} & SERVICES[name].keys()


def test_an_image_that_is_taken_as_it_is_is_pinned() -> None:
    taken = [service["image"] for service in SERVICES.values() if "build" not in service]
    assert taken
    assert all(re.fullmatch(r"[a-z/]+:\d+\.\d+\.\d+-\w+", image) for image in taken)


def test_every_dockerfile_is_used() -> None:
    assert sorted({dockerfile(service) for service in OWN.values()}) == DOCKERFILES
    assert len(DOCKERFILES) == 3


@pytest.mark.parametrize("path", DOCKERFILES, ids=lambda path: path.parent.name)
def test_an_image_pins_its_base_and_ends_without_root(path: Path) -> None:
    bases = [rest for name, rest in instructions(path) if name == "FROM"]
    assert len(bases) == (3 if path.parent.name == "api" else 2)  # the page is built in a stage of its own
    assert {base.partition(" AS ")[0] for base in bases} == {"python:3.11.14-slim-bookworm"}
    users = [rest for name, rest in runtime(path) if name == "USER"]
    assert users == ["10001"]  # by number, so that the engine can tell that it is not root


@pytest.mark.parametrize("path", DOCKERFILES, ids=lambda path: path.parent.name)
def test_an_image_copies_what_exists_and_is_let_through(path: Path) -> None:
    let_through = (ROOT / ".dockerignore").read_text(encoding="utf-8").splitlines()
    copied = [rest.split()[:-1] for name, rest in instructions(path) if name == "COPY" and "--from=" not in rest]
    assert copied
    for source in (each for sources in copied for each in sources):
        assert (ROOT / source).exists()
        assert f"!{Path(source).parts[0]}" in let_through
    assert let_through[0] == "*"


@pytest.mark.parametrize("path", DOCKERFILES, ids=lambda path: path.parent.name)
def test_an_image_has_the_service_and_what_it_needs_of_ours_after_all_that_is_installed(
    path: Path,
) -> None:
    stage = runtime(path)
    sources = [
        number
        for number, (name, rest) in enumerate(stage)
        if name == "COPY" and "/app/" in rest and "--from=page" not in rest
    ]
    own = packages_of(path.parent)
    assert {stage[number][1].split()[-1] for number in sources} == {f"/app/{name}" for name in own}
    (said,) = (rest for name, rest in instructions(path) if name == "RUN" and "> direct.in" in rest)
    projects = {f"{folder}/pyproject.toml" for folder in own.values()}
    assert set(re.findall(r"[a-z_/]+/pyproject\.toml", said)) == projects
    assert all(name != "RUN" for name, _ in stage[min(sources) :])


@pytest.mark.parametrize("path", DOCKERFILES, ids=lambda path: path.parent.name)
def test_an_image_starts_what_one_of_its_services_runs(path: Path) -> None:
    (command,) = (yaml.safe_load(rest) for name, rest in runtime(path) if name == "CMD")
    assert command in [service["command"] for service in OWN.values() if dockerfile(service) == path]


@pytest.mark.parametrize("path", DOCKERFILES, ids=lambda path: path.parent.name)
def test_all_that_is_installed_from_the_lock_is_checked_by_its_hash(path: Path) -> None:
    installs = [
        part for name, rest in instructions(path) if name == "RUN" for part in rest.split("&&") if "pip install" in part
    ]
    assert len(installs) == (3 if path.parent.name == "api" else 2)
    assert all("--require-hashes" in part and "--only-binary :all:" in part for part in installs)


def test_the_cad_kernels_system_libraries_are_in_the_segworkers_image_alone() -> None:
    for path in DOCKERFILES:
        installed = [rest for name, rest in runtime(path) if name == "RUN" and "apt-get install" in rest]
        if path.parent.name == "segworker":
            assert [word for word in installed[0].split() if word.startswith("lib")] == [
                "libgl1",
                "libegl1",
                "libgl1-mesa-dri",
            ]
        else:
            assert installed == []


def test_the_page_is_built_without_what_only_tests_need_and_no_node_is_in_the_image_that_serves_it() -> None:
    path = ROOT / "services/api/Dockerfile"
    assert ("RUN", "PYTHON=python scripts/page.sh --no-tests") in instructions(path)
    copied = [rest for name, rest in runtime(path) if name == "COPY" and "--from=page" in rest]
    dist = "querycad_api/web/dist"
    assert copied == [f"--from=page /build/services/api/{dist} /app/{dist}"]
    assert all("node" not in rest for _, rest in runtime(path))


def test_no_address_of_a_package_registry_is_named() -> None:
    for path in [*DOCKERFILES, ROOT / "docker-compose.yml"]:
        hosts = re.findall(r"https?://([\w.-]+)", path.read_text(encoding="utf-8"))
        assert set(hosts) <= {"127.0.0.1", *SERVICES}
        assert "--index" not in path.read_text(encoding="utf-8")


def test_a_language_model_opens_the_question_worker_alone_and_gives_it_settings_that_are_read() -> None:
    beside = yaml.safe_load((ROOT / "docker-compose.llm.yml").read_text(encoding="utf-8"))
    assert beside["services"].keys() == {"questions"}
    added = beside["services"]["questions"]
    assert added["networks"] == [*OWN["questions"]["networks"], "outside"]
    assert added["environment"].keys() <= {LlmSettings.variable(field) for field in LlmSettings.model_fields}
