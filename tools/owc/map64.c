/* SPDX-License-Identifier: 0BSD */
/* A hash map from 64-bit keys to 32-bit values: open addressing, at most two thirds full. */
#include "map64.h"

#include <stdlib.h>
#include <string.h>

#include "tools/common/xalloc.h"

static uint64_t place(const struct map64 *map, uint64_t key)
{
    uint64_t mask = map->capacity - 1;
    uint64_t at = map64_hash(key) & mask;
    while (map->values[at] != MAP64_NONE && map->keys[at] != key) {
        at = (at + 1) & mask;
    }
    return at;
}

static void grow(struct map64 *map)
{
    struct map64 old = *map;
    map->capacity = old.capacity ? 2 * old.capacity : 64;
    map->keys = xalloc(map->capacity, sizeof *map->keys);
    map->values = xalloc(map->capacity, sizeof *map->values);
    memset(map->values, 0xFF, map->capacity * sizeof *map->values);
    for (uint64_t i = 0; i < old.capacity; i++) {
        if (old.values[i] != MAP64_NONE) {
            uint64_t at = place(map, old.keys[i]);
            map->keys[at] = old.keys[i];
            map->values[at] = old.values[i];
        }
    }
    free(old.keys);
    free(old.values);
}

uint32_t map64_get(const struct map64 *map, uint64_t key)
{
    return map->capacity ? map->values[place(map, key)] : MAP64_NONE;
}

uint32_t map64_put(struct map64 *map, uint64_t key, uint32_t value)
{
    if (3 * (map->count + 1) > 2 * map->capacity) {
        grow(map);
    }
    uint64_t at = place(map, key);
    if (map->values[at] == MAP64_NONE) {
        map->keys[at] = key;
        map->values[at] = value;
        map->count++;
    }
    return map->values[at];
}

void map64_free(struct map64 *map)
{
    free(map->keys);
    free(map->values);
    *map = (struct map64){ 0 };
}
