/* SPDX-License-Identifier: 0BSD */
/*
 * From pieces to what is drawn. All vertices of a line have one order. An
 * outline that runs along a line from one of them to another gets those in
 * between, so along each line all outlines together run over the same steps,
 * and what met edge to edge before cutting does so after it.
 */
#include "repair.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "long_cut.h"
#include "map64.h"
#include "tools/common/xalloc.h"
#include "triangulate.h"

/* sin(0.25 degrees)^2: how far rounding may bend a face before it counts as uneven. */
#define BEND_LIMIT 1.9038e-5

/* ---- the order of vertices along lines ---- */

struct orders {
    const struct arrangement *arrangement;
    size_t *first; /* of each line's vertices, its ends excepted */
    uint32_t *vertices;
    uint32_t *rank;         /* of a vertex on the line that it was made on, from 1 */
    struct map64 crossings; /* ranks of crossings by line and vertex */
};

struct entry {
    int64_t share[2];
    uint32_t vertex;
};

static int compare_entries(const void *left, const void *right)
{
    const struct entry *a = left;
    const struct entry *b = right;
    wide x = (wide)a->share[0] * b->share[1];
    wide y = (wide)b->share[0] * a->share[1];
    return x != y ? (x > y) - (x < y) : (a->vertex > b->vertex) - (a->vertex < b->vertex);
}

static void count_vertices(struct orders *o)
{
    const struct arrangement *a = o->arrangement;
    o->first = xalloc_zero((size_t)a->line_count + 2, sizeof *o->first);
    size_t *first = o->first + 1;
    size_t all = 0;
    for (uint32_t v = a->point_count; v < a->vertex_count; v++, all++) {
        first[a->vertices[v].line + 1]++;
    }
    for (size_t i = 0; i < a->crossing_count; i++, all++) {
        first[a->crossings[i].line + 1]++;
    }
    for (uint32_t i = 0; i < a->line_count; i++) {
        first[i + 1] += first[i];
    }
    o->vertices = xalloc(all, sizeof *o->vertices);
    for (uint32_t v = a->point_count; v < a->vertex_count; v++) {
        o->vertices[first[a->vertices[v].line]++] = v;
    }
    for (size_t i = 0; i < a->crossing_count; i++) {
        o->vertices[first[a->crossings[i].line]++] = a->crossings[i].vertex;
    }
}

static void sort_line(struct orders *o, uint32_t line, struct entry *entries)
{
    const struct arrangement *a = o->arrangement;
    uint32_t *vertices = o->vertices + o->first[line];
    size_t count = o->first[line + 1] - o->first[line];
    for (size_t i = 0; i < count; i++) {
        entries[i].vertex = vertices[i];
        arrangement_share(a, line, vertices[i], entries[i].share);
    }
    qsort(entries, count, sizeof *entries, compare_entries);
    for (size_t i = 0; i < count; i++) {
        uint32_t v = entries[i].vertex;
        vertices[i] = v;
        if (a->vertices[v].line == line) {
            o->rank[v] = (uint32_t)i + 1;
        } else {
            map64_put(&o->crossings, map64_key(line, v), (uint32_t)i + 1);
        }
    }
}

static void sort_lines(struct orders *o, const struct arrangement *arrangement)
{
    struct entry *entries = NULL;
    size_t capacity = 0;
    *o = (struct orders){ .arrangement = arrangement };
    count_vertices(o);
    o->rank = xalloc_zero(arrangement->vertex_count, sizeof *o->rank);
    for (uint32_t line = 0; line < arrangement->line_count; line++) {
        size_t count = o->first[line + 1] - o->first[line];
        if (count > 0) {
            entries = xgrow(entries, &capacity, count, sizeof *entries);
            sort_line(o, line, entries);
        }
    }
    free(entries);
}

static uint32_t rank_on(const struct orders *o, uint32_t line, uint32_t vertex)
{
    const struct line *l = &o->arrangement->lines[line];
    if (vertex == l->ends[0]) {
        return 0;
    }
    if (vertex == l->ends[1]) {
        return (uint32_t)(o->first[line + 1] - o->first[line]) + 1;
    }
    if (o->arrangement->vertices[vertex].line == line) {
        return o->rank[vertex];
    }
    return map64_get(&o->crossings, map64_key(line, vertex));
}

static void orders_free(struct orders *o)
{
    free(o->first);
    free(o->vertices);
    free(o->rank);
    map64_free(&o->crossings);
}

/* ---- outlines ---- */

