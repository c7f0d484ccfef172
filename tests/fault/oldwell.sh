#!/bin/bash
# SPDX-License-Identifier: 0BSD
# oldwell.sh: the program oldwell on a file in the place of a display: frames equal owsim's, trees
# are loaded anew, signals end it, it rests when nothing changes; wrong use is told in one line.
set -uo pipefail
cd "$(dirname "$0")/../.." || exit
O=${O:-build}
oldwell=$PWD/$O/oldwell
dir=$(mktemp -d "$O/oldwell-fault.XXXXXX")
pid=''
trap '[ -z "$pid" ] || kill "$pid"; rm -rf "$dir"' EXIT
bad=0

verdict() { # NAME WHY: ok if WHY is empty
    if [ -z "$2" ]; then
        echo "ok $1"
    else
        echo "not ok $1: $2"
        bad=1
    fi
}

# refused NAME STATUS PATTERN ARGUMENT...
refused() {
    local name=$1 status=$2 pattern=$3 got=0 why='' lines
    shift 3
    "$oldwell" "$@" >"$dir/stdout" 2>"$dir/stderr" </dev/null || got=$?
    lines=$(wc -l <"$dir/stderr")
    [ "$got" = "$status" ] || why+=" exit status $got, not $status;"
    [ "$status" = 2 ] || [ "$lines" = 1 ] || why+=" $lines lines on standard error;"
    grep -qE "^oldwell: .*$pattern" "$dir/stderr" || why+=" it says: $(head -n 1 "$dir/stderr");"
    verdict "$name" "$why"
}

soon() { # COMMAND...: true within ten seconds
    local i
    for ((i = 0; i < 200; i++)); do
        ! "$@" || return 0
        sleep 0.05
    done
    return 1
}

is_soon() { # NAME COMMAND...
    local name=$1 why=''
    shift
    soon "$@" || why="not so within ten seconds: $*"
    verdict "$name" "$why"
}

begin() { # ARGUMENT...: in the background, its messages in $dir/log
    rm -f "$dir/frame"
    "$oldwell" --panel file --device "$dir/frame" --size 64x48 --format rgb565 "$@" \
        2>"$dir/log" </dev/null &
    pid=$!
}

end() { # NAME SIGNAL STATUS
    local got=0 why=''
    kill "-$2" "$pid"
    wait "$pid" || got=$?
    pid=''
    [ "$got" = "$3" ] || why="exit status $got, not $3"
    verdict "$1" "$why"
}

shows() { # FILE: is its content the frame?
    cmp -s "$dir/frame" "$1"
}

cpu_ticks() { # PID: user and system time in clock ticks
    awk '{ print $14 + $15 }' "/proc/$1/stat"
}

if ! "$O/owgen" cubes -o "$dir/cubes.obj" || ! "$O/owgen" oldwell -o "$dir/well.obj" ||
    ! "$O/owc" "$dir/cubes.obj" -o "$dir/cubes.owt" ||
    ! "$O/owc" "$dir/well.obj" -o "$dir/well.owt"; then
    echo "not ok the trees cannot be made"
    exit 1
fi

# ---- frames ----
# A frame of the file is owsim's, pixel by pixel: both hold XRGB words or can be made such.
words() { # PPM: its pixels as XRGB8888 words
    od -An -v -tx1 -w3 -j "$2" "$1" | awk '{ print $3 $2 $1 "00" }' | tr -d '\n'
}
"$O/owsim" "$dir/well.owt" --size 64x48 --orbit 8 -o "$dir/view-%d.ppm"
for view in 0 3 7; do
    "$oldwell" --panel file --device "$dir/frame" --size 64x48 --orbit 8 --first $view --once \
        "$dir/well.owt"
    why=''
    [ "$(od -An -v -tx1 -w4 "$dir/frame" | tr -d ' \n')" = "$(words "$dir/view-$view.ppm" 13)" ] ||
        why="the frame is not owsim's"
    verdict "view $view is owsim's" "$why"
done

