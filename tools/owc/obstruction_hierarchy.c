/* SPDX-License-Identifier: 0BSD */
/* The hierarchy over the faces of a set, and the search in it. */
#include "obstruction_hierarchy.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "map64.h"
#include "tools/common/xalloc.h"

enum { LEAF_FACES = 4, SORT_AXES = 6 };

/* How much a unit of normal weighs, against the longest side of all, when faces are grouped. */
#define NORMAL_WEIGHT 0.35

/* ---- building ---- */

struct grower {
    struct hierarchy *hierarchy;
    double weight; /* lattice steps for a unit of normal */
};

/* A face as a point of six dimensions: where it is and where it looks. */
static double coordinate(const struct grower *g, uint32_t face, int axis)
{
    const struct obstruction_face *f = &g->hierarchy->set->faces[face];
    return axis < 3 ? f->centre[axis] : g->weight * f->normal[axis - 3];
}

static int widest_axis(const struct grower *g, const uint32_t *faces, uint32_t count)
{
    int best = 0;
    double widest = -1;
    for (int axis = 0; axis < SORT_AXES; axis++) {
        double low = INFINITY;
        double high = -INFINITY;
        for (uint32_t i = 0; i < count; i++) {
            double value = coordinate(g, faces[i], axis);
            low = smaller(low, value);
            high = larger(high, value);
        }
        if (high - low > widest) {
            widest = high - low;
            best = axis;
        }
    }
    return best;
}

/* Puts the smaller half of the faces first: Hoare's selection, on (coordinate, number). */
static void halve(const struct grower *g, uint32_t *faces, uint32_t count, int axis)
{
    uint32_t low = 0;
    uint32_t high = count - 1;
    uint32_t middle = count / 2;
    while (low < high) {
        uint32_t pivot = faces[low + (high - low) / 2];
        double value = coordinate(g, pivot, axis);
        uint32_t i = low;
        uint32_t k = high;
        for (;;) {
            double at = coordinate(g, faces[i], axis);
            while (at < value || (at == value && faces[i] < pivot)) {
                at = coordinate(g, faces[++i], axis);
            }
            at = coordinate(g, faces[k], axis);
            while (at > value || (at == value && faces[k] > pivot)) {
                at = coordinate(g, faces[--k], axis);
            }
            if (i >= k) {
                break;
            }
            uint32_t swap = faces[i];
            faces[i++] = faces[k];
            faces[k--] = swap;
        }
        if (middle <= k) {
            high = k;
        } else {
            low = k + 1;
        }
    }
}

static void bound(const struct hierarchy *h, struct hierarchy_node *node)
{
    const struct obstruction_set *set = h->set;
    for (int k = 0; k < 3; k++) {
        node->low[k] = node->normal_low[k] = INFINITY;
        node->high[k] = node->normal_high[k] = -INFINITY;
    }
    for (uint32_t i = node->first; i < node->first + node->count; i++) {
        const struct obstruction_face *face = &set->faces[h->faces[i]];
        for (int k = 0; k < 3; k++) {
            node->normal_low[k] = smaller(node->normal_low[k], face->normal[k]);
            node->normal_high[k] = larger(node->normal_high[k], face->normal[k]);
        }
        for (size_t p = face->first; p < face->first + face->count; p++) {
            for (int k = 0; k < 3; k++) {
                node->low[k] = smaller(node->low[k], set->points[p][k]);
                node->high[k] = larger(node->high[k], set->points[p][k]);
            }
        }
    }
    node->height_low = INFINITY;
    node->height_high = -INFINITY;
    for (int k = 0; k < 3; k++) {
        node->middle[k] = (node->low[k] + node->high[k]) / 2;
    }
    for (uint32_t i = node->first; i < node->first + node->count; i++) {
        double height = obstruction_height(&set->faces[h->faces[i]], node->middle);
        node->height_low = smaller(node->height_low, height);
        node->height_high = larger(node->height_high, height);
    }
}

