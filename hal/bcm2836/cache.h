/* SPDX-License-Identifier: 0BSD */
/* The data caches, where others than the cores read or write memory. */
#ifndef OW_HAL_BCM2836_CACHE_H
#define OW_HAL_BCM2836_CACHE_H

#include <stdint.h>

enum { CACHE_LINE = 64 };

/* Writes back what the caches hold of a block, and forgets it. */
static inline void cache_clean(const void *block, uint32_t bytes)
{
    uintptr_t end = (uintptr_t)block + bytes;
    for (uintptr_t p = (uintptr_t)block & ~(uintptr_t)(CACHE_LINE - 1); p < end; p += CACHE_LINE) {
        __asm__ volatile("mcr p15, 0, %0, c7, c14, 1" ::"r"(p) : "memory");
    }
    __asm__ volatile("dsb" ::: "memory");
}

/* From now on this memory is read and written past the caches; in whole MB. */
void cache_leave_out(uintptr_t first, uint32_t bytes);

#endif
