/* SPDX-License-Identifier: 0BSD */
/* Products of 128-bit integers, exact: signed numbers of 512 bits. */
#ifndef OLDWELL_TESTS_PROPERTY_WIDE_PRODUCT_H
#define OLDWELL_TESTS_PROPERTY_WIDE_PRODUCT_H

#include <stdint.h>
#include <string.h>

#include "tools/owc/exact.h"

enum { BIG_WORDS = 16 };

/* Two's complement, the lowest word first. Results beyond 512 bits are the caller's mistake. */
struct big {
    uint32_t words[BIG_WORDS];
};

static inline struct big big_of(wide value)
{
    struct big big;
    for (int i = 0; i < BIG_WORDS; i++) {
        big.words[i] = i < 4 ? (uint32_t)((uwide)value >> (32 * i)) : value < 0 ? 0xFFFFFFFFu : 0;
    }
    return big;
}

static inline int big_sign(const struct big *big)
{
    struct big zero;
    memset(&zero, 0, sizeof zero);
    if (big->words[BIG_WORDS - 1] >> 31) {
        return -1;
    }
    return memcmp(big, &zero, sizeof zero) != 0;
}

static inline struct big big_add(struct big a, struct big b)
{
    uint64_t carry = 0;
    for (int i = 0; i < BIG_WORDS; i++) {
        carry += (uint64_t)a.words[i] + b.words[i];
        a.words[i] = (uint32_t)carry;
        carry >>= 32;
    }
    return a;
}

static inline struct big big_negate(struct big a)
{
    for (int i = 0; i < BIG_WORDS; i++) {
        a.words[i] = ~a.words[i];
    }
    return big_add(a, big_of(1));
}

static inline struct big big_product(struct big a, struct big b)
{
    struct big product;
    memset(&product, 0, sizeof product);
    for (int i = 0; i < BIG_WORDS; i++) {
        uint64_t carry = 0;
        for (int k = 0; i + k < BIG_WORDS; k++) {
            carry += (uint64_t)a.words[i] * b.words[k] + product.words[i + k];
            product.words[i + k] = (uint32_t)carry;
            carry >>= 32;
        }
    }
    return product;
}

#endif
