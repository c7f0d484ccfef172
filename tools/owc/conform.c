/* SPDX-License-Identifier: 0BSD */
/*
 * Faces without area: middle corners for long edges.
 *
 * An edge may have a middle point, which makes two edges of it, which may have
 * middle points in turn. All polygons replace an edge by the same path, so
 * whatever is entered here, closed surfaces stay closed.
 */
#include "conform.h"

#include <stdlib.h>
#include <string.h>

#include "map64.h"
#include "tools/common/xalloc.h"

/* Work for one face; with more the face is kept (many slivers along one line). */
enum { MOST_STEPS = 512 };

struct paths {
    const struct mesh *mesh;
    struct map64 middles; /* of edges, lower point number first */
};

static uint64_t edge_key(uint32_t a, uint32_t b)
{
    return a < b ? map64_key(a, b) : map64_key(b, a);
}

/* The order of points along their common line. */
static bool comes_before(const struct mesh *mesh, uint32_t a, uint32_t b)
{
    const int16_t *p = mesh->points[a];
    const int16_t *q = mesh->points[b];
    return p[0] != q[0] ? p[0] < q[0] : p[1] != q[1] ? p[1] < q[1] : p[2] < q[2];
}

struct triple {
    uint32_t a, b, c; /* in this order along a line */
};

/* Sorts; false if two are the same point: then nothing needs to be done. */
static bool sort_triple(const struct mesh *mesh, struct triple *t)
{
    uint32_t swap;
    if (comes_before(mesh, t->b, t->a)) {
        swap = t->a, t->a = t->b, t->b = swap;
    }
    if (comes_before(mesh, t->c, t->b)) {
        swap = t->b, t->b = t->c, t->c = swap;
    }
    if (comes_before(mesh, t->b, t->a)) {
        swap = t->a, t->a = t->b, t->b = swap;
    }
    return t->a != t->b && t->b != t->c;
}

/*
 * Makes the path from a to c equal the path from a to b and on to c. False if
 * that takes too many steps; what was entered until then does no harm.
 */
static bool join_paths(struct paths *paths, struct triple first, uint32_t *steps)
{
    struct triple stack[64];
    uint32_t count = 0;
    stack[count++] = first;
    while (count > 0) {
        struct triple t = stack[--count];
        if (++*steps > MOST_STEPS || count + 2 > sizeof stack / sizeof stack[0]) {
            return false;
        }
        uint32_t m = map64_put(&paths->middles, edge_key(t.a, t.c), t.b);
        if (m == t.b) {
            continue;
        }
        if (comes_before(paths->mesh, t.b, m)) {
            stack[count++] = (struct triple){ t.a, t.b, m };
            stack[count++] = (struct triple){ t.b, m, t.c };
        } else {
            stack[count++] = (struct triple){ t.a, m, t.b };
            stack[count++] = (struct triple){ m, t.b, t.c };
        }
    }
    return true;
}

/* As a fan of triangles, whose inner edges cancel each other. */
static bool join_polygon(struct paths *paths, const struct mesh_polygon *polygon)
{
    const uint32_t *corners = paths->mesh->corners + polygon->first;
    uint32_t steps = 0;
    for (uint32_t i = 1; i + 1 < polygon->count; i++) {
        struct triple t = { corners[0], corners[i], corners[i + 1] };
        if (sort_triple(paths->mesh, &t) && !join_paths(paths, t, &steps)) {
            return false;
        }
    }
    return true;
}

/* True also where the outline only runs to and fro between its first corner and others. */
static bool is_line(const struct mesh *mesh, const struct mesh_polygon *polygon)
{
    const uint32_t *corners = mesh->corners + polygon->first;
    for (uint32_t i = 1; i + 1 < polygon->count; i++) {
        uint32_t triangle[3] = { corners[0], corners[i], corners[i + 1] };
        int64_t area[3];
        mesh_area((const int16_t(*)[3])mesh->points, triangle, 3, area);
        if (area[0] != 0 || area[1] != 0 || area[2] != 0) {
            return false;
        }
    }
    return true;
}

