/* SPDX-License-Identifier: 0BSD */
/*
 * Cutting faces. The two sides of a piece are cut apart from each other, but
 * share the parts where the same plane cuts both; and a side that stays whole
 * is drawn as the parts of the other, so that the polygon has no more records
 * than it needs.
 */
#ifndef OWC_OBSTRUCTION_CUTS_H
#define OWC_OBSTRUCTION_CUTS_H

#include <stddef.h>
#include <stdint.h>

#include "arrangement.h"
#include "map64.h"
#include "pieces.h"
#include "split.h"
#include "tree.h"

struct obstruction_parts {
    uint32_t piece[2]; /* front and back; MESH_NONE: nothing but a line */
};

/* All zero to begin with. */
struct obstruction_cuts {
    struct splitter splitter;
    struct map64 by_plane; /* parts by piece and plane */
    struct map64 by_side;  /* parts by piece and side */
    struct obstruction_parts *parts;
    size_t count;
    size_t capacity;
};

/* Cuts a face that lies across a plane; OW_ITEM_NONE stands for a part without area. */
void obstruction_cut(struct obstruction_cuts *cuts, struct arrangement *arrangement,
                     struct pieces *pieces, tree_item face, uint32_t plane, tree_item parts[2]);

/* Lets whole sides of cut pieces share the other side's parts. */
void obstruction_cuts_share(const struct obstruction_cuts *cuts, struct tree *tree);

void obstruction_cuts_free(struct obstruction_cuts *cuts);

#endif
