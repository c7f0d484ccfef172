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

#include "obstruction_plane.h"
#include "tools/common/xalloc.h"

enum { SEARCH_FROM = 96 }; /* faces; fewer are all looked at */

/* A face and where it lies. */
struct keeper_face {
    double low; /* heights of its corners */
    double high;
    uint32_t index;
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
            most = larger(most, u);
        }
        if ((s < from) != (t < from)) {
            most = larger(most, u + (from - s) / (t - s) * (v - u));
        }
        if ((s < to) != (t < to)) {
            most = larger(most, u + (to - s) / (t - s) * (v - u));
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
static bool harms(const struct keeper *k, const struct keeper_face *a, const struct keeper_face *b,
                  int side)
{
    const struct obstruction_face *fa = &k->set->faces[a->index];
    const struct obstruction_face *fb = &k->set->faces[b->index];
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

static struct keeper_face face_of(const struct keeper *k, uint32_t index)
{
    const struct obstruction_face *face = &k->set->faces[index];
    struct keeper_face f = { INFINITY, -INFINITY, index };
    for (size_t p = face->first; p < face->first + face->count; p++) {
        double height = height_of(k, k->set->points[p]);
        f.low = smaller(f.low, height);
        f.high = larger(f.high, height);
    }
    return f;
}

/* Does this face, if it is not on a's side alone, forbid a to stay there? */
static bool forbids(const struct keeper *k, const struct keeper_face *a, uint32_t index, int side)
{
    uint8_t here = side > 0 ? OBSTRUCTION_FRONT : OBSTRUCTION_BACK;
    if (index == a->index || k->places[index] == here) {
        return false;
    }
    struct keeper_face b = face_of(k, index);
    return harms(k, a, &b, side);
}

/* May a node hold a face that forbids a to stay? Never false if it does; coplanar ones excepted. */
static bool may_forbid(const struct keeper *k, const struct hierarchy_node *node,
                       const struct keeper_face *a, int side)
{
    const struct obstruction_face *face = &k->set->faces[a->index];
    double depth = side > 0 ? -a->low : a->high;
    double low = side * k->offset; /* heights of the node's box, on a's side */
    double high = low;
    for (int i = 0; i < 3; i++) {
        double n = side * k->normal[i];
        low += smaller(n * node->low[i], n * node->high[i]);
        high += larger(n * node->low[i], n * node->high[i]);
    }
    return low <= k->set->step + OBSTRUCTION_DOUBT &&
           ((high > -depth && hierarchy_may_hold(&k->hierarchy, node, face, HIERARCHY_HIDING)) ||
            hierarchy_may_hold(&k->hierarchy, node, face, HIERARCHY_HIDDEN));
}

/* The face that forbids a to stay on this side, or MESH_NONE. */
static uint32_t find_forbidding(const struct keeper *k, const struct keeper_face *a, int side)
{
    uint32_t witness = k->witnesses[a->index][side > 0];
    if (witness != MESH_NONE && forbids(k, a, witness, side)) {
        return witness;
    }
    const struct hierarchy *h = &k->hierarchy;
    if (!k->searching || h->coplanar[a->index]) {
        for (uint32_t i = 0; i < k->set->count; i++) {
            if (forbids(k, a, i, side)) {
                return i;
            }
        }
        return MESH_NONE;
    }
    for (uint32_t i = 0; i < h->node_count;) {
        const struct hierarchy_node *node = &h->nodes[i];
        if (!may_forbid(k, node, a, side)) {
            i = node->next;
            continue;
        }
        for (uint32_t f = node->first; node->leaf && f < node->first + node->count; f++) {
            if (forbids(k, a, h->faces[f], side)) {
                return h->faces[f];
            }
        }
        i++;
    }
    return MESH_NONE;
}

static bool may_stay(struct keeper *k, const struct keeper_face *a, int side)
{
    uint32_t found = find_forbidding(k, a, side);
    if (found != MESH_NONE) {
        k->witnesses[a->index][side > 0] = found;
    }
    return found == MESH_NONE;
}

static double reach_of(const struct keeper_face *a)
{
    return smaller(a->high, -a->low);
}

static int compare_reaches(const void *left, const void *right)
{
    const struct keeper_face *a = left;
    const struct keeper_face *b = right;
    double x = reach_of(a);
    double y = reach_of(b);
    return x != y ? (x > y ? 1 : -1) : (a->index > b->index) - (a->index < b->index);
}

void keeper_begin(struct keeper *k, struct obstruction_set *set)
{
    *k = (struct keeper){ .set = set, .lenient = set->tolerance > set->step };
    k->searching = set->count >= SEARCH_FROM;
    k->across = xalloc(set->count, sizeof *k->across);
    k->witnesses = xalloc(set->count, sizeof *k->witnesses);
    for (uint32_t i = 0; i < set->count; i++) {
        k->witnesses[i][0] = k->witnesses[i][1] = MESH_NONE;
    }
    if (k->searching) {
        hierarchy_begin(&k->hierarchy, set);
    }
}

void keeper_free(struct keeper *k)
{
    if (k->searching) {
        hierarchy_free(&k->hierarchy);
    }
    free(k->across);
    free(k->witnesses);
    *k = (struct keeper){ 0 };
}

/* What lies across counts on both sides until it is decided, as if it were cut. */
uint32_t keeper_keep(struct keeper *k, const double normal[3], double offset, uint8_t *places,
                     uint32_t most)
{
    uint32_t count = 0;
    uint32_t cut = 0;
    for (int i = 0; i < 3; i++) {
        k->normal[i] = normal[i];
    }
    k->offset = offset;
    k->places = places;
    for (uint32_t i = 0; i < k->set->count; i++) {
        if (places[i] == OBSTRUCTION_ACROSS) {
            k->across[count++] = face_of(k, i);
        }
    }
    qsort(k->across, count, sizeof *k->across, compare_reaches);
    for (uint32_t i = 0; i < count && cut <= most; i++) {
        const struct keeper_face *a = &k->across[i];
        int nearer = a->high > -a->low ? 1 : -1;
        int side = may_stay(k, a, nearer) ? nearer : may_stay(k, a, -nearer) ? -nearer : 0;
        if (side != 0) {
            places[a->index] = side > 0 ? OBSTRUCTION_FRONT : OBSTRUCTION_BACK;
        }
        cut += side == 0;
    }
    return cut;
}
