/* SPDX-License-Identifier: 0BSD */
/* From the file's polygons to the lattice's. */
#include "clean.h"

#include <stdlib.h>
#include <string.h>

#include "closed.h"
#include "conform.h"
#include "map64.h"
#include "tools/common/xalloc.h"
#include "triangulate.h"

struct cleaner {
    const struct model *model;
    struct mesh *mesh;
    uint32_t *point_of;  /* lattice point of each vertex of the model, or MESH_NONE */
    struct map64 points; /* lattice coordinates to point numbers */
    bool keep_normals;
    size_t point_capacity;
    size_t polygon_capacity;
    size_t corner_capacity;
    size_t mark_capacity;
    size_t normal_capacity;
    size_t source_capacity;
    double (*outline)[3]; /* scratch, for one polygon */
    size_t outline_capacity;
    uint32_t (*triangles)[3];
    size_t triangle_capacity;
};

static uint32_t snap_vertex(struct cleaner *c, uint32_t vertex)
{
    if (c->point_of[vertex] != MESH_NONE) {
        return c->point_of[vertex];
    }
    int16_t at[3];
    lattice_snap(&c->mesh->lattice, c->model->vertices[vertex], at);
    uint64_t key =
        (uint64_t)(uint16_t)at[0] << 32 | (uint64_t)(uint16_t)at[1] << 16 | (uint16_t)at[2];
    uint32_t point = map64_put(&c->points, key, c->mesh->point_count);
    if (point == c->mesh->point_count) {
        c->mesh->points =
            xgrow(c->mesh->points, &c->point_capacity, point + 1u, sizeof *c->mesh->points);
        memcpy(c->mesh->points[point], at, sizeof at);
        c->mesh->point_count++;
    }
    c->point_of[vertex] = point;
    return point;
}

static void put_corner(struct cleaner *c, uint32_t point, uint8_t mark, const float *normal)
{
    struct mesh *mesh = c->mesh;
    size_t at = mesh->corner_count++;
    mesh->corners = xgrow(mesh->corners, &c->corner_capacity, at + 1, sizeof *mesh->corners);
    mesh->marks = xgrow(mesh->marks, &c->mark_capacity, at + 1, sizeof *mesh->marks);
    mesh->corners[at] = point;
    mesh->marks[at] = mark;
    if (c->keep_normals) {
        mesh->normals = xgrow(mesh->normals, &c->normal_capacity, at + 1, sizeof *mesh->normals);
        memcpy(mesh->normals[at], normal, sizeof mesh->normals[at]);
    }
}

/* The snapped corners without equal neighbours; returns their number. */
static uint32_t put_corners(struct cleaner *c, const uint32_t *vertices, const uint8_t *marks,
                            uint32_t count)
{
    struct mesh *mesh = c->mesh;
    size_t first = mesh->corner_count;
    for (uint32_t i = 0; i < count; i++) {
        uint32_t point = snap_vertex(c, vertices[i]);
        uint8_t mark = marks ? marks[i] : 0;
        if (mesh->corner_count > first && mesh->corners[mesh->corner_count - 1] == point) {
            mesh->marks[mesh->corner_count - 1] = mark;
        } else {
            put_corner(c, point, mark, c->model->normals[vertices[i]]);
        }
    }
    while (mesh->corner_count > first + 1 &&
           mesh->corners[mesh->corner_count - 1] == mesh->corners[first]) {
        mesh->corner_count--;
    }
    return (uint32_t)(mesh->corner_count - first);
}

static bool has_three_points(const uint32_t *corners, uint32_t count)
{
    for (uint32_t i = 2; i < count; i++) {
        if (corners[i] != corners[0] && corners[i] != corners[1]) {
            return true;
        }
    }
    return false;
}

static bool has_area(const struct mesh *mesh, size_t first, uint32_t count)
{
    int64_t area[3];
    mesh_area((const int16_t(*)[3])mesh->points, mesh->corners + first, count, area);
    return area[0] != 0 || area[1] != 0 || area[2] != 0;
}

/* What of the source a polygon is made of. */
struct outline {
    const uint32_t *vertices;
    const uint8_t *marks;
    uint32_t count;
    uint32_t source;
    uint16_t colour;
};