struct maker {
    struct repaired *out;
    const struct orders *orders;
    const struct pieces *pieces;
    const struct mesh *mesh;
    struct long_cuts cuts;
    uint32_t *stack;
    size_t stack_capacity;
};

static const int16_t *lattice_of(const struct maker *m, uint32_t vertex)
{
    return m->orders->arrangement->vertices[vertex].lattice;
}

static bool same_point(const int16_t a[3], const int16_t b[3])
{
    return a[0] == b[0] && a[1] == b[1] && a[2] == b[2];
}

/* Appends a corner to the outline that begins at first; joins it with an equal one before. */
static void put_corner(struct repaired *out, size_t first, const int16_t at[3], uint8_t mark,
                       const float *normal)
{
    if (out->corner_count > first && same_point(out->corners[out->corner_count - 1], at)) {
        out->marks[out->corner_count - 1] = mark;
        return;
    }
    size_t i = out->corner_count++;
    out->corners = xgrow(out->corners, &out->corner_capacity, i + 1, sizeof *out->corners);
    out->marks = xgrow(out->marks, &out->mark_capacity, i + 1, sizeof *out->marks);
    memcpy(out->corners[i], at, sizeof out->corners[i]);
    out->marks[i] = mark;
    if (normal != NULL) {
        out->normals = xgrow(out->normals, &out->normal_capacity, i + 1, sizeof *out->normals);
        memcpy(out->normals[i], normal, sizeof out->normals[i]);
    }
}

/* The normal at a vertex between two corners, by its distance from the first. */
static void normal_at(const struct maker *m, size_t from, size_t to, uint32_t vertex,
                      float normal[3])
{
    const double *p = m->orders->arrangement->at[m->pieces->vertices[from]];
    const double *q = m->orders->arrangement->at[m->pieces->vertices[to]];
    const double *v = m->orders->arrangement->at[vertex];
    double along = 0;
    double length = 0;
    for (int k = 0; k < 3; k++) {
        along += (v[k] - p[k]) * (q[k] - p[k]);
        length += (q[k] - p[k]) * (q[k] - p[k]);
    }
    double t = length > 0 ? fmax(0, fmin(1, along / length)) : 0;
    for (int k = 0; k < 3; k++) {
        double a = m->pieces->normals[from][k];
        double b = m->pieces->normals[to][k];
        normal[k] = (float)(a + t * (b - a));
    }
}

static void put_inserted(struct maker *m, size_t first, size_t from, size_t to, uint32_t vertex,
                         uint8_t mark)
{
    float normal[3];
    if (m->pieces->with_normals) {
        normal_at(m, from, to, vertex, normal);
    }
    put_corner(m->out, first, lattice_of(m, vertex), mark, m->pieces->with_normals ? normal : NULL);
    m->out->inserted++;
}

/* A corner and what lies on the edge from it to the next. */
static void put_edge(struct maker *m, size_t first, size_t from, size_t to)
{
    const struct orders *o = m->orders;
    uint32_t line = m->pieces->edges[from] >> 1;
    uint8_t mark = m->pieces->edges[from] & 1;
    put_corner(m->out, first, lattice_of(m, m->pieces->vertices[from]), mark,
               m->pieces->with_normals ? m->pieces->normals[from] : NULL);
    if (o->first[line + 1] == o->first[line]) {
        return;
    }
    const uint32_t *order = o->vertices + o->first[line];
    uint32_t a = rank_on(o, line, m->pieces->vertices[from]);
    uint32_t b = rank_on(o, line, m->pieces->vertices[to]);
    for (uint32_t r = a + 1; r < b; r++) {
        put_inserted(m, first, from, to, order[r - 1], mark);
    }
    for (uint32_t r = a; r > b + 1; r--) {
        put_inserted(m, first, from, to, order[r - 2], mark);
    }
}

static bool has_three_points(const struct repaired *out, size_t first)
{
    for (size_t i = first + 2; i < out->corner_count; i++) {
        if (!same_point(out->corners[i], out->corners[first]) &&
            !same_point(out->corners[i], out->corners[first + 1])) {
            return true;
        }
    }
    return false;
}

/* ---- normals ---- */

