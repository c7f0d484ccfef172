/* SPDX-License-Identifier: 0BSD */
/*
 * Choosing the plane of a switch. Candidates are polygons' own planes, planes
 * through an edge and a vertex, and planes swept through the gaps along some
 * directions. They are judged in floating point, on a sample where there are
 * many faces; the best few then by all faces. What the chosen plane really
 * does is decided exactly.
 */
#include "obstruction_plane.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "obstruction_whole.h"
#include "split.h"
#include "tools/common/xalloc.h"

/* ---- where a face lies ---- */

/* The least and the greatest height of a face's corners above n.x + offset = 0. */
static void heights_of(const struct obstruction_set *set, const struct obstruction_face *face,
                       const double normal[3], double offset, double range[2])
{
    const double(*points)[3] = (const double(*)[3])set->points + face->first;
    range[0] = INFINITY;
    range[1] = -INFINITY;
    for (uint32_t i = 0; i < face->count; i++) {
        double height =
            normal[0] * points[i][0] + normal[1] * points[i][1] + normal[2] * points[i][2] + offset;
        range[0] = height < range[0] ? height : range[0];
        range[1] = height > range[1] ? height : range[1];
    }
}

enum obstruction_place obstruction_place_of(const struct obstruction_set *set,
                                            const struct obstruction_face *face, uint32_t plane)
{
    return (enum obstruction_place)split_side_of(set->arrangement, set->pieces, face->piece, plane);
}

/* ---- candidates ---- */

struct candidate {
    double normal[3]; /* unit */
    double offset;
    int32_t n[3];
    int64_t d;
    uint32_t record;          /* MESH_NONE: a new plane */
    double score;             /* the less, the better */
    const double *through[3]; /* points that it goes through, or NULL */
};

struct chooser {
    struct obstruction_set *set;
    struct planes *planes;
    const uint32_t *faces;
    uint32_t count;
    const uint32_t *sample;
    uint32_t sample_count;
    const struct obstruction_effort *effort;
    struct random *random;
    struct candidate *best; /* finalists, the best first */
    uint32_t best_count;
};

static double entropy(double f, double b)
{
    if (!(f > 0) || !(b > 0)) {
        return 0;
    }
    double p = f / (f + b);
    return -(p * log2(p) + (1 - p) * log2(1 - p));
}

/* Where a candidate puts a face. */
static enum obstruction_place candidate_place(const struct chooser *c,
                                              const struct candidate *candidate, uint32_t number)
{
    const struct obstruction_face *face = &c->set->faces[number];
    double height = candidate->normal[0] * face->centre[0] +
                    candidate->normal[1] * face->centre[1] +
                    candidate->normal[2] * face->centre[2] + candidate->offset;
    if (face->plane == candidate->record) {
        return OBSTRUCTION_ON;
    }
    double step = c->set->step;
    double slack = c->set->slack;
    if (fabs(height) > face->radius + step) {
        return height > 0 ? OBSTRUCTION_FRONT : OBSTRUCTION_BACK;
    }
    double range[2];
    heights_of(c->set, face, candidate->normal, candidate->offset, range);
    if (range[1] > slack && range[0] < -slack) {
        return OBSTRUCTION_ACROSS;
    }
    if (range[1] <= step && range[0] >= -step) {
        return OBSTRUCTION_ON;
    }
    return range[1] > -range[0] ? OBSTRUCTION_FRONT : OBSTRUCTION_BACK;
}

/* What it is worth that so many faces have each place. */
static double score_of(const struct chooser *c, const double counts[4])
{
    double cuts = counts[OBSTRUCTION_ACROSS];
    double on = counts[OBSTRUCTION_ON];
    double front = counts[OBSTRUCTION_FRONT];
    double back = counts[OBSTRUCTION_BACK];
    if (back + on == 0 || front + on == 0) {
        return INFINITY;
    }
    double all = cuts + on + front + back;
    return cuts - c->effort->balance * (all * entropy(front + cuts, back + cuts) + on);
}

/* Judges a candidate by these faces. Infinite: it takes us no further, or is worse than limit. */
static double judge(const struct chooser *c, const struct candidate *candidate,
                    const uint32_t *faces, uint32_t count, double limit)
{
    uint32_t places[4] = { 0, 0, 0, 0 };
    double most = limit + 2 * c->effort->balance * count;
    for (uint32_t i = 0; i < count; i++) {
        enum obstruction_place place = candidate_place(c, candidate, faces[i]);
        places[place]++;
        if (place == OBSTRUCTION_ACROSS && places[place] > most) {
            return INFINITY;
        }
    }
    double counts[4] = { places[0], places[1], places[2], places[3] };
    return score_of(c, counts);
}