static void put_polygon(struct cleaner *c, const struct outline *outline, size_t first,
                        uint32_t count)
{
    struct mesh *mesh = c->mesh;
    size_t at = mesh->source_corner_count;
    mesh->sources =
        xgrow(mesh->sources, &c->source_capacity, at + outline->count, sizeof *mesh->sources);
    memcpy(mesh->sources + at, outline->vertices, outline->count * sizeof *mesh->sources);
    mesh->source_corner_count += outline->count;
    mesh->polygons = xgrow(mesh->polygons, &c->polygon_capacity, mesh->polygon_count + 1u,
                           sizeof *mesh->polygons);
    mesh->polygons[mesh->polygon_count++] = (struct mesh_polygon){
        .first = first,
        .count = count,
        .source = outline->source,
        .source_first = at,
        .source_count = outline->count,
        .record = MESH_NONE,
        .colour = outline->colour,
    };
}

/* False: no area, but corners that are not all in one line; the polygon was not added. */
static bool add_outline(struct cleaner *c, const struct outline *outline)
{
    size_t first = c->mesh->corner_count;
    uint32_t count = put_corners(c, outline->vertices, outline->marks, outline->count);
    if (!has_three_points(c->mesh->corners + first, count)) {
        c->mesh->corner_count = first;
        c->mesh->degenerate_dropped++;
        return true;
    }
    if (count > 3 && !has_area(c->mesh, first, count)) {
        c->mesh->corner_count = first;
        return false;
    }
    put_polygon(c, outline, first, count);
    return true;
}

/* Triangles for triangle_count + 2 corners; sides that are not the outline's are marked. */
static void add_triangles(struct cleaner *c, const struct outline *outline)
{
    for (uint32_t i = 0; i + 2 < outline->count; i++) {
        uint32_t vertices[3];
        uint8_t marks[3];
        for (int k = 0; k < 3; k++) {
            uint32_t corner = c->triangles[i][k];
            uint32_t next = c->triangles[i][(k + 1) % 3];
            vertices[k] = outline->vertices[corner];
            marks[k] = next != (corner + 1 < outline->count ? corner + 1 : 0);
        }
        struct outline triangle = { vertices, marks, 3, outline->source, outline->colour };
        add_outline(c, &triangle);
    }
}

static void add_polygon(struct cleaner *c, size_t number)
{
    const struct model_polygon *polygon = &c->model->polygons[number];
    struct outline outline = { c->model->corners + polygon->first, NULL, polygon->count,
                               (uint32_t)number + 1, polygon->colour };
    c->outline = xgrow(c->outline, &c->outline_capacity, polygon->count, sizeof *c->outline);
    for (uint32_t i = 0; i < polygon->count; i++) {
        lattice_scale(&c->mesh->lattice, c->model->vertices[outline.vertices[i]], c->outline[i]);
    }
    const double(*points)[3] = (const double(*)[3])c->outline;
    bool flat = outline_is_flat(points, polygon->count, 1);
    if (flat && add_outline(c, &outline)) {
        return;
    }
    c->triangles = xgrow(c->triangles, &c->triangle_capacity, polygon->count, sizeof *c->triangles);
    outline_triangulate(points, polygon->count, c->triangles);
    add_triangles(c, &outline);
    c->mesh->uneven_cut++;
}

/* ---- repeated polygons ---- */

/* Where the least of all rotations of a cycle begins. */
static uint32_t least_rotation(const uint32_t *cycle, uint32_t count)
{
    uint32_t i = 0;
    uint32_t j = 1;
    uint32_t same = 0;
    while (i < count && j < count && same < count) {
        uint32_t a = cycle[(i + same) % count];
        uint32_t b = cycle[(j + same) % count];
        if (a == b) {
            same++;
            continue;
        }
        if (a > b) {
            i += same + 1;
        } else {
            j += same + 1;
        }
        j += i == j;
        same = 0;
    }
    return i < j ? i : j;
}

struct cycle {
    uint64_t hash;
    uint32_t polygon;
    uint32_t start;
};

