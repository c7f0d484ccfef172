#!/bin/bash
# SPDX-License-Identifier: 0BSD
# owsim.sh: owsim as people use it and misuse it. Bad input: one line on standard error, exit
# status 1; wrong options: status 2; nothing half-written is left behind.
set -uo pipefail
cd "$(dirname "$0")/../.." || exit
O=${O:-build}
sim=$O/owsim
dir=$(mktemp -d "$O/owsim-fault.XXXXXX")
trap 'rm -rf "$dir"' EXIT
bad=0

verdict() { # NAME WHY: ok if WHY is empty
    if [ -z "$2" ]; then
        echo "ok $1"
    else
        echo "not ok $1: $2"
        bad=1
    fi
}

# refused NAME STATUS PATTERN ARGUMENT...: owsim says so, and leaves nothing in $dir/out.
refused() {
    local name=$1 status=$2 pattern=$3 got=0 why='' lines
    shift 3
    rm -rf "$dir/out" && mkdir "$dir/out"
    "$sim" "$@" >"$dir/stdout" 2>"$dir/stderr" </dev/null || got=$?
    lines=$(wc -l <"$dir/stderr")
    [ "$got" = "$status" ] || why+=" exit status $got, not $status;"
    [ "$status" != 1 ] || [ "$lines" = 1 ] || why+=" $lines lines on standard error;"
    grep -qE "^owsim: .*$pattern" "$dir/stderr" || why+=" it says: $(head -n 1 "$dir/stderr");"
    [ -z "$(ls -A "$dir/out")" ] || why+=" it leaves $(ls -A "$dir/out");"
    verdict "$name" "$why"
}

# works NAME ARGUMENT...: exit status 0, nothing on standard error.
works() {
    local name=$1 got=0 why=''
    shift
    "$sim" "$@" >"$dir/stdout" 2>"$dir/stderr" </dev/null || got=$?
    [ "$got" = 0 ] || why+=" exit status $got;"
    [ ! -s "$dir/stderr" ] || why+=" it says: $(head -n 1 "$dir/stderr");"
    verdict "$name" "$why"
}

is() { # NAME CONDITION...: a command that must succeed
    local name=$1 why=''
    shift
    "$@" || why="not so: $*"
    verdict "$name" "$why"
}

# shellcheck disable=SC2317 # called by is
size_is() { # FILE BYTES
    [ "$(stat -c %s "$1")" = "$2" ]
}

if ! "$O/owgen" cubes -o "$dir/cubes.obj" ||
    ! "$O/owc" "$dir/cubes.obj" -o "$dir/tree.owt" --method bsp --seed 1 --keep-ids; then
    echo "not ok the tree cannot be made"
    exit 1
fi
tree=$dir/tree.owt
out=$dir/out/f-%04d.ppm
bytes=$(stat -c %s "$tree")

# ---- wrong options ------------------------------------------------------------------------------
usage() { # NAME PATTERN ARGUMENT...
    refused "usage: $1" 2 "$2" "${@:3}"
}
usage "no tree" "missing"
usage "unknown option" "unknown option '--sice'" "$tree" --sice 3x3 -o "$out"
usage "nothing to do" "nothing to do" "$tree"
usage "size zero" "size" "$tree" --size 0x5 -o "$out"
usage "size too large" "size" "$tree" --size 4097x5 -o "$out"
usage "field of view" "fov" "$tree" --fov 171 -o "$out"
usage "background" "background" "$tree" --background blue -o "$out"
usage "no light" "zero vector" "$tree" --light 0,0,0 -o "$out"
usage "half a light" "x,y,z" "$tree" --light at:1,2 -o "$out"
usage "a light of words" "x,y,z" "$tree" --light 1,2,3,bright -o "$out"
usage "a light below none" "share" "$tree" --light 1,2,3,-1 -o "$out"
usage "a light too far" "farther" "$tree" --light at:1,2,1e9 -o "$out"
usage "nine lights" "8 times" "$tree" -o "$out" \
    --light 1,2,3 --light 1,2,3 --light 1,2,3 --light 1,2,3 --light 1,2,3 --light 1,2,3 \
    --light 1,2,3 --light 1,2,3 --light 1,2,3
