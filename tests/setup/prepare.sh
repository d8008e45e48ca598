# The way from a bare machine to a built engine. Sourced by tests/run.sh and blend_samples/run.sh, which call
# prepare_engine, prepare_blender, ... in the order they need. A second run installs and builds nothing.
#
# Everything lands in build/ (STILLWATER_BUILD names another folder): venv (the engine installed), blender-venv
# (the bpy package), wheels (the engine's wheel and those it needs), stillwater-*.zip (the extension).

repository="$(cd "$(dirname "${BASH_SOURCE[0]}")/../.." && pwd)"
build="${STILLWATER_BUILD:-$repository/build}"
system_python="${PYTHON:-/usr/bin/python3}"
mkdir -p "$build"

source "$repository/tests/setup/packages.sh"

# once STAMP TEXT: true where STAMP does not hold TEXT yet. done_once STAMP TEXT writes it.
once() { [ "$(cat "$build/stamps/$1" 2>/dev/null)" != "$2" ]; }
done_once() { mkdir -p "$build/stamps" && printf '%s\n' "$2" >"$build/stamps/$1"; }

# What the given files and folders hold, by name, size and time.
state_of() {
  (cd "$repository" && find "$@" -type f -not -name '*.pyc' -printf '%p %s %T@\n' | LC_ALL=C sort | sha256sum | cut -d' ' -f1)
}

# venv FOLDER NAME=REQUIREMENT...: a virtual environment that holds these, beside what it was asked to hold before.
venv() {
  local folder="$1" wanted="${*:2}"
  local stamp
  stamp="venv-$(basename "$folder")-$(printf '%s' "$wanted" | sha256sum | cut -c1-12)"
  [ -x "$folder/bin/python" ] && ! once "$stamp" "$wanted" && return 0
  [ -x "$folder/bin/python" ] || "$system_python" -m venv "$folder" || return 1
  echo "installing in $(basename "$folder"): $wanted"
  "$folder/bin/python" -m pip install --quiet --disable-pip-version-check "${@:2}" || return 1
  done_once "$stamp" "$wanted"
}

# Builds the engine's wheel and installs it. `prepare_engine wheel` stops at the wheel, and asks for no more than that.
prepare_engine() {
  local wanted="scikit-build-core pybind11"
  [ "${1:-}" = wheel ] || wanted="numpy msgspec tqdm $wanted pytest pytest-timeout hypothesis scipy pillow pyrtools"
  install_packages $build_packages $run_packages || return 1
  venv "$build/venv" $wanted || return 1
  local state
  state="$(state_of native CMakeLists.txt)"
  if once engine "$state"; then
    echo "building the engine"
    mkdir -p "$build/wheels"
    rm -f "$build"/wheels/stillwater-*.whl
    "$build/venv/bin/python" -m pip wheel "$repository/native" --quiet --disable-pip-version-check \
      --no-build-isolation --no-deps --wheel-dir "$build/wheels" \
      --config-settings=build-dir="$build/engine" --config-settings=cmake.define.STILLWATER_WERROR="${CI:+ON}" ||
      return 1
    done_once engine "$state"
  fi
  [ "${1:-}" = wheel ] || ! once engine-installed "$state" && return 0
  "$build/venv/bin/python" -m pip install --quiet --disable-pip-version-check --no-deps --force-reinstall \
    "$build"/wheels/stillwater-*.whl || return 1
  done_once engine-installed "$state"
}

# Blender as a Python package: the version that fits this Python, in an environment without the engine, so that
# what runs there is what the extension's zip carries.
prepare_blender() {
  local python_version blender_version
  python_version="$("$system_python" -c 'import sys; print("%d.%d" % sys.version_info[:2])')"
  case "$python_version" in
    3.11) blender_version=4.5 ;;
    3.13) blender_version=5.2 ;;
    *) echo "no bpy package fits Python $python_version (3.11 has Blender 4.5, 3.13 has 5.2)" >&2; return 1 ;;
  esac
  install_packages $blender_packages || return 1
  venv "$build/blender-venv" "bpy==$blender_version.*" numpy "$@"
}

# The extension's zip, with the engine's wheel and those it needs, built by the bpy package or, where it is named, by a
# Blender program. Leaves its path in $extension_zip.
prepare_extension() {
  local state python="$build/blender-venv/bin/python" options=()
  [ $# = 0 ] || python="$build/venv/bin/python" options=(--blender "$1")
  state="$(state_of addon native CMakeLists.txt)"
  if once extension "$state"; then
    echo "building the extension"
    rm -f "$build"/wheels/msgspec-*.whl "$build"/wheels/tqdm-*.whl
    "$build/venv/bin/python" -m pip download --quiet --disable-pip-version-check --only-binary :all: --no-deps \
      --dest "$build/wheels" msgspec tqdm || return 1
    rm -f "$build"/stillwater-*.zip
    "$python" "$repository/addon/build_zip.py" --wheels "$build/wheels" --output "$build" "${options[@]}" || return 1
    done_once extension "$state"
  fi
  extension_zip="$(ls "$build"/stillwater-*.zip)"
}