/* ---- writing the outlines anew ---- */

struct writer {
    struct mesh *mesh;
    uint32_t *corners;
    uint8_t *marks;
    float (*normals)[3];
    size_t count;
    size_t corner_capacity;
    size_t mark_capacity;
    size_t normal_capacity;
    uint32_t *stack;
    size_t stack_capacity;
};

static void put(struct writer *w, uint32_t point, uint8_t mark, const float *normal)
{
    w->corners = xgrow(w->corners, &w->corner_capacity, w->count + 1, sizeof *w->corners);
    w->marks = xgrow(w->marks, &w->mark_capacity, w->count + 1, sizeof *w->marks);
    w->corners[w->count] = point;
    w->marks[w->count] = mark;
    if (normal != NULL) {
        w->normals = xgrow(w->normals, &w->normal_capacity, w->count + 1, sizeof *w->normals);
        memcpy(w->normals[w->count], normal, sizeof w->normals[0]);
    }
    w->count++;
}

/* The points strictly between two corners; they get the first one's normal. */
static void put_path(struct writer *w, const struct paths *paths, uint32_t from, uint32_t to,
                     uint8_t mark, const float *normal)
{
    size_t depth = 0;
    w->stack = xgrow(w->stack, &w->stack_capacity, 1, sizeof *w->stack);
    w->stack[depth++] = to;
    while (depth > 0) {
        uint32_t end = w->stack[depth - 1];
        uint32_t middle = map64_get(&paths->middles, edge_key(from, end));
        if (middle != MAP64_NONE) {
            w->stack = xgrow(w->stack, &w->stack_capacity, depth + 1, sizeof *w->stack);
            w->stack[depth++] = middle;
        } else {
            from = end;
            depth--;
            if (depth > 0) {
                put(w, end, mark, normal);
            }
        }
    }
}

static void write_polygon(struct writer *w, const struct paths *paths, struct mesh_polygon *polygon)
{
    const struct mesh *mesh = w->mesh;
    size_t first = w->count;
    for (uint32_t i = 0; i < polygon->count; i++) {
        size_t at = polygon->first + i;
        size_t after = polygon->first + (i + 1 < polygon->count ? i + 1 : 0);
        const float *normal = mesh->normals ? mesh->normals[at] : NULL;
        put(w, mesh->corners[at], mesh->marks[at], normal);
        put_path(w, paths, mesh->corners[at], mesh->corners[after], mesh->marks[at], normal);
    }
    polygon->first = first;
    polygon->count = (uint32_t)(w->count - first);
}

static void rewrite(struct mesh *mesh, const struct paths *paths)
{
    struct writer w = { .mesh = mesh };
    for (uint32_t i = 0; i < mesh->polygon_count; i++) {
        write_polygon(&w, paths, &mesh->polygons[i]);
    }
    free(mesh->corners);
    free(mesh->marks);
    free(mesh->normals);
    free(w.stack);
    mesh->corners = w.corners;
    mesh->marks = w.marks;
    mesh->normals = w.normals;
    mesh->corner_count = w.count;
}

void conform_drop_lines(struct mesh *mesh)
{
    struct paths paths = { .mesh = mesh };
    for (uint32_t i = 0; i < mesh->polygon_count; i++) {
        struct mesh_polygon *polygon = &mesh->polygons[i];
        if (!is_line(mesh, polygon)) {
            continue;
        }
        if (join_polygon(&paths, polygon)) {
            polygon->count = 0;
            mesh->degenerate_dropped++;
        } else {
            mesh->degenerate_kept++;
        }
    }
    if (paths.middles.count > 0) {
        rewrite(mesh, &paths);
    }
    map64_free(&paths.middles);
}
