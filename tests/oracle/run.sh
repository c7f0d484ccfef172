#!/bin/bash
# SPDX-License-Identifier: 0BSD
# run.sh [--all]: owsim's pictures against the oracle, models of owgen and of ../shared/models:
# 8 views of the orbit, and 8 views inside and very near the surface.
# Without --all: what fits in about a minute. With it: every model at 320x240 and 640x480.
# Prints ok, not ok and skip lines. What was wrong stays in $O/tests/oracle-wrong.
set -uo pipefail
cd "$(dirname "$0")/../.." || exit 2
O=${O:-build}
work=$(mktemp -d "${TMPDIR:-/tmp}/oldwell-oracle.XXXXXX")
trap 'rm -rf "$work"' EXIT
wrong=$O/tests/oracle-wrong
rm -rf "$wrong"
failed=0
all=0
[ "${1:-}" = --all ] && all=1

result() { # STATUS NAME TEXT
    if [ "$1" = 0 ]; then
        echo "ok $2: $3"
    else
        echo "not ok $2: $3"
        failed=1
    fi
}

# judge NAME MODEL TREE OPTIONS...: draws with the options and has it judged.
judge() {
    local name=$1 model=$2 tree=$3 status=0 said sides=()
    shift 3
    [[ " $* " == *" --cull none "* ]] && sides=(--sides two)
    rm -f "$work"/frame-*.ppm "$work"/difference-*.ppm
    if ! said=$("$O/owsim" "$tree" --shade id --dump-views "$work/views.json" \
        -o "$work/frame-%04d.ppm" "$@" 2>&1); then
        result 1 "$name" "owsim: $said"
        return
    fi
    said=$("$O/tests/oracle" "$model" "$tree" --views "$work/views.json" \
        --frames "$work/frame-%04d.ppm" --diff "$work" "${sides[@]}" 2>&1) || status=$?
    result "$status" "$name" "$(tail -n 1 <<<"$said")"
    if [ "$status" != 0 ]; then
        mkdir -p "$wrong/${name// /-}"
        cp "$work"/*.ppm "$work/views.json" "$tree" "$wrong/${name// /-}/"
        grep -A 8 -E '^view.*( [1-9][0-9]* wrong| [1-9][0-9]* holes)' <<<"$said" |
            grep -v ' 0 wrong, 0 holes'
    fi
}

# model NAME MODEL SIZE... [-- OWC-OPTIONS]: compiles a model and judges it at each size.
model() {
    local name=$1 model=$2 list=() size said
    shift 2
    while [ $# -gt 0 ] && [ "$1" != -- ]; do list+=("$1") && shift; done
    [ $# -gt 0 ] && shift
    if ! said=$("$O/owc" "$model" --method bsp --keep-ids "$@" -o "$work/tree.owt" 2>&1); then
        result 1 "$name" "owc: $said"
        return
    fi
    "$O/tests/oracle" "$model" "$work/tree.owt" --near-views 8 >"$work/near.txt" || failed=1
    for size in "${list[@]}"; do
        judge "$name orbit $size" "$model" "$work/tree.owt" --orbit 8 --size "$size"
        judge "$name near $size" "$model" "$work/tree.owt" --views "$work/near.txt" --size "$size"
        judge "$name near, both sides, $size" "$model" "$work/tree.owt" \
            --views "$work/near.txt" --size "$size" --cull none --order back-to-front
    done
}

# generated NAME SIZES KIND-AND-OPTIONS [-- OWC-OPTIONS]
generated() {
    local name=$1 wanted=$2 said options=()
    shift 2
    while [ $# -gt 0 ] && [ "$1" != -- ]; do options+=("$1") && shift; done
    if ! said=$("$O/owgen" "${options[@]}" -o "$work/model.obj" 2>&1); then
        result 1 "$name" "owgen: $said"
        return
    fi
    # shellcheck disable=SC2086 # the sizes are words
    model "$name" "$work/model.obj" $wanted "$@"
}

"$O/tests/oracle" --self-test || failed=1

# The view of [GC91] for its random and parallel triangles.
papers_view=(--parallel 1000 --eye "500,500,2000" --at "500,500,500" --up "0,1,0" --size 500x500)
sizes=320x240
[ $all = 1 ] && sizes="320x240 640x480"
generated oldwell-low "$sizes" oldwell --detail low
generated oldwell-high "$sizes" oldwell --detail high
for kind in cubes klein ribbon atoms robot vise house; do
    generated $kind "$sizes" $kind
done
generated cubes-two-sided "$sizes" cubes -- --sides two
generated random-long "$sizes" random --count 60 --size 600 --seed 1
judge "random-long parallel" "$work/model.obj" "$work/tree.owt" "${papers_view[@]}"
generated random-short "$sizes" random --count 300 --size 60 --seed 2
generated parallel "$sizes" parallel --count 100 --size 400 --seed 3
judge "parallel parallel" "$work/model.obj" "$work/tree.owt" "${papers_view[@]}"
if [ $all = 1 ]; then
    for select in first random exhaustive; do
        generated "house-$select" 320x240 house -- --select $select
    done
fi

shared=../shared/models
light="suzanne beetle cow"
[ $all = 1 ] && light="suzanne beetle cow spot teapot fandisk stanford-bunny"
for name in $light; do
    if [ -e "$shared/$name.obj" ]; then
        # shellcheck disable=SC2086 # the sizes are words
        model "$name" "$shared/$name.obj" $sizes
    else
        echo "skip $name: models outside the repository (../shared/models)"
    fi
done
[ $failed = 0 ]