/* Takes a candidate among the finalists if it is good enough. */
static void enter(struct chooser *c, struct candidate *candidate)
{
    uint32_t most = c->effort->finalists;
    double limit = c->best_count < most ? INFINITY : c->best[most - 1].score;
    candidate->score = judge(c, candidate, c->sample, c->sample_count, limit);
    if (!(candidate->score < limit)) {
        return;
    }
    uint32_t at = c->best_count < most ? c->best_count++ : most - 1;
    while (at > 0 && c->best[at - 1].score > candidate->score) {
        c->best[at] = c->best[at - 1];
        at--;
    }
    c->best[at] = *candidate;
}

static void set_unit(struct candidate *candidate)
{
    double n[3] = { candidate->n[0], candidate->n[1], candidate->n[2] };
    double length = sqrt(n[0] * n[0] + n[1] * n[1] + n[2] * n[2]);
    for (int k = 0; k < 3; k++) {
        candidate->normal[k] = n[k] / length;
    }
    candidate->offset = (double)candidate->d / length;
}

static void enter_own(struct chooser *c, uint32_t record)
{
    const struct plane *plane = &c->planes->all[record];
    struct candidate candidate = { .d = plane->d, .record = record };
    memcpy(candidate.n, plane->n, sizeof candidate.n);
    set_unit(&candidate);
    enter(c, &candidate);
}

/* The plane with this normal, of any length, through a point. False: the normal is none. */
static bool make_plane(struct candidate *candidate, const double normal[3], const double point[3])
{
    const double limit = (1 << NORMAL_BITS) - 1;
    double greatest = fmax(fabs(normal[0]), fmax(fabs(normal[1]), fabs(normal[2])));
    if (!(greatest > 0)) {
        return false;
    }
    *candidate = (struct candidate){ .record = MESH_NONE };
    double d = 0;
    for (int k = 0; k < 3; k++) {
        candidate->n[k] = (int32_t)floor(normal[k] / greatest * limit + 0.5);
        d -= candidate->n[k] * point[k];
    }
    candidate->d = (int64_t)floor(d + 0.5);
    set_unit(candidate);
    return true;
}

static const struct obstruction_face *any_face(const struct chooser *c)
{
    return &c->set->faces[c->faces[random_below(c->random, c->count)]];
}

static void try_own_planes(struct chooser *c)
{
    bool all = c->count <= c->effort->own;
    uint32_t count = all ? c->count : c->effort->own;
    uint32_t before = MESH_NONE;
    for (uint32_t i = 0; i < count; i++) {
        const struct obstruction_face *face = all ? &c->set->faces[c->faces[i]] : any_face(c);
        if (face->plane != before) {
            enter_own(c, face->plane);
        }
        before = face->plane;
    }
}

static void cross(const double a[3], const double b[3], double out[3])
{
    out[0] = a[1] * b[2] - a[2] * b[1];
    out[1] = a[2] * b[0] - a[0] * b[2];
    out[2] = a[0] * b[1] - a[1] * b[0];
}

static void subtract(const double a[3], const double b[3], double out[3])
{
    for (int k = 0; k < 3; k++) {
        out[k] = a[k] - b[k];
    }
}

static bool make_through(struct candidate *candidate, const double *a, const double *b,
                         const double *c)
{
    double ab[3];
    double ac[3];
    double normal[3];
    subtract(b, a, ab);
    subtract(c, a, ac);
    cross(ab, ac, normal);
    if (!make_plane(candidate, normal, a)) {
        return false;
    }
    candidate->through[0] = a;
    candidate->through[1] = b;
    candidate->through[2] = c;
    return true;
}

static const double *any_corner(const struct chooser *c, const struct obstruction_face *face)
{
    return c->set->points[face->first + random_below(c->random, face->count)];
}

