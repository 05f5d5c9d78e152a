#!/usr/bin/env bash
# SPDX-License-Identifier: Apache-2.0
# tests/fuzz/run.sh [SECONDS [NAME...]] fuzzes each harness of build/fuzz for so many seconds (default: 60), two at a
# time, and says executions and findings. Inputs that reach something new are kept in build/fuzz/corpus/NAME, findings
# in build/fuzz/findings. Fails where there is a finding; `build/fuzz/tests/fuzz/fuzz_NAME FILE` repeats it.
set -euo pipefail
root=$(dirname "$(dirname "$(dirname "$(readlink -f "${BASH_SOURCE[0]}")")")")
build=$root/build/fuzz
seconds=${1:-60}
names=("${@:2}")
if [ ${#names[@]} -eq 0 ]; then
  for file in "$root"/tests/fuzz/*_fuzz.cpp; do
    file=${file##*/}
    names+=("${file%_fuzz.cpp}")
  done
fi

# OpenCL drivers and libraries that are loaded late, as in test.sh; what a library never gives back is no finding.
ASAN_OPTIONS=strict_string_checks=1:detect_stack_use_after_return=1:intercept_tls_get_addr=0
export ASAN_OPTIONS=$ASAN_OPTIONS:use_sigaltstack=0:detect_leaks=0
export UBSAN_OPTIONS=print_stacktrace=1
export build seconds
mkdir -p "$build/corpus" "$build/findings" "$build/logs"
# The words that a preset may hold.
grep -o '"[A-Za-z_$][A-Za-z_$]*"' "$root/presets/schema.json" | sort -u >"$build/words"

fuzz() {
  local name=$1 program=$build/tests/fuzz/fuzz_$1 corpus=$build/corpus/$1 log=$build/logs/$1
  TMPDIR=$(mktemp -d)
  export TMPDIR
  local flags=(-max_total_time="$seconds" -timeout=30 -rss_limit_mb=2048 -malloc_limit_mb=1024 -print_final_stats=1
    -max_len=65536
    -artifact_prefix="$build/findings/$name-")
  [ "$name" = gltf ] || [ "$name" = preset ] || [ "$name" = session ] && flags+=(-dict="$build/words")
  "$program" --seeds="$corpus" >"$log" 2>&1 && "$program" "${flags[@]}" "$corpus" >>"$log" 2>&1
  local status=$?
  if [ "$status" -eq 0 ] && [ "$seconds" -gt 60 ]; then # of a corpus that will be fuzzed on
    mkdir "$TMPDIR/merged"
    "$program" -merge=1 -timeout=30 -rss_limit_mb=2048 "$TMPDIR/merged" "$corpus" >"$log-merge" 2>&1 &&
      rm -rf "$corpus" && mv "$TMPDIR/merged" "$corpus"
  fi
  rm -rf "$TMPDIR"
  local executions
  executions=$(sed -n 's/^stat::number_of_executed_units: *//p' "$log")
  if [ "$status" -eq 0 ]; then
    printf 'fuzz %-11s %9s executions\n' "$name" "${executions:-0}"
  else
    printf 'fuzz %-11s a finding after %s executions:\n%s\n' "$name" "${executions:-?}" \
      "$(grep -vE '^#[0-9]+[[:space:]]|^(INFO|stat):' "$log" | tail -n 60)"
    return 1
  fi
}
export -f fuzz
# shellcheck disable=SC2016 # its own shell has $1
printf '%s\n' "${names[@]}" | xargs -P 2 -I{} bash -c 'fuzz "$1"' fuzz {}
