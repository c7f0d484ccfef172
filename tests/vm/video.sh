#!/bin/bash
# SPDX-License-Identifier: 0BSD
# oldwell to a V4L2 output in four formats, and with a camera's picture behind the model.
exec "$(dirname "$0")/lib/run" video
