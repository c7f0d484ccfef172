/* SPDX-License-Identifier: 0BSD */
/*
 * The order of two faces depends on one node alone, the lowest that is above
 * both: a sequence, which orders them once and for all, or a switch S, which
 * orders them by the eye's side of S.
 *
 * Say the order shows P over Q, always or from the eyes in front of S. It is
 * wrong if an eye e sees both fronts and meets a point q of Q before a point p
 * of P: e = q + t (q - p) with some t > 0. Heights are linear, so
 *
 *     above P  h(e) = (1 + t) h(q): q is strictly in front of P's plane;
 *     above Q  h(e) = -t h(p):      p is strictly behind Q's plane;
 *     above S  h(e) = h(q) + t (h(q) - h(p)), positive for some t if h(q) > 0
 *              or h(q) > h(p).
 *
 * p and q are chosen apart from one another. So let b be the greatest height
 * above S of the part of Q in front of P's plane, a the least of the part of P
 * behind Q's: the order is wrong if both parts are there and b > 0 or b > a.
 * Eyes at infinity (parallel projection) are the limit of large t.
 *
 * Within a tolerance T of a plane means on it, as DESIGN.md says: then "in
 * front" is by more than T, and it is not wrong if the eye, or both p and q,
 * are within T of S: wrong are b > T, or a < -T and b > a. Rounding moves both
 * p and q, by less than a step each.
 *
 * Corners are quotients of integers (exact.h), so a and b are quotients of
 * products of two; they are compared as integers of 512 bits. Rounded heights
 * come first and decide what they can.
 */
#include "order_check.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "tests/property/wide_product.h"
#include "tools/common/xalloc.h"

struct judged_face {
    tree_item item;
    uint32_t plane;
    uint32_t polygon;
    int sign; /* -1: it looks against its plane's normal */
    size_t first;
    uint32_t count; /* corners */
};

struct judge {
    struct order_check *check;
    struct judged_face *faces; /* a subtree's faces stand together */
    uint32_t face_count;
    size_t face_capacity;
    uint32_t *corners; /* vertices of the arrangement, or corners of the outlines */
    size_t corner_count;
    size_t corner_capacity;
    int64_t *margins; /* by plane: T |n| */
    bool *met;        /* by item */
};

/* A height above a plane times its normal's length: value / weight, weight > 0. */
struct height {
    wide value;
    wide weight;
};

/* ---- heights ---- */

/* How far corners are off their own plane at most, lattice steps with 8 fraction bits. */
static uint32_t most_reach_q8(const struct planes *planes)
{
    uint32_t most = 0;
    for (uint32_t i = 0; i < planes->count; i++) {
        const struct plane *plane = &planes->all[i];
        uint32_t q8 = 0;
        while (plane->reach > exact_tolerance(plane->n, q8)) {
            q8++;
        }
        most = q8 > most ? q8 : most;
    }
    return most;
}

static void set_margins(struct judge *j)
{
    const struct arrangement *a = j->check->arrangement;
    uint32_t q8 = j->check->tolerance_q8 + most_reach_q8(a->planes);
    q8 += a->rounded > 0 ? 256 : 0; /* some cuts were put on the lattice at once */
    q8 += j->check->repaired != NULL ? 256 : 0;
    j->check->margin_q8 = q8;
    j->margins = xalloc(a->planes->count, sizeof *j->margins);
    for (uint32_t i = 0; i < a->planes->count; i++) {
        j->margins[i] = exact_tolerance(a->planes->all[i].n, q8);
    }
}

static const double *double_at(const struct judge *j, uint32_t corner, double out[3])
{
    if (j->check->repaired == NULL) {
        return j->check->arrangement->at[corner];
    }
    for (int k = 0; k < 3; k++) {
        out[k] = j->check->repaired->corners[corner][k];
    }
    return out;
}

