/* SPDX-License-Identifier: 0BSD */
/* Choosing the plane of a switch: candidates, and what each would do. */
#ifndef OWC_OBSTRUCTION_PLANE_H
#define OWC_OBSTRUCTION_PLANE_H

#include <stdint.h>

#include "obstruction_faces.h"
#include "plane.h"
#include "random.h"
#include "split.h"

struct obstruction_effort {
    uint32_t own;        /* polygons' own planes tried */
    uint32_t edges;      /* planes through an edge and a vertex tried */
    uint32_t directions; /* of planes swept through gaps */
    uint32_t sample;     /* faces by which candidates are judged at first */
    uint32_t climbs;     /* steps by which each finalist is improved */
    uint32_t finalists;  /* candidates that all faces then judge */
    uint32_t ahead;      /* up to so many faces, finalists are judged by what is cut in the end */
    double balance;      /* what perfect balance is worth, in cuts a face */
};

/* Where a face goes. */
enum obstruction_place {
    OBSTRUCTION_ON = SPLIT_ON,
    OBSTRUCTION_FRONT = SPLIT_FRONT,
    OBSTRUCTION_BACK = SPLIT_BACK,
    OBSTRUCTION_ACROSS = SPLIT_ACROSS
};

/*
 * On a plane are its own faces and what is within a lattice step of it; across
 * it what reaches beyond the tolerance on both sides. Exact.
 */
enum obstruction_place obstruction_place_of(const struct obstruction_set *set,
                                            const struct obstruction_face *face, uint32_t plane);

/*
 * A plane for a switch among these faces of the set, count >= 2; added to
 * planes if it is new. Fewer than count faces, parts counted, lie on or in
 * front of it, and fewer on or behind it, or some lie on it: so what goes into
 * either child is always less than there was.
 */
uint32_t obstruction_choose(struct obstruction_set *set, struct planes *planes,
                            const uint32_t *faces, uint32_t count,
                            const struct obstruction_effort *effort, struct random *random);

#endif
