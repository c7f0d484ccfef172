/* SPDX-License-Identifier: 0BSD */
/*
 * A face A that lies across a switch's plane S need not be cut if it does no
 * harm to keep it whole on one side, say in front. Let A' be its part behind
 * S, down to a depth D, and B any face of the other side.
 *
 * An eye in front of S sees A over B. That is wrong where the sight line meets
 * B and then A: it comes down through S, so it meets B above that point of A'.
 * So it must not be that B, as far as it lies above depth D, can obstruct A'.
 *
 * An eye behind S sees B over A. That is wrong where the sight line meets A'
 * and then B. So it must not be that A' can obstruct B; if the sight line goes
 * down, the eye lies less deep than D.
 *
 * With a tolerance, what is less deep than half of it does no harm, unless it
 * overlaps B as seen along the plane's normal (stacked layers): else what is
 * shown and what is due lie that near to the plane, or the eye does.
 *
 * Parts are found in floating point; what that leaves open counts as harm.
 */
#include "obstruction_whole.h"

#include <math.h>
#include <stdlib.h>

#include "tools/common/xalloc.h"

/* A face and where it lies. */
struct straddler {
    double low; /* heights of its corners */
    double high;
    uint32_t index; /* in the faces given */
};

struct keeper {
    struct obstruction_set *set;
    bool lenient; /* there is a tolerance beyond the step */
    double normal[3];
    double offset;
    const uint32_t *faces;
    uint8_t *places;
    struct straddler *across;
    uint32_t across_count;
    struct straddler *sides[2]; /* what is not behind, not in front */
    uint32_t side_counts[2];
};

static double height_of(const struct keeper *k, const double at[3])
{
    return k->normal[0] * at[0] + k->normal[1] * at[1] + k->normal[2] * at[2] + k->offset;
}

/*
 * The greatest value of way * (height above q) over the part of p whose height
 * above the switch's plane, times side, is at least from and at most to.
 */
static double most_within(const struct keeper *k, const struct obstruction_face *p,
                          const struct obstruction_face *q, int way, int side, double from,
                          double to)
{
    const double(*points)[3] = (const double(*)[3])k->set->points + p->first;
    double most = -INFINITY;
    for (uint32_t i = 0; i < p->count; i++) {
        const double *a = points[i];
        const double *b = points[i + 1 < p->count ? i + 1 : 0];
        double s = side * height_of(k, a);
        double t = side * height_of(k, b);
        double u = way * obstruction_height(q, a);
        double v = way * obstruction_height(q, b);
        if (s >= from && s <= to) {
            most = fmax(most, u);
        }
        if ((s < from) != (t < from)) {
            most = fmax(most, u + (from - s) / (t - s) * (v - u));
        }
        if ((s < to) != (t < to)) {
            most = fmax(most, u + (to - s) / (t - s) * (v - u));
        }
    }
    return most;
}

struct part {
    const struct obstruction_face *face;
    double from;
    double to;
};

/* Can part p obstruct part q? The whole faces do. */
static bool parts_obstruct(const struct keeper *k, const struct part *p, const struct part *q,
                           int side)
{
    double least = k->set->step - OBSTRUCTION_DOUBT;
    double up = most_within(k, p->face, q->face, 1, side, p->from, p->to);
    double down = most_within(k, q->face, p->face, -1, side, q->from, q->to);
    if (up < least || down < least) {
        return false;
    }
    if (k->set->tolerance > k->set->step) {
        return (up > k->set->tolerance || obstruction_stacked(k->set, p->face, q->face, 1)) &&
               (down > k->set->tolerance || obstruction_stacked(k->set, q->face, p->face, -1));
    }
    return true;
}

/* Does the part of a beyond the plane overlap b, as deep as that, as seen along its normal? */
static bool is_stacked(const struct keeper *k, const struct obstruction_face *a,
                       const struct obstruction_face *b, int side)
{
    double normal[3];
    for (int i = 0; i < 3; i++) {
        normal[i] = -side * k->normal[i];
    }
    return obstruction_parts_overlap(k->set, a, -side * k->offset, b, INFINITY, normal);
}

