/* SPDX-License-Identifier: 0BSD */
/* Whether a mesh is sound: edges, winding, inward parts, polygons that run through others. */
#ifndef OWC_CHECK_H
#define OWC_CHECK_H

#include <stdbool.h>
#include <stdint.h>

#include "mesh.h"

struct mesh_check {
    uint32_t open_edges;    /* of one polygon */
    uint32_t forked_edges;  /* of more than two: not manifold */
    uint32_t twisted_edges; /* two polygons run along them the same way */
    uint32_t parts;         /* hang together along edges of two polygons */
    uint32_t inward_parts;  /* closed, their normals look inwards, not inside another part */
    uint32_t cavities;      /* likewise, but within the box of another part: rightly so, perhaps */
    uint32_t repeated;      /* polygons with the corners of a later one; cleaning dropped them */
    uint32_t to_turn;       /* polygons that the repair turns over */
    bool repaired;          /* and did turn over */
    uint32_t crossings;     /* pairs of polygons that run through one another */
    bool closed;            /* bounds a volume, as it is after the repair */
    bool crossings_counted; /* false: there were too many pairs to look at, there may be more */
};

/*
 * Looks at a mesh. repair: turns over polygons of closed parts whose winding
 * disagrees with their neighbours', and inward parts; sets mesh->closed anew.
 * The counts are of the mesh as it was.
 */
void check_mesh(struct mesh_check *check, struct mesh *mesh, bool repair);

/* Prints one line on standard error for each thing that was found. */
void check_report(const struct mesh_check *check, const char *file);

#endif
