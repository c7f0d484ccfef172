#!/bin/bash
# SPDX-License-Identifier: 0BSD
# golden.sh: draws the golden scenes and compares the checksums of their frames with crc32.txt.
# Each scene is drawn in both orders and in bands: all must agree. A scene without an entry fails,
# an entry without a scene too. A failing scene leaves its frames in $O/golden.
# GOLDEN_UPDATE=1 (make golden-update) writes crc32.txt anew.
set -euo pipefail
cd "$(dirname "$0")/../.."
O=${O:-build}
file=tests/golden/crc32.txt
dir=$O/golden
new=$dir/crc32.txt
bad=0
mkdir -p "$dir"

# NAME: owgen's arguments: owc's: owsim's. `=NAME` draws an earlier scene's model again; a line
# that begins with a blank continues the one before.
scenes() {
    sed -e ':a' -e '$!N' -e 's/\n  */ /' -e 'ta' -e 'P' -e 'D' <<'SCENES'
cubes: cubes: --keep-ids: --orbit 8 --size 160x120
cubes-id: =cubes: : --orbit 8 --size 160x120 --shade id
cubes-565: =cubes: : --orbit 8 --size 160x120 --format rgb565
cubes-565-be: =cubes: : --orbit 2 --size 160x120 --format rgb565-be
cubes-332: =cubes: : --orbit 2 --size 160x120 --format rgb332
cubes-gray8: =cubes: : --orbit 2 --size 160x120 --format gray8
cubes-gray4: =cubes: : --orbit 2 --size 101x77 --format gray4
cubes-mono: =cubes: : --orbit 2 --size 101x77 --format mono --ambient 0.5
cubes-lines: =cubes: : --orbit 4 --size 101x77 --shade lines
cubes-aa: =cubes: : --orbit 4 --size 101x77 --aa 4x4 --format gray4 --dither
cubes-spectrum: =cubes: : --orbit 4 --size 160x120 --map spectrum
cubes-odd: =cubes: : --orbit 4 --size 101x77
cubes-pixel: =cubes: : --orbit 4 --size 1x1
cubes-parallel: =cubes: : --orbit 4 --size 160x120 --parallel 4
cubes-wide: =cubes: : --orbit 4 --size 160x120 --fov 120
cubes-above: =cubes: : --orbit 4 --size 160x120 --elevation 80
cubes-light: =cubes: : --orbit 4 --size 160x120
    --light 1,0,0 --light-in-model --ambient 0.1 --background 400000
oldwell-low: oldwell --detail low: --keep-ids: --orbit 8 --size 160x120
oldwell-high: oldwell --detail high: --keep-ids: --orbit 8 --size 320x240
oldwell-id: =oldwell-high: : --orbit 8 --size 320x240 --shade id
oldwell-inside: =oldwell-high: : --views tests/golden/oldwell-inside.txt --size 160x120
oldwell-aa: =oldwell-high: : --orbit 4 --size 160x120 --aa 4x4
oldwell-lines: =oldwell-high: : --orbit 4 --size 320x240 --shade lines --format mono
oldwell-lines-inside: =oldwell-high: : --views tests/golden/oldwell-inside.txt --size 160x120
    --shade lines
oldwell-heat: =oldwell-high: : --orbit 4 --size 160x120 --map heat
oldwell-depth: =oldwell-high: : --orbit 4 --size 160x120 --depth-cue 12,21
oldwell-cut: oldwell --detail high: --sides two: --orbit 4 --size 160x120 --cut 0,0,-1,0 --aa 4x4
oldwell-cut-lines: =oldwell-cut: : --orbit 4 --size 160x120 --cut 0,0,-1,0 --shade lines
oldwell-565-dither: =oldwell-high: : --orbit 2 --size 160x120 --format rgb565 --dither
oldwell-332-dither: =oldwell-high: : --orbit 2 --size 160x120 --format rgb332 --dither
oldwell-gray4-dither: =oldwell-high: : --orbit 2 --size 161x120 --format gray4 --dither
oldwell-mono-dither: =oldwell-high: : --orbit 2 --size 161x120 --format mono --dither
oldwell-obstruction: oldwell --detail high: --keep-ids --method obstruction:
    --orbit 8 --size 320x240
atoms-obstruction: atoms: --keep-ids --method obstruction: --orbit 8 --size 320x240
klein-obstruction: klein: --keep-ids --method obstruction: --orbit 8 --size 160x120
klein: klein: --keep-ids: --orbit 8 --size 160x120
klein-lines: =klein: : --orbit 4 --size 160x120 --shade lines --depth-cue 40,80
klein-cool: =klein: : --orbit 4 --size 160x120 --map cool
ribbon: ribbon: --keep-ids: --orbit 8 --size 160x120
atoms: atoms: --keep-ids: --orbit 8 --size 160x120
atoms-gouraud: atoms: --normals compute: --orbit 4 --size 160x120 --shade gouraud
atoms-phong: =atoms-gouraud: : --orbit 4 --size 161x120 --shade phong --format rgb332 --dither
atoms-phong-aa: =atoms-gouraud: : --orbit 2 --size 160x120 --shade phong --aa 4x4
    --depth-cue 5,11 --map heat
atoms-lights: =atoms-gouraud: : --orbit 4 --size 160x120 --shade phong --light at:0,3,0,0.5
    --light 1,0,0,0.3 --light at:-4,0,-5
atoms-lights-gouraud: =atoms-gouraud: : --orbit 2 --size 160x120 --shade gouraud
    --light at:0,3,0,0.5 --light 1,0,0,0.3 --light-in-model
atoms-lights-flat: =atoms-gouraud: : --orbit 2 --size 160x120 --light at:0,3,0,0.5
    --light 1,0,0,0.3 --light-in-model
robot: robot: --keep-ids: --orbit 8 --size 160x120
vise: vise: --keep-ids: --orbit 8 --size 160x120
house: house: --keep-ids: --orbit 8 --size 160x120
random: random --count 60 --size 500 --seed 1: --keep-ids: --size 200x200
    --parallel 1000 --eye 500,500,2000 --at 500,500,500 --up 0,1,0
parallel: parallel --count 300 --size 500 --seed 1: --keep-ids: --size 200x200
    --parallel 1000 --eye 500,500,2000 --at 500,500,500 --up 0,1,0
SCENES
}

