/* SPDX-License-Identifier: 0BSD */
/* The functions that belong together because they read trees alike. */
#include "engine.h"

#include "ow_surface.h"

const struct engine ow_engine = {
    .tree_open = ow_tree_open,
    .parts = &ow_parts_all,
    .segments = &ow_surface_segments,
    .bytes_needed = ow_viewer_bytes_needed,
    .start = ow_viewer_start,
    .step = ow_viewer_step,
    .restart = ow_viewer_restart,
};
