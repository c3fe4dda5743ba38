"""How many questions are there of which kind? `python -m benchmark.card` writes the tables of README.md anew."""

from __future__ import annotations

import json
import re
from collections import Counter
from pathlib import Path
from typing import Any

FOLDER = Path(__file__).parent
README = FOLDER / "README.md"
TABLES = re.compile(r"(?<=<!-- tables -->\n).*(?=<!-- end of tables -->)", re.DOTALL)
SIDES = re.compile(
    r"\b(top|bottom|front|back|left|right|below|underside)\b", re.IGNORECASE
)  # words by which a question restricts itself to a side

KINDS = (
    *("adapter plate", "bevel", "blind hole", "circular base", "circular protrusion", "cone", "cooling fin", "cutout"),
    *("cylinder", "gear", "grid", "head gasket", "hexagonal screw", "hexagonal screw head", "hole", "hole with bevel"),
    *("hole with ring", "leg", "logo", "mounting hole", "nut hole", "object", "octagonal base plate"),
    *("power connector", "radial slots", "rectangular indentation", "rectangular inside", "rectangular part"),
    *("rectangular pin", "rectangular protrusion", "rectangular slot", "ring", "rod", "screw", "screw head"),
    *("semicircle", "shaft", "slot", "standoff with hole", "standoff without hole", "threaded hole", "through hole"),
    "tube",
)  # the kinds of part that CAD-Q&A asks about (QueryCAD, ICRA 2025)
PROPERTIES = (
    *("center", "count", "depth", "diameter", "distance", "extents", "height", "radius", "size", "thickness", "width"),
)  # likewise


def read() -> list[dict[str, Any]]:
    """What do the question files hold? In alphabetical order."""
    return [json.loads(path.read_text()) for path in sorted((FOLDER / "questions").glob("*.json"))]


def tables() -> str:
    """Which Markdown shows the numbers of models and questions by split, form, kind of part, property and type?"""
    files = read()
    asked = [(file["split"], item) for file in files for item in file["items"]]
    models = [
        f"| {file['model'].removesuffix('.step')} | {file['title']} | {file['split']} | {file['form']} "
        f"| {file['unit']} | {file['bodies']} | {len(file['items'])} |"
        for file in files
    ]
    sides = sum(bool(SIDES.search(item["question"])) for _, item in asked)
    return "\n".join(
        [
            f"{len(files)} models, {len(asked)} questions, {sides} of which name a side.",
            "",
            "| model | what it is | split | stored as | unit | bodies | questions |",
            "|---|---|---|---|---|--:|--:|",
            *models,
            "",
            *_counts("kind of part", [(split, item["tags"]["part"]) for split, item in asked]),
            "",
            *_counts("property", [(split, item["tags"]["property"]) for split, item in asked]),
            "",
            *_counts("type of answer", [(split, item["type"]) for split, item in asked]),
            "",
        ]
    )


def _counts(title: str, rows: list[tuple[str, str]]) -> list[str]:
    number = Counter(rows)
    names = sorted({name for _, name in rows}, key=lambda name: (-number["dev", name] - number["held_out", name], name))
    lines = [f"| {name} | {number['dev', name]} | {number['held_out', name]} |" for name in names]
    total = [sum(count for (split, _), count in number.items() if split == part) for part in ("dev", "held_out")]
    return [f"| {title} | dev | held out |", "|---|--:|--:|", *lines, f"| all | {total[0]} | {total[1]} |"]


def main() -> None:
    """Replaces what stands between the marks."""
    text = README.read_text()
    README.write_text(TABLES.sub(lambda _: tables(), text))


if __name__ == "__main__":
    main()
