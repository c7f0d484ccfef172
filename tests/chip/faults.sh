#!/bin/bash
# SPDX-License-Identifier: 0BSD
# faults.sh: a program that does what it must not is stopped by the memory map or the watchdog,
# the serial port says where, and the chip starts again.
set -euo pipefail
cd "$(dirname "$0")/../.."
. tests/chip/qemu.bash
board=lm3s6965evb
make -s BOARD=$board "O=$O" "$O/scenes-$board.elf" >"$work/make" 2>&1 || {
    not_ok "the scenes build" "$(tail -n 5 "$work/make")"
    exit 1
}

# fault WORD PATTERN NAME: the program is told to do WORD; a line like PATTERN, then it starts anew.
fault() {
    qemu_start $board "$O/scenes-$board.elf" \
        -semihosting-config "enable=on,target=native,arg=scenes,arg=$1"
    if hear "Oldwell's scenes*" && hear "$2" && hear restart && hear "Oldwell's scenes*"; then
        ok "$3"
    else
        not_ok "$3" "see above"
    fi
    qemu_stop
    if grep -q 'still here' "$work/said"; then not_ok "$3: it is stopped" "it went on"; fi
}

fault fault 'FAULT cfsr 00000082 * mmfar 60000000 *' "reading where nothing is"
fault flash 'FAULT cfsr 00000082 * mmfar 00000100 *' "writing to flash"
fault execute 'FAULT cfsr 00000001 *' "running data"
fault stack ' the stack has overflowed' "a stack that overflows"
fault hang 'the watchdog was not fed' "a program that hangs"

# The registers are those of the instruction: the pc lies in main.
qemu_start $board "$O/scenes-$board.elf" \
    -semihosting-config enable=on,target=native,arg=scenes,arg=fault
hear 'FAULT*' && hear '* pc *'
qemu_stop
pc=$((0x$(sed -E 's/.* pc ([0-9a-f]{8}).*/\1/' <<<"$heard")))
read -r from size < <(arm-none-eabi-nm -S "$O/scenes-$board.elf" |
    awk '$4 == "main" { print "0x" $1, "0x" $2 }')
if [ $pc -ge $((from)) ] && [ $pc -lt $((from + size)) ]; then
    ok "the program counter that is printed is where it happened"
else
    not_ok "the program counter that is printed is where it happened" "$pc, main at $from"
fi
exit $failed
