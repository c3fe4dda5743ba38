"""From what a check or a run said to what helps a writer to repair it: which name was meant, what a list is."""

from __future__ import annotations

import difflib
import re

from .files import prompt_data
from .reference import attributes, functions

_MISSING = re.compile(r"(?:Object of type|Type) `(?:list\[)?(\w+)\]?` has no attribute `(\w+)`")
_OF_LIST = re.compile(r"`(?:list\[(\w+)\]|Parts)` has no attribute `(\w+)`")
_UNKNOWN = re.compile(r"[Nn]ame `?'?(\w+)'?`? (?:used when not defined|is not defined)")
_ARGUMENT = re.compile(r"Argument `(\w+)` does not match any known parameter")
_NO_MEASURE = re.compile(r"has no (\w+); it has ")
_EMPTY = re.compile(r"IndexError|argument is empty|empty sequence|StopIteration")


def hint(message: str) -> str:
    """What can be said about the message, in sentences; empty when nothing more is known."""
    said: list[str] = []
    if of_list := _OF_LIST.search(message):
        kind, name = of_list.group(1) or "Part", of_list.group(2)
        said.append(f"find_parts returns a list: write [p.{name} for p in parts] for every {kind}.")
        message = message.replace(of_list.group(0), f"Object of type `{kind}` has no attribute `{name}`", 1)
    said += [_attribute(kind, name) for kind, name in _MISSING.findall(message)]
    said += [_attribute("Part", name) for name in _NO_MEASURE.findall(message) if name not in attributes()["Part"]]
    said += [_function(name) for name in _UNKNOWN.findall(message)]
    if _ARGUMENT.search(message):
        said.append('The arguments are a description and a list of sides: find_parts("hole", sides=["top"]).')
    if _EMPTY.search(message):
        said.append("A list was empty: find_parts found no such part there, or a condition held for none.")
    return " ".join(dict.fromkeys(filter(None, said)))


def _attribute(kind: str, name: str) -> str:
    known = attributes().get(kind, ())
    if not known or name in known:
        return ""
    nearest = [
        called for called, others in _names()["attributes"].items() if name.lower() in others and called in known
    ]
    nearest += difflib.get_close_matches(name, known, n=2, cutoff=0.6)
    meant = f" Instead of .{name} use .{nearest[0]}." if nearest else ""
    return f"There is no .{name}; a {kind} has {', '.join(known)}.{meant}"


def _function(name: str) -> str:
    nearest = [called for called, others in _names()["functions"].items() if name.lower() in others]
    nearest += difflib.get_close_matches(name, functions(), n=1, cutoff=0.6)
    meant = f" Instead of {name} use {nearest[0]}." if nearest else ""
    return f"Only these names exist: {', '.join(functions())}.{meant}"


def _names() -> dict[str, dict[str, list[str]]]:
    names: dict[str, dict[str, list[str]]] = prompt_data("words.toml")
    return names
