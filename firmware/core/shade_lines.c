/* SPDX-License-Identifier: 0BSD */
/* Shading of outlines: the foreground's colour. */
#include "ow_light.h"

static uint32_t line_colour(const struct ow_shader *shader, const struct ow_tree *tree,
                            const struct ow_face *face)
{
    return shader->has_depth ? ow_mix(shader->background, shader->foreground,
                                      (uint32_t)ow_face_share(shader, tree, face) >> 8)
                             : shader->foreground;
}

const struct ow_shading ow_shading_lines = { .face = line_colour };
