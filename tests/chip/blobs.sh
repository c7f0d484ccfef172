#!/bin/bash
# SPDX-License-Identifier: 0BSD
# blobs.sh: a tree in flash that is wrong, missing or too large for the chip: the panel and the
# serial port say why, and the loop lives on and takes a new tree; and so with trees that arrive
# wrong, short or too large.
set -euo pipefail
cd "$(dirname "$0")/../.."
. tests/chip/qemu.bash
board=lm3s6965evb
make -s BOARD=$board "O=$O" board chip-tools >"$work/make" 2>&1 || {
    not_ok "$board builds" "$(tail -n 5 "$work/make")"
    exit 1
}
good=$O/chip/oldwell.owt
other=$O/chip/smooth.owt
bytes=$(stat -c %s "$good")

# with FILE ELF: the board's program with these bytes, of the same number, as its tree.
with() {
    arm-none-eabi-objcopy --update-section ".tree=$1" "$O/oldwell-$board.elf" "$2"
}

# flip AT FILE OUT: inverts a byte.
flip() {
    cp "$2" "$3"
    local byte
    byte=$(od -An -tu1 -j "$1" -N1 "$2")
    # shellcheck disable=SC2059
    printf "\\x$(printf %x $((byte ^ 255)))" | dd of="$3" bs=1 seek="$1" conv=notrunc status=none
}

# text FILE: what the host says of a tree.
text() {
    "$O/owsim" "$1" --bench --passes 1 2>&1 >"$work/nothing" |
        sed -E 's/^owsim: [^:]*: //; s/, (compile|copy).*//'
}

# says NAME WHAT TEXT: serial port and panel say TEXT of WHAT.
says() {
    local shown wanted
    wanted=$(tr 'a-z\n' 'A-Z ' <<<"$2: $3" | sed 's/  *$//')
    hear "error: $2: $3" 10 || { not_ok "$1" "the serial port does not say '$3'" && return; }
    look "$work/panel.ppm" 4
    shown=$("$O/tests/read_message" <"$work/panel.ppm" | tr '\n' ' ' | sed 's/  *$//')
    if [ "$shown" = "$wanted" ]; then
        ok "$1: $3"
    else
        not_ok "$1: $3" "the panel says: $shown"
    fi
}

# takes FILE NAME: a tree that is sent now is shown.
takes() {
    tell s
    cat "$1" >&3
    if ! hear "stopped: frame 1 view 0 *"; then not_ok "$2" "it is not shown" && return; fi
    look "$work/panel.ppm" 4
    "$O/owsim" "$1" --orbit 72 --size 128x64 --format gray4 --background 000000 -o "$work/s%d.ppm"
    if cmp -s "$work/panel.ppm" "$work/s0.ppm"; then ok "$2"; else not_ok "$2" "another picture"; fi
}

# A byte wrong: of each of the header's first fields, of nodes, polygons, vertices, and the last.
last=$((bytes - 1))
for at in 0 4 8 12 16 40 130 $((bytes / 3)) $((bytes / 2)) $((bytes * 3 / 4)) $last; do
    flip "$at" "$good" "$work/bad.owt"
    with "$work/bad.owt" "$work/bad.elf"
    qemu_start $board "$work/bad.elf"
    says "byte $at of the tree in flash is wrong" "built-in tree" "$(text "$work/bad.owt")"
    [ "$at" != $last ] || takes "$other" "a tree over the serial port is shown instead"
    qemu_stop
done

head -c "$bytes" /dev/zero | tr '\0' '\377' >"$work/none.owt"
with "$work/none.owt" "$work/bad.elf"
qemu_start $board "$work/bad.elf"
says "no tree in flash" "built-in tree" "$(text "$work/none.owt")"
takes "$other" "a tree over the serial port is shown instead of none"
qemu_stop

# A polygon of 250 corners wants more memory than there is.
awk 'BEGIN { for (i = 0; i < 250; i++) { a = i * 8 * atan2(1, 1) / 250; print "v", cos(a), sin(a), 0 }
    printf "f"; for (i = 1; i <= 250; i++) printf " %d", i; print "" }' >"$work/disc.obj"
"$O/owc" "$work/disc.obj" --sides two -o "$work/disc.owt" 2>/dev/null
make -s BOARD=$board "O=$O" "TREE=$work/disc.owt" board >"$work/make" 2>&1
qemu_start $board "$O/oldwell-$board.elf"
says "a tree in flash that is too large" "built-in tree" "the memory given is too small"
takes "$other" "a smaller tree over the serial port is shown"
qemu_stop
make -s BOARD=$board "O=$O" board >"$work/make" 2>&1

# What can go wrong on the line.
qemu_start $board "$O/oldwell-$board.elf"
hear 'memory*'
head -c 9000 "$other" >&3
says "a tree that stops coming" "received tree" "the tree is cut short"
flip 9000 "$other" "$work/bad.owt"
cat "$work/bad.owt" >&3
says "a byte changed on the line" "received tree" "$(text "$work/bad.owt")"
{ head -c 12 "$other" | head -c 8; printf '\377\377\377\0'; tail -c +13 "$other"; } >&3
says "a tree larger than its memory" "received tree" "the memory given is too small"
printf 'noise\177OW\177' >&3
takes "$other" "after all that, and noise, the next tree is shown"
tell 'gb'
if hear 'tree bytes '"$bytes"' *'; then
    ok "the built-in tree comes back by command"
else
    not_ok "the built-in tree comes back by command" "see above"
fi
qemu_stop
qemu_clean "no guest error"
exit $failed
