/* SPDX-License-Identifier: 0BSD */
/*
 * Is a tree's order right from every viewpoint? Decided for each pair of its
 * faces by exact arithmetic, for all viewpoints at once, without any eye.
 */
#ifndef OLDWELL_TESTS_PROPERTY_ORDER_CHECK_H
#define OLDWELL_TESTS_PROPERTY_ORDER_CHECK_H

#include <stdbool.h>
#include <stdint.h>

#include "tools/owc/arrangement.h"
#include "tools/owc/mesh.h"
#include "tools/owc/pieces.h"
#include "tools/owc/repair.h"
#include "tools/owc/tree.h"

struct order_check {
    const struct mesh *mesh;
    const struct arrangement *arrangement;
    const struct pieces *pieces;
    const struct tree *tree;
    const struct repaired *repaired; /* judge the rounded outlines; NULL: the exact pieces */
    uint32_t tolerance_q8;           /* what may be wrong, lattice steps with 8 fraction bits */
    /* Results. */
    uint64_t pairs;     /* that were judged */
    uint64_t decisive;  /* of these, where one can hide the other */
    uint32_t faces;     /* met */
    uint32_t margin_q8; /* what counts as nothing, lattice steps; 0: judged strictly */
    tree_item wrong[2]; /* the first pair that is wrong: hiding, hidden */
    uint32_t wrong_plane;
};

/* False: a pair is wrong, or a face is in the tree twice. */
bool order_is_right(struct order_check *check);

#endif
