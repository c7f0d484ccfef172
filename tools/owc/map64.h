/* SPDX-License-Identifier: 0BSD */
/* A hash map from 64-bit keys to 32-bit values; MAP64_NONE is no value. */
#ifndef OWC_MAP64_H
#define OWC_MAP64_H

#include <stdint.h>

#define MAP64_NONE 0xFFFFFFFFu

/* All zero: an empty map. */
struct map64 {
    uint64_t *keys;
    uint32_t *values;
    uint64_t capacity; /* 0 or a power of two */
    uint64_t count;
};

/* Two 32-bit numbers as one key. */
static inline uint64_t map64_key(uint32_t high, uint32_t low)
{
    return (uint64_t)high << 32 | low;
}

/* A hash that spreads all bits of the key. */
static inline uint64_t map64_hash(uint64_t key)
{
    key ^= key >> 30;
    key *= 0xBF58476D1CE4E5B9u;
    key ^= key >> 27;
    key *= 0x94D049BB133111EBu;
    return key ^ key >> 31;
}

/* The key's value, or MAP64_NONE. */
uint32_t map64_get(const struct map64 *map, uint64_t key);

/* Enters the value if the key is new. Returns the value that the key has afterwards. */
uint32_t map64_put(struct map64 *map, uint64_t key, uint32_t value);

void map64_free(struct map64 *map);

#endif