static void area_of(const int16_t (*corners)[3], uint32_t count, double area[3])
{
    int64_t sum[3] = { 0, 0, 0 };
    const int16_t *o = corners[0];
    for (uint32_t i = 1; i + 1 < count; i++) {
        int64_t a[3];
        int64_t b[3];
        for (int k = 0; k < 3; k++) {
            a[k] = corners[i][k] - o[k];
            b[k] = corners[i + 1][k] - o[k];
        }
        sum[0] += a[1] * b[2] - a[2] * b[1];
        sum[1] += a[2] * b[0] - a[0] * b[2];
        sum[2] += a[0] * b[1] - a[1] * b[0];
    }
    for (int k = 0; k < 3; k++) {
        area[k] = (double)sum[k];
    }
}

static double square_of(const double v[3])
{
    return v[0] * v[0] + v[1] * v[1] + v[2] * v[2];
}

/* Is a triangle of the fan from the first corner turned away from the whole outline's plane? */
static bool is_bent(const int16_t (*corners)[3], uint32_t count, const double area[3])
{
    double length = square_of(area);
    for (uint32_t i = 1; count > 3 && i + 1 < count; i++) {
        int16_t triangle[3][3];
        double own[3];
        memcpy(triangle[0], corners[0], sizeof triangle[0]);
        memcpy(triangle[1], corners[i], 2 * sizeof triangle[0]);
        area_of((const int16_t(*)[3])triangle, 3, own);
        double cross[3] = { own[1] * area[2] - own[2] * area[1],
                            own[2] * area[0] - own[0] * area[2],
                            own[0] * area[1] - own[1] * area[0] };
        if (square_of(cross) > BEND_LIMIT * square_of(own) * length) {
            return true;
        }
    }
    return false;
}

static void set_normal(struct maker *m, struct outline_final *outline, const struct piece *piece)
{
    const int16_t(*corners)[3] = (const int16_t(*)[3])m->out->corners + outline->first;
    const struct mesh_polygon *polygon = &m->mesh->polygons[piece->polygon];
    double area[3];
    area_of(corners, outline->count, area);
    double length = sqrt(square_of(area));
    outline->uneven = !(length > 0) || is_bent(corners, outline->count, area);
    if (!(length > 0)) { /* no area: the plane's */
        const struct plane *plane = &m->orders->arrangement->planes->all[piece->record];
        for (int k = 0; k < 3; k++) {
            area[k] = polygon->reversed ? -plane->normal[k] : plane->normal[k];
        }
        length = sqrt(square_of(area));
    }
    for (int k = 0; k < 3; k++) {
        outline->normal[k] = (int8_t)floor(area[k] / length * 127 + 0.5);
    }
    m->out->uneven += outline->uneven;
}

static void add_outline(struct maker *m, const struct piece *piece, size_t first, uint32_t count)
{
    struct repaired *out = m->out;
    out->outlines = xgrow(out->outlines, &out->outline_capacity, (size_t)out->outline_count + 1,
                          sizeof *out->outlines);
    struct outline_final *outline = &out->outlines[out->outline_count++];
    *outline = (struct outline_final){ .first = first, .count = count };
    set_normal(m, outline, piece);
}

/* ---- outlines with too many corners ---- */

/* Corners of a piece with all that lies between them, before rounding joins any. */
static uint32_t count_corners(const struct orders *o, const struct pieces *pieces,
                              const struct piece *piece)
{
    uint32_t count = 0;
    for (uint32_t i = 0; i < piece->count; i++) {
        size_t from = piece->first + i;
        size_t to = piece->first + (i + 1 < piece->count ? i + 1 : 0);
        uint32_t line = pieces->edges[from] >> 1;
        count++;
        if (o->first[line + 1] > o->first[line]) {
            uint32_t a = rank_on(o, line, pieces->vertices[from]);
            uint32_t b = rank_on(o, line, pieces->vertices[to]);
            count += (a < b ? b - a : a - b) - (a != b);
        }
    }
    return count;
}

/* Cuts all that is too long. The cuts may lengthen neighbours, so this goes in rounds. */
static uint32_t cut_long_pieces(struct maker *m, struct arrangement *arrangement,
                                struct planes *planes, struct pieces *pieces, const bool *drawn,
                                uint32_t drawn_count)
{
    uint32_t made = 0;
    uint32_t count = pieces->count;
    for (uint32_t i = 0; i < count; i++) {
        bool part = i >= drawn_count;
        if ((part || drawn[i]) && long_cut_part(&m->cuts, i, 0) == MESH_NONE &&
            count_corners(m->orders, pieces, &pieces->all[i]) > OW_MAX_CORNERS) {
            made += long_cut(&m->cuts, arrangement, planes, pieces, i);
        }
    }
    return made;
}

