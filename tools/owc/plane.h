/* SPDX-License-Identifier: 0BSD */
/*
 * Plane records: one integer plane for all polygons that were coplanar before
 * snapping, whichever way they face.
 */
#ifndef OWC_PLANE_H
#define OWC_PLANE_H

#include <stddef.h>
#include <stdint.h>

#include "exact.h"
#include "mesh.h"

struct planes {
    struct plane *all;
    uint32_t count;
    size_t capacity;
    uint32_t tolerance_q8; /* side tests: lattice steps with 8 fraction bits */
    uint32_t shared;       /* planes that carry more than one polygon */
};

/* Groups the mesh's polygons by plane; sets record and reversed of each. */
void plane_group(struct planes *planes, struct mesh *mesh, const struct model *model,
                 uint32_t tolerance_q8);

/* Makes a plane that is among no planes yet; see plane_add. */
void plane_set(struct plane *plane, const int32_t n[3], int64_t d, int64_t reach,
               uint32_t tolerance_q8);

/*
 * Adds the plane n.v + d = 0. The components' magnitudes are below
 * 2^NORMAL_BITS, not all zero. reach: see struct plane.
 */
uint32_t plane_add(struct planes *planes, const int32_t n[3], int64_t d, int64_t reach);

/* The exact plane of three lattice points, if it fits: greatest components just below the limit. */
bool plane_of_triangle(const int16_t a[3], const int16_t b[3], const int16_t c[3], int32_t n[3],
                       int64_t *d);

void planes_free(struct planes *planes);

#endif
