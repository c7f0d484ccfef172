#!/bin/bash
# SPDX-License-Identifier: 0BSD
# test_owc_cli.sh: owc as people call it: exit statuses, one line for what is wrong, no partial
# files. Prints ok and not ok lines.
set -uo pipefail
cd "$(dirname "$0")/../.." || exit 2
owc=$(realpath "${O:-build}")/owc
work=$(mktemp -d "${TMPDIR:-/tmp}/oldwell-owc.XXXXXX")
trap 'rm -rf "$work"' EXIT
cd "$work" || exit 2
failed=0

report() { # STATUS NAME
    if [ "$1" = 0 ]; then
        echo "ok $2"
    else
        echo "not ok $2"
        failed=1
    fi
}

# refused NAME STATUS WORDS ARGUMENT...: that exit status, WORDS in the first line, one line only
# (wrong usage shows the usage as well), and nothing new in the folder.
refused() {
    local name=$1 expected=$2 words=$3 status=0 before lines
    shift 3
    before=$(ls -A)
    timeout 60 "$owc" "$@" >out.log 2>err.log || status=$?
    lines=$(wc -l <err.log)
    [ "$status" = "$expected" ] && head -n 1 err.log | grep -q -- "^owc: .*$words" &&
        { [ "$lines" = 1 ] || [ "$expected" = 2 ]; } && [ ! -s out.log ] &&
        rm -f out.log err.log && [ "$(ls -A)" = "$before" ]
    report $? "$name"
    rm -f out.log err.log tree.owt
}

cube='v -1 -1 -1\nv 1 -1 -1\nv 1 1 -1\nv -1 1 -1\nv -1 -1 1\nv 1 -1 1\nv 1 1 1\nv -1 1 1\n'
cube+='f 4 3 2 1\nf 5 6 7 8\nf 1 2 6 5\nf 2 3 7 6\nf 3 4 8 7\nf 4 1 5 8\n'
printf '%b' "$cube" >cube.obj
: >empty.obj
printf 'v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 9\n' >index.obj
printf 'v 0 0 0\nv 1 0 0\nv 0 nan 0\nf 1 2 3\n' >nan.obj
printf 'v 0 0 0\nv 1 0 0\nv 2 0 0\nf 1 2 3\n' >line.obj
head -c 60 cube.obj >truncated.obj
head -c 3000 "$owc" >program.obj
cp program.obj program.txt
awk 'BEGIN { print "v 0 0 0\nv 1 0 0\nv 2 0 0\nv 3 0 0"
             for (i = 0; i < 1000000; i++) print "f", i % 4 + 1, i * 7 % 4 + 1, i * 3 % 4 + 1 }' \
    >degenerate.obj

refused "a missing model" 1 "cannot be read: No such file" missing.obj -o tree.owt
refused "a folder as model" 1 "cannot be read: Is a directory" . -o tree.owt
refused "an empty model" 1 "empty.obj: is empty" empty.obj -o tree.owt
refused "a truncated model" 1 "truncated.obj" truncated.obj -o tree.owt
refused "not a model" 1 "program.obj" program.obj -o tree.owt
refused "an unknown format" 1 "cannot be read as a model" program.txt -o tree.owt
refused "a coordinate that is no number" 1 "nan.obj:3: a coordinate" nan.obj -o tree.owt
refused "an index out of range" 1 "index.obj:4: .*vertex 9" index.obj -o tree.owt
refused "a model without area" 1 "line.obj: all 1 polygons" line.obj -o tree.owt
refused "a million degenerate faces" 1 "all 1000000 polygons" degenerate.obj -o tree.owt
refused "an output folder that is not there" 1 "folder does not exist" cube.obj -o no/tree.owt
refused "a full disk" 1 "/dev/full: cannot write" cube.obj -o /dev/full
refused "a full disk for the statistics" 1 "cannot write" cube.obj -o tree.owt --stats /dev/full
refused "no model" 2 "name a model"
refused "no output" 2 "name the output" cube.obj
refused "a strategy that nobody knows" 2 "takes one of" cube.obj -o tree.owt --method quick
refused "a selection that nobody knows" 2 "takes one of" cube.obj -o tree.owt --select quick
refused "an unknown option" 2 "unknown option" cube.obj -o tree.owt --colour red
refused "a tolerance out of range" 2 "tolerance" cube.obj -o tree.owt --tolerance 2
refused "information about nothing" 1 "missing.owt: cannot be read" --info missing.owt
refused "information about a model" 1 "cube.obj: " --info cube.obj

"$owc" --help | grep -q -- "--tolerance" && "$owc" --version | grep -q "^owc "
report $? "--help and --version"
"$owc" cube.obj -o tree.owt --keep-ids --stats stats.json >out.log 2>err.log &&
    [ ! -s out.log ] && [ ! -s err.log ] && "$owc" --info tree.owt >info.log &&
    grep -q "^polygons  *6:" info.log && grep -q "closed model" info.log
report $? "a cube compiles silently and is described"
awk 'BEGIN { for (i = 0; i < 16; i++) for (k = 0; k < 16; k++) print "v", i, k, 3 * sin(i * k)
             for (i = 0; i < 15; i++) for (k = 1; k < 16; k++) { a = 16 * i + k
                 print "f", a, a + 16, a + 17; print "f", a, a + 17, a + 1 } }' >waves.obj
"$owc" waves.obj -o one.owt --threads 1 --stats waves.json 2>/dev/null &&
    "$owc" waves.obj -o three.owt --threads 3 2>/dev/null && cmp -s one.owt three.owt &&
    grep -q '"connecting_nodes":	[1-9][0-9]' waves.json
report $? "the tree is the same for any number of threads"
missing=0
for key in source_polygons input_polygons output_polygons splits nodes switch_nodes \
    connecting_nodes depth one_way_relations vertices blob_bytes bytes_per_polygon seconds; do
    grep -q "\"$key\":" stats.json || missing=1
done
report $missing "the statistics have every key of the contract"
"$owc" cube.obj -o - --keep-ids | cmp -s - tree.owt
report $? "standard output gets the same tree"
head -c 200 tree.owt >cut.owt
! "$owc" --info cut.owt >/dev/null 2>err.log && grep -q "cut.owt: the tree is cut short" err.log
report $? "a tree cut short is told"
printf '\377' | dd of=tree.owt bs=1 seek=150 conv=notrunc status=none
! "$owc" --info tree.owt >/dev/null 2>err.log && [ "$(wc -l <err.log)" = 1 ]
report $? "a tree with a wrong byte is told"
[ $failed = 0 ]