# ---- trees anew ----
picture() { # TREE FILE
    rm -f "$dir/frame"
    "$oldwell" --panel file --device "$dir/frame" --size 64x48 --format rgb565 --still --once \
        "$1" && mv "$dir/frame" "$2"
}
picture "$dir/well.owt" "$dir/well.raw"
picture "$dir/cubes.owt" "$dir/cubes.raw"
cp "$dir/well.owt" "$dir/shown.owt"
begin --still "$dir/shown.owt"
is_soon "the tree is shown" shows "$dir/well.raw"
cp "$dir/cubes.owt" "$dir/new" && mv "$dir/new" "$dir/shown.owt"
is_soon "a tree in its place is loaded" shows "$dir/cubes.raw"
head -c 300 "$dir/well.owt" >"$dir/new" && mv "$dir/new" "$dir/shown.owt"
is_soon "a bad one is told" grep -q 'shown.owt: .*going on with the tree of before' "$dir/log"
rm "$dir/shown.owt"
kill -HUP "$pid"
is_soon "a missing one is told" grep -q 'shown.owt: cannot read: .*going on' "$dir/log"
sleep 0.2
why=''
shows "$dir/cubes.raw" || why="the frame has changed"
verdict "the old tree stays" "$why"
cat "$dir/well.owt" >"$dir/shown.owt"
is_soon "a tree written in place is loaded" shows "$dir/well.raw"
end "SIGTERM ends it" TERM 0
cp "$dir/well.owt" "$dir/shown.owt"
begin --no-watch --still "$dir/shown.owt"
is_soon "the tree is shown without a watch" shows "$dir/well.raw"
cp "$dir/cubes.owt" "$dir/shown.owt"
sleep 0.3
why=''
shows "$dir/well.raw" || why="it was loaded"
verdict "--no-watch does not look" "$why"
kill -HUP "$pid"
is_soon "SIGHUP loads it" shows "$dir/cubes.raw"
end "SIGINT ends it" INT 0

# ---- time ----
begin --still --stats "$dir/well.owt"
is_soon "it says figures once a second" grep -q '"frames":0' "$dir/log"
before=$(cpu_ticks "$pid")
sleep 4
used=$(($(cpu_ticks "$pid") - before))
why=''
[ "$used" -le 4 ] || why="$used ticks of $(getconf CLK_TCK) a second in 4 s"
verdict "at rest it takes under 1 % of a processor" "$why"
end "SIGTERM ends it at rest" TERM 0
begin --fps 10 --stats "$dir/well.owt"
is_soon "a second has passed" grep -q '^{' "$dir/log"
soon test "$(grep -c '^{' "$dir/log")" -ge 1
frames=$(sed -nE '1s/.*"frames":([0-9]+).*/\1/p' "$dir/log")
why=''
{ [ "$frames" -ge 2 ] && [ "$frames" -le 11 ]; } || why="$frames frames in a second"
verdict "--fps 10 draws at most ten a second" "$why"
end "SIGTERM ends it in motion" TERM 0

"$oldwell" --panel file --device "$dir/frame" --size 64x48 --stats "$dir/well.owt" \
    2> >(exec 2>&- true) </dev/null &
pid=$!
sleep 2.5
end "nobody reads its figures: it goes on" TERM 0

# ---- board files ----
mkdir "$dir/board"
printf 'panel = file\ndevice = %s\nsize = 64x48\nonce = yes\n' "$dir/frame" >"$dir/board/board.conf"
rm -f "$dir/frame"
why=''
"$oldwell" --board "$dir/board" "$dir/well.owt" 2>"$dir/stderr" || why="$(cat "$dir/stderr")"
[ "$(stat -c %s "$dir/frame")" = $((64 * 48 * 4)) ] || why+=" no frame of that size"
verdict "a board's folder is read" "$why"
"$oldwell" --board "$dir/board/board.conf" --size 32x16 "$dir/well.owt"
rm -f "$dir/frame"
"$oldwell" --size 32x16 "$dir/well.owt" --board="$dir/board/board.conf"
why=''
[ "$(stat -c %s "$dir/frame")" = $((32 * 16 * 4)) ] || why="the frame has another size"
verdict "the command line has the last word" "$why"
wrong_board() { # NAME LINES PATTERN
    printf '%b' "$2" >"$dir/wrong.conf"
    refused "$1" 1 "$3" --board "$dir/wrong.conf" "$dir/well.owt"
}
wrong_board "an unknown setting" '# x\ncolour = red\n' "wrong.conf:2: there is no setting 'colour'"
wrong_board "a wrong value" '\n\nfps = fast\n' "wrong.conf:3: --fps takes a whole number"
wrong_board "a wrong choice" 'panel = paper\n' "wrong.conf:1: --panel takes one of"
wrong_board "a flag that is neither" 'once = maybe\n' "wrong.conf:1: once takes yes or no"
wrong_board "no value" 'panel\n' "wrong.conf:1: a setting is a line"
wrong_board "a board in a board" 'board = x\n' "wrong.conf:1: a board file cannot name"
head -c 70000 /dev/zero | tr '\0' '#' >"$dir/wrong.conf"
refused "a board file without end" 1 'at most 64 KB' --board "$dir/wrong.conf" "$dir/well.owt"
refused "no such board" 1 "there-is-none: cannot read the board" \
    --board there-is-none "$dir/well.owt"

