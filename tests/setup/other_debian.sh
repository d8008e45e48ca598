#!/usr/bin/env bash
# The extension's tests in the other Blender: in a folder of the other Debian (12 has Python 3.11 for Blender 4.5,
# 13 has 3.13 for 5.2), made with mmdebstrap and kept in build/. Needs root; where the folder can't be made, the
# report holds one test that says so and is left out.
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

case "$(. /etc/os-release && echo "${VERSION_CODENAME:-}")" in
  bookworm) other=trixie ;;
  trixie) other=bookworm ;;
  *) leave_out "this machine is neither Debian 12 nor 13" ;;
esac
[ "$(id -u)" = 0 ] || leave_out "a folder of the other Debian is made by root only"
install_packages mmdebstrap || leave_out "mmdebstrap can't be installed"

folder="$build/debian-$other"
if once "debian-$other" made; then
  echo "making a folder of Debian $other"
  rm -rf --one-file-system "$folder"
  mmdebstrap --quiet --variant=apt --include=ca-certificates "$other" "$folder" || leave_out "no folder of Debian $other can be made here"
  done_once "debian-$other" made
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

inside true || leave_out "a folder of Debian $other can't be entered here"
inside bash /stillwater/tests/setup/blender.sh /build/report.xml
code=$?
cp "$folder/build/report.xml" "$report" 2>/dev/null
exit $code
