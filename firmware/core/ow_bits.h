/* SPDX-License-Identifier: 0BSD */
/* Bits of pixels, 32 in a word, the leftmost lowest: what surfaces look for a word at a time. */
#ifndef OW_BITS_H
#define OW_BITS_H

#include <stdint.h>

static inline uint32_t ow_trailing_zeros(uint32_t word)
{
#if defined(__GNUC__)
    return (uint32_t)__builtin_ctz(word);
#else
    uint32_t n = 0;
    while (!(word >> n & 1)) {
        n++;
    }
    return n;
#endif
}

/* Bits first .. 31. */
static inline uint32_t ow_bits_from(uint32_t first)
{
    return 0xFFFFFFFFu << first;
}

/* Bits 0 .. last. */
static inline uint32_t ow_bits_to(uint32_t last)
{
    return 0xFFFFFFFFu >> (31 - last);
}

/* The first pixel in from .. end-1 whose bit is not that of skip (0 or all ones); else end. */
static inline uint32_t ow_next_bit(const uint32_t *words, uint32_t from, uint32_t end,
                                   uint32_t skip)
{
    uint32_t w = from / 32;
    uint32_t found = (words[w] ^ skip) & ow_bits_from(from & 31);
    while (found == 0) {
        w++;
        if (w * 32 >= end) {
            return end;
        }
        found = words[w] ^ skip;
    }
    uint32_t x = w * 32 + ow_trailing_zeros(found);
    return x < end ? x : end;
}

static inline void ow_set_bits(uint32_t *words, uint32_t first, uint32_t end)
{
    uint32_t w = first / 32;
    uint32_t last = (end - 1) / 32;
    uint32_t mask = ow_bits_from(first & 31);
    for (; w < last; w++) {
        words[w] |= mask;
        mask = 0xFFFFFFFFu;
    }
    words[last] |= mask & ow_bits_to((end - 1) & 31);
}

static inline void ow_clear_bits(uint32_t *words, uint32_t first, uint32_t end)
{
    uint32_t w = first / 32;
    uint32_t last = (end - 1) / 32;
    uint32_t mask = ow_bits_from(first & 31);
    for (; w < last; w++) {
        words[w] &= ~mask;
        mask = 0xFFFFFFFFu;
    }
    words[last] &= ~(mask & ow_bits_to((end - 1) & 31));
}

#endif