# ---- wrong use, missing devices ----
refused "no tree" 2 'name the tree'
refused "two trees" 2 "unexpected argument" a b
refused "a tree from standard input" 2 "cannot be '-'" -
refused "no turn of 45 degrees" 2 'rotate takes' --rotate 45 "$dir/well.owt"
refused "no depth of 24" 2 'depth takes' --depth 24 "$dir/well.owt"
refused "a first view that there is not" 2 'first counts' --orbit 4 --first 4 "$dir/well.owt"
refused "no D/C line" 2 '--dc gpiochip0:25' --panel ili9341 "$dir/well.owt"
refused "no address" 2 'i2c-address takes' --panel ssd1306 --bus i2c --i2c-address 99 \
    "$dir/well.owt"
refused "no offset" 2 'offset takes' --panel st7735 --dc 1 --offset 2 "$dir/well.owt"
refused "no such GPIO chip" 3 'none:25: there is no such chip' --panel ili9341 --dc none:25 \
    "$dir/well.owt"
refused "no I2C bus" 3 '/none/i2c: open: ' --panel ssd1306 --bus i2c --device /none/i2c \
    "$dir/well.owt"
refused "no light" 2 'zero vector' --light 0,0,0 "$dir/well.owt"
refused "a missing tree" 1 "none.owt: cannot read" --panel file --device "$dir/frame" \
    "$dir/none.owt"
refused "no tree but a model" 1 "compile the model with owc" --panel file --device "$dir/frame" \
    "$dir/well.obj"
refused "no polygon numbers" 1 "owc --keep-ids" --panel file --device "$dir/frame" --shade id \
    "$dir/well.owt"
refused "no frame buffer" 3 "/none/fb: open: .*connect" --panel fbdev --device /none/fb \
    --console none "$dir/well.owt"
refused "no video output" 3 "/none/video: open: " --panel v4l2 --device /none/video "$dir/well.owt"
refused "no camera" 3 "/none/video: open: " --panel file --device "$dir/frame" \
    --camera /none/video "$dir/well.owt"
refused "no frame buffer but a file" 5 "FBIOGET_VSCREENINFO" --panel fbdev --console none \
    --device "$dir/well.obj" "$dir/well.owt"
if [ "$(id -u)" != 0 ]; then
    : >"$dir/locked" && chmod 0 "$dir/locked"
    refused "no permission" 4 "locked: open: .*doctor" --panel file --device "$dir/locked" \
        "$dir/well.owt"
fi
start=$SECONDS
refused "a device that does not come" 3 "/none/fb: open: " --panel fbdev --device /none/fb \
    --console none --wait 2 "$dir/well.owt"
why=''
[ $((SECONDS - start)) -ge 1 ] || why="it did not wait"
verdict "it is waited for" "$why"
begin --once "$dir/well.owt"
wait "$pid"
rm -f "$dir/late"
(sleep 0.7 && mkdir "$dir/late") &
why=''
"$oldwell" --panel file --device "$dir/late/frame" --wait 20 --once "$dir/well.owt" \
    2>"$dir/stderr" || why="$(cat "$dir/stderr")"
pid=''
verdict "a device that comes late" "$why"
refused "a full disk" 5 "/dev/full: write: " --panel file \
    --device /dev/full --retry 0 "$dir/well.owt"

exit $bad