static struct height exact_height(const struct judge *j, const struct plane *plane, uint32_t corner)
{
    const struct arrangement *a = j->check->arrangement;
    const struct plane *planes = a->planes->all;
    if (j->check->repaired != NULL) {
        return (struct height){ exact_side(plane, j->check->repaired->corners[corner]), 1 };
    }
    const struct vertex *vertex = &a->vertices[corner];
    if (vertex->kind == VERTEX_POINT || vertex->kind == VERTEX_ROUNDED) {
        return (struct height){ exact_side(plane, vertex->lattice), 1 };
    }
    const struct line *line = &a->lines[vertex->line];
    if (vertex->kind == VERTEX_MEETING) {
        struct meeting meeting;
        exact_meet(&planes[line->carrier], &planes[line->cutter], &planes[vertex->plane], &meeting);
        return (struct height){ exact_side_meeting(plane, &meeting), meeting.w };
    }
    const int16_t *p = a->vertices[line->ends[0]].lattice;
    const int16_t *q = a->vertices[line->ends[1]].lattice;
    int64_t s = llabs(exact_side(&planes[vertex->plane], p));
    int64_t t = llabs(exact_side(&planes[vertex->plane], q));
    return (struct height){ (wide)exact_side(plane, p) * t + (wide)exact_side(plane, q) * s,
                            (wide)s + t };
}

/* way * height - margin: positive if the corner is beyond the tolerance on that side. */
static struct height beyond_by(const struct judge *j, uint32_t plane, int way, uint32_t corner)
{
    struct height height = exact_height(j, &j->check->arrangement->planes->all[plane], corner);
    height.value = way * height.value - j->margins[plane] * height.weight;
    return height;
}

static bool is_beyond(const struct judge *j, uint32_t number, int way, uint32_t corner)
{
    const struct plane *plane = &j->check->arrangement->planes->all[number];
    double buffer[3];
    const double *at = double_at(j, corner, buffer);
    double rounded = way * (plane->normal[0] * at[0] + plane->normal[1] * at[1] +
                            plane->normal[2] * at[2] + plane->offset) -
                     (double)j->margins[number];
    if (fabs(rounded) > 1) { /* rounding errors are far below 1 */
        return rounded > 0;
    }
    return beyond_by(j, number, way, corner).value > 0;
}

static bool reaches(const struct judge *j, const struct judged_face *face, uint32_t plane, int way)
{
    for (uint32_t i = 0; i < face->count; i++) {
        if (is_beyond(j, plane, way, j->corners[face->first + i])) {
            return true;
        }
    }
    return false;
}

/* ---- how far the hiding parts reach ---- */

struct ratio {
    struct big value;
    struct big weight; /* positive */
};

static struct ratio ratio_of(const struct height *height)
{
    return (struct ratio){ big_of(height->value), big_of(height->weight) };
}

/* a < b */
static bool is_less(const struct ratio *a, const struct ratio *b)
{
    struct big left = big_product(a->value, b->weight);
    struct big right = big_product(b->value, a->weight);
    struct big difference = big_add(right, big_negate(left));
    return big_sign(&difference) > 0;
}

/* Between two corners, where the cutting height is zero: in > 0 at the one, out <= 0 at the other. */
static struct ratio crossing(const struct height *in, const struct height *out,
                             const struct height *at_in, const struct height *at_out)
{
    struct big minus_out = big_negate(big_of(out->value));
    struct big value = big_add(big_product(big_of(at_in->value), minus_out),
                               big_product(big_of(at_out->value), big_of(in->value)));
    struct big weight = big_add(big_product(big_of(in->value), big_of(out->weight)),
                                big_product(minus_out, big_of(in->weight)));
    return (struct ratio){ value, weight };
}

/*
 * The greatest way * height - margin above plane S of the part of a face that
 * is beyond a plane. Corners have the same weight whatever the plane is, so the
 * crossing's weights cancel but for those of the cutting heights.
 */
