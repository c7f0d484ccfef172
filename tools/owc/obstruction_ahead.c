/* SPDX-License-Identifier: 0BSD */
/* A switch's halves, cut in floating point alone, and their components. */
#include "obstruction_ahead.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "obstruction_components.h"
#include "obstruction_plane.h"
#include "tools/common/xalloc.h"

/* The part of a face on one side (1: in front); a convex one has at most one corner more. */
static uint32_t cut_off(const struct obstruction_set *set, const struct obstruction_face *face,
                        const double normal[3], double offset, int side, double (*out)[3])
{
    const double(*points)[3] = (const double(*)[3])set->points + face->first;
    uint32_t count = 0;
    for (uint32_t i = 0; i < face->count; i++) {
        const double *a = points[i];
        const double *b = points[i + 1 < face->count ? i + 1 : 0];
        double s = side * (normal[0] * a[0] + normal[1] * a[1] + normal[2] * a[2] + offset);
        double t = side * (normal[0] * b[0] + normal[1] * b[1] + normal[2] * b[2] + offset);
        if (s >= 0) {
            memcpy(out[count++], a, sizeof out[0]);
        }
        if ((s < 0) != (t < 0)) {
            for (int k = 0; k < 3; k++) {
                out[count][k] = a[k] + s / (s - t) * (b[k] - a[k]);
            }
            count++;
        }
    }
    return count;
}

static double bits_of_half(const struct obstruction_set *set, const double normal[3], double offset,
                           const uint8_t *places, int side)
{
    struct obstruction_set half = *set;
    uint8_t here = side > 0 ? OBSTRUCTION_FRONT : OBSTRUCTION_BACK;
    size_t points = 0;
    half.count = 0;
    half.relations = 0;
    for (uint32_t i = 0; i < set->count; i++) {
        points += 2 * (size_t)set->faces[i].count;
    }
    half.faces = xalloc(set->count, sizeof *half.faces);
    half.points = xalloc(points, sizeof *half.points);
    points = 0;
    for (uint32_t i = 0; i < set->count; i++) {
        if (places[i] != here && places[i] != OBSTRUCTION_ACROSS) {
            continue;
        }
        const struct obstruction_face *face = &set->faces[i];
        struct obstruction_face *part = &half.faces[half.count];
        *part = *face;
        part->first = points;
        if (places[i] == here) {
            memcpy(half.points + points, set->points + face->first,
                   face->count * sizeof *half.points);
        } else {
            part->rough = true;
            part->count = cut_off(set, face, normal, offset, side, half.points + points);
        }
        if (part->count > 0) {
            points += part->count;
            half.count++;
        }
    }
    double bits = 0;
    if (half.count > 1) {
        struct components c;
        components_find(&c, &half);
        for (uint32_t i = 0; i < c.count; i++) {
            double n = c.starts[i + 1] - c.starts[i];
            bits += n * log2(n);
        }
        components_free(&c);
    }
    free(half.faces);
    free(half.points);
    return bits;
}

double obstruction_bits_ahead(const struct obstruction_set *set, const double normal[3],
                              double offset, const uint8_t *places)
{
    return bits_of_half(set, normal, offset, places, 1) +
           bits_of_half(set, normal, offset, places, -1);
}