/* Depth is the logarithm of the number of faces: recursion is safe. */
static void grow(const struct grower *g, uint32_t first, uint32_t count, uint32_t parent)
{
    struct hierarchy *h = g->hierarchy;
    uint32_t number = h->node_count++;
    struct hierarchy_node *node = &h->nodes[number];
    node->first = first;
    node->count = count;
    node->parent = parent;
    node->leaf = count <= LEAF_FACES;
    bound(h, node);
    if (!node->leaf) {
        halve(g, h->faces + first, count, widest_axis(g, h->faces + first, count));
        grow(g, first, count / 2, number);
        grow(g, first + count / 2, count - count / 2, number);
    } else {
        for (uint32_t i = first; i < first + count; i++) {
            h->leaf_of[h->faces[i]] = number;
        }
    }
    node->next = h->node_count;
}

static void find_coplanar(struct hierarchy *h)
{
    struct map64 planes = { 0 };
    for (uint32_t i = 0; i < h->set->count; i++) {
        const struct obstruction_face *face = &h->set->faces[i];
        uint32_t other = map64_put(&planes, map64_key(face->plane, face->sign > 0), i);
        if (other != i) {
            h->coplanar[i] = h->coplanar[other] = true;
        }
    }
    map64_free(&planes);
}

void hierarchy_begin(struct hierarchy *h, struct obstruction_set *set)
{
    uint32_t count = set->count;
    *h = (struct hierarchy){ .set = set };
    h->nodes = xalloc(2 * (size_t)count, sizeof *h->nodes);
    h->faces = xalloc(count, sizeof *h->faces);
    h->leaf_of = xalloc(count, sizeof *h->leaf_of);
    h->visited = xalloc(count, sizeof *h->visited);
    h->coplanar = xalloc_zero(count, sizeof *h->coplanar);
    for (uint32_t i = 0; i < count; i++) {
        h->faces[i] = i;
    }
    struct grower g = { h, 0 };
    struct hierarchy_node all = { .first = 0, .count = count };
    bound(h, &all);
    for (int k = 0; k < 3; k++) {
        g.weight = larger(g.weight, NORMAL_WEIGHT * (all.high[k] - all.low[k]));
    }
    grow(&g, 0, count, MESH_NONE);
    find_coplanar(h);
    hierarchy_reset(h);
}

void hierarchy_free(struct hierarchy *h)
{
    free(h->nodes);
    free(h->faces);
    free(h->leaf_of);
    free(h->visited);
    free(h->coplanar);
    *h = (struct hierarchy){ 0 };
}

void hierarchy_reset(struct hierarchy *h)
{
    memset(h->visited, 0, h->set->count * sizeof *h->visited);
    for (uint32_t i = 0; i < h->node_count; i++) {
        h->nodes[i].left = h->nodes[i].count;
    }
}

void hierarchy_visit(struct hierarchy *h, uint32_t face)
{
    h->visited[face] = true;
    for (uint32_t i = h->leaf_of[face]; i != MESH_NONE; i = h->nodes[i].parent) {
        h->nodes[i].left--;
    }
}

/* ---- searching ---- */

/* The greatest height of a corner in the node above a face's plane; the least with way -1. */
static double farthest_height(const struct hierarchy_node *node,
                              const struct obstruction_face *face, int way)
{
    double height = way * face->offset;
    for (int k = 0; k < 3; k++) {
        double n = way * face->normal[k];
        height += larger(n * node->high[k], n * node->low[k]); /* without a branch */
    }
    return height;
}

/* No less than the greatest height of a point above a plane of the node; likewise. */
static double farthest_above(const struct hierarchy_node *node, const double point[3], int way)
{
    double height = way > 0 ? node->height_high : -node->height_low;
    for (int k = 0; k < 3; k++) {
        double x = way * (point[k] - node->middle[k]);
        height += larger(x * node->normal_high[k], x * node->normal_low[k]);
    }
    return height;
}

