"""Draws the pictures of docs/questions.md anew: `python -m benchmark.answer_pictures`."""

from __future__ import annotations

import io
import re
from pathlib import Path

from PIL import Image

import querycad

ROOT = Path(__file__).parents[1]
PAGE = ROOT / "docs" / "questions.md"
ROW = re.compile(
    r"^\| (?P<model>\w+) \| (?P<question>[^|]+) \| [^|]+ \| !\[[^]]*\]\((?P<picture>[^)]+)\) \|$", re.MULTILINE
)
SIZE = (480, 300)
"""Width and height, pixels: as narrow as a column of the table."""
COLOURS = 64


def main() -> int:
    """Asks each question that has a picture, and writes it."""
    for row in ROW.finditer(PAGE.read_text(encoding="utf-8")):
        model = querycad.open(ROOT / "examples" / f"{row['model']}.step")
        drawn = Image.open(io.BytesIO(model.ask(row["question"]).picture()))
        target = PAGE.parent / row["picture"]
        target.parent.mkdir(parents=True, exist_ok=True)
        drawn.convert("RGB").resize(SIZE, Image.Resampling.LANCZOS).quantize(COLOURS).save(target, optimize=True)
        print(f"{target.relative_to(ROOT)}: {target.stat().st_size} bytes")
    return 0


if __name__ == "__main__":
    raise SystemExit(main())
