#!/usr/bin/env bash
# Our mattes beside PyMatting's on pictures with true mattes: bash tests/mattes.sh FOLDER [--output DIR]
# FOLDER holds input, gt, trimap1, trimap2 (alphamatting.com). Prints SAD, MSE, gradient and connectivity errors.
set -uo pipefail
cd "$(dirname "${BASH_SOURCE[0]}")/.."
source tests/setup/prepare.sh
prepare_engine || exit 1
"$build/venv/bin/python" -c "import importlib.util as i, sys; sys.exit(i.find_spec('pymatting') is None)" ||
  "$build/venv/bin/python" -m pip install --quiet --disable-pip-version-check pymatting || exit 1
exec "$build/venv/bin/python" tests/looks/compare_mattes.py "$@"
