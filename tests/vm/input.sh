#!/bin/bash
# SPDX-License-Identifier: 0BSD
# oldwell's buttons, rotary encoder, keys and joystick, driven from outside.
exec "$(dirname "$0")/lib/run" input
