/* SPDX-License-Identifier: 0BSD */
/* Where polygons were split, and by what. */
#ifndef OWC_EXPLAIN_H
#define OWC_EXPLAIN_H

#include <stdio.h>

#include "arrangement.h"
#include "mesh.h"
#include "pieces.h"

/*
 * One line for each of the first cut_count cuts: the polygon that was split, what
 * split it, and from where to where. That is the polygon whose plane it was (of
 * several in that plane the first in the file), or the plane a,b,c,d with
 * ax + by + cz + d = 0. All in model units.
 */
void explain_cuts(FILE *out, const struct mesh *mesh, const struct arrangement *arrangement,
                  const struct pieces *pieces, uint32_t cut_count);

#endif
