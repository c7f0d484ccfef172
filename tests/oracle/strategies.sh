#!/bin/bash
# SPDX-License-Identifier: 0BSD
# strategies.sh [--all]: the trees of every strategy against the oracle.
# Without --all: every strategy on small models. With it: on every model.
# Prints ok, not ok and skip lines.
set -uo pipefail
cd "$(dirname "$0")/../.." || exit 2
O=${O:-build}
work=$(mktemp -d "${TMPDIR:-/tmp}/oldwell-strategies.XXXXXX")
trap 'rm -rf "$work"' EXIT
wrong=$O/tests/oracle-strategies
rm -rf "$wrong"
failed=0

result() { # STATUS NAME TEXT
    if [ "$1" = 0 ]; then
        echo "ok $2: $3"
    else
        echo "not ok $2: $3"
        failed=1
    fi
}

# judge NAME MODEL TREE VIEWS...: draws the views, near first and far first, and has them judged.
judge() {
    local name=$1 model=$2 tree=$3 order status said
    shift 3
    for order in front-to-back back-to-front; do
        status=0
        rm -f "$work"/frame-*.ppm
        if ! said=$("$O/owsim" "$tree" --shade id --size 320x240 --order $order \
            --dump-views "$work/views.json" -o "$work/frame-%04d.ppm" "$@" 2>&1); then
            result 1 "$name $order" "owsim: $said"
            continue
        fi
        said=$("$O/tests/oracle" "$model" "$tree" --views "$work/views.json" \
            --frames "$work/frame-%04d.ppm" 2>&1) || status=$?
        result "$status" "$name $order" "$(tail -n 1 <<<"$said")"
        if [ "$status" != 0 ]; then
            mkdir -p "$wrong/${name// /-}"
            cp "$work"/*.ppm "$work/views.json" "$tree" "$wrong/${name// /-}/"
        fi
    done
}

# tree NAME MODEL TREE: eight views of the orbit, eight within and near.
tree() {
    judge "$1 orbit" "$2" "$3" --orbit 8
    "$O/tests/oracle" "$2" "$3" --near-views 8 >"$work/near.txt" || failed=1
    judge "$1 near" "$2" "$3" --views "$work/near.txt"
}

strategies=("--method online" "--method feudal-static" "--method feudal-dynamic"
    "--method bsp --select conflict" "--method bsp --dividing axis"
    "--method bsp --planes-file $work/planes" "--method feudal-dynamic --sides two")
printf '0,1,0,0 # a plane through the middle\n1,0,0.5,-0.1\n' >"$work/planes"

# strategies NAME MODEL
strategies() {
    local said options
    for options in "${strategies[@]}"; do
        # shellcheck disable=SC2086 # the options are words
        if said=$("$O/owc" "$2" $options --keep-ids -o "$work/tree.owt" 2>&1); then
            tree "$1 ${options//"$work/"/}" "$2" "$work/tree.owt"
        else
            result 1 "$1 $options" "owc: $said"
        fi
    done
}

# Half of a model is compiled, the other half is added: the whole must come out right. The first
# half has the polygons at the box's sides, so that the second fits into its cube.
inserted() { # NAME MODEL
    local said
    awk -v folder="$work" '
        /^v / { v[++n] = $0; for (k = 2; k <= 4; k++) {
            if (n == 1 || $k < low[k]) low[k] = $k
            if (n == 1 || $k > high[k]) high[k] = $k
            at[n, k] = $k } }
        /^f / { f[++m] = $0; for (i = 2; i <= NF; i++) { split($i, part, "/"); of[m, i] = part[1] }
            corners[m] = NF }
        END {
            for (i = 1; i <= n; i++) print v[i] >(folder "/first.obj")
            for (i = 1; i <= n; i++) print v[i] >(folder "/second.obj")
            for (i = 1; i <= n; i++) print v[i] >(folder "/whole.obj")
            for (pass = 1; pass <= 2; pass++) for (i = 1; i <= m; i++) {
                first = i % 2
                for (c = 2; c <= corners[i]; c++) for (k = 2; k <= 4; k++)
                    first = first || at[of[i, c], k] == low[k] || at[of[i, c], k] == high[k]
                if (first == (pass == 1)) {
                    print f[i] >(folder (pass == 1 ? "/first.obj" : "/second.obj"))
                    print f[i] >(folder "/whole.obj")
                }
            }
        }' "$2"
    if ! said=$("$O/owc" "$work/first.obj" --method bsp --sides two --keep-ids \
        -o "$work/first.owt" 2>&1); then
        result 1 "$1 inserted" "owc: $said"
    elif ! said=$("$O/owc" --insert "$work/second.obj" "$work/first.owt" \
        -o "$work/tree.owt" 2>&1); then
        result 1 "$1 inserted" "owc: $said"
    else
        tree "$1 inserted" "$work/whole.obj" "$work/tree.owt"
    fi
}

generated() { # KIND OPTIONS...
    local said
    if said=$("$O/owgen" "$@" -o "$work/model.obj" 2>&1); then
        strategies "$1" "$work/model.obj"
        inserted "$1" "$work/model.obj"
    else
        result 1 "$1" "owgen: $said"
    fi
}

kinds="cubes vise"
shared="suzanne"
if [ "${1:-}" = --all ]; then
    kinds="cubes klein ribbon atoms robot vise house"
    shared="suzanne cow"
    generated oldwell --detail high
    generated parallel --count 100 --size 400 --seed 3
    generated random --count 300 --size 60 --seed 2
fi
generated oldwell --detail low
generated random --count 60 --size 600 --seed 1
for kind in $kinds; do
    generated "$kind"
done
for name in $shared; do
    if [ -e "../shared/models/$name.obj" ]; then
        strategies "$name" "../shared/models/$name.obj"
    else
        echo "skip $name: models outside the repository (../shared/models)"
    fi
done
[ $failed = 0 ]
