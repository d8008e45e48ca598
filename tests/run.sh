#!/usr/bin/env bash
# The one test command. On a bare Debian 12 or 13 it installs, builds and runs everything.
#
#   bash tests/run.sh             all rooms, in both Blenders, and in one with a window
#   bash tests/run.sh setup       stops after the build
#   bash tests/run.sh NAME...     rooms (motion, frame, blender, gui, ...) or files
#   bash tests/run.sh sanitize    the engine's tests under the address and undefined-behaviour sanitizers
set -uo pipefail
cd "$(dirname "${BASH_SOURCE[0]}")/.."
source tests/setup/prepare.sh

prepare_engine || exit 1
case "${1:-}" in
  setup)
    echo "ready: $build/venv/bin/python -m stillwater"
    exit 0 ;;
  sanitize)
    shift
    source tests/setup/sanitize.sh
    run_sanitized "$@"
    exit ;;
esac
install_packages $test_packages || echo "without $test_packages some tests are left out"
exec "$build/venv/bin/python" tests/setup/run_rooms.py --build "$build" "$@"
