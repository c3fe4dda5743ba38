"""How many frames a second does the page draw of a model, without a graphics card?

python -m benchmark.perf.page FILE.step … turns each model in headless Chromium, which draws by software, in a view of
960 x 540 pixels. The processor time of a frame tells more than the rate where other programs have the cores, too.
"""

from __future__ import annotations

import argparse
import os
import sys
from pathlib import Path

from playwright.sync_api import Browser
from tests.page.conftest import Service
from tests.page.tour import shown, stage

from querycad.client import Client

ROUNDS, FRAMES = 5, 90
WIDTH, HEIGHT = 960, 540
READ_S = 180.0


def main(arguments: list[str]) -> None:
    """Starts a service and a browser, and prints a line for each file."""
    parser = argparse.ArgumentParser(prog="python -m benchmark.perf.page", description=__doc__.splitlines()[0])
    parser.add_argument("files", nargs="+", type=Path, metavar="FILE")
    files: list[Path] = parser.parse_args(arguments).files
    with stage() as (browser, service, client):
        for path in files:
            sys.stdout.write(frames(browser, service, client, path) + "\n")


def frames(
    browser: Browser, service: Service, client: Client, path: Path, rounds: int = ROUNDS, count: int = FRAMES
) -> str:
    """How fast is the model drawn while it turns? The rate of each round, slowest first, and the time of a frame."""
    model = client.upload(path, READ_S).id
    page = shown(browser, service, model)
    for side, length in (("width", WIDTH), ("height", HEIGHT)):
        name = side.capitalize()
        whole = page.page.evaluate(f"() => inner{name} - querycad.canvas.client{name}") + length
        page.page.set_viewport_size({**(page.page.viewport_size or {}), side: whole})  # type: ignore[typeddict-item]
        page.until(f"() => querycad.canvas.client{name} === {length}")
    busy_s = _busy_s()
    rates = sorted(page.page.evaluate("frames => querycad.spin(frames)", count) for _ in range(rounds))
    frame_ms = (_busy_s() - busy_s) / (count * rounds) * 1e3
    drawn = page.page.evaluate("() => [querycad.canvas.width, querycad.canvas.height]")
    faces = page.page.evaluate("() => querycad.model.faceCount")
    said = ", ".join(f"{rate:.1f}" for rate in rates)
    cores = f"load {os.getloadavg()[0]:.1f} on {os.cpu_count()} cores"
    page.page.context.close()
    return (
        f"{path.name}: {faces} faces, view {WIDTH} x {HEIGHT}, drawn at {drawn[0]} x {drawn[1]} while it moves: "
        f"{said} frames a second; {frame_ms:.0f} ms of a core each, {cores}"
    )


def _busy_s() -> float:
    """How long have the browser's processes had a core, altogether? They are those below this one that draw."""
    ours, ticks = {str(os.getpid())}, 0
    for folder in sorted(Path("/proc").glob("[0-9]*"), key=lambda path: int(path.name)):
        try:
            said = (folder / "stat").read_text().rpartition(")")[2].split()
            command = (folder / "cmdline").read_text(errors="replace")
        except OSError:
            continue  # it has ended
        if said[1] in ours:
            ours.add(folder.name)
            ticks += sum(map(int, said[11:13])) if "swiftshader" in command or "--type=renderer" in command else 0
    return ticks / os.sysconf("SC_CLK_TCK")


if __name__ == "__main__":
    main(sys.argv[1:])
