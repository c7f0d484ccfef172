/* SPDX-License-Identifier: 0BSD */
/* Exact numbers: wide integers, planes at lattice points and at meeting points. */
#include "exact.h"

wide wide_round_quotient(wide numerator, wide denominator)
{
    wide top = 2 * numerator + denominator;
    wide bottom = 2 * denominator;
    wide quotient = top / bottom;
    return quotient - (top % bottom < 0);
}

uint64_t wide_sqrt(uwide value)
{
    uwide root = 0;
    for (int bit = 63; bit >= 0; bit--) {
        uwide trial = root | (uwide)1 << bit;
        if (trial * trial <= value) {
            root = trial;
        }
    }
    return (uint64_t)root;
}

int64_t exact_tolerance(const int32_t n[3], uint32_t tolerance_q8)
{
    uint64_t square = 0;
    for (int i = 0; i < 3; i++) {
        square += (uint64_t)((int64_t)n[i] * n[i]);
    }
    uint64_t tolerance = (uint64_t)tolerance_q8 * tolerance_q8;
    return (int64_t)(wide_sqrt((uwide)square * tolerance) >> 8);
}

int64_t exact_side(const struct plane *plane, const int16_t point[3])
{
    return (int64_t)plane->n[0] * point[0] + (int64_t)plane->n[1] * point[1] +
           (int64_t)plane->n[2] * point[2] + plane->d;
}

static void cross(const int32_t a[3], const int32_t b[3], int64_t out[3])
{
    out[0] = (int64_t)a[1] * b[2] - (int64_t)a[2] * b[1];
    out[1] = (int64_t)a[2] * b[0] - (int64_t)a[0] * b[2];
    out[2] = (int64_t)a[0] * b[1] - (int64_t)a[1] * b[0];
}

/* Cramer's rule: v = -(da (nb x nc) + db (nc x na) + dc (na x nb)) / na.(nb x nc). */
bool exact_meet(const struct plane *a, const struct plane *b, const struct plane *c,
                struct meeting *meeting)
{
    int64_t bc[3];
    int64_t ca[3];
    int64_t ab[3];
    cross(b->n, c->n, bc);
    cross(c->n, a->n, ca);
    cross(a->n, b->n, ab);
    wide w = (wide)a->n[0] * bc[0] + (wide)a->n[1] * bc[1] + (wide)a->n[2] * bc[2];
    for (int i = 0; i < 3; i++) {
        wide x = (wide)a->d * bc[i] + (wide)b->d * ca[i] + (wide)c->d * ab[i];
        meeting->x[i] = w > 0 ? -x : x;
    }
    meeting->w = w > 0 ? w : -w;
    return w != 0;
}

int exact_sign(const struct plane *plane, wide value, wide weight)
{
    wide limit = (wide)plane->tolerance * weight;
    return (value > limit) - (value < -limit);
}

wide exact_side_meeting(const struct plane *plane, const struct meeting *meeting)
{
    return plane->n[0] * meeting->x[0] + plane->n[1] * meeting->x[1] + plane->n[2] * meeting->x[2] +
           plane->d * meeting->w;
}
