/* SPDX-License-Identifier: 0BSD */
/* Stage "shade": colours from normals, materials and the light. */
#ifndef OW_SHADE_H
#define OW_SHADE_H

#include <stdbool.h>
#include <stdint.h>

#include "ow_draw.h"
#include "ow_project.h"

/* The look of one frame, made ready. */
struct ow_shader {
    bool caps;    /* backs are drawn as the flat cap of a cut */
    uint32_t cap; /* its colour */
    int8_t cap_normal[3];
    enum ow_shade shade;
    int32_t ambient_q16;
    int32_t light_q16[3];   /* intensity (256 is full) that one unit of an i8 normal adds */
    int32_t towards_q14[3]; /* unit vector to the light, model axes */
    int32_t halfway_q14[3]; /* Phong: unit vector between light and viewer, model axes */
    int32_t light_q8;
    int32_t specular_q8;
    uint32_t shininess;
    uint32_t parts; /* that smooth shading interpolates */
    bool is_plain;  /* neither map nor depth cue */
    enum ow_map map;
    uint32_t background; /* 0x00RRGGBB */
    uint32_t foreground;
    /* Depth cue: share = (depth_far - z) * depth_scale, camera units, 65536 for 1. */
    bool has_depth;
    int32_t depth_far;
    struct ow_scale depth_scale;
    const struct ow_view *view;
};

void ow_shader_make(struct ow_shader *shader, const struct ow_look *look,
                    const struct ow_view *view);

/* The material's colour of a face, 0x00RRGGBB; OW_SHADE_ID: its source polygon's number. */
uint32_t ow_face_colour(const struct ow_shader *shader, const struct ow_tree *tree,
                        const struct ow_face *face);

/* The colour of a face that has one normal, 0x00RRGGBB. */
uint32_t ow_shade_face(const struct ow_shader *shader, const struct ow_tree *tree,
                       const struct ow_face *face);

/* What smooth shading interpolates from this vertex on. The tree has normals. */
struct ow_corner_light ow_shade_corner(const struct ow_shader *shader, const struct ow_tree *tree,
                                       uint32_t vertex, bool reverse);

/* The colour of a pixel from the face's colour and what was interpolated. */
uint32_t ow_shade_pixel(const struct ow_shader *shader, uint32_t colour,
                        const struct ow_corner_light *light);

/* The map's colour at an intensity 0 .. 256; not for OW_MAP_NONE. */
uint32_t ow_map_colour(enum ow_map map, uint32_t intensity);

/* From a to b by share, 0 .. 256, channel by channel, rounded to the nearest. */
static inline uint32_t ow_mix(uint32_t a, uint32_t b, uint32_t share)
{
    uint32_t rest = 256 - share;
    uint32_t red_blue = (a & 0xFF00FF) * rest + (b & 0xFF00FF) * share + 0x800080;
    uint32_t green = (a & 0x00FF00) * rest + (b & 0x00FF00) * share + 0x008000;
    return (red_blue >> 8 & 0xFF00FF) | (green >> 8 & 0x00FF00);
}

static inline bool ow_shade_is_smooth(enum ow_shade shade)
{
    return shade == OW_SHADE_GOURAUD || shade == OW_SHADE_PHONG;
}

#endif
