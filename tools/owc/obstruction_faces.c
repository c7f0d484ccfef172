/* SPDX-License-Identifier: 0BSD */
/* The obstruction relation between two faces. */
#include "obstruction_faces.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "ow_blob.h"
#include "tools/common/xalloc.h"

/* ---- the set ---- */

static void set_sphere(const struct obstruction_set *set, struct obstruction_face *face)
{
    const double(*points)[3] = (const double(*)[3])set->points + face->first;
    double low[3];
    double high[3];
    memcpy(low, points[0], sizeof low);
    memcpy(high, points[0], sizeof high);
    for (uint32_t i = 1; i < face->count; i++) {
        for (int k = 0; k < 3; k++) {
            low[k] = smaller(low[k], points[i][k]);
            high[k] = larger(high[k], points[i][k]);
        }
    }
    for (int k = 0; k < 3; k++) {
        face->centre[k] = (low[k] + high[k]) / 2;
    }
    double most = 0;
    for (uint32_t i = 0; i < face->count; i++) {
        double square = 0;
        for (int k = 0; k < 3; k++) {
            double way = points[i][k] - face->centre[k];
            square += way * way;
        }
        most = larger(most, square);
    }
    face->radius = sqrt(most) + OBSTRUCTION_DOUBT;
}

static void set_plane(const struct obstruction_set *set, struct obstruction_face *face)
{
    const struct plane *plane = &set->arrangement->planes->all[face->plane];
    double length = sqrt(plane->normal[0] * plane->normal[0] + plane->normal[1] * plane->normal[1] +
                         plane->normal[2] * plane->normal[2]);
    for (int k = 0; k < 3; k++) {
        face->normal[k] = face->sign * plane->normal[k] / length;
    }
    face->offset = face->sign * plane->offset / length;
    double tolerance = (double)plane->tolerance / length;
    double reach = (double)plane->reach / length;
    face->on = tolerance - OBSTRUCTION_DOUBT;
    face->sure = larger(tolerance, reach) + OBSTRUCTION_DOUBT;
}

static void set_face(struct obstruction_set *set, struct obstruction_face *face, tree_item item,
                     size_t first)
{
    const struct piece *piece = &set->pieces->all[tree_item_value(item)];
    bool reverse = tree_item_tag(item) == OW_ITEM_REVERSE;
    face->item = item;
    face->piece = tree_item_value(item);
    face->plane = piece->record;
    face->polygon = piece->polygon;
    face->sign = set->mesh->polygons[piece->polygon].reversed != reverse ? -1 : 1;
    face->rough = false;
    face->first = first;
    face->count = piece->count;
    for (uint32_t i = 0; i < piece->count; i++) {
        memcpy(set->points[first + i],
               set->arrangement->at[set->pieces->vertices[piece->first + i]],
               sizeof set->points[0]);
    }
    set_plane(set, face);
    set_sphere(set, face);
}

void obstruction_set_begin(struct obstruction_set *set, const struct mesh *mesh,
                           const struct arrangement *arrangement, const struct pieces *pieces,
                           double tolerance, const tree_item *items, uint32_t count)
{
    size_t points = 0;
    double step = arrangement->planes->tolerance_q8 / 256.0;
    *set = (struct obstruction_set){ .mesh = mesh,
                                     .arrangement = arrangement,
                                     .pieces = pieces,
                                     .count = count,
                                     .tolerance = tolerance,
                                     .step = step,
                                     .slack = larger(step, tolerance / 2) };
    for (uint32_t i = 0; i < count; i++) {
        points += pieces->all[tree_item_value(items[i])].count;
    }
    set->faces = xalloc(count, sizeof *set->faces);
    set->points = xalloc(points, sizeof *set->points);
    points = 0;
    for (uint32_t i = 0; i < count; i++) {
        set_face(set, &set->faces[i], items[i], points);
        points += set->faces[i].count;
    }
}

