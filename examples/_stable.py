"""How does a STEP file with colours become the same bytes each time?

The exporter writes them in the order of memory addresses; here they are put in the order of their content.
"""

from __future__ import annotations

import re
from functools import cache

STYLE = "MECHANICAL_DESIGN_GEOMETRIC_PRESENTATION_REPRESENTATION"
ENTITY = re.compile(r"^#(\d+) = (.*?);\n", re.MULTILINE | re.DOTALL)
REFERENCE = re.compile(r"#(\d+)")
ITEMS = re.compile(r"\((?:#\d+,?)+\)")


def sort_styles(step: str) -> str:
    """Which text does the file have once its presentation entities, the last of the data section, are sorted?

    The items of a representation are a SET (ISO 10303-43), so that their order means nothing. A file without colours
    comes back as it is.
    """
    entities = {int(number): re.sub(r"\n\s*", "", body) for number, body in ENTITY.findall(step)}
    roots = [number for number, body in entities.items() if body.startswith(STYLE)]
    if not roots:
        return step
    first = min(roots)

    @cache
    def content(number: int) -> str:
        """The entity with its references written out, down to the geometry, whose order is fixed already."""
        if number < first:
            return f"#{number}"
        if number in roots:
            return "".join(sorted(content(int(item)) for item in REFERENCE.findall(entities[number])))
        return REFERENCE.sub(lambda match: content(int(match[1])), entities[number])

    numbers: dict[int, int] = {}
    lines: list[tuple[int, str]] = []

    def emit(number: int) -> int:
        if number < first:
            return number
        if number not in numbers:
            numbers[number] = first + len(numbers)
            lines.append((numbers[number], ""))
            place = len(lines) - 1
            body = entities[number]
            if number in roots:
                items = sorted((int(n) for n in REFERENCE.findall(ITEMS.findall(body)[0])), key=content)
                body = ITEMS.sub("(" + ",".join(f"#{n}" for n in items) + ")", body, count=1)
            lines[place] = (numbers[number], REFERENCE.sub(lambda match: f"#{emit(int(match[1]))}", body))
        return numbers[number]

    for root in sorted(roots, key=content):
        emit(root)
    start = step.index(f"#{first} = ")
    end = step.index("ENDSEC;", start)
    return step[:start] + "".join(f"#{number} = {body};\n" for number, body in lines) + step[end:]
