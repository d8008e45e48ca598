#!/usr/bin/env bash
# The window tests, in a folder of Debian sid: no release of Debian has a Blender that the extension runs in. The engine
# is built in there, for that Blender's Python. Screenshots of every step land in build/screens/. Where the folder can't
# be made, the report holds one test that says so and is left out. With STILLWATER_GUIDE set, the screenshots of the
# artist's guide are taken anew into addon/guide/.
#   bash tests/setup/gui.sh REPORT.xml [FILE...]
set -uo pipefail
cd "$(dirname "${BASH_SOURCE[0]}")/../.."
source tests/setup/prepare.sh
source tests/setup/debian_folder.sh
report="$1"
shift
make_folder sid "window tests" $build_packages $run_packages $window_packages
# Not under CI's rule that warnings are errors: sid's compiler is newer than any that the engine is written for.
CI="" test_inside window.sh "$@"
code=$?
rm -rf "$build/screens"
cp -r "$folder/build/screens" "$build/screens" 2>/dev/null
[ -z "${STILLWATER_GUIDE:-}" ] || [ $code != 0 ] || cp "$build/screens/guide/"*.jpg addon/guide/
exit $code
