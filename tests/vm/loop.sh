#!/bin/bash
# SPDX-License-Identifier: 0BSD
# oldwell's loop: what it costs at rest, that it leaves the heap alone, signals, a changed tree.
exec "$(dirname "$0")/lib/run" loop
