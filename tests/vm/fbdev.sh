#!/bin/bash
# SPDX-License-Identifier: 0BSD
# oldwell on frame buffers of two depths and on virtio-gpu's, and what goes wrong with them.
exec "$(dirname "$0")/lib/run" fbdev
