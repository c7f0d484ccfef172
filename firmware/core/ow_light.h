/* SPDX-License-Identifier: 0BSD */
/* What the shadings share: normals, lights and colours. Inline: these run for every face. */
#ifndef OW_LIGHT_H
#define OW_LIGHT_H

#include "ow_read.h"
#include "ow_shade.h"

enum {
    OW_INTENSITY_MAX = 32 * 256,             /* brighter lights are taken for this: 32 times full */
    OW_LIGHT_FULL = OW_INTENSITY_FULL << 16, /* a sum of light that is full */
    OW_PER_NORMAL_Q22 = 33026,               /* 2^22 / 127: normals are 127 long */
    OW_PLACE_MAX = 11 * (OW_EYE_MAX / 4)     /* of a point of light: an eye and a camera's reach */
};
_Static_assert(3 * 128 * (OW_INTENSITY_MAX * (int64_t)OW_PER_NORMAL_Q22 / 64 + 1) < INT32_MAX,
               "the sum of three products of a normal and light_q16 fits 32 bits");
_Static_assert((OW_LIGHTS_MAX + 1LL) * OW_LIGHT_FULL < INT32_MAX, "all lights' sum fits 32 bits");

/* A stored normal of the side that is seen; the cap's where a cut shows the inside. */
static inline void ow_seen_normal(const struct ow_shader *shader, const ow_byte *bytes,
                                  uint32_t normal_at, bool reverse, int32_t normal[3])
{
    for (uint32_t i = 0; i < 3; i++) {
        int32_t n = ow_read_i8(bytes, normal_at + i);
        normal[i] = !reverse ? n : shader->caps ? shader->cap_normal[i] : -n;
    }
}

/* What the directional lights add at a normal: OW_LIGHT_FULL for full, at most that for each. */
static inline int32_t ow_shine_directional(const struct ow_shader *shader, const int32_t normal[3])
{
    int32_t sum = 0;
    for (uint32_t i = 0; i < shader->directional; i++) {
        const int32_t *along = shader->lights[i].light_q16;
        int32_t light = normal[0] * along[0] + normal[1] * along[1] + normal[2] * along[2];
        light = light < OW_LIGHT_FULL ? light : OW_LIGHT_FULL;
        sum += light > 0 ? light : 0;
    }
    return sum;
}

/* Sets a directional light, whose intensity is known, from its direction in model axes. */
static inline void ow_light_set_direction(struct ow_ready_light *light,
                                          const int32_t towards_q14[3])
{
    for (uint32_t i = 0; i < 3; i++) {
        int32_t t = towards_q14[i];
        t = t > 1 << 14 ? 1 << 14 : t < -(1 << 14) ? -(1 << 14) : t;
        int64_t along = (int64_t)t * light->intensity_q8;
        light->towards_q14[i] = (int16_t)t;
        light->light_q16[i] = (int32_t)((along * OW_PER_NORMAL_Q22) >> (14 + 22 - 16));
    }
}

/* A sum of light as intensity, 65536 for full. */
static inline int32_t ow_intensity_q16(int32_t sum)
{
    return (sum < OW_LIGHT_FULL ? sum : OW_LIGHT_FULL) >> 8;
}

/* The effect's share of a face's nearest corner; with has_depth. */
int32_t ow_face_share(const struct ow_shader *shader, const struct ow_tree *tree,
                      const struct ow_face *face);

/* Vertex number vertex of the tree, lattice steps. */
static inline void ow_read_vertex(const struct ow_tree *tree, uint32_t vertex, int32_t place[3])
{
    uint32_t at = tree->vertices_at + vertex * OW_VERTEX_BYTES;
    for (uint32_t i = 0; i < 3; i++) {
        place[i] = ow_read_i16(tree->bytes, at + 2 * i);
    }
}

/* A colour under an intensity 0 .. 256, each channel rounded down. */
static inline uint32_t ow_scale_colour(uint32_t colour, uint32_t intensity)
{
    uint32_t red_blue = (colour & 0xFF00FF) * intensity >> 8;
    uint32_t green = (colour & 0x00FF00) * intensity >> 8;
    return (red_blue & 0xFF00FF) | (green & 0x00FF00);
}

static inline uint32_t ow_add_white(uint32_t colour, uint32_t shift, uint32_t white)
{
    uint32_t sum = (colour >> shift & 255) + white;
    return (sum > 255 ? 255 : sum) << shift;
}

/* A colour with a highlight of 0 .. 255. */
static inline uint32_t ow_add_whites(uint32_t colour, uint32_t white)
{
    if (white == 0) {
        return colour;
    }
    return ow_add_white(colour, 16, white) | ow_add_white(colour, 8, white) |
           ow_add_white(colour, 0, white);
}

/* A direction given right, up, towards the viewer, in model axes. */
void ow_to_model(int32_t model[3], const int32_t camera[3], const struct ow_view *view);

/* 2^30 / sqrt(x) for x in 2^28 .. 2^30, within 2^-11: a line and two Newton steps. */
static inline uint32_t ow_reciprocal_root(uint32_t x)
{
    uint32_t y = 70900 - (x >> 15) - (x >> 17); /* 2^15 .. 2^16, within a tenth */
    for (int i = 0; i < 2; i++) {
        uint32_t square = (uint32_t)(((uint64_t)y * y) >> 15);       /* 2^15 .. 2^17 */
        uint32_t product = (uint32_t)(((uint64_t)square * x) >> 30); /* near 2^15 */
        y = (uint32_t)(((uint64_t)y * (3 * 32768 - product)) >> 16);
    }
    return y;
}

/* Scales v (components below 2^15 in size) to unit length, 14 fraction bits; 0 stays 0. */
static inline void ow_make_unit_q14(int32_t v[3])
{
    uint32_t squares = (uint32_t)(v[0] * v[0]) + (uint32_t)(v[1] * v[1]) + (uint32_t)(v[2] * v[2]);
    if (squares == 0) {
        return;
    }
    /* squares * 4^shift is in 2^28 .. 2^30 */
    int32_t shift = ((int32_t)ow_leading_zeros(squares) - 2) >> 1;
    squares = shift < 0 ? squares >> 2 : squares << (2 * shift);
    int32_t root = (int32_t)ow_reciprocal_root(squares); /* 2^15 * 2^15 / length */
    for (int i = 0; i < 3; i++) {
        int64_t scaled = (int64_t)v[i] * root;
        v[i] =
            (int32_t)(shift < 0 ? scaled >> (16 - shift) : (scaled * ((int64_t)1 << shift)) >> 16);
    }
}

#endif
