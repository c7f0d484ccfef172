#!/bin/bash
# SPDX-License-Identifier: 0BSD
# oldwell by DRM on a virtio-gpu: pixels, page flips, other programs, a card that goes and comes.
exec "$(dirname "$0")/lib/run" drm
