#!/usr/bin/env bash
# The extension's tests in the other Blender: 4.5 runs in Python 3.11, which Debian 12 has, 5.2 in 3.13, which Debian 13
# has. Where the other Python is found on this machine (pyenv's folders too) that is enough. Else, or where
# STILLWATER_OTHER=folder asks for it, in a folder of the other Debian, made with mmdebstrap and kept in build/, which
# needs root. Where neither can be had, the report holds one test that says so and is left out.
#   bash tests/setup/other_debian.sh REPORT.xml
set -uo pipefail
cd "$(dirname "${BASH_SOURCE[0]}")/../.."
source tests/setup/prepare.sh
source tests/setup/debian_folder.sh
report="$1"

case "$("$system_python" -c 'import sys; print("%d.%d" % sys.version_info[:2])')" in
  3.11) other_python=3.13 other_debian=trixie ;;
  3.13) other_python=3.11 other_debian=bookworm ;;
  *) leave_out "other Blender" "this machine's Python is neither 3.11 nor 3.13" ;;
esac

# The first Python of the other version that can make environments and build modules.
find_python() {
  local candidate
  for candidate in "$HOME/.pyenv/versions/$other_python".*/bin/python3 "$(command -v "python$other_python")"; do
    "$candidate" -c 'import ensurepip, venv, pathlib, sysconfig
assert sysconfig.get_python_version() == "'"$other_python"'"
assert pathlib.Path(sysconfig.get_path("include"), "Python.h").exists()' 2>/dev/null && echo "$candidate" && return
  done
  return 1
}

if [ "${STILLWATER_OTHER:-}" != folder ] && python="$(find_python)"; then
  echo "the other Blender, with $python"
  exec env PYTHON="$python" STILLWATER_BUILD="$build/python-$other_python" bash tests/setup/blender.sh "$report"
fi

make_folder "$other_debian" "other Blender" mount
test_inside blender.sh