/* Copies a corner of the long outline to the end; joined: the edge to the next one is new. */
static void copy_corner(struct repaired *out, size_t from, bool joined)
{
    int16_t at[3];
    float normal[3];
    memcpy(at, out->corners[from], sizeof at);
    if (out->normals != NULL) {
        memcpy(normal, out->normals[from], sizeof normal);
    }
    put_corner(out, out->corner_count, at, joined ? 1 : out->marks[from],
               out->normals ? normal : NULL);
}

/* The last resort, for an outline that no plane shortens. */
static void cut_into_triangles(struct maker *m, const struct piece *piece, size_t first,
                               uint32_t count)
{
    struct repaired *out = m->out;
    double(*points)[3] = xalloc(count, sizeof *points);
    uint32_t(*triangles)[3] = xalloc(count, sizeof *triangles);
    for (uint32_t i = 0; i < count; i++) {
        for (int k = 0; k < 3; k++) {
            points[i][k] = out->corners[first + i][k];
        }
    }
    outline_triangulate((const double(*)[3])points, count, triangles);
    for (uint32_t i = 0; i + 2 < count; i++) {
        size_t begin = out->corner_count;
        for (int k = 0; k < 3; k++) {
            uint32_t corner = triangles[i][k];
            uint32_t next = triangles[i][(k + 1) % 3];
            copy_corner(out, first + corner, next != (corner + 1 < count ? corner + 1 : 0));
        }
        add_outline(m, piece, begin, 3);
    }
    free(points);
    free(triangles);
}

/* ---- all pieces ---- */

static void make_outline(struct maker *m, const struct piece *piece)
{
    struct repaired *out = m->out;
    size_t first = out->corner_count;
    uint32_t inserted = out->inserted;
    for (uint32_t i = 0; i < piece->count; i++) {
        put_edge(m, first, piece->first + i, piece->first + (i + 1 < piece->count ? i + 1 : 0));
    }
    while (out->corner_count > first + 1 &&
           same_point(out->corners[out->corner_count - 1], out->corners[first])) {
        out->corner_count--;
    }
    if (!has_three_points(out, first)) {
        out->corner_count = first;
        out->inserted = inserted;
        out->vanished++;
        return;
    }
    uint32_t count = (uint32_t)(out->corner_count - first);
    if (count > OW_MAX_CORNERS) {
        cut_into_triangles(m, piece, first, count);
    } else {
        add_outline(m, piece, first, count);
    }
}

/* The outlines of a piece, or of all parts that it was cut into. */
static void make_outlines(struct maker *m, uint32_t piece)
{
    size_t count = 0;
    m->stack = xgrow(m->stack, &m->stack_capacity, 1, sizeof *m->stack);
    m->stack[count++] = piece;
    while (count > 0) {
        uint32_t next = m->stack[--count];
        if (long_cut_part(&m->cuts, next, 0) == MESH_NONE) {
            make_outline(m, &m->pieces->all[next]);
            continue;
        }
        m->stack = xgrow(m->stack, &m->stack_capacity, count + 2, sizeof *m->stack);
        m->stack[count++] = long_cut_part(&m->cuts, next, 1);
        m->stack[count++] = long_cut_part(&m->cuts, next, 0);
        m->out->long_cut++;
    }
}

void repair_pieces(struct repaired *repaired, struct arrangement *arrangement,
                   struct planes *planes, struct pieces *pieces, const struct mesh *mesh,
                   const bool *drawn)
{
    struct orders orders;
    uint32_t count = pieces->count;
    struct maker maker = { .out = repaired, .orders = &orders, .pieces = pieces, .mesh = mesh };
    *repaired = (struct repaired){ 0 };
    sort_lines(&orders, arrangement);
    while (cut_long_pieces(&maker, arrangement, planes, pieces, drawn, count) > 0) {
        orders_free(&orders);
        sort_lines(&orders, arrangement);
    }
    repaired->first = xalloc((size_t)count + 1, sizeof *repaired->first);
    for (uint32_t i = 0; i < count; i++) {
        repaired->first[i] = repaired->outline_count;
        if (drawn[i]) {
            make_outlines(&maker, i);
        }
    }
    repaired->first[count] = repaired->outline_count;
    orders_free(&orders);
    long_cuts_free(&maker.cuts);
    free(maker.stack);
}

void repaired_free(struct repaired *repaired)
{
    free(repaired->outlines);
    free(repaired->first);
    free(repaired->corners);
    free(repaired->marks);
    free(repaired->normals);
    *repaired = (struct repaired){ 0 };
}
