#!/usr/bin/env bash
# Films by one clip beside how the clip goes on: bash tests/films.sh [--output DIR] [--frames N] CLIP...
# A frame of each clip is the picture, what comes before it the example; prints how far the film, the live loop and a plain
# cross-faded advection are from what comes after it, and writes sheets to build/looks/films.
set -uo pipefail
cd "$(dirname "${BASH_SOURCE[0]}")/.."
source tests/setup/prepare.sh
prepare_engine || exit 1
exec "$build/venv/bin/python" tests/looks/compare_films.py "$@"
