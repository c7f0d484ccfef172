/* SPDX-License-Identifier: 0BSD */
/* Which strategy builds the tree, and what it is told. */
#ifndef OWC_STRATEGY_H
#define OWC_STRATEGY_H

#include <stdbool.h>
#include <stdint.h>

#include "arrangement.h"
#include "bsp.h"
#include "dividing.h"
#include "insert.h"
#include "mesh.h"
#include "pieces.h"
#include "plane.h"
#include "progress.h"
#include "tree.h"

enum method {
    METHOD_BSP,
    METHOD_ONLINE,         /* [GC91] */
    METHOD_FEUDAL_STATIC,  /* [CW96] */
    METHOD_FEUDAL_DYNAMIC, /* [CW96] */
    METHOD_OBSTRUCTION
};

struct strategy {
    enum method method;
    enum bsp_select select;
    uint32_t candidates;
    double conflict_weight;
    uint64_t seed;
    uint32_t threads;                   /* 0: as many as there are processors */
    uint32_t tolerance_q8;              /* with METHOD_OBSTRUCTION: of the relation */
    const struct user_planes *dividing; /* with METHOD_BSP: switches before all others; or NULL */
    bool dividing_axis;                 /* with METHOD_BSP: planes along the axes, at gaps */
    const struct insertion *into;       /* a tree that the mesh's new polygons are added to */
    bool two_sided;                     /* each piece's back is a face too */
};

/* Builds the tree of all pieces; cuts them as needed. progress may be NULL. */
void strategy_build(struct tree *tree, struct arrangement *arrangement, struct planes *planes,
                    struct pieces *pieces, const struct mesh *mesh, const struct strategy *strategy,
                    struct progress *progress);

#endif
