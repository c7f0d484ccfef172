/* SPDX-License-Identifier: 0BSD */
/* The parts of a cut piece that are worth keeping. */
#ifndef OWC_PARTS_H
#define OWC_PARTS_H

#include "split.h"

/* False: the piece only runs to and fro along one line. */
bool part_is_kept(const struct pieces *pieces, uint32_t piece);

/* Cuts a piece; parts: in front and behind, MESH_NONE for one that is not kept. */
void split_into_parts(struct splitter *splitter, struct arrangement *arrangement,
                      struct pieces *pieces, uint32_t piece, uint32_t plane, uint32_t parts[2]);

#endif
