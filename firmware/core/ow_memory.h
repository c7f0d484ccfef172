/* SPDX-License-Identifier: 0BSD */
/*
 * Memory: the three functions that a freestanding compiler expects anyway,
 * and words that may overlay a buffer of bytes.
 */
#ifndef OW_MEMORY_H
#define OW_MEMORY_H

#include <stddef.h>
#include <stdint.h>

void *memcpy(void *restrict to, const void *restrict from, size_t bytes);
void *memset(void *to, int value, size_t bytes);

#if defined(__GNUC__)
typedef uint64_t __attribute__((__may_alias__, __aligned__(4))) ow_word64;
typedef uint32_t __attribute__((__may_alias__)) ow_word32;
typedef uint16_t __attribute__((__may_alias__)) ow_word16;
#else
typedef uint64_t ow_word64;
typedef uint32_t ow_word32;
typedef uint16_t ow_word16;
#endif

/* The host's word whose bytes in memory are value's, lowest first. */
static inline uint32_t ow_little32(uint32_t value)
{
#if defined(__BYTE_ORDER__) && __BYTE_ORDER__ == __ORDER_BIG_ENDIAN__
    return value >> 24 | (value >> 8 & 0xFF00) | (value & 0xFF00) << 8 | value << 24;
#else
    return value;
#endif
}

#endif
