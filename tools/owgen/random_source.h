/* SPDX-License-Identifier: 0BSD */
/* Random numbers that are the same on every machine: the splitmix64 generator. */
#ifndef OLDWELL_TOOLS_OWGEN_RANDOM_SOURCE_H
#define OLDWELL_TOOLS_OWGEN_RANDOM_SOURCE_H

#include <stdint.h>

struct random_source {
    uint64_t state; /* set it to the seed */
};

/* The next 64 bits. */
uint64_t random_bits(struct random_source *source);

/* Uniform in [low, high), in steps of (high - low) / 2^53. */
double random_between(struct random_source *source, double low, double high);

#endif
