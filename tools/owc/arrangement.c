/* SPDX-License-Identifier: 0BSD */
/* The arrangement: vertices and lines, made by cutting and kept exact. */
#include "arrangement.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "tools/common/fail.h"
#include "tools/common/xalloc.h"

enum { CHORD_SHARE_BITS = 40 };

#define MOST_OFF_EDGE 1.0 /* lattice steps between a cut edge and a vertex on it */

/* ---- beginning ---- */

static uint32_t add_vertex(struct arrangement *a, struct vertex vertex, const double at[3])
{
    if (a->vertex_count == MESH_NONE - 1) {
        fail(FAIL_INPUT, NULL, 0, "cutting made more than %u vertices", MESH_NONE - 1);
    }
    size_t needed = (size_t)a->vertex_count + 1;
    a->vertices = xgrow(a->vertices, &a->vertex_capacity, needed, sizeof *a->vertices);
    a->at = xgrow(a->at, &a->at_capacity, needed, sizeof *a->at);
    a->vertices[a->vertex_count] = vertex;
    memcpy(a->at[a->vertex_count], at, sizeof a->at[0]);
    return a->vertex_count++;
}

static int compare_records(const void *left, const void *right)
{
    uint32_t a = *(const uint32_t *)left;
    uint32_t b = *(const uint32_t *)right;
    return (a > b) - (a < b);
}

static void list_records(struct arrangement *a, const struct mesh *mesh)
{
    struct mesh_around around;
    mesh_around_find(&around, mesh);
    a->record_first = around.first;
    a->records = xalloc(around.first[mesh->point_count], sizeof *a->records);
    for (size_t i = 0; i < around.first[mesh->point_count]; i++) {
        a->records[i] = mesh->polygons[around.all[i].polygon].record;
    }
    for (uint32_t i = 0; i < mesh->point_count; i++) {
        qsort(a->records + a->record_first[i], a->record_first[i + 1] - a->record_first[i],
              sizeof *a->records, compare_records);
    }
    free(around.all);
}

void arrangement_begin(struct arrangement *a, const struct mesh *mesh, const struct planes *planes)
{
    *a = (struct arrangement){ .planes = planes, .point_count = mesh->point_count };
    for (uint32_t i = 0; i < mesh->point_count; i++) {
        const int16_t *p = mesh->points[i];
        struct vertex vertex = { LINE_NONE, MESH_NONE, { p[0], p[1], p[2] }, VERTEX_POINT };
        add_vertex(a, vertex, (const double[3]){ p[0], p[1], p[2] });
    }
    list_records(a, mesh);
}

void arrangement_free(struct arrangement *a)
{
    free(a->vertices);
    free(a->at);
    free(a->lines);
    free(a->crossings);
    map64_free(&a->segments);
    map64_free(&a->cuts);
    free(a->record_first);
    free(a->records);
    *a = (struct arrangement){ 0 };
}

/* ---- lines ---- */

static uint32_t add_line(struct arrangement *a, struct line line)
{
    if (a->line_count == LINE_NONE >> 1) { /* pieces keep a mark beside the number */
        fail(FAIL_INPUT, NULL, 0, "cutting made more than %u lines", LINE_NONE >> 1);
    }
    a->lines = xgrow(a->lines, &a->line_capacity, (size_t)a->line_count + 1, sizeof *a->lines);
    a->lines[a->line_count] = line;
    return a->line_count++;
}

uint32_t arrangement_segment(struct arrangement *a, uint32_t from, uint32_t to)
{
    uint32_t low = from < to ? from : to;
    uint32_t high = from < to ? to : from;
    uint32_t line = map64_put(&a->segments, map64_key(low, high), a->line_count);
    if (line == a->line_count) {
        add_line(a, (struct line){ { low, high }, MESH_NONE, MESH_NONE });
    }
    return line;
}

static double distance_squared(const struct arrangement *a, uint32_t u, uint32_t v)
{
    double sum = 0;
    for (int k = 0; k < 3; k++) {
        sum += (a->at[u][k] - a->at[v][k]) * (a->at[u][k] - a->at[v][k]);
    }
    return sum;
}

/* The vertex farthest from u; of equals the first. */
static uint32_t farthest(const struct arrangement *a, uint32_t u, const uint32_t *vertices,
                         uint32_t count)
{
    uint32_t best = u;
    for (uint32_t i = 0; i < count; i++) {
        if (distance_squared(a, u, vertices[i]) > distance_squared(a, u, best)) {
            best = vertices[i];
        }
    }
    if (best == u) { /* all in one place: any other will do */
        for (uint32_t i = 0; i < count && best == u; i++) {
            best = vertices[i];
        }
    }
    return best;
}

