#!/bin/bash
# SPDX-License-Identifier: 0BSD
# identity.sh: the same trees and views give the same frame bytes on this machine, on arm64 and
# on every board, and the instructions that the Cortex-M3 takes for them stay within a margin.
set -euo pipefail
cd "$(dirname "$0")/../.."
. tests/chip/qemu.bash
margin=5 # per cent: compilers of other releases differ by less
trees=("$O/chip/oldwell.owt" "$O/chip/smooth.owt")
