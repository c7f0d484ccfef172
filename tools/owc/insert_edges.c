/* SPDX-License-Identifier: 0BSD */
/*
 * Edges that new polygons share with a tree. The tree's vertices stand in cells
 * of a grid; along an edge the cells that it passes are searched.
 */
#include "insert_edges.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "map64.h"
#include "ow_read.h"
#include "tools/common/xalloc.h"

#define CELL 256.0 /* lattice steps */

/* Rounding to the lattice moves a point by at most half a cube's diagonal, here squared. */
#define ROUNDING 0.7501

struct found {
    double share; /* of the way along the edge */
    uint32_t point;
};

struct edges {
    struct mesh *mesh;
    const struct ow_tree *tree;
    struct map64 cells;  /* to the first vertex in each */
    uint32_t *next;      /* the next vertex in the same cell */
    struct map64 points; /* lattice coordinates to the mesh's point numbers */
    bool *is_old;        /* points of the mesh that are the tree's too */
    size_t old_capacity;
    size_t point_capacity;
    struct found *found;
    size_t found_capacity;
    struct mesh out; /* the corners as they will be */
    size_t corner_capacity;
    size_t mark_capacity;
    size_t normal_capacity;
};

static void read_vertex(const struct edges *e, uint32_t vertex, int16_t at[3])
{
    for (uint32_t k = 0; k < 3; k++) {
        at[k] = (int16_t)ow_read_i16(e->tree->bytes,
                                     e->tree->vertices_at + vertex * OW_VERTEX_BYTES + 2 * k);
    }
}

static uint64_t point_key(const int16_t at[3])
{
    return (uint64_t)(uint16_t)at[0] << 32 | (uint64_t)(uint16_t)at[1] << 16 | (uint16_t)at[2];
}

static int cell_of(double at)
{
    return (int)floor((at + 32768) / CELL) + 1;
}

static uint64_t cell_key(const int cell[3])
{
    return (uint64_t)cell[0] << 32 | (uint64_t)cell[1] << 16 | (uint64_t)cell[2];
}

static void enter_vertices(struct edges *e)
{
    uint32_t count = e->tree->vertex_count;
    e->next = xalloc(count, sizeof *e->next);
    for (uint32_t i = 0; i < count; i++) {
        int16_t at[3];
        int cell[3];
        read_vertex(e, i, at);
        for (int k = 0; k < 3; k++) {
            cell[k] = cell_of(at[k]);
        }
        uint32_t head = map64_put(&e->cells, cell_key(cell), i);
        e->next[i] = MESH_NONE;
        if (head != i) { /* the map keeps the first one: the others hang behind it */
            e->next[i] = e->next[head];
            e->next[head] = i;
        }
    }
}

static void mark_old(struct edges *e, uint32_t point, bool old)
{
    e->is_old = xgrow(e->is_old, &e->old_capacity, (size_t)point + 1, sizeof *e->is_old);
    e->is_old[point] = old;
}

static void enter_points(struct edges *e)
{
    struct map64 old = { 0 };
    for (uint32_t i = 0; i < e->tree->vertex_count; i++) {
        int16_t at[3];
        read_vertex(e, i, at);
        map64_put(&old, point_key(at), 0);
    }
    for (uint32_t i = 0; i < e->mesh->point_count; i++) {
        uint64_t key = point_key(e->mesh->points[i]);
        map64_put(&e->points, key, i);
        mark_old(e, i, map64_get(&old, key) != MAP64_NONE);
    }
    map64_free(&old);
}

static uint32_t point_at(struct edges *e, const int16_t at[3])
{
    struct mesh *mesh = e->mesh;
    uint32_t point = map64_put(&e->points, point_key(at), mesh->point_count);
    if (point == mesh->point_count) {
        mesh->points =
            xgrow(mesh->points, &e->point_capacity, (size_t)point + 1, sizeof *mesh->points);
        memcpy(mesh->points[point], at, sizeof mesh->points[0]);
        mesh->point_count++;
        mark_old(e, point, true);
    }
    return point;
}

/* ---- one edge ---- */

/* True if a point is within rounding of the edge, between its ends. */
static bool is_beside(const double p[3], const double q[3], const int16_t at[3], double *share)
{
    double along = 0;
    double length = 0;
    double off = 0;
    for (int k = 0; k < 3; k++) {
        along += (at[k] - p[k]) * (q[k] - p[k]);
        length += (q[k] - p[k]) * (q[k] - p[k]);
    }
    *share = along / length;
    for (int k = 0; k < 3; k++) {
        double to = at[k] - p[k] - *share * (q[k] - p[k]);
        off += to * to;
    }
    return *share > 0 && *share < 1 && off <= ROUNDING;
}

static void search_cell(struct edges *e, const int cell[3], const double p[3], const double q[3],
                        uint32_t ends[2], size_t *count)
{
    for (uint32_t i = map64_get(&e->cells, cell_key(cell)); i != MESH_NONE; i = e->next[i]) {
        int16_t at[3];
        double share;
        read_vertex(e, i, at);
        if (!is_beside(p, q, at, &share)) {
            continue;
        }
        uint32_t point = point_at(e, at);
        if (point != ends[0] && point != ends[1]) {
            e->found = xgrow(e->found, &e->found_capacity, *count + 1, sizeof *e->found);
            e->found[(*count)++] = (struct found){ share, point };
        }
    }
}

