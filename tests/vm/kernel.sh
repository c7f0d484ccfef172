#!/bin/bash
# SPDX-License-Identifier: 0BSD
# The guest and the instruments by themselves: plain writers draw, each device shows it.
exec "$(dirname "$0")/lib/run" kernel
