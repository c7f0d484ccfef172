/* SPDX-License-Identifier: 0BSD */
/*
 * Stage "shade": colours from normals, materials and lights. A shading is a
 * file shade_NAME.c with one const table; a program contains those it names.
 *
 * Intensity is ambient plus, for each light, its intensity times the cosine of
 * its angle of incidence where that is positive; all of it at most 1; times the
 * material's colour. Points of light grow no weaker with distance.
 */
#ifndef OW_SHADE_H
#define OW_SHADE_H

#include <stdbool.h>
#include <stdint.h>

#include "ow_draw.h"
#include "ow_gradient.h"
#include "ow_project.h"

enum { OW_INTENSITY_FULL = 256 }; /* the intensity that shows a colour as it is */

/* A light made ready. */
struct ow_ready_light {
    int32_t light_q16[3];   /* directional: intensity (256 is full) that a unit of an i8 normal
                               adds; a point: its place, ow_q8, within OW_PLACE_MAX */
    int16_t towards_q14[3]; /* directional: unit vector, model axes */
    int16_t halfway_q14[3]; /* Phong: unit vector between that and the viewer */
    uint16_t intensity_q8;  /* at most OW_INTENSITY_MAX */
};

struct ow_shader;

/* Lights of another kind than the directional: a file light_NAME.c. */
struct ow_light_kind {
    void (*make)(struct ow_ready_light *ready, const struct ow_light *light,
                 const struct ow_view *view);
    /*
     * The intensity that the shader's lights of this kind add where the normal (127 long) and
     * the place (lattice steps) are these: OW_INTENSITY_FULL << 16 for full, at most that for each.
     */
    int32_t (*shine)(const struct ow_shader *shader, const int32_t normal[3],
                     const int32_t place[3]);
};

struct ow_shading {
    bool is_smooth; /* it interpolates between the corners; the tree must have normals */
    uint8_t parts;  /* that it interpolates, without points of light and effect */
    void (*make)(struct ow_shader *shader); /* when the lights are ready; NULL: nothing to do */
    /* Flat: the colour of a face, 0x00RRGGBB. Smooth: of its material. */
    uint32_t (*face)(const struct ow_shader *shader, const struct ow_tree *tree,
                     const struct ow_face *face);
    /* Smooth: what is interpolated from this vertex on. */
    void (*corner)(const struct ow_shader *shader, const struct ow_tree *tree, uint32_t vertex,
                   bool reverse, struct ow_corner_light *light);
    /* Smooth: the colour of a pixel from the face's colour and what was interpolated. */
    uint32_t (*pixel)(const struct ow_shader *shader, uint32_t colour,
                      const struct ow_corner_light *light);
    /* Smooth: the same for pixels first .. end-1 of the ramps' line. */
    void (*run)(const struct ow_shader *shader, uint32_t colour, const struct ow_ramp *ramps,
                uint32_t first, uint32_t end, uint32_t *rgb);
};

extern const struct ow_shading ow_shading_id;
extern const struct ow_shading ow_shading_flat;
extern const struct ow_shading ow_shading_gouraud;
extern const struct ow_shading ow_shading_phong;
extern const struct ow_shading ow_shading_lines;

/* What becomes of intensity and colour in the end: a file effect_NAME.c. */
struct ow_effect {
    void (*make)(struct ow_shader *shader, const struct ow_look *look, const struct ow_view *view);
    /* The share of its colour that a vertex shows, 65536 for all: interpolated if has_depth. */
    int32_t (*share)(const struct ow_shader *shader, const struct ow_tree *tree, uint32_t vertex);
    /* What is seen of a colour under an intensity 0 .. 256 and a highlight of 0 .. 255. */
    uint32_t (*finish)(const struct ow_shader *shader, uint32_t colour, uint32_t intensity,
                       uint32_t white, int32_t share_q16);
};

extern const struct ow_light_kind ow_light_point;
extern const struct ow_effect ow_effect_map_and_depth;

/* The look of one frame, made ready. */
struct ow_shader {
    const struct ow_shading *shading;
    const struct ow_effect *effect; /* NULL: none */
    enum ow_shade shade;
    bool caps;    /* backs are drawn as the flat cap of a cut */
    uint32_t cap; /* its colour */
    int8_t cap_normal[3];
    uint8_t directional; /* lights[0 .. directional-1]; points come after them */
    uint8_t points;
    uint8_t parts; /* that smooth shading interpolates */
    uint8_t shininess;
    bool has_depth;
    int32_t ambient_q16;
    int32_t specular_q8;
    struct ow_ready_light lights[OW_LIGHTS_MAX];
    const struct ow_light_kind *point;
    uint32_t background; /* 0x00RRGGBB */
    uint32_t foreground;
    /* The effect's: share = (depth_far - z) * depth_scale, camera units, 65536 for 1. */
    enum ow_map map;
    int32_t depth_far;
    struct ow_scale depth_scale;
    const struct ow_view *view;
};

/* The parts hold what the look needs. */
void ow_shader_make(struct ow_shader *shader, const struct ow_parts *parts,
                    const struct ow_look *look, const struct ow_view *view);

static inline bool ow_look_has_effect(const struct ow_look *look)
{
    return look->map != OW_MAP_NONE || look->depth_far > 0;
}

/* The material's colour of a face, 0x00RRGGBB. */
uint32_t ow_face_colour(const struct ow_shader *shader, const struct ow_tree *tree,
                        const struct ow_face *face);

/* The colour of a face that has one normal, 0x00RRGGBB; of smooth shading: its material's. */
static inline uint32_t ow_shade_face(const struct ow_shader *shader, const struct ow_tree *tree,
                                     const struct ow_face *face)
{
    return shader->shading->face(shader, tree, face);
}

/* What smooth shading interpolates from this vertex on, its parts. The tree has normals. */
static inline void ow_shade_corner(const struct ow_shader *shader, const struct ow_tree *tree,
                                   uint32_t vertex, bool reverse, struct ow_corner_light *light)
{
    shader->shading->corner(shader, tree, vertex, reverse, light);
    if (shader->has_depth) {
        light->part[shader->parts - 1] = shader->effect->share(shader, tree, vertex);
    }
}

/* The colour of a pixel from the face's colour and what was interpolated. */
static inline uint32_t ow_shade_pixel(const struct ow_shader *shader, uint32_t colour,
                                      const struct ow_corner_light *light)
{
    return shader->shading->pixel(shader, colour, light);
}

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