uint32_t arrangement_chord(struct arrangement *a, uint32_t carrier, uint32_t cutter,
                           const uint32_t *vertices, uint32_t count)
{
    uint32_t u = vertices[0];
    uint32_t v = vertices[1];
    if (count == 2 && u < a->point_count && v < a->point_count && u != v) {
        return arrangement_segment(a, u, v);
    }
    if (count > 2) {
        u = farthest(a, vertices[0], vertices, count);
        v = farthest(a, u, vertices, count);
    }
    uint32_t line = add_line(a, (struct line){ { u, v }, carrier, cutter });
    for (uint32_t i = 0; i < count; i++) {
        if (vertices[i] != u && vertices[i] != v) {
            a->crossings = xgrow(a->crossings, &a->crossing_capacity, a->crossing_count + 1,
                                 sizeof *a->crossings);
            a->crossings[a->crossing_count++] = (struct crossing){ line, vertices[i] };
        }
    }
    return line;
}

/* ---- vertices on lines ---- */

/* |n.v + d| at a segment's ends: weights of the other end. False if they are not separated. */
static bool segment_weights(const struct arrangement *a, const struct line *line,
                            const struct plane *plane, int64_t weights[2])
{
    int64_t s = exact_side(plane, a->vertices[line->ends[0]].lattice);
    int64_t t = exact_side(plane, a->vertices[line->ends[1]].lattice);
    bool separated = (s < 0 && t > 0) || (s > 0 && t < 0);
    weights[0] = llabs(t);
    weights[1] = llabs(s);
    return separated;
}

static bool place_on_segment(const struct arrangement *a, const struct line *line,
                             const struct plane *plane, struct vertex *vertex, double at[3])
{
    int64_t weights[2];
    if (!segment_weights(a, line, plane, weights)) {
        return false;
    }
    const int16_t *p = a->vertices[line->ends[0]].lattice;
    const int16_t *q = a->vertices[line->ends[1]].lattice;
    int64_t sum = weights[0] + weights[1];
    for (int k = 0; k < 3; k++) {
        wide value = (wide)p[k] * weights[0] + (wide)q[k] * weights[1];
        vertex->lattice[k] = (int16_t)wide_round_quotient(value, sum);
        at[k] = (double)value / (double)sum;
    }
    vertex->kind = VERTEX_EDGE;
    return true;
}

/* How far a point lies from the segment between two vertices, squared. */
static double off_segment_squared(const struct arrangement *a, uint32_t u, uint32_t v,
                                  const double at[3])
{
    double along = 0;
    double off = 0;
    double length = distance_squared(a, u, v);
    for (int k = 0; k < 3; k++) {
        along += (at[k] - a->at[u][k]) * (a->at[v][k] - a->at[u][k]);
    }
    double t = length > 0 ? fmax(0, fmin(1, along / length)) : 0;
    for (int k = 0; k < 3; k++) {
        double way = at[k] - a->at[u][k] - t * (a->at[v][k] - a->at[u][k]);
        off += way * way;
    }
    return off;
}

/*
 * False if the planes do not meet in a point, or not near the cut edge from u
 * to v. (An end may be on the cutter only within the tolerance: where cutter and
 * carrier are nearly parallel, their line is then far beside the edge.)
 */
static bool place_on_chord(const struct arrangement *a, const struct line *line,
                           const struct plane *plane, uint32_t u, uint32_t v, struct vertex *vertex,
                           double at[3])
{
    struct meeting meeting;
    const struct plane *planes = a->planes->all;
    if (!exact_meet(&planes[line->carrier], &planes[line->cutter], plane, &meeting)) {
        return false;
    }
    for (int k = 0; k < 3; k++) {
        wide rounded = wide_round_quotient(meeting.x[k], meeting.w);
        if (rounded < -OW_LATTICE_MAX || rounded > OW_LATTICE_MAX) {
            return false;
        }
        vertex->lattice[k] = (int16_t)rounded;
        at[k] = (double)meeting.x[k] / (double)meeting.w;
    }
    vertex->kind = VERTEX_MEETING;
    return off_segment_squared(a, u, v, at) <= MOST_OFF_EDGE * MOST_OFF_EDGE;
}

/* By the heights of u and v, rounded, between the two. */
static void place_between(const struct arrangement *a, const struct plane *plane, uint32_t u,
                          uint32_t v, struct vertex *vertex, double at[3])
{
    double s = fabs(arrangement_height(a, plane, u));
    double t = fabs(arrangement_height(a, plane, v));
    double share = s + t > 0 ? s / (s + t) : 0.5;
    for (int k = 0; k < 3; k++) {
        double p = a->vertices[u].lattice[k];
        double q = a->vertices[v].lattice[k];
        double value = floor(p + share * (q - p) + 0.5);
        at[k] = fmax(fmin(value, fmax(p, q)), fmin(p, q));
        vertex->lattice[k] = (int16_t)at[k];
    }
    vertex->kind = VERTEX_ROUNDED;
}

