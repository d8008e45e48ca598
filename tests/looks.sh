#!/usr/bin/env bash
# Contact sheets of what the engine makes of a folder of pictures: bash tests/looks.sh FOLDER [NAME...]
# For every picture with a label map beside it, and every one that polygons.json knows, build/looks/NAME.png.
# To be looked at; nothing is compared.
set -uo pipefail
cd "$(dirname "${BASH_SOURCE[0]}")/.."
source tests/setup/prepare.sh
prepare_engine || exit 1
exec "$build/venv/bin/python" tests/looks/make_sheets.py --output "$build/looks" "$@"
