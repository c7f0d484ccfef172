#!/bin/bash
# SPDX-License-Identifier: 0BSD
# raspi2b.sh: the board with a frame buffer and four cores, in QEMU, shows what owsim draws, pixel
# for pixel, over a whole turn, in 32 and in 16 bits a pixel.
set -euo pipefail
cd "$(dirname "$0")/../.."
. tests/chip/qemu.bash
board=raspi2b

# turn FORMAT BITS WIDTH HEIGHT: a turn of 72 views.
turn() {
    local format=$1 bits=$2 width=$3 height=$4 view name differ=0
    name="a turn at ${width}x$height in $format is the simulator's"
    if ! make -s "O=$O" BOARD=$board FRAME_BITS="$bits" FRAME_WIDTH="$width" \
        FRAME_HEIGHT="$height" board chip-tools >"$work/make" 2>&1; then
        not_ok "$name" "$(tail -n 5 "$work/make")"
        return
    fi
    "$O/owsim" "$O/chip/oldwell.owt" --orbit 72 --size "${width}x$height" --format "$format" \
        -o "$work/sim-%04d.ppm"
    qemu_start $board "$O/oldwell-$board.elf"
    hear 'Oldwell on*' && hear 'memory*'
    tell 'sb'
    for view in $(seq 0 71); do
        [ "$view" = 0 ] || tell n
        hear "stopped:* view $view *" || break
        look "$work/panel.ppm" 1 "$format"
        cmp -s "$work/panel.ppm" "$work/$(printf 'sim-%04d.ppm' "$view")" || differ=$((differ + 1))
    done
    if [ "$view" = 71 ] && [ $differ = 0 ]; then
        ok "$name"
    else
        not_ok "$name" "view $view, $differ differ"
    fi
    tell 'g?'
    hear 'memory*'
    echo "# $heard"
    qemu_stop
    qemu_clean "no guest error in $format"
}

turn rgb565 16 320 240
turn xrgb8888 32 640 480
exit $failed
