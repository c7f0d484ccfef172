/* SPDX-License-Identifier: 0BSD */
/* Pieces with more corners than a polygon record holds, cut by planes along the axes. */
#ifndef OWC_LONG_CUT_H
#define OWC_LONG_CUT_H

#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>

#include "arrangement.h"
#include "pieces.h"
#include "plane.h"
#include "split.h"

/* The two parts of each piece that was cut here; MESH_NONE for the others. */
struct long_cuts {
    uint32_t (*parts)[2];
    size_t count; /* pieces that parts knows of */
    size_t capacity;
    struct splitter splitter;
};

/*
 * Cuts a piece where that shares out its corners. False: no plane does (an
 * outline as jagged as a comb), or the piece was cut before.
 */
bool long_cut(struct long_cuts *cuts, struct arrangement *arrangement, struct planes *planes,
              struct pieces *pieces, uint32_t piece);

/* A part of a piece, or MESH_NONE. */
uint32_t long_cut_part(const struct long_cuts *cuts, uint32_t piece, int part);

void long_cuts_free(struct long_cuts *cuts);

#endif
