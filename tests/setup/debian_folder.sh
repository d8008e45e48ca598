# A folder that holds another Debian, made with mmdebstrap (which needs root), kept in build/ and entered with chroot.
# Sourced after prepare.sh by scripts whose tests run in there; they have set $report.

# leave_out NAME REASON: ends the script with a report of one test, left out for this reason.
leave_out() {
  cat >"$report" <<XML
<testsuites><testsuite><testcase name="$1"><skipped message="$2"/></testcase></testsuite></testsuites>
XML
  exit 0
}

# make_folder SUITE NAME PACKAGE...: $folder with this Debian and these packages. Where it can't be made or entered,
# the test NAME is left out.
make_folder() {
  local suite="$1" name="$2"
  shift 2
  folder="$build/debian-$suite"
  [ "$(id -u)" = 0 ] || leave_out "$name" "a folder of Debian $suite is made by root only"
  install_packages mmdebstrap || leave_out "$name" "mmdebstrap can't be installed"
  if [ ! -d "$folder/etc" ] || once "debian-$suite" "$*"; then
    echo "making a folder of Debian $suite"
    rm -rf --one-file-system "$folder"
    # Its documentation and translations, half of the files, are never looked at; nor has it to survive a power cut.
    mmdebstrap --quiet --variant=apt --include="$(IFS=,; echo "ca-certificates,$*")" \
      --dpkgopt='path-exclude=/usr/share/doc/*' --dpkgopt='path-exclude=/usr/share/man/*' \
      --dpkgopt='path-exclude=/usr/share/locale/*' --dpkgopt=force-unsafe-io \
      --aptopt='Acquire::Check-Valid-Until "false"' "$suite" "$folder" >"$build/debian-$suite.log" 2>&1 ||
      leave_out "$name" "no folder of Debian $suite can be made here; $build/debian-$suite.log says why"
    done_once "debian-$suite" "$*"
  fi
  # pip in there trusts what this machine trusts.
  cp /etc/ssl/certs/ca-certificates.crt "$folder/etc/ssl/certs/ca-certificates.crt"
  cp /etc/resolv.conf "$folder/etc/resolv.conf"
  inside true || leave_out "$name" "a folder of Debian $suite can't be entered here"
}

# inside COMMAND...: runs it in $folder, where the repository is /stillwater (read-only) and build/ is a /build of its own.
inside() {
  # A mount namespace of its own: what is mounted here is gone with the process, whatever happens.
  unshare --mount --propagation private bash -c '
    set -e
    folder="$1"; repository="$2"; shift 2
    mount -t proc proc "$folder/proc" || mount --bind /proc "$folder/proc"
    mount --rbind /dev "$folder/dev"
    mkdir -p "$folder/stillwater" "$folder/build"
    mount --bind "$repository" "$folder/stillwater"
    mount -o remount,bind,ro "$folder/stillwater"
    exec chroot "$folder" env -u PYTHON HOME=/root PATH=/usr/sbin:/usr/bin:/sbin:/bin STILLWATER_BUILD=/build "$@"
  ' inside "$folder" "$repository" "$@"
}

# test_inside SCRIPT [ARGUMENT...]: runs a script of tests/setup/ in $folder; its report comes back as $report.
test_inside() {
  rm -f "$folder/build/report.xml"
  inside bash "/stillwater/tests/setup/$1" /build/report.xml "${@:2}"
  local code=$?
  cp "$folder/build/report.xml" "$report" 2>/dev/null
  return $code
}
