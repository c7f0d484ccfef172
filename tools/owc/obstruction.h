/* SPDX-License-Identifier: 0BSD */
/*
 * The obstruction tree: sequences of the relation's strongly connected
 * components, hidden before hiding, and switches only inside components of
 * several faces.
 */
#ifndef OWC_OBSTRUCTION_H
#define OWC_OBSTRUCTION_H

#include <stdbool.h>
#include <stdint.h>

#include "arrangement.h"
#include "mesh.h"
#include "pieces.h"
#include "plane.h"
#include "progress.h"
#include "tree.h"

struct obstruction_options {
    uint64_t seed;
    uint32_t tolerance_q8; /* of the relation; that of the planes may be less */
    bool two_sided;        /* each piece's back is a face too */
    double price;          /* what a switch costs, in cuts; 0: the usual */
    uint64_t most;         /* give up where there would be more faces; 0: never */
    uint32_t threads;      /* 0: as many as there are processors; the tree is the same */
};

/*
 * Builds the tree of all pieces; cuts them and adds planes as needed. planes
 * are the arrangement's. progress may be NULL. False: it gave up.
 */
bool obstruction_build(struct tree *tree, struct planes *planes, const struct mesh *mesh,
                       struct arrangement *arrangement, struct pieces *pieces,
                       const struct obstruction_options *options, struct progress *progress);

#endif
