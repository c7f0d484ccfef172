/* SPDX-License-Identifier: 0BSD */
/* On which sides of a plane a piece lies, and cutting it there. */
#ifndef OWC_SPLIT_H
#define OWC_SPLIT_H

#include <stddef.h>
#include <stdint.h>

#include "arrangement.h"
#include "pieces.h"

/* Where a piece lies; SPLIT_ACROSS is both. */
enum split_side { SPLIT_ON = 0, SPLIT_FRONT = 1, SPLIT_BACK = 2, SPLIT_ACROSS = 3 };

/* Ends as soon as both sides are seen. */
enum split_side split_side_of(const struct arrangement *arrangement, const struct pieces *pieces,
                              uint32_t piece, uint32_t plane);

/* Memory that one split hands on to the next. All zero to begin with. */
struct splitter {
    int8_t *sides;
    size_t side_capacity;
    uint32_t *crossings;
    size_t crossing_capacity;
};

/*
 * Cuts a piece that lies across a plane into two new ones. Concave pieces may
 * come out as one outline that runs along the cut more than once: by the
 * winding rule that is several faces.
 */
void split_piece(struct splitter *splitter, struct arrangement *arrangement, struct pieces *pieces,
                 uint32_t piece, uint32_t plane, uint32_t *front, uint32_t *back);

void splitter_free(struct splitter *splitter);

#endif
