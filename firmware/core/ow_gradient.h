/* SPDX-License-Identifier: 0BSD */
/*
 * What smooth shading interpolates, as a function of the pixel: the same value
 * for a pixel of a face wherever a run begins, in every order and band.
 */
#ifndef OW_GRADIENT_H
#define OW_GRADIENT_H

#include <stdbool.h>
#include <stdint.h>

#include "ow_project.h"

/* One part's value on a scan line: at + slope * x, 16 fraction bits, kept within low .. high. */
struct ow_ramp {
    int64_t at; /* where x is 0 */
    int64_t slope;
    int32_t low;
    int32_t high;
};

struct ow_gradient {
    const struct ow_outline_point *points;
    const struct ow_corner_light *lights;
    uint32_t count;
    bool beside;                   /* set by the caller: ow_gradient_beside will be asked */
    ow_sub8 left;                  /* beside: the line's outermost crossings, */
    ow_sub8 right_end;             /* left is greater if there are none */
    uint32_t parts;                /* 1 .. OW_LIGHT_PARTS */
    int32_t line;                  /* the one that ramp is for; -1: none */
    bool is_plane;                 /* a triangle: down and right hold for all lines */
    int64_t right[OW_LIGHT_PARTS]; /* per 1/256 pixel, 16 fraction bits */
    int64_t down[OW_LIGHT_PARTS];
    struct ow_ramp ramp[OW_LIGHT_PARTS];
};

/* Prepares the gradient of an outline; points and lights must stay. */
void ow_gradient_begin(struct ow_gradient *gradient, const struct ow_outline_point *points,
                       const struct ow_corner_light *lights, uint32_t count, uint32_t parts);

/* Makes gradient->ramp for a scan line that the outline crosses. */
void ow_gradient_line(struct ow_gradient *gradient, int32_t line);

/*
 * The values at a pixel of the ramp's line, for coverage: where its centre lies
 * beside the outline, those of the outline's nearest point.
 */
void ow_gradient_beside(const struct ow_gradient *gradient, uint32_t x,
                        struct ow_corner_light *light);

/* The value at a pixel of the ramp's line. */
static inline int32_t ow_ramp_value(const struct ow_ramp *ramp, uint32_t x)
{
    int64_t value = (ramp->at + ramp->slope * x) >> 16;
    return value < ramp->low ? ramp->low : value > ramp->high ? ramp->high : (int32_t)value;
}

#endif
