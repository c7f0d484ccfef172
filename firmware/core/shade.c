/* SPDX-License-Identifier: 0BSD */
/*
 * Stage "shade". Intensity is ambient plus directional light times the cosine
 * of its angle of incidence, at most 1, times the material's colour; Phong adds
 * a white highlight around the vector halfway between light and viewer.
 */
#include "ow_shade.h"

#include "ow_read.h"

enum {
    FULL = 256,             /* intensity that shows a colour as it is */
    PER_NORMAL_Q22 = 33026, /* 2^22 / 127: normals are 127 long */
    NORMAL_BITS = 6         /* Phong's normals: 64 times the stored ones */
};

/* A direction given right, up, towards the viewer, in model axes. */
static void to_model(int32_t model[3], const int32_t camera[3], const struct ow_view *view)
{
    for (int i = 0; i < 3; i++) {
        int64_t sum = (int64_t)camera[0] * view->right[i] + (int64_t)camera[1] * view->up[i] -
                      (int64_t)camera[2] * view->forward[i];
        model[i] = (int32_t)(sum >> 30);
    }
}

/* 2^30 / sqrt(x) for x in 2^28 .. 2^30, within 2^-11: a line and two Newton steps. */
static uint32_t reciprocal_root(uint32_t x)
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
static void make_unit(int32_t v[3])
{
    uint32_t squares = (uint32_t)(v[0] * v[0]) + (uint32_t)(v[1] * v[1]) + (uint32_t)(v[2] * v[2]);
    if (squares == 0) {
        return;
    }
    int32_t shift = 0; /* squares * 4^shift is in 2^28 .. 2^30 */
    while (squares >= 1u << 30) {
        squares >>= 2;
        shift--;
    }
    while (squares < 1u << 28) {
        squares <<= 2;
        shift++;
    }
    int32_t root = (int32_t)reciprocal_root(squares); /* 2^15 * 2^15 / length */
    for (int i = 0; i < 3; i++) {
        int64_t scaled = (int64_t)v[i] * root;
        v[i] =
            (int32_t)(shift < 0 ? scaled >> (16 - shift) : (scaled * ((int64_t)1 << shift)) >> 16);
    }
}

/* A distance in camera units. */
static int32_t to_depth(ow_q8 distance, const struct ow_view *view)
{
    int64_t z = ((int64_t)distance << 30) >> view->camera_shift;
    return z > INT32_MAX ? INT32_MAX : (int32_t)z;
}

static void make_depth_cue(struct ow_shader *shader, const struct ow_look *look,
                           const struct ow_view *view)
{
    shader->has_depth = look->depth_far > 0;
    if (shader->has_depth) {
        int32_t near = to_depth(look->depth_near, view);
        shader->depth_far = to_depth(look->depth_far, view);
        uint32_t range = (uint32_t)shader->depth_far - (uint32_t)near;
        shader->depth_scale = ow_scale_of(65536, range == 0 ? 1 : range);
    }
}

void ow_shader_make(struct ow_shader *shader, const struct ow_look *look,
                    const struct ow_view *view)
{
    static const int32_t viewer_q14[3] = { 0, 0, 1 << 14 };
    shader->shade = look->shade;
    shader->ambient_q16 = look->ambient_q8 * 65536;
    shader->light_q8 = look->light.intensity_q8;
    shader->specular_q8 = look->specular_q8;
    shader->shininess = look->shininess;
    shader->map = look->map;
    shader->background = look->background;
    shader->foreground = look->foreground;
    shader->view = view;
    make_depth_cue(shader, look, view);
    shader->is_plain = look->map == OW_MAP_NONE && !shader->has_depth;
    shader->parts = (look->shade == OW_SHADE_PHONG ? 3u : 1u) + shader->has_depth;
    int32_t viewer[3];
    to_model(viewer, viewer_q14, view);
    for (int i = 0; i < 3; i++) {
        shader->towards_q14[i] = look->light.direction_q14[i];
    }
    if (!look->light.in_model_space) {
        to_model(shader->towards_q14,
                 (const int32_t[3]){ look->light.direction_q14[0], look->light.direction_q14[1],
                                     look->light.direction_q14[2] },
                 view);
    }
    for (int i = 0; i < 3; i++) {
        shader->halfway_q14[i] = (shader->towards_q14[i] + viewer[i]) / 2;
        int64_t along = (int64_t)shader->towards_q14[i] * look->light.intensity_q8;
        shader->light_q16[i] = (int32_t)((along * PER_NORMAL_Q22) >> (14 + 22 - 16));
    }
    make_unit(shader->halfway_q14);
    shader->caps = view->cuts && look->caps;
    shader->cap = look->cap;
    for (int i = 0; i < 3 && view->cuts; i++) { /* the cap looks at what was taken away */
        int64_t kept = ((int64_t)view->cut_axis[i] * 127 + (1 << 29)) >> 30;
        shader->cap_normal[i] = (int8_t)-kept;
    }
}