static int compare_cycles(const void *left, const void *right)
{
    const struct cycle *a = left;
    const struct cycle *b = right;
    return a->hash != b->hash ? (a->hash < b->hash ? -1 : 1)
                              : (a->polygon > b->polygon) - (a->polygon < b->polygon);
}

static bool same_cycle(const struct mesh *mesh, const struct cycle *a, const struct cycle *b)
{
    const struct mesh_polygon *p = &mesh->polygons[a->polygon];
    const struct mesh_polygon *q = &mesh->polygons[b->polygon];
    if (p->count != q->count) {
        return false;
    }
    for (uint32_t i = 0; i < p->count; i++) {
        if (mesh->corners[p->first + (a->start + i) % p->count] !=
            mesh->corners[q->first + (b->start + i) % q->count]) {
            return false;
        }
    }
    return true;
}

/* Of polygons with the same corners in the same order the last one stays: it would win. */
static void drop_repeated(struct mesh *mesh)
{
    struct cycle *cycles = xalloc(mesh->polygon_count, sizeof *cycles);
    uint32_t count = 0;
    for (uint32_t i = 0; i < mesh->polygon_count; i++) {
        const struct mesh_polygon *polygon = &mesh->polygons[i];
        if (polygon->count == 0) {
            continue;
        }
        const uint32_t *corners = mesh->corners + polygon->first;
        uint32_t start = least_rotation(corners, polygon->count);
        uint64_t hash = polygon->count;
        for (uint32_t k = 0; k < polygon->count; k++) {
            hash = map64_hash(hash + corners[(start + k) % polygon->count]);
        }
        cycles[count++] = (struct cycle){ hash, i, start };
    }
    qsort(cycles, count, sizeof *cycles, compare_cycles);
    for (uint32_t i = 0; i + 1 < count; i++) {
        if (cycles[i].hash == cycles[i + 1].hash && same_cycle(mesh, &cycles[i], &cycles[i + 1])) {
            mesh->polygons[cycles[i].polygon].count = 0;
            mesh->repeated_dropped++;
        }
    }
    free(cycles);
}

/* Returns how many of those that stay have an area. */
static uint32_t remove_dropped(struct mesh *mesh)
{
    uint32_t kept = 0;
    uint32_t with_area = 0;
    for (uint32_t i = 0; i < mesh->polygon_count; i++) {
        const struct mesh_polygon *polygon = &mesh->polygons[i];
        if (polygon->count > 0) {
            with_area += has_area(mesh, polygon->first, polygon->count);
            mesh->polygons[kept++] = *polygon;
        }
    }
    mesh->polygon_count = kept;
    return with_area;
}

static void read_polygons(struct cleaner *c)
{
    c->point_of = xalloc(c->model->vertex_count, sizeof *c->point_of);
    memset(c->point_of, 0xFF, c->model->vertex_count * sizeof *c->point_of);
    for (size_t i = 0; i < c->model->polygon_count; i++) {
        add_polygon(c, i);
    }
    map64_free(&c->points);
    free(c->point_of);
    free(c->outline);
    free(c->triangles);
}

bool clean_model(struct mesh *mesh, const struct model *model, bool keep_normals,
                 struct problem *problem)
{
    struct lattice lattice;
    memset(mesh, 0, sizeof *mesh);
    if (!lattice_of_model(&lattice, model)) {
        return problem_set(problem, 0, "all corners lie in one point");
    }
    return clean_model_on(mesh, model, &lattice, keep_normals, problem);
}

bool clean_model_on(struct mesh *mesh, const struct model *model, const struct lattice *lattice,
                    bool keep_normals, struct problem *problem)
{
    *mesh = (struct mesh){ .lattice = *lattice };
    if (model->polygon_count >= MESH_NONE / 4) {
        return problem_set(problem, 0, "has %zu polygons, too many", model->polygon_count);
    }
    struct cleaner cleaner = { .model = model, .mesh = mesh, .keep_normals = keep_normals };
    read_polygons(&cleaner);
    conform_drop_lines(mesh);
    drop_repeated(mesh);
    if (remove_dropped(mesh) == 0) {
        return problem_set(problem, 0, "all %zu polygons are degenerate: no area is left",
                           model->polygon_count);
    }
    mesh->closed = closed_mesh(mesh);
    return true;
}
