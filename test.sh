#!/usr/bin/env bash
# SPDX-License-Identifier: Apache-2.0
# ./test.sh [PRESET] [CTEST ARGS...] installs what is missing (Debian 12 or 13), builds and runs every test.
# PRESET is one of CMakePresets.json: release (the default), debug, ci, asan, tsan, clang, headless. ./test.sh asan -R
# Dispersion runs the suites with that in their name under AddressSanitizer and UndefinedBehaviorSanitizer.
set -euo pipefail
root=$(dirname "$(readlink -f "${BASH_SOURCE[0]}")")
# shellcheck source=cmake/build.sh
. "$root/cmake/build.sh"
# shellcheck source=third_party/packages.sh
. "$root/third_party/packages.sh"

preset=release
case ${1-} in
  release | debug | ci | asan | tsan | clang | headless) preset=$1; shift ;;
  '' | -*) ;;
  *) sed -n '3,5s/^# //p' "${BASH_SOURCE[0]}" >&2; exit 2 ;;
esac

packages=("${build_packages[@]}" "${program_packages[@]}" "${workshop_packages[@]}"
  "${test_packages[@]}")
[ "$preset" = headless ] || packages+=("${window_packages[@]}")
[ "$preset" != clang ] || packages+=(clang)

prepare_build() {
  configure "$preset" -DNEPHROID_TESTS=ON
  build "$preset"
}

run_tests() {
  # The suppressions and their reasons: tests/sanitizers/.
  # intercept_tls_get_addr: LeakSanitizer of g++ 12 misreads the thread-local blocks of libraries that are loaded late,
  # as PoCL and the picture module are, and now and then crashes itself at the end of a sound run. use_sigaltstack: so
  # does AddressSanitizer where a thread of the OpenGL driver has a signal stack of its own.
  local asan=strict_string_checks=1:detect_stack_use_after_return=1:intercept_tls_get_addr=0:use_sigaltstack=0
  export ASAN_OPTIONS="$asan${ASAN_OPTIONS:+:$ASAN_OPTIONS}"
  local leaks=$root/tests/sanitizers/leak.supp
  export LSAN_OPTIONS="suppressions=$leaks:print_suppressions=0${LSAN_OPTIONS:+:$LSAN_OPTIONS}"
  export TSAN_OPTIONS="suppressions=$root/tests/sanitizers/thread.supp${TSAN_OPTIONS:+:$TSAN_OPTIONS}"
  export UBSAN_OPTIONS="print_stacktrace=1${UBSAN_OPTIONS:+:$UBSAN_OPTIONS}"
  # Warnings of kernels are errors where those of C++ are. PoCL alone reads this.
  [ "$preset" != ci ] || export POCL_EXTRA_BUILD_FLAGS=-Werror
  local status=0
  ctest --test-dir "$root/build/$preset" --output-on-failure --parallel 2 --no-tests=error "$@" || status=$?
  awk '/^\[=+\] Running [0-9]+ tests? from/ { ++suites; tests += $3 } /^\[  SKIPPED \] [0-9]+ test/ { skipped += $4 }
       END { printf "%d suites, of %d tests in all; %d were skipped\n", suites, tests, skipped }' \
    "$root/build/$preset/Testing/Temporary/LastTest.log" || true # there is none where ctest only listed
  return "$status"
}

phase install install_packages "${packages[@]}"
phase build prepare_build
say_phases
run_tests "$@"