uint32_t arrangement_cut(struct arrangement *a, uint32_t line_number, uint32_t plane_number,
                         uint32_t u, uint32_t v)
{
    uint32_t found = map64_put(&a->cuts, map64_key(line_number, plane_number), a->vertex_count);
    if (found != a->vertex_count) {
        return found;
    }
    const struct line *line = &a->lines[line_number];
    const struct plane *plane = &a->planes->all[plane_number];
    struct vertex vertex = { .line = line_number, .plane = plane_number };
    double at[3];
    bool placed = line->carrier == MESH_NONE ? place_on_segment(a, line, plane, &vertex, at)
                                             : place_on_chord(a, line, plane, u, v, &vertex, at);
    if (!placed) {
        place_between(a, plane, u, v, &vertex, at);
        a->rounded++;
    }
    return add_vertex(a, vertex, at);
}

void arrangement_share(const struct arrangement *a, uint32_t line_number, uint32_t number,
                       int64_t share[2])
{
    const struct line *line = &a->lines[line_number];
    const struct vertex *vertex = &a->vertices[number];
    int64_t weights[2];
    if (vertex->kind == VERTEX_EDGE && vertex->line == line_number &&
        segment_weights(a, line, &a->planes->all[vertex->plane], weights)) {
        share[0] = weights[1];
        share[1] = weights[0] + weights[1];
        return;
    }
    const double *p = a->at[line->ends[0]];
    const double *q = a->at[line->ends[1]];
    double along = 0;
    double length = 0;
    for (int k = 0; k < 3; k++) {
        along += (a->at[number][k] - p[k]) * (q[k] - p[k]);
        length += (q[k] - p[k]) * (q[k] - p[k]);
    }
    double t = length > 0 ? fmax(0, fmin(1, along / length)) : 0;
    share[1] = (int64_t)1 << CHORD_SHARE_BITS;
    share[0] = (int64_t)(t * (double)share[1]);
}

/* ---- sides ---- */

/* Is this point of the mesh a corner of a polygon with this plane? */
static bool is_own_corner(const struct arrangement *a, uint32_t plane, uint32_t point)
{
    const uint32_t *records = a->records + a->record_first[point];
    size_t count = a->record_first[point + 1] - a->record_first[point];
    return bsearch(&plane, records, count, sizeof *records, compare_records) != NULL;
}

static int side_of_lattice_point(const struct arrangement *a, uint32_t plane_number,
                                 uint32_t number)
{
    const struct plane *plane = &a->planes->all[plane_number];
    int64_t height = exact_side(plane, a->vertices[number].lattice);
    int64_t size = llabs(height);
    if (size <= plane->tolerance || (size <= plane->reach && number < a->point_count &&
                                     is_own_corner(a, plane_number, number))) {
        return 0;
    }
    return height > 0 ? 1 : -1;
}

static int side_on_segment(const struct arrangement *a, uint32_t plane_number,
                           const struct vertex *vertex)
{
    const struct plane *plane = &a->planes->all[plane_number];
    const struct line *line = &a->lines[vertex->line];
    int64_t weights[2];
    segment_weights(a, line, &a->planes->all[vertex->plane], weights);
    wide value = (wide)exact_side(plane, a->vertices[line->ends[0]].lattice) * weights[0] +
                 (wide)exact_side(plane, a->vertices[line->ends[1]].lattice) * weights[1];
    wide weight = (wide)weights[0] + weights[1];
    int sign = exact_sign(plane, value, weight);
    if (sign != 0 && is_own_corner(a, plane_number, line->ends[0]) &&
        is_own_corner(a, plane_number, line->ends[1])) {
        return 0;
    }
    return sign;
}

static int side_of_meeting(const struct arrangement *a, uint32_t plane_number,
                           const struct vertex *vertex)
{
    const struct plane *planes = a->planes->all;
    const struct line *line = &a->lines[vertex->line];
    struct meeting meeting;
    exact_meet(&planes[line->carrier], &planes[line->cutter], &planes[vertex->plane], &meeting);
    const struct plane *plane = &planes[plane_number];
    return exact_sign(plane, exact_side_meeting(plane, &meeting), meeting.w);
}

int arrangement_side_exactly(const struct arrangement *a, uint32_t plane, uint32_t number)
{
    const struct vertex *vertex = &a->vertices[number];
    if (vertex->kind == VERTEX_POINT) {
        return side_of_lattice_point(a, plane, number);
    }
    const struct line *line = &a->lines[vertex->line];
    if (vertex->plane == plane || line->carrier == plane || line->cutter == plane) {
        return 0;
    }
    switch (vertex->kind) {
    case VERTEX_EDGE:
        return side_on_segment(a, plane, vertex);
    case VERTEX_MEETING:
        return side_of_meeting(a, plane, vertex);
    default:
        return side_of_lattice_point(a, plane, number);
    }
}