static struct ratio greatest(const struct judge *j, const struct judged_face *face, uint32_t plane,
                             int beyond_way, uint32_t s, int way)
{
    struct ratio best = { { { 0 } }, { { 0 } } };
    bool found = false;
    for (uint32_t i = 0; i < face->count; i++) {
        uint32_t here = j->corners[face->first + i];
        uint32_t next = j->corners[face->first + (i + 1 < face->count ? i + 1 : 0)];
        struct height h = beyond_by(j, plane, beyond_way, here);
        struct height n = beyond_by(j, plane, beyond_way, next);
        struct height at_here = beyond_by(j, s, way, here);
        struct height at_next = beyond_by(j, s, way, next);
        struct ratio candidates[2];
        int count = 0;
        if (h.value > 0) {
            candidates[count++] = ratio_of(&at_here);
        }
        if ((h.value > 0) != (n.value > 0)) {
            candidates[count++] = h.value > 0 ? crossing(&h, &n, &at_here, &at_next)
                                              : crossing(&n, &h, &at_next, &at_here);
        }
        for (int k = 0; k < count; k++) {
            if (!found || is_less(&best, &candidates[k])) {
                best = candidates[k];
                found = true;
            }
        }
    }
    return best;
}

/*
 * Both hiding parts are there. b - T > 0, or -a - T > 0 and b > a, that is
 * (b - T) + (-a - T) + 2T > 0.
 */
static bool switch_is_wrong(const struct judge *j, const struct judged_face *p,
                            const struct judged_face *q, uint32_t s, int way)
{
    bool q_reaches = reaches(j, q, s, way);
    bool p_reaches = reaches(j, p, s, -way);
    if (!q_reaches && !p_reaches) {
        return false;
    }
    struct ratio b = greatest(j, q, p->plane, p->sign, s, way);
    if (big_sign(&b.value) > 0) {
        return true;
    }
    if (!p_reaches) {
        return false;
    }
    struct ratio a = greatest(j, p, q->plane, -q->sign, s, -way);
    if (big_sign(&a.value) <= 0) {
        return false;
    }
    /* b > a: the margins that were taken off both are put back, those of rounding excepted. */
    const struct plane *plane = &j->check->arrangement->planes->all[s];
    wide back = 2 * (wide)j->margins[s];
    back -= j->check->repaired != NULL ? 2 * (wide)exact_tolerance(plane->n, 256) : 0;
    struct ratio least = { big_negate(a.value), a.weight };
    least.value = big_add(least.value, big_negate(big_product(big_of(back), a.weight)));
    return is_less(&least, &b);
}

/* ---- pairs ---- */

#define ALWAYS MESH_NONE /* instead of a switch's plane */

static double cross_along(const double u[3], const double v[3], const double n[3])
{
    return (u[1] * v[2] - u[2] * v[1]) * n[0] + (u[2] * v[0] - u[0] * v[2]) * n[1] +
           (u[0] * v[1] - u[1] * v[0]) * n[2];
}

/* Height of corner c over the edge i of a face, lattice steps; inside is positive. */
static double inside_edge(const struct judge *j, const struct judged_face *face, uint32_t i,
                          uint32_t corner)
{
    double buffers[3][3];
    const struct plane *plane = &j->check->arrangement->planes->all[face->plane];
    const double *p = double_at(j, j->corners[face->first + i], buffers[0]);
    const double *q = double_at(j, j->corners[face->first + (i + 1) % face->count], buffers[1]);
    const double *c = double_at(j, corner, buffers[2]);
    double u[3] = { q[0] - p[0], q[1] - p[1], q[2] - p[2] };
    double v[3] = { c[0] - p[0], c[1] - p[1], c[2] - p[2] };
    double length =
        sqrt((u[0] * u[0] + u[1] * u[1] + u[2] * u[2]) *
             (plane->normal[0] * plane->normal[0] + plane->normal[1] * plane->normal[1] +
              plane->normal[2] * plane->normal[2]));
    int looks = tree_item_tag(face->item) == OW_ITEM_REVERSE ? -1 : 1; /* corners run that way */
    return length > 0 ? face->sign * looks * cross_along(u, v, plane->normal) / length : 0;
}

