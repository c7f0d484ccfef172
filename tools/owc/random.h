/* SPDX-License-Identifier: 0BSD */
/* Random numbers: a 64-bit counter, mixed. The same seed gives the same numbers everywhere. */
#ifndef OWC_RANDOM_H
#define OWC_RANDOM_H

#include <stdint.h>

#include "map64.h"

struct random {
    uint64_t state;
};

static inline uint64_t random_next(struct random *random)
{
    random->state += 0x9E3779B97F4A7C15u;
    return map64_hash(random->state);
}

/* A number below limit, limit > 0. */
static inline uint32_t random_below(struct random *random, uint32_t limit)
{
    return (uint32_t)((random_next(random) >> 32) * limit >> 32);
}

#endif
