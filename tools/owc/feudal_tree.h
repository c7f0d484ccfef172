/* SPDX-License-Identifier: 0BSD */
/* The feudal priority tree of a mesh's pieces, as sequences and switches [CW96]. */
#ifndef OWC_FEUDAL_TREE_H
#define OWC_FEUDAL_TREE_H

#include <stdbool.h>
#include <stdint.h>

#include "arrangement.h"
#include "feudal.h"
#include "mesh.h"
#include "pieces.h"
#include "progress.h"
#include "tree.h"

struct feudal_options {
    bool dynamic;
    uint64_t seed;  /* dynamic: of the order in which polygons are taken */
    bool two_sided; /* each piece's back is a face too */
};

/* Builds the tree of all pieces; cuts them as needed. progress may be NULL. */
void feudal_build(struct tree *tree, struct arrangement *arrangement, struct pieces *pieces,
                  const struct mesh *mesh, const struct feudal_options *options,
                  struct progress *progress);

/*
 * The same tree as sequences and switches. A connecting node becomes B1 ... Bn,
 * switch, Fn ... F1; two-sided, B1 and the reverse of F1, ... Bn and the reverse
 * of Fn, switch, Fn and the reverse of Bn, ... F1 and the reverse of B1. rank:
 * a bunch's polygons come in its order.
 */
void feudal_to_tree(struct tree *tree, const struct feudal *feudal, const uint32_t *rank,
                    bool two_sided);

#endif
