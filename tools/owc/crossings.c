/* SPDX-License-Identifier: 0BSD */
/*
 * Polygons that run through one another: a hierarchy of boxes, compared with
 * itself, yields pairs; an edge passes through a polygon if its ends are on
 * different sides of the plane, exactly, and the point between is inside.
 */
#include "crossings.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "tools/common/xalloc.h"

enum { LEAF = 4 };

struct box {
    int16_t low[3];
    int16_t high[3];
};

/* A box over a run of order. */
struct knot {
    struct box box;
    uint32_t first;
    uint32_t count;
    uint32_t second; /* the second half; the first one follows at once; 0: a leaf */
};

struct hierarchy {
    const struct mesh *mesh;
    struct box *boxes; /* of polygons */
    struct entry *order;
    struct knot *knots;
    uint32_t knot_count;
};

struct entry {
    int32_t middle; /* twice, along the axis that the run is sorted by */
    uint32_t polygon;
};

static void join(struct box *box, const struct box *other)
{
    for (int k = 0; k < 3; k++) {
        box->low[k] = other->low[k] < box->low[k] ? other->low[k] : box->low[k];
        box->high[k] = other->high[k] > box->high[k] ? other->high[k] : box->high[k];
    }
}

static bool overlap(const struct box *a, const struct box *b)
{
    for (int k = 0; k < 3; k++) {
        if (a->low[k] > b->high[k] || b->low[k] > a->high[k]) {
            return false;
        }
    }
    return true;
}

static struct box box_of(const struct mesh *mesh, uint32_t number)
{
    const struct mesh_polygon *polygon = &mesh->polygons[number];
    struct box box = { { 0 }, { 0 } };
    for (uint32_t i = 0; i < polygon->count; i++) {
        const int16_t *p = mesh->points[mesh->corners[polygon->first + i]];
        struct box point;
        memcpy(point.low, p, sizeof point.low);
        memcpy(point.high, p, sizeof point.high);
        if (i == 0) {
            box = point;
        }
        join(&box, &point);
    }
    return box;
}

static int compare_entries(const void *left, const void *right)
{
    const struct entry *a = left;
    const struct entry *b = right;
    return a->middle != b->middle ? (a->middle > b->middle) - (a->middle < b->middle)
                                  : (a->polygon > b->polygon) - (a->polygon < b->polygon);
}

/* Halves are equal in number, so that the depth is at most 32. */
static uint32_t build(struct hierarchy *h, uint32_t first, uint32_t count)
{
    uint32_t number = h->knot_count++;
    struct knot *knot = &h->knots[number];
    *knot = (struct knot){ h->boxes[h->order[first].polygon], first, count, 0 };
    for (uint32_t i = 1; i < count; i++) {
        join(&knot->box, &h->boxes[h->order[first + i].polygon]);
    }
    if (count <= LEAF) {
        return number;
    }
    int axis = 0;
    for (int k = 1; k < 3; k++) {
        if (knot->box.high[k] - knot->box.low[k] > knot->box.high[axis] - knot->box.low[axis]) {
            axis = k;
        }
    }
    for (uint32_t i = first; i < first + count; i++) {
        const struct box *box = &h->boxes[h->order[i].polygon];
        h->order[i].middle = box->low[axis] + box->high[axis];
    }
    qsort(h->order + first, count, sizeof *h->order, compare_entries);
    build(h, first, count / 2);
    uint32_t second = build(h, first + count / 2, count - count / 2);
    h->knots[number].second = second;
    return number;
}

/* ---- one pair ---- */

static double dot(const double a[3], const double b[3])
{
    return a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
}

/* The winding number of the outline about a point of its plane, seen along an axis. */
static bool is_inside(const struct mesh *mesh, const struct mesh_polygon *polygon, int axis,
                      const double point[3])
{
    int x = (axis + 1) % 3;
    int y = (axis + 2) % 3;
    int winding = 0;
    for (uint32_t i = 0; i < polygon->count; i++) {
        const int16_t *a = mesh->points[mesh->corners[polygon->first + i]];
        uint32_t next = i + 1 < polygon->count ? i + 1 : 0;
        const int16_t *b = mesh->points[mesh->corners[polygon->first + next]];
        if ((a[y] <= point[y]) == (b[y] <= point[y])) {
            continue;
        }
        double cross =
            (double)(b[x] - a[x]) * (point[y] - a[y]) - (double)(b[y] - a[y]) * (point[x] - a[x]);
        bool up = a[y] < b[y];
        winding += up && cross > 0 ? 1 : !up && cross < 0 ? -1 : 0;
    }
    return winding != 0;
}

/* Within a step and a half of the outline: it touches, or snapping moved it there. */
static bool is_at_outline(const struct mesh *mesh, const struct mesh_polygon *polygon,
                          const double point[3])
{
    for (uint32_t i = 0; i < polygon->count; i++) {
        const int16_t *a = mesh->points[mesh->corners[polygon->first + i]];
        uint32_t next = i + 1 < polygon->count ? i + 1 : 0;
        const int16_t *b = mesh->points[mesh->corners[polygon->first + next]];
        double along[3];
        double to[3];
        for (int k = 0; k < 3; k++) {
            along[k] = b[k] - a[k];
            to[k] = point[k] - a[k];
        }
        double share = fmax(0, fmin(1, dot(along, to) / dot(along, along)));
        for (int k = 0; k < 3; k++) {
            to[k] -= share * along[k];
        }
        if (dot(to, to) < 2.25) {
            return true;
        }
    }
    return false;
}

