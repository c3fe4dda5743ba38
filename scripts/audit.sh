#!/bin/sh
# Looks for known weaknesses: bandit in the sources, of medium severity and more; pip-audit in what requirements.lock pins.
# pip-audit asks a database on the network: where that is out of reach it says so, and what bandit found decides.
set -eu
cd "$(dirname "$0")/.."

.venv/bin/uv tool run --quiet bandit --quiet --recursive --severity-level medium packages services
mkdir -p build
if ! .venv/bin/uv tool run --quiet pip-audit --no-deps --disable-pip --progress-spinner off -r requirements.lock > build/audit.txt 2>&1; then
    cat build/audit.txt >&2
    printf 'audit: pip-audit found something, or did not reach its database\n' >&2
    exit 1
fi
skipped=$(grep -c 'could not be audited' build/audit.txt || true)
printf 'audit: nothing known; %s packages could not be looked up\n' "$skipped"
