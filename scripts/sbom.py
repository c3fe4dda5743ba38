"""Writes what the product is made of as CycloneDX 1.6 JSON to standard output: `make sbom`, and part of `make dist`.

The components are those of the environment that requirements.lock pins, and what the page is built from, by
web/package-lock.json. What the product needs at run time, its extras included, is `required`; what only builds, tests
and measures it is `excluded`. The same environment gives the same text.
"""

from __future__ import annotations

import base64
import json
import sys
from collections.abc import Iterator
from importlib import metadata
from pathlib import Path
from typing import Any

from packaging.requirements import Requirement
from packaging.utils import canonicalize_name

ROOT = Path(__file__).parents[1]
PRODUCT = "querycad"
LONGEST_LICENSE = 100
"""Some packages put the whole text there; it is in their wheel."""

Installed = dict[str, metadata.Distribution]


def needs(distribution: metadata.Distribution, extras: frozenset[str], installed: Installed) -> Iterator[Requirement]:
    """What is installed of it that the distribution needs here, with these extras."""
    for line in distribution.requires or ():
        wanted = Requirement(line)
        marker = wanted.marker
        if marker is None or any(marker.evaluate({"extra": extra}) for extra in ("", *extras)):
            if canonicalize_name(wanted.name) in installed:
                yield wanted


def needed_by(product: str, installed: Installed) -> dict[str, set[str]]:
    """What the product needs at run time, however indirectly, by name, and which names each of these needs itself."""
    extras = frozenset(installed[product].metadata.get_all("Provides-Extra") or ())
    waiting, graph, seen = [(product, extras)], dict[str, set[str]](), set[tuple[str, frozenset[str]]]()
    while waiting:
        name, extras = one = waiting.pop()
        if one in seen:
            continue
        seen.add(one)
        for wanted in needs(installed[name], extras, installed):
            other = canonicalize_name(wanted.name)
            graph.setdefault(name, set()).add(other)
            waiting.append((other, frozenset(wanted.extras)))
        graph.setdefault(name, set())
    return graph


def python_component(name: str, distribution: metadata.Distribution, required: bool) -> dict[str, Any]:
    """One package of the environment."""
    purl = f"pkg:pypi/{name}@{distribution.version}"
    about = distribution.metadata
    found: dict[str, Any] = {
        "type": "library",
        "bom-ref": purl,
        "name": name,
        "version": distribution.version,
        "purl": purl,
        "scope": "required" if required else "excluded",
    }
    if expression := about.get("License-Expression"):
        return {**found, "licenses": [{"expression": expression}]}
    named = (about.get("License") or "").strip()
    if not 0 < len(named) <= LONGEST_LICENSE or "\n" in named:
        classified = [each for each in about.get_all("Classifier") or () if each.startswith("License :: ")]
        named = classified[0].rpartition(" :: ")[2] if classified else ""
    return {**found, "licenses": [{"license": {"name": named}}]} if named else found


def page_components() -> Iterator[dict[str, Any]]:
    """What web/package-lock.json pins, with its hashes; what only tests the page is excluded."""
    lock = json.loads((ROOT / "web/package-lock.json").read_text(encoding="utf-8"))
    for place, package in lock["packages"].items():
        if not place:
            continue
        name = place.rpartition("node_modules/")[2]
        purl = f"pkg:npm/{name.replace('@', '%40')}@{package['version']}"
        algorithm, _, digest = package.get("integrity", "").partition("-")
        yield {
            "type": "library",
            "bom-ref": f"{purl}#{place}",
            "name": name,
            "version": package["version"],
            "purl": purl,
            "scope": "excluded" if package.get("dev") else "optional" if package.get("optional") else "required",
            **({"licenses": [{"expression": package["license"]}]} if "license" in package else {}),
            **({"hashes": [{"alg": "SHA-512", "content": _hex(digest)}]} if algorithm == "sha512" else {}),
        }


def _hex(digest: str) -> str:
    return base64.b64decode(digest).hex()


def sbom() -> dict[str, Any]:
    """The whole bill of materials."""
    installed = {canonicalize_name(each.name): each for each in metadata.distributions()}
    graph = needed_by(PRODUCT, installed)
    components = {name: python_component(name, installed[name], name in graph) for name in sorted(installed)}
    product = components.pop(PRODUCT)
    refs = {name: str(one["bom-ref"]) for name, one in {PRODUCT: product, **components}.items()}
    return {
        "bomFormat": "CycloneDX",
        "specVersion": "1.6",
        "version": 1,
        "metadata": {"component": {**product, "type": "application"}},
        "components": [*components.values(), *page_components()],
        "dependencies": [
            {"ref": refs[name], "dependsOn": sorted(refs[each] for each in others)}
            for name, others in sorted(graph.items())
        ],
    }


if __name__ == "__main__":
    sys.stdout.write(json.dumps(sbom(), indent=1) + "\n")
