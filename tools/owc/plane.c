/* SPDX-License-Identifier: 0BSD */
/*
 * Plane records. The largest polygon that has none founds one; all polygons
 * whose corners, not yet snapped, lie within a lattice step of its plane join:
 * those that hang together with it are found along shared corners, the others
 * by a hash of their own plane.
 */
#include "plane.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "map64.h"
#include "tools/common/xalloc.h"
#include "triangulate.h"

enum {
    NORMAL_LIMIT = (1 << NORMAL_BITS) - 1,
    NORMAL_CELLS = 1024, /* of a unit normal's component, in the hash */
    MOST_AT_POINT = 64,  /* corners with more polygons (the tips of cones) are not followed */
    MOST_MISSES = 64     /* polygons of a cell that do not join, before it is left */
};

#define DISTANCE_CELL 2.0 /* lattice steps, in the hash */
#define JOIN_LIMIT 1.0    /* lattice steps from the founder's plane */
#define JOIN_COSINE 0.7   /* and facing like it, or against it */

/* A polygon's own plane before snapping: unit normal n, points with n.v = distance. */
struct own_plane {
    double normal[3];
    double distance;
    double area;
};

struct grouper {
    struct planes *planes;
    struct mesh *mesh;
    const struct model *model;
    struct own_plane *own;
    uint32_t *order; /* polygons, largest first */
    struct mesh_around around;
    struct map64 cells; /* hash of a plane to the first polygon with it */
    uint32_t *cell_next;
    uint32_t *tried;   /* the founder that last tried this polygon */
    uint32_t *members; /* of the record being made */
    uint32_t member_count;
};

static double dot(const double a[3], const double b[3])
{
    return a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
}

/* Corner k as it was before snapping, in lattice steps. */
static void source_corner(const struct grouper *g, const struct mesh_polygon *polygon, uint32_t k,
                          double out[3])
{
    uint32_t vertex = g->mesh->sources[polygon->source_first + k];
    lattice_scale(&g->mesh->lattice, g->model->vertices[vertex], out);
}

/* ---- the planes as they were read ---- */

static void set_own_plane(struct own_plane *own, double area[3], const double middle[3])
{
    double length = sqrt(dot(area, area));
    for (int k = 0; k < 3; k++) {
        own->normal[k] = area[k] / length;
    }
    own->area = length;
    own->distance = dot(own->normal, middle);
}

static void find_own_plane(struct grouper *g, uint32_t number, double (*corners)[3])
{
    const struct mesh_polygon *polygon = &g->mesh->polygons[number];
    double middle[3] = { 0, 0, 0 };
    double area[3];
    for (uint32_t k = 0; k < polygon->source_count; k++) {
        source_corner(g, polygon, k, corners[k]);
        for (int i = 0; i < 3; i++) {
            middle[i] += corners[k][i] / polygon->source_count;
        }
    }
    outline_area((const double(*)[3])corners, polygon->source_count, area);
    if (!(dot(area, area) > 0)) { /* a needle that only got its area by snapping */
        int64_t snapped[3];
        mesh_area((const int16_t(*)[3])g->mesh->points, g->mesh->corners + polygon->first,
                  polygon->count, snapped);
        for (int i = 0; i < 3; i++) {
            area[i] = (double)snapped[i];
        }
    }
    if (!(dot(area, area) > 0)) { /* kept although it has no area: any plane will do */
        area[2] = 1e-9;
    }
    set_own_plane(&g->own[number], area, middle);
}

static void find_own_planes(struct grouper *g)
{
    double(*corners)[3] = NULL;
    size_t capacity = 0;
    g->own = xalloc(g->mesh->polygon_count, sizeof *g->own);
    for (uint32_t i = 0; i < g->mesh->polygon_count; i++) {
        corners = xgrow(corners, &capacity, g->mesh->polygons[i].source_count, sizeof *corners);
        find_own_plane(g, i, corners);
    }
    free(corners);
}

struct by_area {
    double area;
    uint32_t polygon;
};

static int compare_areas(const void *left, const void *right)
{
    const struct by_area *a = left;
    const struct by_area *b = right;
    return a->area != b->area ? (a->area > b->area ? -1 : 1)
                              : (a->polygon > b->polygon) - (a->polygon < b->polygon);
}

static void sort_by_area(struct grouper *g)
{
    uint32_t count = g->mesh->polygon_count;
    struct by_area *sorted = xalloc(count, sizeof *sorted);
    for (uint32_t i = 0; i < count; i++) {
        sorted[i] = (struct by_area){ g->own[i].area, i };
    }
    qsort(sorted, count, sizeof *sorted, compare_areas);
    g->order = xalloc(count, sizeof *g->order);
    for (uint32_t i = 0; i < count; i++) {
        g->order[i] = sorted[i].polygon;
    }
    free(sorted);
}

/* ---- neighbours: by corners, and by cells of planes ---- */

