#!/bin/sh
# Makes .venv: the newest Python that the packages run on, everything in requirements.lock by its hashes, and the
# project's own packages from the tree; and builds the page that the service serves. Does nothing when nothing changed since it last ran.
set -eu
cd "$(dirname "$0")/.."

PACKAGES="packages/contracts packages/language packages/answering packages/querycad services/api services/segworker services/llm_sandbox"
STAMP=.venv/setup-stamp

say() { printf 'setup: %s\n' "$*" >&2; }
fail() { say "$*"; exit 1; }

# The state that a finished setup stands for: the inputs' hash and where the tree lies (editable installs hold paths).
fingerprint() {
    { pwd; cat requirements.lock VERSION scripts/setup.sh; for package in $PACKAGES; do cat "$package/pyproject.toml"; done; } |
        sha256sum
}

# Runs a command as root where that needs no password; fails where it does.
as_root() {
    if [ "$(id -u)" = 0 ]; then "$@"
    elif command -v sudo >/dev/null && sudo -n true 2>/dev/null; then sudo -n "$@"
    else return 1
    fi
}

apt_install() {
    command -v apt-get >/dev/null && as_root true || return 1
    say "installing system packages: $*"
    { DEBIAN_FRONTEND=noninteractive as_root apt-get install -qq -y --no-install-recommends "$@" ||
        { as_root apt-get update -qq && DEBIAN_FRONTEND=noninteractive as_root apt-get install -qq -y --no-install-recommends "$@"; }
    } </dev/null >.setup-apt.log 2>&1 && rm -f .setup-apt.log
}

has_library() { "$1" -c "import ctypes; ctypes.CDLL('$2')" 2>/dev/null; }
# Mesa's software rasteriser: swrast_dri.so, or part of libgallium in newer releases.
has_rasteriser() {
    for driver in /usr/lib/*/dri/swrast_dri.so /usr/lib*/dri/swrast_dri.so /usr/lib/*/libgallium*.so; do
        [ -e "$driver" ] && return 0
    done
    return 1
}

# libGL is linked by the CAD kernel; EGL and Mesa's rasteriser draw off screen and can be done without.
system_packages() {
    wanted=
    has_library "$1" libGL.so.1 || wanted=libgl1
    has_library "$1" libEGL.so.1 || wanted="$wanted libegl1"
    has_rasteriser || wanted="$wanted libgl1-mesa-dri"
    [ -n "$wanted" ] || return 0
    # shellcheck disable=SC2086  # a list of words
    apt_install $wanted || true
    has_library "$1" libGL.so.1 ||
        fail "the CAD kernel needs libGL.so.1, and this user may not install it. As root: apt-get install libgl1"
    if ! has_library "$1" libEGL.so.1 || ! has_rasteriser; then
        say "no EGL here (as root: apt-get install libegl1 libgl1-mesa-dri): rays draw everything, and tests"
        say "that draw with OpenGL are skipped."
    fi
}

# A name on PATH may be a shim that does not run: only one that runs and says its version counts.
find_python() {
    for name in ${PYTHON:-} python3.14 python3.13 python3.12 python3.11 python3; do
        "$name" -c 'import sys; sys.exit(not (3, 11) <= sys.version_info < (3, 15))' 2>/dev/null && { echo "$name"; return; }
    done
    fail "no Python from 3.11 to 3.14 found. On Debian or Ubuntu: apt-get install python3 python3-venv"
}

has_venv() { "$1" -c 'import ensurepip, venv' 2>/dev/null; }

make_venv() {
    version=$("$1" -c 'import sys; print("%d.%d" % sys.version_info[:2])')
    rm -rf .venv
    has_venv "$1" || apt_install "python$version-venv" || true
    if has_venv "$1"; then "$1" -m venv .venv
    elif command -v uv >/dev/null; then uv venv --quiet --seed --python "$1" .venv
    elif command -v virtualenv >/dev/null; then virtualenv --quiet --python "$1" .venv
    else fail "$1 cannot make virtual environments, and neither uv nor virtualenv is here. As root: apt-get install python$version-venv"
    fi
    say "made .venv with Python $version"
}

# uv itself comes from the lock too: its entry is the only one that pip reads.
install_uv() {
    awk '/^[a-z0-9]/ { wanted = /^uv==/ } wanted' requirements.lock > .venv/uv.lock
    .venv/bin/python -m pip install --quiet --disable-pip-version-check --require-hashes --only-binary :all: -r .venv/uv.lock
}

# The service and all commands work without the page: a machine that cannot reach npm is told, and goes on.
build_page() { [ ! -x scripts/page.sh ] || scripts/page.sh --unless-failed || true; }

main() {
    if [ -x .venv/bin/python ] && [ "$(cat "$STAMP" 2>/dev/null)" = "$(fingerprint)" ]; then
        system_packages .venv/bin/python
        build_page
        return
    fi
    python=$(find_python)
    .venv/bin/python -m pip --version >/dev/null 2>&1 || make_venv "$python"
    rm -f "$STAMP"
    system_packages .venv/bin/python
    install_uv
    say "installing what requirements.lock names"
    .venv/bin/uv pip sync --quiet --python .venv/bin/python --require-hashes --no-config requirements.lock
    editables=
    for package in $PACKAGES; do editables="$editables --editable $package"; done
    # shellcheck disable=SC2086  # a list of words
    .venv/bin/uv pip install --quiet --python .venv/bin/python --no-deps --no-build-isolation --no-config $editables
    fingerprint > "$STAMP"
    build_page
    say "ready: .venv/bin/querycad"
}

main
