#!/bin/bash
# SPDX-License-Identifier: 0BSD
# owc-strategies.sh: owc's strategies, insertion, location and reports as people use and misuse
# them. Bad input: one line on standard error, exit status 1; wrong options: status 2; nothing
# half-written is left behind.
set -uo pipefail
cd "$(dirname "$0")/../.." || exit
O=${O:-build}
dir=$(mktemp -d "$O/owc-fault.XXXXXX")
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

run() { # ARGUMENT...: owc with an empty folder for its output; sets got
    got=0
    rm -rf "$dir/out" && mkdir "$dir/out"
    "$O/owc" "$@" >"$dir/stdout" 2>"$dir/stderr" </dev/null || got=$?
}

# refused NAME STATUS PATTERN ARGUMENT...
refused() {
    local name=$1 status=$2 pattern=$3 why=''
    shift 3
    run "$@"
    [ "$got" = "$status" ] || why+=" exit status $got, not $status;"
    [ "$status" != 1 ] || [ "$(wc -l <"$dir/stderr")" = 1 ] || why+=" not one line;"
    grep -qE "^owc: .*$pattern" "$dir/stderr" || why+=" it says: $(head -n 1 "$dir/stderr");"
    [ -z "$(ls -A "$dir/out")" ] || why+=" it leaves $(ls -A "$dir/out");"
    verdict "$name" "$why"
}

# prints NAME PATTERN ARGUMENT...: exit status 0, and a line of standard output or error like it
prints() {
    local name=$1 pattern=$2 why=''
    shift 2
    run "$@"
    [ "$got" = 0 ] || why+=" exit status $got: $(head -n 1 "$dir/stderr");"
    cat "$dir/stdout" "$dir/stderr" | grep -qaE "$pattern" ||
        why+=" no $pattern: $(head -n 2 "$dir/stdout" "$dir/stderr");"
    verdict "$name" "$why"
}

new=$dir/out/new.owt
"$O/owgen" cubes -o "$dir/cubes.obj" && "$O/owgen" house -o "$dir/house.obj" &&
    "$O/owc" "$dir/cubes.obj" --method bsp -o "$dir/cubes.owt" &&
    "$O/owc" "$dir/cubes.obj" --method feudal-static -o "$dir/feudal.owt" || exit 1
printf 'v 0 0 0\nv 0.1 0 0\nv 0 0.1 0\nf 1 2 3\n' >"$dir/inside.obj"
printf 'v 0 0 0\nv 100 0 0\nv 0 100 0\nf 1 2 3\n' >"$dir/outside.obj"
printf '1,0,0,0\n1,0,oops,0\n' >"$dir/planes"
head -c 200 "$dir/cubes.owt" >"$dir/short.owt"

for method in bsp online feudal-static feudal-dynamic; do
    prints "method $method" '"output_polygons"' "$dir/cubes.obj" --method $method -o "$new" --stats -
done
for seed in 1 2; do
    "$O/owc" "$dir/cubes.obj" --method feudal-dynamic --seed 7 -o "$dir/same$seed.owt"
done
verdict "equal seeds give equal trees" "$(cmp "$dir/same1.owt" "$dir/same2.owt" 2>&1)"

prints "insertion" 'is open, but the tree is one-sided' \
    --insert "$dir/inside.obj" "$dir/cubes.owt" -o "$new"
refused "insertion from outside" 1 'outside.obj: .*recompile' \
    --insert "$dir/outside.obj" "$dir/cubes.owt" -o "$new"
refused "insertion into sequences" 1 'feudal.owt: sequences' \
    --insert "$dir/inside.obj" "$dir/feudal.owt" -o "$new"
refused "insertion into what is no tree" 1 'short.owt: ' \
    --insert "$dir/inside.obj" "$dir/short.owt" -o "$new"
refused "insertion of nothing" 1 'nowhere.obj: ' \
    --insert "$dir/nowhere.obj" "$dir/cubes.owt" -o "$new"
refused "insertion without a tree" 2 'name a tree' --insert "$dir/inside.obj" -o "$new"

prints "location" '^region [0-9]+ of [0-9]+' --locate 0,0.5,0 "$dir/cubes.owt"
refused "location far away" 1 'too far' --locate 1e20,0,0 "$dir/cubes.owt"
refused "location among sequences" 1 'feudal.owt: sequences' --locate 0,0,0 "$dir/feudal.owt"
refused "location with an output" 2 'no output' --locate 0,0,0 "$dir/cubes.owt" -o "$new"

refused "planes that are none" 1 'planes:2: is no plane' \
    "$dir/cubes.obj" --planes-file "$dir/planes" -o "$new"
refused "planes that are missing" 1 'nowhere: cannot be read' \
    "$dir/cubes.obj" --planes-file "$dir/nowhere" -o "$new"
refused "planes with another method" 2 'go with --method bsp' \
    "$dir/cubes.obj" --method online --dividing axis -o "$new"
refused "a weight without conflicts" 2 'goes with --select conflict' \
    "$dir/cubes.obj" --conflict-weight 3 -o "$new"
refused "two outputs on one stream" 2 'only one of' "$dir/cubes.obj" --explain --stats - -o "$new"

prints "explanation" '^polygon [0-9]+ split by the plane of polygon [0-9]+, from' \
    "$dir/cubes.obj" --method online --explain -o "$new"
prints "picture" '</svg>' "$dir/cubes.obj" --plot - -o "$new"
refused "a picture that cannot be written" 1 'nowhere' \
    "$dir/cubes.obj" --plot "$dir/nowhere/plot.svg" -o "$new"
prints "checks" 'house.obj: is not manifold' "$dir/house.obj" -o "$new"
awk '/^f / { printf "f"; for (i = NF; i > 1; i--) printf " %s", $i; print ""; next } { print }' \
    "$dir/cubes.obj" >"$dir/inward.obj"
prints "inward normals" 'normals of 3 of 3 parts look inwards' "$dir/inward.obj" -o "$new"
prints "repair" '"closed":.*(true|1)' "$dir/inward.obj" --repair -o "$new" --stats -
[ $bad = 0 ]
