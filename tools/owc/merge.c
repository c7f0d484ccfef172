/* SPDX-License-Identifier: 0BSD */
/*
 * Coplanar neighbours joined into convex polygons. Shared edges are taken one
 * after the other, longest first. Two convex outlines that share a chain of
 * edges make a convex one if the corners at the chain's ends stay convex.
 */
#include "merge.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "ow_blob.h"
#include "tools/common/xalloc.h"

enum { LEAST_BENT = 8 }; /* lattice steps: edges that rounding may be thought to have bent */

#define SAME_NORMAL 1e-4f

struct corner {
    uint32_t point;
    uint8_t mark; /* of the edge to the next corner */
    float normal[3];
};

/* A polygon as it grows; count 0: it has been joined to another. */
struct outline {
    struct corner *corners;
    uint32_t count;
};

struct merger {
    struct mesh *mesh;
    struct outline *outlines;
    uint32_t *owner; /* of each polygon: what it was joined to, or itself */
    uint32_t *uses;  /* corners of outlines at each point */
    struct corner *joined;
    size_t joined_capacity;
};

/* ---- shared edges ---- */

struct edge {
    uint32_t low;
    uint32_t high;
    uint32_t polygon;
    bool forwards; /* it runs from low to high */
};

struct shared {
    double length; /* squared */
    uint32_t polygons[2];
};

static int compare_edges(const void *left, const void *right)
{
    const struct edge *a = left;
    const struct edge *b = right;
    if (a->low != b->low) {
        return a->low > b->low ? 1 : -1;
    }
    if (a->high != b->high) {
        return a->high > b->high ? 1 : -1;
    }
    return (a->polygon > b->polygon) - (a->polygon < b->polygon);
}

static int compare_shared(const void *left, const void *right)
{
    const struct shared *a = left;
    const struct shared *b = right;
    if (a->length != b->length) {
        return a->length < b->length ? 1 : -1;
    }
    if (a->polygons[0] != b->polygons[0]) {
        return a->polygons[0] > b->polygons[0] ? 1 : -1;
    }
    return (a->polygons[1] > b->polygons[1]) - (a->polygons[1] < b->polygons[1]);
}

static struct edge *list_edges(const struct mesh *mesh, size_t *count)
{
    struct edge *edges = xalloc(mesh->corner_count, sizeof *edges);
    *count = 0;
    for (uint32_t i = 0; i < mesh->polygon_count; i++) {
        const struct mesh_polygon *polygon = &mesh->polygons[i];
        for (uint32_t k = 0; k < polygon->count; k++) {
            uint32_t a = mesh->corners[polygon->first + k];
            uint32_t b = mesh->corners[polygon->first + (k + 1 < polygon->count ? k + 1 : 0)];
            edges[(*count)++] = (struct edge){ a < b ? a : b, a < b ? b : a, i, a < b };
        }
    }
    qsort(edges, *count, sizeof *edges, compare_edges);
    return edges;
}

static bool may_join(const struct mesh *mesh, uint32_t a, uint32_t b)
{
    const struct mesh_polygon *p = &mesh->polygons[a];
    const struct mesh_polygon *q = &mesh->polygons[b];
    return a != b && p->record == q->record && p->reversed == q->reversed && p->colour == q->colour;
}

/* Edges that two polygons that may be joined have, and no other polygon. */
static struct shared *list_shared(const struct mesh *mesh, size_t *count)
{
    size_t edge_count;
    struct edge *edges = list_edges(mesh, &edge_count);
    struct shared *all = xalloc(edge_count / 2, sizeof *all);
    *count = 0;
    for (size_t i = 0; i < edge_count;) {
        size_t end = i + 1;
        while (end < edge_count && edges[end].low == edges[i].low &&
               edges[end].high == edges[i].high) {
            end++;
        }
        if (end == i + 2 && edges[i].forwards != edges[i + 1].forwards &&
            may_join(mesh, edges[i].polygon, edges[i + 1].polygon)) {
            double length = 0;
            for (int k = 0; k < 3; k++) {
                double way = mesh->points[edges[i].high][k] - mesh->points[edges[i].low][k];
                length += way * way;
            }
            all[(*count)++] = (struct shared){ length, { edges[i].polygon, edges[i + 1].polygon } };
        }
        i = end;
    }
    free(edges);
    qsort(all, *count, sizeof *all, compare_shared);
    return all;
}