/* Does an edge of a pass through b? Lattice planes have integers below 2^53: signs are exact. */
static bool passes(const struct mesh *mesh, const struct mesh_polygon *a,
                   const struct mesh_polygon *b)
{
    int64_t area[3];
    double n[3];
    double o[3];
    int axis = 0;
    mesh_area((const int16_t(*)[3])mesh->points, mesh->corners + b->first, b->count, area);
    for (int k = 0; k < 3; k++) {
        n[k] = (double)area[k];
        o[k] = mesh->points[mesh->corners[b->first]][k];
        axis = fabs(n[k]) > fabs(n[axis]) ? k : axis;
    }
    double offset = dot(n, o);
    double slack = sqrt(dot(n, n)); /* one lattice step: polygons are flat to within it */
    for (uint32_t i = 0; i < a->count; i++) {
        uint32_t next = i + 1 < a->count ? i + 1 : 0;
        double p[3];
        double q[3];
        for (int k = 0; k < 3; k++) {
            p[k] = mesh->points[mesh->corners[a->first + i]][k];
            q[k] = mesh->points[mesh->corners[a->first + next]][k];
        }
        double s = dot(n, p) - offset;
        double t = dot(n, q) - offset;
        if ((s > slack && t < -slack) || (s < -slack && t > slack)) {
            for (int k = 0; k < 3; k++) {
                p[k] += (q[k] - p[k]) * s / (s - t);
            }
            if (is_inside(mesh, b, axis, p) && !is_at_outline(mesh, b, p)) {
                return true;
            }
        }
    }
    return false;
}

static bool cross(const struct hierarchy *h, uint32_t i, uint32_t k)
{
    const struct mesh *mesh = h->mesh;
    const struct mesh_polygon *a = &mesh->polygons[i];
    const struct mesh_polygon *b = &mesh->polygons[k];
    return overlap(&h->boxes[i], &h->boxes[k]) && (passes(mesh, a, b) || passes(mesh, b, a));
}

/* ---- all pairs ---- */

static uint32_t count_in_leaves(const struct hierarchy *h, const struct knot *a,
                                const struct knot *b)
{
    uint32_t found = 0;
    for (uint32_t i = 0; i < a->count; i++) {
        for (uint32_t k = a == b ? i + 1 : 0; k < b->count; k++) {
            found += cross(h, h->order[a->first + i].polygon, h->order[b->first + k].polygon);
        }
    }
    return found;
}

struct pair {
    uint32_t a;
    uint32_t b;
};

static uint32_t count_pairs(const struct hierarchy *h, bool *complete)
{
    struct pair *stack = NULL;
    size_t capacity = 0;
    size_t count = 1;
    uint32_t boxes = 0;
    uint32_t found = 0;
    stack = xgrow(stack, &capacity, 1, sizeof *stack);
    stack[0] = (struct pair){ 0, 0 };
    while (count > 0 && boxes < CROSSINGS_MOST_BOXES) {
        struct pair pair = stack[--count];
        const struct knot *a = &h->knots[pair.a];
        const struct knot *b = &h->knots[pair.b];
        boxes++;
        if (!overlap(&a->box, &b->box)) {
            continue;
        }
        if (a->second == 0 && b->second == 0) {
            found += count_in_leaves(h, a, b);
            boxes += a->count * b->count;
            continue;
        }
        stack = xgrow(stack, &capacity, count + 3, sizeof *stack);
        if (pair.a == pair.b) {
            stack[count++] = (struct pair){ pair.a + 1, pair.a + 1 };
            stack[count++] = (struct pair){ a->second, a->second };
            stack[count++] = (struct pair){ pair.a + 1, a->second };
        } else if (b->second == 0 || (a->second != 0 && a->count > b->count)) {
            stack[count++] = (struct pair){ pair.a + 1, pair.b };
            stack[count++] = (struct pair){ a->second, pair.b };
        } else {
            stack[count++] = (struct pair){ pair.a, pair.b + 1 };
            stack[count++] = (struct pair){ pair.a, b->second };
        }
    }
    *complete = count == 0;
    free(stack);
    return found;
}

uint32_t crossings_count(const struct mesh *mesh, bool *complete)
{
    uint32_t count = mesh->polygon_count;
    struct hierarchy h = { .mesh = mesh };
    h.boxes = xalloc(count, sizeof *h.boxes);
    h.order = xalloc(count, sizeof *h.order);
    h.knots = xalloc((size_t)count * 2, sizeof *h.knots);
    for (uint32_t i = 0; i < count; i++) {
        h.boxes[i] = box_of(mesh, i);
        h.order[i].polygon = i;
    }
    build(&h, 0, count);
    uint32_t found = count_pairs(&h, complete);
    free(h.boxes);
    free(h.order);
    free(h.knots);
    return found;
}