/* Through an edge of a face: upright on the face, or to a corner of another. */
static void try_edge(struct chooser *c)
{
    const struct obstruction_face *face = any_face(c);
    const double(*points)[3] = (const double(*)[3])c->set->points + face->first;
    uint32_t corner = random_below(c->random, face->count);
    const double *from = points[corner];
    const double *to = points[corner + 1 < face->count ? corner + 1 : 0];
    struct candidate candidate;
    bool made;
    if (random_below(c->random, 4) == 0) {
        double edge[3];
        double normal[3];
        subtract(to, from, edge);
        cross(edge, face->normal, normal);
        made = make_plane(&candidate, normal, from);
    } else {
        made = make_through(&candidate, from, to, any_corner(c, any_face(c)));
    }
    if (made) {
        enter(c, &candidate);
    }
}

/* ---- climbing ---- */

/* A face that the candidate cuts, if one is met soon. */
static const struct obstruction_face *cut_face(const struct chooser *c,
                                               const struct candidate *candidate)
{
    enum { TRIES = 24 };
    uint32_t number = 0;
    for (int i = 0; i < TRIES; i++) {
        number = c->sample[random_below(c->random, c->sample_count)];
        if (candidate_place(c, candidate, number) == OBSTRUCTION_ACROSS) {
            break;
        }
    }
    return &c->set->faces[number];
}

/* Moves one of the three points to a corner of a face that is cut, as long as that helps. */
static void climb(struct chooser *c, struct candidate *candidate)
{
    for (uint32_t i = 0; i < c->effort->climbs; i++) {
        const double *through[3];
        struct candidate next;
        memcpy(through, candidate->through, sizeof through);
        const double *corner = any_corner(c, cut_face(c, candidate)); /* drawn first */
        through[random_below(c->random, 3)] = corner;
        if (!make_through(&next, through[0], through[1], through[2])) {
            continue;
        }
        next.score = judge(c, &next, c->sample, c->sample_count, candidate->score);
        if (next.score < candidate->score) {
            *candidate = next;
        }
    }
}

static void climb_finalists(struct chooser *c)
{
    for (uint32_t i = 0; i < c->best_count; i++) {
        if (c->best[i].through[0] != NULL) {
            climb(c, &c->best[i]);
        }
    }
}

/* ---- planes swept through gaps ---- */

/* Where a face begins or ends along a direction. */
struct bound {
    double at;
    int step;
};

static int compare_bounds(const void *left, const void *right)
{
    const struct bound *a = left;
    const struct bound *b = right;
    return a->at != b->at ? (a->at > b->at ? 1 : -1) : a->step - b->step;
}

/* The best place between two bounds; false if there is none. */
static bool best_gap(const struct chooser *c, const struct bound *bounds, double *at)
{
    uint32_t count = c->sample_count;
    double best = INFINITY;
    uint32_t begun = 0;
    uint32_t ended = 0;
    for (uint32_t i = 0; i + 1 < 2 * count; i++) {
        begun += bounds[i].step > 0;
        ended += bounds[i].step < 0;
        if (ended == 0 || begun == count || !(bounds[i + 1].at > bounds[i].at)) {
            continue;
        }
        double score = begun - ended - c->effort->balance * count * entropy(begun, count - ended);
        if (score < best) {
            best = score;
            *at = (bounds[i].at + bounds[i + 1].at) / 2;
        }
    }
    return best < INFINITY;
}

static void sweep(struct chooser *c, const double way[3], struct bound *bounds)
{
    double shrink = c->set->step;
    for (uint32_t i = 0; i < c->sample_count; i++) {
        double range[2];
        heights_of(c->set, &c->set->faces[c->sample[i]], way, 0, range);
        double middle = (range[0] + range[1]) / 2; /* what reaches across less is not cut */
        bounds[2 * i] = (struct bound){ fmin(range[0] + shrink, middle), 1 };
        bounds[2 * i + 1] = (struct bound){ fmax(range[1] - shrink, middle), -1 };
    }
    qsort(bounds, 2 * (size_t)c->sample_count, sizeof *bounds, compare_bounds);
    double at = 0;
    if (best_gap(c, bounds, &at)) {
        double point[3] = { way[0] * at, way[1] * at, way[2] * at };
        struct candidate candidate;
        if (make_plane(&candidate, way, point)) {
            enter(c, &candidate);
        }
    }
}

static double random_unit(struct chooser *c)
{
    return (double)random_below(c->random, 1u << 30) / (1u << 29) - 1;
}