static int compare_found(const void *left, const void *right)
{
    const struct found *a = left;
    const struct found *b = right;
    return a->share != b->share ? (a->share > b->share) - (a->share < b->share)
                                : (a->point > b->point) - (a->point < b->point);
}

/* The cells about a place on the edge, as far as the next place is. */
static void search_about(struct edges *e, const double at[3], const double p[3], const double q[3],
                         uint32_t ends[2], size_t *count)
{
    int low[3];
    int high[3];
    int cell[3];
    for (int k = 0; k < 3; k++) {
        low[k] = cell_of(at[k] - CELL / 4 - 2);
        high[k] = cell_of(at[k] + CELL / 4 + 2);
    }
    for (cell[0] = low[0]; cell[0] <= high[0]; cell[0]++) {
        for (cell[1] = low[1]; cell[1] <= high[1]; cell[1]++) {
            for (cell[2] = low[2]; cell[2] <= high[2]; cell[2]++) {
                search_cell(e, cell, p, q, ends, count);
            }
        }
    }
}

/* Finds the tree's vertices on an edge, in order; the direction does not matter to which. */
static size_t search_edge(struct edges *e, uint32_t from, uint32_t to)
{
    uint32_t ends[2] = { from, to };
    double p[3];
    double q[3];
    double longest = 0;
    size_t count = 0;
    for (int k = 0; k < 3; k++) {
        p[k] = e->mesh->points[from][k];
        q[k] = e->mesh->points[to][k];
        longest = fmax(longest, fabs(q[k] - p[k]));
    }
    int steps = (int)(longest / (CELL / 2)) + 1;
    for (int i = 0; i <= steps; i++) {
        double at[3];
        for (int k = 0; k < 3; k++) {
            at[k] = p[k] + (q[k] - p[k]) * i / steps;
        }
        search_about(e, at, p, q, ends, &count);
    }
    if (count > 1) {
        qsort(e->found, count, sizeof *e->found, compare_found);
    }
    size_t kept = 0;
    for (size_t i = 0; i < count; i++) { /* a vertex may be found from several places */
        if (kept == 0 || e->found[kept - 1].point != e->found[i].point) {
            e->found[kept++] = e->found[i];
        }
    }
    return kept;
}

/* ---- all of the mesh ---- */

static void put_corner(struct edges *e, uint32_t point, uint8_t mark, const float *normal)
{
    struct mesh *out = &e->out;
    size_t at = out->corner_count++;
    out->corners = xgrow(out->corners, &e->corner_capacity, at + 1, sizeof *out->corners);
    out->marks = xgrow(out->marks, &e->mark_capacity, at + 1, sizeof *out->marks);
    out->corners[at] = point;
    out->marks[at] = mark;
    if (normal != NULL) {
        out->normals = xgrow(out->normals, &e->normal_capacity, at + 1, sizeof *out->normals);
        memcpy(out->normals[at], normal, sizeof out->normals[0]);
    }
}

static void put_edge(struct edges *e, size_t from, size_t to)
{
    const struct mesh *mesh = e->mesh;
    uint32_t a = mesh->corners[from];
    uint32_t b = mesh->corners[to];
    const float *normal = mesh->normals != NULL ? mesh->normals[from] : NULL;
    put_corner(e, a, mesh->marks[from], normal);
    size_t count = e->is_old[a] && e->is_old[b] ? search_edge(e, a, b) : 0;
    for (size_t i = 0; i < count; i++) {
        float between[3] = { 0, 0, 0 };
        for (int k = 0; normal != NULL && k < 3; k++) {
            between[k] =
                (float)(normal[k] + e->found[i].share * ((double)mesh->normals[to][k] - normal[k]));
        }
        put_corner(e, e->found[i].point, mesh->marks[from], normal != NULL ? between : NULL);
    }
}

void insert_edges(struct mesh *mesh, const struct ow_tree *tree)
{
    struct edges e = { .mesh = mesh, .tree = tree };
    e.point_capacity = mesh->point_count;
    enter_vertices(&e);
    enter_points(&e);
    for (uint32_t i = 0; i < mesh->polygon_count; i++) {
        struct mesh_polygon *polygon = &mesh->polygons[i];
        size_t first = e.out.corner_count;
        for (uint32_t k = 0; k < polygon->count; k++) {
            put_edge(&e, polygon->first + k, polygon->first + (k + 1 < polygon->count ? k + 1 : 0));
        }
        polygon->first = first;
        polygon->count = (uint32_t)(e.out.corner_count - first);
    }
    free(mesh->corners);
    free(mesh->marks);
    free(mesh->normals);
    mesh->corners = e.out.corners;
    mesh->marks = e.out.marks;
    mesh->normals = e.out.normals;
    mesh->corner_count = e.out.corner_count;
    free(e.next);
    free(e.is_old);
    free(e.found);
    map64_free(&e.cells);
    map64_free(&e.points);
}