usage "a dangerous pattern" "%d" "$tree" -o "$dir/out/%s.ppm"
usage "two numbers" "only once" "$tree" -o "$dir/out/%d%d.ppm"
usage "unknown picture format" "ppm or .png" "$tree" -o "$dir/out/f.jpg"
usage "one name for many frames" "need a number" "$tree" --orbit 2 -o "$dir/out/f.ppm"
usage "--eye and --orbit" "exclude" "$tree" --eye 1,2,3 --orbit 3 -o "$out"
usage "--at alone" "need --eye" "$tree" --at 1,2,3 -o "$out"
usage "eye is at" "the eye is where it looks" "$tree" --eye 1,2,3 --at 1,2,3 -o "$out"
usage "up along the view" "parallel to the view" "$tree" --eye 0,5,0 --at 0,0,0 -o "$out"
usage "up is zero" "up is zero" "$tree" --eye 0,0,5 --at 0,0,0 --up 0,0,0 -o "$out"
usage "too far" "farther" "$tree" --eye 0,0,1e6 -o "$out"
usage "far beyond" "farther" "$tree" --eye 0,0,1e300 -o "$out"
usage "near" "above 0" "$tree" --near 0 -o "$out"
usage "parallel height" "above 0" "$tree" --parallel -3 -o "$out"
usage "parallel and fov" "perspective" "$tree" --parallel 3 --fov 20 -o "$out"
usage "numbers in 16 bits" "xrgb8888" "$tree" --shade id --format rgb565 -o "$out"
usage "two on standard output" "only one" "$tree" -o - --bench
usage "script and eye" "orbit" "$tree" --script /dev/null --eye 1,2,3 -o "$out"
usage "passes alone" "bench" "$tree" --passes 3 -o "$out"

# ---- bad input ----------------------------------------------------------------------------------
input() { # NAME PATTERN ARGUMENT...
    refused "input: $1" 1 "$2" "${@:3}"
}
input "missing" "No such file" "$dir/nowhere.owt" -o "$out"
input "a folder" "directory" "$dir" -o "$out"
: >"$dir/bad.owt"
input "empty" "empty" "$dir/bad.owt" -o "$out"
input "empty standard input" "empty" - -o "$out"
input "a model, not a tree" "not an Oldwell tree" "$dir/cubes.obj" -o "$out"
why=''
for ((n = 1; n < bytes; n += bytes / 40 + 1)); do
    head -c "$n" "$tree" >"$dir/bad.owt"
    "$sim" "$dir/bad.owt" -o "$out" >/dev/null 2>"$dir/stderr"
    [ $? = 1 ] && [ "$(wc -l <"$dir/stderr")" = 1 ] || why+=" $n"
done
verdict "input: cut off" "$why"
why=''
for ((n = 0; n < bytes; n += bytes / 60 + 1)); do
    cp "$tree" "$dir/bad.owt"
    was=$(od -An -tu1 -j "$n" -N 1 "$tree")
    printf '%b' "\\x$(printf %02x $((was ^ 0x41)))" |
        dd of="$dir/bad.owt" bs=1 seek="$n" conv=notrunc status=none
    "$sim" "$dir/bad.owt" -o "$out" >/dev/null 2>"$dir/stderr"
    [ $? = 1 ] && [ "$(wc -l <"$dir/stderr")" = 1 ] || why+=" $n"
done
verdict "input: a byte changed" "$why"
is "input: none of them left a picture" test -z "$(ls -A "$dir/out")"
cp "$tree" "$dir/bad.owt"
printf '\x63' | dd of="$dir/bad.owt" bs=1 seek=4 conv=notrunc status=none
input "another version" "version" "$dir/bad.owt" -o "$out"
"$O/owc" "$dir/cubes.obj" -o "$dir/noids.owt" --method bsp --seed 1
input "no numbers" "keep-ids" "$dir/noids.owt" --shade id -o "$out"
input "no output folder" "folder does not exist" "$tree" -o "$dir/nowhere/f-%d.ppm"
input "no folder for the sheet" "folder does not exist" "$tree" --sheet "$dir/nowhere/s.ppm"
printf '0 0 5 0 0 0 0 1 0\n# fine\n0 0 5 0 0 0\n' >"$dir/views"
input "a view cut off" "views:3: a view is nine numbers" "$tree" --views "$dir/views" -o "$out"
printf '0 0 5 0 0 5 0 1 0\n' >"$dir/views"
input "a view from nowhere" "views:1: this view cannot" "$tree" --views "$dir/views" -o "$out"
printf '0 0 5 0 0 zero 0 1 0\n' >"$dir/views"
input "a view of words" "views:1: " "$tree" --views "$dir/views" -o "$out"
printf '# none\n' >"$dir/views"
input "no view" "no view" "$tree" --views "$dir/views" -o "$out"
printf '0 left press\n5 right push\n' >"$dir/script"
input "a wrong event" "script:2: 'push'" "$tree" --script "$dir/script" -o "$out"
if [ -c /dev/full ]; then
    full() { # NAME ARGUMENT...
        local status=0 why=''
        "$sim" "${@:2}" >/dev/full 2>"$dir/stderr" || status=$?
        [ "$status" = 1 ] || why+=" exit status $status"
        grep -q '^owsim: standard output: cannot write: ' "$dir/stderr" ||
            why+=" it says: $(cat "$dir/stderr")"
        verdict "input: full disk: $1" "$why"
    }
    full "pictures" "$tree" -o -
    full "bench" "$tree" --bench --passes 1
    full "sheet" "$tree" --sheet -
    full "views" "$tree" --dump-views -
