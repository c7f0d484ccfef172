#!/bin/bash
# SPDX-License-Identifier: 0BSD
# equal.sh [--all]: one picture, whoever draws it. 16 views of each scene, each shade and size, by
# painter, dynamic screen (bits and segments) and priority scan line; whole by 1, 2 and 3 threads;
# in bands of 64, 8 and 1 lines: all give one checksum. What front to back writes is each pixel of
# the model once: counted against the painter's pictures on two backgrounds.
# Without --all: three scenes at 320x240, 12 s. With it (make equal): nine scenes at 320x240
# and 1500x1500, about 20 minutes; at 1500x1500 bands of one line draw 2 views.
# ONLY: a pattern for the scenes' names.
set -uo pipefail
cd "$(dirname "$0")/../.." || exit 2
[ "${GOLDEN_UPDATE:-0}" = 0 ] || exit 0
O=${O:-build}
work=$(mktemp -d "${TMPDIR:-/tmp}/oldwell-equal.XXXXXX")
trap 'rm -rf "$work"' EXIT
all=0
[ "${1:-}" = --all ] && all=1
failed=0
orders=("--order back-to-front" "--order front-to-back --unlit bits"
    "--order front-to-back --unlit segments" "--order scanline")

# draw OPTION...: crc32, pixels written, pixels background of the tree's views.
draw() {
    "$O/owsim" "$work/tree.owt" "$@" --passes 1 --bench |
        sed -E 's/.*"pixels_written":([0-9]+),"pixels_background":([0-9]+).*"crc32":([0-9]+).*/\3 \1 \2/'
}

# agree NAME EXPECTED OPTION...: the checksum must be that, or bad is set; leaves the counts in
# written and unlit.
agree() {
    local name=$1 expected=$2 crc=''
    shift 2
    read -r crc written unlit < <(draw "$@")
    if [ -z "$crc" ] || [ "$crc" != "$expected" ]; then
        echo "not ok $name: checksum $crc, not $expected, with $*"
        bad=1
        return 1
    fi
}

# background SIZE: pixels that show no model, seen by the painter on two backgrounds.
background() {
    local options=(--order back-to-front --orbit 16 --size "$1")
    rm -rf "$work/black" "$work/white"
    mkdir "$work/black" "$work/white"
    "$O/owsim" "$work/tree.owt" "${options[@]}" --background 000000 -o "$work/black/%02d.ppm" &&
        "$O/owsim" "$work/tree.owt" "${options[@]}" --background ffffff -o "$work/white/%02d.ppm" \
            --compare "$work/black" --diff-dir "$work/black" 2>/dev/null |
        awk '/pixels differ/ { sum += $2 } END { printf "%d\n", sum }'
    rm -rf "$work/black" "$work/white"
}

# count NAME EXPECTED PIXELS: what was written and what was not make all pixels, each once.
count() {
    if [ "$unlit" != "$2" ] || [ $((written + unlit)) != "$3" ]; then
        echo "not ok $1: $written pixels written, $unlit left, of $3; $2 show no model"
        bad=1
    fi
}

# equal NAME SIZE SHADE EMPTY: all ways to draw the tree at hand.
equal() {
    local name="$1 $2 $3" size=$2 order lines threads crc few pixels bad=0 begin=$SECONDS
    local options=(--orbit 16 --size "$size" --shade "$3")
    pixels=$((${size%x*} * ${size#*x} * 16))
    read -r crc _ < <(draw "${options[@]}" --order back-to-front)
    for order in "${orders[@]}"; do
        # shellcheck disable=SC2086 # options and values
        for threads in 1 2 3; do
            agree "$name" "$crc" "${options[@]}" $order --threads $threads || continue
            [[ $order == *back-to-front ]] || count "$name, $order" "$4" "$pixels"
        done
        # shellcheck disable=SC2086
        for lines in 64 8; do
            agree "$name" "$crc" "${options[@]}" $order --panel write --band $lines
        done
        few=("${options[@]}")
        [ "$size" = 320x240 ] || few[1]=2
        # shellcheck disable=SC2086
        agree "$name" "$(draw "${few[@]}" --order back-to-front | cut -d ' ' -f 1)" "${few[@]}" \
            $order --panel write --band 1
    done
    if [ $bad = 0 ]; then
        echo "ok $name: crc32 $crc, $((SECONDS - begin)) s"
    fi
    failed=$((failed | bad))
}

# scene NAME MODEL SIZE...: compiles and draws.
scene() {
    local name=$1 model=$2 size shade empty
    shift 2
    # shellcheck disable=SC2053 # a pattern is meant
    [[ $name == ${ONLY:-*} ]] || return 0
    if ! "$O/owc" "$model" --normals compute --crease 50 -o "$work/tree.owt" 2>"$work/said"; then
        echo "not ok $name: $(head -n 1 "$work/said")"
        failed=1
        return
    fi
    for size in "$@"; do
        empty=$(background "$size")
        for shade in flat gouraud phong; do
            equal "$name" "$size" $shade "$empty"
        done
    done
}

# generated NAME SIZES OPTION...: a model of owgen's.
generated() {
    local name=$1 sizes=$2
    shift 2
    "$O/owgen" "$@" -o "$work/model.obj" || failed=1
    # shellcheck disable=SC2086 # the sizes are words
    scene "$name" "$work/model.obj" $sizes
}

sizes=320x240
[ $all = 1 ] && sizes="320x240 1500x1500"
generated oldwell "$sizes" oldwell --detail high
generated klein "$sizes" klein
if [ $all = 0 ]; then
    generated random "$sizes" random --count 60 --size 500 --seed 1
else
    generated cubes "$sizes" cubes
    generated house "$sizes" house
    generated random "$sizes" random --count 500 --size 500 --seed 1
    generated parallel "$sizes" parallel --count 10000 --size 500 --seed 1
    for name in cow teapot stanford-bunny; do
        if [ -e ../shared/models/$name.obj ]; then
            # shellcheck disable=SC2086 # the sizes are words
            scene $name ../shared/models/$name.obj $sizes
        else
            echo "skip $name: models outside the repository (../shared/models)"
        fi
    done
fi
[ $failed = 0 ]