/* ---- outlines ---- */

static void begin(struct merger *m)
{
    const struct mesh *mesh = m->mesh;
    m->outlines = xalloc(mesh->polygon_count, sizeof *m->outlines);
    m->owner = xalloc(mesh->polygon_count, sizeof *m->owner);
    m->uses = xalloc_zero(mesh->point_count, sizeof *m->uses);
    for (uint32_t i = 0; i < mesh->polygon_count; i++) {
        const struct mesh_polygon *polygon = &mesh->polygons[i];
        struct outline *outline = &m->outlines[i];
        *outline = (struct outline){ xalloc_zero(polygon->count, sizeof *outline->corners),
                                     polygon->count };
        for (uint32_t k = 0; k < polygon->count; k++) {
            struct corner *corner = &outline->corners[k];
            size_t at = polygon->first + k;
            corner->point = mesh->corners[at];
            corner->mark = mesh->marks[at];
            if (mesh->normals != NULL) {
                memcpy(corner->normal, mesh->normals[at], sizeof corner->normal);
            }
            m->uses[corner->point]++;
        }
        m->owner[i] = i;
    }
}

static uint32_t owner_of(struct merger *m, uint32_t polygon)
{
    while (m->owner[polygon] != polygon) {
        m->owner[polygon] = m->owner[m->owner[polygon]];
        polygon = m->owner[polygon];
    }
    return polygon;
}

static const struct corner *corner_at(const struct outline *outline, uint32_t place)
{
    return &outline->corners[place % outline->count];
}

/* The area vector of the triangle of three points, times 2. */
static void turn_at(const struct merger *m, uint32_t a, uint32_t b, uint32_t c, int64_t area[3])
{
    mesh_area((const int16_t(*)[3])m->mesh->points, (const uint32_t[]){ a, b, c }, 3, area);
}

static double distance_between(const struct merger *m, uint32_t a, uint32_t b)
{
    double sum = 0;
    for (int k = 0; k < 3; k++) {
        double way = m->mesh->points[a][k] - m->mesh->points[b][k];
        sum += way * way;
    }
    return sqrt(sum);
}

/* Does the outline a, b, c not turn right at b, but for what rounding may do? */
static bool is_convex_at(const struct merger *m, const double normal[3], uint32_t a, uint32_t b,
                         uint32_t c)
{
    int64_t area[3];
    turn_at(m, a, b, c, area);
    double along = 0;
    double square = 0;
    for (int k = 0; k < 3; k++) {
        along += (double)area[k] * normal[k];
        square += (double)area[k] * (double)area[k];
    }
    double before = distance_between(m, a, b);
    double after = distance_between(m, b, c);
    if (along < 0) { /* reflex: bent by at most a step? */
        return a != c && before >= LEAST_BENT && after >= LEAST_BENT &&
               sqrt(square) <= distance_between(m, a, c);
    }
    if (square > 0) {
        return true;
    }
    return distance_between(m, a, c) > before && distance_between(m, a, c) > after; /* straight */
}

static bool same_normals(const struct corner *a, const struct corner *b)
{
    for (int k = 0; k < 3; k++) {
        if (!(fabsf(a->normal[k] - b->normal[k]) <= SAME_NORMAL)) {
            return false;
        }
    }
    return true;
}

/* ---- joining ---- */

/* p runs along the chain from corner p_from over edges edges, q back from q_from. */
struct chain {
    uint32_t p_from;
    uint32_t q_from;
    uint32_t edges;
};

/* The one chain of edges that two outlines share. False: there is none, or more than one. */
static bool find_chain(const struct outline *p, const struct outline *q, struct chain *chain)
{
    uint32_t shared = 0;
    bool found = false;
    for (uint32_t i = 0; i < p->count; i++) {
        for (uint32_t k = 0; k < q->count; k++) {
            if (corner_at(p, i)->point != corner_at(q, k + 1)->point ||
                corner_at(p, i + 1)->point != corner_at(q, k)->point) {
                continue;
            }
            shared++;
            bool starts = corner_at(p, i + p->count - 1)->point != corner_at(q, k + 2)->point;
            if (starts) {
                *chain = (struct chain){ i, k + 1, 0 };
                found = true;
            }
        }
    }
    if (!found) {
        return false; /* none, or they are front and back of one outline */
    }
    while (corner_at(p, chain->p_from + chain->edges + 1)->point ==
               corner_at(q, chain->q_from + 2 * q->count - chain->edges - 1)->point &&
           chain->edges < p->count && chain->edges < q->count) {
        chain->edges++;
    }
    return chain->edges == shared && p->count + q->count > 2 * shared + 2;
}