/* Is it wrong to keep a on this side (1: in front) of the plane, with b on the other? */
static bool harms(const struct keeper *k, const struct straddler *a, const struct straddler *b,
                  int side)
{
    const struct obstruction_face *fa = &k->set->faces[k->faces[a->index]];
    const struct obstruction_face *fb = &k->set->faces[k->faces[b->index]];
    double depth = side > 0 ? -a->low : a->high;
    double above = side > 0 ? b->high : -b->low; /* how far b comes over to a's side */
    if (k->places[b->index] == OBSTRUCTION_ACROSS) {
        above = 0; /* it is cut */
    }
    if (fa->plane == fb->plane) {
        return fa->sign == fb->sign && obstruction_overlap(k->set, fa, fb);
    }
    bool shallow = depth <= k->set->slack;
    if (k->lenient && shallow && above <= k->set->slack && !is_stacked(k, fa, fb, side)) {
        return false;
    }
    bool b_hides = above > -depth && obstruction_holds(k->set, fb, fa);
    bool a_hides = obstruction_holds(k->set, fa, fb);
    if (above > k->set->step) {
        return a_hides || b_hides; /* it was kept whole there and comes over */
    }
    struct part pa = { fa, -depth, 0 };
    struct part near = { fb, -depth, k->set->step };
    struct part all = { fb, -INFINITY, k->set->step };
    return (b_hides && parts_obstruct(k, &near, &pa, side)) ||
           (a_hides && parts_obstruct(k, &pa, &all, side));
}

static bool may_stay(const struct keeper *k, const struct straddler *a, int side)
{
    int other = side > 0;
    uint8_t here = side > 0 ? OBSTRUCTION_FRONT : OBSTRUCTION_BACK;
    for (uint32_t i = k->side_counts[other]; i > 0; i--) {
        const struct straddler *b = &k->sides[other][i - 1];
        if (b->index != a->index && k->places[b->index] != here && harms(k, a, b, side)) {
            return false;
        }
    }
    return true;
}

static double reach_of(const struct straddler *a)
{
    return fmin(a->high, -a->low);
}

static int compare_reaches(const void *left, const void *right)
{
    const struct straddler *a = left;
    const struct straddler *b = right;
    double x = reach_of(a);
    double y = reach_of(b);
    return x != y ? (x > y ? 1 : -1) : (a->index > b->index) - (a->index < b->index);
}

/* What lies across counts on both sides until it is decided, as if it were cut. */
static void sort_out(struct keeper *k, uint32_t count)
{
    for (uint32_t i = 0; i < count; i++) {
        const struct obstruction_face *face = &k->set->faces[k->faces[i]];
        struct straddler s = { INFINITY, -INFINITY, i };
        for (size_t p = face->first; p < face->first + face->count; p++) {
            double height = height_of(k, k->set->points[p]);
            s.low = fmin(s.low, height);
            s.high = fmax(s.high, height);
        }
        if (k->places[i] == OBSTRUCTION_ACROSS) {
            k->across[k->across_count++] = s;
        }
        if (k->places[i] != OBSTRUCTION_BACK) {
            k->sides[0][k->side_counts[0]++] = s;
        }
        if (k->places[i] != OBSTRUCTION_FRONT) {
            k->sides[1][k->side_counts[1]++] = s;
        }
    }
}

uint32_t obstruction_keep_whole(struct obstruction_set *set, const double normal[3], double offset,
                                const uint32_t *faces, uint32_t count, uint8_t *places)
{
    struct keeper k = { .set = set,
                        .lenient = set->tolerance > set->step,
                        .offset = offset,
                        .faces = faces,
                        .places = places };
    uint32_t cut = 0;
    for (int i = 0; i < 3; i++) {
        k.normal[i] = normal[i];
    }
    k.across = xalloc(count, sizeof *k.across);
    k.sides[0] = xalloc(count, sizeof *k.sides[0]);
    k.sides[1] = xalloc(count, sizeof *k.sides[1]);
    sort_out(&k, count);
    qsort(k.across, k.across_count, sizeof *k.across, compare_reaches);
    for (uint32_t i = 0; i < k.across_count; i++) {
        const struct straddler *a = &k.across[i];
        int nearer = a->high > -a->low ? 1 : -1;
        int side = may_stay(&k, a, nearer) ? nearer : may_stay(&k, a, -nearer) ? -nearer : 0;
        if (side != 0) {
            places[a->index] = side > 0 ? OBSTRUCTION_FRONT : OBSTRUCTION_BACK;
        }
        cut += side == 0;
    }
    free(k.across);
    free(k.sides[0]);
    free(k.sides[1]);
    return cut;
}
