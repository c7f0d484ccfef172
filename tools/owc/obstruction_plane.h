/* SPDX-License-Identifier: 0BSD */
/* Choosing the plane of a switch: candidates, and what each would do. */
#ifndef OWC_OBSTRUCTION_PLANE_H
#define OWC_OBSTRUCTION_PLANE_H

#include <stdint.h>

#include "obstruction_faces.h"
#include "plane.h"
#include "random.h"
#include "split.h"

/* How hard a good plane is looked for. */
struct obstruction_effort {
    uint32_t own;        /* polygons' own planes tried */
    uint32_t edges;      /* planes through an edge and a vertex tried */
    uint32_t directions; /* of planes swept through gaps */
    uint32_t sample;     /* faces that a sweep looks at */
    uint32_t climbers;   /* the best so many candidates are improved, */
    uint32_t climbs;     /* in so many steps */
    uint32_t finalists;  /* candidates of which is counted what stays whole */
    uint32_t ahead;      /* up to so many faces, the components that are left are found for */
    uint32_t looks;      /* the best so many */
    double price;        /* what a switch costs, in cuts */
};

/* Where a face goes. */
enum obstruction_place {
    OBSTRUCTION_ON = SPLIT_ON,
    OBSTRUCTION_FRONT = SPLIT_FRONT,
    OBSTRUCTION_BACK = SPLIT_BACK,
    OBSTRUCTION_ACROSS = SPLIT_ACROSS
};

/* A plane that was chosen. */
struct obstruction_choice {
    uint32_t record; /* a polygon's, or MESH_NONE: a new one, n.v + d = 0 */
    int32_t n[3];
    int64_t d;
};

/*
 * Chooses a plane for a switch among all faces of a set, at least 2, and says
 * where each face goes. Fewer than all, parts counted, lie on or in front of
 * it, and fewer on or behind it, or some lie on it: so what goes into either
 * child is always less than there was. planes is the arrangement's; its record
 * with the number spare, behind all others, is overwritten.
 */
void obstruction_choose(struct obstruction_choice *choice, uint8_t *places,
                        struct obstruction_set *set, struct planes *planes, uint32_t spare,
                        const struct obstruction_effort *effort, struct random *random);

#endif