/* How far the two overlap across each edge of a, at least; < 0: a is not convex. */
static double depth_inside(const struct judge *j, const struct judged_face *a,
                           const struct judged_face *b)
{
    double least = INFINITY;
    for (uint32_t i = 0; i < a->count; i++) {
        double own = 0;
        double others = -INFINITY;
        for (uint32_t k = 0; k < a->count; k++) {
            double inside = inside_edge(j, a, i, j->corners[a->first + k]);
            if (inside < -1e-3) {
                return -1;
            }
            own = fmax(own, inside);
        }
        for (uint32_t k = 0; k < b->count; k++) {
            others = fmax(others, inside_edge(j, a, i, j->corners[b->first + k]));
        }
        least = fmin(least, fmin(own, others));
    }
    return least;
}

/*
 * Faces of one plane record that look the same way: of two that overlap the
 * later in the file is to be seen. By rounded heights, convex faces alone.
 */
static bool coplanar_is_wrong(const struct judge *j, const struct judged_face *shown,
                              const struct judged_face *other)
{
    const struct plane *plane = &j->check->arrangement->planes->all[shown->plane];
    double length = sqrt(plane->normal[0] * plane->normal[0] + plane->normal[1] * plane->normal[1] +
                         plane->normal[2] * plane->normal[2]);
    /* A step is the finest distance; and corners may be off their plane. */
    double margin = 1 + 2.0 * j->check->tolerance_q8 / 256 + 2 * (double)plane->reach / length;
    margin += j->check->arrangement->rounded > 0 || j->check->repaired != NULL ? 2 : 0;
    return shown->sign == other->sign && shown->polygon < other->polygon &&
           depth_inside(j, shown, other) > margin && depth_inside(j, other, shown) > margin;
}

/* Does a face reach out of a plane? */
static bool is_off(const struct judge *j, const struct judged_face *face, uint32_t plane)
{
    return reaches(j, face, plane, 1) || reaches(j, face, plane, -1);
}

static bool both_reach(const struct judge *j, const struct judged_face *p,
                       const struct judged_face *q, uint32_t plane, int way)
{
    return reaches(j, p, plane, way) && reaches(j, q, plane, way);
}

/*
 * The order shows p over q: always (way 0), or where the eye's height above s
 * has the sign of way. Is that wrong?
 */
static bool is_wrong(struct judge *j, const struct judged_face *p, const struct judged_face *q,
                     uint32_t s, int way)
{
    j->check->pairs++;
    if (p->plane == q->plane) {
        bool seen = s != p->plane || way != -p->sign;
        bool there =
            s == ALWAYS || s == p->plane || both_reach(j, p, q, s, 1) || both_reach(j, p, q, s, -1);
        return seen && there && coplanar_is_wrong(j, p, q);
    }
    if (!reaches(j, q, p->plane, p->sign) || !reaches(j, p, q->plane, -q->sign)) {
        return false;
    }
    j->check->decisive++;
    if (s != ALWAYS && way == 0) { /* both lie in the switch's plane */
        return is_off(j, p, s) || is_off(j, q, s);
    }
    return s == ALWAYS || switch_is_wrong(j, p, q, s, way);
}

/* Faces of range a are shown under those of range b. */
static bool ranges_are_right(struct judge *j, const uint32_t a[2], const uint32_t b[2], uint32_t s,
                             int way)
{
    for (uint32_t i = a[0]; i < a[1]; i++) {
        for (uint32_t k = b[0]; k < b[1]; k++) {
            if (is_wrong(j, &j->faces[k], &j->faces[i], s, way)) {
                j->check->wrong[0] = j->faces[i].item;
                j->check->wrong[1] = j->faces[k].item;
                j->check->wrong_plane = s;
                return false;
            }
        }
    }
    return true;
}

/* ---- the tree ---- */

static void add_corner(struct judge *j, uint32_t corner)
{
    j->corners = xgrow(j->corners, &j->corner_capacity, j->corner_count + 1, sizeof *j->corners);
    j->corners[j->corner_count++] = corner;
}