bool hierarchy_may_hold(const struct hierarchy *h, const struct hierarchy_node *node,
                        const struct obstruction_face *face, enum hierarchy_way way)
{
    double least = h->set->step - OBSTRUCTION_DOUBT;
    int front = way == HIERARCHY_HIDING ? 1 : -1; /* where they lie, seen from the face */
    if (farthest_height(node, face, front) < least ||
        farthest_above(node, face->centre, -front) + face->radius < least) {
        return false;
    }
    const double(*points)[3] = (const double(*)[3])h->set->points + face->first;
    for (uint32_t i = 0; i < face->count; i++) {
        if (farthest_above(node, points[i], -front) >= least) {
            return true;
        }
    }
    return false;
}

static bool stands(const struct hierarchy *h, uint32_t face, uint32_t other, enum hierarchy_way way)
{
    const struct obstruction_face *f = &h->set->faces[face];
    const struct obstruction_face *o = &h->set->faces[other];
    return way == HIERARCHY_HIDING ? obstruction_holds(h->set, o, f)
                                   : obstruction_holds(h->set, f, o);
}

/* May the node hold a face that overlaps this one? */
static bool may_overlap(const struct hierarchy_node *node, const struct obstruction_face *face)
{
    for (int k = 0; k < 3; k++) {
        if (node->low[k] > face->centre[k] + face->radius ||
            node->high[k] < face->centre[k] - face->radius) {
            return false;
        }
    }
    return true;
}

/* Of two overlapping faces in one plane the one that is later in the file hides the other. */
static bool stands_coplanar(const struct hierarchy *h, uint32_t face, uint32_t other,
                            enum hierarchy_way way)
{
    const struct obstruction_face *f = &h->set->faces[face];
    const struct obstruction_face *o = &h->set->faces[other];
    return f->plane == o->plane && f->sign == o->sign &&
           (way == HIERARCHY_HIDING ? o->polygon > f->polygon : o->polygon < f->polygon) &&
           obstruction_overlap(h->set, f, o);
}

static uint32_t find_in_leaf(const struct hierarchy *h, const struct hierarchy_node *leaf,
                             uint32_t face, enum hierarchy_way way, bool among_coplanar)
{
    for (uint32_t i = leaf->first; i < leaf->first + leaf->count; i++) {
        uint32_t other = h->faces[i];
        if (!h->visited[other] &&
            (among_coplanar ? stands_coplanar(h, face, other, way) : stands(h, face, other, way))) {
            return other;
        }
    }
    return MESH_NONE;
}

static uint32_t find_below(struct hierarchy *h, uint32_t face, enum hierarchy_way way,
                           struct hierarchy_cursor *cursor)
{
    const struct obstruction_face *f = &h->set->faces[face];
    uint32_t i = cursor->node;
    while (i < h->node_count) {
        const struct hierarchy_node *node = &h->nodes[i];
        if (node->left == 0 || !(cursor->among_coplanar ? may_overlap(node, f)
                                                        : hierarchy_may_hold(h, node, f, way))) {
            i = node->next;
        } else if (!node->leaf) {
            i++;
        } else {
            uint32_t found = find_in_leaf(h, node, face, way, cursor->among_coplanar);
            if (found != MESH_NONE) {
                cursor->node = i;
                return found;
            }
            i++;
        }
    }
    cursor->node = i;
    return MESH_NONE;
}

uint32_t hierarchy_find(struct hierarchy *h, uint32_t face, enum hierarchy_way way,
                        struct hierarchy_cursor *cursor)
{
    uint32_t found = find_below(h, face, way, cursor);
    if (found == MESH_NONE && h->coplanar[face] && !cursor->among_coplanar) {
        *cursor = (struct hierarchy_cursor){ 0, true };
        found = find_below(h, face, way, cursor);
    }
    return found;
}
