#!/usr/bin/env bash
# A table of work, ours, reference and ratio; medians. bash tests/bench/run.sh [NAME...]
set -uo pipefail
cd "$(dirname "${BASH_SOURCE[0]}")/../.."
source tests/setup/prepare.sh
prepare_engine || exit 1
# cv::remap is what the displacement is measured against.
"$build/venv/bin/python" -c "import cv2" 2>/dev/null ||
  "$build/venv/bin/python" -m pip install --quiet --disable-pip-version-check opencv-python-headless || exit 1
# PyMatting is what mattes are measured against.
"$build/venv/bin/python" -c "import importlib.util as i, sys; sys.exit(i.find_spec('pymatting') is None)" ||
  "$build/venv/bin/python" -m pip install --quiet --disable-pip-version-check pymatting || exit 1
# The extension is measured in Blender.
prepare_blender pytest pytest-timeout hypothesis && prepare_extension || exit 1
export STILLWATER_BUILD="$build"
exec "$build/venv/bin/python" tests/bench/run.py "$@"