static uint32_t scale_channel(uint32_t colour, uint32_t shift, uint32_t intensity)
{
    return ((colour >> shift & 255) * intensity / FULL) << shift;
}

static uint32_t scale_colour(uint32_t colour, uint32_t intensity)
{
    return scale_channel(colour, 16, intensity) | scale_channel(colour, 8, intensity) |
           scale_channel(colour, 0, intensity);
}

/* A stored normal of the side that is seen; the cap's where a cut shows the inside. */
static void seen_normal(const struct ow_shader *shader, const ow_byte *bytes, uint32_t normal_at,
                        bool reverse, int32_t normal[3])
{
    for (uint32_t i = 0; i < 3; i++) {
        int32_t n = ow_read_i8(bytes, normal_at + i);
        normal[i] = !reverse ? n : shader->caps ? shader->cap_normal[i] : -n;
    }
}

/* Intensity at a stored normal, 65536 for full. */
static int32_t intensity_q16(const struct ow_shader *shader, const ow_byte *bytes,
                             uint32_t normal_at, bool reverse)
{
    int32_t normal[3];
    seen_normal(shader, bytes, normal_at, reverse, normal);
    int64_t light = 0;
    for (uint32_t i = 0; i < 3; i++) {
        light += (int64_t)normal[i] * shader->light_q16[i];
    }
    int64_t intensity = (shader->ambient_q16 + (light > 0 ? light : 0)) >> 8;
    return intensity > 65536 ? 65536 : (int32_t)intensity;
}

uint32_t ow_face_colour(const struct ow_shader *shader, const struct ow_tree *tree,
                        const struct ow_face *face)
{
    const ow_byte *bytes = tree->bytes;
    if (shader->shade == OW_SHADE_ID) {
        return (tree->flags & OW_TREE_IDS)
                   ? ow_read_u32(bytes, face->at + OW_POLYGON_HEAD_BYTES) & 0xFFFFFF
                   : 0xFFFFFF;
    }
    if (face->reverse && shader->caps) {
        return shader->cap;
    }
    uint32_t number = ow_read_u16(bytes, face->at + 4) & OW_POLYGON_COLOUR_MASK;
    return ow_read_u32(bytes, tree->colours_at + number * OW_COLOUR_BYTES);
}

/* How much of its colour a point at this depth shows, 0 .. 65536. */
static int32_t depth_share(const struct ow_shader *shader, int32_t z)
{
    int64_t left = (int64_t)shader->depth_far - z; /* below 2^32, the mantissa below 2^31 */
    int64_t share = (left * (int64_t)shader->depth_scale.mantissa) >> shader->depth_scale.exponent;
    return share < 0 ? 0 : share > 65536 ? 65536 : (int32_t)share;
}

static int32_t vertex_share(const struct ow_shader *shader, const struct ow_tree *tree,
                            uint32_t vertex)
{
    return depth_share(shader, ow_to_camera(tree, shader->view, vertex).z);
}

/* The share of a face's nearest corner. */
static int32_t face_share(const struct ow_shader *shader, const struct ow_tree *tree,
                          const struct ow_face *face)
{
    uint32_t corners = ow_read_u8(tree->bytes, face->at);
    int32_t most = 0;
    for (uint32_t i = 0; i < corners; i++) {
        int32_t share = vertex_share(shader, tree, ow_corner(tree, face->at, i));
        most = share > most ? share : most;
    }
    return most;
}

static uint32_t add_white(uint32_t colour, uint32_t shift, uint32_t white)
{
    uint32_t sum = (colour >> shift & 255) + white;
    return (sum > 255 ? 255 : sum) << shift;
}

