#!/bin/sh
# Runs the benchmark, with a summary in build/bench/summary.md and the questions in build/bench/junit.xml; with a commit,
# says too what was fixed and broken since. Exit code of `make bench`: 1 where a set is below its floor.
set -eu
cd "$(dirname "$0")/.."
out=build/bench
rm -rf "$out"
mkdir -p "$out"

result=0
make bench ARGS="--out $out --markdown $out/summary.md --junit $out/junit.xml" || result=$?

base=${1:-}
if [ -n "$base" ]; then
    rm -rf build/base
    git worktree prune
    git worktree add --quiet --detach build/base "$base"
    # the base's own code asks its own questions: compared are those that both have
    if make -C build/base bench; then :; else echo "the base itself is below its floor" >&2; fi
    for set in benchmark cad-qa-dev; do
        [ -f "$out/$set/results.json" ] && [ -f "build/base/build/bench/$set/results.json" ] || continue
        .venv/bin/querycad bench compare "build/base/build/bench/$set" "$out/$set" --markdown "$out/summary.md"
    done
    git worktree remove --force build/base
fi
exit "$result"
