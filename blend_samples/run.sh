#!/usr/bin/env bash
# The one command that shows what Stillwater does. On a bare Debian 12 or 13 it installs, builds, animates a sample's
# picture, opens it in Blender with the extension installed, and renders it through the Stillwater compositor node.
#
#   bash blend_samples/run.sh [SAMPLE] [--frames A-B] [--blender PATH]
#
# SAMPLE is lake (default), tree, harbour, campfire or waterfall. Without --blender, Blender is the bpy package that fits this Python.
# Leaves build/samples/SAMPLE.mp4 and build/samples/SAMPLE.png (8 frames with their numbers); prints both paths last.
set -uo pipefail
cd "$(dirname "${BASH_SOURCE[0]}")/.."
source tests/setup/prepare.sh

usage="usage: bash blend_samples/run.sh [SAMPLE] [--frames A-B] [--blender PATH]"
sample="" frames="" blender=""
while [ $# -gt 0 ]; do
  case "$1" in
    --frames | --blender)
      [ $# -gt 1 ] || { echo "$1 is given without a value; $usage" >&2; exit 2; }
      [ "$1" = --frames ] && frames="$2" || blender="$2"
      shift 2 ;;
    --help | -h) echo "$usage"; exit 0 ;;
    -*) echo "$1 is not an option; $usage" >&2; exit 2 ;;
    *)
      [ -z "$sample" ] || { echo "$1: a sample is named already ($sample); $usage" >&2; exit 2; }
      sample="$1"
      shift ;;
  esac
done
sample="${sample:-lake}"
recipe="blend_samples/$sample/recipe.json"
if [ ! -f "$recipe" ]; then
  echo "$sample is not a sample ($(cd blend_samples && ls -d */recipe.json | xargs -n1 dirname | xargs))" >&2
  exit 2
fi
if [ -n "$frames" ] && ! [[ "$frames" =~ ^[0-9]+-[0-9]+$ ]]; then
  echo "--frames: $frames is not FIRST-LAST" >&2
  exit 2
fi
if [ -n "$blender" ] && ! command -v "$blender" >/dev/null; then
  echo "--blender: $blender is not a program" >&2
  exit 2
fi

prepare_engine || exit 1
if [ -n "$blender" ]; then
  prepare_extension "$blender" || exit 1
else
  prepare_blender && prepare_extension || exit 1
fi

python="$build/venv/bin/python"
work="$build/samples/$sample"
mkdir -p "$work"

echo "baking $recipe"
timeout 3600 "$python" -m stillwater render "$recipe" --output "$work/frames" --progress bar \
  ${frames:+--frames "$frames"} || exit

echo "rendering $sample in Blender"
profile="$(mktemp -d)"
trap 'rm -rf "$profile"' EXIT
run_film=("$build/blender-venv/bin/python" blend_samples/film.py)
[ -n "$blender" ] && run_film=("$blender" --background --python-exit-code 1 --python blend_samples/film.py)
# Blender writes a line or more a frame to its standard output; the progress goes to standard error.
BLENDER_USER_RESOURCES="$profile" timeout 1800 "${run_film[@]}" -- --zip "$extension_zip" --recipe "$recipe" \
  --work "$work" ${frames:+--frames "$frames"} >"$work/blender.log" </dev/null ||
  {
    tail -20 "$work/blender.log" >&2
    echo "Blender didn't render $sample; all it said is in $work/blender.log" >&2
    exit 1
  }

timeout 600 "$python" blend_samples/develop.py --recipe "$recipe" --frames "$work/film" \
  --movie "$build/samples/$sample.mp4" --sheet "$build/samples/$sample.png"
