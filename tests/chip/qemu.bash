#!/bin/bash
# SPDX-License-Identifier: 0BSD
# Sourced by the tests of the chip boards: a board in QEMU, its serial port and monitor as pipes.
# After qemu_start: fd 3 is what the board receives, 4 what it sends, 5 and 6 the monitor.
O=${O:-build}
work=$(mktemp -d "${TMPDIR:-/tmp}/oldwell-chip.XXXXXX")
qemu_pid=
trap 'qemu_stop; rm -rf "$work"' EXIT
export failed=0

ok() { # NAME
    echo "ok $1"
}
not_ok() { # NAME WHY
    echo "# $2"
    echo "not ok $1"
    failed=1
}

# qemu_start MACHINE ELF [OPTION...]
qemu_start() {
    local machine=$1 elf=$2
    shift 2
    rm -f "$work"/{uart,qmp}.{in,out} "$work/said"
    mkfifo "$work"/{uart,qmp}.{in,out}
    exec 3<>"$work/uart.in" 4<>"$work/uart.out" 5<>"$work/qmp.in" 6<>"$work/qmp.out"
    : >"$work/said"
    qemu-system-arm -M "$machine" -display none -monitor none -serial "pipe:$work/uart" \
        -qmp "pipe:$work/qmp" -d guest_errors,unimp -D "$work/log" -kernel "$elf" "$@" \
        </dev/null >"$work/out" 2>"$work/errors" 3>&- 4>&- 5>&- 6>&- &
    qemu_pid=$!
    qmp '{"execute":"qmp_capabilities"}'
}

# qmp COMMAND: waits for its answer.
qmp() {
    local line
    echo "$1" >&5
    while IFS= read -r -t 20 line <&6; do
        case $line in
        *'"return"'*) return 0 ;;
        *'"error"'*) echo "# monitor: $line" && return 1 ;;
        esac
    done
    echo "# the monitor does not answer: $1"
    return 1
}

# hear PATTERN [SECONDS]: reads lines of the board until one fits; it is then in $heard.
hear() {
    while IFS= read -r -t "${2:-20}" heard <&4; do
        heard=${heard//[$'\r\x11\x13']/} # and XON, XOFF
        echo "$heard" >>"$work/said"
        # shellcheck disable=SC2053 # a pattern is meant
        [[ $heard != $1 ]] || return 0
    done
    echo "# the board did not say '$1'; it said:"
    sed 's/^/#   /' "$work/said" | tail -n 12
    return 1
}

tell() { # BYTES for the serial port, as printf has them
    # shellcheck disable=SC2059 # escapes are meant
    printf "$1" >&3
}

key() { # QCODE true|false: a button goes down or up
    qmp '{"execute":"input-send-event","arguments":{"events":[{"type":"key","data":
        {"down":'"$2"',"key":{"type":"qcode","data":"'"$1"'"}}}]}}' 2>/dev/null
}

# look FILE.ppm [FACTOR [rgb565]]: the panel's picture; a pixel is FACTOR times FACTOR (1) large.
look() {
    qmp '{"execute":"screendump","arguments":{"filename":"'"$work/dump.ppm"'"}}' &&
        "$O/tests/panel_dump" "${2:-1}" "${@:3}" <"$work/dump.ppm" >"$1"
}

qemu_stop() {
    if [ -n "$qemu_pid" ]; then
        echo '{"execute":"quit"}' >&5
        for _ in 1 2 3 4 5 6 7 8 9 10; do
            kill -0 "$qemu_pid" 2>/dev/null || break
            sleep 0.1
        done
        kill "$qemu_pid" 2>/dev/null || true
        wait "$qemu_pid" 2>/dev/null || true
        qemu_pid=
        exec 3>&- 4>&- 5>&- 6>&-
    fi
}

# No access that QEMU calls an error, nothing that the panel's model does not know.
qemu_clean() { # NAME
    if [ -s "$work/log" ]; then
        not_ok "$1" "guest errors: $(head -n 3 "$work/log" | tr '\n' ' ')"
    elif grep -v '^Timer with period zero' "$work/errors" >&2; then
        not_ok "$1" "messages of the machine, above"
    else
        ok "$1"
    fi
}
