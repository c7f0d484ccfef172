/* SPDX-License-Identifier: 0BSD */
/* The polygon conflicts that a root takes away or leaves [FKN80]. */
#ifndef OWC_CONFLICT_H
#define OWC_CONFLICT_H

#include <stdint.h>

#include "arrangement.h"
#include "pieces.h"

/* Memory that one score hands on to the next. All zero to begin with. */
struct conflict {
    uint32_t *sets[3]; /* pieces in front, across, behind */
    size_t capacity[3];
    uint32_t counts[3];
};

/*
 * I(1,3) + I(3,1) - weight I(2,2) for the plane as root of the list: I(m,n)
 * counts pairs of a piece of set m and one of set n which meets the plane of
 * the first. Sets are counted from 1: in front, across, behind. Of more than
 * CONFLICT_PAIRS pairs it takes a regular sample. Adds to relations.
 */
double conflict_score(struct conflict *conflict, const struct arrangement *arrangement,
                      const struct pieces *pieces, const uint32_t *list, uint32_t count,
                      uint32_t plane, double weight, uint64_t *relations);

enum { CONFLICT_PAIRS = 1 << 20 };

void conflict_free(struct conflict *conflict);

#endif
