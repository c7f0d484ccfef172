#!/bin/bash
# SPDX-License-Identifier: 0BSD
# planes_cli.sh: owc --planes and owsim --planes: a picture drawn from the planes is the one drawn
# from memory, in every order and shade, with threads; what does not fit or is none is refused.
set -euo pipefail
cd "$(dirname "$0")/../.."
O=${O:-build}
work=$(mktemp -d "${TMPDIR:-/tmp}/oldwell-planes.XXXXXX")
trap 'rm -rf "$work"' EXIT
failed=0

check() { # NAME CONDITION...
    if "${@:2}"; then
        echo "ok $1"
    else
        echo "not ok $1"
        failed=1
    fi
}

"$O/owgen" oldwell --detail low -o "$work/m.obj"
"$O/owc" "$work/m.obj" --normals compute -o "$work/m.owt" 2>"$work/log"
"$O/owc" "$work/m.obj" --normals compute --planes 160x120 -o "$work/m.pgm" 2>"$work/log"

bytes=$(stat -c %s "$work/m.owt")
check "the image is its head, the tree and zeros" \
    cmp -s "$work/m.pgm" <(printf 'P5\n160 120\n255\n'
        cat "$work/m.owt"
        head -c $((160 * 120 - bytes)) /dev/zero)

frames() { # FROM OPTION...: the checksum of some frames
    "$O/owsim" "$@" --orbit 5 --bench --passes 1 2>"$work/log" |
        sed -E 's/.*"crc32":([0-9]+).*/\1/'
}
for way in "--order front-to-back" "--order back-to-front" "--order scanline" "--shade gouraud" \
    "--shade phong --order back-to-front" "--shade lines" "--aa 4x4" "--threads 2" "--band 7"; do
    # shellcheck disable=SC2086 # several words
    check "$way: from planes as from memory" \
        test "$(frames "$work/m.pgm" --planes $way)" = \
        "$(frames "$work/m.owt" --size 160x120 $way)"
done
"$O/owsim" "$work/m.pgm" --planes --format rgb565 --dither -o "$work/a.ppm"
"$O/owsim" "$work/m.owt" --size 160x120 --format rgb565 --dither -o "$work/b.ppm"
check "16 planes of picture beside 8 of tree" cmp -s "$work/a.ppm" "$work/b.ppm"

refuses() { # NAME STATUS WORDS COMMAND...
    local status=0
    "${@:4}" >"$work/out" 2>"$work/err" || status=$?
    if [ $status = "$2" ] && grep -q "$3" "$work/err"; then
        echo "ok $1"
    else
        sed 's/^/# /' "$work/err"
        echo "not ok $1: status $status"
        failed=1
    fi
}
refuses "planes that are too small" 1 'hold 4096' \
    "$O/owc" "$work/m.obj" --planes 64x64 -o "$work/none.pgm"
check "nothing is written then" test ! -e "$work/none.pgm"
refuses "a tree that is no image" 1 'no whole plane image' \
    "$O/owsim" "$work/m.owt" --planes -o "$work/c.ppm"
head -c 15000 "$work/m.pgm" >"$work/short.pgm"
refuses "half an image" 1 'no whole plane image' \
    "$O/owsim" "$work/short.pgm" --planes -o "$work/c.ppm"
{ head -c 5000 "$work/m.pgm"; printf x; tail -c +5002 "$work/m.pgm"; } >"$work/bad.pgm"
refuses "a byte of the tree that is wrong" 1 'checksum' \
    "$O/owsim" "$work/bad.pgm" --planes -o "$work/c.ppm"
refuses "a picture of another size" 2 'the planes are 160x120' \
    "$O/owsim" "$work/m.pgm" --planes --size 320x240 -o "$work/c.ppm"
refuses "a format without room" 2 'leaves room' \
    "$O/owsim" "$work/m.pgm" --planes --format mono -o "$work/c.ppm"
exit $failed
