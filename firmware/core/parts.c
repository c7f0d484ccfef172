/* SPDX-License-Identifier: 0BSD */
/* All parts in one list: for programs that have the room. */
#include "ow_parts.h"

#include "ow_coverage.h"
#include "ow_dither.h"
#include "ow_frame.h"
#include "ow_lines.h"

const struct ow_parts ow_parts_all = {
    .painter = &ow_surface_painter,
    .dynamic = &ow_surface_dynamic,
    .scan_line = &ow_line_order,
    .shading = { &ow_shading_id, &ow_shading_flat, &ow_shading_gouraud, &ow_shading_phong,
                 &ow_shading_lines },
    .point = &ow_light_point,
    .effect = &ow_effect_map_and_depth,
    .coverage = &ow_faces_covering,
    .lines = &ow_faces_in_lines,
    .dither = &ow_dithering,
    .difference = &ow_differences,
    .instances = &ow_instancing,
    .skip = &ow_skipping,
    .draw_small = ow_draw_small,
};