static uint32_t add_whites(uint32_t colour, uint32_t white)
{
    return add_white(colour, 16, white) | add_white(colour, 8, white) | add_white(colour, 0, white);
}

/* What is seen of a colour under an intensity 0 .. 256 and a highlight, at share of its depth. */
static uint32_t finish(const struct ow_shader *shader, uint32_t colour, uint32_t intensity,
                       uint32_t white, int32_t share_q16)
{
    if (shader->map != OW_MAP_NONE) {
        intensity += white;
        colour = ow_map_colour(shader->map, intensity > FULL ? FULL : intensity);
    } else {
        colour = add_whites(scale_colour(colour, intensity), white);
    }
    return shader->has_depth ? ow_mix(shader->background, colour, (uint32_t)share_q16 >> 8)
                             : colour;
}

uint32_t ow_shade_face(const struct ow_shader *shader, const struct ow_tree *tree,
                       const struct ow_face *face)
{
    uint32_t colour = ow_face_colour(shader, tree, face);
    if (shader->shade == OW_SHADE_ID) {
        return colour;
    }
    int32_t share = shader->has_depth ? face_share(shader, tree, face) : 0;
    if (shader->shade == OW_SHADE_LINES) {
        colour = shader->foreground;
        return shader->has_depth ? ow_mix(shader->background, colour, (uint32_t)share >> 8)
                                 : colour;
    }
    int32_t intensity = intensity_q16(shader, tree->bytes, face->at + 1, face->reverse);
    if (shader->is_plain) {
        return scale_colour(colour, (uint32_t)intensity >> 8);
    }
    return finish(shader, colour, (uint32_t)intensity >> 8, 0, share);
}

struct ow_corner_light ow_shade_corner(const struct ow_shader *shader, const struct ow_tree *tree,
                                       uint32_t vertex, bool reverse)
{
    uint32_t at = tree->normals_at + vertex * OW_NORMAL_BYTES;
    struct ow_corner_light light = { { 0, 0, 0, 0 } };
    if (shader->has_depth) {
        light.part[shader->parts - 1] = vertex_share(shader, tree, vertex);
    }
    if (shader->shade == OW_SHADE_GOURAUD) {
        light.part[0] = intensity_q16(shader, tree->bytes, at, reverse);
        return light;
    }
    seen_normal(shader, tree->bytes, at, reverse, light.part);
    for (uint32_t i = 0; i < 3; i++) {
        light.part[i] *= 1 << NORMAL_BITS;
    }
    return light;
}

static int32_t dot_q14(const int32_t a[3], const int32_t b[3])
{
    return (a[0] * b[0] + a[1] * b[1] + a[2] * b[2]) >> 14;
}

static uint32_t shade_phong(const struct ow_shader *shader, uint32_t colour,
                            const struct ow_corner_light *light)
{
    int32_t normal[3] = { light->part[0], light->part[1], light->part[2] };
    make_unit(normal);
    int32_t cosine = dot_q14(normal, shader->towards_q14);
    int32_t intensity = shader->ambient_q16 >> 16;
    uint32_t white = 0;
    if (cosine > 0) {
        intensity += (cosine * shader->light_q8) >> 14;
        int32_t gleam = dot_q14(normal, shader->halfway_q14);
        gleam = gleam < 0 ? 0 : gleam > 1 << 14 ? 1 << 14 : gleam;
        for (uint32_t i = 0; i < shader->shininess; i++) {
            gleam = (gleam * gleam) >> 14;
        }
        white = ((uint32_t)gleam * (uint32_t)shader->specular_q8 * 255) >> 22;
    }
    uint32_t bounded = intensity > FULL ? FULL : (uint32_t)intensity;
    if (shader->is_plain) {
        return add_whites(scale_colour(colour, bounded), white);
    }
    return finish(shader, colour, bounded, white, light->part[3]);
}

uint32_t ow_shade_pixel(const struct ow_shader *shader, uint32_t colour,
                        const struct ow_corner_light *light)
{
    if (shader->shade == OW_SHADE_PHONG) {
        return shade_phong(shader, colour, light);
    }
    uint32_t intensity = (uint32_t)light->part[0] >> 8;
    return shader->is_plain ? scale_colour(colour, intensity)
                            : finish(shader, colour, intensity, 0, light->part[1]);
}
