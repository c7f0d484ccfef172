/* SPDX-License-Identifier: 0BSD */
/* Long sequences in chunks: near in space and in normal as far as the order leaves freedom. */
#ifndef OWC_OBSTRUCTION_CHUNKS_H
#define OWC_OBSTRUCTION_CHUNKS_H

#include <stdint.h>

#include "obstruction_faces.h"

enum {
    CHUNK_RUN = 96, /* shorter runs of faces stay as they are */
    CHUNK_LEAST = 32,
    CHUNK_MOST = 64
};

/*
 * Rearranges a run of faces that are in a right order into another right
 * order. ends: room for count numbers; ends[i] is where chunk i ends. Returns
 * how many chunks there are.
 */
uint32_t obstruction_chunks(struct obstruction_set *set, uint32_t *faces, uint32_t count,
                            uint32_t *ends);

#endif
