/* SPDX-License-Identifier: 0BSD */
/* Polygons that run through one another. */
#ifndef OWC_CROSSINGS_H
#define OWC_CROSSINGS_H

#include <stdbool.h>
#include <stdint.h>

#include "mesh.h"

/* Pairs of boxes that are compared at most, so that the time is bounded. */
enum { CROSSINGS_MOST_BOXES = 40000000 };

/*
 * Pairs of polygons of which one has an edge that passes through the other's
 * inside. complete: all pairs were looked at. Polygons that only touch, or lie
 * in one plane, do not count.
 */
uint32_t crossings_count(const struct mesh *mesh, bool *complete);

#endif