/* Do only these two polygons have the points inside the chain, and agree on its ends? */
static bool chain_may_go(const struct merger *m, const struct outline *p, const struct outline *q,
                         const struct chain *chain)
{
    for (uint32_t i = 0; i <= chain->edges; i++) {
        const struct corner *a = corner_at(p, chain->p_from + i);
        const struct corner *b = corner_at(q, chain->q_from + q->count - i);
        bool inside = i > 0 && i < chain->edges;
        if ((inside && m->uses[a->point] != 2) || (!inside && !same_normals(a, b))) {
            return false;
        }
    }
    return true;
}

static void put_joined(struct merger *m, size_t *count, const struct corner *corner)
{
    m->joined = xgrow(m->joined, &m->joined_capacity, *count + 1, sizeof *m->joined);
    m->joined[(*count)++] = *corner;
}

static void plane_normal(const struct merger *m, const struct outline *outline, double normal[3])
{
    int64_t sum[3] = { 0, 0, 0 };
    for (uint32_t i = 1; i + 1 < outline->count; i++) {
        int64_t area[3];
        turn_at(m, outline->corners[0].point, outline->corners[i].point,
                outline->corners[i + 1].point, area);
        for (int k = 0; k < 3; k++) {
            sum[k] += area[k];
        }
    }
    for (int k = 0; k < 3; k++) {
        normal[k] = (double)sum[k];
    }
}

static bool outline_is_convex(const struct merger *m, const struct outline *outline)
{
    double normal[3];
    plane_normal(m, outline, normal);
    for (uint32_t i = 0; i < outline->count; i++) {
        if (!is_convex_at(m, normal, corner_at(outline, i)->point, corner_at(outline, i + 1)->point,
                          corner_at(outline, i + 2)->point)) {
            return false;
        }
    }
    return true;
}

/* Joins q to p if that can be. */
static bool join(struct merger *m, uint32_t first, uint32_t second)
{
    struct outline *p = &m->outlines[first];
    struct outline *q = &m->outlines[second];
    struct chain chain = { 0, 0, 0 };
    size_t count = 0;
    if (!find_chain(p, q, &chain) || !chain_may_go(m, p, q, &chain) ||
        p->count + q->count - 2 * chain.edges > OW_MAX_CORNERS) {
        return false;
    }
    /* p from the chain's end round to its begin, q from there round to the chain's end. */
    for (uint32_t i = chain.edges; i < p->count; i++) {
        put_joined(m, &count, corner_at(p, chain.p_from + i));
    }
    for (uint32_t i = 0; i < q->count - chain.edges; i++) {
        put_joined(m, &count, corner_at(q, chain.q_from + i));
    }
    struct outline joined = { m->joined, (uint32_t)count };
    if (!outline_is_convex(m, &joined)) {
        return false;
    }
    for (uint32_t i = 0; i <= chain.edges; i++) {
        bool inside = i > 0 && i < chain.edges;
        m->uses[corner_at(p, chain.p_from + i)->point] -= inside ? 2 : 1;
    }
    p->corners = xresize(p->corners, count, sizeof *p->corners);
    memcpy(p->corners, m->joined, count * sizeof *p->corners);
    p->count = (uint32_t)count;
    free(q->corners);
    *q = (struct outline){ NULL, 0 };
    m->owner[second] = first;
    return true;
}

/* ---- corners on straight edges ---- */

/* What lies beside a point in the outlines that have it. */
struct beside {
    uint32_t ends[2]; /* the lower and the higher neighbour */
    uint32_t straight;
};

static bool is_straight(const struct merger *m, uint32_t a, uint32_t b, uint32_t c)
{
    int64_t area[3];
    turn_at(m, a, b, c, area);
    double whole = distance_between(m, a, c);
    return area[0] == 0 && area[1] == 0 && area[2] == 0 && whole > distance_between(m, a, b) &&
           whole > distance_between(m, b, c);
}

