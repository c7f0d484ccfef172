#!/bin/bash
# SPDX-License-Identifier: 0BSD
# planes.sh: trees in the spare bit planes of the frame buffer, on the board and on this machine:
# 10,000 polygons in 512 x 512 planes, where [FAG83] had about 5,000; a turn is the simulator's,
# and the tree's bytes in video memory are what they were after it.
set -euo pipefail
cd "$(dirname "$0")/../.."
. tests/chip/qemu.bash
board=raspi2b-planes

# ball U V: a bumpy ball of about 2UV triangles.
ball() {
    awk -v U="$1" -v V="$2" 'BEGIN {
        pi = atan2(0, -1); N = (V - 1) * U + 1
        for (j = 1; j < V; j++) for (i = 0; i < U; i++) {
            t = pi * j / V; p = 2 * pi * i / U; r = 1 + 0.12 * sin(7 * p) * sin(t) * sin(6 * t)
            print "v", r * sin(t) * cos(p), r * cos(t), r * sin(t) * sin(p)
        }
        print "v 0 1 0\nv 0 -1 0"
        for (i = 0; i < U; i++) {
            a = i + 1; b = (i + 1) % U + 1; print "f", N, b, a
            for (j = 0; j < V - 2; j++) {
                c = a + U; d = b + U; print "f", a, b, c; print "f", b, d, c; a = c; b = d
            }
            print "f", a, b, N + 1
        }
    }'
}

# top MODEL COUNT: its COUNT highest triangles.
top() {
    grep '^v ' "$1"
    awk '/^v / { y[++n] = $3 } /^f / { print y[$2 + 0] + y[$3 + 0] + y[$4 + 0], $0 }' "$1" |
        sort -gr | awk -v n="$2" 'NR <= n { sub(/^[^ ]* /, ""); print }'
}

# holds NAME MODEL [OPTION...]: 10,000 polygons of it fit, and are drawn from the planes.
holds() {
    local name=$1 polygons
    shift
    "$O/owc" "$@" --planes 512x512 --stats "$work/stats" -o "$work/big.pgm" 2>"$work/owc"
    "$O/owc" "$@" -o "$work/big.owt" 2>"$work/owc"
    polygons=$(sed -nE 's/.*"output_polygons":[^0-9]*([0-9]+).*/\1/p' "$work/stats")
    if [ "$polygons" -lt 10000 ]; then
        not_ok "$name: 10,000 polygons" "only $polygons"
        return
    fi
    "$O/owsim" "$work/big.pgm" --planes --orbit 3 -o "$work/a%d.ppm"
    "$O/owsim" "$work/big.owt" --size 512x512 --orbit 3 -o "$work/b%d.ppm"
    if cmp -s "$work/a0.ppm" "$work/b0.ppm" && cmp -s "$work/a2.ppm" "$work/b2.ppm"; then
        ok "$name: $polygons polygons, $(stat -c %s "$work/big.owt") of 262144 bytes, drawn in place"
    else
        not_ok "$name: $polygons polygons drawn in place" "another picture than from memory"
    fi
}

make -s "O=$O" programs chip-tools >"$work/make" 2>&1
if [ -e ../shared/models/stanford-bunny.obj ]; then
    top ../shared/models/stanford-bunny.obj 9800 >"$work/part.obj"
    holds "part of the bunny" "$work/part.obj" --sides one
else
    echo "skip part of the bunny: models outside the repository"
fi
ball 104 50 >"$work/ball.obj"
holds "a bumpy ball" "$work/ball.obj"

# The ball on the board.
if ! make -s "O=$O" BOARD=$board FRAME_WIDTH=512 FRAME_HEIGHT=512 FRAME_BITS=32 \
    "TREE=$work/big.owt" board >"$work/make" 2>&1; then
    not_ok "$board builds" "$(tail -n 5 "$work/make")"
    exit 1
fi
views=12
"$O/owsim" "$work/big.pgm" --planes --orbit 72 -o "$work/sim-%04d.ppm"
qemu_start raspi2b "$O/oldwell-$board.elf"
hear 'Oldwell on*' && hear 'memory*'
tell 'sb'
differ=0
for view in $(seq 0 $((views - 1))); do
    [ "$view" = 0 ] || tell n
    hear "stopped:* view $view *" || break
    look "$work/panel.ppm"
    cmp -s "$work/panel.ppm" "$work/$(printf 'sim-%04d.ppm' "$view")" || differ=$((differ + 1))
done
if [ "$view" = $((views - 1)) ] && [ $differ = 0 ]; then
    ok "the board draws them from its frame buffer as the simulator does, $views views"
else
    not_ok "the board draws them from its frame buffer" "view $view, $differ differ"
fi
# On through the turn, then every fourth byte of video memory.
tell g
sleep 4
tell 's?'
hear 'shows frame*'
echo "# $heard"
qmp '{"execute":"pmemsave","arguments":{"val":'"$((0x$(sed -n "s/^frame buffer //p" "$work/said")))"',
    "size":1048576,"filename":"'"$work/video"'"}}' || true
bytes=$(stat -c %s "$work/big.owt")
od -An -v -tx1 -w4 "$work/video" | awk -v n="$bytes" 'NR <= n { print $4 }' >"$work/planes.hex"
od -An -v -tx1 -w1 "$work/big.owt" | tr -d ' ' >"$work/tree.hex"
if cmp -s "$work/planes.hex" "$work/tree.hex"; then
    ok "the tree in video memory is what it was"
else
    not_ok "the tree in video memory is what it was" "its bytes differ"
fi
tell 'g'
cat "$O/chip/oldwell.owt" >&3
if hear "tree bytes $(stat -c %s "$O/chip/oldwell.owt") *"; then
    ok "a tree that is sent goes into the planes"
else
    not_ok "a tree that is sent goes into the planes" "see above"
fi
qemu_stop
qemu_clean "no guest error"
exit $failed
