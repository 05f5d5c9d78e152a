#!/usr/bin/env bash
# SPDX-License-Identifier: Apache-2.0
# tests/packaging/bare.sh FOLDER, as root in a Debian with a window's tools and nothing of Nephroid: takes the .deb of
# FOLDER through its life. An older package is installed, this one over it; a preset is rendered, and opened as a file
# manager does; at last all is purged, and no file may be left. Needs what is installed below, and leaves a picture of
# the window in out/.
set -euo pipefail
deb=$(ls "$(readlink -f "$1")"/nephroid_*.deb)
export DEBIAN_FRONTEND=noninteractive LC_ALL=C.UTF-8 HOME=/root
apt=(apt-get -qq -o Dpkg::Use-Pty=0 --yes --no-install-recommends)
say() { printf '== %s\n' "$*"; }
fail() { printf 'FAILED: %s\n' "$*" >&2; exit 1; }
# What apt, dpkg and the dynamic linker keep for themselves is no file of a package.
files() {
  find / -xdev \( -path /proc -o -path /sys -o -path /dev -o -path /tmp -o -path /run -o -path /root \
    -o -path /var/cache -o -path /var/lib/apt \
    -o -path /var/lib/dpkg -o -path /var/log \) -prune -o -print | sort
}

"${apt[@]}" update
# adduser: apt of Debian 13 never takes it away again.
"${apt[@]}" install adduser xvfb xauth xdotool imagemagick xdg-utils libglib2.0-bin desktop-file-utils \
  shared-mime-info hicolor-icon-theme >/dev/null
work=$(mktemp -d)
cd "$work"
files >before

say "an older package, with a file that this one has no more"
dpkg-deb -R "$deb" older
sed -i 's/^Version: .*/Version: 0.0.9/' older/DEBIAN/control
echo '{}' >older/usr/share/nephroid/presets/gone.json
dpkg-deb --root-owner-group -b older older.deb >/dev/null
"${apt[@]}" install ./older.deb >/dev/null
"${apt[@]}" install "$deb" >/dev/null
dpkg-query -W nephroid
[ "$(dpkg-query -W -f '${Version}' nephroid)" = "$(dpkg-deb -f "$deb" Version)" ] ||
  fail "this version is not installed"
[ ! -e /usr/share/nephroid/presets/gone.json ] || fail "a file of the older package is left"
[ -z "$(dpkg -V nephroid)" ] || fail "files differ from the package's: $(dpkg -V nephroid)"

say "the command line"
nephroid version | head -n 1
nephroid devices
nephroid run first-light --passes 2 -o first-light
[ -s first-light/image.png ] || fail "there is no picture"
nephroid pictures inverse/words -o words.png >/dev/null # a font, and OpenImageIO

say "the file manager"
cp /usr/share/nephroid/presets/first-light.json mine.nephroid.json
cp mine.nephroid.json other.json
gio info -a standard::content-type mine.nephroid.json other.json | grep -v '^uri\|^attr\|^local'
type=application/vnd.nephroid.preset+json
[[ $(gio info -a standard::content-type mine.nephroid.json) == *$type ]] || fail "a preset is not known by its name"
[[ $(gio info -a standard::content-type other.json) != *$type ]] || fail "other JSON is taken for a preset"
[ "$(xdg-mime query default $type)" = org.nephroid.Nephroid.desktop ] || fail "a preset has no program"
cat >opened <<'IN_X'
gio open mine.nephroid.json
for i in $(seq 300); do
  window=$(xdotool search --onlyvisible --name mine | head -n 1) && [ -n "$window" ] && break
  sleep 1
done
sleep 15 # the picture in out/ is of a run that is under way
xdotool getwindowname "$window" | tee title
tr '\0' ' ' </proc/"$(xdotool getwindowpid "$window")"/cmdline; echo
import -window root window.png
process=$(xdotool getwindowpid "$window")
kill "$process"
while [ -e "/proc/$process" ]; do sleep 1; done
IN_X
xvfb-run -a -s '-screen 0 1280x800x24' bash opened
mkdir -p "$OLDPWD/out" && cp window.png first-light/image.png words.png "$OLDPWD/out"
grep -q mine title || fail "the window shows another preset"

say "purged"
"${apt[@]}" purge --autoremove nephroid >/dev/null
files >after
diff before after || fail "these files are left or gone"
echo "no file is left"
