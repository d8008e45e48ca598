#!/usr/bin/env bash
# The extension's tests in the Blender that fits this machine's Python, against the zip as it is installed.
#   bash tests/setup/blender.sh REPORT.xml [pytest's arguments]
set -uo pipefail
cd "$(dirname "${BASH_SOURCE[0]}")/../.."
source tests/setup/prepare.sh
report="$1"
shift
prepare_engine || exit 1
prepare_blender pytest pytest-timeout hypothesis || exit 1
prepare_extension || exit 1
timeout 1200 "$build/blender-venv/bin/python" tests/blender/run.py --zip "$extension_zip" --junitxml="$report" "$@"
