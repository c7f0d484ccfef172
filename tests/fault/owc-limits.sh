#!/bin/bash
# SPDX-License-Identifier: 0BSD
# owc-limits.sh: owc at its limits: very many polygons in one place, too little memory, interrupted.
# It ends, says in one line what is wrong, and leaves no half-written file. (The format's own limits
# are in tests/unit/test_owc_blob.c.)
set -uo pipefail
cd "$(dirname "$0")/../.." || exit
O=${O:-build}
dir=$(mktemp -d "$O/owc-limits.XXXXXX")
trap 'rm -rf "$dir"' EXIT
bad=0
million=1000000
# Sanitizers and emulators are slow; under one the program is owc.elf, started by a script.
[ "${SAN:-0}" = 0 ] && [ ! -e "$O/owc.elf" ] || million=40000

verdict() { # NAME WHY: ok if WHY is empty
    if [ -z "$2" ]; then
        echo "ok $1"
    else
        echo "not ok $1: $2"
        bad=1
    fi
}

fresh() { # an empty folder for the output
    rm -rf "$dir/out" && mkdir "$dir/out"
}

left() { # what lies there afterwards
    local files
    files=$(ls -A "$dir/out")
    [ -z "$files" ] || echo " it leaves $files;"
}

# ends NAME SECONDS PATTERN MODEL OPTION...: compiles in that time, and the statistics say so
ends() {
    local name=$1 seconds=$2 pattern=$3 status=0 why=''
    shift 3
    fresh
    timeout "$seconds" "$O/owc" "$@" -o "$dir/out/tree.owt" --stats "$dir/out/stats" \
        2>"$dir/stderr" || status=$?
    [ $status = 0 ] || why+=" exit status $status: $(tail -n 1 "$dir/stderr");"
    [ $status != 0 ] || tr -d '\n\t' <"$dir/out/stats" | grep -qE "$pattern" || why+=" no $pattern;"
    verdict "$name" "$why"
}

# ---- very many polygons in one place ----
awk -v n=$million 'BEGIN {
    print "v 0 0 0\nv 1 0 0\nv 0 1 0"
    for (i = 0; i < n; i++) print "f 1 2 3"
}' >"$dir/same.obj"
awk -v n=$million 'BEGIN {
    side = int(sqrt(n))
    for (y = 0; y <= side; y++) for (x = 0; x <= side; x++) print "v", x, y, 0
    for (y = 0; y < side; y++) for (x = 0; x < side; x++) {
        a = y * (side + 1) + x + 1
        print "f", a, a + 1, a + side + 2, a + side + 1
    }
}' >"$dir/flat.obj"
awk 'BEGIN {
    n = 20000
    for (i = 0; i < n; i++) print "v", i / n, "0 0\nv", 1 + i / n, "0 0\nv", i / n, "1 0"
    for (i = 0; i < n; i++) print "f", 3 * i + 1, 3 * i + 2, 3 * i + 3
}' >"$dir/stack.obj"
ends "$million identical polygons" 120 '"output_polygons":1,' "$dir/same.obj"
ends "$million coplanar polygons" 300 "\"output_polygons\":$million," "$dir/flat.obj"
ends "20000 polygons that overlap in one plane" 120 '"output_polygons":20000,' "$dir/stack.obj"
ends "the same as switches alone" 120 '"output_polygons":20000,"splits":0,' "$dir/stack.obj" \
    --method bsp

# ---- too little memory ----
"$O/owgen" random --count 20000 --size 100 --seed 1 -o "$dir/random.obj" || exit 1
if [ $million = 1000000 ]; then
    for megabytes in 40 60 90; do
        fresh
        status=0
        (ulimit -v $((megabytes * 1024)) &&
            exec "$O/owc" "$dir/random.obj" --method bsp -o "$dir/out/tree.owt") 2>"$dir/stderr" ||
            status=$?
        why=''
        [ $status = 1 ] || why+=" exit status $status;"
        [ "$(wc -l <"$dir/stderr")" = 1 ] || why+=" not one line;"
        grep -q '^owc: .*out of memory' "$dir/stderr" || why+=" it says: $(head -n 1 "$dir/stderr");"
        verdict "$megabytes MB are too little" "$why$(left)"
    done
else
    echo "# not here: too little memory, for sanitizers and emulators take more by themselves"
fi

# ---- interrupted ----
for signal in INT TERM HUP; do
    for when in 0.05 0.5; do
        fresh
        status=0
        timeout --preserve-status --kill-after=60 --signal=$signal $when \
            "$O/owc" "$dir/random.obj" -o "$dir/out/tree.owt" --stats "$dir/out/stats" \
            2>"$dir/stderr" || status=$?
        why=''
        [ $status -gt 128 ] && [ $status != 137 ] || why+=" exit status $status;"
        verdict "$signal after $when s" "$why$(left)"
    done
done
[ $bad = 0 ]
