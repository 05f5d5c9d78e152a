#!/usr/bin/env bash
# SPDX-License-Identifier: Apache-2.0
# packaging/package.sh [headless] installs what is missing (Debian 12 or 13), builds, and makes a .deb and an archive in
# out/package. headless: without the window.
set -euo pipefail
root=$(dirname "$(dirname "$(readlink -f "${BASH_SOURCE[0]}")")")
# shellcheck source=cmake/build.sh
. "$root/cmake/build.sh"
# shellcheck source=third_party/packages.sh
. "$root/third_party/packages.sh"

preset=${1:-release}
packages=("${build_packages[@]}" "${program_packages[@]}" "${workshop_packages[@]}" "${packaging_packages[@]}")
case $preset in
  release) packages+=("${window_packages[@]}") ;;
  headless) ;;
  *) sed -n '3,4s/^# //p' "${BASH_SOURCE[0]}" >&2; exit 2 ;;
esac

prepare_build() {
  [ -f "$root/build/$preset/build.ninja" ] || configure "$preset" -DNEPHROID_TESTS=OFF
  build "$preset"
}

phase install install_packages "${packages[@]}"
phase build prepare_build
phase package cpack --config "$root/build/$preset/CPackConfig.cmake" -B "$root/out/package" >&2
say_phases
