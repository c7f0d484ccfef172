/* SPDX-License-Identifier: 0BSD */
/* Effects: pseudo-colour in the place of the material's colour, and the depth cue. */
#include "ow_light.h"

/* A distance in camera units. */
static int32_t to_depth(ow_q8 distance, const struct ow_view *view)
{
    int64_t z = ((int64_t)distance << 30) >> view->camera_shift;
    return z > INT32_MAX ? INT32_MAX : (int32_t)z;
}

static void make(struct ow_shader *shader, const struct ow_look *look, const struct ow_view *view)
{
    shader->map = look->map;
    shader->has_depth = look->depth_far > 0;
    if (shader->has_depth) {
        int32_t near = to_depth(look->depth_near, view);
        shader->depth_far = to_depth(look->depth_far, view);
        uint32_t range = (uint32_t)shader->depth_far - (uint32_t)near;
        shader->depth_scale = ow_scale_of(65536, range == 0 ? 1 : range);
    }
}

static int32_t share(const struct ow_shader *shader, const struct ow_tree *tree, uint32_t vertex)
{
    int32_t z = ow_to_camera(tree, shader->view, vertex).z;
    int64_t left = (int64_t)shader->depth_far - z; /* below 2^32, the mantissa below 2^31 */
    int64_t part = (left * (int64_t)shader->depth_scale.mantissa) >> shader->depth_scale.exponent;
    return part < 0 ? 0 : part > 65536 ? 65536 : (int32_t)part;
}

static uint32_t finish(const struct ow_shader *shader, uint32_t colour, uint32_t intensity,
                       uint32_t white, int32_t share_q16)
{
    if (shader->map != OW_MAP_NONE) {
        intensity += white;
        colour = ow_map_colour(shader->map,
                               intensity > OW_INTENSITY_FULL ? OW_INTENSITY_FULL : intensity);
    } else {
        colour = ow_add_whites(ow_scale_colour(colour, intensity), white);
    }
    return shader->has_depth ? ow_mix(shader->background, colour, (uint32_t)share_q16 >> 8)
                             : colour;
}

const struct ow_effect ow_effect_map_and_depth = { .make = make, .share = share, .finish = finish };
