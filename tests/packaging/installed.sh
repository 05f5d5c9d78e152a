#!/usr/bin/env bash
# SPDX-License-Identifier: Apache-2.0
# tests/packaging/installed.sh BUILD CMAKE installs into a folder, moves it, and runs the program from there: it must
# find its presets, materials, mesh reader and picture module beside itself. Then the desktop's files are validated,
# where the tools are there.
set -euo pipefail
build=$1 cmake=$2
work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT
fail() { echo "FAILED: $*" >&2; exit 1; }

"$cmake" --install "$build" --prefix "$work/first" >/dev/null
mv "$work/first" "$work/a place of its own"
at="$work/a place of its own"
program=$at/bin/nephroid
cd "$work"
unset NEPHROID_PRESETS

"$program" presets --json >presets.json
[ "$(grep -c "$at/bin/../share/nephroid/presets\|$at/share/nephroid/presets" presets.json)" -gt 0 ] ||
  fail "presets are not its own: $(head -c 300 presets.json)"
"$program" dispersion N-BK7 --nm 587.56 | grep -q 1.5168 || fail "N-BK7 has another index"
cp "$at/share/nephroid/presets/environment/ring.obj" .
cat >mine.nephroid.json <<'IN'
{ "parent": "environment/ring" }
IN
"$program" plan mine.nephroid.json >/dev/null || fail "a mesh is not read"
"$program" pictures inverse/words -o words.png >/dev/null || fail "no picture is written"
[ -s words.png ] || fail "there is no picture"

# The files that a desktop and a shell look for.
share=$at/share
for file in man/man1/nephroid.1.gz bash-completion/completions/nephroid zsh/site-functions/_nephroid \
  fish/vendor_completions.d/nephroid.fish \
  doc/nephroid/README.md; do
  [ -s "$share/$file" ] || fail "$file is missing"
done
ls "$share"/doc/nephroid*/copyright "$share"/doc/nephroid*/changelog.gz >/dev/null
# DESTDIR goes before an absolute prefix.
DESTDIR=$work/stage "$cmake" --install "$build" --prefix /usr >/dev/null
[ -s "$work/stage/usr/share/zsh/vendor-completions/_nephroid" ] || fail "Debian's zsh does not find its completions"
asked=()
if [ -d "$share/applications" ]; then
  if command -v desktop-file-validate >/dev/null; then
    asked+=(desktop-file-validate)
    desktop-file-validate "$share"/applications/*.desktop
  fi
  if command -v appstreamcli >/dev/null; then
    asked+=(appstreamcli)
    appstreamcli validate --no-net "$share"/metainfo/*.xml
  fi
  if command -v update-mime-database >/dev/null; then
    asked+=(update-mime-database)
    update-mime-database "$share/mime" >/dev/null
    grep -qx 'application/vnd.nephroid.preset+json:\*.nephroid.json' "$share/mime/globs" ||
      fail "the type of presets is unknown"
  fi
  for word in "Icon=nephroid" "Exec=nephroid %F"; do
    grep -qx "$word" "$share"/applications/*.desktop || fail "$word"
  done
  [ -s "$share/icons/hicolor/scalable/apps/nephroid.svg" ] || fail "there is no icon"
fi
echo "asked: ${asked[*]:-no validator is here}"
