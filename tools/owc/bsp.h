/* SPDX-License-Identifier: 0BSD */
/* The BSP tree: switches alone, each in a polygon's plane [FKN80, FAG83]. */
#ifndef OWC_BSP_H
#define OWC_BSP_H

#include <stdbool.h>
#include <stdint.h>

#include "arrangement.h"
#include "pieces.h"
#include "progress.h"
#include "tree.h"

/* Which polygon's plane becomes the switch. */
enum bsp_select {
    BSP_FIRST,      /* the first in the file */
    BSP_RANDOM,     /* any */
    BSP_KEDEM,      /* the best of a few chosen at random [FAG83] */
    BSP_EXHAUSTIVE, /* the best of all [FKN80] */
    BSP_CONFLICT    /* of a few at random the one that takes away most conflicts [FKN80] */
};

struct bsp_options {
    enum bsp_select select;
    uint32_t candidates; /* BSP_KEDEM, BSP_CONFLICT: how many, at least 1 */
    uint64_t seed;
    bool two_sided;         /* each piece's back is a face too */
    double conflict_weight; /* BSP_CONFLICT: of the conflicts that stay */
    /* Switches before all others: these planes in their order, then planes found along the axes. */
    const uint32_t *dividing;
    uint32_t dividing_count;
    struct planes *axis_planes; /* the arrangement's, to which they are added; NULL: none */
};

/* Builds the tree of all pieces; cuts them as needed. progress may be NULL. */
void bsp_build(struct tree *tree, struct arrangement *arrangement, struct pieces *pieces,
               const struct bsp_options *options, struct progress *progress);

#endif
