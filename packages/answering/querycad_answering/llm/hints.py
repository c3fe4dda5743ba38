"""From what a check or a run said to what helps a writer to repair it: which name was meant, what a list is.

The patterns read the interpreter and its type checker, which say in words alone what is wrong.
"""

from __future__ import annotations

import re

from querycad_contracts import MissingAttribute
from querycad_contracts.guest_names import meant_attribute, meant_function

from .reference import attributes, functions

_MISSING = re.compile(r"(?:Object of type|Type) `(?:list\[)?(\w+)\]?` has no attribute `(\w+)`")
_OF_LIST = re.compile(r"`(?:list\[(\w+)\]|Parts)` has no attribute `(\w+)`")
_UNKNOWN = re.compile(r"[Nn]ame `?'?(\w+)'?`? (?:used when not defined|is not defined)")
_ARGUMENT = re.compile(r"Argument `(\w+)` does not match any known parameter")
_EMPTY = re.compile(r"IndexError|argument is empty|empty sequence|StopIteration")


def hint(message: str, lacking: MissingAttribute | None = None) -> str:
    """What can be said about the message, in sentences; empty when nothing more is known.

    `lacking` is the measure for want of which a program ended.
    """
    said: list[str] = []
    if of_list := _OF_LIST.search(message):
        kind, name = of_list.group(1) or "Part", of_list.group(2)
        said.append(f"find_parts returns a list: write [p.{name} for p in parts] for every {kind}.")
        message = message.replace(of_list.group(0), f"Object of type `{kind}` has no attribute `{name}`", 1)
    said += [_attribute(kind, name) for kind, name in _MISSING.findall(message)]
    if lacking is not None and lacking.attribute not in attributes()["Part"]:
        said.append(_attribute("Part", lacking.attribute))
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
    nearest = meant_attribute(kind, name)
    meant = f" Instead of .{name} use .{nearest}." if nearest else ""
    return f"There is no .{name}; a {kind} has {', '.join(known)}.{meant}"


def _function(name: str) -> str:
    nearest = meant_function(name)
    meant = f" Instead of {name} use {nearest}." if nearest else ""
    return f"Only these names exist: {', '.join(functions())}.{meant}"
