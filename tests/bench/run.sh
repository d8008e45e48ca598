#!/usr/bin/env bash
# A table of work, ours, reference and ratio; medians. bash tests/bench/run.sh [NAME...]
set -uo pipefail
cd "$(dirname "${BASH_SOURCE[0]}")/../.."
source tests/setup/prepare.sh
prepare_engine || exit 1
exec "$build/venv/bin/python" tests/bench/run.py "$@"
