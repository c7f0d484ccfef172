/* SPDX-License-Identifier: 0BSD */
/*
 * Exact numbers: integer planes over the lattice, and points that are
 * quotients of wide integers. The bounds below show that nothing overflows.
 */
#ifndef OWC_EXACT_H
#define OWC_EXACT_H

#include <stdbool.h>
#include <stdint.h>

#include "ow_blob.h"

__extension__ typedef __int128 wide;
__extension__ typedef unsigned __int128 uwide;

/* Magnitudes in bits: a value of B bits is less than 2^B. */
enum {
    POINT_BITS = 15,                             /* a lattice coordinate */
    NORMAL_BITS = OW_PLANE_NORMAL_BITS,          /* a component of a plane's normal */
    OFFSET_BITS = 41,                            /* a plane's d */
    SIDE_BITS = OFFSET_BITS + 1,                 /* n.v + d at a lattice point */
    EDGE_BITS = 2 * SIDE_BITS + 1,               /* the same at a point of a lattice edge */
    CROSS_BITS = 2 * NORMAL_BITS + 1,            /* a component of n1 x n2 */
    MEET_W_BITS = NORMAL_BITS + CROSS_BITS + 2,  /* n1.(n2 x n3) */
    MEET_BITS = OFFSET_BITS + CROSS_BITS + 2,    /* a numerator of the meeting point */
    MEET_SIDE_BITS = NORMAL_BITS + MEET_BITS + 3 /* n.v + d at a meeting point, times w */
};
_Static_assert(OW_LATTICE_MAX < 1 << POINT_BITS, "lattice coordinates");
_Static_assert(NORMAL_BITS + POINT_BITS + 2 < OFFSET_BITS, "n.v is less than d may be");
_Static_assert(SIDE_BITS < 53, "a side test at a lattice point is exact in binary64");
_Static_assert(EDGE_BITS + 1 < 127, "side tests on lattice edges fit the wide integer");
_Static_assert(OFFSET_BITS + MEET_W_BITS < MEET_SIDE_BITS, "d.w is less than n.x");
_Static_assert(MEET_SIDE_BITS + 1 < 127, "side tests at meeting points fit the wide integer");
_Static_assert(SIDE_BITS + MEET_W_BITS < 127, "a tolerance times w fits the wide integer");

/* The points v with n.v + d = 0; the front is where the sum is positive. */
struct plane {
    int64_t d;
    int64_t tolerance; /* floor(T |n|): a lattice point with |n.v + d| up to this is on it */
    int64_t reach;     /* largest |n.v + d| of the corners of its own faces, which are on it */
    double normal[3];  /* n, d as binary64: the same values */
    double offset;
    double sure; /* a rounded |n.v + d| above this decides the side */
    int32_t n[3];
};

/* A point x / w, w > 0. */
struct meeting {
    wide x[3];
    wide w;
};

/* -1, 0 or 1. */
static inline int wide_sign(wide value)
{
    return (value > 0) - (value < 0);
}

/* numerator / denominator, rounded to the nearest, halves up; denominator > 0. */
wide wide_round_quotient(wide numerator, wide denominator);

/* floor(sqrt(value)). */
uint64_t wide_sqrt(uwide value);

/* floor(T sqrt(n.n)) for T = tolerance_q8 / 256. */
int64_t exact_tolerance(const int32_t n[3], uint32_t tolerance_q8);

/* n.v + d at a lattice point. */
int64_t exact_side(const struct plane *plane, const int16_t point[3]);

/* The point common to three planes. False if there is none or more than one. */
bool exact_meet(const struct plane *a, const struct plane *b, const struct plane *c,
                struct meeting *meeting);

/* The side of a plane on which a point value / weight lies: 1, 0 (within tolerance) or -1. */
int exact_sign(const struct plane *plane, wide value, wide weight);

/* (n.v + d) w at a meeting point. */
wide exact_side_meeting(const struct plane *plane, const struct meeting *meeting);

#endif
