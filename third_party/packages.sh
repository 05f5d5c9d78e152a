# SPDX-License-Identifier: Apache-2.0
# shellcheck shell=bash
# The Debian packages that Nephroid needs, by what needs them, and how the missing ones are installed. Sourced by
# run.sh, test.sh and .ci/run; versions and licences are in README.md beside this file.

# Configuring and compiling. python3-pip downloads two source archives (pip_fetch.cmake).
build_packages=(g++ cmake ninja-build pkg-config python3-pip)
# Libraries of the program itself, the bunny that the first-light preset shows, the font that words are drawn with, and
# the chart library that reports hold.
program_packages=(
  opencl-clhpp-headers ocl-icd-opencl-dev pocl-opencl-icd
  libfmt-dev nlohmann-json3-dev libyaml-cpp-dev libcli11-dev
  libglm-dev libassimp-dev libpugixml-dev zlib1g-dev libhowardhinnant-date-dev libembree-dev libopenimageio-dev
  liblcms2-dev libeigen3-dev libqrencode-dev glmark2-data fonts-dejavu-core libjs-chart.js)
# The window.
window_packages=(libglfw3-dev libgl-dev)
# STEP files (docs/workshop.md), in a package of their own. The build leaves them out where it does not find this.
workshop_packages=(libocct-data-exchange-dev)
# What cpack makes a package with: a library's package by dpkg-shlibdeps, and what is a program by file.
packaging_packages=(dpkg-dev file)
# The tests. xvfb and xauth give the window a display where there is none, xdotool moves its mouse; python3-jsonschema
# validates presets, admesh checks meshes that are to be milled, zbar-tools reads QR codes. Open MPI: runs on several
# machines, which who wants them builds; pybind11: the Python module.
test_packages=(libgtest-dev libgmock-dev libboost-dev libbenchmark-dev xvfb xauth xdotool python3-jsonschema admesh
  zbar-tools
  libopenmpi-dev openmpi-bin pybind11-dev python3-dev python3-numpy)
# What .ci/run checks the sources and fuzzes with. libclang-rt-dev: libFuzzer and the sanitizers of clang.
check_packages=(clang clang-format clang-tidy libclang-rt-dev shellcheck)

# missing_packages NAME...: prints those that are not installed.
missing_packages() {
  local installed name
  installed=" $(dpkg-query -W -f '${db:Status-Status}:${Package} ' "$@" 2>/dev/null || true)"
  for name in "$@"; do
    [[ $installed == *" installed:$name "* ]] || printf '%s\n' "$name"
  done
}

# install_packages NAME...: installs those that are missing, as root or by sudo; where neither works, prints the line to
# type and fails.
install_packages() {
  if ! command -v dpkg-query >/dev/null; then
    say "this is not a Debian system: install what these packages hold by your own means: $*"
    return 0
  fi
  local missing
  mapfile -t missing < <(missing_packages "$@")
  [ ${#missing[@]} -gt 0 ] || return 0

  local as_root=()
  if [ "$(id -u)" -ne 0 ]; then
    # Without a terminal sudo cannot ask for a password: it is of use only where it needs none.
    if command -v sudo >/dev/null && { [ -t 0 ] || sudo -n true 2>/dev/null; }; then
      as_root=(sudo)
    else
      say "these packages are missing and installing them needs root; type this as root, then run the command again:"
      say "  apt-get update && apt-get install --no-install-recommends ${missing[*]}"
      return 1
    fi
  fi
  say "installing ${#missing[@]} missing packages: ${missing[*]}"
  local apt=("${as_root[@]}" env DEBIAN_FRONTEND=noninteractive apt-get -qq)
  apt+=(-o DPkg::Lock::Timeout=300 -o Dpkg::Use-Pty=0)
  local log
  log=$(mktemp)
  if ! { "${apt[@]}" update && "${apt[@]}" install --yes --no-install-recommends "${missing[@]}"; } >"$log" 2>&1; then
    tail -n 20 "$log" >&2
    say "the packages could not be installed (apt-get's last lines are above); once that is mended, run it again"
    return 1
  fi
  rm -f "$log"
}
