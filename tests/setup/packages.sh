# What Debian's package manager brings. Sourced by prepare.sh.

build_packages="g++ cmake ninja-build pkg-config python3 python3-dev python3-venv
  libopencv-dev libopenimageio-dev libavformat-dev libavcodec-dev libswscale-dev
  libfftw3-dev libeigen3-dev"
run_packages="ffmpeg"
blender_packages="libxi6 libxxf86vm1 libxfixes3 libxrender1 libxkbcommon0 libsm6 libice6 libgl1 libegl1
  libegl-mesa0 libgl1-mesa-dri"
# A Blender that shows a window, with what Debian only recommends to it, a screen for it, and what looks at the screen.
window_packages="blender python3-cattr python3-numpy python3-requests python3-xlib xvfb imagemagick libegl1 libgl1-mesa-dri"
test_packages="qemu-user openimageio-tools mount"

as_root() {
  if [ "$(id -u)" = 0 ]; then "$@"; else sudo "$@"; fi
}

# install_packages NAME...: only what is missing, so that a second run asks nobody. Two rooms that run side by side take
# turns at it.
install_packages() {
  local missing=()
  local name
  for name in "$@"; do
    dpkg-query -W -f '${Status}' "$name" 2>/dev/null | grep -q 'install ok installed' || missing+=("$name")
  done
  [ ${#missing[@]} = 0 ] && return 0
  command -v apt-get >/dev/null ||
    { echo "apt-get is not here; these, or what they are called here, must be: ${missing[*]}" >&2; return 0; }
  echo "installing ${missing[*]}"
  as_root env DEBIAN_FRONTEND=noninteractive flock --timeout 900 /var/lib/apt bash -c '
    apt-get update -qq
    apt-get install -y -qq --no-install-recommends "$@"' apt "${missing[@]}" \
    >"$build/apt.log" 2>&1 || { tail -20 "$build/apt.log" >&2; return 1; }
}
