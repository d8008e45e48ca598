#!/usr/bin/env bash
# The window tests on a machine whose Debian has Blender, Xvfb and ImageMagick; gui.sh makes one of a folder.
#   bash tests/setup/window.sh REPORT.xml [FILE...]
set -uo pipefail
cd "$(dirname "${BASH_SOURCE[0]}")/../.."
source tests/setup/prepare.sh
report="$1"
shift
install_packages $window_packages || exit 1
prepare_engine wheel || exit 1
prepare_extension blender || exit 1
timeout --kill-after=10 1200 "$system_python" tests/gui/run.py --zip "$extension_zip" --junitxml="$report" \
  --screens "$build/screens" "$@"