void obstruction_set_part(struct obstruction_set *part, const struct obstruction_set *set,
                          const uint32_t *faces, uint32_t count)
{
    size_t points = 0;
    *part = *set;
    part->relations = 0;
    part->count = count;
    for (uint32_t i = 0; i < count; i++) {
        points += set->faces[faces[i]].count;
    }
    part->faces = xalloc(count, sizeof *part->faces);
    part->points = xalloc(points, sizeof *part->points);
    points = 0;
    for (uint32_t i = 0; i < count; i++) {
        struct obstruction_face *face = &part->faces[i];
        *face = set->faces[faces[i]];
        memcpy(part->points + points, set->points + face->first,
               face->count * sizeof *part->points);
        face->first = points;
        points += face->count;
    }
}

void obstruction_set_free(struct obstruction_set *set)
{
    free(set->faces);
    free(set->points);
    *set = (struct obstruction_set){ 0 };
}

/* ---- overlap as seen along a normal ---- */

/* A flat outline that need not be stored anywhere else. */
struct outline {
    const double (*points)[3];
    uint32_t count;
};

static void range_along(const struct outline *outline, const double way[3], double range[2])
{
    range[0] = INFINITY;
    range[1] = -INFINITY;
    for (uint32_t i = 0; i < outline->count; i++) {
        const double *p = outline->points[i];
        double t = way[0] * p[0] + way[1] * p[1] + way[2] * p[2];
        range[0] = smaller(range[0], t);
        range[1] = larger(range[1], t);
    }
}

/* Are the two apart, or do they overlap by less than the limit, across an edge of edges? */
static bool edge_separates(const struct outline *edges, const struct outline *a,
                           const struct outline *b, const double normal[3], double limit)
{
    for (uint32_t i = 0; i < edges->count; i++) {
        const double *p = edges->points[i];
        const double *q = edges->points[i + 1 < edges->count ? i + 1 : 0];
        double e[3] = { q[0] - p[0], q[1] - p[1], q[2] - p[2] };
        double way[3] = { e[1] * normal[2] - e[2] * normal[1], e[2] * normal[0] - e[0] * normal[2],
                          e[0] * normal[1] - e[1] * normal[0] };
        double length = sqrt(way[0] * way[0] + way[1] * way[1] + way[2] * way[2]);
        double ra[2];
        double rb[2];
        range_along(a, way, ra);
        range_along(b, way, rb);
        if (smaller(ra[1], rb[1]) - larger(ra[0], rb[0]) < limit * length) {
            return true;
        }
    }
    return false;
}

/* Do two outlines overlap by the limit or more in all directions, as seen along the normal? */
static bool outlines_overlap(const struct outline *a, const struct outline *b,
                             const double normal[3], double limit)
{
    return !edge_separates(a, a, b, normal, limit) && !edge_separates(b, a, b, normal, limit);
}

static double distance_seen_along(const double normal[3], const double a[3], const double b[3])
{
    double way[3] = { a[0] - b[0], a[1] - b[1], a[2] - b[2] };
    double along = way[0] * normal[0] + way[1] * normal[1] + way[2] * normal[2];
    double square = way[0] * way[0] + way[1] * way[1] + way[2] * way[2] - along * along;
    return sqrt(larger(0, square));
}

/* The part of p at least as high as least above normal.x + offset = 0. At most 2 count corners. */
static uint32_t part_above(const struct obstruction_set *set, const struct obstruction_face *p,
                           const double normal[3], double offset, double (*out)[3])
{
    const double(*points)[3] = (const double(*)[3])set->points + p->first;
    uint32_t count = 0;
    for (uint32_t i = 0; i < p->count; i++) {
        const double *a = points[i];
        const double *b = points[i + 1 < p->count ? i + 1 : 0];
        double s = normal[0] * a[0] + normal[1] * a[1] + normal[2] * a[2] + offset;
        double t = normal[0] * b[0] + normal[1] * b[1] + normal[2] * b[2] + offset;
        if (s >= 0) {
            memcpy(out[count++], a, sizeof out[0]);
        }
        if ((s < 0) != (t < 0)) {
            for (int k = 0; k < 3; k++) {
                out[count][k] = a[k] + s / (s - t) * (b[k] - a[k]);
            }
            count++;
        }
    }
    return count;
}

