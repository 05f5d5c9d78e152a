#!/usr/bin/env bash
# SPDX-License-Identifier: Apache-2.0
# ./run.sh installs what is missing (Debian 12 or 13), builds, and renders the first-light preset into out/first-light.
# ./run.sh ARGS builds in the same way, then runs `nephroid ARGS` in the folder it was called from.
set -euo pipefail
root=$(dirname "$(readlink -f "${BASH_SOURCE[0]}")")
# shellcheck source=cmake/build.sh
. "$root/cmake/build.sh"
# shellcheck source=third_party/packages.sh
. "$root/third_party/packages.sh"

program=$root/build/release/bin/nephroid
picture=$root/out/first-light/image.png

# The tests need packages of their own, so a new build folder leaves them out until ./test.sh turns them on.
prepare_build() {
  if [ -f "$root/build/release/build.ninja" ]; then
    configure release
  else
    configure release -DNEPHROID_TESTS=OFF
  fi
  build release nephroid
}

# picture_is_current: newer than the program and everything that the preset may name.
picture_is_current() {
  [ -f "$picture" ] && [ -z "$(find "$program" "$root/presets" -newer "$picture" -print -quit)" ]
}

render() {
  say "rendering the first-light preset into $root/out/first-light"
  "$program" run first-light -o "$root/out/first-light"
}

phase install install_packages "${build_packages[@]}" "${program_packages[@]}" "${window_packages[@]}"
phase build prepare_build
if [ $# -gt 0 ]; then
  exec "$program" "$@"
fi
if picture_is_current; then
  say "nothing to do: the program and the picture are up to date"
else
  phase render render
  say_phases
fi
say "the picture is $picture"
say "what next: ./run.sh presets lists presets, ./run.sh first-light opens the window, ./run.sh --help says the rest"
