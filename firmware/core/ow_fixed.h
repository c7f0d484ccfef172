/* SPDX-License-Identifier: 0BSD */
/*
 * Numbers: fixed-point types and the few functions that need a quotient or a
 * root. A name says its Q format: _q30 has 30 fraction bits. Shifts of
 * negative numbers are arithmetic (floor), which every compiler in use does
 * and is asserted below.
 */
#ifndef OW_FIXED_H
#define OW_FIXED_H

#include <stdint.h>

typedef int32_t ow_q8;    /* lattice units, 8 fraction bits */
typedef int32_t ow_q30;   /* -2 .. 2, 30 fraction bits: unit vectors, sines */
typedef int32_t ow_sub8;  /* screen coordinates, pixels with 8 fraction bits */
typedef uint32_t ow_turn; /* an angle as a share of a full turn, 32 fraction bits */

enum { OW_SUB_BITS = 8, OW_SUB = 1 << OW_SUB_BITS }; /* of ow_sub8: 1/256 pixel */

_Static_assert((-1 >> 1) == -1, "shifts of negative numbers must be arithmetic");

/* A positive number mantissa * 2^-exponent, mantissa in 2^30 .. 2^31-1. */
struct ow_scale {
    uint32_t mantissa;
    int32_t exponent;
};

/* Leading zero bits of x; 32 for 0. */
static inline uint32_t ow_leading_zeros(uint32_t x)
{
#if defined(__GNUC__)
    return x ? (uint32_t)__builtin_clz(x) : 32;
#else
    uint32_t n = 32;
    while (x) {
        x >>= 1;
        n--;
    }
    return n;
#endif
}

/*
 * About 2^63 / x for x in 2^31 .. 2^32-1, within 2^-29 of it, in 2^31 .. 2^32-1.
 * A 16-bit quotient and a Newton step: no 64-bit division.
 */
static inline uint32_t ow_reciprocal(uint32_t x)
{
    uint32_t seed = 0xFFFFFFFFu / (x >> 16);                /* 2^48 / x: 2^16 .. 2^17-1 */
    uint32_t y = seed << 15;                                /* 2^63 / x */
    uint32_t residue = (uint32_t)(((uint64_t)x * y) >> 32); /* x * y in 2^31 units: near 2^31 */
    uint32_t correction = 0u - residue;                     /* 2 - x * y, same units */
    uint64_t refined = ((uint64_t)y * correction) >> 31;
    return refined > 0xFFFFFFFFu ? 0xFFFFFFFFu : (uint32_t)refined;
}

/* floor(sqrt(x)). */
uint32_t ow_sqrt64(uint64_t x);

/* numerator * 2^shift / denominator, rounded down; numerator < denominator, denominator > 0,
 * shift 0 .. 32. One subtraction a bit: for set-up, not for inner loops. */
uint32_t ow_ratio(uint32_t numerator, uint32_t denominator, uint32_t shift);

/* numerator / denominator as a scale; both > 0. */
struct ow_scale ow_scale_of(uint64_t numerator, uint64_t denominator);

/* Sine and cosine by table and linear interpolation, within 2^-15 of the true value. */
ow_q30 ow_sin(ow_turn angle);
ow_q30 ow_cos(ow_turn angle);

#endif
