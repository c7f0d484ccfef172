/* SPDX-License-Identifier: 0BSD */
/*
 * Polygon conflicts. Pairs on different sides of the root never meet again, so
 * what they would have cut of one another is saved; pieces that are cut may cut
 * one another's parts on both sides.
 */
#include "conflict.h"

#include <stdlib.h>

#include "split.h"
#include "tools/common/xalloc.h"

enum set { IN_FRONT, ACROSS, BEHIND };

static void put(struct conflict *c, enum set set, uint32_t piece)
{
    c->sets[set] =
        xgrow(c->sets[set], &c->capacity[set], (size_t)c->counts[set] + 1, sizeof *c->sets[set]);
    c->sets[set][c->counts[set]++] = piece;
}

static void sort_out(struct conflict *c, const struct arrangement *arrangement,
                     const struct pieces *pieces, const uint32_t *list, uint32_t count,
                     uint32_t plane)
{
    c->counts[IN_FRONT] = c->counts[ACROSS] = c->counts[BEHIND] = 0;
    for (uint32_t i = 0; i < count; i++) {
        switch (split_side_of(arrangement, pieces, list[i], plane)) {
        case SPLIT_ON:
            break;
        case SPLIT_FRONT:
            put(c, IN_FRONT, list[i]);
            break;
        case SPLIT_BACK:
            put(c, BEHIND, list[i]);
            break;
        case SPLIT_ACROSS:
            put(c, ACROSS, list[i]);
            break;
        }
    }
}

/* The least step from this one on by which every place of a row comes up. */
static uint64_t coprime_from(uint64_t step, uint64_t row)
{
    for (;; step++) {
        uint64_t a = step;
        uint64_t b = row;
        while (b != 0) {
            uint64_t rest = a % b;
            a = b;
            b = rest;
        }
        if (a == 1) {
            return step;
        }
    }
}

/* I(m,n), or what a sample of the pairs says that it is. */
static double count_pairs(const struct conflict *c, const struct arrangement *arrangement,
                          const struct pieces *pieces, enum set m, enum set n, uint64_t *relations)
{
    uint64_t pairs = (uint64_t)c->counts[m] * c->counts[n];
    uint64_t step =
        pairs > CONFLICT_PAIRS ? coprime_from(pairs / CONFLICT_PAIRS + 1, c->counts[n]) : 1;
    uint64_t looked = 0;
    uint64_t meet = 0;
    for (uint64_t i = 0; i < pairs; i += step) {
        uint32_t root = c->sets[m][i / c->counts[n]];
        uint32_t piece = c->sets[n][i % c->counts[n]];
        looked++;
        meet += split_side_of(arrangement, pieces, piece, pieces->all[root].record) == SPLIT_ACROSS;
    }
    *relations += looked;
    return looked > 0 ? (double)meet * (double)pairs / (double)looked : 0;
}

double conflict_score(struct conflict *c, const struct arrangement *arrangement,
                      const struct pieces *pieces, const uint32_t *list, uint32_t count,
                      uint32_t plane, double weight, uint64_t *relations)
{
    sort_out(c, arrangement, pieces, list, count, plane);
    *relations += count;
    return count_pairs(c, arrangement, pieces, IN_FRONT, BEHIND, relations) +
           count_pairs(c, arrangement, pieces, BEHIND, IN_FRONT, relations) -
           weight * count_pairs(c, arrangement, pieces, ACROSS, ACROSS, relations);
}

void conflict_free(struct conflict *c)
{
    for (int i = 0; i < 3; i++) {
        free(c->sets[i]);
    }
    *c = (struct conflict){ 0 };
}