fi

# ---- what it is for -----------------------------------------------------------------------------
rm -rf "$dir/out" && mkdir "$dir/out"
works "orbit: frames" "$tree" --orbit 3 --size 40x30 -o "$out"
is "orbit: frame 2 is whole" size_is "$dir/out/f-0002.ppm" $((13 + 3 * 40 * 30))
works "orbit: to standard output" "$tree" --orbit 3 --size 40x30 -o -
cat "$dir"/out/f-000[012].ppm >"$dir/all"
is "orbit: the same, concatenated" cmp -s "$dir/all" "$dir/stdout"
"$sim" - --orbit 3 --size 40x30 -o - <"$tree" >"$dir/stdin"
is "orbit: tree from standard input" cmp -s "$dir/all" "$dir/stdin"

mkdir "$dir/again" "$dir/ref" "$dir/diff"
works "compare: equal" "$tree" --orbit 3 --size 40x30 --compare "$dir/out" \
    -o "$dir/again/f-%04d.ppm"
is "compare: equal frames leave no pictures but their own" test \
    "$(find "$dir/again" -type f | wc -l)" = 3
cp "$dir"/out/f-000[01].ppm "$dir/ref"
printf 'x' | dd of="$dir/ref/f-0001.ppm" bs=1 seek=100 conv=notrunc status=none
"$sim" "$tree" --orbit 3 --size 40x30 -o "$dir/out/f-%04d.ppm" --compare "$dir/ref" \
    --diff-dir "$dir/diff" >"$dir/stdout" 2>"$dir/stderr"
is "compare: exit status 1" test $? = 1
is "compare: frame 0 is equal" grep -qx 'f-0000: 0 pixels differ' "$dir/stdout"
is "compare: frame 1 differs by one pixel" grep -qx 'f-0001: 1 pixels differ' "$dir/stdout"
is "compare: frame 2 is missing" grep -q '^f-0002: there is no picture' "$dir/stdout"
is "compare: pictures" test "$(cd "$dir/diff" && echo f-*-* | sed 's/\.[a-z]*//g')" = \
    "f-0001-actual f-0001-diff f-0002-actual"

keys=order,shade,format,width,height,frames,ms_per_frame_min,ms_per_frame_median
keys+=,polygons_visited,polygons_painted,pixels_written,pixels_background,spans,crc32,ms_memset_median,
works "bench: runs" "$tree" --orbit 2 --size 40x30 --bench --passes 2
is "bench: one line" test "$(wc -l <"$dir/stdout")" = 1
is "bench: its keys" test "$(grep -oE '"[a-z_0-9]+":' "$dir/stdout" | tr -d '":' | tr '\n' ,)" = \
    "$keys"
is "bench: no picture" test -z "$(find . -maxdepth 1 -name 'out-*' -newer "$tree")"

printf '0 knob1 turn 2\n1000000 right press\n1120000 right release\n' >"$dir/script"
rm -rf "$dir/out" && mkdir "$dir/out"
works "script: runs" "$tree" --script "$dir/script" --size 40x30 -o "$out"
is "script: the first frame, the press and two repeats" test \
    "$(find "$dir/out" -name 'f-*' | wc -l)" = 4
works "views: dump" "$tree" --orbit 2 --dump-views "$dir/views.json"
is "views: dump has both" test "$(grep -c '"camera_shift"' "$dir/views.json")" = 2

exit "$bad"
