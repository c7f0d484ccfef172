#!/bin/bash
# SPDX-License-Identifier: 0BSD
# test_owbench.sh: the table of strategies is whole, has the papers' figures, and keeps to its time.
set -uo pipefail
cd "$(dirname "$0")/../.." || exit
O=${O:-build}
dir=$(mktemp -d "$O/owbench.XXXXXX")
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

# lines PATTERN: how many lines of the output are like it
lines() {
    grep -cE "$1" "$dir/out" || true
}

"$O/owbench" trees cubes --seeds 3 --limit 60 >"$dir/out" 2>"$dir/err"
status=$? why=''
[ $status = 0 ] || why+=" exit status $status: $(head -n 1 "$dir/err");"
[ "$(lines '^(bsp k=|exhaustive|conflict|online|feudal|obstruction).* [0-9.]+ +[0-9]')" = 11 ] ||
    why+=" not 11 strategies;"
[ "$(lines '^bsp k=15 .* 240 +24 *$')" = 1 ] || why+=" without the paper's figures;"
verdict "the table of a generated model" "$why"

printf 'v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n' >"$dir/one.obj"
status=0
"$O/owbench" trees "$dir/one.obj" --limit 30 --seeds 1 >"$dir/out" || status=$?
[ $status = 0 ] && [ "$(lines '^obstruction +1 +1.00 +0 ')" = 1 ] && why='' || why="$(cat "$dir/out")"
verdict "the table of a file" "$why"

"$O/owgen" random --count 3000 --size 300 --seed 1 -o "$dir/long.obj"
begin=$SECONDS
"$O/owbench" trees "$dir/long.obj" --limit 0.1 --seeds 2 >"$dir/out" || status=$?
[ $status = 0 ] && [ "$(lines '^obstruction.* -$')" = 2 ] && [ $((SECONDS - begin)) -lt 30 ] && why='' ||
    why="$((SECONDS - begin)) s: $(cat "$dir/out")"
verdict "what takes too long is ended" "$why"

for arguments in "" "tree" "trees --seeds 0"; do
    # shellcheck disable=SC2086 # words
    "$O/owbench" $arguments >"$dir/out" 2>"$dir/err"
    [ $? = 2 ] && why='' || why="not exit status 2"
    verdict "usage: owbench $arguments" "$why"
done
[ $bad = 0 ]
