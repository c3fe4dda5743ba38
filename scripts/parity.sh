#!/bin/sh
# Compares the detector and the segmenter with the public reference implementations, on tiny models exported to ONNX as it
# runs. Installs PyTorch and transformers into .venv for it, which the next change of requirements.lock takes out again.
# With --record, writes anew the models and answers that the tests compare with where PyTorch is not installed.
set -eu
cd "$(dirname "$0")/.."

# A folder of wheels that pip is told of may hold a PyTorch for the CPU; uv reads another variable.
UV_FIND_LINKS=${UV_FIND_LINKS:-${PIP_FIND_LINKS:-}}
export UV_FIND_LINKS
printf 'parity: installing PyTorch and transformers (without a build for the CPU alone: several GB)\n' >&2
.venv/bin/uv pip install --quiet --python .venv/bin/python --group parity

if [ "${1:-}" = --record ]; then
    exec .venv/bin/python -m tests.segworker.segcad.engines.reference tests/segworker/segcad/engines/recorded.tar.xz
fi
QUERYCAD_PARITY=1 exec .venv/bin/python -m pytest tests/segworker/segcad/engines/test_parity.py "$@"