static void try_sweeps(struct chooser *c)
{
    struct bound *bounds = xalloc(2 * (size_t)c->sample_count, sizeof *bounds);
    for (uint32_t i = 0; i < c->effort->directions; i++) {
        double way[3] = { i == 0, i == 1, i == 2 };
        double length = 1;
        if (i > 2) {
            for (int k = 0; k < 3; k++) {
                way[k] = random_unit(c);
            }
            length = sqrt(way[0] * way[0] + way[1] * way[1] + way[2] * way[2]);
        }
        if (length > 0.01) {
            way[0] /= length;
            way[1] /= length;
            way[2] /= length;
            sweep(c, way, bounds);
        }
    }
    free(bounds);
}

/* ---- choosing ---- */

static uint32_t *take_sample(const struct chooser *c)
{
    uint32_t *sample = xalloc(c->effort->sample, sizeof *sample);
    for (uint32_t i = 0; i < c->effort->sample; i++) {
        sample[i] = c->faces[random_below(c->random, c->count)];
    }
    return sample;
}

/* Does the plane, exactly, leave less for either child than there is? */
static bool takes_further(const struct chooser *c, uint32_t plane)
{
    bool front = false; /* something is in front alone, or on the plane */
    bool back = false;
    for (uint32_t i = 0; i < c->count && !(front && back); i++) {
        enum obstruction_place place =
            obstruction_place_of(c->set, &c->set->faces[c->faces[i]], plane);
        front |= place == OBSTRUCTION_FRONT || place == OBSTRUCTION_ON;
        back |= place == OBSTRUCTION_BACK || place == OBSTRUCTION_ON;
    }
    return front && back;
}

static int compare_candidates(const void *left, const void *right)
{
    double a = ((const struct candidate *)left)->score;
    double b = ((const struct candidate *)right)->score;
    return (a > b) - (a < b);
}

/* The finalists, judged by all faces, the best first. */
static void judge_finalists(struct chooser *c)
{
    double limit = INFINITY;
    for (uint32_t i = 0; i < c->best_count; i++) {
        c->best[i].score = judge(c, &c->best[i], c->faces, c->count, limit);
        limit = fmin(limit, c->best[i].score);
    }
    qsort(c->best, c->best_count, sizeof *c->best, compare_candidates);
}

/* Judges finalists by what is cut in the end. */
static void judge_wholes(struct chooser *c)
{
    uint8_t *places = xalloc(c->count, sizeof *places);
    for (uint32_t i = 0; i < c->best_count; i++) {
        struct candidate *candidate = &c->best[i];
        double counts[4] = { 0, 0, 0, 0 };
        if (!(candidate->score < INFINITY)) {
            continue;
        }
        for (uint32_t k = 0; k < c->count; k++) {
            places[k] = (uint8_t)candidate_place(c, candidate, c->faces[k]);
        }
        obstruction_keep_whole(c->set, candidate->normal, candidate->offset, c->faces, c->count,
                               places);
        for (uint32_t k = 0; k < c->count; k++) {
            counts[places[k]]++;
        }
        candidate->score = score_of(c, counts);
    }
    free(places);
    qsort(c->best, c->best_count, sizeof *c->best, compare_candidates);
}

uint32_t obstruction_choose(struct obstruction_set *set, struct planes *planes,
                            const uint32_t *faces, uint32_t count,
                            const struct obstruction_effort *effort, struct random *random)
{
    struct chooser c = { set, planes, faces, count, faces, count, effort, random, NULL, 0 };
    uint32_t *sample = NULL;
    uint32_t chosen = set->faces[faces[0]].plane;
    c.best = xalloc(effort->finalists, sizeof *c.best);
    if (count > effort->sample) {
        c.sample = sample = take_sample(&c);
        c.sample_count = effort->sample;
    }
    try_own_planes(&c);
    for (uint32_t i = 0; i < effort->edges; i++) {
        try_edge(&c);
    }
    try_sweeps(&c);
    climb_finalists(&c);
    judge_finalists(&c);
    if (count <= effort->ahead) {
        judge_wholes(&c);
    }
    for (uint32_t i = 0; i < c.best_count && c.best[i].score < INFINITY; i++) {
        if (c.best[i].record != MESH_NONE) { /* its own faces lie on it */
            chosen = c.best[i].record;
            break;
        }
        uint32_t plane = plane_add(planes, c.best[i].n, c.best[i].d, 0);
        if (takes_further(&c, plane)) {
            chosen = plane;
            break;
        }
        planes->count--;
    }
    free(sample);
    free(c.best);
    return chosen;
}
