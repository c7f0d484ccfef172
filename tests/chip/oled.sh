#!/bin/bash
# SPDX-License-Identifier: 0BSD
# oled.sh: the Cortex-M3 board in QEMU shows what owsim draws, pixel for pixel: one turn of the
# Old Well, with buttons pressed on the way; then what memory it took.
set -euo pipefail
cd "$(dirname "$0")/../.."
. tests/chip/qemu.bash
board=lm3s6965evb
make -s BOARD=$board "O=$O" board chip-tools >"$work/make" 2>&1 || {
    not_ok "$board builds" "$(tail -n 5 "$work/make")"
    exit 1
}

# The same buttons at the same views, by owsim's script: times in us, a view each 50 ms.
cat >"$work/script" <<'END'
505000 right press
505001 right release
506000 right press
506001 right release
507000 up press
507001 up release
508000 down press
508001 down release
509000 left press
509001 left release
510000 select press
510001 select release
END
buttons=(right right up down left ctrl) # between views 10 and 11
"$O/owsim" "$O/chip/oldwell.owt" --orbit 72 --size 128x64 --format gray4 --background 000000 \
    --interval 50 --script "$work/script" -o "$work/sim-%04d.ppm"

frames=0 differ=0
compare() { # the panel with the simulator's next frame
    local sim
    sim=$(printf '%s/sim-%04d.ppm' "$work" $frames)
    look "$work/panel.ppm" 4
    if ! cmp -s "$work/panel.ppm" "$sim"; then
        differ=$((differ + 1))
        echo "# frame $frames differs"
    fi
    frames=$((frames + 1))
}

qemu_start $board "$O/oldwell-$board.elf"
hear 'Oldwell on*'
hear 'memory*'
# QEMU's buttons are pressed until each has been released once.
for b in up down left right ctrl; do
    key $b true
    key $b false
done
sleep 0.3
tell 'sb'
hear 'stopped: frame 1 view 0 *'
compare
for view in $(seq 1 71); do
    tell n
    hear "stopped:* view $view *"
    compare
    if [ "$view" = 10 ]; then
        for b in "${buttons[@]}"; do
            key "$b" true
            hear "stopped:* view 10 *"
            key "$b" false
            compare
            sleep 0.1 # longer than the board takes to see the release
        done
    fi
done
expected=("$work"/sim-*.ppm)
if [ $differ = 0 ] && [ $frames = ${#expected[@]} ]; then
    ok "$frames frames of the OLED are the simulator's, buttons included"
else
    not_ok "$frames frames of the OLED are the simulator's, buttons included" \
        "$differ differ, the simulator has ${#expected[@]}"
fi
tell 'g?'
hear 'memory*'
stack=$(sed -E 's/.* stack ([0-9]+) of ([0-9]+).*/\1 \2/' <<<"$heard")
echo "# $heard"
if [ "${stack% *}" -lt "${stack#* }" ]; then
    ok "the stack's high-water mark: ${stack% *} of ${stack#* } bytes"
else
    not_ok "the stack's high-water mark" "$stack"
fi
qemu_stop
qemu_clean "no guest error, no unknown command of the panel"
exit $failed
