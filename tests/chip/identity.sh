#!/bin/bash
# SPDX-License-Identifier: 0BSD
# identity.sh: the same trees and views give the same frame bytes on this machine, on arm64 and on
# the boards; and the instructions that the Cortex-M3 takes for them stay near those noted here.
# INSTRUCTIONS_UPDATE=1 writes them anew: look at the difference before you keep it.
set -euo pipefail
cd "$(dirname "$0")/../.."
. tests/chip/qemu.bash
margin=3 # per cent; a compiler of another release needs the file anew
notes=tests/chip/instructions.txt
trees=("$O/chip/oldwell.owt" "$O/chip/smooth.owt")

build() { # WHAT...
    make -s "O=$O" "$@" >"$work/make" 2>&1 || {
        not_ok "building $*" "$(tail -n 5 "$work/make")"
        exit 1
    }
}

# same NAME FILE: a machine's lines are the host's.
same() {
    sed -E 's/\r//; s/ units .*//' "$2" | grep '^scene' >"$work/lines" || true
    if cmp -s "$work/lines" "$work/host"; then
        ok "the frames of $1 are this machine's, $(wc -l <"$work/host") scenes"
    else
        diff "$work/lines" "$work/host" | sed 's/^/# /' || true
        not_ok "the frames of $1 are this machine's" "see above"
    fi
}

build chip-tools
"$O/tests/scenes" "${trees[@]}" >"$work/host"
if grep -q failed "$work/host"; then not_ok "every scene can be drawn" "$(cat "$work/host")"; fi
sim=$("$O/owsim" "${trees[0]}" --orbit 8 --size 320x240 --format rgb565 --bench --passes 1 |
    sed -E 's/.*"crc32":([0-9]+).*/\1/')
if grep -qx "scene tft frames 8 crc32 $sim" "$work/host"; then
    ok "a scene is what owsim draws"
else
    not_ok "a scene is what owsim draws" "owsim: $sim, $(grep '^scene tft ' "$work/host")"
fi

scripts/m3-scenes "$O" >"$work/m3" 2>"$work/m3-errors" || true
same "Cortex-M3" "$work/m3"
scripts/m3-scenes "$O" planes >"$work/m3-planes" 2>"$work/m3-errors" || true
same "Cortex-M3 that reads bit planes" "$work/m3-planes"

build BOARD=raspi2b "$O/scenes-raspi2b.elf"
qemu_start raspi2b "$O/scenes-raspi2b.elf"
hear end 60 || true
qemu_stop
same "Cortex-A7" "$work/said"
qemu_clean "no guest error on the Cortex-A7"

if [ "$(uname -m)" = aarch64 ]; then
    ok "this machine is an arm64"
elif ! command -v aarch64-linux-gnu-gcc >/dev/null || ! command -v qemu-aarch64 >/dev/null; then
    echo "skip arm64: no compiler or emulator"
else
    build "O=$O/arm64-static" CC='aarch64-linux-gnu-gcc -static' "$O/arm64-static/tests/scenes"
    qemu-aarch64 "$O/arm64-static/tests/scenes" "${trees[@]}" >"$work/arm64" || true
    same arm64 "$work/arm64"
fi

sed -E 's/\r//; /^scene/!d; s/^scene ([^ ]*) .* units (.*)/\1 \2/' "$work/m3" >"$work/instructions"
if [ "${INSTRUCTIONS_UPDATE:-0}" = 1 ]; then
    { grep '^#' $notes && cat "$work/instructions"; } >"$work/notes"
    cp "$work/notes" $notes
fi
while read -r name noted; do
    got=$(sed -n "s/^$name //p" "$work/instructions")
    if [ -n "$got" ] && awk -v a="$got" -v b="$noted" -v m=$margin \
        'BEGIN { exit !(a <= b * (1 + m / 100) && a >= b * (1 - m / 100)) }'; then
        ok "$name: $got instructions a frame, $noted noted"
    else
        not_ok "$name: $got instructions a frame, $noted noted" "more than $margin % away"
    fi
done < <(grep -v '^#' $notes)
exit $failed