enum { USUAL_CORNERS = 32 };

/* The part of p above p_offset and that of q above q_offset, as seen along the normal. */
bool obstruction_parts_overlap(const struct obstruction_set *set, const struct obstruction_face *p,
                               double p_offset, const struct obstruction_face *q, double q_offset,
                               const double normal[3])
{
    double few[2][USUAL_CORNERS][3];
    if (distance_seen_along(normal, p->centre, q->centre) > p->radius + q->radius) {
        return false;
    }
    uint32_t most = 2 * (p->count > q->count ? p->count : q->count);
    double(*points)[3] = most > USUAL_CORNERS ? xalloc(2 * (size_t)most, sizeof *points) : few[0];
    double(*more)[3] = most > USUAL_CORNERS ? points + most : few[1];
    struct outline a = { (const double(*)[3])points, part_above(set, p, normal, p_offset, points) };
    struct outline b = { (const double(*)[3])more, part_above(set, q, normal, q_offset, more) };
    bool overlap =
        a.count > 2 && b.count > 2 && outlines_overlap(&a, &b, normal, set->tolerance / 2);
    if (points != few[0]) {
        free(points);
    }
    return overlap;
}

bool obstruction_stacked(const struct obstruction_set *set, const struct obstruction_face *p,
                         const struct obstruction_face *q, int way)
{
    double normal[3] = { way * q->normal[0], way * q->normal[1], way * q->normal[2] };
    return obstruction_parts_overlap(set, p, way * q->offset, q, INFINITY, normal);
}

bool obstruction_overlap(const struct obstruction_set *set, const struct obstruction_face *p,
                         const struct obstruction_face *q)
{
    if (distance_seen_along(q->normal, p->centre, q->centre) > p->radius + q->radius) {
        return false;
    }
    struct outline a = { (const double(*)[3])set->points + p->first, p->count };
    struct outline b = { (const double(*)[3])set->points + q->first, q->count };
    return outlines_overlap(&a, &b, q->normal, 1); /* a lattice step */
}

/* ---- the relation ---- */

static bool beyond_exactly(const struct obstruction_set *set, const struct obstruction_face *p,
                           uint32_t corner, const struct obstruction_face *q, int way)
{
    if (p->rough) {
        return false;
    }
    const struct piece *piece = &set->pieces->all[p->piece];
    uint32_t vertex = set->pieces->vertices[piece->first + corner];
    return q->sign * arrangement_side(set->arrangement, q->plane, vertex) == way;
}

/* Has p a point strictly on this side (1 in front, -1 behind) of q's plane? */
static bool reaches(const struct obstruction_set *set, const struct obstruction_face *p,
                    const struct obstruction_face *q, int way)
{
    const double(*points)[3] = (const double(*)[3])set->points + p->first;
    bool tolerant = set->tolerance > set->step;
    double sure = tolerant ? larger(set->tolerance, q->sure) : q->sure;
    bool beyond = false;
    for (uint32_t i = 0; i < p->count; i++) {
        double height = way * obstruction_height(q, points[i]);
        if (height > sure) {
            return true;
        }
        beyond |= height > q->on && (height > q->sure || beyond_exactly(set, p, i, q, way));
    }
    return beyond && (!tolerant || obstruction_stacked(set, p, q, way));
}

bool obstruction_holds(struct obstruction_set *set, const struct obstruction_face *p,
                       const struct obstruction_face *q)
{
    set->relations++;
    return p->plane != q->plane && reaches(set, p, q, 1) && reaches(set, q, p, -1);
}
