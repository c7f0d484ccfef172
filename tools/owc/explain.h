/* SPDX-License-Identifier: 0BSD */
/* Where polygons were split, and by what. */
#ifndef OWC_EXPLAIN_H
#define OWC_EXPLAIN_H

#include <stdio.h>

#include "mesh.h"
#include "pieces.h"

/*
 * One line for each of the first cut_count cuts: the polygon that was split, and
 * the polygon whose plane it was (of several in that plane the first in the
 * file), or that it was a dividing plane. plane_count: planes there are.
 */
void explain_cuts(FILE *out, const struct mesh *mesh, const struct pieces *pieces,
                  uint32_t cut_count, uint32_t plane_count);

#endif
