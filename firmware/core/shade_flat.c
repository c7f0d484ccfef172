/* SPDX-License-Identifier: 0BSD */
/* Flat shading: one normal and one colour a face. Points of light shine on its middle. */
#include "ow_light.h"

static void middle(const struct ow_tree *tree, uint32_t at, int32_t place[3])
{
    int32_t corners = (int32_t)ow_read_u8(tree->bytes, at);
    int32_t sum[3] = { 0, 0, 0 };
    for (int32_t k = 0; k < corners; k++) {
        ow_read_vertex(tree, ow_corner(tree, at, (uint32_t)k), place);
        for (int i = 0; i < 3; i++) {
            sum[i] += place[i];
        }
    }
    for (int i = 0; i < 3; i++) {
        place[i] = sum[i] / corners;
    }
}

static uint32_t face_colour(const struct ow_shader *shader, const struct ow_tree *tree,
                            const struct ow_face *face)
{
    uint32_t colour = ow_face_colour(shader, tree, face);
    int32_t normal[3];
    ow_seen_normal(shader, tree->bytes, face->at + 1, face->reverse, normal);
    int32_t sum = shader->ambient_q16 + ow_shine_directional(shader, normal);
    if (shader->points > 0) {
        int32_t place[3];
        middle(tree, face->at, place);
        sum += shader->point->shine(shader, normal, place);
    }
    uint32_t intensity = (uint32_t)ow_intensity_q16(sum) >> 8;
    if (shader->effect == NULL) {
        return ow_scale_colour(colour, intensity);
    }
    int32_t share = shader->has_depth ? ow_face_share(shader, tree, face) : 0;
    return shader->effect->finish(shader, colour, intensity, 0, share);
}

const struct ow_shading ow_shading_flat = { .face = face_colour };
