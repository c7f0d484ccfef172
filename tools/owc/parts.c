/* SPDX-License-Identifier: 0BSD */
/* The parts of a cut piece that are worth keeping. */
#include "parts.h"

bool part_is_kept(const struct pieces *pieces, uint32_t number)
{
    const struct piece *piece = &pieces->all[number];
    const uint32_t *edges = pieces->edges + piece->first;
    return piece->count > 2 || (piece->count == 2 && edges[0] >> 1 != edges[1] >> 1);
}

void split_into_parts(struct splitter *splitter, struct arrangement *arrangement,
                      struct pieces *pieces, uint32_t piece, uint32_t plane, uint32_t parts[2])
{
    split_piece(splitter, arrangement, pieces, piece, plane, &parts[0], &parts[1]);
    for (int i = 0; i < 2; i++) {
        parts[i] = part_is_kept(pieces, parts[i]) ? parts[i] : MESH_NONE;
    }
}