trim() {
    local s=$1
    s=${s#"${s%%[! ]*}"}
    echo "${s%"${s##*[! ]}"}"
}

# crc TREE OPTION...: the checksum that --bench reports.
crc() {
    "$O/owsim" "$@" --passes 1 --bench | sed -E 's/.*"crc32":([0-9]+).*/\1/'
}

# tree NAME MODEL COMPILE: makes the scene's tree, or finds an earlier one's.
tree() {
    local model compile
    read -ra model <<<"$2"
    read -ra compile <<<"$3"
    if [[ $2 == =* ]]; then
        echo "$dir/${2#=}.owt"
        return
    fi
    "$O/owgen" "${model[@]}" -o "$dir/$1.obj" &&
        "$O/owc" "$dir/$1.obj" -o "$dir/$1.owt" --method bsp --seed 1 "${compile[@]}" &&
        echo "$dir/$1.owt"
}

fails() { # NAME WHY
    echo "not ok $1: $2"
    bad=1
}

# scene NAME MODEL COMPILE VIEW: draws one and reports.
scene() {
    local name=$1 owt view got other expected
    read -ra view <<<"$4"
    if ! owt=$(tree "$1" "$2" "$3"); then
        fails "$name" "the model cannot be made or compiled"
        return
    fi
    if ! got=$(crc "$owt" "${view[@]}"); then
        fails "$name" "it cannot be drawn"
        return
    fi
    for other in "--order back-to-front" "--order scanline" "--threads 3" "--panel write --band 1" \
        "--panel write --band 50" "--order scanline --panel write --band 7"; do
        if [[ $4 == *--aa* && $other == *--order* ]]; then
            continue # coverage has one order
        fi
        # shellcheck disable=SC2086 # an option and its value
        if [ "$(crc "$owt" "${view[@]}" $other)" != "$got" ]; then
            mkdir -p "$dir/other"
            "$O/owsim" "$owt" "${view[@]}" -o "$dir/$name-%04d.png"
            # shellcheck disable=SC2086
            "$O/owsim" "$owt" "${view[@]}" $other -o "$dir/other/$name-%04d.png" \
                --compare "$dir" || true
            fails "$name" "$other draws another picture: see $dir/other/$name-*.png"
            return
        fi
    done
    printf '%s %s\n' "$name" "$got" >>"$new"
    expected=$(awk -v name="$name" '$1 == name { print $2 }' "$file" 2>/dev/null || true)
    if [ "${GOLDEN_UPDATE:-0}" = 1 ] || [ "$got" = "$expected" ]; then
        echo "ok $name"
        return
    fi
    "$O/owsim" "$owt" "${view[@]}" -o "$dir/$name-%04d.ppm"
    if [ -z "$expected" ]; then
        fails "$name" "there is no entry in $file; the frames are in $dir/$name-*.ppm"
    else
        fails "$name" "checksum $got, expected $expected; the frames are in $dir/$name-*.ppm"
    fi
}

: >"$new"
while IFS=: read -r name model compile view; do
    scene "$(trim "$name")" "$(trim "$model")" "$(trim "$compile")" "$(trim "$view")"
done < <(scenes)

# Entries that no scene stands behind any more.
while read -r name _; do
    scenes | grep -q "^$name:" || fails "$name" "$file has an entry, but there is no such scene"
done < <(cat "$file" 2>/dev/null || true)

if [ "${GOLDEN_UPDATE:-0}" = 1 ] && [ "$bad" = 0 ]; then
    cp "$new" "$file"
fi
exit "$bad"
