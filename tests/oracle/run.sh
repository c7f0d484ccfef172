#!/bin/bash
# SPDX-License-Identifier: 0BSD
# run.sh [--all]: owsim's pictures against the oracle, models of owgen and of ../shared/models:
# 8 views of the orbit, and 8 views inside and very near the surface; closed models cut open by
# planes through their middle, as polygons and with caps.
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
    local name=$1 model=$2 tree=$3 status=0 said sides=() shade=(--shade id)
    shift 3
    [[ " $* " == *" --cull none "* ]] && sides=(--sides two)
    if [[ " $* " == *" --cap $cap "* ]]; then
        shade=(--shade flat --ambient 1 --background "$background")
        sides=(--caps "$cap,$background")
    fi
    rm -f "$work"/frame-*.ppm "$work"/difference-*.ppm
    if ! said=$("$O/owsim" "$tree" "${shade[@]}" --dump-views "$work/views.json" \
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

# The cap's colour and another one, which no model has.
cap=fe01fe background=010203

# cut NAME MODEL SIZE CUTS [OWC-OPTIONS]: cuts a closed model in so many ways and judges it.
cut() {
    local name=$1 model=$2 size=$3 cuts=$4 said middle=() n d
    shift 4
    if ! said=$("$O/owc" "$model" --keep-ids --sides two "$@" -o "$work/tree.owt" 2>&1); then
        result 1 "$name" "owc: $said"
        return
    fi
    if [[ $("$O/owc" --info "$work/tree.owt") != *"closed model"* ]]; then
        result 1 "$name" "is not closed: it cannot have caps"
        return
    fi
    "$O/tests/oracle" "$model" "$work/tree.owt" --near-views 8 >"$work/near.txt" || failed=1
    read -ra middle < <(awk '$1 == "v" { for (i = 2; i < 5; i++) {
            if (!(i in low) || $i + 0 < low[i]) low[i] = $i + 0
            if (!(i in high) || $i + 0 > high[i]) high[i] = $i + 0 } }
        END { print (low[2] + high[2]) / 2, (low[3] + high[3]) / 2, (low[4] + high[4]) / 2 }' \
        "$model")
    for n in $(head -n "$cuts" <<<"0.3,0.2,-1
1,0.1,0.35
0,-1,0
-0.5,0.7,0.6"); do
        d=$(awk -v n="$n" -v m="${middle[*]}" 'BEGIN { split(n, a, ","); split(m, b, " ")
            printf "%.6f", a[1] * b[1] + a[2] * b[2] + a[3] * b[3] }')
        judge "$name cut $n" "$model" "$work/tree.owt" --orbit 8 --size "$size" --cut "$n,$d" \
            --cap none
        judge "$name cut $n, near" "$model" "$work/tree.owt" --views "$work/near.txt" \
            --size "$size" --cut "$n,$d" --cap none
        judge "$name cut $n, caps" "$model" "$work/tree.owt" --orbit 8 --size "$size" \
            --cut "$n,$d" --cap $cap
        judge "$name cut $n, near, caps" "$model" "$work/tree.owt" --views "$work/near.txt" \
            --size "$size" --cut "$n,$d" --cap $cap
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

cuts=2
[ $all = 1 ] && cuts=4
for kind in "oldwell --detail low" house robot; do
    # shellcheck disable=SC2086 # the options are words
    if "$O/owgen" $kind -o "$work/model.obj"; then
        cut "${kind%% *}" "$work/model.obj" 320x240 $cuts
        cut "${kind%% *} bsp" "$work/model.obj" 320x240 $cuts --method bsp
    else
        result 1 "${kind%% *}" "owgen fails"
    fi
done
light="cow"
[ $all = 1 ] && light="cow spot fandisk"
for name in $light; do
    if [ -e "$shared/$name.obj" ]; then
        cut "$name" "$shared/$name.obj" 320x240 $cuts
    else
        echo "skip $name cut open: models outside the repository (../shared/models)"
    fi
done
[ $failed = 0 ]
