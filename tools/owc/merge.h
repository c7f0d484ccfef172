/* SPDX-License-Identifier: 0BSD */
/* Coplanar neighbours joined into convex polygons. */
#ifndef OWC_MERGE_H
#define OWC_MERGE_H

#include "mesh.h"

/*
 * Joins polygons that share an edge, lie in one plane record, look the same way
 * and have the same colour, as long as the result is convex (but for a lattice
 * step, which rounding may bend an outline by) and has at most OW_MAX_CORNERS
 * corners. With normals only where both have the same at the edge's ends. The
 * longest edges go first.
 *
 * A joined polygon has the source number and the place of its first one in the
 * file. Each corner that another polygon has stays; a corner on a straight edge
 * goes where all that have it can do without it.
 *
 * The records must be set (plane_group). Returns how many polygons are gone.
 */
uint32_t merge_coplanar(struct mesh *mesh);

#endif
