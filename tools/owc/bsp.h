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
    BSP_FIRST,     /* the first in the file */
    BSP_RANDOM,    /* any */
    BSP_KEDEM,     /* the best of a few chosen at random [FAG83] */
    BSP_EXHAUSTIVE /* the best of all [FKN80] */
};

struct bsp_options {
    enum bsp_select select;
    uint32_t candidates; /* BSP_KEDEM: how many, at least 1 */
    uint64_t seed;
    bool two_sided; /* each piece's back is a face too */
};

/* Builds the tree of all pieces; cuts them as needed. progress may be NULL. */
void bsp_build(struct tree *tree, struct arrangement *arrangement, struct pieces *pieces,
               const struct bsp_options *options, struct progress *progress);

#endif
