#!/usr/bin/env bash
# The extension's tests in the other Blender: 4.5 runs in Python 3.11, which Debian 12 has, 5.2 in 3.13, which Debian 13
# has. Where the other Python is found on this machine (pyenv's folders too) that is enough. Else, or where
# STILLWATER_OTHER=folder asks for it, in a folder of the other Debian, made with mmdebstrap and kept in build/, which
# needs root. Where neither can be had, the report holds one test that says so and is left out.
#   bash tests/setup/other_debian.sh REPORT.xml
set -uo pipefail
cd "$(dirname "${BASH_SOURCE[0]}")/../.."
source tests/setup/prepare.sh
report="$1"

leave_out() {
  cat >"$report" <<XML
<testsuites><testsuite><testcase name="other Blender"><skipped message="$1"/></testcase></testsuite></testsuites>
XML
  exit 0
}

case "$("$system_python" -c 'import sys; print("%d.%d" % sys.version_info[:2])')" in
  3.11) other_python=3.13 other_debian=trixie ;;
  3.13) other_python=3.11 other_debian=bookworm ;;
  *) leave_out "this machine's Python is neither 3.11 nor 3.13" ;;
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

[ "$(id -u)" = 0 ] || leave_out "a folder of the other Debian is made by root only"
install_packages mmdebstrap || leave_out "mmdebstrap can't be installed"

folder="$build/debian-$other_debian"
if once "debian-$other_debian" made; then
  echo "making a folder of Debian $other_debian"
  rm -rf --one-file-system "$folder"
  mmdebstrap --quiet --variant=apt --include=ca-certificates "$other_debian" "$folder" ||
    leave_out "no folder of Debian $other_debian can be made here"
  done_once "debian-$other_debian" made
fi
# pip in there trusts what this machine trusts.
cp /etc/ssl/certs/ca-certificates.crt "$folder/etc/ssl/certs/ca-certificates.crt"
cp /etc/resolv.conf "$folder/etc/resolv.conf"

inside() {
  # A mount namespace of its own: what is mounted here is gone with the process, whatever happens.
  unshare --mount --propagation private bash -c '
    set -e
    folder="$1"; repository="$2"; build="$3"; shift 3
    mount -t proc proc "$folder/proc" || mount --bind /proc "$folder/proc"
    mount --rbind /dev "$folder/dev"
    mkdir -p "$folder/stillwater" "$folder/build"
    mount --bind "$repository" "$folder/stillwater"
    mount -o remount,bind,ro "$folder/stillwater"
    exec chroot "$folder" env -u PYTHON HOME=/root PATH=/usr/sbin:/usr/bin:/sbin:/bin STILLWATER_BUILD=/build "$@"
  ' inside "$folder" "$repository" "$build" "$@"
}

inside true || leave_out "a folder of Debian $other_debian can't be entered here"
inside bash /stillwater/tests/setup/blender.sh /build/report.xml
code=$?
cp "$folder/build/report.xml" "$report" 2>/dev/null
exit $code