/* Counts, for each point, the outlines that run straight through it between the same two points. */
static void look_beside(const struct merger *m, struct beside *beside)
{
    memset(beside, 0, m->mesh->point_count * sizeof *beside);
    for (uint32_t i = 0; i < m->mesh->polygon_count; i++) {
        const struct outline *outline = &m->outlines[i];
        double area[3] = { 0, 0, 0 };
        if (outline->count > 3) {
            plane_normal(m, outline, area);
        }
        bool flat = area[0] == 0 && area[1] == 0 && area[2] == 0;
        for (uint32_t k = 0; !flat && k < outline->count; k++) {
            uint32_t a = corner_at(outline, k)->point;
            uint32_t b = corner_at(outline, k + 1)->point;
            uint32_t c = corner_at(outline, k + 2)->point;
            uint32_t ends[2] = { a < c ? a : c, a < c ? c : a };
            struct beside *here = &beside[b];
            bool same = here->straight == 0 || memcmp(here->ends, ends, sizeof ends) == 0;
            if (same && is_straight(m, a, b, c)) {
                memcpy(here->ends, ends, sizeof ends);
                here->straight++;
            }
        }
    }
}

/*
 * Takes out what all outlines can do without. Neighbours on one edge would change
 * what lies beside one another, so only points without such a neighbour go in one round.
 */
static uint32_t drop_straight(struct merger *m, struct beside *beside, uint8_t *drop)
{
    uint32_t dropped = 0;
    look_beside(m, beside);
    memset(drop, 0, m->mesh->point_count);
    for (uint32_t p = 0; p < m->mesh->point_count; p++) {
        const struct beside *b = &beside[p];
        drop[p] =
            b->straight > 0 && b->straight == m->uses[p] && !drop[b->ends[0]] && !drop[b->ends[1]];
    }
    for (uint32_t i = 0; i < m->mesh->polygon_count; i++) {
        struct outline *outline = &m->outlines[i];
        uint32_t kept = 0;
        for (uint32_t k = 0; k < outline->count; k++) {
            dropped += drop[outline->corners[k].point];
            if (!drop[outline->corners[k].point]) {
                outline->corners[kept++] = outline->corners[k];
            }
        }
        outline->count = kept;
    }
    for (uint32_t p = 0; p < m->mesh->point_count; p++) {
        m->uses[p] = drop[p] ? 0 : m->uses[p];
    }
    return dropped;
}

/* ---- back into the mesh ---- */

static uint32_t finish(struct merger *m)
{
    struct mesh *mesh = m->mesh;
    uint32_t kept = 0;
    uint32_t gone = 0;
    size_t at = 0;
    for (uint32_t i = 0; i < mesh->polygon_count; i++) {
        const struct outline *outline = &m->outlines[i];
        gone += outline->count == 0;
        if (outline->count == 0) {
            continue;
        }
        mesh->polygons[kept] = mesh->polygons[i];
        mesh->polygons[kept].first = at;
        mesh->polygons[kept++].count = outline->count;
        for (uint32_t k = 0; k < outline->count; k++, at++) { /* never more than there were */
            mesh->corners[at] = outline->corners[k].point;
            mesh->marks[at] = outline->corners[k].mark;
            if (mesh->normals != NULL) {
                memcpy(mesh->normals[at], outline->corners[k].normal, sizeof mesh->normals[at]);
            }
        }
        free(outline->corners);
    }
    mesh->polygon_count = kept;
    mesh->corner_count = at;
    return gone;
}

uint32_t merge_coplanar(struct mesh *mesh)
{
    struct merger m = { .mesh = mesh };
    size_t count;
    struct shared *all = list_shared(mesh, &count);
    begin(&m);
    for (size_t i = 0; i < count; i++) {
        uint32_t a = owner_of(&m, all[i].polygons[0]);
        uint32_t b = owner_of(&m, all[i].polygons[1]);
        if (a != b) {
            join(&m, a < b ? a : b, a < b ? b : a);
        }
    }
    free(all);
    struct beside *beside = xalloc(mesh->point_count, sizeof *beside);
    uint8_t *drop = xalloc(mesh->point_count, 1);
    while (drop_straight(&m, beside, drop) > 0) {
    }
    uint32_t gone = finish(&m);
    free(beside);
    free(drop);
    free(m.outlines);
    free(m.owner);
    free(m.uses);
    free(m.joined);
    return gone;
}
