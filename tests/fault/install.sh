#!/bin/bash
# SPDX-License-Identifier: 0BSD
# install.sh: what make install puts where, that every board's settings are understood, and that
# unit and manual pages are well-formed where there are tools to say so.
set -uo pipefail
cd "$(dirname "$0")/../.." || exit
O=${O:-build}
root=$(mktemp -d "$O/install.XXXXXX")
trap 'rm -rf "$root"' EXIT
bad=0

verdict() { # NAME WHY: ok if WHY is empty
    if [ -z "$2" ]; then
        echo "ok $1"
    else
        echo "not ok $1: $2"
        bad=1
    fi
}

why=''
{ "$O/owgen" cubes -o "$root/cubes.obj" && "$O/owc" "$root/cubes.obj" -o "$root/cubes.owt"; } ||
    why="no tree can be made"
[ -e "$O/oldwell.owt" ] || cp "$root/cubes.owt" "$O/oldwell.owt"
make --no-print-directory O="$O" DESTDIR="$PWD/$root/tree" prefix=/usr install-linux-files \
    >"$root/log" 2>&1 || why="$(tail -n 1 "$root/log")"
verdict "make install with DESTDIR and prefix" "$why"

for file in bin/oldwell share/man/man1/oldwell.1 share/man/man5/oldwell-board.5 \
    share/oldwell/oldwell.owt share/oldwell/boards/fbdev/board.conf \
    lib/systemd/system/oldwell.service lib/sysusers.d/oldwell.conf \
    lib/udev/rules.d/70-oldwell.rules; do
    why=''
    [ -s "$root/tree/usr/$file" ] || why="it is not there"
    verdict "installed $file" "$why"
done
why=$(find "$root/tree" -perm /022 ! -type l | head -n 1)
verdict "nothing installed may be written by others" "$why"
why=''
grep -q '^ExecStart=/usr/bin/oldwell ' "$root/tree/usr/lib/systemd/system/oldwell.service" ||
    why="it does not start /usr/bin/oldwell"
verdict "the unit starts the installed program" "$why"

for board in boards/*/board.conf; do
    name=$(basename "$(dirname "$board")")
    why=''
    said=$("$O/oldwell" --board "boards/$name" "$root/none.owt" 2>&1)
    [[ $said == "oldwell: $root/none.owt: cannot read"* ]] || why=$said
    grep -q '^Not measured on hardware' "boards/$name/README.md" ||
        why+=" its README does not say whether it was measured"
    verdict "board $name" "$why"
done

if command -v systemd-analyze >/dev/null; then
    mkdir -p "$root/tree/bin" && cp /bin/true "$root/tree/bin/kill"
    said=$(systemd-analyze verify --man=no --root="$root/tree" oldwell.service 2>&1)
    verdict "the unit is well-formed" "$said"
fi
if command -v man >/dev/null && command -v groff >/dev/null; then
    for page in docs/man/*; do
        verdict "$page" "$(man --warnings -l "$page" 2>&1 >/dev/null)"
    done
fi
exit $bad
