# SPDX-License-Identifier: Apache-2.0
# shellcheck shell=bash
# What run.sh, test.sh and .ci/run share: saying what happens, timing it by phase, configuring and building. Everything
# said goes to standard error, so that standard output is the program's alone. The sourcing script sets $root to the
# project's folder.

say() { printf 'nephroid: %s\n' "$*" >&2; }

# minutes SECONDS: prints M:SS.
minutes() { printf '%d:%02d' $(($1 / 60)) $(($1 % 60)); }

phases=()
# phase NAME COMMAND...: runs it and remembers how long it took; ends the script where it fails.
phase() {
  local name=$1 start=$SECONDS status=0
  shift
  # Run apart from the test of its status: `set -e` is off inside a tested command, and a failure half way would go on.
  set +e
  (set -e; "$@")
  status=$?
  set -e
  phases+=("$name $(minutes $((SECONDS - start)))")
  if [ "$status" -ne 0 ]; then
    say "failed to $name after $(minutes $((SECONDS - start)))"
    exit "$status"
  fi
}

# say_phases: one line with minutes:seconds by phase so far.
say_phases() {
  local line
  printf -v line '%s, ' "${phases[@]}"
  say "minutes:seconds by phase: ${line%, }; in all $(minutes "$SECONDS")"
}

# configure PRESET [-DNAME=VALUE...]: only where the preset's build folder is not configured with these values yet, or
# the presets changed; ninja itself looks after changed CMake files.
configure() {
  local preset=$1 folder=$root/build/$1 setting
  shift
  local needed=false
  [[ -f $folder/build.ninja && ! $root/CMakePresets.json -nt $folder/build.ninja ]] || needed=true
  for setting in "$@"; do
    setting=${setting#-D}
    grep -qsx "${setting%%=*}:[A-Z]*=${setting#*=}" "$folder/CMakeCache.txt" || needed=true
  done
  $needed || return 0
  say "configuring $folder"
  (cd "$root" && cmake --preset "$preset" "$@") >&2
}

# build PRESET [TARGET...]: ninja finds out what is out of date; what it says where nothing is, is left out.
build() {
  local folder=$root/build/$1
  shift
  cmake --build "$folder" ${1:+--target "$@"} |
    sed -u -e '/^ninja: /{/no work to do/d;/Entering directory/d}' \
      -e '/Re-checking globbed directories/d;/Checking the commit/d' >&2
}
