/* SPDX-License-Identifier: 0BSD */
/*
 * The location problem [FKN80]: in which convex region of a tree of switches does
 * a point lie? Integers only, no memory of its own, as in the core.
 *
 * A region is an empty child of a switch, or one that holds faces without a
 * switch. They are numbered from 1 as their switches stand in the blob, the front
 * child before the back one.
 */
#ifndef OWC_LOCATE_H
#define OWC_LOCATE_H

#include <stdbool.h>
#include <stdint.h>

#include "ow_status.h"
#include "ow_tree.h"

/* A switch plane n.v + d = 0, lattice units, and the side of it on which the region lies. */
struct locate_side {
    int32_t n[3];
    int64_t d;
    bool front;
};

struct locate_region {
    uint32_t leaf;
    uint32_t side_count; /* switches on the path */
};

/*
 * point: lattice units with 8 fraction bits, magnitudes up to 2^30; a point on
 * a plane counts as in front of it. sides: room for tree->depth entries, from the
 * root down; they bound the region. OW_UNSUPPORTED: sequences order faces, so the
 * tree's switches do not bound regions alone.
 */
enum ow_status locate_point(const struct ow_tree *tree, const int32_t point_q8[3],
                            struct locate_side *sides, struct locate_region *region);

#endif
