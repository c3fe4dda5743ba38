"""Rebuilds every example: its model, its questions, its picture."""

from __future__ import annotations

import subprocess
import sys
from pathlib import Path

from _render import render_example

FOLDER = Path(__file__).parent


def main() -> None:
    """Runs each script in a process of its own, as the kernel numbers products through a whole process."""
    for script in sorted(FOLDER.glob("build_*.py")):
        name = script.stem.removeprefix("build_")
        print(f"{name} …", flush=True)
        subprocess.run([sys.executable, str(script)], check=True)
        render_example(FOLDER / f"{name}.step", FOLDER / f"{name}.png")


if __name__ == "__main__":
    main()
