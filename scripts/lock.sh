#!/bin/sh
# Resolves what the packages and the development tools need into requirements.lock: every version pinned, every
# file hashed, no address of where it came from. With arguments, upgrades only the packages named: lock.sh numpy
set -eu
cd "$(dirname "$0")/.."

upgrade=
[ $# -gt 0 ] || upgrade=--upgrade
for package in "$@"; do
    upgrade="$upgrade --upgrade-package $package"
done

# The options' order is fixed, so that the same inputs give the same file. The project's own packages are
# installed from the tree, not from the lock.
# shellcheck disable=SC2086  # upgrade holds several words
"${UV:-.venv/bin/uv}" pip compile --quiet --universal --python-version 3.11 --fork-strategy fewest \
    --generate-hashes --no-emit-index-url --no-emit-find-links --no-header --no-annotate --no-config \
    --no-emit-package querycad-contracts --no-emit-package querycad-language \
    --no-emit-package querycad-answering --no-emit-package querycad-api \
    --no-emit-package querycad-segworker --no-emit-package querycad-sandbox \
    $upgrade --output-file requirements.lock --all-extras --group dev packages/querycad/pyproject.toml
