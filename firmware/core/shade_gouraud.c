/* SPDX-License-Identifier: 0BSD */
/* Gouraud shading: intensity at the corners, interpolated. Its part: that, 65536 for full. */
#include "ow_light.h"

static void corner(const struct ow_shader *shader, const struct ow_tree *tree, uint32_t vertex,
                   bool reverse, struct ow_corner_light *light)
{
    int32_t normal[3];
    ow_seen_normal(shader, tree->bytes, tree->normals_at + vertex * OW_NORMAL_BYTES, reverse,
                   normal);
    int32_t sum = shader->ambient_q16 + ow_shine_directional(shader, normal);
    if (shader->points > 0) {
        int32_t place[3];
        ow_read_vertex(tree, vertex, place);
        sum += shader->point->shine(shader, normal, place);
    }
    light->part[0] = ow_intensity_q16(sum);
}

static uint32_t pixel(const struct ow_shader *shader, uint32_t colour,
                      const struct ow_corner_light *light)
{
    uint32_t intensity = (uint32_t)light->part[0] >> 8;
    return shader->effect == NULL
               ? ow_scale_colour(colour, intensity)
               : shader->effect->finish(shader, colour, intensity, 0, light->part[1]);
}

static void run(const struct ow_shader *shader, uint32_t colour, const struct ow_ramp *ramps,
                uint32_t first, uint32_t end, uint32_t *rgb)
{
    const struct ow_ramp ramp = ramps[0];
    if (shader->effect != NULL) {
        for (uint32_t x = first; x < end; x++) {
            struct ow_corner_light light = { { ow_ramp_value(&ramp, x) } };
            light.part[1] = shader->has_depth ? ow_ramp_value(&ramps[1], x) : 0;
            *rgb++ = pixel(shader, colour, &light);
        }
        return;
    }
    for (uint32_t x = first; x < end; x++) {
        *rgb++ = ow_scale_colour(colour, (uint32_t)ow_ramp_value(&ramp, x) >> 8);
    }
}

const struct ow_shading ow_shading_gouraud = {
    .is_smooth = true,
    .parts = 1,
    .face = ow_face_colour,
    .corner = corner,
    .pixel = pixel,
    .run = run,
};