/* The cell of a plane; corner's bits 0 to 3 choose the lower or upper cell near it. */
static uint64_t cell_key(const double normal[3], double distance, double sign, unsigned corner)
{
    uint64_t key = 0;
    for (int k = 0; k < 4; k++) {
        double value = sign * (k < 3 ? normal[k] * NORMAL_CELLS : distance / DISTANCE_CELL);
        int64_t cell = (int64_t)floor(value - 0.5 + (corner >> k & 1));
        key = map64_hash(key + (uint64_t)(cell + (1 << 20)));
    }
    return key;
}

/* Each polygon enters the cell in which its own plane lies. */
static void enter_cells(struct grouper *g)
{
    g->cell_next = xalloc(g->mesh->polygon_count, sizeof *g->cell_next);
    for (uint32_t i = g->mesh->polygon_count; i > 0; i--) {
        uint32_t polygon = g->order[i - 1];
        const struct own_plane *own = &g->own[polygon];
        double shifted[3];
        for (int k = 0; k < 3; k++) { /* floor(value), by the same formula */
            shifted[k] = own->normal[k] + 0.5 / NORMAL_CELLS;
        }
        uint64_t key = cell_key(shifted, own->distance + 0.5 * DISTANCE_CELL, 1, 0);
        /* The map keeps the first value: lists hang behind it. */
        uint32_t head = map64_put(&g->cells, key, polygon);
        g->cell_next[polygon] = MESH_NONE;
        if (head != polygon) {
            g->cell_next[polygon] = g->cell_next[head];
            g->cell_next[head] = polygon;
        }
    }
}

/* ---- making a record ---- */

static bool fits(const struct grouper *g, const struct own_plane *founder, uint32_t number)
{
    const struct mesh_polygon *polygon = &g->mesh->polygons[number];
    if (fabs(dot(g->own[number].normal, founder->normal)) < JOIN_COSINE) {
        return false;
    }
    for (uint32_t k = 0; k < polygon->source_count; k++) {
        double at[3];
        source_corner(g, polygon, k, at);
        if (!(fabs(dot(founder->normal, at) - founder->distance) <= JOIN_LIMIT)) {
            return false;
        }
    }
    return true;
}

/* Lets a polygon join if it fits. Returns false if it was looked at and does not. */
static bool try_polygon(struct grouper *g, uint32_t founder, uint32_t number)
{
    struct mesh_polygon *polygon = &g->mesh->polygons[number];
    if (polygon->record != MESH_NONE || g->tried[number] == founder) {
        return true;
    }
    g->tried[number] = founder;
    if (!fits(g, &g->own[founder], number)) {
        return false;
    }
    polygon->record = g->planes->count;
    polygon->reversed = dot(g->own[number].normal, g->own[founder].normal) < 0;
    g->members[g->member_count++] = number;
    return true;
}

static void follow_corners(struct grouper *g, uint32_t founder, uint32_t number)
{
    const struct mesh_polygon *polygon = &g->mesh->polygons[number];
    for (uint32_t k = 0; k < polygon->count; k++) {
        uint32_t point = g->mesh->corners[polygon->first + k];
        size_t end = g->around.first[point + 1];
        if (end - g->around.first[point] > MOST_AT_POINT) {
            continue;
        }
        for (size_t i = g->around.first[point]; i < end; i++) {
            try_polygon(g, founder, g->around.all[i].polygon);
        }
    }
}

static void search_cell(struct grouper *g, uint32_t founder, uint64_t key)
{
    uint32_t misses = 0;
    uint32_t before = MESH_NONE;
    uint32_t polygon = map64_get(&g->cells, key);
    while (polygon != MESH_NONE && misses < MOST_MISSES) {
        uint32_t next = g->cell_next[polygon];
        misses += !try_polygon(g, founder, polygon);
        if (g->mesh->polygons[polygon].record != MESH_NONE && before != MESH_NONE) {
            g->cell_next[before] = next; /* it has a record: nobody needs to see it again */
        } else {
            before = polygon;
        }
        polygon = next;
    }
}

static void gather(struct grouper *g, uint32_t founder)
{
    g->member_count = 0;
    try_polygon(g, founder, founder);
    if (g->member_count == 0) { /* bent by more than a step: cannot be, but must not be lost */
        g->mesh->polygons[founder].record = g->planes->count;
        g->members[g->member_count++] = founder;
    }
    const struct own_plane *own = &g->own[founder];
    for (unsigned corner = 0; corner < 16; corner++) {
        search_cell(g, founder, cell_key(own->normal, own->distance, 1, corner));
        search_cell(g, founder, cell_key(own->normal, own->distance, -1, corner));
    }
    for (uint32_t i = 0; i < g->member_count; i++) {
        follow_corners(g, founder, g->members[i]);
    }
}

/* ---- integer planes ---- */

static int64_t gcd(int64_t a, int64_t b)
{
    a = a < 0 ? -a : a;
    b = b < 0 ? -b : b;
    while (b != 0) {
        int64_t rest = a % b;
        a = b;
        b = rest;
    }
    return a;
}