static struct judged_face *add_face(struct judge *j, tree_item item)
{
    uint32_t number = tree_item_value(item);
    const struct piece *piece = &j->check->pieces->all[number];
    bool reverse = tree_item_tag(item) == OW_ITEM_REVERSE;
    j->faces = xgrow(j->faces, &j->face_capacity, (size_t)j->face_count + 1, sizeof *j->faces);
    struct judged_face *face = &j->faces[j->face_count++];
    *face =
        (struct judged_face){ item,
                              piece->record,
                              piece->polygon,
                              j->check->mesh->polygons[piece->polygon].reversed != reverse ? -1 : 1,
                              j->corner_count,
                              0 };
    return face;
}

/* A face, or as many as the piece has outlines; slivers without area are left out. */
static bool meet_faces(struct judge *j, tree_item item)
{
    uint32_t number = tree_item_value(item);
    const struct piece *piece = &j->check->pieces->all[number];
    const struct repaired *repaired = j->check->repaired;
    if (j->met[item]) {
        j->check->wrong[0] = j->check->wrong[1] = item;
        return false;
    }
    j->met[item] = true;
    j->check->faces++;
    if (repaired == NULL && piece->count > 2) {
        struct judged_face *face = add_face(j, item);
        face->count = piece->count;
        for (uint32_t i = 0; i < piece->count; i++) {
            add_corner(j, j->check->pieces->vertices[piece->first + i]);
        }
    }
    for (uint32_t o = repaired != NULL ? repaired->first[number] : 0;
         repaired != NULL && o < repaired->first[number + 1]; o++) {
        struct judged_face *face = add_face(j, item);
        face->count = repaired->outlines[o].count;
        for (uint32_t i = 0; i < face->count; i++) {
            add_corner(j, (uint32_t)repaired->outlines[o].first + i);
        }
    }
    return true;
}

static bool meet(struct judge *j, tree_item item);

/* Each item of a sequence, or face in a switch's plane, is shown over those before it. */
static bool meet_items(struct judge *j, const struct tree_node *node)
{
    uint32_t begin = j->face_count;
    for (uint32_t i = 0; i < node->count; i++) {
        uint32_t before[2] = { begin, j->face_count };
        if (!meet(j, j->check->tree->items[node->first + i])) {
            return false;
        }
        uint32_t own[2] = { before[1], j->face_count };
        if (!ranges_are_right(j, before, own, node->plane, 0)) {
            return false;
        }
    }
    return true;
}

/* From the front: back child, coplanar faces, front child, farthest first. */
static bool meet_switch(struct judge *j, const struct tree_node *node)
{
    uint32_t begin = j->face_count;
    if (!meet(j, node->back)) {
        return false;
    }
    uint32_t back[2] = { begin, j->face_count };
    if (!meet_items(j, node)) {
        return false;
    }
    uint32_t on[2] = { back[1], j->face_count };
    if (!meet(j, node->front)) {
        return false;
    }
    uint32_t front[2] = { on[1], j->face_count };
    uint32_t s = node->plane;
    return ranges_are_right(j, back, on, s, 1) && ranges_are_right(j, back, front, s, 1) &&
           ranges_are_right(j, on, front, s, 1) && ranges_are_right(j, on, back, s, -1) &&
           ranges_are_right(j, front, back, s, -1) && ranges_are_right(j, front, on, s, -1);
}

/* Recursive: scenes are small. */
static bool meet(struct judge *j, tree_item item)
{
    if (item == OW_ITEM_NONE) {
        return true;
    }
    if (tree_item_tag(item) != OW_ITEM_NODE) {
        return meet_faces(j, item);
    }
    const struct tree_node *node = &j->check->tree->nodes[tree_item_value(item)];
    return node->plane == MESH_NONE ? meet_items(j, node) : meet_switch(j, node);
}

bool order_is_right(struct order_check *check)
{
    struct judge j = { .check = check };
    check->pairs = check->decisive = check->faces = 0;
    check->wrong_plane = MESH_NONE;
    set_margins(&j);
    j.met = xalloc_zero((size_t)check->pieces->count << OW_ITEM_TAG_BITS, sizeof *j.met);
    bool right = meet(&j, check->tree->root);
    free(j.margins);
    free(j.met);
    free(j.faces);
    free(j.corners);
    return right;
}
