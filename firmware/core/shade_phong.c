/* SPDX-License-Identifier: 0BSD */
/*
 * Phong shading: normals at the corners, interpolated; directional lights and
 * their highlights at each pixel, around the vector halfway between light and
 * viewer. Points of light have no highlight, and what they add is interpolated
 * from the corners. Parts: the normal, 8128 times the unit vector; with points
 * of light, what they add, 65536 for full.
 */
#include "ow_light.h"

enum { NORMAL_BITS = 6 }; /* normals are 64 times the stored ones */

static void make(struct ow_shader *shader)
{
    static const int32_t viewer_q14[3] = { 0, 0, 1 << 14 };
    int32_t viewer[3];
    ow_to_model(viewer, viewer_q14, shader->view);
    for (uint32_t k = 0; k < shader->directional; k++) {
        struct ow_ready_light *light = &shader->lights[k];
        int32_t halfway[3];
        for (int i = 0; i < 3; i++) {
            halfway[i] = (light->towards_q14[i] + viewer[i]) / 2;
        }
        ow_make_unit_q14(halfway);
        for (int i = 0; i < 3; i++) {
            light->halfway_q14[i] = (int16_t)halfway[i];
        }
    }
}

static void corner(const struct ow_shader *shader, const struct ow_tree *tree, uint32_t vertex,
                   bool reverse, struct ow_corner_light *light)
{
    int32_t normal[3];
    ow_seen_normal(shader, tree->bytes, tree->normals_at + vertex * OW_NORMAL_BYTES, reverse,
                   normal);
    for (uint32_t i = 0; i < 3; i++) {
        light->part[i] = normal[i] * (1 << NORMAL_BITS);
    }
    if (shader->points > 0) {
        int32_t place[3];
        ow_read_vertex(tree, vertex, place);
        light->part[3] = ow_intensity_q16(shader->point->shine(shader, normal, place));
    }
}

static int32_t dot_q14(const int32_t a[3], const int16_t b[3])
{
    return (a[0] * b[0] + a[1] * b[1] + a[2] * b[2]) >> 14;
}

/* How bright the highlight is: the cosine, raised to the shininess, 14 fraction bits. */
static uint32_t gleam_q14(const struct ow_shader *shader, int32_t cosine)
{
    int32_t gleam = cosine < 0 ? 0 : cosine > 1 << 14 ? 1 << 14 : cosine;
    for (uint32_t i = 0; i < shader->shininess; i++) {
        gleam = (gleam * gleam) >> 14;
    }
    return (uint32_t)gleam;
}

static inline uint32_t pixel(const struct ow_shader *shader, uint32_t colour,
                             const struct ow_corner_light *light)
{
    int32_t normal[3] = { light->part[0], light->part[1], light->part[2] };
    ow_make_unit_q14(normal);
    int32_t intensity = shader->ambient_q16 >> 16;
    uint32_t white = 0;
    for (uint32_t k = 0; k < shader->directional; k++) {
        const struct ow_ready_light *source = &shader->lights[k];
        int32_t cosine = dot_q14(normal, source->towards_q14);
        if (cosine > 0) {
            intensity += (cosine * source->intensity_q8) >> 14;
            uint32_t gleam = gleam_q14(shader, dot_q14(normal, source->halfway_q14));
            white += (gleam * (uint32_t)shader->specular_q8 * 255) >> 22;
        }
    }
    if (shader->points > 0) {
        intensity += light->part[3] >> 8;
    }
    uint32_t bounded = intensity > OW_INTENSITY_FULL ? OW_INTENSITY_FULL : (uint32_t)intensity;
    return shader->effect == NULL ? ow_add_whites(ow_scale_colour(colour, bounded), white)
                                  : shader->effect->finish(shader, colour, bounded, white,
                                                           light->part[shader->parts - 1]);
}

static void run(const struct ow_shader *shader, uint32_t colour, const struct ow_ramp *ramps,
                uint32_t first, uint32_t end, uint32_t *rgb)
{
    for (uint32_t x = first; x < end; x++) {
        struct ow_corner_light light = { { ow_ramp_value(&ramps[0], x), ow_ramp_value(&ramps[1], x),
                                           ow_ramp_value(&ramps[2], x) } };
        for (uint32_t i = 3; i < shader->parts; i++) {
            light.part[i] = ow_ramp_value(&ramps[i], x);
        }
        *rgb++ = pixel(shader, colour, &light);
    }
}

const struct ow_shading ow_shading_phong = {
    .is_smooth = true,
    .parts = 3,
    .make = make,
    .face = ow_face_colour,
    .corner = corner,
    .pixel = pixel,
    .run = run,
};