bool plane_of_triangle(const int16_t a[3], const int16_t b[3], const int16_t c[3], int32_t n[3],
                       int64_t *d)
{
    int16_t points[3][3];
    memcpy(points[0], a, sizeof points[0]);
    memcpy(points[1], b, sizeof points[1]);
    memcpy(points[2], c, sizeof points[2]);
    int64_t area[3];
    mesh_area((const int16_t(*)[3])points, (const uint32_t[]){ 0, 1, 2 }, 3, area);
    int64_t common = gcd(area[0], gcd(area[1], area[2]));
    int64_t greatest = 0;
    for (int k = 0; k < 3 && common > 0; k++) {
        area[k] /= common;
        greatest = llabs(area[k]) > greatest ? llabs(area[k]) : greatest;
    }
    if (greatest == 0 || greatest > NORMAL_LIMIT) {
        return false;
    }
    int64_t scale = NORMAL_LIMIT / greatest; /* a long normal makes the tolerance finer */
    *d = 0;
    for (int k = 0; k < 3; k++) {
        n[k] = (int32_t)(area[k] * scale);
        *d -= n[k] * (int64_t)a[k];
    }
    return true;
}

static void round_normal(const double normal[3], int32_t n[3])
{
    double greatest = fmax(fabs(normal[0]), fmax(fabs(normal[1]), fabs(normal[2])));
    for (int k = 0; k < 3; k++) {
        n[k] = (int32_t)floor(normal[k] / greatest * NORMAL_LIMIT + 0.5);
    }
}

/* The least and the greatest n.v of the members' snapped corners. */
static void range_of_members(const struct grouper *g, const int32_t n[3], int64_t range[2])
{
    range[0] = INT64_MAX;
    range[1] = INT64_MIN;
    for (uint32_t i = 0; i < g->member_count; i++) {
        const struct mesh_polygon *polygon = &g->mesh->polygons[g->members[i]];
        for (uint32_t k = 0; k < polygon->count; k++) {
            const int16_t *p = g->mesh->points[g->mesh->corners[polygon->first + k]];
            int64_t value = (int64_t)n[0] * p[0] + (int64_t)n[1] * p[1] + (int64_t)n[2] * p[2];
            range[0] = value < range[0] ? value : range[0];
            range[1] = value > range[1] ? value : range[1];
        }
    }
}

static void add_record(struct grouper *g, uint32_t founder)
{
    const struct mesh_polygon *polygon = &g->mesh->polygons[founder];
    const uint32_t *corners = g->mesh->corners + polygon->first;
    int16_t(*points)[3] = g->mesh->points;
    int32_t n[3];
    int64_t d;
    int64_t range[2];
    if (g->member_count == 1 && polygon->count == 3 &&
        plane_of_triangle(points[corners[0]], points[corners[1]], points[corners[2]], n, &d)) {
        plane_add(g->planes, n, d, 0);
        return;
    }
    round_normal(g->own[founder].normal, n);
    range_of_members(g, n, range);
    d = -(range[0] + range[1]) / 2;
    int64_t low = llabs(range[0] + d);
    int64_t high = llabs(range[1] + d);
    plane_add(g->planes, n, d, low > high ? low : high);
    g->planes->shared += g->member_count > 1;
}

void plane_set(struct plane *plane, const int32_t n[3], int64_t d, int64_t reach,
               uint32_t tolerance_q8)
{
    *plane = (struct plane){ .d = d, .reach = reach, .offset = (double)d };
    for (int k = 0; k < 3; k++) {
        plane->n[k] = n[k];
        plane->normal[k] = n[k];
    }
    plane->tolerance = exact_tolerance(n, tolerance_q8);
    plane->sure = (double)(plane->tolerance > reach ? plane->tolerance : reach) + 1;
}

uint32_t plane_add(struct planes *planes, const int32_t n[3], int64_t d, int64_t reach)
{
    struct plane plane;
    plane_set(&plane, n, d, reach, planes->tolerance_q8);
    planes->all =
        xgrow(planes->all, &planes->capacity, (size_t)planes->count + 1, sizeof *planes->all);
    planes->all[planes->count] = plane;
    return planes->count++;
}

void plane_group(struct planes *planes, struct mesh *mesh, const struct model *model,
                 uint32_t tolerance_q8)
{
    struct grouper g = { .planes = planes, .mesh = mesh, .model = model };
    uint32_t count = mesh->polygon_count;
    *planes = (struct planes){ .tolerance_q8 = tolerance_q8 };
    find_own_planes(&g);
    sort_by_area(&g);
    mesh_around_find(&g.around, mesh);
    enter_cells(&g);
    g.members = xalloc(count, sizeof *g.members);
    g.tried = xalloc(count, sizeof *g.tried);
    memset(g.tried, 0xFF, count * sizeof *g.tried);
    for (uint32_t i = 0; i < count; i++) {
        if (mesh->polygons[g.order[i]].record == MESH_NONE) {
            gather(&g, g.order[i]);
            add_record(&g, g.order[i]);
        }
    }
    map64_free(&g.cells);
    free(g.own);
    free(g.order);
    mesh_around_free(&g.around);
    free(g.cell_next);
    free(g.tried);
    free(g.members);
}

void planes_free(struct planes *planes)
{
    free(planes->all);
    *planes = (struct planes){ 0 };
}
